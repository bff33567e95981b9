"""A strip of pictures of the body, as in Habu 2020 Fig. 3-10, 3-15 and 3-17."""

import numpy as np
from matplotlib.figure import Figure

from neuromech.errors import RecordingError
from neuromech.graph.model import BodyModel
from neuromech.report.camera import Angle
from neuromech.report.ground import square
from neuromech.report.layout import SHOWN_CYCLES, NotDrawableError, recent
from neuromech.report.replay import Motion, recorded_body
from neuromech.report.scene import Picture, Scene
from neuromech.report.shot import shoot
from neuromech.report.solids import body_size
from neuromech.report.weights import recorded_swings
from neuromech.simulate.recording import Recording
from neuromech.spec.world import Slope, Step

PICTURES = 6
_COLUMNS = 3
_PICTURE = Picture(480, 288, finer=2)
_DOTS_PER_INCH = 160.0
_AFTER_HIT = 0.2
"""Time (s) for which pictures go on after a weight was taken away."""

_SAMPLE = 0.02
"""Time (s) between samples of the way of the body."""

_BETWEEN = 10
"""Poses from one picture to the next, over which the camera's way is smoothed."""


def stills_figure(
    recording: Recording,
    body: BodyModel | None = None,
    window: tuple[float, float] | None = None,
    angle: Angle = "side",
    number: int = PICTURES,
) -> Figure:
    """Return pictures of the body at times of equal distance, three in a row.

    Args:
        recording: of the body's motion.
        body: that of the recorded document where None is given.
        window: times (s) of the first and the last picture; where None is given, those between
            the last weight swings, else those between which it passes the last slope or step that it reaches, or its
            last cycle on level ground.
        angle: where the camera stands.
        number: of pictures.

    Raises:
        NotDrawableError: the motion was not recorded, or there is no body.
    """
    try:
        motion = Motion(recorded_body(recording) if body is None else body, recording)
    except RecordingError as error:
        raise NotDrawableError(str(error)) from error
    start, end = window or _window(motion)
    shot = shoot(motion, angle, np.linspace(start, end, _BETWEEN * (number - 1) + 1))
    with Scene(shot, _PICTURE) as scene:
        images = [scene.image(_BETWEEN * k) for k in range(number)]
    rows = -(-number // _COLUMNS)
    size = (_COLUMNS * _PICTURE.width / _DOTS_PER_INCH, rows * (_PICTURE.height / _DOTS_PER_INCH + 0.22) + 0.2)
    figure = Figure(figsize=size, layout="constrained")
    axes = figure.subplots(rows, _COLUMNS, squeeze=False)
    for one in axes.flat[number:]:
        one.remove()
    for k, (one, image) in enumerate(zip(axes.flat, images, strict=False)):
        one.imshow(image, interpolation="none")
        one.set_axis_off()
        one.set_title(f"{k + 1}   {shot.poses.time[_BETWEEN * k]:.2f} s", loc="left")
    if shot.body.world.ground is not None:
        figure.supxlabel(
            f"squares of {1e3 * square(shot.size):g} mm; feet that carry load are yellow", fontsize="small"
        )
    return figure


def _window(motion: Motion) -> tuple[float, float]:
    """Return when a weight hits the body, or when it passes the last slope or step that it reaches; or a last cycle."""
    swings = recorded_swings(motion.body, motion.recording)
    if swings:
        last = max(swings, key=lambda swing: swing.begin)
        return last.begin, min(last.end + _AFTER_HIT, motion.end)
    passage = _passage(motion)
    if passage is not None:
        return passage
    start, end = recent(motion.recording)
    return max(start, end - (end - start) / SHOWN_CYCLES), min(end, motion.end)


def _passage(motion: Motion) -> tuple[float, float] | None:
    ground = motion.body.world.ground
    time = np.linspace(0.0, motion.end, 1 + round(motion.end / _SAMPLE))
    poses = motion.at(time)
    x, margin = poses.position[:, 0, 0], 0.5 * body_size(motion.body, poses)
    stretches: list[Slope | Step] = [] if ground is None else [*ground.slopes, *ground.steps.values()]
    reached = [one for one in stretches if float(one.start) < x.max()]
    if not reached:
        return None
    last = max(reached, key=lambda one: float(one.start))
    start, end = float(last.start) - margin, float(last.start) + float(last.length) + margin
    passing = time[(x >= start) & (x <= end)]
    return float(passing[0]), float(passing[-1])
