"""Measures of the values of signals: averages, extremes, levels, differences."""

import numpy as np

from neuromech.analyse.oscillation import cycles_of
from neuromech.analyse.windows import Array, NotMeasurableError, View, Window
from neuromech.errors import MeasureError


def outcome(view: View) -> str:
    """Return how the run ended: `finished`, `fell`, `diverged` or `stopped`."""
    return view.recording.outcome.kind


def mean(view: View) -> float:
    """Return the time average of `signal`, ∫ x dt / T by the trapezoidal rule; unit of the signal."""
    return view.signal().mean()


def minimum(view: View) -> float:
    """Return the smallest sample of `signal`; unit of the signal."""
    return float(view.signal().values.min())


def maximum(view: View) -> float:
    """Return the largest sample of `signal`; unit of the signal."""
    return float(view.signal().values.max())


def span(view: View) -> float:
    """Return the largest minus the smallest sample of `signal`; unit of the signal."""
    return float(np.ptp(view.signal().values))


def rms(view: View) -> float:
    """Return √(mean x²) of the samples of `signal`; unit of the signal."""
    return root_mean_square(view.signal().values)


def standard_deviation(view: View) -> float:
    """Return √(mean (x − mean x)²) of the samples of `signal`; unit of the signal."""
    return float(np.std(view.signal().values))


def final(view: View) -> float:
    """Return the last sample of `signal`; unit of the signal."""
    return float(view.signal().values[-1])


def silence(view: View) -> float:
    """Return the largest sample of any of the `signals`; their common unit."""
    return max(float(seen.values.max()) for seen in view.signals())


def held(view: View) -> str:
    """Return `held` where `signal` is above `level` all the time from `after` on, else `released`."""
    seen = view.signal()
    return "held" if np.all(seen.values > view.argument("level", seen.unit)) else "released"


def fraction_active(view: View) -> float:
    """Return the part of its own cycle in 0…1 for which `signal` is above `reference`, or above `level`.

    Whole cycles of `signal` only; crossings are interpolated linearly.
    """
    seen = view.signal()
    found = cycles_of(view, seen)
    if view.spec.reference is None:
        difference = seen.values - view.argument("level", seen.unit)
    else:
        difference = seen.values - _matching(seen, view.reference()).at(seen.time)
    time, values = _clip(seen.time, difference, float(found.onsets[0]), float(found.onsets[-1]))
    return _time_above_zero(time, values) / float(time[-1] - time[0])


def rms_difference(view: View) -> float:
    """Return √(mean (x − y)²) of `signal` x and `reference` y at the sample times of x; unit of the signal."""
    seen = view.signal()
    return root_mean_square(seen.values - _matching(seen, view.reference()).at(seen.time))


def correlation(view: View) -> float:
    """Return Pearson's correlation of `signal` and `reference` at the sample times of `signal`, in −1…1."""
    seen = view.signal()
    return pearson(seen.values, view.reference().at(seen.time))


def pearson(first: Array, second: Array) -> float:
    """Return Pearson's correlation of two sequences of one length, in −1…1.

    Raises:
        NotMeasurableError: one of them is constant.
    """
    deviations = first - first.mean(), second - second.mean()
    norm = float(np.linalg.norm(deviations[0]) * np.linalg.norm(deviations[1]))
    if norm == 0.0:
        raise NotMeasurableError("a constant signal has no correlation")
    return float(deviations[0] @ deviations[1]) / norm


def rms_difference_of_runs(view: View, other: View) -> float:
    """Return √(mean (x − y)²) of `signal` in two runs, at the sample times of the first in their common time.

    Raises:
        MeasureError: the units differ.
        NotMeasurableError: the runs have no time in common.
    """
    first, second = view.signal(), other.signal()
    common = (first.time >= second.time[0]) & (first.time <= second.time[-1])
    if not np.any(common):
        raise NotMeasurableError("the runs have no time in common")
    return root_mean_square(first.values[common] - _matching(first, second).at(first.time[common]))


def root_mean_square(values: Array) -> float:
    """Return √(mean x²)."""
    return float(np.sqrt(np.mean(values**2)))


def _matching(seen: Window, other: Window) -> Window:
    if seen.unit != other.unit:
        raise MeasureError(f"{seen.name} is in '{seen.unit}', {other.name} in '{other.unit}': they cannot be compared")
    return other


def _clip(time: Array, values: Array, start: float, end: float) -> tuple[Array, Array]:
    """Return the piecewise linear signal between two times, with samples at both."""
    inside = (time > start) & (time < end)
    clipped = np.concatenate(([start], time[inside], [end]))
    return clipped, np.interp(clipped, time, values)


def _time_above_zero(time: Array, values: Array) -> float:
    """Return how long (s) a piecewise linear signal is above zero."""
    high, low = np.maximum(values[:-1], values[1:]), np.minimum(values[:-1], values[1:])
    crossing = (high > 0.0) & (low < 0.0)
    part = np.where(low >= 0.0, (high > 0.0).astype(float), 0.0)
    part[crossing] = high[crossing] / (high - low)[crossing]
    return float(part @ np.diff(time))
