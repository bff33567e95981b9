"""Cycles of an oscillating signal, and bursts of an active one."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from neuromech.analyse.windows import Array, NotMeasurableError

FEWEST_CYCLES = 3
HYSTERESIS = 0.25
"""A signal must fall this part of its range below half amplitude before another rise counts."""

NO_RHYTHM = "no rhythm"


@dataclass(frozen=True, slots=True)
class Cycles:
    """Consecutive cycles from onset to onset.

    Args:
        onsets: onset times, shape (n + 1,) (s).
    """

    onsets: Array

    @property
    def durations(self) -> Array:
        """Durations, shape (n,) (s)."""
        return np.diff(self.onsets)

    @property
    def period(self) -> float:
        """Median duration (s)."""
        return float(np.median(self.durations))

    def phases(self, times: Array) -> tuple[NDArray[np.int64], Array]:
        """Return the cycle index, shape (m,), and the phase in 0…1, shape (m,), of those times that lie in a cycle."""
        index = np.searchsorted(self.onsets, times, side="right").astype(np.int64) - 1
        inside = (index >= 0) & (index < len(self.onsets) - 1)
        index = index[inside]
        return index, (times[inside] - self.onsets[index]) / self.durations[index]

    def slices(self, time: Array) -> list[slice]:
        """Return for each cycle the slice of a time axis that lies in it, without cycles that hold no sample."""
        edges = np.searchsorted(time, self.onsets)
        return [slice(start, end) for start, end in pairwise(edges) if end > start]

    def normalised(self, time: Array, values: Array, points: int = 101) -> Array:
        """Return a signal over each cycle at equal parts of it, 0 and 100 % included, shape (n, points).

        Linear interpolation between samples.
        """
        parts = np.linspace(0.0, 1.0, points)
        return np.interp(self.onsets[:-1, None] + self.durations[:, None] * parts, time, values)


def onsets(time: Array, values: Array) -> Array:
    """Return the times (s) at which a signal rises through half amplitude.

    Half amplitude is (max + min) / 2. A rise counts when the signal was lower than a quarter of its range below that
    since the rise before, which keeps noise from counting twice. Linear interpolation between samples.
    """
    low, high = float(values.min()), float(values.max())
    half = (low + high) / 2.0
    rises = np.flatnonzero((values[:-1] < half) & (values[1:] >= half))
    troughs = np.flatnonzero(values < half - HYSTERESIS * (high - low))
    rises = rises[np.diff(np.searchsorted(troughs, rises, side="right"), prepend=0) > 0]
    part = (half - values[rises]) / (values[rises + 1] - values[rises])
    return np.asarray(time[rises] + part * (time[rises + 1] - time[rises]))


def cycles(time: Array, values: Array, least_amplitude: float) -> Cycles:
    """Return the cycles of a rhythmic signal.

    A signal is rhythmic when it spans at least `least_amplitude` from minimum to maximum, has at least three cycles,
    and its last onset lies no more than two periods before its end.

    Raises:
        NotMeasurableError: the signal is not rhythmic.
    """
    if np.ptp(values) < least_amplitude:
        raise NotMeasurableError(NO_RHYTHM)
    found = Cycles(onsets(time, values))
    if len(found.durations) < FEWEST_CYCLES or time[-1] - found.onsets[-1] > 2.0 * found.period:
        raise NotMeasurableError(NO_RHYTHM)
    return found


@dataclass(frozen=True, slots=True)
class Burst:
    """A stretch of activity above a level: onset and end (s), largest value, and the centre of its area (s)."""

    onset: float
    end: float
    peak: float
    center: float

    @property
    def duration(self) -> float:
        """Duration (s)."""
        return self.end - self.onset


def bursts(time: Array, values: Array, level: float) -> list[Burst]:
    """Return the stretches in which a signal is above a level, from first sample above to first sample not above.

    A stretch that the record cuts at its start or end is part of the result, as far as it was recorded.
    """
    above = np.concatenate(([False], values > level, [False]))
    edges = np.flatnonzero(above[1:] != above[:-1]).reshape(-1, 2)
    return [_burst(time, values, level, int(start), int(end)) for start, end in edges]


def _burst(time: Array, values: Array, level: float, start: int, end: int) -> Burst:
    weights = values[start:end] - level
    center = float(np.sum(weights * time[start:end]) / np.sum(weights))
    last = min(end, len(time) - 1)
    return Burst(float(time[start]), float(time[last]), float(values[start:end].max()), center)
