"""Lengths, velocities and moment arms of muscle paths from the joint angles."""

from math import cos, sin, sqrt

import numpy as np

from neuromech.compiler.numerics import Floats, Integers, part

CONSTANT_ARMS, STRAIGHT_LINES, LEVER_ARMS = range(3)
CONSTANT, COSINE, GEOMETRIC = range(3)


@part
def lever(form: int, radius: float, angle: float, reference: float, peak: float) -> tuple[float, float]:
    """Return the lever arm (m) at an angle, and its integral (m) from the reference on; Dzeladini 2013 eq. 2.18–2.23.

    Args:
        form: `CONSTANT`, `COSINE` or `GEOMETRIC`.
        radius: largest lever arm, m.
        angle: rad.
        reference: rad.
        peak: angle of the largest lever arm, rad.
    """
    if form == CONSTANT:
        return radius, radius * (angle - reference)
    if form == COSINE:
        return radius * cos(angle - peak), radius * (sin(angle - peak) - sin(reference - peak))
    a = cos(peak)
    now = sqrt(1.0 + a * a - 2.0 * a * cos(angle))
    then = sqrt(1.0 + a * a - 2.0 * a * cos(reference))
    return radius * sin(angle) / now, 2.0 * radius * (cos(reference) - cos(angle)) / (now + then)


@part
def straight_path(
    points: Floats,
    carrier: Integers,
    moved: Integers,
    axis: Floats,
    position: Floats,
    child: Integers,
    slide: Integers,
    joint: Integers,
    arms: Floats,
) -> float:
    """Return the length (m) of straight lines through `points` (p, 3) in the world, and fill the moment arms.

    Args:
        points: (p, 3) in m, in the order from origin to insertion.
        carrier: (p,) segment of each point.
        moved: (n, s) 1 where joint n moves segment s.
        axis: (n, 3) joint axes in the world.
        position: (s, 3) origins of the segment frames in the world, m.
        child: (n,) segment whose frame stands at the joint.
        slide: (n,) 1 for a sliding joint.
        joint: (k,) joints that the path crosses.
        arms: (k,) filled with r = −dl/dq, m (or 1 for a sliding joint).
    """
    length = 0.0
    for k in range(joint.shape[0]):
        arms[k] = 0.0
    for i in range(points.shape[0] - 1):
        x = points[i + 1, 0] - points[i, 0]
        y = points[i + 1, 1] - points[i, 1]
        z = points[i + 1, 2] - points[i, 2]
        distance = np.sqrt(x * x + y * y + z * z)
        length += distance
        inverse = 1.0 / distance
        for k in range(joint.shape[0]):
            j = joint[k]
            first = moved[j, carrier[i]]
            second = moved[j, carrier[i + 1]]
            if first == second or distance == 0.0:
                continue
            end = i + 1 if second else i
            sign = 1.0 if second else -1.0
            dx, dy, dz = _motion(points, end, axis, position[child[j]], j, slide[j])
            arms[k] -= sign * inverse * (x * dx + y * dy + z * dz)
    return length


@part
def _motion(points: Floats, i: int, axis: Floats, origin: Floats, j: int, slides: int) -> tuple[float, float, float]:
    if slides:
        return axis[j, 0], axis[j, 1], axis[j, 2]
    x = points[i, 0] - origin[0]
    y = points[i, 1] - origin[1]
    z = points[i, 2] - origin[2]
    return axis[j, 1] * z - axis[j, 2] * y, axis[j, 2] * x - axis[j, 0] * z, axis[j, 0] * y - axis[j, 1] * x
