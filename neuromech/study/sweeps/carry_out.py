"""A sweep from its first run to its results: what is finished is kept, what is left is run side by side."""

from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import dataclass

from neuromech.study.executors import Done, Executor, Stop
from neuromech.study.sweeps.design import SweepJob
from neuromech.study.sweeps.journal import Journal
from neuromech.study.sweeps.results import PointResult
from neuromech.study.sweeps.task import SweepTask


@dataclass(frozen=True, slots=True)
class SweepStanding:
    """How far a sweep is.

    Args:
        done: points that are finished, those of earlier sessions included.
        total: all points.
        outcomes: how many ended in which way.
    """

    done: int
    total: int
    outcomes: Counter[str]


def carry_out(
    task: SweepTask, journal: Journal, executor: Executor, stop: Stop, report: Callable[[SweepStanding], None]
) -> list[PointResult]:
    """Run what is left of a sweep and return what became of all points that are finished.

    The results are in the order of the jobs, whatever the executor and the number of its workers.

    Args:
        task: the sweep.
        journal: holds what is finished already, and gets what will be.
        executor: where runs take place.
        stop: when it turns true, no other run begins.
        report: is told how far the sweep is, at the beginning and after each run.

    Raises:
        DocumentError: the changed document is wrong.
        MeasureError: a measure does not fit what was recorded.
        OSError: the journal cannot be written.
    """
    jobs = task.design.jobs()
    left = [job for job in jobs if job.number not in journal.finished]
    report(_standing(journal, task))
    if left:
        executor.prepare(task.prepare)
    for done in executor.run(task, left, stop):
        journal.write(done.job.number, done.result if done.result is not None else _crashed(task, done))
        report(_standing(journal, task))
    return [result for number in sorted(journal.finished) for result in journal.finished[number]]


def _crashed(task: SweepTask, done: Done[SweepJob, tuple[PointResult, ...]]) -> tuple[PointResult, ...]:
    words = str(done.crash)
    missing = dict.fromkeys(task.sweep.measures, "crashed")
    return tuple(PointResult(point, task.seed(point), "crashed", 0.0, words, missing, "") for point in done.job.points)


def _standing(journal: Journal, task: SweepTask) -> SweepStanding:
    results: Iterable[PointResult] = (result for some in journal.finished.values() for result in some)
    outcomes = Counter[str](result.outcome for result in results)
    return SweepStanding(outcomes.total(), task.design.size(), outcomes)
