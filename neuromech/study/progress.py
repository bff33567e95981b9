"""How far a search is: what a terminal shows while it runs."""

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from neuromech.study.evaluation import Evaluation, Job
from neuromech.study.score import Score


@dataclass(frozen=True, slots=True)
class Standing:
    """How far a search is.

    Args:
        generation: the one that is evaluated, from 0.
        done: how many evaluations are complete, those of earlier sessions included.
        total: how many there will be, as far as is known.
        best: the best score so far, None before the first one; while the best are confirmed, the best of these.
        median: median score of the latest complete generation, failed candidates counting as worst; None where half of
            them failed, or before there is one.
        crashed: how many candidates crashed or diverged.
        fallen: how many fell.
        rate: evaluations per second since this start of it (1/s), 0 before the first one.
        real_time_factor: simulated seconds per second on the clock since this start of it.
        remaining: seconds until the end at this rate; None before the first evaluation since this start of it.
        is_confirming: whether the search is over and its best are confirmed.
    """

    generation: int
    done: int
    total: int
    best: Score | None
    median: Score | None
    crashed: int
    fallen: int
    rate: float
    real_time_factor: float
    remaining: float | None
    is_confirming: bool = False


Report = Callable[[Standing], None]


@dataclass
class Tally:
    """Counts what is done; makes a `Standing` of it.

    Args:
        total: how many evaluations there will be.
        clock: seconds, from any start.
    """

    total: int
    clock: Callable[[], float] = time.monotonic
    generation: int = 0
    best: Score | None = None
    median: Score | None = None
    done: int = 0
    crashed: int = 0
    fallen: int = 0
    is_confirming: bool = False
    confirmed: Score | None = None
    _started: float = 0.0
    _session: int = 0
    _simulated: float = 0.0

    def start(self) -> None:
        """Begin a session: rates are counted from here."""
        self._started = self.clock()

    def add(self, evaluation: Evaluation, fresh: bool = True) -> None:
        """Count an evaluation; one that is not fresh was stored by an earlier session."""
        self.done += 1
        self.crashed += evaluation.score is None
        self.fallen += evaluation.fell
        if evaluation.confirms is None:
            self.best = best(self.best, evaluation.score)
        else:
            self.confirmed = best(self.confirmed, evaluation.score)
            self.total += not fresh
        if fresh:
            self._session += 1
            self._simulated += evaluation.simulated_seconds

    def expect(self, jobs: Sequence[Job]) -> None:
        """Take note of what is evaluated next; what confirms others comes on top of the search."""
        self.is_confirming = jobs[0].confirms is not None
        if self.is_confirming:
            self.total = self.done + len(jobs)

    def end_generation(self, scores: Sequence[Score | None]) -> None:
        """Take note that a generation is complete."""
        self.generation += 1
        self.median = median(scores)

    def standing(self) -> Standing:
        """Return how far the search is now."""
        seconds = max(self.clock() - self._started, 1e-9)
        rate = self._session / seconds
        return Standing(
            generation=self.generation,
            done=self.done,
            total=self.total,
            best=self.confirmed if self.is_confirming else self.best,
            median=self.median,
            crashed=self.crashed,
            fallen=self.fallen,
            rate=rate,
            real_time_factor=self._simulated / seconds,
            remaining=max(self.total - self.done, 0) / rate if rate else None,
            is_confirming=self.is_confirming,
        )


def best(one: Score | None, other: Score | None) -> Score | None:
    """Return the better of two scores; a failed one is worse than any."""
    if one is None or other is None:
        return other if one is None else one
    return max(one, other)


def median(scores: Sequence[Score | None]) -> Score | None:
    """Return the lower median of scores, failed ones counting as worst; None where that is a failed one."""
    ordered = sorted(score for score in scores if score is not None)
    failed = len(scores) - len(ordered)
    position = (len(scores) - 1) // 2 - failed
    return ordered[position] if scores and position >= 0 else None
