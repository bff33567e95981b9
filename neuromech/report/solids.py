"""What a body looks like: a coloured solid for each segment and each contact, and how large all of it is."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from matplotlib.colors import to_rgb

from neuromech.analyse.windows import Array
from neuromech.graph.model import BodyModel
from neuromech.report.layout import BLUE, RED
from neuromech.report.meshes import Mesh, box, capsule
from neuromech.report.replay import Poses
from neuromech.report.weights import Swing
from neuromech.spec.model import BoxShape, CapsuleShape, Segment

Color = tuple[float, float, float]

LEFT, MIDDLE, RIGHT = to_rgb(RED), (0.72, 0.69, 0.66), to_rgb(BLUE)
LIFTED, LOADED = (0.25, 0.25, 0.25), (0.94, 0.89, 0.26)

WEIGHT = (0.35, 0.71, 0.91)

_STRING = 0.08
"""Radius of a string, in radii of its weight."""

_ROD = 0.02
"""Radius of the rods that stand for a segment without a shape, in body sizes."""

_OFF_MIDDLE = 0.02
"""How far from the middle plane a segment belongs to a side, in body sizes."""

_ONE_PIECE = 1e3
"""Length (m) that no side of a segment's box reaches."""


@dataclass(frozen=True, slots=True)
class Solid:
    """A coloured mesh in the frame of a segment, by its row in `Poses`."""

    segment: int
    mesh: Mesh
    color: Color


def segment_solids(body: BodyModel, poses: Poses, size: float) -> list[Solid]:
    """Return the solids of all segments: left legs orange, right legs blue, what is in the middle grey.

    A segment without a shape is shown as rods from its joint to what it carries. In a body whose legs all stand in the
    middle, as that of a planar walker, legs called `left` and `right` are coloured by their names.

    Args:
        body: the body.
        poses: of which the first tells what is left and right.
        size: of the body, in m.
    """
    return [
        Solid(row, mesh, _color(poses, row, size, name))
        for row, (name, segment) in enumerate(body.segments.items())
        for mesh in _meshes(body, name, segment, size)
    ]


def contact_meshes(body: BodyModel) -> list[Mesh]:
    """Return the sphere of each contact around the origin."""
    origin = np.zeros(3)
    return [capsule(origin, origin, float(contact.radius)) for contact in body.contacts.values()]


def weight_solids(swing: Swing) -> list[tuple[Mesh, Color]]:
    """Return a weight around the origin and its string, which goes straight up from it."""
    origin, top = np.zeros(3), np.array([0.0, 0.0, float(swing.pendulum.string)])
    radius = float(swing.pendulum.radius)
    weight, string = capsule(origin, origin, radius), capsule(origin, top, _STRING * radius)
    return [(weight, WEIGHT), (string, LIFTED)]


def body_size(body: BodyModel, poses: Poses) -> float:
    """Return the diagonal (m) of the box that holds the first pose's joints, contacts and boxes."""
    diagonal = float(np.linalg.norm(np.ptp(outline(body, poses)[0], axis=0)))
    return diagonal or 1.0


def outline(body: BodyModel, poses: Poses) -> Array:
    """Return the joints and contacts of a body and the ends of its solids in each pose, in m; (n, points, 3)."""
    ends = [
        poses.position[:, row] + poses.rotation[:, row] @ point
        for row, segment in enumerate(body.segments.values())
        for point in _outline(segment)
    ]
    return np.concatenate((poses.position, poses.contact, np.stack(ends, axis=1)), axis=1)


def _outline(segment: Segment) -> Iterator[Array]:
    if isinstance(segment.shape, CapsuleShape):
        yield from (np.array(segment.shape.start), np.array(segment.shape.end))
    elif isinstance(segment.shape, BoxShape):
        half, middle = 0.5 * np.array(segment.shape.size), np.array(segment.shape.position)
        yield from (middle - half, middle + half)
    else:
        yield np.array(segment.center_of_mass)


def _meshes(body: BodyModel, name: str, segment: Segment, size: float) -> Iterator[Mesh]:
    shape = segment.shape
    if isinstance(shape, CapsuleShape):
        yield capsule(np.array(shape.start), np.array(shape.end), float(shape.radius))
    elif isinstance(shape, BoxShape):
        yield box(np.array(shape.size), _ONE_PIECE).moved(np.eye(3), np.array(shape.position))
    else:
        ends = _carried(body, name) or [2.0 * np.array(segment.center_of_mass)]
        yield from (capsule(np.zeros(3), end, _ROD * size) for end in ends)


def _carried(body: BodyModel, name: str) -> list[Array]:
    """Return where joints and contacts of a segment are in its frame, each shape (3,) (m)."""
    joints = [joint.position for joint in body.joints.values() if joint.parent == name]
    contacts = [contact.position for contact in body.contacts.values() if contact.segment == name]
    return [np.array(position, dtype=np.float64) for position in (*joints, *contacts)]


def _color(poses: Poses, row: int, size: float, name: str) -> Color:
    """Return the colour of the side of the root that a segment hangs on."""
    seen = poses.rotation[0, 0].T @ (poses.position[0, row] - poses.position[0, 0])
    if abs(seen[1]) < _OFF_MIDDLE * size:
        return {"left": LEFT, "right": RIGHT}.get(name.partition(".")[0], MIDDLE)
    return LEFT if seen[1] > 0.0 else RIGHT
