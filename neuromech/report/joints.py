"""Joint angles over time, and their phase planes as in Habu 2020 Fig. 3-3."""

from collections import Counter

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from neuromech.analyse.measures import measure
from neuromech.analyse.windows import Array
from neuromech.report.layout import (
    TIME_COLORS,
    NotDrawableError,
    Trace,
    axis_label,
    by_scope,
    grid,
    in_shown_unit,
    panels,
    recent,
    title,
    trace,
)
from neuromech.report.protocol import sensor_names
from neuromech.simulate.recording import Recording
from neuromech.spec.measure import Measure
from neuromech.units import Quantity

MOST_POINTS = 6000
"""Number of samples beyond which a phase plane leaves some out."""

RARE = 0.5
"""Percentage of samples on either side that may leave the frame of a phase plane."""


def joint_angles(recording: Recording) -> dict[str, list[str]]:
    """Return {scope: angles of joints}; what sensors see as an angle is left out."""
    sensors = sensor_names(recording)
    found = {
        scope: [name for name in names if name.rpartition(".")[0] not in sensors]
        for scope, names in by_scope(recording, "angle").items()
    }
    return {scope: names for scope, names in found.items() if names}


def joint_angle_figure(recording: Recording) -> Figure:
    """Return joint angles, one row per leg: the whole run, and the last few cycles.

    Dashed lines show the centre of oscillation over the last few cycles, as in Habu 2020 Fig. 3-1.

    Raises:
        NotDrawableError: no joint angle was recorded.
    """
    scopes = joint_angles(recording)
    if not scopes:
        raise NotDrawableError("no joint angle is recorded")
    options = {"sharex": "col", "sharey": "row", "width_ratios": [2.2, 1.0]}
    figure, axes = grid(len(scopes), 2, 4.6, 2.1, **options)
    start, end = recent(recording)
    for (whole, late), (scope, names) in zip(axes, scopes.items(), strict=True):
        for name in names:
            _angle(whole, late, recording, name, start)
        whole.set_title(title(recording, scope), loc="left")
        whole.set_ylabel(axis_label("angle", trace(recording, names[0]).unit))
        late.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    for bottom in axes[-1]:
        bottom.set_xlabel("time (s)")
    axes[-1][0].set_xlim(0.0, max(end, recording.outcome.time))
    axes[-1][1].set_xlim(start, end)
    return figure


def _angle(whole: Axes, late: Axes, recording: Recording, name: str, start: float) -> None:
    one = trace(recording, name)
    (line,) = whole.plot(one.time, one.values, linewidth=0.8)
    center = measure(recording, Measure(kind="center", signal=name, after=Quantity(start))).value
    label = one.element
    if not isinstance(center, str):
        shown = in_shown_unit(center, recording.unit(name))
        whole.axhline(shown, color=line.get_color(), linestyle="--", linewidth=0.7)
        label = f"{one.element}, centre {shown:.0f} {one.unit}"
    late.plot(one.time, one.values, color=line.get_color(), label=label)


def phase_plane_figure(recording: Recording) -> Figure:
    """Return joint velocity against joint angle, coloured by time, one panel per joint, a leg's joints side by side.

    Rare excursions, such as the first jerk of a run, leave the frame.

    Raises:
        NotDrawableError: no joint was recorded with both angle and velocity.
    """
    joints = joints_with_velocity(recording)
    if not joints:
        raise NotDrawableError("no joint is recorded with angle and velocity")
    width = max(Counter(joint.rpartition(".")[0] for joint in joints).values())
    names = [" ".join(joint.rsplit(".", 1)) for joint in joints]
    figure, axes = panels(names, 2.7, 2.1, columns=width if width > 1 else 2)
    normalize = Normalize(0.0, max(recording.outcome.time, recent(recording)[1]))
    for one, joint in zip(axes, joints, strict=True):
        _path(one, trace(recording, f"{joint}.angle"), trace(recording, f"{joint}.velocity"), normalize)
    colors = ScalarMappable(normalize, TIME_COLORS)
    figure.colorbar(colors, ax=figure.axes, label="time (s)", shrink=0.6, aspect=30, pad=0.02)
    return figure


def joints_with_velocity(recording: Recording) -> list[str]:
    """Return the joints that were recorded with angle and velocity, leg after leg."""
    velocities = set(recording.match("*.velocity"))
    joints = (name.removesuffix(".angle") for names in joint_angles(recording).values() for name in names)
    return [joint for joint in joints if f"{joint}.velocity" in velocities]


def _path(axes: Axes, angle: Trace, velocity: Trace, normalize: Normalize) -> None:
    """Draw the path coloured by time."""
    other = np.interp(angle.time, velocity.time, velocity.values)
    points = np.column_stack((angle.values, other))[:: 1 + len(angle.time) // MOST_POINTS]
    segments = np.stack((points[:-1], points[1:]), axis=1)
    times = np.linspace(angle.time[0], angle.time[-1], len(segments))
    axes.add_collection(LineCollection(list(segments), array=times, cmap=TIME_COLORS, norm=normalize, linewidths=0.7))
    axes.set_xlim(*usual_range(points[:, 0]))
    axes.set_ylim(*usual_range(points[:, 1]))
    axes.set_xlabel(axis_label("angle", angle.unit))
    axes.set_ylabel(axis_label("velocity", velocity.unit))


def usual_range(values: Array) -> tuple[float, float]:
    """Return the range of all but the rarest values, with a margin."""
    finite = values[np.isfinite(values)]
    if len(finite) == 0:
        return 0.0, 1.0
    low, high = np.percentile(finite, [RARE, 100.0 - RARE])
    margin = 0.15 * (high - low) or 1.0
    return float(low - margin), float(high + margin)
