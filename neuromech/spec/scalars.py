"""Single values that stand in several sections of a document."""

from typing import Annotated

from pydantic import Field, StrictFloat, StrictInt, StringConstraints

from neuromech.units import TIME, Length, Quantity

NAME_PATTERN = r"^[A-Za-z][A-Za-z0-9_+-]*$"
Name = Annotated[str, StringConstraints(pattern=NAME_PATTERN)]
Vector = tuple[Length, Length, Length]
Written = str | StrictInt | StrictFloat
PositiveTime = Annotated[Quantity, TIME.positive]
Seed = Annotated[int, Field(ge=0, strict=True)]
