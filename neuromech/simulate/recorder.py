"""Where a run writes its samples, and how they become a recording."""

import platform

import numpy as np

from neuromech.bodies.versions import package_version
from neuromech.compiler.lower import recorded
from neuromech.compiler.numerics import Floats, Integers
from neuromech.compiler.program import Program
from neuromech.graph.signals import signals, split
from neuromech.simulate.anatomy import Anatomy
from neuromech.simulate.recording import GroupData, Outcome, Provenance, Recording
from neuromech.simulate.sample_memory import borrowed
from neuromech.units import si_unit

_PACKAGES = ("numpy", "scipy", "numba", "pybullet")


class Recorder:
    """One preallocated buffer for all samples of a run, group after group, row after row."""

    def __init__(self, program: Program, offsets: Integers, ticks: int) -> None:
        """Reserve room for `ticks` ticks and note in the integer buffer where each group starts."""
        self._program = program
        self._ticks = ticks
        groups = program.graph.document.experiment.record
        self._names = {name: recorded(group.signals, program.graph) for name, group in groups.items()}
        self._every = {name: round(float(group.every) / program.tick) for name, group in groups.items()}
        start = 0
        self._start: dict[str, int] = {}
        for k, name in enumerate(groups):
            self._start[name] = start
            offsets[program.header["group_row"] + k] = start
            start += self._rows(name, ticks) * len(self._names[name])
        self.samples: Floats = borrowed(start)

    def _rows(self, name: str, ticks: int) -> int:
        return -(-ticks // self._every[name])

    def recording(self, ticks: int, outcome: Outcome, seed: int, engine: str, wall_seconds: float) -> Recording:
        """Return what was sampled during the first `ticks` ticks."""
        units = signals(self._program.graph)
        groups = {name: self._group(name, ticks, units) for name in self._names}
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
        return Recording.from_groups(groups, provenance)

    def _group(self, name: str, ticks: int, units: dict[str, str]) -> GroupData:
        names, rows = self._names[name], self._rows(name, ticks)
        start = self._start[name]
        values = self.samples[start : start + rows * len(names)].reshape(rows, len(names))
        time = np.arange(rows, dtype=np.float64) * (self._every[name] * self._program.tick)
        return GroupData(time, tuple(names), values, tuple(si_unit(units[_listed(signal)]) for signal in names))


def _listed(name: str) -> str:
    """Return the name that a signal has in the list of all, which has populations as wholes."""
    element, _, quantity = split(name)
    return f"{element}.{quantity}"
