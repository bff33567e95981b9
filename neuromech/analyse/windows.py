"""The part of a recording that a measure looks at, and the words for what cannot be measured there."""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from pydantic_core import PydanticCustomError

from neuromech.errors import MeasureError
from neuromech.simulate.recording import Recording
from neuromech.spec.measure import MUSCLE_SIGNALS, Measure, ReferenceCurve
from neuromech.units import Unit, unit_factor

Array = NDArray[np.float64]


class NotMeasurableError(Exception):
    """A run does not show what a measure is about; the text says what is missing (`no rhythm`)."""


@dataclass(frozen=True, slots=True)
class Window:
    """One signal between two times: times (s) and finite values, shape (n,) each, n at least 2."""

    name: str
    time: Array
    values: Array
    unit: str

    def integral(self, time: Array) -> Array:
        """Return ∫ x dt from the start of the window to other times in it, by the trapezoidal rule."""
        step = np.diff(self.time)
        total = np.concatenate(([0.0], np.cumsum(0.5 * (self.values[1:] + self.values[:-1]) * step)))
        index = np.clip(np.searchsorted(self.time, time, side="right") - 1, 0, len(step) - 1)
        rest = time - self.time[index]
        slope = (self.values[index + 1] - self.values[index]) / step[index]
        return np.asarray(total[index] + rest * (self.values[index] + 0.5 * slope * rest))

    def at(self, time: Array) -> Array:
        """Return the values at other times, linearly interpolated."""
        return self.values if time is self.time else np.interp(time, self.time, self.values)

    def mean(self) -> float:
        """Return the time average, by the trapezoidal rule."""
        return float(np.trapezoid(self.values, self.time) / (self.time[-1] - self.time[0]))


@dataclass(frozen=True, slots=True)
class View:
    """A recording as one measure sees it. Every method raises what it says in addition to these.

    Raises:
        MeasureError: the measure lacks an argument, or an argument does not fit the signal.
        RecordingError: a signal was not recorded.
    """

    recording: Recording
    spec: Measure

    def signal(self) -> Window:
        """Return the measure's `signal`.

        Raises:
            NotMeasurableError: as for `window`.
        """
        return self.window(self._need("signal"))

    def reference(self) -> Window:
        """Return the measure's `reference`.

        Raises:
            NotMeasurableError: as for `window`.
        """
        return self.window(self._need("reference"))

    def signals(self) -> list[Window]:
        """Return the measure's `signals`, in the order given.

        Raises:
            NotMeasurableError: as for `window`.
        """
        return [self.window(name) for name in self.signal_names()]

    def signal_names(self) -> list[str]:
        """Return the names of the measure's `signals`, where patterns are replaced by what they match."""
        if self.spec.signals is None:
            raise MeasureError(f"measure '{self.spec.kind}' needs 'signals'")
        return [name for pattern in self.spec.signals for name in self._expand(pattern)]

    def window(self, name: str) -> Window:
        """Return a signal between `after` and `until`.

        Raises:
            NotMeasurableError: fewer than two samples are left, or a value is not finite.
        """
        time, values = self.recording.signal(name)
        start = int(np.searchsorted(time, float(self.spec.after)))
        end = len(time) if self.spec.until is None else int(np.searchsorted(time, float(self.spec.until), side="right"))
        chosen = slice(start, end)
        if end - start < 2:
            raise NotMeasurableError(f"the run ended at {self.recording.outcome.time:g} s, before there was a signal")
        if not np.all(np.isfinite(values[chosen])):
            raise NotMeasurableError(f"{name} is not finite")
        return Window(name, time[chosen], values[chosen], self.recording.unit(name))

    def feet(self) -> tuple[str, ...]:
        """Return the measure's `feet`."""
        if self.spec.feet is None:
            raise MeasureError(f"measure '{self.spec.kind}' needs 'feet'")
        return self.spec.feet

    def load(self, foot: str) -> tuple[Array, Array]:
        """Return times (s) and vertical force (N) of a foot, summed over its contacts, shape (n,) each.

        Raises:
            NotMeasurableError: as for `window`.
        """
        names = self._expand(f"{foot}.force_z")
        limbs = dict.fromkeys(name.rpartition(".")[0].rpartition(".")[0] for name in names)
        if len(limbs) > 1:
            raise MeasureError(f"'{foot}' must be the contacts of one foot (got those of {', '.join(limbs)})")
        return _added([self.window(name) for name in names])

    def place(self, foot: str) -> tuple[Array, Array]:
        """Return times (s) and position (m) of a foot along `axis`, the mean of its contacts, shape (n,) each.

        Raises:
            NotMeasurableError: as for `window`.
        """
        names = self._expand(f"{foot}.{self.spec.axis}")
        time, total = _added([self.window(name) for name in names])
        return time, total / len(names)

    def muscles(self) -> list[str]:
        """Return the names of the measure's `muscles`, in recorded order."""
        if self.spec.muscles is None:
            raise MeasureError(f"measure '{self.spec.kind}' needs 'muscles'")
        found = [name for muscle in self.spec.muscles for name in self._expand(f"{muscle}.{MUSCLE_SIGNALS[0]}")]
        return [name.rpartition(".")[0] for name in dict.fromkeys(found)]

    def curve(self) -> ReferenceCurve:
        """Return the measure's `curve`."""
        if self.spec.curve is None:
            raise MeasureError(f"measure '{self.spec.kind}' needs 'curve'")
        return self.spec.curve

    def coordinate(self, quantity: str) -> str:
        """Return the name of a signal of the measure's `segment`."""
        return f"{self._need('segment')}.{quantity}"

    def weight(self) -> float:
        """Return the weight of the body (N)."""
        weight = self.recording.provenance.anatomy.weight
        if weight == 0.0:
            raise MeasureError(f"measure '{self.spec.kind}' needs a body with weight")
        return weight

    def gravity(self) -> float:
        """Return the gravitational acceleration (m/s²)."""
        gravity = self.recording.provenance.anatomy.gravity
        if gravity == 0.0:
            raise MeasureError(f"measure '{self.spec.kind}' needs gravity")
        return gravity

    def argument(self, name: Literal["level", "least_amplitude", "tolerance"], unit: str) -> float:
        """Return an argument of the measure as a number of `unit`."""
        return in_unit(self._need(name), unit, name.replace("_", " "))

    def number(self, name: Literal["leg_length", "perturbed_at", "average_over", "least_speed"]) -> float:
        """Return an argument of the measure that has a unit of its own, in SI units."""
        return float(self._need(name))

    def _need(self, name: str) -> str:
        value = getattr(self.spec, name)
        if value is None:
            raise MeasureError(f"measure '{self.spec.kind}' needs '{name}'")
        return str(value)

    def _expand(self, pattern: str) -> list[str]:
        if not any(sign in pattern for sign in "*?["):
            return [pattern]
        found = self.recording.match(pattern)
        if not found:
            raise MeasureError(f"no recorded signal matches '{pattern}'")
        return found


def _added(windows: list[Window]) -> tuple[Array, Array]:
    first, *others = windows
    return first.time, sum((other.at(first.time) for other in others), first.values)


def in_unit(value: str | int | float, unit: str, what: str) -> float:
    """Return a written quantity as a number of `unit`.

    Raises:
        MeasureError: it is no quantity, or of another dimension; `what` names it in the message.
    """
    try:
        return float(Unit(what, unit).parse(value)) / unit_factor(unit)[0]
    except PydanticCustomError as error:
        raise MeasureError(f"{error.message()} (got {value})") from error
