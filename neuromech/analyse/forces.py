"""Measures of the force that the ground exerts.

SciPy's filters take a second to import, so that only a measure that needs them does.
"""

from collections.abc import Callable

import numpy as np

from neuromech.analyse.contacts import footfalls
from neuromech.analyse.windows import Array, View

FILTER_RATE = 100.0
"""Rate (1/s) of the first-order filter of the force of a foot; Dzeladini 2013 eq. 2.34."""

HUMP = 0.05
"""How far a hump of a force must stand out, in body weights."""


def ground_reaction_peak(view: View) -> float:
    """Return the peak of the filtered vertical force in stance, in body weights: mean of stances, mean of the `feet`.

    The filter is dF/dt = 100 1/s (f − F) (Dzeladini 2013 eq. 2.34), exact for a force that is linear between samples.
    With `average_over` it is a moving average over this time instead; 100 ms are order 100 at steps of 1 ms, which is
    what the caption of its figure 3.3 says.
    """
    return _peak(view, lambda start, end: (start, end))


def loading_peak(view: View) -> float:
    """Return the peak of the filtered vertical force in the first half of stance, as for `ground_reaction_peak`."""
    return _peak(view, lambda start, end: (start, 0.5 * (start + end)))


def push_off_peak(view: View) -> float:
    """Return the peak of the filtered vertical force in the second half of stance, as for `ground_reaction_peak`."""
    return _peak(view, lambda start, end: (0.5 * (start + end), end))


def force_humps(view: View) -> float:
    """Return how many humps the filtered vertical force has in a stance: mean of stances, mean of the `feet`.

    A hump stands out by at least a twentieth of the body's weight from what lies between it and a higher one. The
    filter is that of `ground_reaction_peak`, also with `average_over`.
    """
    counts = []
    for foot in footfalls(view):
        strides = foot.strides()
        time, load = view.load(foot.name)
        smooth = _smooth(view, time, load)
        starts, ends = (np.searchsorted(time, times) for times in (strides.cycles.onsets[:-1], strides.liftoffs))
        least = HUMP * view.weight()
        counts.append(np.mean([_humps(smooth[start:end], least) for start, end in zip(starts, ends, strict=True)]))
    return float(np.mean(counts))


def _humps(load: Array, least: float) -> int:
    from scipy.signal import find_peaks

    surrounded = np.concatenate(([0.0], load, [0.0]))
    return len(find_peaks(surrounded, prominence=least)[0])


def _smooth(view: View, time: Array, load: Array) -> Array:
    """Return a force after the filter that the measure asks for, shape (n,)."""
    return filtered(time, load) if view.spec.average_over is None else _averaged(view, time, load)


def _averaged(view: View, time: Array, load: Array) -> Array:
    """Return a moving average of a force, samples at one rate, shape (n,)."""
    from scipy.ndimage import uniform_filter1d

    step = float(time[-1] - time[0]) / (len(time) - 1)
    return np.asarray(uniform_filter1d(load, max(1, round(view.number("average_over") / step))))


def filtered(time: Array, load: Array) -> Array:
    """Return a force after the filter dF/dt = 100 1/s (f − F), from F = f on; samples at one rate, shape (n,)."""
    from scipy.signal import lfilter

    step = FILTER_RATE * float(time[-1] - time[0]) / (len(time) - 1)
    decay = np.exp(-step)
    mean = (1.0 - decay) / step
    new, old = 1.0 - mean, mean - decay
    start = load[:1] * (1.0 - new)
    return np.asarray(lfilter([new, old], [1.0, -decay], load, zi=start)[0])


def _peak(view: View, part: Callable[[Array, Array], tuple[Array, Array]]) -> float:
    weight = view.weight()
    peaks = []
    for foot in footfalls(view):
        strides = foot.strides()
        time, load = view.load(foot.name)
        smooth = _smooth(view, time, load)
        starts, ends = np.searchsorted(time, part(strides.cycles.onsets[:-1], strides.liftoffs))
        peaks.append(
            np.mean([smooth[start : max(end, start + 1)].max() for start, end in zip(starts, ends, strict=True)])
        )
    return float(np.mean(peaks)) / weight
