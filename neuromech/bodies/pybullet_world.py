"""Building a Bullet world: engine settings, ground, robot, its joints and links, checked after loading.

Traps that this file exists for: the base pose is that of the centre of mass; links have damping and joints have motors
by default; joints are cut off at 100 rad/s; an impossible inertia is replaced by zero with a mere warning.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby
from math import cos, inf, sin
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Final

import numpy as np

from neuromech.bodies.base import Floats, body_problem, root_quaternion
from neuromech.bodies.bullet_client import MOST_BOXES, BulletBox, BulletClient, BulletError, BulletJoint
from neuromech.bodies.urdf import CONTACT, PLANAR_JOINTS, urdf_text
from neuromech.errors import DocumentError
from neuromech.graph.engines import refusals
from neuromech.graph.model import BodyModel
from neuromech.graph.swing import first_place
from neuromech.graph.terrain import Box, Terrain, terrain
from neuromech.spec.model import Contact

Vector = tuple[float, float, float]

# 5 to 200 iterations gave the same gaits.
_SOLVER_ITERATIONS: Final = 10
_INERTIA_TOLERANCE: Final = 1e-9
_GAP: Final = 0.05
# Groups of collisions, beside those that Bullet has for all else: weights, and segments that they hit.
_WEIGHTS: Final = 64
_HIT: Final = 128
_FREE: Final = {
    "linearDamping": 0.0,
    "angularDamping": 0.0,
    "jointDamping": 0.0,
    "restitution": 0.0,
    "rollingFriction": 0.0,
    "spinningFriction": 0.0,
    # Bullet cuts faster joints off without a word; a run that diverges shall be seen to diverge.
    "maxJointVelocity": inf,
}


@dataclass(frozen=True, slots=True)
class BulletWorld:
    """What lives in a world, by Bullet's numbers.

    Args:
        robot: the body.
        plane: the ground where it is a plane, None where it is anything else.
        joints: in the body's order.
        root: the three joints of a planar root, empty for other roots.
        free: whether the root moves freely.
        root_pose: first position in m and orientation x, y, z, w of the root frame.
        center: centre of mass of the root segment in its frame, in m.
        links: robot and Bullet's link number of each segment, −1 of a root link; then each weight on a string.
        weights: the weights on strings.
        contact_row: Bullet's link number of a contact -> its row among the body's contacts.
        clear_heights: for each contact, in m, how high its centre must be for Bullet to see nothing of the ground.
    """

    robot: int
    plane: int | None
    joints: list[BulletJoint]
    root: list[BulletJoint]
    free: bool
    root_pose: tuple[float, ...]
    center: Vector
    links: list[tuple[int, int]]
    weights: list[int]
    contact_row: dict[int, int]
    clear_heights: list[float]


def build_world(client: BulletClient, body: BodyModel, step: float) -> BulletWorld:
    """Build the world of a body in a new client, everything at angle zero and the root at the origin.

    Args:
        client: without a world.
        body: the body.
        step: in seconds.

    Raises:
        DocumentError: Bullet refuses the body.
    """
    try:
        robot = _load(client, body)
    except BulletError as error:
        raise DocumentError([body_problem(f"PyBullet cannot load the body: {error}")]) from error
    every = client.joints(robot)
    links = {joint.link: joint.number for joint in every}
    if body.root.kind != "planar":
        links[body.root_segment] = -1
    client.set_engine(step, _SOLVER_ITERATIONS, float(body.world.gravity))
    # A joint is born with a velocity motor that acts as friction.
    client.stop_motors(robot, [joint for joint in every if joint.moves])
    _set_links(client, robot, body, links)
    named = {joint.name: joint for joint in every}
    x, y, z = body.segments[body.root_segment].center_of_mass
    weights = _add_weights(client, robot, body, links)
    ground = None if body.world.ground is None else terrain(body.world.ground)
    return BulletWorld(
        robot=robot,
        plane=_add_ground(client, ground),
        joints=[named[name] for name in body.joints],
        root=[named[name] for name in PLANAR_JOINTS if name in named],
        free=body.root.kind == "free",
        root_pose=(*map(float, body.root.position), *root_quaternion(body.root)),
        center=(float(x), float(y), float(z)),
        links=[*((robot, links[name]) for name in body.segments), *((weight, -1) for weight in weights)],
        weights=weights,
        contact_row={links[CONTACT + name]: row for row, name in enumerate(body.contacts)},
        clear_heights=_clear_heights(body, ground),
    )


def put(
    client: BulletClient,
    world: BulletWorld,
    body: BodyModel,
    angles: Sequence[float] | Floats,
    velocities: Sequence[float] | Floats,
) -> None:
    """Put the root to its first pose and the joints as told."""
    x, y, z, *quaternion = world.root_pose
    if world.root:
        places = (x, z, float(body.root.orientation[1]))
        speeds = (body.motion.root[0], body.motion.root[2], 0.0)
        for joint, place, speed in zip(world.root, places, speeds, strict=True):
            client.put_joint(world.robot, joint.number, place, float(speed))
    else:
        a, b, c = rotated(quaternion, world.center)
        client.put_root(world.robot, (x + a, y + b, z + c), quaternion, body.motion.root if world.free else (0.0,) * 3)
    for joint, angle, velocity in zip(world.joints, angles, velocities, strict=True):
        client.put_joint(world.robot, joint.number, float(angle), float(velocity))


def rotated(quaternion: Sequence[float], vector: Sequence[float]) -> Vector:
    """Return a vector turned by a unit quaternion x, y, z, w."""
    x, y, z, w = quaternion
    a, b, c = vector
    across = (2.0 * (y * c - z * b), 2.0 * (z * a - x * c), 2.0 * (x * b - y * a))
    return (
        a + w * across[0] + y * across[2] - z * across[1],
        b + w * across[1] + z * across[0] - x * across[2],
        c + w * across[2] + x * across[1] - y * across[0],
    )


def check_pybullet(body: BodyModel) -> None:
    """Check that Bullet can move a body.

    Raises:
        DocumentError: there is something in it that Bullet does not know, see `neuromech.graph.engines`.
    """
    problems = [body_problem(refusal.message, refusal.hint) for refusal in refusals(body, "pybullet")]
    if problems:
        raise DocumentError(problems)


def _load(client: BulletClient, body: BodyModel) -> int:
    with TemporaryDirectory(prefix="neuromech-") as folder:
        file = Path(folder, "body.urdf")
        file.write_text(urdf_text(body), encoding="utf-8")
        return client.load(file, fixed=body.root.kind != "free")


def _add_ground(client: BulletClient, ground: Terrain | None) -> int | None:
    """Add the ground and return the plane where it is nothing but a plane."""
    if ground is None:
        return None
    pieces = [] if ground.plane is None else [(client.add_plane(ground.plane[0]), ground.plane[1])]
    for some, friction in _alike(ground.boxes):
        pieces.append((client.add_boxes(some), friction))
    for piece, friction in pieces:
        client.set_dynamics(piece, -1, {"lateralFriction": friction, "restitution": 0.0})
    return pieces[0][0] if ground.plane is not None and not ground.boxes else None


def _add_weights(client: BulletClient, robot: int, body: BodyModel, links: Mapping[str, int]) -> list[int]:
    weights = []
    for pendulum in body.world.pendulums.values():
        weight = client.add_ball(float(pendulum.radius), float(pendulum.mass), first_place(body, pendulum))
        client.set_dynamics(weight, -1, _FREE | {"lateralFriction": 0.0})
        client.set_partners(weight, -1, _WEIGHTS, _HIT)
        client.set_partners(robot, links[pendulum.segment], _HIT, _WEIGHTS)
        weights.append(weight)
    return weights


def _alike(boxes: Sequence[Box]) -> Iterator[tuple[list[BulletBox], float]]:
    """Yield neighbouring boxes of one friction together: every thing by itself costs Bullet time at each step."""
    for friction, some in groupby(boxes, key=lambda box: box.friction):
        alike = [BulletBox(box.size, box.center, (0.0, -sin(box.angle / 2), 0.0, cos(box.angle / 2))) for box in some]
        for first in range(0, len(alike), MOST_BOXES):
            yield alike[first : first + MOST_BOXES], friction


def _clear_heights(body: BodyModel, ground: Terrain | None) -> list[float]:
    # Bullet keeps contact points up to a gap of 0.02 m, for a sphere of more than 1 m in radius 0.02 radii.
    if ground is None:
        return [-inf] * len(body.contacts)
    radii = (float(contact.radius) for contact in body.contacts.values())
    return [ground.highest + radius + _GAP * max(1.0, radius) for radius in radii]


def _set_links(client: BulletClient, robot: int, body: BodyModel, links: Mapping[str, int]) -> None:
    for link in (-1, *links.values()):
        client.set_dynamics(robot, link, _FREE)
    for name, contact in body.contacts.items():
        _set_contact(client, robot, links[CONTACT + name], contact)
    for name in body.segments:
        if name != body.root_segment or body.root.kind != "fixed":  # What never moves has no mass in Bullet.
            _assert_inertia(client, robot, links[name], body, name)


def _set_contact(client: BulletClient, robot: int, link: int, contact: Contact) -> None:
    client.set_dynamics(robot, link, {"lateralFriction": float(contact.friction)})
    if contact.stiffness is not None and contact.damping is not None:
        law = {"contactStiffness": float(contact.stiffness), "contactDamping": float(contact.damping)}
        client.set_dynamics(robot, link, law)


def _assert_inertia(client: BulletClient, robot: int, link: int, body: BodyModel, name: str) -> None:
    # Bullet replaces an impossible inertia by zero and only warns.
    segment = body.segments[name]
    wanted = (float(segment.mass), *map(float, segment.inertia))
    if not np.allclose(client.inertia(robot, link), wanted, rtol=_INERTIA_TOLERANCE, atol=0.0):
        hint = "no principal moment of inertia may exceed the sum of the other two"
        raise DocumentError([body_problem(f"PyBullet refuses the inertia of segment '{name}'", hint)])
