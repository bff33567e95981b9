"""Building a PyBullet world: engine settings, ground, robot, its joints and links, checked after loading.

Traps that this file exists for: the base pose is that of the centre of mass; links have damping and joints have motors
by default; joints are cut off at 100 rad/s; an impossible inertia is replaced by zero with a mere warning.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import inf
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Final

import numpy as np
import pybullet

from neuromech.bodies.base import body_problem
from neuromech.bodies.urdf import CONTACT, PLANAR_JOINTS, urdf_text
from neuromech.errors import DocumentError, Problem
from neuromech.graph.model import BodyModel
from neuromech.spec.model import Contact

# Bullet cuts faster joints off without a word; a run that diverges shall be seen to diverge.
_MAXIMAL_JOINT_VELOCITY: Final = inf
# 5 to 200 iterations gave the same gaits.
_SOLVER_ITERATIONS: Final = 10
_INERTIA_TOLERANCE: Final = 1e-9


@dataclass(frozen=True, slots=True)
class BulletWorld:
    """A physics client and what lives in it, by Bullet's numbers.

    Args:
        client: the physics client.
        robot: the body.
        ground: the plane, None without one.
        joints: Bullet's joint number of each joint, in the body's order.
        root: of the three joints of a planar root, empty for other roots.
        contact_row: Bullet's link number of a contact -> its row among the body's contacts.
    """

    client: int
    robot: int
    ground: int | None
    joints: list[int]
    root: list[int]
    contact_row: dict[int, int]


def build_world(body: BodyModel, step: float) -> BulletWorld:
    """Connect a client and build the world of a body in it, everything at angle zero.

    Args:
        body: the body.
        step: in seconds.

    Raises:
        DocumentError: Bullet refuses the body.
    """
    client = pybullet.connect(pybullet.DIRECT)
    try:
        return _fill(client, body, step)
    except pybullet.error as error:
        pybullet.disconnect(physicsClientId=client)
        raise DocumentError([body_problem(f"PyBullet cannot load the body: {error}")]) from error
    except BaseException:
        pybullet.disconnect(physicsClientId=client)
        raise


def check_pybullet(body: BodyModel) -> None:
    """Check that Bullet can move a body.

    Raises:
        DocumentError: a joint has an armature (Bullet knows none), a contact has only one of stiffness and damping, or
            a planar root is not upright in the x–z plane.
    """
    problems = [*_armatures(body), *_half_soft_contacts(body), *_tilted_plane(body)]
    if problems:
        raise DocumentError(problems)


def _armatures(body: BodyModel) -> Iterator[Problem]:
    for name, joint in body.joints.items():
        if joint.armature > 0.0:
            message = f"joint '{name}' has an armature, and PyBullet knows none"
            yield body_problem(message, f"leave out armature of '{name}'")


def _half_soft_contacts(body: BodyModel) -> Iterator[Problem]:
    for name, contact in body.contacts.items():
        if (contact.stiffness is None) != (contact.damping is None):
            given = "damping" if contact.stiffness is None else "stiffness"
            yield body_problem(
                f"contact '{name}' has {given} only", "PyBullet needs both stiffness and damping, or none"
            )


def _tilted_plane(body: BodyModel) -> Iterator[Problem]:
    roll, _, yaw = body.root.orientation
    if body.root.kind == "planar" and (roll or yaw):
        yield body_problem("a planar root moves in the x–z plane, so its roll and yaw must be zero")


def _fill(client: int, body: BodyModel, step: float) -> BulletWorld:
    robot = _load(client, body)
    count = pybullet.getNumJoints(robot, physicsClientId=client)
    infos = [pybullet.getJointInfo(robot, index, physicsClientId=client) for index in range(count)]
    joints = {info[1].decode(): int(info[0]) for info in infos}
    links = {info[12].decode(): int(info[0]) for info in infos}
    if body.root.kind != "planar":
        links[body.root_segment] = -1
    _set_engine(client, body, step)
    _free_joints(client, robot, [info[0] for info in infos if info[2] != pybullet.JOINT_FIXED])
    _set_links(client, robot, body, links)
    return BulletWorld(
        client=client,
        robot=robot,
        ground=_add_ground(client, body),
        joints=[joints[name] for name in body.joints],
        root=[joints[name] for name in PLANAR_JOINTS if name in joints],
        contact_row={links[CONTACT + name]: row for row, name in enumerate(body.contacts)},
    )


def _load(client: int, body: BodyModel) -> int:
    with TemporaryDirectory(prefix="neuromech-") as folder:
        file = Path(folder, "body.urdf")
        file.write_text(urdf_text(body), encoding="utf-8")
        # Bullet keeps files by name; another body's file may have had this one.
        pybullet.setPhysicsEngineParameter(enableFileCaching=0, physicsClientId=client)
        robot: int = pybullet.loadURDF(
            str(file),
            useFixedBase=body.root.kind != "free",
            flags=pybullet.URDF_USE_INERTIA_FROM_FILE,
            physicsClientId=client,
        )
    return robot


def _set_engine(client: int, body: BodyModel, step: float) -> None:
    pybullet.setPhysicsEngineParameter(
        fixedTimeStep=step,
        numSubSteps=0,
        numSolverIterations=_SOLVER_ITERATIONS,
        deterministicOverlappingPairs=1,
        physicsClientId=client,
    )
    pybullet.setGravity(0.0, 0.0, -float(body.world.gravity), physicsClientId=client)


def _add_ground(client: int, body: BodyModel) -> int | None:
    ground = body.world.ground
    if ground is None:
        return None
    plane = pybullet.createCollisionShape(pybullet.GEOM_PLANE, physicsClientId=client)
    robot: int = pybullet.createMultiBody(
        0.0, plane, basePosition=(0.0, 0.0, float(ground.height)), physicsClientId=client
    )
    pybullet.changeDynamics(robot, -1, lateralFriction=float(ground.friction), restitution=0.0, physicsClientId=client)
    return robot


def _free_joints(client: int, robot: int, joints: list[int]) -> None:
    # A joint is born with a velocity motor that acts as friction.
    pybullet.setJointMotorControlArray(
        robot, joints, pybullet.VELOCITY_CONTROL, forces=[0.0] * len(joints), physicsClientId=client
    )


def _set_links(client: int, robot: int, body: BodyModel, links: Mapping[str, int]) -> None:
    for index in (-1, *links.values()):
        pybullet.changeDynamics(
            robot,
            index,
            linearDamping=0.0,
            angularDamping=0.0,
            jointDamping=0.0,
            restitution=0.0,
            rollingFriction=0.0,
            spinningFriction=0.0,
            maxJointVelocity=_MAXIMAL_JOINT_VELOCITY,
            physicsClientId=client,
        )
    for name, contact in body.contacts.items():
        _set_contact(client, robot, links[CONTACT + name], contact)
    for name in body.segments:
        if name != body.root_segment or body.root.kind != "fixed":  # What never moves has no mass in Bullet.
            _assert_inertia(client, robot, links[name], body, name)


def _set_contact(client: int, robot: int, link: int, contact: Contact) -> None:
    pybullet.changeDynamics(robot, link, lateralFriction=float(contact.friction), physicsClientId=client)
    if contact.stiffness is not None and contact.damping is not None:
        pybullet.changeDynamics(
            robot,
            link,
            contactStiffness=float(contact.stiffness),
            contactDamping=float(contact.damping),
            physicsClientId=client,
        )


def _assert_inertia(client: int, robot: int, link: int, body: BodyModel, name: str) -> None:
    # Bullet replaces an impossible inertia by zero and only warns.
    segment = body.segments[name]
    info = pybullet.getDynamicsInfo(robot, link, physicsClientId=client)
    wanted = (float(segment.mass), *map(float, segment.inertia))
    if not np.allclose((info[0], *info[2]), wanted, rtol=_INERTIA_TOLERANCE, atol=0.0):
        hint = "no principal moment of inertia may exceed the sum of the other two"
        raise DocumentError([body_problem(f"PyBullet refuses the inertia of segment '{name}'", hint)])
