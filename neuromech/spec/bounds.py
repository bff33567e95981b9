"""The bounds of a parameter: its value, and every value that a protocol gives it, lie within them."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Self

from neuromech.errors import Problem
from neuromech.spec.model import Parameter
from neuromech.spec.node import join
from neuromech.spec.scalars import Written
from neuromech.units import measure, repr_short

_LIMITS = ("minimum", "maximum")


@dataclass(frozen=True, slots=True)
class Bounds:
    """Dimension and limits (SI units) of a parameter, and the limits as written."""

    dimension: str
    unit: str
    least: float
    most: float
    least_text: str
    most_text: str

    @classmethod
    def of(cls, parameter: Parameter) -> Self | None:
        """Return the bounds of a parameter, or None where they cannot be read; that is reported elsewhere."""
        try:
            _, dimension = measure(parameter.value)
            least = -math.inf if parameter.minimum is None else measure(parameter.minimum)[0]
            most = math.inf if parameter.maximum is None else measure(parameter.maximum)[0]
        except ValueError:
            return None
        return cls(dimension, str(parameter.value), least, most, str(parameter.minimum), str(parameter.maximum))


def check_parameter(parameter: Parameter, path: str) -> Iterator[Problem]:
    """Yield what is wrong with a parameter in itself."""
    readable = [
        _readable(value, join(path, key))
        for key in ("value", "minimum", "maximum")
        if (value := getattr(parameter, key)) is not None
    ]
    problems = [problem for problem in readable if problem is not None]
    yield from problems
    bounds = Bounds.of(parameter)
    if problems or bounds is None:
        return
    odd = _of_another_dimension(parameter, path)
    if odd is not None:
        yield odd
        return
    if bounds.least > bounds.most:
        message = f"must not be below the minimum, {bounds.least_text}"
        yield Problem("out-of-range", join(path, "maximum"), message, repr_short(parameter.maximum))
    else:
        yield from _inside(parameter.value, bounds, join(path, "value"), "")


def _of_another_dimension(parameter: Parameter, path: str) -> Problem | None:
    """Return the problem of a limit that is no such quantity as the value; of the value where both limits say so."""
    value, *limits = parameter.value, parameter.minimum, parameter.maximum
    dimensions = {key: measure(one)[1] for key, one in zip(_LIMITS, limits, strict=True) if one is not None}
    odd = [key for key, dimension in dimensions.items() if dimension != measure(value)[1]]
    if not odd:
        return None
    if len(odd) == len(_LIMITS) and len(set(dimensions.values())) == 1:
        message = f"must have the dimension of its limits, '{limits[0]}' and '{limits[1]}'"
        return Problem("wrong-unit", join(path, "value"), message, repr_short(value))
    message = f"must have the dimension of the value, '{value}'"
    return Problem("wrong-unit", join(path, odd[0]), message, repr_short(getattr(parameter, odd[0])))


def check_value(value: Written, bounds: Bounds, name: str, path: str) -> Iterator[Problem]:
    """Yield what is wrong with a value that a protocol gives to the parameter `name`."""
    unreadable = _readable(value, path)
    if unreadable is not None:
        yield unreadable
    elif measure(value)[1] != bounds.dimension:
        message = f"must have the dimension of the parameter '{name}', '{bounds.unit}'"
        yield Problem("wrong-unit", path, message, repr_short(value))
    else:
        yield from _inside(value, bounds, path, f" of the parameter '{name}'")


def _readable(value: Written, path: str) -> Problem | None:
    try:
        number, _ = measure(value)
    except ValueError as error:
        return Problem("not-a-quantity", path, f"must be a quantity: {error}", repr_short(value))
    if not math.isfinite(number):
        return Problem("out-of-range", path, "must be a finite number", repr_short(value))
    return None


def _inside(value: Written, bounds: Bounds, path: str, owner: str) -> Iterator[Problem]:
    number, _ = measure(value)
    got = repr_short(value)
    if number < bounds.least:
        yield Problem("out-of-range", path, f"is below the minimum{owner}, {bounds.least_text}", got)
    elif number > bounds.most:
        yield Problem("out-of-range", path, f"is above the maximum{owner}, {bounds.most_text}", got)
