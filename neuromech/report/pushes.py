"""A series of pushes: what hit the body, and the distributions of its numbers, as in Dzeladini 2013 Fig. 2.7."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from scipy import stats

from neuromech.analyse.windows import Array
from neuromech.report.layout import BLUE, RED, NotDrawableError
from neuromech.report.protocol import push_series
from neuromech.simulate.recording import Recording
from neuromech.spec.pushes import PushSeries, RandomAngle, RandomLength, RandomTime

_TAIL = 0.002
"""Part of a distribution beyond either end of its axis."""


def push_series_figure(recording: Recording) -> Figure:
    """Return the force of the first series of pushes over time, and the densities that its numbers are drawn from.

    Raises:
        NotDrawableError: there is no series of pushes, or its force was not recorded.
    """
    found = push_series(recording)
    if not found:
        raise NotDrawableError("the protocol has no series of pushes")
    name, series = next(iter(found.items()))
    if f"{name}.force_x" not in recording.names:
        raise NotDrawableError("the force of the pushes is not recorded")
    figure = Figure(figsize=(7.2, 4.2), layout="constrained")
    parts = figure.subplot_mosaic([["force"] * 4, ["duration", "interval", "angle", "height"]], height_ratios=(1.3, 1))
    _draw_force(parts["force"], recording, name)
    _draw_density(parts["duration"], of_time(series.duration), 1.0, "duration (s)")
    _draw_density(parts["interval"], of_time(series.interval), 1.0, "time between (s)")
    _draw_density(parts["angle"], of_value(series.angle), 180.0 / np.pi, "angle (deg)")
    _draw_density(parts["height"], of_value(series.height), 1.0, "height (m)")
    parts["force"].set_title(_course(series), loc="left")
    return figure


def of_time(time: RandomTime) -> stats.rv_continuous:
    """Return the distribution of a random time (s)."""
    if time.gamma is not None:
        return stats.gamma(float(time.gamma[0]), scale=float(time.gamma[1]))
    if time.f is not None:
        return stats.f(float(time.f[0]), float(time.f[1]), scale=float(time.f[2]))
    return _uniform(time.uniform)


def of_value(value: RandomAngle | RandomLength) -> stats.rv_continuous:
    """Return the distribution of a random angle (rad) or length (m)."""
    if value.normal is not None:
        return stats.norm(*map(float, value.normal))
    return _uniform(value.uniform)


def _uniform(ends: tuple[float, float] | None) -> stats.rv_continuous:
    if ends is None:
        raise ValueError("a random number without a distribution")
    return stats.uniform(float(ends[0]), float(ends[1]) - float(ends[0]))


def _draw_force(axes: Axes, recording: Recording, name: str) -> None:
    for quantity, label, color in (("force_x", "forward", BLUE), ("force_z", "upward", RED)):
        if f"{name}.{quantity}" in recording.names:
            axes.plot(*recording.signal(f"{name}.{quantity}"), color=color, linewidth=0.8, label=label)
    axes.axhline(0.0, color="0.8", linewidth=0.5, zorder=0)
    axes.set_xlabel("time (s)")
    axes.set_ylabel("force (N)")
    axes.legend(loc="upper left")


def _draw_density(axes: Axes, drawn: stats.rv_continuous, factor: float, label: str) -> None:
    low, high = drawn.ppf(_TAIL), drawn.ppf(1.0 - _TAIL)
    margin = 0.05 * (high - low)
    places: Array = np.linspace(low - margin, high + margin, 400)
    axes.fill_between(factor * places, drawn.pdf(places), color=BLUE, alpha=0.35, linewidth=0.0)
    axes.plot(factor * places, drawn.pdf(places), color=BLUE)
    axes.set_yticks([])
    axes.set_ylim(bottom=0.0)
    axes.set_xlabel(label)


def _course(series: PushSeries) -> str:
    mean, deviation = float(series.force), float(series.deviation)
    return f"mean force grows to {mean:g} ± {deviation:g} N in {series.growing_over} pushes"
