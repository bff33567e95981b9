"""Single values that stand in several sections of a document."""

from typing import Annotated

from pydantic import Field, StrictFloat, StrictInt, StringConstraints, ValidatorFunctionWrapHandler, WrapValidator

from neuromech.units import TIME, BoundText, Length, Quantity

NAME_PATTERN = r"^[A-Za-z][A-Za-z0-9_+-]*$"
Name = Annotated[str, StringConstraints(pattern=NAME_PATTERN)]
Vector = tuple[Length, Length, Length]
Written = str | StrictInt | StrictFloat


def _keep_parameter(value: object, handler: ValidatorFunctionWrapHandler) -> object:
    return value if isinstance(value, BoundText) else handler(value)


Following = Annotated[Written, WrapValidator(_keep_parameter)]
"""A written value that remembers the parameter that it follows."""
PositiveTime = Annotated[Quantity, TIME.positive]
Seed = Annotated[int, Field(ge=0, strict=True)]
