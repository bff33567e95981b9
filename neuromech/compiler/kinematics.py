"""Positions and velocities of the segments of a tree. Compiled, without allocation, callable from compiled code."""

from math import asin, atan2

from neuromech.compiler.numerics import Floats, Integers, exact_part, exactly
from neuromech.compiler.sines import sine_and_cosine
from neuromech.compiler.tree import AXIS, HINGE, JOINT, KIND, PARENT, POSITION


@exactly
def forward_kinematics(
    topology: Integers, geometry: Floats, angles: Floats, root_pose: Floats, rotation: Floats, position: Floats
) -> None:
    """Fill the world orientation and the world position of every segment frame.

    Args:
        topology: see `Tree`.
        geometry: see `Tree`.
        angles: (joints,) joint angles in rad, displacements of slides in m.
        root_pose: (7,) position of the root frame in m, unit quaternion x, y, z, w.
        rotation: filled; (segments, 3, 3), its columns are the axes of the segment in the world.
        position: filled; (segments, 3) in m.
    """
    quaternion_rotation(root_pose[3], root_pose[4], root_pose[5], root_pose[6], rotation[0])
    for k in range(3):
        position[0, k] = root_pose[k]
    # All at once; they stand where the positions will be.
    for i in range(1, topology.shape[0]):
        position[i, 0], position[i, 1] = sine_and_cosine(angles[topology[i, JOINT]])
    for i in range(1, topology.shape[0]):
        parent = topology[i, PARENT]
        shift = 0.0
        if topology[i, KIND] == HINGE:
            a, b, c = geometry[i, AXIS], geometry[i, AXIS + 1], geometry[i, AXIS + 2]
            _turn(rotation[parent], a, b, c, position[i, 0], position[i, 1], rotation[i])
        else:
            _turn(rotation[parent], 1.0, 0.0, 0.0, 0.0, 1.0, rotation[i])
            shift = angles[topology[i, JOINT]]
        x = geometry[i, POSITION] + shift * geometry[i, AXIS]
        y = geometry[i, POSITION + 1] + shift * geometry[i, AXIS + 1]
        z = geometry[i, POSITION + 2] + shift * geometry[i, AXIS + 2]
        for k in range(3):
            moved = rotation[parent, k, 0] * x + rotation[parent, k, 1] * y + rotation[parent, k, 2] * z
            position[i, k] = position[parent, k] + moved


@exactly
def segment_velocities(
    topology: Integers,
    geometry: Floats,
    velocities: Floats,
    root_velocity: Floats,
    rotation: Floats,
    position: Floats,
    linear: Floats,
    angular: Floats,
) -> None:
    """Fill the world velocity of every segment frame's origin and the world angular velocity of every segment.

    Args:
        topology: see `Tree`.
        geometry: see `Tree`.
        velocities: (joints,) joint velocities in rad/s, of slides in m/s.
        root_velocity: (6,) linear velocity of the root frame's origin in m/s, angular velocity in rad/s, world axes.
        rotation: from `forward_kinematics`.
        position: from `forward_kinematics`.
        linear: filled; (segments, 3) in m/s.
        angular: filled; (segments, 3) in rad/s.
    """
    for k in range(3):
        linear[0, k] = root_velocity[k]
        angular[0, k] = root_velocity[3 + k]
    for i in range(1, topology.shape[0]):
        parent = topology[i, PARENT]
        speed = velocities[topology[i, JOINT]]
        turning = topology[i, KIND] == HINGE
        x = position[i, 0] - position[parent, 0]
        y = position[i, 1] - position[parent, 1]
        z = position[i, 2] - position[parent, 2]
        linear[i, 0] = linear[parent, 0] + angular[parent, 1] * z - angular[parent, 2] * y
        linear[i, 1] = linear[parent, 1] + angular[parent, 2] * x - angular[parent, 0] * z
        linear[i, 2] = linear[parent, 2] + angular[parent, 0] * y - angular[parent, 1] * x
        for k in range(3):
            along = speed * world_axis(geometry, rotation, i, k)
            angular[i, k] = angular[parent, k]
            if turning:
                angular[i, k] += along
            else:
                linear[i, k] += along


@exactly
def contact_positions(
    contact_segment: Integers, contact_position: Floats, rotation: Floats, position: Floats, centers: Floats
) -> None:
    """Fill the world position of the centre of every contact sphere; `centers` is (contacts, 3) in m."""
    for i in range(contact_segment.shape[0]):
        segment = contact_segment[i]
        for k in range(3):
            centers[i, k] = position[segment, k]
            for axis in range(3):
                centers[i, k] += rotation[segment, k, axis] * contact_position[i, axis]


@exactly
def roll_pitch_yaw(rotation: Floats) -> tuple[float, float, float]:
    """Return roll, pitch and yaw in rad of a (3, 3) rotation: R = Rz(yaw) Ry(pitch) Rx(roll), pitch in ±π/2."""
    pitch = asin(min(1.0, max(-1.0, -rotation[2, 0])))
    return atan2(rotation[2, 1], rotation[2, 2]), pitch, atan2(rotation[1, 0], rotation[0, 0])


@exactly
def quaternion_rotation(x: float, y: float, z: float, w: float, rotation: Floats) -> None:
    """Fill the (3, 3) rotation of a unit quaternion."""
    rotation[0, 0] = 1.0 - 2.0 * (y * y + z * z)
    rotation[0, 1] = 2.0 * (x * y - z * w)
    rotation[0, 2] = 2.0 * (x * z + y * w)
    rotation[1, 0] = 2.0 * (x * y + z * w)
    rotation[1, 1] = 1.0 - 2.0 * (x * x + z * z)
    rotation[1, 2] = 2.0 * (y * z - x * w)
    rotation[2, 0] = 2.0 * (x * z - y * w)
    rotation[2, 1] = 2.0 * (y * z + x * w)
    rotation[2, 2] = 1.0 - 2.0 * (x * x + y * y)


@exact_part
def world_axis(geometry: Floats, rotation: Floats, segment: int, k: int) -> float:
    """Return component `k` of a segment's joint axis in world axes."""
    component: float = (
        rotation[segment, k, 0] * geometry[segment, AXIS]
        + rotation[segment, k, 1] * geometry[segment, AXIS + 1]
        + rotation[segment, k, 2] * geometry[segment, AXIS + 2]
    )
    return component


@exact_part
def _turn(parent: Floats, x: float, y: float, z: float, s: float, c: float, rotation: Floats) -> None:
    # Rodrigues' formula with sine and cosine of the angle, multiplied onto the parent's orientation.
    d = 1.0 - c
    for k in range(3):
        a = parent[k, 0]
        b = parent[k, 1]
        e = parent[k, 2]
        rotation[k, 0] = a * (c + d * x * x) + b * (d * x * y + s * z) + e * (d * x * z - s * y)
        rotation[k, 1] = a * (d * x * y - s * z) + b * (c + d * y * y) + e * (d * y * z + s * x)
        rotation[k, 2] = a * (d * x * z + s * y) + b * (d * y * z - s * x) + e * (c + d * z * z)
