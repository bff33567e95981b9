"""Where a camera stands that follows a body, and how large the body is in its pictures."""

from dataclasses import dataclass
from math import cos, radians, sin, tan
from typing import Literal, get_args

import numpy as np
from scipy.ndimage import gaussian_filter1d

from neuromech.analyse.windows import Array

Angle = Literal["side", "front", "follow"]
ANGLES: tuple[Angle, ...] = get_args(Angle)

FIELD_OF_VIEW = 30.0
"""Angle (deg) between the lower and the upper edge of a picture."""

_HEIGHT_SHOWN = 1.0
"""Height of a picture at the body, in body sizes."""

_SMOOTHING = 0.25
"""Time (s) over which the camera evens out the way of the body, so that its bobbing is seen."""

_DIRECTIONS = {"side": (-90.0, 9.0), "front": (0.0, 9.0), "follow": (-140.0, 20.0)}
"""Where the camera stands as seen from the body: angle from the x axis to the left, angle above the horizon (deg)."""


@dataclass(frozen=True, slots=True)
class Camera:
    """A camera that looks at a point.

    Args:
        target: the point, shape (3,) (m).
        eye: where the camera stands, shape (3,) (m).
        light: direction towards the light, shape (3,).
    """

    target: Array
    eye: Array
    light: Array

    @property
    def distance(self) -> float:
        """Distance (m) from the camera to its target."""
        return float(np.linalg.norm(self.eye - self.target))


def followed(time: Array, points: Array, angle: Angle, size: float) -> list[Camera]:
    """Return a camera for each pose; it goes evenly with the body and keeps its direction.

    Args:
        time: of the poses (s), at equal distance; (n,).
        points: of the body in each pose (m); (n, points, 3).
        angle: from the right, from the front, or from behind on the right.
        size: of the body, in m.
    """
    middle = 0.5 * (points.min(axis=1) + points.max(axis=1))
    step = float(time[1] - time[0]) if len(time) > 1 else 1.0
    targets = gaussian_filter1d(middle, _SMOOTHING / step, axis=0, mode="nearest")
    distance = 0.5 * _HEIGHT_SHOWN * size / tan(radians(0.5 * FIELD_OF_VIEW))
    azimuth, elevation = _DIRECTIONS[angle]
    offset = distance * _direction(azimuth, elevation)
    light = _direction(azimuth + 35.0, 55.0)
    return [Camera(target, target + offset, light) for target in targets]


def _direction(azimuth: float, elevation: float) -> Array:
    a, e = radians(azimuth), radians(elevation)
    return np.array([cos(e) * cos(a), cos(e) * sin(a), sin(e)])
