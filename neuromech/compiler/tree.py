"""A body as a tree of rigid segments in flat arrays, ready for compiled kinematics and dynamics."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Final

import numpy as np

from neuromech.compiler.numerics import Floats, Integers
from neuromech.graph.model import BodyModel

HINGE: Final = 1
SLIDE: Final = 2
FIXED_ROOT: Final = 0
PLANAR_ROOT: Final = 3
FREE_ROOT: Final = 6

# Columns of `Tree.topology`.
PARENT: Final = 0
JOINT: Final = 1
KIND: Final = 2
# First columns of `Tree.geometry`.
POSITION: Final = 0
AXIS: Final = 3
MASS: Final = 6
CENTER: Final = 7
INERTIA: Final = 10
ARMATURE: Final = 13
COLUMNS: Final = 14
# Columns of the work array of the inertia, and the rows that it needs beside one per segment.
WORK_COLUMNS: Final = 22
WORK_ROWS: Final = 6

_KINDS = {"hinge": HINGE, "slide": SLIDE}
_ROOTS = {"fixed": FIXED_ROOT, "planar": PLANAR_ROOT, "free": FREE_ROOT}


@dataclass(frozen=True)
class Tree:
    """A rigid-body tree. Segment 0 is the root; a parent comes before its children. All in SI units.

    Compiled functions take `topology` and `geometry` as they are; the properties give their columns by name.

    Args:
        segments: names, in the order of the rows of `topology` and `geometry`.
        joints: names, in the order of joint angles everywhere.
        contacts: names, in the order of contact forces everywhere.
        topology: (segments, 3): row of the parent (−1 for the root), index of the joint to it (−1 for the root),
            and its kind, `HINGE` or `SLIDE` (0 for the root).
        geometry: (segments, 14): joint position in the parent's frame (3), joint axis as a unit vector (3), mass,
            centre of mass (3), principal moments of inertia about it (3), armature of the joint.
        root: number of ways the root can move: `FIXED_ROOT`, `PLANAR_ROOT` (x, z and rotation about y) or `FREE_ROOT`.
        contact_segment: (contacts,) row of the segment that carries the contact.
        contact_position: (contacts, 3) centre of the contact sphere in the segment's frame.
        contact_radius: (contacts,) radius of the contact sphere.
    """

    segments: tuple[str, ...]
    joints: tuple[str, ...]
    contacts: tuple[str, ...]
    topology: Integers
    geometry: Floats
    root: int
    contact_segment: Integers
    contact_position: Floats
    contact_radius: Floats

    @property
    def parent(self) -> Integers:
        """Row of each segment's parent, −1 for the root; (segments,)."""
        return self.topology[:, PARENT]

    @property
    def joint(self) -> Integers:
        """Index of the joint between each segment and its parent, −1 for the root; (segments,)."""
        return self.topology[:, JOINT]

    @property
    def kind(self) -> Integers:
        """`HINGE` or `SLIDE` for the joint of each segment, 0 for the root; (segments,)."""
        return self.topology[:, KIND]

    @property
    def joint_position(self) -> Floats:
        """Position of each segment's joint in its parent's frame in metres; (segments, 3)."""
        return self.geometry[:, POSITION:AXIS]

    @property
    def axis(self) -> Floats:
        """Unit vector of each segment's joint axis; (segments, 3)."""
        return self.geometry[:, AXIS:MASS]

    @property
    def mass(self) -> Floats:
        """Mass of each segment in kg; (segments,)."""
        return self.geometry[:, MASS]

    @property
    def center_of_mass(self) -> Floats:
        """Centre of mass in the segment's frame in metres; (segments, 3)."""
        return self.geometry[:, CENTER:INERTIA]

    @property
    def inertia(self) -> Floats:
        """Principal moments of inertia about the centre of mass in kg m²; (segments, 3)."""
        return self.geometry[:, INERTIA:ARMATURE]

    @property
    def armature(self) -> Floats:
        """Armature of each segment's joint in kg m²; (segments,)."""
        return self.geometry[:, ARMATURE]

    def new_work(self) -> Floats:
        """Return a work array for `inertia_of_all`; (segments + 6, 22)."""
        return np.zeros((len(self.segments) + WORK_ROWS, WORK_COLUMNS))


def lower_tree(body: BodyModel) -> Tree:
    """Turn a body into flat arrays.

    Raises:
        ValueError: a segment hangs on no joint or comes before its parent, or a joint axis has no direction.
    """
    segments = tuple(body.segments)
    topology, geometry = _segment_rows(body, segments)
    return Tree(
        segments=segments,
        joints=tuple(body.joints),
        contacts=tuple(body.contacts),
        topology=topology,
        geometry=geometry,
        root=_ROOTS[body.root.kind],
        contact_segment=np.array([segments.index(c.segment) for c in body.contacts.values()], dtype=np.int64),
        contact_position=_vectors(c.position for c in body.contacts.values()),
        contact_radius=np.array([float(c.radius) for c in body.contacts.values()]),
    )


def _segment_rows(body: BodyModel, segments: tuple[str, ...]) -> tuple[Integers, Floats]:
    if segments[0] != body.root_segment:
        raise ValueError(f"segment '{segments[0]}' comes before the root segment '{body.root_segment}'")
    topology = np.zeros((len(segments), 3), dtype=np.int64)
    geometry = np.zeros((len(segments), COLUMNS))
    topology[0] = (-1, -1, 0)
    for row, segment in enumerate(body.segments.values()):
        geometry[row, MASS] = segment.mass
        geometry[row, CENTER:INERTIA] = segment.center_of_mass
        geometry[row, INERTIA:ARMATURE] = segment.inertia
    place = {name: row for row, name in enumerate(segments)}
    incoming = {joint.child: index for index, joint in enumerate(body.joints.values())}
    joints = list(body.joints.items())
    for row, segment_name in enumerate(segments[1:], start=1):
        if segment_name not in incoming:
            raise ValueError(f"segment '{segment_name}' hangs on no joint")
        index = incoming[segment_name]
        name, joint = joints[index]
        if place[joint.parent] >= row:
            raise ValueError(f"segment '{segment_name}' comes before its parent '{joint.parent}'")
        topology[row] = (place[joint.parent], index, _KINDS[joint.kind])
        geometry[row, POSITION:AXIS] = joint.position
        geometry[row, AXIS:MASS] = unit_vector(joint.axis, name)
        geometry[row, ARMATURE] = joint.armature
    return topology, geometry


def unit_vector(axis: tuple[float, float, float], joint: str) -> Floats:
    """Return the direction of a joint axis as a unit vector; (3,).

    Raises:
        ValueError: the axis is zero.
    """
    vector = np.array(axis, dtype=np.float64)
    length = float(np.linalg.norm(vector))
    if length == 0.0:
        raise ValueError(f"the axis of joint '{joint}' has no direction")
    return vector / length


def _vectors(vectors: Iterable[tuple[float, float, float]]) -> Floats:
    return np.array([[float(x) for x in vector] for vector in vectors], dtype=np.float64).reshape(-1, 3)
