"""Small documents with sweeps, and their results without processes."""

from collections.abc import Callable
from math import exp
from pathlib import Path

from searches import Inline

from neuromech.study.sweeps.carry_out import SweepStanding, carry_out
from neuromech.study.sweeps.journal import Journal, SweepHeader
from neuromech.study.sweeps.results import PointResult
from neuromech.study.sweeps.task import SweepTask

CELLS = """
neuromech: 1
name: two cells
parameters:
  first_bias: {value: 0.5, minimum: 0, maximum: 1}
  second_bias: {value: 0.5, minimum: 0, maximum: 1}
  time_constant: {value: 5 ms, minimum: 0.01 ms, maximum: 0.1 s}
  delay: {value: 2 ms, minimum: 0 ms, maximum: 10 ms}
network:
  neurons:
    first: {kind: rate_neuron, time_constant: "${time_constant}", bias: "${first_bias}"}
    second: {kind: rate_neuron, time_constant: 5 ms, bias: "${second_bias}"}
    third: {kind: rate_neuron, time_constant: 5 ms}
  synapses:
    excitatory:
      second: {third: {weight: 1, delay: "${delay}"}}
protocol: {duration: 300 ms, initial: {first.rate: {uniform: [0, 1]}}}
record:
  all: {signals: ["*.activity"], every: 1 ms}
sweeps:
  sweep:
"""

MEASURES = """
    measures:
      first: {kind: final, signal: first.activity}
      second: {kind: final, signal: second.activity}
      rhythm: {kind: rhythm, signal: first.activity}
      period: {kind: period, signal: first.activity}
"""


def task_in(folder: Path, sweep: str, measures: str = MEASURES) -> SweepTask:
    """Write a document with a sweep into a folder and return the task."""
    file = folder / "cells.yaml"
    file.write_text(CELLS + "\n".join(f"    {line}" for line in sweep.strip().splitlines()) + measures, "utf-8")
    return SweepTask(file, "sweep")


def results_of(
    task: SweepTask,
    folder: Path,
    stop: Callable[[], bool] = lambda: False,
    report: Callable[[SweepStanding], None] = lambda standing: None,
    workers: int = 1,
) -> list[PointResult]:
    """Carry out a sweep in this process, or what is left of it."""
    with (
        Journal(folder / "unfinished.jsonl", SweepHeader.of(task.document, task.name)) as journal,
        Inline(workers) as executor,
    ):
        return carry_out(task, journal, executor, stop, report)


def settled(bias: float) -> float:
    """Return the activity that a cell comes to with a bias."""
    return 1.0 / (1.0 + exp(-(bias - 0.5) / 0.1))
