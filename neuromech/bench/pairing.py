"""Two sides measured in turn, A B A B …: medians, ranges, and the ratio of each pair."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from statistics import median
from typing import Any

Measure = Callable[[], float]


@dataclass(frozen=True, slots=True)
class Comparison:
    """What is measured against what.

    Args:
        ours: measures our side once, in `unit`.
        peer: measures the other side once; None where there is none.
        unit: of both.
        against: what the other side is, with version and scheme.
        notes: facts that belong to the numbers, such as both periods.
        largest_repetitions: more are not made, for what takes long.
    """

    ours: Measure
    peer: Measure | None
    unit: str
    against: str
    notes: Mapping[str, Any] = field(default_factory=dict)
    largest_repetitions: int = 1000


@dataclass(frozen=True, slots=True)
class Result:
    """What came out, or why nothing did.

    Args:
        name: of the benchmark.
        unit: of all measurements.
        against: what the other side is.
        ours: measurements of our side, in order.
        peer: measurements of the other side, in order; empty where there is none.
        notes: facts that belong to the numbers.
        problem: why there are no measurements; None where there are.
    """

    name: str
    unit: str
    against: str
    ours: tuple[float, ...]
    peer: tuple[float, ...]
    notes: Mapping[str, Any]
    problem: str | None = None

    @property
    def ratios(self) -> tuple[float, ...]:
        """Ours ÷ peer of each pair."""
        return tuple(ours / peer for ours, peer in zip(self.ours, self.peer, strict=False))

    def as_dict(self) -> dict[str, Any]:
        """Return plain values for JSON: medians, with the ranges and all measurements beside them."""
        return {
            "name": self.name,
            "ours": _median(self.ours),
            "peer": _median(self.peer),
            "ratio": _median(self.ratios),
            "unit": self.unit,
            "against": self.against,
            "ours_range": _range(self.ours),
            "peer_range": _range(self.peer),
            "ratio_range": _range(self.ratios),
            "repetitions": len(self.ours),
            "notes": dict(self.notes),
            "problem": self.problem,
        }


def measure(name: str, comparison: Comparison, repetitions: int) -> Result:
    """Measure both sides in turn, after one unmeasured pair that warms up caches and compilers."""
    sides = [side for side in (comparison.ours, comparison.peer) if side is not None]
    for side in sides:
        side()
    count = min(repetitions, comparison.largest_repetitions)
    pairs = [[side() for side in sides] for _ in range(count)]
    ours, *peer = zip(*pairs, strict=True)
    return Result(name, comparison.unit, comparison.against, ours, peer[0] if peer else (), comparison.notes)


def failed(name: str, problem: str) -> Result:
    """Return the result of a benchmark that cannot be made, with the reason."""
    return Result(name, "", "", (), (), {}, problem)


def _median(values: tuple[float, ...]) -> float | None:
    return median(values) if values else None


def _range(values: tuple[float, ...]) -> list[float] | None:
    return [min(values), max(values)] if values else None
