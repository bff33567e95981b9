"""A small study whose candidates are judged by a formula, and what runs it without processes."""

import os
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Future
from functools import partialmethod
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from neuromech.compiler.numerics import Floats
from neuromech.pipeline import load_document
from neuromech.study.database import Database
from neuromech.study.driver import Search
from neuromech.study.evaluation import Evaluation, Job, RunResult
from neuromech.study.executors import Executor
from neuromech.study.plan import Plan
from neuromech.study.score import Score
from neuromech.study.space import Space
from neuromech.study.storage import StoredStudy
from neuromech.study.tasks import Packed, call
from neuromech.units import measure

DOCUMENT = """
neuromech: 1
name: two cells
parameters:
  gain: {value: 0.5, minimum: 0.1, maximum: 2}
  delay: {value: 20 ms, minimum: 1 ms, maximum: 0.1 s}
network:
  neurons:
    first: {kind: rate_neuron, time_constant: "${delay}", bias: 1}
    second: {kind: rate_neuron, time_constant: 10 ms}
  synapses:
    excitatory:
      first: {second: "${gain}"}
protocol: {duration: 50 ms}
record:
  all: {signals: ["*.activity"], every: 1 ms}
study:
  tune: {gain: {}, delay: {scale: log}}
  algorithm: {kind: pso, population: 4}
  evaluations: 14
  seed: 3
  scenarios: {plain: {seeds: 2}}
  objective:
    terms:
      level: {measure: {kind: final, signal: second.activity}, target: 0.3, scale: 0.1}
"""


def plan_in(folder: Path, *overrides: str, text: str = DOCUMENT) -> Plan:
    """Write the document into a folder and return its plan."""
    file = folder / "cells.yaml"
    file.write_text(text, "utf-8")
    return Plan.of(load_document(file, overrides))


def coordinates(space: Space, job: Job) -> Floats:
    """Return the point of the cube at which a candidate is."""
    return np.array([one.coordinate(measure(job.parameters[one.name])[0]) for one in space.dimensions])


class Paraboloid:
    """Judges a candidate by its distance from a place of the cube; notes what it evaluated in a file."""

    def __init__(self, space: Space, notes: Path, crashing: tuple[int, ...] = (), deadly: tuple[int, ...] = ()) -> None:
        self.space = space
        self.notes = notes
        self.crashing = crashing
        self.deadly = deadly

    def __call__(self, job: Job) -> Evaluation:
        with self.notes.open("a") as stream:
            stream.write(f"{job.number}\n")
        if job.number in self.deadly:
            os._exit(9)
        if job.number in self.crashing:
            raise ZeroDivisionError("the cat divided itself")
        point = coordinates(self.space, job)
        score = Score(0, -float(np.sum((point - 0.3) ** 2)))
        measures = {"distance": float(point[0]), "words": "none"}
        runs = tuple(RunResult("plain", seed, "finished", 1.0, "", measures, {"distance": 1.0}) for seed in job.seeds)
        return Evaluation(
            job.number, job.generation, job.index, job.parameters, runs, score, None, 0.1, 1.0, job.confirms
        )

    def numbers(self) -> list[int]:
        """Return what was evaluated, in this order."""
        return [int(line) for line in self.notes.read_text().split()] if self.notes.exists() else []


class Inline(Executor):
    """Carries out jobs at once, in this thread; the last of those handed out together is over first."""

    def __init__(self, workers: int = 1) -> None:
        self._workers = workers

    @property
    def workers(self) -> int:
        return self._workers

    def prepare(self, function: Callable[[], None]) -> None:
        function()

    def close(self) -> None:
        """Nothing to let go."""

    def _slots(self) -> int:
        return self._workers

    def _submit(self, packed: Packed, job: Any) -> Future[Any]:
        future: Future[Any] = Future()
        try:
            future.set_result(call(packed, job))
        except ZeroDivisionError as error:
            future.set_exception(error)
        return future

    def _release(self, future: Future[Any]) -> bool:
        return False


def never() -> bool:
    return False


def searched(
    plan: Plan,
    stored: StoredStudy,
    task: Callable[[Job], Evaluation],
    executor: Executor | None = None,
    stop: Callable[[], bool] = never,
) -> str:
    """Search with a task, and return how it ended."""
    return Search(plan, stored, lambda standing: None).run(executor or Inline(), task, stop)


def contents(stored: StoredStudy) -> list[dict[str, Any]]:
    """Return the stored evaluations without the time that they took."""
    return [
        {key: value for key, value in one.to_dict().items() if key != "wall_seconds"} for one in stored.evaluations()
    ]


def begun(plan: Plan, folder: Path, name: str) -> StoredStudy:
    return Database(str(folder / f"{name}.db")).create("study", plan.header)


def reopened(folder: Path, name: str) -> StoredStudy:
    return Database(str(folder / f"{name}.db")).open("study")


class KilledError(BaseException):
    """Ends a search between two writes, as `kill -9` may."""


def goes_on_after_a_kill(
    plan: Plan, folder: Path, task: Paraboloid, until: int, expected: Sequence[Mapping[str, Any]]
) -> None:
    """Kill a search after so many writes, and see that the next one gives the rest of what is expected."""
    with pytest.MonkeyPatch.context() as monkeypatch:
        stored = begun(plan, folder, "killed")
        _let_write(monkeypatch, until)
        with pytest.raises(KilledError):
            searched(plan, stored, task)
    kept = contents(reopened(folder, "killed"))
    assert kept == expected[: len(kept)]
    again = Paraboloid(plan.space, folder / "again", crashing=(5,))
    assert searched(plan, reopened(folder, "killed"), again) == "complete"
    assert contents(reopened(folder, "killed")) == expected
    assert again.numbers() == list(range(len(kept), len(expected)))


def _let_write(monkeypatch: pytest.MonkeyPatch, until: int) -> None:
    """Let that many writes pass, where each evaluation is one; the next one, and all after it, do not take place."""
    left = until

    def guarded(self: StoredStudy, what: Any, *others: Any, original: Any, size: Callable[[Any], int]) -> None:
        nonlocal left
        left -= size(what)
        if left < 0:
            raise KilledError
        original(self, what, *others)

    for name, size in (("begin", lambda jobs: 1), ("finish", len), ("set_boundary", lambda boundary: 1)):
        original = getattr(StoredStudy, name)
        monkeypatch.setattr(StoredStudy, name, partialmethod(guarded, original=original, size=size))
