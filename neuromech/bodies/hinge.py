"""A single hinge, integrated to rounding error in plain floats: a body whose exact motion is known.

With τ held over the step, I q̈ = τ − m g dz/dq, where z(q) is the height of the centre of mass, a constant plus
a cosine and a sine of q. Classical Runge–Kutta sub-steps h keep h (ω₀ + |q̇| + dt |τ|/I) below `_PHASE`, where dt is the
step and ω₀² = m g r / I; their error per radian of that phase is of the order `_PHASE`⁴/120 ≈ 10⁻¹⁴. Without gravity a
single sub-step is exact.
"""

from collections.abc import Iterator, Sequence
from math import ceil, cos, hypot, sin, sqrt
from typing import Final

import numpy as np
from scipy.spatial.transform import Rotation

from neuromech.bodies.base import Body, Engine, Floats, body_problem, initial_motion, root_quaternion
from neuromech.compiler.body_state import BodyState
from neuromech.compiler.tree import lower_tree
from neuromech.errors import DocumentError, RunError
from neuromech.graph.model import BodyModel

_PHASE: Final = 1e-3
_VERSION: Final = "1"


class HingeBody(Body):
    """A segment that turns about one hinge on a fixed root. A limit of the range stops it without rebound."""

    def __init__(self, body: BodyModel, step: float) -> None:
        """Take the hinge's inertia and gravity from the body.

        Args:
            body: the body.
            step: in seconds.

        Raises:
            DocumentError: the body is more than one hinge on a fixed root.
        """
        check_hinge(body)
        (joint,) = body.joints.values()
        self.joints = tuple(body.joints)
        self.contacts = ()
        self.step_seconds = step
        self.engine = Engine("hinge", _VERSION)
        self.layout = BodyState(1, 0)
        self._range = joint.range
        self._root_pose = (*map(float, body.root.position), *root_quaternion(body.root))
        self._inertia, self._cosine, self._sine = _constants(body)
        self._frequency = sqrt(hypot(self._cosine, self._sine) / self._inertia)
        (self._angle,), (self._velocity,) = initial_motion(body)
        self._open = True

    def read(self, state: Floats) -> None:
        """Fill the state array."""
        self._require_open()
        state[0] = self._angle
        state[1] = self._velocity
        state[self.layout.root_pose] = self._root_pose
        state[self.layout.root_velocity] = 0.0

    def step(self, torque: Floats) -> None:
        """Apply the joint torque and advance by one step."""
        self._require_open()
        push = float(torque[0])
        count = self._sub_steps(push)
        for _ in range(count):
            self._sub_step(push, self.step_seconds / count)

    def reset(self, angles: Sequence[float] | Floats, velocities: Sequence[float] | Floats | None = None) -> None:
        """Set angle and velocity."""
        self._require_open()
        self._angle = float(angles[0])
        self._velocity = 0.0 if velocities is None else float(velocities[0])

    def close(self) -> None:
        """Refuse further steps."""
        self._open = False

    @property
    def inertia(self) -> float:
        """Moment of inertia about the joint axis in kg m², armature included."""
        return self._inertia

    @property
    def frequency(self) -> float:
        """Angular frequency of small swings under gravity alone, in rad/s; zero without gravity."""
        return self._frequency

    def _require_open(self) -> None:
        if not self._open:
            raise RunError("the body is closed")

    def _sub_steps(self, torque: float) -> int:
        if self._frequency == 0.0 and self._range is None:
            return 1
        rate = self._frequency + abs(self._velocity) + self.step_seconds * abs(torque) / self._inertia
        return max(1, ceil(self.step_seconds * rate / _PHASE)) if np.isfinite(rate) else 1

    def _acceleration(self, angle: float, torque: float) -> float:
        return (torque + self._cosine * cos(angle) + self._sine * sin(angle)) / self._inertia

    def _sub_step(self, torque: float, h: float) -> None:
        q, v = self._angle, self._velocity
        a = self._acceleration(q, torque)
        b = self._acceleration(q + h / 2 * v, torque)
        c = self._acceleration(q + h / 2 * (v + h / 2 * a), torque)
        d = self._acceleration(q + h * (v + h / 2 * b), torque)
        self._angle = q + h * (v + h / 6 * (a + b + c))
        self._velocity = v + h / 6 * (a + 2 * b + 2 * c + d)
        if self._range is not None:
            self._stop(*self._range)

    def _stop(self, lower: float, upper: float) -> None:
        if self._angle < lower:
            self._angle, self._velocity = float(lower), max(0.0, self._velocity)
        elif self._angle > upper:
            self._angle, self._velocity = float(upper), min(0.0, self._velocity)


def check_hinge(body: BodyModel) -> None:
    """Check that a body is one hinge on a fixed root.

    Raises:
        DocumentError: it is not.
    """
    problems = [body_problem(message, "use engine: pybullet") for message in _more_than_a_hinge(body)]
    if problems:
        raise DocumentError(problems)


def _more_than_a_hinge(body: BodyModel) -> Iterator[str]:
    if [joint.kind for joint in body.joints.values()] != ["hinge"] or len(body.segments) != 2:
        found = f"{len(body.joints)} joints and {len(body.segments)} segments"
        yield f"engine 'hinge' moves exactly one hinge between two segments, not {found}"
    if body.root.kind != "fixed":
        yield f"engine 'hinge' needs a fixed root, not a {body.root.kind} one"
    if body.contacts:
        yield "engine 'hinge' knows no contacts"


def _constants(body: BodyModel) -> tuple[float, float, float]:
    # Moment of inertia about the axis, and gravity's torque as its cosine and sine parts.
    tree = lower_tree(body)
    axis, center, mass = tree.axis[1], tree.center_of_mass[1], float(tree.mass[1])
    arm = center - axis * (axis @ center)
    inertia = float(axis**2 @ tree.inertia[1] + mass * (arm @ arm) + tree.armature[1])
    up = Rotation.from_quat(root_quaternion(body.root)).as_matrix()[2]
    weight = mass * float(body.world.gravity)
    return inertia, -weight * float(up @ np.cross(axis, arm)), weight * float(up @ arm)
