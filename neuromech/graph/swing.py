"""Where a pendulum hangs, and where its weight starts. In plain floats, so that rules and compiled code can ask."""

from math import atan2, cos, pi, sin, sqrt
from typing import Final

from neuromech.graph.model import BodyModel
from neuromech.graph.pose import Vector, added, frames, turned
from neuromech.spec.model import BoxShape
from neuromech.spec.pendulum import Pendulum

HEADINGS: Final = {"front": 0.0, "left": 0.5 * pi, "back": pi, "right": -0.5 * pi}
"""Side → direction from the body to where the weight comes from, as an angle from the heading in rad."""

# Complete elliptic integral K(1/2): the time from horizontal to the lowest point is K sqrt(string / gravity).
_QUARTER: Final = 1.8540746773013719


def aimed(
    x: float, y: float, z: float, heading: float, vx: float, vy: float, string: float, radius: float, gravity: float
) -> tuple[float, float, float]:
    """Return the pivot from which a weight released now hits a moving point at the lowest point of its swing.

    Args:
        x: of the point in m.
        y: of the point in m.
        z: of the point in m.
        heading: direction from the point to where the weight comes from, in rad.
        vx: velocity of the point along x in m/s.
        vy: velocity of the point along y in m/s.
        string: length in m.
        radius: of the weight in m.
        gravity: in m/s².
    """
    time = _QUARTER * sqrt(string / gravity)
    return x + vx * time + radius * cos(heading), y + vy * time + radius * sin(heading), z + string


def first_pivot(body: BodyModel, pendulum: Pendulum) -> Vector:
    """Return the pivot at time zero; with a target, as if it were released then."""
    if pendulum.pivot is not None:
        x, y, z = map(float, pendulum.pivot)
        return x, y, z
    rotation, origin = frames(body)[pendulum.segment]
    x, y, z = added(origin, turned(rotation, pendulum.target or (0.0, 0.0, 0.0)))
    heading = atan2(rotation[1][0], rotation[0][0]) + HEADINGS[pendulum.side]
    sizes = (float(pendulum.string), float(pendulum.radius), float(body.world.gravity))
    return aimed(x, y, z, heading, body.motion.root[0], body.motion.root[1], *sizes)


def first_place(body: BodyModel, pendulum: Pendulum) -> Vector:
    """Return the middle of the weight at time zero."""
    heading = HEADINGS[pendulum.side]
    if pendulum.target is not None:
        rotation, _ = frames(body)[pendulum.segment]
        heading += atan2(rotation[1][0], rotation[0][0])
    string = float(pendulum.string)
    return added(first_pivot(body, pendulum), (string * cos(heading), string * sin(heading), 0.0))


def depth(body: BodyModel, pendulum: Pendulum) -> float:
    """Return how deep in m the weight is in the shape of its segment at time zero; negative outside."""
    shape = body.segments[pendulum.segment].shape
    if shape is None:
        return -float(pendulum.string)
    rotation, origin = frames(body)[pendulum.segment]
    away = added(first_place(body, pendulum), (-origin[0], -origin[1], -origin[2]))
    x, y, z = (sum(rotation[row][column] * away[row] for row in range(3)) for column in range(3))
    if isinstance(shape, BoxShape):
        beyond = [
            abs(at - float(middle)) - 0.5 * float(side)
            for at, middle, side in zip((x, y, z), shape.position, shape.size, strict=True)
        ]
        outside = sqrt(sum(max(0.0, gap) ** 2 for gap in beyond))
        return float(pendulum.radius) - (outside if outside > 0.0 else max(beyond))
    start = [float(part) for part in shape.start]
    along = [float(end) - begin for begin, end in zip(start, shape.end, strict=True)]
    to = [at - begin for at, begin in zip((x, y, z), start, strict=True)]
    length = sum(part * part for part in along)
    share = min(1.0, max(0.0, sum(a * b for a, b in zip(to, along, strict=True)) / length)) if length > 0.0 else 0.0
    gap = sqrt(sum((a - share * b) ** 2 for a, b in zip(to, along, strict=True)))
    return float(pendulum.radius) + float(shape.radius) - gap
