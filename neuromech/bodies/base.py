"""What the simulation asks of a body, whatever engine moves it."""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from types import TracebackType
from typing import Any, ClassVar, Self

import numpy as np
from numpy.typing import NDArray

from neuromech.compiler.body_state import BodyState
from neuromech.errors import Problem, RunError
from neuromech.graph.model import BodyModel
from neuromech.spec.model import Root

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Engine:
    """What moves a body, for the provenance of a run.

    Args:
        name: of the engine.
        version: of the engine.
        path: how it is called, for an engine that can be called in several ways.
    """

    name: str
    version: str
    path: str = ""

    def __str__(self) -> str:
        """Return name, version and path, as in `pybullet 3.2.7 (native)`."""
        return f"{self.name} {self.version}" + (f" ({self.path})" if self.path else "")


class Body(ABC):
    """A body that moves in steps of equal length. Opened at the initial angles of its joints, with its first motion.

    `damping`, `stiffness` and `rest_angle` of joints are no business of an engine: the coupling adds them to the
    torques that `step` gets, so an engine sets its own joint damping to zero. `range` of joints is its business.

    Attributes:
        joints: names of the joints, in the order of angles and torques.
        contacts: names of the contacts, in the order of contact forces.
        step_seconds: time by which one step advances the body.
        engine: what moves the body.
        layout: where things stand in the state array.
        native_module: module with the compiled functions `read(engine, state)`, `step(engine, torque)`,
            `push(engine, segment, acting)` and `place(engine, weight, position)`, None where the engine has none. They
            do what the methods do, to the last bit. Instead of raising they return an integer: 0, or another number
            where the engine failed; `check` tells why.
    """

    native_module: ClassVar[str | None] = None
    joints: tuple[str, ...]
    contacts: tuple[str, ...]
    step_seconds: float
    engine: Engine
    layout: BodyState

    @abstractmethod
    def read(self, state: Floats) -> None:
        """Fill the state array; (`layout.size`,), see `BodyState`.

        Raises:
            RunError: the engine failed, or the body is closed.
        """

    @abstractmethod
    def step(self, torque: Floats) -> None:
        """Apply joint torques, held for the whole step, and advance by exactly one step.

        Args:
            torque: (joints,) in N m, for slides in N.

        Raises:
            RunError: the engine failed, or the body is closed.
        """

    def push(self, segment: int, acting: Floats) -> None:
        """Let a force act on a segment during the next step, beside those that act already.

        Args:
            segment: row of the segment, in the order of the body; weights of pendulums follow.
            acting: (9,) force in N, the point where it acts and the centre of mass of the segment in m, world axes.

        Raises:
            RunError: the engine knows no pushes, or failed, or the body is closed.
        """
        raise RunError(f"engine '{self.engine.name}' knows no pushes")

    def place(self, weight: int, position: Floats) -> None:
        """Put the weight of a pendulum to a place, at rest.

        Args:
            weight: which one, in the order of the world.
            position: (3,) of its middle in m.

        Raises:
            RunError: the engine knows no pendulums, or failed, or the body is closed.
        """
        raise RunError(f"engine '{self.engine.name}' knows no pendulums")

    @abstractmethod
    def reset(self, angles: Sequence[float] | Floats, velocities: Sequence[float] | Floats | None = None) -> None:
        """Give joints angles and velocities; everything else is as new, pose and velocity of the root included.

        Args:
            angles: (joints,) in rad, of slides in m.
            velocities: (joints,) in rad/s, of slides in m/s; at rest where not given.

        Raises:
            RunError: the engine failed, or the body is closed.
        """

    def native(self) -> tuple[Any, ...] | None:
        """Return what the compiled functions of `native_module` take as `engine`, or None where they cannot be used.

        The arrays in it are valid until the body is reset or closed.

        Raises:
            RunError: the body is closed.
        """
        return None

    def check(self) -> None:
        """Raise what a compiled function could only report by its result; nothing where all is well.

        Raises:
            RunError: the engine failed since the body was opened or reset.
        """
        return

    @abstractmethod
    def close(self) -> None:
        """Free the engine. A closed body can be closed again."""

    def __enter__(self) -> Self:
        """Return the body; it is closed at the end of the `with` block."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Close the body."""
        self.close()


def body_problem(message: str, hint: str | None = None) -> Problem:
    """Return the problem of a document whose body an engine cannot move."""
    return Problem("body", "body", message, hint=hint)


def initial_motion(body: BodyModel) -> tuple[list[float], list[float]]:
    """Return angle and velocity of every joint at time zero, in rad and rad/s, of slides in m and m/s."""
    angles = [float(joint.initial_angle) for joint in body.joints.values()]
    return angles, [body.motion.joints.get(name, 0.0) for name in body.joints]


def root_quaternion(root: Root) -> tuple[float, float, float, float]:
    """Return the unit quaternion x, y, z, w of the root's first orientation, Rz(yaw) Ry(pitch) Rx(roll)."""
    roll, pitch, yaw = (0.5 * float(angle) for angle in root.orientation)
    cr, cp, cy = np.cos((roll, pitch, yaw)).tolist()
    sr, sp, sy = np.sin((roll, pitch, yaw)).tolist()
    return (
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
        cr * cp * cy + sr * sp * sy,
    )
