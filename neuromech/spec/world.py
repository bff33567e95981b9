"""The world of a body: gravity, and the ground with its slopes and steps. World axes: x forward, y left, z up."""

from math import pi
from typing import Annotated

from pydantic import Field

from neuromech.components.base import SpecModel
from neuromech.spec.pendulum import Pendulum
from neuromech.spec.pushes import RandomLength
from neuromech.spec.scalars import Name
from neuromech.units import ACCELERATION, ANGLE, DIMENSIONLESS, LENGTH, Length, Quantity, quantity

Friction = Annotated[Quantity, DIMENSIONLESS.non_negative]
PositiveLength = Annotated[Quantity, LENGTH.positive]
Angle45 = Annotated[Quantity, ANGLE.within(-pi / 4, pi / 4)]


class Slope(SpecModel):
    """A stretch that rises along x, or falls where its angle is negative, as wide as the ground.

    Before, between and after slopes the ground is level, at the height that was reached.
    """

    start: Annotated[Length, Field(description="x where it begins")]
    length: Annotated[PositiveLength, Field(description="along x")]
    angle: Angle45
    friction: Annotated[Friction | None, Field(description="that of the ground where it is not given")] = None


class Step(SpecModel):
    """A block on the ground, on one slope or on level ground, with faces along x and y."""

    start: Annotated[Length, Field(description="x of its front")]
    length: Annotated[PositiveLength, Field(description="along x")]
    middle: Annotated[Length, Field(description="y of its middle")] = quantity("0 m")
    width: Annotated[PositiveLength, Field(description="along y")]
    height: PositiveLength
    friction: Annotated[Friction | None, Field(description="that of the ground where it is not given")] = None


class Incline(SpecModel):
    """Ground that gets steadily steeper along x, in pieces of equal length; level ground lies before and after it."""

    start: Annotated[Length, Field(description="x where it begins")]
    length: Annotated[PositiveLength, Field(description="along x")]
    angle: Annotated[Angle45, Field(description="of its last piece; negative where it falls")]
    pieces: Annotated[int, Field(ge=1, le=1000, strict=True)] = 20


class Waves(SpecModel):
    """A row of trapezoids along x that get steeper, drawn from the run's seed. Source: Dzeladini 2013, 2.2.4.2.

    The i-th rises and falls by `angle` i/n, where n is `growing_over`; later ones by `angle`.
    """

    start: Annotated[Length, Field(description="x where the first space begins")]
    number: Annotated[int, Field(ge=1, le=1000, strict=True, description="of trapezoids")]
    angle: Annotated[Quantity, ANGLE.within(0.0, pi / 4)]
    growing_over: Annotated[int, Field(ge=1, strict=True, description="number of trapezoids")] = 1
    length: Annotated[RandomLength, Field(description="of a trapezoid along x; what is not positive is drawn again")]
    space: Annotated[RandomLength, Field(description="before each trapezoid; what is not positive is drawn again")]
    top: Annotated[
        Quantity, DIMENSIONLESS.within(0.0, 0.9), Field(description="share of a trapezoid that is level")
    ] = quantity("0.3333333333333333")


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
        Field(description="where it begins and ends; without end where not given, with slopes from -10 m to 10 m"),
    ] = None
    slopes: Annotated[tuple[Slope, ...], Field(description="in order along x")] = ()
    incline: Annotated[Incline | None, Field(description="in place of slopes")] = None
    waves: Annotated[Waves | None, Field(description="in place of slopes")] = None
    steps: dict[Name, Step] = {}


class World(SpecModel):
    """Gravity (downwards), ground, and weights on strings."""

    gravity: Annotated[Quantity, ACCELERATION.non_negative] = quantity("9.81 m/s^2")
    ground: Ground | None = None
    pendulums: dict[Name, Pendulum] = {}
