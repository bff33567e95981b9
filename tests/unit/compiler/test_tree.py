"""The tree's kinematics and inertia against what they mean: geometry, energy, and an engine written by others."""

import numpy as np
import pybullet
import pytest

from neuromech.bodies.pybullet import PyBulletBody
from neuromech.compiler.dynamics import mass_matrix
from neuromech.compiler.kinematics import (
    contact_positions,
    forward_kinematics,
    quaternion_rotation,
    roll_pitch_yaw,
    segment_velocities,
)
from neuromech.compiler.tree import HINGE, SLIDE, lower_tree
from neuromech.graph.model import BodyModel
from neuromech.spec.model import Contact, Joint, Root
from neuromech.spec.world import World
from neuromech.testing.body_models import segment, vector
from neuromech.units import Quantity


def random_body(seed, root="fixed", armature=0.0, count=8):
    """A branched tree with oblique axes, one slide, and joints listed in another order than segments."""
    rng = np.random.default_rng(seed)

    def random_segment(mass):
        a, b = rng.uniform(1e-3, 2e-3, 2)
        return segment(mass, (a, b, 0.9 * (a + b)), rng.uniform(-0.1, 0.1, 3))

    segments, joints = {"trunk": random_segment(4.0)}, {}
    for number in range(count):
        parent = list(segments)[rng.integers(len(segments))]
        segments[f"s{number}"] = random_segment(0.2)
        joints[f"j{number}"] = Joint(
            kind="slide" if number == 5 else "hinge",
            parent=parent,
            child=f"s{number}",
            position=vector(*rng.uniform(-0.2, 0.2, 3)),
            axis=vector(*rng.normal(size=3)),
            initial_angle=Quantity(rng.uniform(-1.0, 1.0)),
            armature=Quantity(armature),
        )
    orientation = (0.0, 0.4, 0.0) if root == "planar" else (0.3, 0.4, -0.5)
    return BodyModel(
        engine="pybullet",
        file=None,
        root=Root(kind=root, position=vector(0.1, 0.2, 3.0), orientation=vector(*orientation)),
        root_segment="trunk",
        segments=segments,
        joints=dict(reversed(joints.items())),
        contacts={"toe": Contact(segment="s3", position=vector(0.1, 0.2, 0.3), radius=Quantity(0.01))},
        world=World(),
    )


def pose_of(tree, angles, root_pose):
    rotation, position = np.zeros((len(tree.segments), 3, 3)), np.zeros((len(tree.segments), 3))
    forward_kinematics(tree.topology, tree.geometry, angles, root_pose, rotation, position)
    return rotation, position


def inertia_of(tree, angles, root_pose):
    return mass_matrix(tree, *pose_of(tree, angles, root_pose))


def random_state(seed, joints):
    rng = np.random.default_rng(seed)
    quaternion = rng.normal(size=4)
    pose = np.concatenate([rng.normal(size=3), quaternion / np.linalg.norm(quaternion)])
    return rng.uniform(-1.0, 1.0, joints), pose, rng.normal(size=joints), rng.normal(size=6)


def velocities_of(tree, angles, pose, velocities, root_velocity):
    rotation, position = pose_of(tree, angles, pose)
    linear, angular = np.zeros_like(position), np.zeros_like(position)
    segment_velocities(tree.topology, tree.geometry, velocities, root_velocity, rotation, position, linear, angular)
    return rotation, position, linear, angular


def kinetic_energy(tree, rotation, linear, angular):
    energy = 0.0
    for row in range(len(tree.segments)):
        turned = rotation[row].T @ angular[row]
        velocity = linear[row] + np.cross(angular[row], rotation[row] @ tree.center_of_mass[row])
        energy += 0.5 * tree.mass[row] * velocity @ velocity + 0.5 * tree.inertia[row] @ turned**2
    return energy


def bullet_matrix(body):
    """Bullet's mass matrix with the root's motion eliminated, in the order of our joints."""
    with PyBulletBody(body, 1e-3, "python") as opened:
        world, client = opened._motion.world, opened._motion.client.number
        state = np.zeros(opened.layout.size)
        opened.read(state)
        moving = sorted(joint.number for joint in world.joints + world.root)
        angles = [s[0] for s in pybullet.getJointStates(world.robot, moving, physicsClientId=client)]
        full = np.array(pybullet.calculateMassMatrix(world.robot, angles, physicsClientId=client))
    first = len(full) - len(moving)
    order = [*range(first), *(first + moving.index(joint.number) for joint in world.root + world.joints)]
    full = full[np.ix_(order, order)]
    root = first + len(world.root)
    joints = full[root:, root:]
    if root:
        joints = joints - full[root:, :root] @ np.linalg.solve(full[:root, :root], full[:root, root:])
    return joints, state[opened.layout.angles], state[opened.layout.root_pose]


@pytest.mark.parametrize("root", ["fixed", "planar", "free"])
@pytest.mark.parametrize("seed", [1, 2])
def test_mass_matrix_is_that_of_bullet(root, seed):
    body = random_body(seed, root)
    expected, angles, pose = bullet_matrix(body)
    found = inertia_of(lower_tree(body), angles, pose)
    assert np.abs(found - expected).max() <= 1e-9 * np.abs(expected).max()


@pytest.mark.parametrize("root", ["fixed", "planar", "free"])
def test_mass_matrix_is_symmetric_and_positive_definite(root):
    tree = lower_tree(random_body(3, root))
    for seed in range(5):
        angles, pose, *_ = random_state(seed, len(tree.joints))
        if root == "planar":
            pose = np.array([0.1, 0.2, 0.3, 0.0, np.sin(0.3), 0.0, np.cos(0.3)])
        inertia = inertia_of(tree, angles, pose)
        assert np.array_equal(inertia, inertia.T)
        assert np.linalg.eigvalsh(inertia).min() > 0.0


def test_mass_matrix_gives_the_kinetic_energy():
    tree = lower_tree(random_body(4))
    angles, pose, velocities, _ = random_state(0, len(tree.joints))
    rotation, _, linear, angular = velocities_of(tree, angles, pose, velocities, np.zeros(6))
    energy = 0.5 * velocities @ inertia_of(tree, angles, pose) @ velocities
    assert energy == pytest.approx(kinetic_energy(tree, rotation, linear, angular), rel=1e-12)


def test_a_free_root_takes_the_velocity_of_least_kinetic_energy():
    # Without outer forces the root moves such that its momentum is zero, which minimises the kinetic energy.
    tree = lower_tree(random_body(5, "free"))
    angles, pose, velocities, _ = random_state(0, len(tree.joints))

    def energy(root_velocity):
        rotation, _, linear, angular = velocities_of(tree, angles, pose, velocities, root_velocity)
        return kinetic_energy(tree, rotation, linear, angular)

    unit = np.eye(6)
    base = energy(np.zeros(6))
    gradient = np.array([(energy(u) - energy(-u)) / 2 for u in unit])
    hessian = np.array([[energy(u + v) - energy(u) - energy(v) + base for v in unit] for u in unit])
    least = base - 0.5 * gradient @ np.linalg.solve(hessian, gradient)
    assert 0.5 * velocities @ inertia_of(tree, angles, pose) @ velocities == pytest.approx(least, rel=1e-9)


def test_armature_adds_to_the_diagonal_only():
    angles, pose, *_ = random_state(0, 8)
    plain = inertia_of(lower_tree(random_body(6, "free")), angles, pose)
    heavy = inertia_of(lower_tree(random_body(6, "free", armature=0.01)), angles, pose)
    assert heavy - plain == pytest.approx(0.01 * np.eye(8), abs=1e-15)


def test_velocities_are_the_rates_of_positions_and_orientations():
    tree = lower_tree(random_body(7))
    angles, pose, velocities, _ = random_state(1, len(tree.joints))
    rotation, _, linear, angular = velocities_of(tree, angles, pose, velocities, np.zeros(6))
    h = 1e-6
    before, after = pose_of(tree, angles - h * velocities, pose), pose_of(tree, angles + h * velocities, pose)
    assert (after[1] - before[1]) / (2 * h) == pytest.approx(linear, abs=1e-8)
    spin = np.einsum("sij,skj->sik", (after[0] - before[0]) / (2 * h), rotation)
    found = np.stack([spin[:, 2, 1], spin[:, 0, 2], spin[:, 1, 0]], axis=1)
    assert found == pytest.approx(angular, abs=1e-8)


def test_root_velocity_moves_all_segments_as_one_rigid_body():
    tree = lower_tree(random_body(8, "free"))
    angles, pose, _, root_velocity = random_state(2, len(tree.joints))
    _, position, linear, angular = velocities_of(tree, angles, pose, np.zeros(8), root_velocity)
    turned = np.cross(root_velocity[3:], position - position[0])
    assert linear == pytest.approx(root_velocity[:3] + turned, abs=1e-12)
    assert (angular == root_velocity[3:]).all()


def test_segments_stand_where_bullet_has_them():
    body = random_body(9, "free")
    with PyBulletBody(body, 1e-3, "python") as opened:
        state = np.zeros(opened.layout.size)
        opened.read(state)
        world, client = opened._motion.world, opened._motion.client.number
        places = {}
        for number in range(pybullet.getNumJoints(world.robot, physicsClientId=client)):
            name = pybullet.getJointInfo(world.robot, number, physicsClientId=client)[12].decode()
            places[name] = pybullet.getLinkState(world.robot, number, physicsClientId=client)[4]
    tree = lower_tree(body)
    rotation, position = pose_of(tree, state[opened.layout.angles], state[opened.layout.root_pose])
    centers = np.zeros((1, 3))
    contact_positions(tree.contact_segment, tree.contact_position, rotation, position, centers)
    # PyBullet reports frames of links to single precision only.
    assert np.array([places[name] for name in tree.segments[1:]]) == pytest.approx(position[1:], abs=1e-6)
    assert np.array(places["contact:toe"]) == pytest.approx(centers[0], abs=1e-6)
    assert position[0].tolist() == pytest.approx([0.1, 0.2, 3.0], abs=1e-12)


def test_roll_pitch_yaw_turn_about_x_then_y_then_z():
    rotation = np.zeros((3, 3))
    half = np.array([0.3, -1.1, 2.5]) / 2
    quaternion = pybullet.getQuaternionFromEuler((2 * half).tolist())
    quaternion_rotation(*quaternion, rotation)
    assert roll_pitch_yaw(rotation) == pytest.approx((0.3, -1.1, 2.5), abs=1e-12)


def test_columns_have_their_names():
    body = random_body(10, armature=0.02)
    tree = lower_tree(body)
    row = tree.segments.index("s5")
    joint = body.joints["j5"]
    assert tree.joints[tree.joint[row]] == "j5"
    assert tree.segments[tree.parent[row]] == joint.parent
    assert (tree.kind[row], tree.kind[1]) == (SLIDE, HINGE)
    assert tree.joint_position[row].tolist() == list(joint.position)
    assert np.cross(tree.axis[row], joint.axis) == pytest.approx(0.0, abs=1e-15)
    assert np.linalg.norm(tree.axis[1:], axis=1) == pytest.approx(1.0)
    assert tree.mass[row] == 0.2
    assert tree.inertia[row].tolist() == list(body.segments["s5"].inertia)
    assert tree.center_of_mass[row].tolist() == list(body.segments["s5"].center_of_mass)
    assert tree.armature.tolist() == [0.0] + [0.02] * 8
    assert (tree.contact_segment.tolist(), tree.contact_radius.tolist()) == ([tree.segments.index("s3")], [0.01])


def test_a_joint_without_direction_is_refused():
    body = random_body(11)
    body.joints["j2"] = body.joints["j2"].model_copy(update={"axis": vector(0.0, 0.0, 0.0)})
    with pytest.raises(ValueError, match="axis of joint 'j2' has no direction"):
        lower_tree(body)


def test_a_segment_without_joint_is_refused():
    body = random_body(12)
    del body.joints["j7"]
    with pytest.raises(ValueError, match="segment 's7' hangs on no joint"):
        lower_tree(body)


def test_a_body_without_contacts_or_joints_lowers():
    body = random_body(13, count=0)
    body.contacts.clear()
    tree = lower_tree(body)
    assert tree.contact_position.shape == (0, 3)
    assert inertia_of(tree, np.zeros(0), np.array([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0])).shape == (0, 0)
