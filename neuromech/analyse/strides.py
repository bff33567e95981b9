"""Measures of strides: durations, duty factor, double support, touchdowns."""

from collections.abc import Callable

import numpy as np

from neuromech.analyse.contacts import Footfalls, Strides, footfalls
from neuromech.analyse.cycles import FEWEST_CYCLES
from neuromech.analyse.oscillation import cycles_of
from neuromech.analyse.windows import Array, NotMeasurableError, View, Window


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


def double_support_duration(view: View) -> float:
    """Return the time for which both of two `feet` are loaded, per step (s); a stride has two steps.

    Over the whole strides of the first foot; zero for a gait without double support.
    """
    first, second = footfalls(view)
    onsets = first.strides().cycles.onsets
    second.strides()
    own, other = (np.clip(foot.contacts, onsets[0], onsets[-1]) for foot in (first, second))
    starts, ends = np.maximum.outer(own[:, 0], other[:, 0]), np.minimum.outer(own[:, 1], other[:, 1])
    return float(np.sum(np.maximum(ends - starts, 0.0)) / (2.0 * (len(onsets) - 1)))


def flight_duration(view: View) -> float:
    """Return the shortest time before a touchdown for which none of two `feet` is loaded (s), over all touchdowns.

    Below zero where a foot touches down while the other is still loaded: then it is minus the longest time for which
    both are, until the liftoff of the other. So it is above zero only for a gait with a flight in every step.
    """
    first, second = footfalls(view)
    shares = [*_in_the_air(first, second), *_in_the_air(second, first)]
    if len(shares) < 2 * FEWEST_CYCLES:
        raise NotMeasurableError(f"{first.name} and {second.name} make fewer than {2 * FEWEST_CYCLES} steps")
    return min(shares)


def _in_the_air(foot: Footfalls, other: Footfalls) -> list[float]:
    """Return the time (s) from the liftoff of the other foot to each touchdown, below zero where it comes later."""
    foot.strides()
    contacts = other.contacts
    last = np.searchsorted(contacts[:, 0], foot.touchdowns, side="right") - 1
    known = last >= 0
    return [float(gap) for gap in foot.touchdowns[known] - contacts[last[known], 1]]


def running_time(view: View) -> float:
    """Return how long two feet run (s): until one lands beside the other, or twice in a row, or the end.

    From `after` to the first touchdown while the other foot is loaded, or the first with no touchdown of the other one
    since the last. Also of a run that ended early, up to its end.
    """
    feet = footfalls(view)
    contacts = np.concatenate([foot.contacts for foot in feet])
    sides = np.repeat(np.arange(len(feet)), [len(foot.contacts) for foot in feet])
    order = np.argsort(contacts[:, 0], kind="stable")
    contacts, sides = contacts[order], sides[order]
    walks = (contacts[1:, 0] <= contacts[:-1, 1]) | (sides[1:] == sides[:-1])
    end = contacts[1:][walks][0, 0] if walks.any() else feet[0].end
    return float(end - feet[0].start)


def stance_asymmetry(view: View) -> float:
    """Return |a − b| / ((a + b) / 2) of the median stance durations of two `feet`: 0 where they are equal, at most 2.

    The symmetry index of Robinson, Herzog & Nigg 1987, J. Manipulative Physiol. Ther. 10:172–176, as a fraction.
    """
    first, second = (float(np.median(foot.strides().stances)) for foot in footfalls(view))
    return abs(first - second) / (0.5 * (first + second))


def period_ratio(view: View) -> float:
    """Return the period of the first of two `feet` or `signals` over that of the second, 1 where they are locked."""
    if view.spec.feet is not None:
        first, second = (foot.strides().cycles for foot in footfalls(view))
    else:
        first, second = (cycles_of(view, signal) for signal in view.signals())
    return first.period / second.period


def touchdowns_per_cycle(view: View) -> float:
    """Return how often each of the `feet` touches down in a cycle of `reference`, in the mean; 1 in a regular gait."""
    reference = cycles_of(view, view.reference())
    feet = footfalls(view)
    count = sum(len(reference.phases(foot.touchdowns)[0]) for foot in feet)
    return count / (len(reference.durations) * len(feet))


def fraction_in_stance(view: View) -> float:
    """Return the part of the activity of `signal` that falls in the stance of the foot in `feet`, in 0…1.

    ∫ a dt while the foot is loaded over ∫ a dt, by the trapezoidal rule; a is what `signal` is above zero.
    """
    seen = view.signal()
    active = Window(seen.name, seen.time, np.maximum(seen.values, 0.0), seen.unit)
    total = float(active.integral(seen.time[-1:])[0])
    if total == 0.0:
        raise NotMeasurableError(f"{seen.name} is never active")
    contacts = footfalls(view)[0].contacts
    return float(np.sum(active.integral(contacts[:, 1]) - active.integral(contacts[:, 0]))) / total


def _mean_over_feet(view: View, of: Callable[[Strides], Array]) -> float:
    return float(np.mean([np.median(of(foot.strides())) for foot in footfalls(view)]))
