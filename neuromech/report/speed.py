"""Speed over time, and the parameters that move meanwhile."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from neuromech.report.layout import BLUE, GREEN, RED, NotDrawableError, grid, rhythm_of, root_of
from neuromech.report.protocol import moving_parameters
from neuromech.report.steps import feet, strides_of
from neuromech.simulate.recording import Recording

_WITHOUT_RHYTHM = 0.5
"""Time (s) over which speed is averaged where nothing is rhythmic."""

_PARAMETER_COLORS = (RED, GREEN, "0.3")


def speed_figure(recording: Recording) -> Figure:
    """Return forward speed averaged over a cycle, and the parameters that the protocol moves, as in Habu 2020 Fig. 3-8.

    The speed at a time is the way along x from half a cycle before it to half a cycle after it, over the cycle's
    duration. At most three parameters are drawn.

    Raises:
        NotDrawableError: x of the root was not recorded, it does not move, or the run is shorter than a cycle.
    """
    root = root_of(recording, "x")
    if not root:
        raise NotDrawableError("x of the root is not recorded")
    time, x = recording.signal(f"{root}.x")
    if np.ptp(x) == 0.0:
        raise NotDrawableError(f"{root} does not move")
    half = 0.5 * _period(recording)
    middle = time[(time >= time[0] + half) & (time <= time[-1] - half)]
    if len(middle) == 0:
        raise NotDrawableError("the run is shorter than a cycle")
    speed = (np.interp(middle + half, time, x) - np.interp(middle - half, time, x)) / (2.0 * half)
    figure, axes = grid(1, 1, 6.5, 2.4)
    one = axes[0][0]
    lines = one.plot(middle, speed, color=BLUE, label="speed")
    one.set_xlim(0.0, float(time[-1]))
    one.set_xlabel("time (s)")
    one.set_ylabel("speed (m/s)")
    lines += _parameters(one, recording, float(time[-1]))
    one.legend(handles=lines, loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=len(lines))
    return figure


def _parameters(axes: Axes, recording: Recording, end: float) -> list[Line2D]:
    """Draw parameters against an axis on the right, and return the lines."""
    courses = moving_parameters(recording)
    if not courses:
        return []
    right = axes.twinx()
    right.spines["right"].set_visible(True)
    drawn: list[Line2D] = []
    for (name, course), color in zip(courses.items(), _PARAMETER_COLORS, strict=False):
        label = f"{name} ({course.unit})" if course.unit else name
        shown = ([*course.times, end], [*course.values, course.values[-1]])
        drawn += right.plot(*shown, color=color, linestyle="--", label=label)
    right.set_ylabel(str(drawn[0].get_label()) if len(drawn) == 1 else "parameters")
    return drawn


def _period(recording: Recording) -> float:
    """Return the duration (s) of a stride of the first foot, else of a cycle of the first rhythmic signal."""
    try:
        strides = [strides_of(foot) for foot in feet(recording).values()]
    except NotDrawableError:
        strides = []
    rhythms = (rhythm_of(recording, name) for name in recording.match("*.activity", "*.angle"))
    cycles = [one.cycles for one in strides if one is not None]
    found = cycles[0] if cycles else next((one for one in rhythms if one is not None), None)
    return _WITHOUT_RHYTHM if found is None else found.period
