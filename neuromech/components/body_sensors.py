"""Sensors of reflex controllers: muscle force and length, posture, joints that are stretched too far."""

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from neuromech.components.base import Port, Reference, Sensor
from neuromech.units import (
    DIMENSIONLESS,
    INVERSE_ANGLE,
    INVERSE_ANGULAR_VELOCITY,
    Angle,
    Dimensionless,
    Quantity,
    quantity,
)

_SIGNAL = Port("signal", "")
_POSTURE = Reference("segment", (("pitch", "angle"), ("angular_velocity_y", "velocity")))


class _OffsetSensor(Sensor):
    inputs: ClassVar[tuple[Port, ...]] = (Port("value", ""),)
    outputs: ClassVar[tuple[Port, ...]] = (_SIGNAL,)

    offset: Dimensionless = quantity("0")

    @staticmethod
    def output(value: float, offset: float) -> float:
        """Return value − offset."""
        return value - offset


class MuscleForceSensor(_OffsetSensor):
    """Golgi tendon organ: force of a muscle with a tendon over its maximal force, less an offset."""

    kind: Literal["muscle_force_sensor"] = "muscle_force_sensor"
    source: ClassVar[str] = "Dzeladini 2013 eq. 2.32"

    muscle: Annotated[str, Reference("muscle", (("relative_force", "value"),))]


class MuscleLengthSensor(_OffsetSensor):
    """Spindle: fibre length of a muscle with a tendon over its optimal length, less an offset; may be negative."""

    kind: Literal["muscle_length_sensor"] = "muscle_length_sensor"
    source: ClassVar[str] = "Dzeladini 2013 eq. 2.31"

    muscle: Annotated[str, Reference("muscle", (("relative_fibre_length", "value"),))]


class _PostureSensor(Sensor):
    inputs: ClassVar[tuple[Port, ...]] = (Port("angle", "rad"), Port("velocity", "rad/s"))
    outputs: ClassVar[tuple[Port, ...]] = (_SIGNAL,)

    segment: Annotated[str, _POSTURE]
    reference_angle: Angle = quantity("0 deg")
    angle_gain: Annotated[Quantity, INVERSE_ANGLE] = quantity("0 1/rad")
    velocity_gain: Annotated[Quantity, INVERSE_ANGULAR_VELOCITY] = quantity("0 s/rad")


class PostureSensor(_PostureSensor):
    """Lean of a segment about the world's y axis against a reference, positive forward, and its rate."""

    kind: Literal["posture_sensor"] = "posture_sensor"
    source: ClassVar[str] = "Dzeladini 2013 eq. 2.36 without its brackets"

    @staticmethod
    def output(angle: float, velocity: float, reference_angle: float, angle_gain: float, velocity_gain: float) -> float:
        """Return angle_gain (θ − θ_ref) + velocity_gain dθ/dt."""
        return angle_gain * (angle - reference_angle) + velocity_gain * velocity


class RectifiedPostureSensor(_PostureSensor):
    """As `posture_sensor`, but never negative: the muscles that turn a segment back are others for either direction."""

    kind: Literal["rectified_posture_sensor"] = "rectified_posture_sensor"
    source: ClassVar[str] = "Dzeladini 2013 eq. 2.36"

    direction: Annotated[
        Quantity, DIMENSIONLESS.within(-1.0, 1.0), Field(description="1 for a forward lean, −1 for a backward one")
    ] = quantity("1")

    @staticmethod
    def output(
        angle: float,
        velocity: float,
        reference_angle: float,
        angle_gain: float,
        velocity_gain: float,
        direction: float,
    ) -> float:
        """Return max(0, direction × (angle_gain (θ − θ_ref) + velocity_gain dθ/dt))."""
        return max(0.0, direction * (angle_gain * (angle - reference_angle) + velocity_gain * velocity))


class RectifiedJointSensor(Sensor):
    """Angle of a joint against a reference, and its rate, as far as they call for a turn in one direction."""

    kind: Literal["rectified_joint_sensor"] = "rectified_joint_sensor"
    source: ClassVar[str] = "Dzeladini 2013 eq. 2.36 of a joint, section 2.1.3"
    inputs: ClassVar[tuple[Port, ...]] = (Port("angle", "rad"), Port("velocity", "rad/s"))
    outputs: ClassVar[tuple[Port, ...]] = (_SIGNAL,)

    joint: Annotated[str, Reference("joint", (("angle", "angle"), ("velocity", "velocity")))]
    reference_angle: Angle = quantity("0 deg")
    angle_gain: Annotated[Quantity, INVERSE_ANGLE] = quantity("0 1/rad")
    velocity_gain: Annotated[Quantity, INVERSE_ANGULAR_VELOCITY] = quantity("0 s/rad")
    direction: Annotated[
        Quantity, DIMENSIONLESS.within(-1.0, 1.0), Field(description="1 above the reference, −1 below it")
    ] = quantity("1")

    output = staticmethod(RectifiedPostureSensor.output)


class OverextensionSensor(Sensor):
    """How far a joint is beyond an angle, while it moves on; negative rotation counts with a gain below zero."""

    kind: Literal["overextension_sensor"] = "overextension_sensor"
    source: ClassVar[str] = "Dzeladini 2013 eq. 2.33; condition as in Geyer & Herr 2010, doi:10.1109/TNSRE.2010.2047592"
    inputs: ClassVar[tuple[Port, ...]] = (Port("angle", "rad"), Port("velocity", "rad/s"))
    outputs: ClassVar[tuple[Port, ...]] = (_SIGNAL,)

    joint: Annotated[str, Reference("joint", (("angle", "angle"), ("velocity", "velocity")))]
    limit_angle: Angle
    zero_angle: Angle = quantity("0 deg")
    gain: Annotated[Quantity, INVERSE_ANGLE] = quantity("1 1/rad")

    @staticmethod
    def output(angle: float, velocity: float, limit_angle: float, zero_angle: float, gain: float) -> float:
        """Return |gain| × the excess over the limit while the joint moves further that way, else 0."""
        if gain * velocity <= 0.0:
            return 0.0
        return max(0.0, gain * (angle + zero_angle - limit_angle))
