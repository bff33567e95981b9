"""Bodies moved by MuJoCo, stepped by compiled code or through its portable Python functions, with the same bits.

Every body owns a model and its data.
"""

from collections.abc import Sequence
from typing import Any, ClassVar, Literal

import numpy as np

from neuromech.bodies.base import Body, Engine, Floats, initial_motion, root_quaternion
from neuromech.bodies.mjcf import WEIGHT
from neuromech.bodies.mujoco_native import place, push, read
from neuromech.bodies.mujoco_world import build_model, load_mujoco, step_address
from neuromech.bodies.versions import package_version
from neuromech.compiler.body_state import BodyState
from neuromech.compiler.numerics import Integers
from neuromech.compiler.tree import FREE_ROOT, PLANAR_ROOT, lower_tree
from neuromech.errors import RunError
from neuromech.graph.model import BodyModel
from neuromech.graph.swing import first_place


class MujocoBody(Body):
    """A body in a MuJoCo world of its own."""

    native_module: ClassVar[str | None] = "neuromech.bodies.mujoco_native"

    def __init__(self, body: BodyModel, step: float, path: Literal["native", "python"] | None = None) -> None:
        """Compile the model.

        Args:
            body: the body.
            step: in seconds.
            path: stepped by compiled code, or through Python; by compiled code where it can be, if not given.

        Raises:
            DocumentError: MuJoCo cannot move this body.
            MissingExtraError: MuJoCo is not installed.
            RunError: the native path is asked for, and the address of `mj_step` cannot be found.
        """
        self._mujoco = load_mujoco()
        address = None if path == "python" else step_address(self._mujoco)
        if path == "native" and address is None:
            raise RunError("MuJoCo's C function mj_step cannot be called here")
        self._model = build_model(self._mujoco, body, step)
        self._data: Any = self._mujoco.MjData(self._model)
        self.joints = tuple(body.joints)
        self.contacts = tuple(body.contacts)
        self.step_seconds = step
        self.engine = Engine("mujoco", package_version("mujoco"), "python" if address is None else "native")
        self.layout = BodyState(len(body.joints), len(body.contacts), len(body.world.pendulums))
        joints = [self._model.joint(name) for name in self.joints]
        places = [[joint.qposadr[0] for joint in joints], [joint.dofadr[0] for joint in joints]]
        self._root_start = _root_start(body)
        self._root_velocity = _root_velocity(body)
        self._weight_starts = [np.array(first_place(body, one)) for one in body.world.pendulums.values()]
        self._engine = self._views(body, np.array(places, dtype=np.int64).reshape(2, -1), address or 0)
        self.reset(*initial_motion(body))

    def read(self, state: Floats) -> None:
        """Fill the state array."""
        read(self._opened(), state)

    def step(self, torque: Floats) -> None:
        """Apply joint torques and advance by one step."""
        _, _, places, _, _, applied, _, warnings, pushed, *_ = self._opened()
        applied[places[1]] = torque
        self._mujoco.mj_step(self._model, self._data)
        pushed[:] = 0.0
        if warnings.any():
            self.check()

    def push(self, segment: int, acting: Floats) -> None:
        """Let a force act on a segment during the next step."""
        push(self._opened(), segment, acting)

    def place(self, weight: int, position: Floats) -> None:
        """Put the weight of a pendulum to a place, at rest."""
        place(self._opened(), weight, position)

    def check(self) -> None:
        """Raise the first kind of warning of MuJoCo."""
        warnings = self._opened()[7]
        for kind in np.flatnonzero(warnings):
            info = int(self._data.warning.lastinfo[kind])
            raise RunError(f"MuJoCo failed: {self._mujoco.mju_warningText(int(kind), info)}")

    def reset(self, angles: Sequence[float] | Floats, velocities: Sequence[float] | Floats | None = None) -> None:
        """Make the data new and put the joints as told."""
        _, _, places, positions, speeds, *_ = self._opened()
        self._mujoco.mj_resetData(self._model, self._data)
        positions[: len(self._root_start)] = self._root_start
        speeds[: len(self._root_velocity)] = self._root_velocity
        positions[places[0]] = angles
        if velocities is not None:
            speeds[places[1]] = velocities
        for weight, start in enumerate(self._weight_starts):
            self.place(weight, start)

    def native(self) -> tuple[Any, ...] | None:
        """Return the views that `neuromech.bodies.mujoco_native` works on, None on the Python path."""
        engine = self._opened()
        return engine if self.engine.path == "native" else None

    def close(self) -> None:
        """Free the data."""
        self._data = None
        self._engine = ()

    def _opened(self) -> tuple[Any, ...]:
        if self._data is None:
            raise RunError("the body is closed")
        return self._engine

    def _views(self, body: BodyModel, places: Integers, address: int) -> tuple[Any, ...]:
        data, count = self._data, 3 * len(body.contacts)
        weights = [self._model.joint(f"{WEIGHT}{name}:x") for name in body.world.pendulums]
        starts = [[joint.qposadr[0] for joint in weights], [joint.dofadr[0] for joint in weights]]
        rows = [*body.segments, *(WEIGHT + name for name in body.world.pendulums)]
        addresses = (address, self._model._address, data._address)
        pose = (*map(float, body.root.position), *root_quaternion(body.root))
        return (
            np.array(addresses, dtype=np.int64),
            np.array([float(lower_tree(body).root), *pose]),
            places,
            data.qpos,
            data.qvel,
            data.qfrc_applied,
            data.sensordata[:count] if body.world.ground is not None else np.zeros(count),
            data.warning.number,
            data.xfrc_applied,
            np.array([self._model.body(name).id for name in rows], dtype=np.int64),
            np.array(starts, dtype=np.int64).reshape(2, -1),
            data.sensordata[count if body.world.ground is not None else 0 :],
        )


def _root_velocity(body: BodyModel) -> tuple[float, ...]:
    # The first entries of MuJoCo's qvel.
    x, y, z = map(float, body.motion.root)
    return {FREE_ROOT: (x, y, z), PLANAR_ROOT: (x, z)}.get(lower_tree(body).root, ())


def _root_start(body: BodyModel) -> tuple[float, ...]:
    # The first entries of MuJoCo's qpos.
    x, y, z = map(float, body.root.position)
    root = lower_tree(body).root
    if root == FREE_ROOT:
        a, b, c, w = root_quaternion(body.root)
        return (x, y, z, w, a, b, c)
    return (x, z, float(body.root.orientation[1])) if root == PLANAR_ROOT else ()
