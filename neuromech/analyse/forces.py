"""Measures of the force that the ground exerts."""

from collections.abc import Callable

import numpy as np
from scipy.signal import lfilter

from neuromech.analyse.contacts import footfalls
from neuromech.analyse.windows import Array, View

FILTER_RATE = 100.0
"""Rate (1/s) of the first-order filter of the force of a foot; Dzeladini 2013 eq. 2.34."""


def ground_reaction_peak(view: View) -> float:
    """Return the peak of the filtered vertical force in stance, in body weights: mean of stances, mean of the `feet`.

    The filter is dF/dt = 100 1/s (f − F) (Dzeladini 2013 eq. 2.34), exact for a force that is linear between samples.
    """
    return _peak(view, lambda start, end: (start, end))


def loading_peak(view: View) -> float:
    """Return the peak of the filtered vertical force in the first half of stance, as for `ground_reaction_peak`."""
    return _peak(view, lambda start, end: (start, 0.5 * (start + end)))


def push_off_peak(view: View) -> float:
    """Return the peak of the filtered vertical force in the second half of stance, as for `ground_reaction_peak`."""
    return _peak(view, lambda start, end: (0.5 * (start + end), end))


def filtered(time: Array, load: Array) -> Array:
    """Return a force after the filter dF/dt = 100 1/s (f − F), from F = f on; samples at one rate, shape (n,)."""
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
        smooth = filtered(time, load)
        starts, ends = np.searchsorted(time, part(strides.cycles.onsets[:-1], strides.liftoffs))
        peaks.append(
            np.mean([smooth[start : max(end, start + 1)].max() for start, end in zip(starts, ends, strict=True)])
        )
    return float(np.mean(peaks)) / weight
