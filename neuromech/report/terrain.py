"""The profile of the ground that a body walks on."""

import numpy as np
from matplotlib.figure import Figure

from neuromech.errors import RecordingError
from neuromech.graph.terrain import terrain
from neuromech.report.layout import BLUE, NotDrawableError, grid, root_of
from neuromech.report.replay import recorded_body
from neuromech.simulate.ground import drawn_ground
from neuromech.simulate.recording import Recording

_BEYOND = 3.0
"""How far (m) the profile is shown beyond where the body came."""


def terrain_figure(recording: Recording) -> Figure:
    """Return height and slope of the ground along y = 0 where the root came, as in Dzeladini 2013 Fig. 2.8 and 7.5 A.

    Raises:
        NotDrawableError: the body cannot be read or its way was not recorded, or the ground is level.
    """
    root = root_of(recording, "x")
    if not root:
        raise NotDrawableError("the way of the root is not recorded")
    try:
        ground = drawn_ground(recorded_body(recording).world.ground, recording.provenance.seed)
    except RecordingError as reason:
        raise NotDrawableError(str(reason)) from reason
    if ground is None or ((surface := terrain(ground)).plane is not None and not surface.steps):
        raise NotDrawableError("the ground is level")
    way = recording.signal(f"{root}.x")[1]
    x = np.arange(min(way.min(), 0.0) - 1.0, way.max() + _BEYOND, 0.01)
    height = np.array([surface.height(float(one), 0.0) for one in x])
    figure, axes = grid(2, 1, 6.5, 1.4, sharex=True)
    profile, slope = axes[0][0], axes[1][0]
    profile.fill_between(x, 1e3 * height, 1e3 * min(0.0, height.min()), color="0.8", linewidth=0.0)
    profile.plot(x, 1e3 * height, color="black", linewidth=0.8)
    profile.set_ylabel("height (mm)")
    slope.plot(x[:-1], 100.0 * np.diff(height) / np.diff(x), color=BLUE, linewidth=0.8)
    slope.set_ylabel("slope (%)")
    slope.set_xlabel("x (m)")
    slope.set_xlim(x[0], x[-1])
    for one in (profile, slope):
        one.axvline(way[-1], color="0.4", linestyle=":", linewidth=0.9)
    profile.set_title(f"{root} ends at {way[-1]:.1f} m: {recording.outcome.kind}", loc="left")
    return figure
