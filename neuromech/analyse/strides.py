"""Measures of strides: durations, duty factor, double support, touchdowns."""

from collections.abc import Callable

import numpy as np

from neuromech.analyse.contacts import Strides, footfalls
from neuromech.analyse.windows import Array, View


def cycle_duration(view: View) -> float:
    """Return the duration of a stride from touchdown to touchdown (s): median of each of the `feet`, mean of feet."""
    return _mean_over_feet(view, lambda strides: strides.cycles.durations)


def stance_duration(view: View) -> float:
    """Return the time from touchdown to liftoff (s): median over strides of each of the `feet`, mean of feet."""
    return _mean_over_feet(view, lambda strides: strides.stances)


def swing_duration(view: View) -> float:
    """Return the time from liftoff to touchdown (s): median over strides of each of the `feet`, mean of feet."""
    return _mean_over_feet(view, lambda strides: strides.swings)


def duty_factor(view: View) -> float:
    """Return stance over stride duration, in 0…1: median over strides of each of the `feet`, mean of feet.

    Alexander 1984, doi:10.1177/027836498400300205.
    """
    return _mean_over_feet(view, lambda strides: strides.duty_factors)


def touchdowns(view: View) -> float:
    """Return how often the `feet` touch down, all together. Also of a run that ended early, up to its end."""
    return float(sum(len(foot.touchdowns) for foot in footfalls(view)))


def _mean_over_feet(view: View, of: Callable[[Strides], Array]) -> float:
    return float(np.mean([np.median(of(foot.strides())) for foot in footfalls(view)]))
