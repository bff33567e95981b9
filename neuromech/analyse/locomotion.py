"""Measures of a body's way through the world."""

import numpy as np

from neuromech.analyse.windows import NotMeasurableError, View


def time_alive(view: View) -> float:
    """Return how long the run went on (s): from `after` to its end, or to `until`; zero where it ended before `after`.

    Also of a run that ended early.
    """
    end = view.recording.outcome.time
    until = end if view.spec.until is None else min(end, float(view.spec.until))
    return max(0.0, until - float(view.spec.after))


def distance(view: View) -> float:
    """Return how far `segment` moved along `axis` of the world, last minus first sample (m); backwards is negative.

    Also of a run that ended early, up to its end.
    """
    seen = view.window(view.coordinate(view.spec.axis))
    return float(seen.values[-1] - seen.values[0])


def speed(view: View) -> float:
    """Return the mean speed of `segment` along `axis` of the world, `distance` over time (m/s); backwards is negative.

    Also of a run that ended early, up to its end.
    """
    seen = view.window(view.coordinate(view.spec.axis))
    return float((seen.values[-1] - seen.values[0]) / (seen.time[-1] - seen.time[0]))


def speed_range(view: View) -> float:
    """Return the greatest minus the least speed of `segment` along `axis`, each a mean over `average_over` (m/s).

    The stretches are all that fit into the window, one from each sample on. Take some strides, so that the speed within
    a stride does not count.
    """
    seen = view.window(view.coordinate(view.spec.axis))
    stretch = view.number("average_over")
    starts = seen.time[seen.time + stretch <= seen.time[-1] + 1e-9]
    if len(starts) == 0:
        raise NotMeasurableError(f"the window is shorter than {stretch:g} s")
    ways = np.interp(starts + stretch, seen.time, seen.values) - seen.values[: len(starts)]
    return float(np.ptp(ways) / stretch)


def moving_time(view: View) -> float:
    """Return how long `segment` moves on along `axis` (s): until a stretch in which it is slower than `least_speed`.

    The speed is the mean over `average_over`. Stretches begin at each sample, and what counts is the time before the
    first slow one. Where none is slow it is the whole window. A window that is shorter than a stretch is one stretch.

    Also of a run that ended early, up to its end. Source: t of equation 15 of Habu 2020, with 0.05 m/s.
    """
    seen = view.window(view.coordinate(view.spec.axis))
    time = seen.time - seen.time[0]
    stretch = min(view.number("average_over"), time[-1])
    starts = time[time + stretch <= time[-1] + 1e-9]
    ways = np.interp(starts + stretch, time, seen.values) - seen.values[: len(starts)]
    slow = starts[ways < view.number("least_speed") * stretch]
    return float(slow[0] if len(slow) else time[-1])


def froude_number(view: View) -> float:
    """Return v² / (g L) of the speed v of `segment` along `axis` and `leg_length` L.

    Alexander & Jayes 1983, doi:10.1111/j.1469-7998.1983.tb04266.x.
    """
    return speed(view) ** 2 / (view.gravity() * view.number("leg_length"))


def travel_direction(view: View) -> float:
    """Return the direction of the way of `segment` from first to last sample, atan2(Δy, Δx) in −π…π (rad).

    Zero is along the x axis of the world, positive to its left.
    """
    x, y = (view.window(view.coordinate(axis)).values for axis in ("x", "y"))
    forward, sideways = float(x[-1] - x[0]), float(y[-1] - y[0])
    if forward == 0.0 and sideways == 0.0:
        raise NotMeasurableError(f"{view.spec.segment} does not move")
    return float(np.arctan2(sideways, forward))


def heading_drift(view: View) -> float:
    """Return how much the yaw of `segment` changes over the window (rad), positive to the left.

    The slope of the least-squares line through the unwrapped yaw, times the duration of the window, so that the
    yaw within a cycle hardly counts.
    """
    seen = view.window(view.coordinate("yaw"))
    yaw = np.unwrap(seen.values)
    time = seen.time - seen.time.mean()
    return float(time @ (yaw - yaw.mean()) / (time @ time) * (seen.time[-1] - seen.time[0]))
