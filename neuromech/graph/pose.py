"""Where segments and contacts are at time zero, and how far contacts are from the ground. In plain floats."""

from math import cos, hypot, sin, sqrt
from typing import Final

from neuromech.graph.model import BodyModel
from neuromech.graph.terrain import Terrain, terrain
from neuromech.spec.model import Joint

Vector = tuple[float, float, float]
Matrix = tuple[Vector, Vector, Vector]

# Share of its radius by which a sphere may stand in the ground at time zero.
_ALLOWED: Final = 0.1
# Shares of its radius at which the underside of a sphere is looked at, along x and along y.
_SHARES: Final = tuple(k / 10.0 for k in range(-10, 11))


def frames(body: BodyModel) -> dict[str, tuple[Matrix, Vector]]:
    """Return orientation and origin in m of each segment, at the initial angles and the first root pose."""
    x, y, z = map(float, body.root.position)
    found = {body.root_segment: (_root_rotation(*map(float, body.root.orientation)), (x, y, z))}
    for name in body.joints:
        joint = body.joints[name]
        found[joint.child] = _moved(*found[joint.parent], joint)
    return found


def contact_centers(body: BodyModel) -> dict[str, Vector]:
    """Return the centre of each contact sphere in the world in m, at the initial angles and the first root pose."""
    placed = frames(body)
    centers = {}
    for name, contact in body.contacts.items():
        rotation, origin = placed[contact.segment]
        centers[name] = added(origin, turned(rotation, contact.position))
    return centers


def clearances(body: BodyModel) -> dict[str, float]:
    """Return by how much in m each contact sphere can sink, upright, until it touches the ground; negative in it."""
    ground = body.world.ground
    if ground is None:
        return {}
    below = terrain(ground)
    centers = contact_centers(body)
    return {name: _clearance(below, centers[name], float(body.contacts[name].radius)) for name in body.contacts}


def sunk(body: BodyModel) -> tuple[str, float] | None:
    """Return the contact that starts deepest in the ground and its depth in m, None where all stand on or above it.

    A tenth of a sphere's radius counts as standing on it.
    """
    depths = {name: -gap - _ALLOWED * float(body.contacts[name].radius) for name, gap in clearances(body).items()}
    name = max(depths, key=depths.__getitem__, default="")
    return (name, -clearances(body)[name]) if name and depths[name] > 0.0 else None


def _clearance(below: Terrain, center: Vector, radius: float) -> float:
    x, y, z = center
    if below.plane is not None and not below.steps:
        return z - radius - below.plane[0]
    across = _SHARES if _near_step(below, x, y, radius) else (0.0,)
    gaps = (
        z - radius * sqrt(1.0 - min(1.0, u * u + v * v)) - below.height(x + radius * u, y + radius * v)
        for u in _SHARES
        for v in across
        if u * u + v * v <= 1.0
    )
    return min(gaps)


def _near_step(below: Terrain, x: float, y: float, radius: float) -> bool:
    return any(
        abs(x - middle) <= length + thickness + radius and low - radius <= y <= high + radius
        for middle, _, length, thickness, _, _, low, high in below.steps
    )


def _moved(rotation: Matrix, origin: Vector, joint: Joint) -> tuple[Matrix, Vector]:
    length = hypot(*joint.axis)
    x, y, z = (float(part) / length for part in joint.axis)
    angle = float(joint.initial_angle)
    at = (float(joint.position[0]), float(joint.position[1]), float(joint.position[2]))
    if joint.kind == "slide":
        return rotation, added(origin, turned(rotation, added(at, (angle * x, angle * y, angle * z))))
    return _product(rotation, _rotation(x, y, z, angle)), added(origin, turned(rotation, at))


def _root_rotation(roll: float, pitch: float, yaw: float) -> Matrix:
    heading = _product(_rotation(0.0, 0.0, 1.0, yaw), _rotation(0.0, 1.0, 0.0, pitch))
    return _product(heading, _rotation(1.0, 0.0, 0.0, roll))


def _rotation(x: float, y: float, z: float, angle: float) -> Matrix:
    """Return the rotation about a unit vector by Rodrigues' formula."""
    c, s = cos(angle), sin(angle)
    d = 1.0 - c
    return (
        (c + d * x * x, d * x * y - s * z, d * x * z + s * y),
        (d * x * y + s * z, c + d * y * y, d * y * z - s * x),
        (d * x * z - s * y, d * y * z + s * x, c + d * z * z),
    )


def _product(one: Matrix, other: Matrix) -> Matrix:
    first, second, third = (turned(one, column) for column in zip(*other, strict=True))
    return tuple(zip(first, second, third, strict=True))  # type: ignore[return-value]


def turned(rotation: Matrix, vector: Vector) -> Vector:
    """Return a vector turned by a rotation."""
    x, y, z = (row[0] * vector[0] + row[1] * vector[1] + row[2] * vector[2] for row in rotation)
    return x, y, z


def added(one: Vector, other: Vector) -> Vector:
    """Return the sum of two vectors."""
    return one[0] + other[0], one[1] + other[1], one[2] + other[2]
