"""Laws that every search algorithm must keep. A law takes what makes a search from a seed, uses it, and asserts.

    def make(seed):
        return MySearch(MySettings(population=8), dimension=3, seed=seed, start=None)

    def test_state():
        state_goes_on_exactly(make)

Each call of `make` must give a new search with the same settings, dimension and start.
"""

import json
from collections.abc import Callable, Sequence
from itertools import pairwise

import numpy as np

from neuromech.study.algorithms.base import Algorithm, Floats
from neuromech.study.score import Score

Maker = Callable[[int], Algorithm]
Judge = Callable[[Floats], list[Score | None]]


def sphere(points: Floats) -> list[Score | None]:
    """Rate points by minus their squared distance from 0.7 in every coordinate."""
    return [Score(0, -float(value)) for value in np.sum((points - 0.7) ** 2, axis=1)]


def rough(points: Floats) -> list[Score | None]:
    """Rate points in three stages by their first coordinates; a third of the cube fails."""
    return [
        None if point[-1] > 2.0 / 3.0 else Score(int(3.0 * point[0] * 0.999), float(np.sin(20.0 * point).sum()))
        for point in points
    ]


def generations(algorithm: Algorithm, judge: Judge, count: int) -> list[Floats]:
    """Search for a number of generations and return their candidates."""
    asked = []
    for _ in range(count):
        asked.append(algorithm.ask())
        algorithm.tell(judge(asked[-1]))
    return asked


def candidates_stay_inside(make: Maker, count: int = 30) -> None:
    """Every candidate has a value in [0, 1] for each parameter, also where the best place is a corner or outside."""

    def corner(points: Floats) -> list[Score | None]:
        return [Score(0, float(value)) for value in (points.sum(axis=1))]

    for judge in (corner, rough, sphere):
        algorithm = make(1)
        for points in generations(algorithm, judge, count):
            assert points.dtype == np.float64
            assert points.ndim == 2
            assert points.shape[1] == algorithm.dimension, points.shape
            assert (points >= 0.0).all(), points.min()
            assert (points <= 1.0).all(), points.max()


def centers_stay_inside(make: Maker, count: int = 10) -> None:
    """`centers` gives places inside the cube, any number of them, the same again from a restored state, and a copy."""
    algorithm, other = make(12), make(12)
    for _ in range(count):
        found = algorithm.centers()
        assert found.shape[1:] == (algorithm.dimension,), found.shape
        assert ((found >= 0.0) & (found <= 1.0)).all()
        other.restore(json.loads(json.dumps(algorithm.state())))
        assert np.array_equal(other.centers(), found)
        kept = algorithm.ask()
        found[:] = 0.5
        assert np.array_equal(algorithm.ask(), kept)
        algorithm.tell(rough(kept))


def asking_again_changes_nothing(make: Maker) -> None:
    """`ask` gives the same until `tell`, whatever is done with its answer, and however often it was asked."""
    eager, plain = make(2), make(2)
    for _ in range(3):
        first = eager.ask()
        kept = first.copy()
        first[:] = 0.5
        eager.state()
        assert np.array_equal(eager.ask(), kept)
        assert np.array_equal(plain.ask(), kept)
        eager.tell(rough(kept))
        plain.tell(rough(kept))


def seed_decides(make: Maker, count: int = 5) -> None:
    """The same seed gives the same candidates to the last bit, another seed gives others, global generators nothing."""
    np.random.seed(0)
    one = generations(make(3), rough, count)
    np.random.seed(1)
    two = generations(make(3), rough, count)
    other = generations(make(4), rough, count)
    assert all(np.array_equal(left, right) for left, right in zip(one, two, strict=True))
    assert all(left.shape != right.shape or (left != right).any() for left, right in zip(one, other, strict=True))


def state_goes_on_exactly(make: Maker, count: int = 5) -> None:
    """A search restored from its state, as JSON text, has the same candidates as the one that was never interrupted.

    The state is taken at every generation from the first on, before and after `ask`.
    """
    whole = make(5)
    texts = []
    asked = []
    for _ in range(2 * count):
        texts.append(json.dumps(whole.state(), allow_nan=False))
        asked.append(whole.ask())
        assert json.dumps(whole.state(), allow_nan=False) == texts[-1], "asking changes the state"
        whole.tell(rough(asked[-1]))
    for begin in range(count):
        resumed = make(5)
        resumed.restore(json.loads(texts[begin]))
        found = generations(resumed, rough, count)
        assert all(np.array_equal(left, right) for left, right in zip(found, asked[begin:], strict=False)), begin
        assert json.dumps(resumed.state(), allow_nan=False) == texts[begin + count]


def failures_are_survived(make: Maker) -> None:
    """Generations in which all candidates but one, or all of them, fail leave a search that still finds its way."""
    algorithm = make(6)
    for alive in (0, 0, 1, 0):
        points = algorithm.ask()
        algorithm.tell([score if index < alive else None for index, score in enumerate(sphere(points))])
    asked = generations(algorithm, sphere, 60)
    assert all(np.isfinite(points).all() for points in asked)
    first, last = (max(score for score in sphere(points) if score) for points in (asked[0], asked[-1]))
    assert last > first, "it does not get better any more"


def failing_places_are_left(make: Maker, count: int = 40) -> None:
    """Where the score rises towards a wall and candidates beyond fail, later generations do not all lie beyond it."""

    def wall(points: Floats) -> list[Score | None]:
        return [None if point[0] > 0.6 else Score(0, float(point[0])) for point in points]

    asked = generations(make(7), wall, count)
    beyond = [float((points[:, 0] > 0.6).mean()) for points in asked]
    assert float(np.mean(beyond[-count // 4 :])) < 0.9, beyond
    best = [max((score.value for score in wall(points) if score is not None), default=0.0) for points in asked]
    assert max(best) > 0.55, best


def it_gets_better(make: Maker, count: int = 60, factor: float = 10.0) -> None:
    """The best squared distance on the sphere shrinks by a factor within some generations."""
    asked = generations(make(8), sphere, count)
    first, last = ([-score.value for score in sphere(points) if score] for points in (asked[0], asked[-1]))
    assert min(last) * factor <= min(first), (min(first), min(last))


def wrong_number_of_scores_is_refused(make: Maker) -> None:
    """More or fewer scores than candidates raise `ValueError` and change nothing."""
    algorithm = make(9)
    points = algorithm.ask()
    scores = sphere(points)
    for wrong in (scores[:-1], [*scores, None], []):
        try:
            algorithm.tell(wrong)
        except ValueError:
            assert np.array_equal(algorithm.ask(), points)
            continue
        raise AssertionError("a wrong number of scores is taken")


def only_the_order_matters(make: Maker, count: int = 15) -> None:
    """Scores that are changed without changing their order give the same candidates. Not for value-based searches."""

    def judge(change: Callable[[Score], Score]) -> Judge:
        return lambda points: [None if score is None else change(score) for score in rough(points)]

    plain = generations(make(10), rough, count)
    for change in (
        lambda score: Score(score.stage, 2.0 * score.value - 7.0),
        lambda score: Score(score.stage, float(np.expm1(score.value))),
        lambda score: Score(3 * score.stage + 1, score.value),
        lambda score: Score(0, 100.0 * score.stage + score.value),
    ):
        found = generations(make(10), judge(change), count)
        assert all(np.array_equal(left, right) for left, right in zip(found, plain, strict=True))


def best_are_carried_over(make: Maker, elites: int, count: int = 15) -> None:
    """The best scored candidates of a generation are among the next one, bit for bit; failed ones never are."""
    asked = generations(make(11), rough, count)
    for points, following in pairwise(asked):
        scored = [(score, index) for index, score in enumerate(rough(points)) if score is not None]
        scored.sort(key=lambda pair: (pair[0], -pair[1]), reverse=True)
        for _, index in scored[:elites]:
            assert (following == points[index]).all(axis=1).any(), "an elite is lost"
        for index in set(range(len(points))) - {index for _, index in scored}:
            assert not (following == points[index]).all(axis=1).any(), "a failed candidate is carried over"


ALL: Sequence[Callable[[Maker], None]] = (
    candidates_stay_inside,
    centers_stay_inside,
    asking_again_changes_nothing,
    seed_decides,
    state_goes_on_exactly,
    failures_are_survived,
    failing_places_are_left,
    it_gets_better,
    wrong_number_of_scores_is_refused,
)
"""The laws that hold for every algorithm; the remaining ones depend on its kind."""
