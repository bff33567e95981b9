"""How a gait comes back after something happened: phase planes coloured by time, as in Habu 2020 Fig. 3-13, 14, 16."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from neuromech.report.joints import joints_with_velocity, usual_range
from neuromech.report.layout import BLUE, GREEN, RED, NotDrawableError, axis_label, panels, trace
from neuromech.report.protocol import first_disturbance
from neuromech.simulate.recording import Recording

SPAN = 5.0
"""Time (s) that one colour stands for."""

_COLORS = (RED, GREEN, BLUE, "0.1")
_BEFORE = "0.75"


def recovery_figure(recording: Recording, after: float | None = None) -> Figure:
    """Return velocity against angle of the first joint of each leg, coloured by the time since something happened.

    The five seconds before are grey, then every five seconds have a colour, twenty seconds in all.

    Args:
        recording: of a run.
        after: time (s) of what happened; of what first disturbs the run by its protocol where None is given.

    Raises:
        NotDrawableError: no time is given and the protocol disturbs nothing, the run ended before it, or no joint was
            recorded with both angle and velocity.
    """
    what, start = _event(recording) if after is None else ("the event", after)
    if start >= recording.outcome.time:
        raise NotDrawableError(f"the run ended before {what} at {start:g} s")
    joints = _first_joints(recording)
    if not joints:
        raise NotDrawableError("no joint is recorded with angle and velocity")
    figure, axes = panels([" ".join(joint.rsplit(".", 1)) for joint in joints], 3.1, 2.4)
    for one, joint in zip(axes, joints, strict=True):
        _plane(one, recording, joint, start)
    handles, labels = axes[0].get_legend_handles_labels()
    title = f"time after {what}, {start:g} s"
    figure.legend(handles, labels, title=title, loc="outside lower center", ncols=len(labels))
    return figure


def _event(recording: Recording) -> tuple[str, float]:
    found = first_disturbance(recording)
    if found is None:
        raise NotDrawableError("the protocol disturbs nothing, and no time was given")
    return found


def _first_joints(recording: Recording) -> list[str]:
    """Return the first joint of each leg that was recorded with angle and velocity."""
    found: dict[str, str] = {}
    for joint in joints_with_velocity(recording):
        found.setdefault(joint.rpartition(".")[0], joint)
    return list(found.values())


def _plane(axes: Axes, recording: Recording, joint: str, start: float) -> None:
    angle, velocity = trace(recording, f"{joint}.angle"), trace(recording, f"{joint}.velocity")
    speeds = np.interp(angle.time, velocity.time, velocity.values)
    last = float(angle.time[-1])
    spans = [(start - SPAN, start, _BEFORE, "before")]
    for number, color in enumerate(_COLORS):
        first = number * SPAN
        spans.append((start + first, start + first + SPAN, color, f"{first:g} to {first + SPAN:g} s"))
    for begin, end, color, label in spans:
        chosen = (angle.time >= begin) & (angle.time <= end)
        if begin < last and chosen.any():
            axes.plot(angle.values[chosen], speeds[chosen], color=color, linewidth=0.7, label=label)
    shown = (angle.time >= start - SPAN) & (angle.time <= start + len(_COLORS) * SPAN)
    axes.set_xlim(*usual_range(angle.values[shown]))
    axes.set_ylim(*usual_range(speeds[shown]))
    axes.set_xlabel(axis_label("angle", angle.unit))
    axes.set_ylabel(axis_label("velocity", velocity.unit))
