"""Bullet through PyBullet's Python functions: the portable path."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from math import cos, sin
from pathlib import Path

from neuromech.bodies.base import Floats
from neuromech.bodies.bullet_client import BulletBox, BulletClient, BulletError, BulletJoint
from neuromech.bodies.pybullet_import import pybullet
from neuromech.bodies.pybullet_world import BulletWorld, rotated
from neuromech.compiler.body_state import BodyState
from neuromech.errors import RunError


class PythonClient(BulletClient):
    """A client of the Python module.

    Attributes:
        number: by which the Python module knows the client.
    """

    def __init__(self) -> None:
        """Connect."""
        self.number: int = pybullet.connect(pybullet.DIRECT)

    def set_engine(self, step: float, iterations: int, gravity: float) -> None:
        """Set time step, iterations and gravity."""
        pybullet.setPhysicsEngineParameter(
            fixedTimeStep=step,
            numSubSteps=0,
            numSolverIterations=iterations,
            deterministicOverlappingPairs=1,
            physicsClientId=self.number,
        )
        pybullet.setGravity(0.0, 0.0, -gravity, physicsClientId=self.number)

    def load(self, file: Path, fixed: bool) -> int:
        """Load a URDF file."""
        # Bullet keeps files by name; another body's file may have had this one.
        pybullet.setPhysicsEngineParameter(enableFileCaching=0, physicsClientId=self.number)
        try:
            robot: int = pybullet.loadURDF(
                str(file), useFixedBase=fixed, flags=pybullet.URDF_USE_INERTIA_FROM_FILE, physicsClientId=self.number
            )
        except pybullet.error as error:
            raise BulletError(str(error)) from error
        return robot

    def joints(self, robot: int) -> list[BulletJoint]:
        """Return the joints of a robot."""
        count = pybullet.getNumJoints(robot, physicsClientId=self.number)
        infos = [pybullet.getJointInfo(robot, number, physicsClientId=self.number) for number in range(count)]
        return [
            BulletJoint(info[0], info[1].decode(), info[12].decode(), info[2] != pybullet.JOINT_FIXED, info[3], info[4])
            for info in infos
        ]

    def add_plane(self, height: float) -> int:
        """Add a level plane."""
        shape = pybullet.createCollisionShape(pybullet.GEOM_PLANE, physicsClientId=self.number)
        plane: int = pybullet.createMultiBody(0.0, shape, basePosition=(0.0, 0.0, height), physicsClientId=self.number)
        return plane

    def add_boxes(self, boxes: Sequence[BulletBox]) -> int:
        """Add boxes as one thing."""
        shape = pybullet.createCollisionShapeArray(
            [pybullet.GEOM_BOX] * len(boxes),
            halfExtents=[[0.5 * side for side in box.size] for box in boxes],
            collisionFramePositions=[list(box.position) for box in boxes],
            collisionFrameOrientations=[list(box.quaternion) for box in boxes],
            physicsClientId=self.number,
        )
        thing: int = pybullet.createMultiBody(0.0, shape, physicsClientId=self.number)
        return thing

    def add_ball(self, radius: float, mass: float, position: Sequence[float]) -> int:
        """Add a ball."""
        shape = pybullet.createCollisionShape(pybullet.GEOM_SPHERE, radius=radius, physicsClientId=self.number)
        ball: int = pybullet.createMultiBody(mass, shape, basePosition=position, physicsClientId=self.number)
        return ball

    def set_partners(self, thing: int, link: int, group: int, partners: int) -> None:
        """Say with what a link collides."""
        pybullet.setCollisionFilterGroupMask(thing, link, group, partners, physicsClientId=self.number)

    def stop_motors(self, robot: int, joints: Sequence[BulletJoint]) -> None:
        """Take away the force of the motors."""
        pybullet.setJointMotorControlArray(
            robot,
            [joint.number for joint in joints],
            pybullet.VELOCITY_CONTROL,
            forces=[0.0] * len(joints),
            physicsClientId=self.number,
        )

    def set_dynamics(self, robot: int, link: int, settings: Mapping[str, float]) -> None:
        """Set properties of a link."""
        pybullet.changeDynamics(robot, link, physicsClientId=self.number, **settings)

    def inertia(self, robot: int, link: int) -> tuple[float, float, float, float]:
        """Return mass and principal moments of inertia of a link."""
        info = pybullet.getDynamicsInfo(robot, link, physicsClientId=self.number)
        return (info[0], *info[2])

    def put_root(
        self, robot: int, position: Sequence[float], quaternion: Sequence[float], velocity: Sequence[float]
    ) -> None:
        """Put the root link's centre of mass to a place."""
        pybullet.resetBasePositionAndOrientation(robot, position, quaternion, physicsClientId=self.number)
        pybullet.resetBaseVelocity(robot, velocity, (0.0, 0.0, 0.0), physicsClientId=self.number)

    def put_joint(self, robot: int, joint: int, position: float, velocity: float) -> None:
        """Give a joint its angle and velocity."""
        pybullet.resetJointState(robot, joint, position, velocity, physicsClientId=self.number)

    def close(self) -> None:
        """Disconnect."""
        pybullet.disconnect(physicsClientId=self.number)


class PythonMotion:
    """Reads and steps a world through a Python client.

    Attributes:
        client: the client.
        world: what it built.
    """

    def __init__(self, client: PythonClient, world: BulletWorld, layout: BodyState) -> None:
        """Take the numbers of joints from the world."""
        self.client = client
        self.world = world
        self._layout = layout
        self._joints = [joint.number for joint in world.joints]
        self._moving = self._joints + [joint.number for joint in world.root]

    def read(self, state: Floats) -> None:
        """Fill the state array."""
        n = len(self._joints)
        with _translated():
            moving = self._joint_states()
            state[self._layout.angles] = [joint[0] for joint in moving[:n]]
            state[self._layout.velocities] = [joint[1] for joint in moving[:n]]
            self._read_root(state, moving[n:])
            self._read_contacts(state)
            self._read_weights(state)

    def step(self, torque: Floats) -> None:
        """Apply joint torques and advance by one step."""
        with _translated():
            if self._joints:
                pybullet.setJointMotorControlArray(
                    self.world.robot,
                    self._joints,
                    pybullet.TORQUE_CONTROL,
                    forces=torque.tolist(),
                    physicsClientId=self.client.number,
                )
            pybullet.stepSimulation(physicsClientId=self.client.number)

    def push(self, segment: int, acting: Floats) -> None:
        """Let a force act on a segment during the next step."""
        thing, link = self.world.links[segment]
        force, point = acting[:3].tolist(), acting[3:6].tolist()
        with _translated():
            pybullet.applyExternalForce(
                thing, link, force, point, pybullet.WORLD_FRAME, physicsClientId=self.client.number
            )

    def place(self, weight: int, position: Floats) -> None:
        """Put the weight of a pendulum to a place, at rest."""
        with _translated():
            self.client.put_root(self.world.weights[weight], position.tolist(), (0.0, 0.0, 0.0, 1.0), (0.0, 0.0, 0.0))

    def check(self) -> None:
        """Do nothing: the methods raise their own errors."""

    def native(self) -> None:
        """Return None: compiled code cannot call Python functions."""
        return

    def _joint_states(self) -> Sequence[tuple[float, ...]]:
        if not self._moving:
            return ()  # PyBullet answers an empty question with None.
        states: Sequence[tuple[float, ...]] = pybullet.getJointStates(
            self.world.robot, self._moving, physicsClientId=self.client.number
        )
        return states

    def _read_root(self, state: Floats, planar: Sequence[tuple[float, ...]]) -> None:
        if planar:
            (x, vx, *_), (z, vz, *_), (pitch, turn, *_) = planar
            y = self.world.root_pose[1]
            state[self._layout.root_pose] = (x, y, z, 0.0, sin(pitch / 2), 0.0, cos(pitch / 2))
            state[self._layout.root_velocity] = (vx, 0.0, vz, 0.0, turn, 0.0)
        elif self.world.free:
            self._read_free_root(state)
        else:
            state[self._layout.root_pose] = self.world.root_pose
            state[self._layout.root_velocity] = 0.0

    def _read_free_root(self, state: Floats) -> None:
        # PyBullet's base is the centre of mass; the root frame's origin is elsewhere.
        robot, client = self.world.robot, self.client.number
        center, quaternion = pybullet.getBasePositionAndOrientation(robot, physicsClientId=client)
        (vx, vy, vz), (wx, wy, wz) = pybullet.getBaseVelocity(robot, physicsClientId=client)
        x, y, z = rotated(quaternion, self.world.center)
        state[self._layout.root_pose] = (center[0] - x, center[1] - y, center[2] - z, *quaternion)
        state[self._layout.root_velocity] = (
            vx - (wy * z - wz * y),
            vy - (wz * x - wx * z),
            vz - (wx * y - wy * x),
            wx,
            wy,
            wz,
        )

    def _read_contacts(self, state: Floats) -> None:
        forces = state[self._layout.contact_forces]
        forces[:] = 0.0
        world = self.world
        only = () if world.plane is None else (world.robot, world.plane)
        for point in pybullet.getContactPoints(*only, physicsClientId=self.client.number):
            # As in `bullet_native`.
            sign, link = (1.0, point[3]) if point[1] == world.robot else (-1.0, point[4])
            if link not in world.contact_row:
                continue
            at = 3 * world.contact_row[link]
            normal, first, second = point[7], point[11], point[13]
            for k in range(3):
                along = sign * point[9] * normal[k] + sign * point[10] * first[k]
                forces[at + k] += along + sign * point[12] * second[k]

    def _read_weights(self, state: Floats) -> None:
        client = self.client.number
        weights = state[self._layout.hanging].reshape(-1, 9)
        for weight, row in zip(self.world.weights, weights, strict=True):
            row[:3], _ = pybullet.getBasePositionAndOrientation(weight, physicsClientId=client)
            row[3:6], _ = pybullet.getBaseVelocity(weight, physicsClientId=client)
            row[6:] = 0.0
            for point in pybullet.getContactPoints(weight, self.world.robot, physicsClientId=client):
                for k in range(3):
                    row[6 + k] -= point[9] * point[7][k]


@contextmanager
def _translated() -> Iterator[None]:
    try:
        yield
    except pybullet.error as error:
        raise RunError(f"PyBullet failed: {error}") from error
