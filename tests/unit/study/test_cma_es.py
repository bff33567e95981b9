"""CMA-ES by the library: what we add to it keeps its numbers, its end, its restarts, and its state."""

import sys

import cmaes
import numpy as np
import pytest

from neuromech.errors import MissingExtraError
from neuromech.study.algorithms.cma_es import CmaEs, CmaEsSettings
from neuromech.study.score import Score


def search(dimension=3, start=None, **settings):
    return CmaEs(CmaEsSettings(**settings), dimension, 1, start)


def go(algorithm, judge, generations):
    for _ in range(generations):
        algorithm.tell([judge(point) for point in algorithm.ask()])


@pytest.mark.parametrize(("covariance", "kind"), [("full", cmaes.CMA), ("separable", cmaes.SepCMA)])
def test_the_distribution_is_updated_as_the_library_does(covariance, kind):
    start = np.full(4, 0.4)
    ours = search(4, start, step=0.2, covariance=covariance)
    theirs = kind(np.full(4, 0.4), 0.2, np.tile([0.0, 1.0], (4, 1)), seed=0)
    for _ in range(40):
        points = ours.ask()
        values = [float(np.sum(np.arange(1.0, 5.0) * (point - 0.6) ** 2)) for point in points]
        theirs.tell(list(zip(points, values, strict=True)))
        ours.tell([Score(0, -value) for value in values])
    state = ours.state()["memory"]
    assert state["mean"] == pytest.approx(theirs.mean, rel=1e-9)
    assert state["sigma"] == pytest.approx(theirs._sigma, rel=1e-9)
    assert state["g"] == theirs.generation == 40
    assert (start == 0.4).all(), "the library moves the document's own values"


def evaluations_until(target, dimension, **settings):
    """Return what an ellipsoid along the axes takes whose longest axis is a thousand times the shortest."""
    scales = 1e3 ** (np.arange(dimension) / (dimension - 1))
    one = search(dimension, np.full(dimension, 0.4), **settings)
    count, best = 0, np.inf
    while best > target:
        values = [float(np.sum((scales * (point - 0.6)) ** 2)) for point in one.ask()]
        one.tell([Score(0, -value) for value in values])
        count, best = count + len(values), min(best, *values)
    return count


def test_a_separable_search_learns_many_independent_scales_sooner():
    full = evaluations_until(1.0, 20)
    assert 1.5 * evaluations_until(1.0, 20, covariance="separable") < full


def test_a_separable_search_stores_one_number_for_each_parameter():
    assert len(search(95, covariance="separable").state()["memory"]["C"]) == 95
    assert len(search(95).state()["memory"]["c_1d"]) == 95 * 96 // 2


def test_candidates_begin_around_the_documents_values():
    points = search(2, np.array([0.3, 0.8]), population=4000, step=0.05).ask()
    assert points.mean(axis=0) == pytest.approx([0.3, 0.8], abs=5e-3)
    assert points.std(axis=0) == pytest.approx([0.05, 0.05], abs=3e-3)


@pytest.mark.parametrize(("dimension", "expected"), [(1, 4), (10, 10), (100, 17)])
def test_the_default_population_grows_with_the_logarithm_of_the_dimension(dimension, expected):
    assert len(search(dimension).ask()) == expected


def test_a_generation_of_failures_leaves_the_distribution_as_it_was():
    one = search()
    go(one, lambda point: Score(0, float(point.sum())), 3)
    before, points = one.state()["memory"], one.ask()
    one.tell([None] * len(points))
    assert one.state()["memory"] == before
    assert (one.ask() != points).all()


def test_a_search_at_its_end_goes_on_with_sound_numbers():
    one = search(2)
    go(one, lambda point: Score(0, -float(np.sum((point - 0.3) ** 2))), 400)
    assert one.ask() == pytest.approx(np.full((6, 2), 0.3), abs=1e-6)
    assert np.isfinite(one.state()["memory"]["c_1d"]).all()


def test_restarts_double_the_population_where_the_search_has_come_to_an_end():
    one = search(2, population=5, restarts="ipop")
    sizes = []
    for _ in range(60):
        points = one.ask()
        sizes.append(len(points))
        one.tell([Score(0, 0.0)] * len(points))
    assert sizes == sorted(sizes)
    assert {5, 10, 20} <= set(sizes)
    assert one.state()["memory"]["population"] == sizes[-1]
    resumed = search(2, population=5, restarts="ipop")
    resumed.restore(one.state())
    assert np.array_equal(resumed.ask(), one.ask())


def hollows(point):
    """Return a score with a hollow at each place of a grid; the deepest is off the middle."""
    x = 10.0 * (point - 0.62)
    return Score(0, -float(np.sum(x**2 - 10.0 * np.cos(2.0 * np.pi * x) + 10.0)))


def generations_before_a_restart(judge):
    """Return how many generations go by before the population grows."""
    one = search(4, population=8, restarts="ipop")
    for generation in range(400):
        points = one.ask()
        if len(points) > 8:
            return generation
        one.tell([judge(point) for point in points])
    return 400


def test_a_search_in_a_hollow_restarts_where_the_librarys_own_would():
    theirs = cmaes.CMA(np.full(4, 0.5), 0.3, np.tile([0.0, 1.0], (4, 1)), seed=1, population_size=8)
    while not theirs.should_stop():
        points = [theirs.ask() for _ in range(8)]
        theirs.tell([(point, -hollows(point).value) for point in points])
    assert generations_before_a_restart(hollows) == pytest.approx(theirs.generation, rel=0.2)


def test_a_plateau_ends_with_a_failure_or_another_stage():
    flat = search(2, population=5, restarts="ipop")
    for generation in range(60):
        points = flat.ask()
        assert len(points) == 5
        scores = [Score(generation // 5 % 2, 1e-3 * index) for index in range(5)]
        flat.tell([None, *scores[1:]] if generation % 7 == 0 else scores)


def test_a_flat_landscape_does_not_restart_where_that_is_not_asked_for():
    one = search(2, population=5)
    go(one, lambda _point: Score(0, 0.0), 100)
    assert len(one.ask()) == 5


def test_a_library_that_is_not_installed_is_one_line(monkeypatch):
    monkeypatch.setitem(sys.modules, "cmaes", None)
    with pytest.raises(MissingExtraError, match=r"^cmaes is not installed\. Hint: pip install 'neuromech\[study\]'$"):
        search()
