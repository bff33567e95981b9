"""Where a run writes its samples, and how they become a recording."""

import platform

import numpy as np

from neuromech.bodies.versions import package_version
from neuromech.compiler.numerics import Floats, Integers
from neuromech.compiler.program import Program
from neuromech.compiler.records import RecordGroup
from neuromech.simulate.anatomy import Anatomy
from neuromech.simulate.recording import GroupData, Outcome, Provenance, Recording
from neuromech.simulate.sample_memory import borrowed

_PACKAGES = ("numpy", "scipy", "numba", "pybullet")


class Recorder:
    """One preallocated buffer for all samples of a run, group after group, row after row."""

    def __init__(self, program: Program, offsets: Integers, ticks: int) -> None:
        """Reserve room for `ticks` ticks and note in the integer buffer where each group starts."""
        self._program = program
        start = 0
        self._start: dict[str, int] = {}
        for k, group in enumerate(program.records):
            self._start[group.name] = start
            offsets[program.header["group_row"] + k] = start
            start += _rows(group, ticks) * len(group.signals)
        self.samples: Floats = borrowed(start)

    def recording(self, ticks: int, outcome: Outcome, seed: int, engine: str, wall_seconds: float) -> Recording:
        """Return what was sampled during the first `ticks` ticks."""
        document = self._program.graph.document
        provenance = Provenance(
            name=document.experiment.name,
            specification=document.text,
            version=package_version("neuromech"),
            versions={package: package_version(package) for package in _PACKAGES},
            engine=engine,
            platform=f"{platform.platform()}, Python {platform.python_version()}",
            seed=seed,
            parameters={name: parameter.value for name, parameter in document.experiment.parameters.items()},
            outcome=outcome,
            simulated_seconds=ticks * self._program.tick,
            wall_seconds=wall_seconds,
            anatomy=Anatomy.of(self._program.graph),
        )
        groups = {group.name: self._group(group, ticks) for group in self._program.records}
        return Recording.from_groups(groups, provenance)

    def _group(self, group: RecordGroup, ticks: int) -> GroupData:
        rows, start = _rows(group, ticks), self._start[group.name]
        values = self.samples[start : start + rows * len(group.signals)].reshape(rows, len(group.signals))
        time = np.arange(rows, dtype=np.float64) * (group.every * self._program.tick)
        return GroupData(time, group.signals, values, group.units)


def _rows(group: RecordGroup, ticks: int) -> int:
    return -(-ticks // group.every)
