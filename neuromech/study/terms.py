"""Points for what was measured: the shapes of the terms of an objective."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal, Self

from neuromech.analyse.measures import MeasuredValue
from neuromech.spec.study import Term
from neuromech.units import measure

NO_LIMIT = math.inf

MOST_POINTS = 1e100
"""No term counts more than this, for or against, so that sums stay finite."""


@dataclass(frozen=True, slots=True)
class Points:
    """How a term turns a value in SI units into points, before its weight.

    A deviation is how far the value lies outside of `low`…`high`; zero for a direction, which counts the value itself.

    Args:
        shape: `saturating`: -d / (s + d) of a deviation d and the scale s. `linear`: -d / s of a deviation, ± x / s of
            a value x that is to be large or small. `logistic`: 1 / (1 + exp(∓ (x - c) / s)) with the center c.
        direction: 1 where the value is to be large, -1 where it is to be small, 0 where it has bounds.
        scale: SI units, greater than zero.
        low: lower bound; for a direction the least value that counts.
        high: upper bound; for a direction the largest value that counts.
        center: of the logistic shape.
        worst: fewest points, and those of a value that could not be taken.
    """

    shape: Literal["saturating", "linear", "logistic"]
    direction: int
    scale: float
    low: float
    high: float
    center: float
    worst: float

    @classmethod
    def of(cls, term: Term) -> Self:
        """Return the points of a term that judges a number."""
        numbers = {key: _si(getattr(term, key)) for key in ("scale", "target", "within", "center", "up_to")}
        within = numbers["within"] or 0.0
        low, high = _si(term.at_least), _si(term.at_most)
        if numbers["target"] is not None:
            low, high = numbers["target"] - within, numbers["target"] + within
        if term.goal == "maximize":
            high = numbers["up_to"]
        return cls(
            shape=term.curve,
            direction={"maximize": 1, "minimize": -1, None: 0}[term.goal],
            scale=numbers["scale"] or 1.0,
            low=-NO_LIMIT if low is None else low,
            high=NO_LIMIT if high is None else high,
            center=numbers["center"] or 0.0,
            worst=float(term.worst) if term.worst is not None else {"logistic": 0.0}.get(term.curve, -1.0),
        )

    def of_value(self, value: float) -> float:
        """Return the points of a value that could be taken."""
        if self.shape == "logistic":
            return _logistic(self.direction * (value - self.center) / self.scale)
        if self.direction:
            return max(self.worst, self.direction * min(value, self.high) / self.scale)
        deviation = max(self.low - value, value - self.high, 0.0)
        if self.shape == "saturating":
            return -1.0 / (1.0 + self.scale / deviation) if deviation > 0.0 else 0.0
        return max(self.worst, -deviation / self.scale)


@dataclass(frozen=True, slots=True)
class JudgedTerm:
    """A term with the measures that make up its value, and what they are worth."""

    term: Term
    points: Points | None

    @classmethod
    def of(cls, term: Term) -> Self:
        """Return a term, ready to judge."""
        return cls(term, None if term.equals is not None else Points.of(term))

    def value(self, measured: Mapping[str, MeasuredValue]) -> float | str:
        """Return `measure` times `times` by `per`, or the words of the first of them that could not be taken."""
        for one in measured.values():
            if isinstance(one.value, str):
                return one.value
        first, times, per = (measured[key].value if key in measured else 1.0 for key in ("measure", "times", "per"))
        product = float(first) * float(times)
        if float(per) == 0.0:
            return "divided by zero"
        return product / float(per) if math.isfinite(product / float(per)) else "not a finite number"

    def weighted(self, value: float | str) -> float:
        """Return the points of a value, times the weight; finite whatever the value."""
        if self.points is None:
            return 0.0 if value == self.term.equals else -float(self.term.weight)
        points = self.points.worst if isinstance(value, str) else self.points.of_value(value)
        return max(-MOST_POINTS, min(MOST_POINTS, float(self.term.weight) * points))


def _si(written: str | int | float | None) -> float | None:
    return None if written is None else measure(written)[0]


def _logistic(x: float) -> float:
    """Return 1 / (1 + exp(-x)) without overflow."""
    if x >= 0.0:
        return 1.0 / (1.0 + math.exp(-x))
    return math.exp(x) / (1.0 + math.exp(x))
