"""Everything that pictures of a stretch of a run show: poses, loaded contacts, and where the camera stands."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from neuromech.analyse.contacts import footfalls
from neuromech.analyse.windows import Array, NotMeasurableError, View
from neuromech.errors import MeasureError
from neuromech.graph.model import BodyModel
from neuromech.report.camera import Angle, Camera, followed
from neuromech.report.replay import Motion, Poses
from neuromech.report.solids import body_size, outline
from neuromech.report.weights import Swing, recorded_swings
from neuromech.simulate.recording import Recording
from neuromech.spec.measure import Measure


@dataclass(frozen=True, slots=True)
class Shot:
    """What n pictures show.

    Args:
        body: the body.
        size: of the body, in m.
        poses: n of them.
        loaded: (n, contacts) whether the ground carries a contact; false where its force was not recorded.
        cameras: n of them.
        swings: weights on strings.
    """

    body: BodyModel
    size: float
    poses: Poses
    loaded: NDArray[np.bool_]
    cameras: tuple[Camera, ...]
    swings: tuple[Swing, ...]


def shoot(motion: Motion, angle: Angle, times: Array) -> Shot:
    """Return a shot of a motion at times (s) of equal distance, from an angle."""
    poses = motion.at(times)
    size = body_size(motion.body, poses)
    loads = [_loaded(motion.recording, contact, times) for contact in motion.body.contacts]
    loaded = np.column_stack([np.empty((len(times), 0), dtype=np.bool_), *loads])
    cameras = tuple(followed(poses.time, outline(motion.body, poses), angle, size))
    swings = tuple(recorded_swings(motion.body, motion.recording))
    return Shot(motion.body, size, poses, loaded, cameras, swings)


def _loaded(recording: Recording, contact: str, times: Array) -> NDArray[np.bool_]:
    if f"{contact}.force_z" not in recording.names:
        return np.zeros(len(times), dtype=np.bool_)
    try:
        (found,) = footfalls(View(recording, Measure(kind="duty_factor", feet=(contact,))))
    except (NotMeasurableError, MeasureError):  # A diverged run, or one without weight, has no contacts to show.
        return np.zeros(len(times), dtype=np.bool_)
    return found.loaded(times)
