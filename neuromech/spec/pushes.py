"""Pushes of a protocol: single ones, and series whose times, places and strengths are drawn from the run's seed."""

from typing import Annotated

from pydantic import Field

from neuromech.components.base import SpecModel
from neuromech.spec.scalars import PositiveTime, Vector
from neuromech.units import ANGLE, DIMENSIONLESS, FORCE, LENGTH, TIME, Angle, Force, Length, Quantity, quantity

_Time = Annotated[Quantity, TIME.non_negative]
_Positive = Annotated[Quantity, DIMENSIONLESS.positive]


class RandomTime(SpecModel):
    """A random time, by one of several distributions. None of them gives negative times."""

    uniform: Annotated[tuple[_Time, _Time] | None, Field(description="lowest and highest")] = None
    gamma: Annotated[
        tuple[_Positive, PositiveTime] | None, Field(description="shape and scale; the mean is their product")
    ] = None
    f: Annotated[
        tuple[_Positive, _Positive, PositiveTime] | None,
        Field(description="degrees of freedom of numerator and denominator, and a time by which it is multiplied"),
    ] = None


class RandomAngle(SpecModel):
    """A random angle, by one of two distributions."""

    uniform: Annotated[tuple[Angle, Angle] | None, Field(description="lowest and highest")] = None
    normal: Annotated[
        tuple[Angle, Annotated[Quantity, ANGLE.non_negative]] | None, Field(description="mean and standard deviation")
    ] = None


class RandomLength(SpecModel):
    """A random length, by one of two distributions."""

    uniform: Annotated[tuple[Length, Length] | None, Field(description="lowest and highest")] = None
    normal: Annotated[
        tuple[Length, Annotated[Quantity, LENGTH.non_negative]] | None, Field(description="mean and standard deviation")
    ] = None


class Push(SpecModel):
    """A constant force on a segment for a time. Its impulse is force times duration, whatever the step."""

    segment: str
    point: Annotated[
        Vector | None, Field(description="where it acts, in the segment's frame; at the centre of mass if not given")
    ] = None
    force: Annotated[tuple[Force, Force, Force], Field(description="along the axes of the world")]
    start: _Time
    duration: PositiveTime
    delay: Annotated[RandomTime | None, Field(description="random time that is added to start")] = None


class PushSeries(SpecModel):
    """Constant forces one after another, that grow stronger. Source: Dzeladini 2013, section 2.2.4.1 and figure 2.7.

    The i-th force is drawn from a normal distribution with mean `force` i/n and standard deviation `deviation` i/n,
    where n is `growing_over`; later ones have `force` and `deviation`.
    """

    segment: str
    point: Annotated[Vector, Field(description="in the segment's frame; heights count from here along its z")] = (
        quantity("0 m"),
        quantity("0 m"),
        quantity("0 m"),
    )
    height: RandomLength
    force: Annotated[Quantity, FORCE.non_negative]
    deviation: Annotated[Quantity, FORCE.non_negative] = quantity("0 N")
    growing_over: Annotated[int, Field(ge=1, strict=True, description="number of pushes")] = 1
    angle: Annotated[RandomAngle, Field(description="of the force with the horizontal, upwards")]
    heading: Annotated[RandomAngle | None, Field(description="of its horizontal part, 0 forward, 90 deg left")] = None
    duration: RandomTime
    interval: Annotated[RandomTime, Field(description="before each push, without one")]
    start: Annotated[_Time, Field(description="when the first interval begins")] = quantity("0 s")
    end: Annotated[PositiveTime | None, Field(description="when the last push may begin; that of the run at most")] = (
        None
    )
