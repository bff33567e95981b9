"""The ways that muscles take over joints."""

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from neuromech.components.base import Path, SpecModel
from neuromech.units import DIMENSIONLESS, LENGTH, Angle, Length, Quantity, quantity


class ConstantMomentArms(Path):
    """Length changes linearly with joint angle: l = l_ref − Σ r_j (q_j − q_ref,j)."""

    kind: Literal["constant_moment_arms"] = "constant_moment_arms"
    source: ClassVar[str] = "An et al. 1984, doi:10.1115/1.3138499 (moment arm r = −dl/dq)"

    reference_length: Annotated[Quantity, LENGTH.positive]
    reference_angles: dict[str, Angle] = Field(min_length=1)
    moment_arms: dict[str, Length] = Field(min_length=1)


class PathPoint(SpecModel):
    """A point that a muscle passes, fixed in a segment."""

    segment: str
    position: tuple[Length, Length, Length]


class StraightLines(Path):
    """Straight lines from origin over via points to insertion; moment arms follow from the geometry."""

    kind: Literal["straight_lines"] = "straight_lines"
    source: ClassVar[str] = "Delp & Loan 1995, doi:10.1016/0010-4825(95)98882-E"

    points: tuple[PathPoint, ...] = Field(min_length=2)


class _LeverArm(SpecModel):
    radius: Annotated[Length, Field(description="largest lever arm; positive where the muscle turns the joint forward")]
    reference_angle: Annotated[Angle, Field(description="joint angle at the reference length of the path")]
    zero_angle: Annotated[Angle, Field(description="joint angle, as counted here, where the body's is zero")] = (
        quantity("0 deg")
    )


class ConstantArm(_LeverArm):
    """The same lever arm at every angle: r = r_0 (Dzeladini 2013 eq. 2.18)."""

    kind: Literal["constant"]


class _PeakedArm(_LeverArm):
    angle_of_maximum: Annotated[Angle, Field(description="joint angle at which the lever arm is the radius")]


class CosineArm(_PeakedArm):
    """r = r_0 cos(φ − φ_max) (Dzeladini 2013 eq. 2.19)."""

    kind: Literal["cosine"]


class GeometricArm(_PeakedArm):
    """A straight line between two segments: r = r_0 sin φ / √(1 + a² − 2 a cos φ), a = cos φ_max (eq. 2.20).

    The angle between the segments is φ, so that `zero_angle` matters.
    """

    kind: Literal["geometric"]


LeverArm = ConstantArm | CosineArm | GeometricArm


class LeverArms(Path):
    """Lever arms that depend on their own joint's angle; the length is their integral.

    l = l_ref − ρ Σ_j ∫ r_j dφ_j from the reference angle on. With a pennation factor ρ below 1, length changes less
    than the lever arms say, while the torque is r F as ever: muscle and joint power then differ by that factor.
    """

    kind: Literal["lever_arms"] = "lever_arms"
    source: ClassVar[str] = "Dzeladini 2013 eq. 2.17–2.24; Geyer & Herr 2010, doi:10.1109/TNSRE.2010.2047592"

    reference_length: Annotated[Quantity, LENGTH.positive]
    pennation_factor: Annotated[Quantity, DIMENSIONLESS.within(0.0, 1.0)] = quantity("1")
    arms: dict[str, Annotated[LeverArm, Field(discriminator="kind")]] = Field(min_length=1)


MusclePath = Annotated[ConstantMomentArms | StraightLines | LeverArms, Field(discriminator="kind")]
