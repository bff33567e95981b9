"""A weight on a string that hits the body."""

from typing import Annotated, Literal

from pydantic import Field

from neuromech.components.base import SpecModel
from neuromech.spec.scalars import PositiveTime, Vector
from neuromech.units import LENGTH, MASS, TIME, Quantity, quantity


class Pendulum(SpecModel):
    """A weight on a massless string, released from horizontal, that hits a segment and nothing else.

    With `target` the pivot is put, at the time of release, where the weight hits that point of the segment at the
    lowest point of its swing if it goes on as it went during the last second. With `pivot` it is where you say.
    Source: Habu 2020, section 3.5.2.
    """

    segment: Annotated[str, Field(description="that is hit; its shape is what the weight touches")]
    mass: Annotated[Quantity, MASS.positive]
    radius: Annotated[Quantity, LENGTH.positive] = quantity("30 mm")
    string: Annotated[Quantity, LENGTH.positive, Field(description="from the pivot to the middle of the weight")] = (
        quantity("0.5 m")
    )
    side: Annotated[
        Literal["front", "back", "left", "right"],
        Field(description="from which it comes: of the segment's heading with target, of the world with pivot"),
    ] = "front"
    target: Annotated[Vector | None, Field(description="point that it hits, in the segment's frame")] = None
    pivot: Annotated[Vector | None, Field(description="in the world")] = None
    release: Annotated[Quantity, TIME.non_negative]
    stays: Annotated[bool, Field(strict=True, description="it goes on swinging after it hit")] = False
    taken_away: Annotated[
        PositiveTime, Field(description="how long after its first touch it goes back to where it was released")
    ] = quantity("100 ms")
