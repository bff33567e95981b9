"""Which points a sweep has, and which runs visit them."""

import itertools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import pow, prod
from typing import Self

from neuromech.spec.scalars import Written
from neuromech.spec.sweep import Sweep, Varied
from neuromech.units import measure, unit_factor, unit_text

Position = tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Axis:
    """The values of one parameter.

    Args:
        name: the parameter.
        texts: its values as an author writes them, in the order in which they are tried.
    """

    name: str
    texts: tuple[str, ...]

    @classmethod
    def of(cls, name: str, varied: Varied) -> Self:
        """Return the axis of a parameter whose values were checked."""
        if varied.range is None:
            return cls(name, tuple(str(value) for value in varied.values))
        return cls(name, tuple(_spaced(varied.range, varied.count or 0, varied.scale or "linear")))

    @property
    def values(self) -> tuple[float, ...]:
        """The values as numbers in `unit`."""
        return tuple(_in_unit(text, self.unit) for text in self.texts)

    @property
    def unit(self) -> str:
        """Unit that the first value is written in, empty for a number."""
        return unit_text(self.texts[0])


@dataclass(frozen=True, slots=True)
class Block:
    """Parameters whose values are all combined with each other.

    Args:
        name: the varied parameters; empty for a grid, which is the only block.
        axes: of `for_each` first, then of what is varied.
        outer: how many axes are of `for_each`.
    """

    name: str
    axes: tuple[Axis, ...]
    outer: int

    @property
    def shape(self) -> Position:
        """How many values each axis has."""
        return tuple(len(axis.texts) for axis in self.axes)

    def parameters(self, position: Position) -> dict[str, str]:
        """Return name → value as written at a position."""
        return {axis.name: axis.texts[index] for axis, index in zip(self.axes, position, strict=True)}

    def paths(self) -> Iterator[list[Position]]:
        """Yield for each combination of `for_each` the positions there and back: neighbours are one step apart."""
        counts = self.shape
        for head in itertools.product(*map(range, counts[: self.outer])):
            yield [(*head, *tail) for tail in _there_and_back(counts[self.outer :])]


@dataclass(frozen=True, slots=True)
class Point:
    """A place of a sweep: the block, the position in it, and the repetition, from 0."""

    block: int
    position: Position
    repetition: int


@dataclass(frozen=True, slots=True)
class SweepJob:
    """Points that one run visits, one after the other; a single one unless the sweep goes on within a run."""

    number: int
    points: tuple[Point, ...]


@dataclass(frozen=True, slots=True)
class Design:
    """All points of a sweep."""

    blocks: tuple[Block, ...]
    repetitions: int
    within_one_run: bool

    @classmethod
    def of(cls, sweep: Sweep) -> Self:
        """Return the design of a sweep that was checked."""
        outer = tuple(Axis.of(name, varied) for name, varied in sweep.for_each.items())
        axes = [Axis.of(name, varied) for name, varied in sweep.vary.items()]
        size = {"grid": len(axes), "one_at_a_time": 1, "pairs": 2}[sweep.design]
        blocks = tuple(
            Block("" if sweep.design == "grid" else _block_name(chosen), (*outer, *chosen), len(outer))
            for chosen in itertools.combinations(axes, size)
        )
        return cls(blocks, sweep.seeds, sweep.within_one_run is not None)

    def size(self) -> int:
        """Return how many points there are, repetitions included."""
        return self.repetitions * sum(prod(block.shape) for block in self.blocks)

    def jobs(self) -> list[SweepJob]:
        """Return the runs, in the order in which they begin."""
        paths = [
            [Point(number, position, repetition) for position in path]
            for repetition in range(self.repetitions)
            for number, block in enumerate(self.blocks)
            for path in block.paths()
        ]
        if not self.within_one_run:
            paths = [[point] for path in paths for point in sorted(path, key=lambda one: one.position)]
        return [SweepJob(number, tuple(path)) for number, path in enumerate(paths)]


def _block_name(axes: Sequence[Axis]) -> str:
    return " and ".join(axis.name for axis in axes)


def _in_unit(text: str, unit: str) -> float:
    """Return the number of a quantity in a unit: the written one where that is its own unit."""
    if unit_text(text) == unit:
        return float(text.removesuffix(unit))
    return measure(text)[0] / unit_factor(unit)[0]


def _there_and_back(counts: Position) -> list[Position]:
    """Return all positions of a grid, each next to the one before it."""
    found: list[Position] = [()]
    for count in counts:
        there = range(count)
        found = [
            (*head, last) for turn, head in enumerate(found) for last in (there if turn % 2 == 0 else reversed(there))
        ]
    return found


def _spaced(ends: tuple[Written, Written], count: int, scale: str) -> Iterator[str]:
    """Yield values from one end to the other in the unit of the first; those between are rounded to 12 digits."""
    unit = unit_text(ends[0])
    first, last = measure(ends[0])[0], measure(ends[1])[0]
    yield str(ends[0])
    for step in range(1, count - 1):
        share = step / (count - 1)
        value = first * pow(last / first, share) if scale == "log" else first + (last - first) * share
        yield f"{float(f'{value / unit_factor(unit)[0]:.12g}')!r} {unit}".strip()
    yield str(ends[1])
