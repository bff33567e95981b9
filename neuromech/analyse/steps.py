"""Measures of the lengths of steps and strides."""

import math

import numpy as np

from neuromech.analyse.contacts import Footfalls, footfalls
from neuromech.analyse.cycles import FEWEST_CYCLES
from neuromech.analyse.windows import Array, NotMeasurableError, View


def step_length(view: View) -> float:
    """Return the mean length of the steps of two `feet` along `axis` (m).

    A step goes from the place of the touchdown of one foot to that of the next touchdown of the other foot. The place
    of a foot is the mean of its contacts.
    """
    return float(np.mean(np.concatenate(_steps(view))))


def stride_length(view: View) -> float:
    """Return the mean distance between successive touchdowns of a foot along `axis` (m): mean of the `feet`."""
    return float(np.mean([np.mean(np.diff(_places(view, foot))) for foot in _stepping(view)]))


def step_length_snr(view: View) -> float:
    """Return ln(x̄ / var x) of the step lengths x of two `feet` in metres; Dzeladini 2013 eq. 2.53–2.54.

    The variance is that of eq. 2.50, with 1/N. More is more regular.
    """
    return _log_ratio(np.concatenate(_steps(view)))


def step_length_similarity(view: View) -> float:
    """Return ln |x̄ / var x − ȳ / var y| of the step lengths x and y of two `feet`; Dzeladini 2013 eq. 2.59–2.60.

    Lengths in metres, variances with 1/N; a step belongs to the foot that ends it. Less is more similar.
    """
    first, second = (math.exp(_log_ratio(lengths)) for lengths in _steps(view))
    if first == second:
        raise NotMeasurableError("the steps of both feet are equally regular")
    return math.log(abs(first - second))


def _log_ratio(lengths: Array) -> float:
    mean, variance = float(np.mean(lengths)), float(np.var(lengths))
    if mean <= 0.0:
        raise NotMeasurableError("the steps do not go forward")
    if variance == 0.0:
        raise NotMeasurableError("all steps are equal")
    return math.log(mean / variance)


def _steps(view: View) -> tuple[Array, Array]:
    """Return the lengths (m) of the steps that end with the first foot, and of those that end with the second."""
    first, second = _stepping(view)
    places = _places(view, first), _places(view, second)
    times = first.touchdowns, second.touchdowns
    lengths = (
        _from_other(times[0], places[0], times[1], places[1]),
        _from_other(times[1], places[1], times[0], places[0]),
    )
    if min(len(found) for found in lengths) < FEWEST_CYCLES:
        raise NotMeasurableError(f"fewer than {FEWEST_CYCLES} steps of each foot")
    return lengths


def _from_other(times: Array, places: Array, other_times: Array, other_places: Array) -> Array:
    """Return how far each touchdown lies ahead of the other foot's last one; without those that have none."""
    index = np.searchsorted(other_times, times) - 1
    known = index >= 0
    return np.asarray(places[known] - other_places[index[known]])


def _places(view: View, foot: Footfalls) -> Array:
    time, place = view.place(foot.name)
    return np.interp(foot.touchdowns, time, place)


def _stepping(view: View) -> list[Footfalls]:
    """Return the feet that all make strides."""
    feet = footfalls(view)
    for foot in feet:
        foot.strides()
    return feet
