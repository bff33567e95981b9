"""When feet carry load: touchdowns, liftoffs and strides."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from neuromech.analyse.cycles import FEWEST_CYCLES, Cycles
from neuromech.analyse.windows import Array, NotMeasurableError, View

LEAST_LOAD = 0.02
"""Vertical force from which a foot counts as loaded, in body weights, where a measure gives no `level`."""

RELEASE = 0.5
"""A loaded foot counts as unloaded when its force falls below this part of the force that makes it loaded."""

LEAST_CONTACT = 0.02
"""Least duration (s) of a contact, and of a gap between two, where a measure gives no `least_duration`."""


@dataclass(frozen=True, slots=True)
class Footfalls:
    """The contacts of one foot in a window of a run.

    Args:
        name: the foot, as the measure names it.
        start: start of the window (s).
        end: end of the window (s).
        contacts: start and end (s) of each contact, shape (n, 2); those that the window cuts are clipped.
    """

    name: str
    start: float
    end: float
    contacts: Array

    @property
    def touchdowns(self) -> Array:
        """Times (s) of the touchdowns that lie in the window."""
        starts = self.contacts[:, 0]
        return np.asarray(starts[starts > self.start])

    def strides(self) -> "Strides":
        """Return the strides, each from touchdown to touchdown.

        Raises:
            NotMeasurableError: there are fewer than three, or the last touchdown lies more than two periods before the
                end of the window.
        """
        seen = self.contacts[self.contacts[:, 0] > self.start]
        if len(seen) <= FEWEST_CYCLES:
            raise NotMeasurableError(f"{self.name} makes fewer than {FEWEST_CYCLES} strides")
        strides = Strides(Cycles(seen[:, 0]), seen[:-1, 1])
        if self.end - seen[-1, 0] > 2.0 * strides.cycles.period:
            raise NotMeasurableError(f"{self.name} stops stepping")
        return strides

    def loaded(self, time: Array) -> NDArray[np.bool_]:
        """Return at which of some times the foot is loaded, shape as `time`."""
        index = np.searchsorted(self.contacts[:, 0], time, side="right") - 1
        ends = np.concatenate((self.contacts[:, 1], [-np.inf]))
        return np.asarray(time < ends[index])


@dataclass(frozen=True, slots=True)
class Strides:
    """Consecutive strides of one foot.

    Args:
        cycles: from touchdown to touchdown, n of them.
        liftoffs: liftoff times, shape (n,) (s).
    """

    cycles: Cycles
    liftoffs: Array

    @property
    def stances(self) -> Array:
        """Stance durations, shape (n,) (s)."""
        return self.liftoffs - self.cycles.onsets[:-1]

    @property
    def swings(self) -> Array:
        """Swing durations, shape (n,) (s)."""
        return self.cycles.onsets[1:] - self.liftoffs

    @property
    def duty_factors(self) -> Array:
        """Stance over stride duration, shape (n,)."""
        return self.stances / self.cycles.durations


def footfalls(view: View) -> list[Footfalls]:
    """Return the footfalls of each of a measure's `feet`, in the order given.

    The load of a foot is the sum of the vertical forces of its contacts. A contact starts where the load rises through
    `level` (0.02 body weights where none is given) and ends where it falls through half of that, both interpolated
    linearly; then gaps shorter than `least_duration` (20 ms where none is given) are closed, and contacts shorter than
    it are left out.

    Raises:
        MeasureError: the measure has no `feet`, or neither the measure nor the recording says how much load counts.
        NotMeasurableError: as for `View.window`.
    """
    level = _level(view)
    least = LEAST_CONTACT if view.spec.least_duration is None else float(view.spec.least_duration)
    return [_footfalls(name, *view.load(name), level, least) for name in view.feet()]


def _footfalls(name: str, time: Array, load: Array, level: float, least: float) -> Footfalls:
    contacts = _without_short(_crossings(time, load, level), least, float(time[0]), float(time[-1]))
    return Footfalls(name, float(time[0]), float(time[-1]), contacts)


def _level(view: View) -> float:
    if view.spec.level is None:
        return LEAST_LOAD * view.weight()
    return view.argument("level", "N")


def _crossings(time: Array, load: Array, level: float) -> Array:
    """Return start and end of each stretch in which a signal is loaded, shape (n, 2)."""
    known = np.flatnonzero((load > level) | (load < RELEASE * level))
    marks = np.zeros(len(load), dtype=np.int64)
    marks[known] = known
    last = np.maximum.accumulate(marks)
    loaded = load[last] > level
    edges = np.flatnonzero(loaded[1:] != loaded[:-1])
    rises, falls = edges[~loaded[edges]], edges[loaded[edges]]
    starts, ends = _crossed(time, load, rises, level), _crossed(time, load, falls, RELEASE * level)
    starts = np.concatenate((time[:1], starts)) if loaded[0] else starts
    ends = np.concatenate((ends, time[-1:])) if loaded[-1] else ends
    return np.column_stack((starts, ends))


def _crossed(time: Array, values: Array, before: NDArray[np.int64], level: float) -> Array:
    """Return when a signal crosses a level between samples `before` and `before + 1`, shape as `before` (s)."""
    low, high = values[before], values[before + 1]
    return np.asarray(time[before] + (level - low) / (high - low) * (time[before + 1] - time[before]))


def _without_short(contacts: Array, least: float, start: float, end: float) -> Array:
    """Close gaps shorter than `least`, then leave out contacts shorter than it that the window does not cut."""
    if len(contacts) == 0:
        return contacts
    apart = contacts[1:, 0] - contacts[:-1, 1] >= least
    starts = contacts[np.concatenate(([True], apart)), 0]
    ends = contacts[np.concatenate((apart, [True])), 1]
    kept = (ends - starts >= least) | (starts <= start) | (ends >= end)
    return np.column_stack((starts[kept], ends[kept]))
