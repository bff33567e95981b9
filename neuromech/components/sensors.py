"""Sensors: stretch, load, joint and link."""

from math import pow
from typing import Annotated, ClassVar, Literal

from neuromech.components.base import Port, Reference, Sensor, State
from neuromech.units import (
    DIMENSIONLESS,
    FORCE,
    INVERSE_FORCE,
    LENGTH,
    TIME,
    Angle,
    Dimensionless,
    Quantity,
    Unit,
    quantity,
)

_SIGNAL = Port("signal", "")


class StretchSensor(Sensor):
    """Ia afferent: power of the stretch velocity plus stretch beyond a threshold length, while the leg is loaded."""

    kind: Literal["ia_stretch_sensor"] = "ia_stretch_sensor"
    source: ClassVar[str] = (
        "Habu 2020 eq. 12–13; Prilutsky et al. 2016, doi:10.1007/978-1-4939-3267-2_10 (signed power)"
    )
    inputs: ClassVar[tuple[Port, ...]] = (Port("length", "mm"), Port("velocity", "mm/s"), Port("load", "N"))
    outputs: ClassVar[tuple[Port, ...]] = (_SIGNAL,)

    muscle: Annotated[str, Reference("muscle", (("length", "length"), ("velocity", "velocity")))]
    load_sensor: Annotated[str, Reference("sensor", (("load", "load"),))]
    threshold_length: Annotated[Quantity, LENGTH.positive]
    velocity_gain: Annotated[Quantity, DIMENSIONLESS.non_negative] = quantity("0.5")
    length_gain: Annotated[Quantity, DIMENSIONLESS.non_negative] = quantity("20")
    load_threshold: Annotated[Quantity, FORCE.non_negative] = quantity("0.01 N")
    scale: Annotated[Quantity, DIMENSIONLESS.non_negative] = quantity("1")

    @staticmethod
    def output(
        length: float,
        velocity: float,
        load: float,
        threshold_length: float,
        velocity_gain: float,
        length_gain: float,
        load_threshold: float,
        scale: float,
    ) -> float:
        """Return feedback₁, never negative; v is in threshold lengths per second and its sign is kept by the power."""
        if load <= load_threshold:
            return 0.0
        speed = velocity / threshold_length
        power = pow(abs(speed), 0.6)
        if speed < 0.0:
            power = -power
        stretch = max(0.0, (length - threshold_length) / threshold_length)
        return scale * max(0.0, velocity_gain * power + length_gain * stretch)


class MuscleSpindle(Sensor):
    """Ia afferent of a muscle that is not gated by load: power of the stretch velocity plus stretch beyond a length."""

    kind: Literal["muscle_spindle"] = "muscle_spindle"
    source: ClassVar[str] = "Prilutsky et al. 2016, doi:10.1007/978-1-4939-3267-2_10; Habu 2020 eq. 12 without its gate"
    inputs: ClassVar[tuple[Port, ...]] = (Port("length", "mm"), Port("velocity", "mm/s"))
    outputs: ClassVar[tuple[Port, ...]] = (_SIGNAL,)

    muscle: Annotated[str, Reference("muscle", (("length", "length"), ("velocity", "velocity")))]
    threshold_length: Annotated[Quantity, LENGTH.positive]
    velocity_gain: Annotated[Quantity, DIMENSIONLESS.non_negative] = quantity("0.5")
    length_gain: Annotated[Quantity, DIMENSIONLESS.non_negative] = quantity("20")

    @staticmethod
    def output(
        length: float, velocity: float, threshold_length: float, velocity_gain: float, length_gain: float
    ) -> float:
        """Return the feedback, never negative; the velocity is in threshold lengths per second."""
        speed = velocity / threshold_length
        power = pow(abs(speed), 0.6)
        if speed < 0.0:
            power = -power
        stretch = max(0.0, (length - threshold_length) / threshold_length)
        return max(0.0, velocity_gain * power + length_gain * stretch)


class LegLoadSensor(Sensor):
    """Vertical force on a foot behind a first-order low pass, scaled to a feedback signal."""

    kind: Literal["leg_load_sensor"] = "leg_load_sensor"
    source: ClassVar[str] = "Habu 2020 eq. 14; the low pass is ours"
    states: ClassVar[tuple[State, ...]] = (State("filtered_load", "N", "initial_load"),)
    inputs: ClassVar[tuple[Port, ...]] = (Port("contact_force", "N"),)
    outputs: ClassVar[tuple[Port, ...]] = (_SIGNAL, Port("load", "N"))

    contact: Annotated[str, Reference("contact", (("force_z", "contact_force"),))]
    gain: Annotated[Quantity, INVERSE_FORCE.non_negative]
    time_constant: Annotated[Quantity, TIME.positive] = quantity("5 ms")
    initial_load: Annotated[Quantity, FORCE.non_negative] = quantity("0 N")

    @staticmethod
    def flow(contact_force: float, time_constant: float) -> tuple[float, float]:
        """Return drive (N/s) and rate (1/s) of the filtered load."""
        return contact_force / time_constant, 1.0 / time_constant

    @staticmethod
    def output(filtered_load: float, gain: float) -> tuple[float, float]:
        """Return feedback₂ = gain × load, and the load (N)."""
        return gain * filtered_load, filtered_load


class JointSensor(Sensor):
    """Joint angle and velocity, linearly combined."""

    kind: Literal["joint_sensor"] = "joint_sensor"
    source: ClassVar[str] = "linear combination"
    inputs: ClassVar[tuple[Port, ...]] = (Port("angle", "rad"), Port("velocity", "rad/s"))
    outputs: ClassVar[tuple[Port, ...]] = (_SIGNAL,)

    joint: Annotated[str, Reference("joint", (("angle", "angle"), ("velocity", "velocity")))]
    reference_angle: Angle = quantity("0 deg")
    angle_gain: Annotated[Quantity, Unit("gain per angle", "1/rad")] = quantity("0 1/rad")
    velocity_gain: Annotated[Quantity, Unit("gain per angular velocity", "s/rad")] = quantity("0 s/rad")

    @staticmethod
    def output(angle: float, velocity: float, reference_angle: float, angle_gain: float, velocity_gain: float) -> float:
        """Return angle_gain (q − q_ref) + velocity_gain dq/dt."""
        return angle_gain * (angle - reference_angle) + velocity_gain * velocity


class LinkSensor(Sensor):
    """One number of a segment's motion in the world, relative to a reference and scaled. All in SI units."""

    kind: Literal["link_sensor"] = "link_sensor"
    source: ClassVar[str] = "linear"
    inputs: ClassVar[tuple[Port, ...]] = (Port("value", "*"),)
    outputs: ClassVar[tuple[Port, ...]] = (_SIGNAL,)

    segment: Annotated[str, Reference("segment", (("{quantity}", "value"),))]
    quantity: Literal["x", "y", "z", "roll", "pitch", "yaw", "velocity_x", "velocity_y", "velocity_z"]
    reference: Dimensionless = Quantity(0.0)
    gain: Dimensionless = Quantity(1.0)

    @staticmethod
    def output(value: float, reference: float, gain: float) -> float:
        """Return gain (value − reference)."""
        return gain * (value - reference)


class ContactSensor(Sensor):
    """One number of a contact, such as its place in the world, relative to a reference and scaled. All in SI units."""

    kind: Literal["contact_sensor"] = "contact_sensor"
    source: ClassVar[str] = "linear"
    inputs: ClassVar[tuple[Port, ...]] = (Port("value", "*"),)
    outputs: ClassVar[tuple[Port, ...]] = (_SIGNAL,)

    contact: Annotated[str, Reference("contact", (("{quantity}", "value"),))]
    quantity: Literal["x", "y", "z", "force_x", "force_y", "force_z"]
    reference: Dimensionless = Quantity(0.0)
    gain: Dimensionless = Quantity(1.0)

    @staticmethod
    def output(value: float, reference: float, gain: float) -> float:
        """Return gain (value − reference)."""
        return gain * (value - reference)
