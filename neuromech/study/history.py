"""What a study found: its generations in a row, its best candidate, and why candidates failed."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from neuromech.study.evaluation import Evaluation
from neuromech.study.progress import median
from neuromech.study.score import Score, ranks


@dataclass(frozen=True, slots=True)
class Generation:
    """One generation in numbers.

    Args:
        number: from 0.
        evaluations: how many of its candidates are complete.
        best: its best score; None where all of its candidates failed.
        median: its lower median, failed candidates counting as worst; None where that is a failed one.
        best_so_far: the best score of this generation and all before it.
        failed: how many crashed or diverged.
        fell: how many fell.
    """

    number: int
    evaluations: int
    best: Score | None
    median: Score | None
    best_so_far: Score | None
    failed: int
    fell: int


@dataclass(frozen=True, slots=True)
class Confirmed:
    """A candidate that was evaluated again after the search.

    Args:
        evaluation: with fresh seeds.
        searched: its score in the search; None for a place that was none of the candidates.
    """

    evaluation: Evaluation
    searched: Score | None


def generations(evaluations: Iterable[Evaluation]) -> list[Generation]:
    """Return the generations of the search that have complete evaluations, in order."""
    members: dict[int, list[Evaluation]] = {}
    for evaluation in _searched(evaluations):
        members.setdefault(evaluation.generation, []).append(evaluation)
    found: list[Generation] = []
    for number in sorted(members):
        so_far = found[-1].best_so_far if found else None
        found.append(_generation(number, members[number], so_far))
    return found


def best_of(evaluations: Sequence[Evaluation]) -> Evaluation | None:
    """Return the evaluation with the best score, the earliest of equals; None where all failed.

    Where candidates were confirmed it is the best of those evaluations, whatever the scores of the search were.
    """
    best: Evaluation | None = None
    for evaluation in _latest_confirmed(evaluations) or sorted(evaluations, key=lambda one: one.number):
        if evaluation.score is not None and (best is None or best.score is None or evaluation.score > best.score):
            best = evaluation
    return best


def confirmed(evaluations: Sequence[Evaluation]) -> list[Confirmed]:
    """Return the candidates that were evaluated again, with the seeds of the latest such evaluation, best first."""
    searched = {one.number: one.score for one in _searched(evaluations)}
    found = [
        Confirmed(one, searched[one.confirms] if isinstance(one.confirms, int) else None)
        for one in _latest_confirmed(evaluations)
    ]
    places = ranks([one.evaluation.score for one in found])
    return [one for _, _, one in sorted(zip(places, range(len(found)), found, strict=True))]


def failures(evaluations: Iterable[Evaluation]) -> list[tuple[str, list[int]]]:
    """Return why candidates failed, the most frequent reason first, each with the numbers of its evaluations."""
    numbers: dict[str, list[int]] = {}
    for evaluation in evaluations:
        if evaluation.failure is not None:
            numbers.setdefault(evaluation.failure, []).append(evaluation.number)
    return sorted(numbers.items(), key=lambda pair: (-len(pair[1]), pair[0]))


def _searched(evaluations: Iterable[Evaluation]) -> list[Evaluation]:
    return [one for one in evaluations if one.confirms is None]


def _latest_confirmed(evaluations: Iterable[Evaluation]) -> list[Evaluation]:
    """Return the evaluations that confirm others, by number, without those that had other seeds than the latest one."""
    found = sorted((one for one in evaluations if one.confirms is not None), key=lambda one: one.number)
    seeds = next((one.seeds for one in reversed(found) if one.score is not None), ())
    return [one for one in found if one.score is None or one.seeds == seeds]


def _generation(number: int, members: Sequence[Evaluation], so_far: Score | None) -> Generation:
    scores = [member.score for member in members]
    best = max((score for score in scores if score is not None), default=None)
    return Generation(
        number=number,
        evaluations=len(members),
        best=best,
        median=median(scores),
        best_so_far=max((score for score in (best, so_far) if score is not None), default=None),
        failed=scores.count(None),
        fell=sum(member.fell for member in members),
    )
