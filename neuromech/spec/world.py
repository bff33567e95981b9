"""The world of a body: gravity, and the ground with its slopes and steps. World axes: x forward, y left, z up."""

from math import pi
from typing import Annotated

from pydantic import Field

from neuromech.components.base import SpecModel
from neuromech.spec.scalars import Name
from neuromech.units import ACCELERATION, ANGLE, DIMENSIONLESS, LENGTH, Length, Quantity, quantity

Friction = Annotated[Quantity, DIMENSIONLESS.non_negative]
PositiveLength = Annotated[Quantity, LENGTH.positive]
Incline = Annotated[Quantity, ANGLE.within(-pi / 4, pi / 4)]


class Slope(SpecModel):
    """A stretch that rises along x, or falls where its angle is negative, as wide as the ground.

    Before, between and after slopes the ground is level, at the height that was reached.
    """

    start: Annotated[Length, Field(description="x where it begins")]
    length: Annotated[PositiveLength, Field(description="along x")]
    angle: Incline
    friction: Annotated[Friction | None, Field(description="that of the ground where it is not given")] = None


class Step(SpecModel):
    """A block on the ground, on one slope or on level ground, with faces along x and y."""

    start: Annotated[Length, Field(description="x of its front")]
    length: Annotated[PositiveLength, Field(description="along x")]
    middle: Annotated[Length, Field(description="y of its middle")] = quantity("0 m")
    width: Annotated[PositiveLength, Field(description="along y")]
    height: PositiveLength
    friction: Annotated[Friction | None, Field(description="that of the ground where it is not given")] = None


class Ground(SpecModel):
    """Level ground, with slopes along x and steps on it."""

    height: Length = quantity("0 m")
    friction: Friction = quantity("1")
    x: Annotated[
        tuple[Length, Length] | None,
        Field(description="where it begins and ends; without end where not given, with slopes from -100 m to 1000 m"),
    ] = None
    y: Annotated[
        tuple[Length, Length] | None,
        Field(description="where it begins and ends; without end where not given, with slopes from -100 m to 100 m"),
    ] = None
    slopes: Annotated[tuple[Slope, ...], Field(description="in order along x")] = ()
    steps: dict[Name, Step] = {}


class World(SpecModel):
    """Gravity (downwards) and ground."""

    gravity: Annotated[Quantity, ACCELERATION.non_negative] = quantity("9.81 m/s^2")
    ground: Ground | None = None
