"""Bodies moved by PyBullet, through its portable Python calls. Every body owns a physics client and the world in it.

A world is built anew for every opening and every reset: Bullet repeats a run bit for bit only in a fresh world
(https://github.com/bulletphysics/bullet3/issues/3099).
"""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from importlib.metadata import version
from math import cos, sin

import pybullet

from neuromech.bodies.base import Body, Engine, Floats, root_quaternion
from neuromech.bodies.pybullet_world import BulletWorld, build_world, check_pybullet
from neuromech.compiler.body_state import BodyState
from neuromech.errors import RunError
from neuromech.graph.model import BodyModel


class PyBulletBody(Body):
    """A body in a PyBullet world of its own."""

    def __init__(self, body: BodyModel, step: float) -> None:
        """Build the world.

        Args:
            body: the body.
            step: in seconds.

        Raises:
            DocumentError: Bullet cannot move this body.
        """
        check_pybullet(body)
        self.joints = tuple(body.joints)
        self.contacts = tuple(body.contacts)
        self.step_seconds = step
        self.engine = Engine("pybullet", version("pybullet"))
        self.layout = BodyState(len(body.joints), len(body.contacts))
        self._body = body
        self._root_pose = (*map(float, body.root.position), *root_quaternion(body.root))
        self._center = [float(x) for x in body.segments[body.root_segment].center_of_mass]
        self._world: BulletWorld | None = None
        self._start([float(joint.initial_angle) for joint in body.joints.values()], [0.0] * len(body.joints))

    def read(self, state: Floats) -> None:
        """Fill the state array."""
        world = self._opened()
        n = len(self.joints)
        with _translated():
            moving = _joint_states(world)
            state[self.layout.angles] = [joint[0] for joint in moving[:n]]
            state[self.layout.velocities] = [joint[1] for joint in moving[:n]]
            self._read_root(world, state, moving[n:])
            self._read_contacts(world, state)

    def step(self, torque: Floats) -> None:
        """Apply joint torques and advance by one step."""
        world = self._opened()
        with _translated():
            if self.joints:
                pybullet.setJointMotorControlArray(
                    world.robot,
                    world.joints,
                    pybullet.TORQUE_CONTROL,
                    forces=torque.tolist(),
                    physicsClientId=world.client,
                )
            pybullet.stepSimulation(physicsClientId=world.client)

    def reset(self, angles: Sequence[float] | Floats, velocities: Sequence[float] | Floats | None = None) -> None:
        """Build the world anew and put the joints as told."""
        self._opened()
        self.close()
        self._start(angles, [0.0] * len(self.joints) if velocities is None else velocities)

    def close(self) -> None:
        """Disconnect the physics client."""
        if self._world is not None:
            pybullet.disconnect(physicsClientId=self._world.client)
            self._world = None

    def _opened(self) -> BulletWorld:
        if self._world is None:
            raise RunError("the body is closed")
        return self._world

    def _start(self, angles: Sequence[float] | Floats, velocities: Sequence[float] | Floats) -> None:
        self._world = world = build_world(self._body, self.step_seconds)
        x, y, z, *quaternion = self._root_pose
        if world.root:
            root = (x, z, float(self._body.root.orientation[1]))
            self._put(world, world.root, root, (0.0, 0.0, 0.0))
        else:
            a, b, c = _rotated(quaternion, self._center)
            pybullet.resetBasePositionAndOrientation(
                world.robot, (x + a, y + b, z + c), quaternion, physicsClientId=world.client
            )
        self._put(world, world.joints, angles, velocities)

    @staticmethod
    def _put(
        world: BulletWorld,
        joints: Sequence[int],
        angles: Sequence[float] | Floats,
        velocities: Sequence[float] | Floats,
    ) -> None:
        for joint, angle, velocity in zip(joints, angles, velocities, strict=True):
            pybullet.resetJointState(world.robot, joint, angle, velocity, physicsClientId=world.client)

    def _read_root(self, world: BulletWorld, state: Floats, planar: Sequence[tuple[float, ...]]) -> None:
        if world.root:
            (x, vx, *_), (z, vz, *_), (pitch, turn, *_) = planar
            state[self.layout.root_pose] = (x, self._root_pose[1], z, 0.0, sin(pitch / 2), 0.0, cos(pitch / 2))
            state[self.layout.root_velocity] = (vx, 0.0, vz, 0.0, turn, 0.0)
        elif self._body.root.kind == "free":
            self._read_free_root(world, state)
        else:
            state[self.layout.root_pose] = self._root_pose
            state[self.layout.root_velocity] = 0.0

    def _read_free_root(self, world: BulletWorld, state: Floats) -> None:
        # PyBullet's base is the centre of mass; the root frame's origin is elsewhere.
        center, quaternion = pybullet.getBasePositionAndOrientation(world.robot, physicsClientId=world.client)
        (vx, vy, vz), (wx, wy, wz) = pybullet.getBaseVelocity(world.robot, physicsClientId=world.client)
        x, y, z = _rotated(quaternion, self._center)
        state[self.layout.root_pose] = (center[0] - x, center[1] - y, center[2] - z, *quaternion)
        state[self.layout.root_velocity] = (
            vx - (wy * z - wz * y),
            vy - (wz * x - wx * z),
            vz - (wx * y - wy * x),
            wx,
            wy,
            wz,
        )

    def _read_contacts(self, world: BulletWorld, state: Floats) -> None:
        forces = state[self.layout.contact_forces]
        forces[:] = 0.0
        if world.ground is None:
            return
        for point in pybullet.getContactPoints(world.robot, world.ground, physicsClientId=world.client):
            at = 3 * world.contact_row[point[3]]
            normal, first, second = point[7], point[11], point[13]
            for k in range(3):
                forces[at + k] += point[9] * normal[k] + point[10] * first[k] + point[12] * second[k]


@contextmanager
def _translated() -> Iterator[None]:
    try:
        yield
    except pybullet.error as error:
        raise RunError(f"PyBullet failed: {error}") from error


def _joint_states(world: BulletWorld) -> Sequence[tuple[float, ...]]:
    joints = world.joints + world.root
    if not joints:
        return ()  # PyBullet answers an empty question with None.
    states: Sequence[tuple[float, ...]] = pybullet.getJointStates(world.robot, joints, physicsClientId=world.client)
    return states


def _rotated(quaternion: Sequence[float], vector: Sequence[float]) -> tuple[float, float, float]:
    x, y, z, w = quaternion
    a, b, c = vector
    across = (2.0 * (y * c - z * b), 2.0 * (z * a - x * c), 2.0 * (x * b - y * a))
    return (
        a + w * across[0] + y * across[2] - z * across[1],
        b + w * across[1] + z * across[0] - x * across[2],
        c + w * across[2] + x * across[1] - y * across[0],
    )
