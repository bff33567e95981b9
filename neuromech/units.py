"""The words for quantities: text with a unit in, one SI number out.

Dimensions are checked by pint with the units of `units.txt`. An angle is a dimension of its own there, so that
`9` is no angle and `9 deg` is no weight.
"""

import json
import math
import re
from dataclasses import dataclass, replace
from functools import cache, lru_cache
from importlib import import_module
from pathlib import Path
from typing import Annotated, Any, Self

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import PydanticCustomError, core_schema

NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
_TEXT = re.compile(rf"^\s*({NUMBER})\s*(.*?)\s*$")
_NOT_FINITE = re.compile(r"^\s*[-+]?\.?(nan|inf(inity)?)\b", re.IGNORECASE)
_POWER = r"(?:(?:\^|\*\*)-?\d(?:\.5)?)?"
_BETWEEN = r"(?:\s*[*/]\s*|\s+)"
_WORD = rf"(?:1|%|[A-Za-zµ]+){_POWER}"
_FACTOR = rf"(?:{_WORD}|\({_WORD}(?:{_BETWEEN}{_WORD})*\){_POWER})"
_UNIT_TEXT = re.compile(rf"^(?:{_FACTOR}(?:{_BETWEEN}{_FACTOR})*)?$")


class Quantity(float):
    """A number in SI units that remembers which named parameter of the document it follows, if any."""

    __slots__ = ("parameter",)

    parameter: str | None

    def __new__(cls, value: float, parameter: str | None = None) -> Self:
        """Make a quantity from its SI value and the name of the parameter that it follows."""
        self = super().__new__(cls, value)
        self.parameter = parameter
        return self

    def __getnewargs__(self) -> tuple[float, str | None]:  # type: ignore[override]
        """Keep the parameter through copying and pickling; `float` only knows the value."""
        return (float(self), self.parameter)


class BoundText(str):
    """The text of a parameter's value where a document says `${name}`; `parameter` is that name."""

    __slots__ = ("parameter",)

    parameter: str

    def __new__(cls, text: str, parameter: str) -> Self:
        """Make the text of the parameter's value."""
        self = super().__new__(cls, text)
        self.parameter = parameter
        return self

    def __getnewargs__(self) -> tuple[str, str]:  # type: ignore[override]
        """Keep the parameter through copying and pickling; `str` only knows the text."""
        return (str(self), self.parameter)


@cache
def common_units() -> dict[str, tuple[float, str]]:
    """Return factor and dimension of the units that documents mostly use, as pint gave them (see `units.txt`)."""
    table = json.loads(Path(__file__).with_name("common_units.json").read_text(encoding="utf-8"))
    return {unit: (factor, dimension) for unit, (factor, dimension) in table.items()}


@lru_cache(maxsize=4096)
def unit_factor(unit: str) -> tuple[float, str]:
    """Return the factor from `unit` to SI base units, and its dimension as text.

    Raises:
        ValueError: the text is no unit of `units.txt`.
    """
    if unit in common_units():
        return common_units()[unit]
    if len(unit) > 40 or not _UNIT_TEXT.match(unit):
        raise ValueError(f"'{unit[:40]}' is no unit")
    return resolved(unit)


def resolved(unit: str) -> tuple[float, str]:
    """Return factor and dimension of a unit as pint reads it.

    pint takes a quarter of a second to import, which a document with common units alone need not wait for.

    Raises:
        ValueError: the text is no unit of `units.txt`.
    """
    pint = import_module("pint")
    try:
        registry = _registry()
        parsed = registry.parse_units(unit)
        factor = float(registry.Quantity(1.0, parsed).to_base_units().magnitude)
        dimensions = sorted(registry.get_dimensionality(parsed).items())
        return factor, " ".join(f"{name}^{power:g}" for name, power in dimensions)
    except (pint.PintError, ArithmeticError, SyntaxError, TypeError, AttributeError) as error:
        raise ValueError(f"'{unit}' is no unit that is known here") from error


@cache
def _registry() -> Any:
    return import_module("pint").UnitRegistry(str(Path(__file__).with_name("units.txt")), system="SI")


@dataclass(frozen=True, slots=True)
class Unit:
    """What a field of a document must be: a dimension and bounds. Used as `Annotated[Quantity, Unit(...)]`.

    Args:
        name: the field's word for the quantity (`conductance`).
        example: a unit of it (`nS`); empty for a dimensionless number.
        above: exclusive lower bound in SI units.
        least: inclusive lower bound in SI units.
        most: inclusive upper bound in SI units.
    """

    name: str
    example: str
    above: float | None = None
    least: float | None = None
    most: float | None = None

    @property
    def positive(self) -> "Unit":
        """The same quantity, greater than zero."""
        return replace(self, above=0.0)

    @property
    def non_negative(self) -> "Unit":
        """The same quantity, zero or greater."""
        return replace(self, least=0.0)

    def within(self, least: float, most: float) -> "Unit":
        """Return the same quantity between two bounds in SI units, both included."""
        return replace(self, least=least, most=most)

    def parse(self, value: object) -> Quantity:
        """Read a quantity from what the author wrote.

        Raises:
            PydanticCustomError: no number, no unit, a wrong dimension, not finite, or out of bounds.
        """
        if isinstance(value, Quantity):
            return self._bounded(value, f"{float(value):g}")
        magnitude, unit = self._split(value)
        if math.isfinite(magnitude):
            magnitude *= self._factor(unit, value)
        return self._bounded(Quantity(magnitude, getattr(value, "parameter", None)), str(value))

    def _split(self, value: object) -> tuple[float, str]:
        if isinstance(value, int | float) and not isinstance(value, bool):
            return float(value), ""
        if not isinstance(value, str):
            raise self._error("not-a-quantity", value)
        if _NOT_FINITE.match(value):
            return math.nan, ""
        match = _TEXT.match(value)
        if match is None:
            raise self._error("not-a-quantity", value)
        return float(match[1]), match[2]

    def _factor(self, unit: str, value: object) -> float:
        if not unit and self.example:
            raise self._error("missing-unit", value)
        try:
            factor, dimension = unit_factor(unit)
        except ValueError as error:
            raise self._error("unknown-unit", value) from error
        if dimension != unit_factor(self.example)[1]:
            raise self._error("wrong-unit", value)
        return factor

    def _error(self, code: str, value: object) -> PydanticCustomError:
        word = {"unknown-unit": "unit is not known", "missing-unit": "unit is missing"}.get(code)
        article = "an" if self.name[0] in "aeiou" else "a"
        expected = f"must be {article} {self.name}" + (
            f" in units like {self.example}" if self.example else " without a unit"
        )
        message = f"{word}; {expected}" if word else expected
        hint = f"write for example '1.0 {self.example}'" if self.example else "write a bare number, for example 1.0"
        return PydanticCustomError(code, "{message}", {"message": message, "got": repr_short(value), "hint": hint})

    def _bounded(self, quantity: Quantity, text: str) -> Quantity:
        if not math.isfinite(quantity):
            message = "must be a finite number"
        elif self.above is not None and not quantity > self.above:
            message = f"must be greater than {self.written(self.above)}"
        elif self.least is not None and quantity < self.least:
            message = f"must be at least {self.written(self.least)}"
        elif self.most is not None and quantity > self.most:
            message = f"must be at most {self.written(self.most)}"
        else:
            return quantity
        raise PydanticCustomError("out-of-range", "{message}", {"message": message, "got": text, "hint": None})

    def written(self, value: float) -> str:
        """Return an SI value as text in the unit of the example."""
        return f"{value / unit_factor(self.example)[0]:g} {self.example}".strip()

    def __get_pydantic_core_schema__(self, _source: object, _handler: GetCoreSchemaHandler) -> core_schema.CoreSchema:
        """Validate with `parse`; serialise as a plain SI number."""
        return core_schema.no_info_plain_validator_function(
            self.parse, serialization=core_schema.plain_serializer_function_ser_schema(float)
        )

    def __get_pydantic_json_schema__(
        self, _schema: core_schema.CoreSchema, _handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        """Describe the text form for editors."""
        if not self.example:
            return {"anyOf": [{"type": "number"}, {"type": "string", "pattern": rf"^({NUMBER}( ?%)?|\$\{{.+\}})$"}]}
        return {
            "type": "string",
            "pattern": rf"^({NUMBER} .+|\$\{{.+\}})$",
            "description": f"a {self.name}, for example '1.0 {self.example}'",
        }


_SI_UNITS = (
    *("", "s", "m", "kg", "rad", "A", "N", "V", "S", "F", "J", "W", "Pa", "ohm", "1/s", "rad/s", "rad/s^2", "m/s"),
    *("m/s^2", "kg m^2", "m^2", "N m", "N/m", "N s/m", "N s", "N/rad", "N m/rad", "N m s/rad"),
    *("1/N", "1/rad", "s/rad", "V/s"),
)


@cache
def _si_unit_of_dimension() -> dict[str, str]:
    return {unit_factor(unit)[1]: unit for unit in reversed(_SI_UNITS)}


def si_unit(unit: str) -> str:
    """Return the usual SI unit of the same dimension (`mV` gives `V`, `deg` gives `rad`).

    Raises:
        ValueError: the unit is unknown, or its dimension has no usual SI unit.
    """
    if unit in _SI_UNITS:
        return unit
    dimension = unit_factor(unit)[1]
    if dimension not in _si_unit_of_dimension():
        raise ValueError(f"'{unit}' has no usual SI unit")
    return _si_unit_of_dimension()[dimension]


def repr_short(value: object, length: int = 60) -> str:
    """Return what was found in a document as short text: words quoted, numbers bare, structures named."""
    if isinstance(value, dict):
        return "a map"
    if isinstance(value, list | tuple):
        return "a list"
    if value is None:
        return "nothing"
    text = repr(str(value)) if isinstance(value, str) else str(value)
    text = text.lower() if isinstance(value, bool) else text
    return text if len(text) <= length else text[: length - 1] + "…"


def measure(value: str | int | float) -> tuple[float, str]:
    """Return the SI value and the dimension of a quantity of whatever dimension; not finite where it is written so.

    Raises:
        ValueError: the text has no number or an unknown unit.
    """
    if not isinstance(value, str):
        return float(value), unit_factor("")[1]
    match = _TEXT.match(value)
    if match is None:
        if _NOT_FINITE.match(value):
            return math.nan, ""
        raise ValueError(f"'{value[:40]}' is no quantity")
    factor, dimension = unit_factor(match[2])
    return float(match[1]) * factor, dimension


def unit_text(value: str | int | float) -> str:
    """Return the unit that a quantity is written with, empty where there is none."""
    return re.sub(rf"^\s*{NUMBER}\s*", "", str(value)).strip()


def quantity(text: str) -> Quantity:
    """Return the SI value of text such as `20 pF`, of whatever dimension. For defaults in our own code.

    Raises:
        ValueError: the text has no number or an unknown unit.
    """
    return Quantity(measure(text)[0])


DIMENSIONLESS = Unit("number", "")
VOLTAGE = Unit("voltage", "mV")
CONDUCTANCE = Unit("conductance", "nS")
CAPACITANCE = Unit("capacitance", "pF")
TIME = Unit("time", "ms")
RATE = Unit("rate", "1/s")
LENGTH = Unit("length", "mm")
MASS = Unit("mass", "kg")
FORCE = Unit("force", "N")
INVERSE_FORCE = Unit("gain per force", "1/N")
ANGLE = Unit("angle", "deg")
INVERSE_ANGLE = Unit("gain per angle", "1/rad")
ANGULAR_VELOCITY = Unit("angular velocity", "rad/s")
INVERSE_ANGULAR_VELOCITY = Unit("gain per angular velocity", "s/rad")
VELOCITY = Unit("velocity", "m/s")
ACCELERATION = Unit("acceleration", "m/s^2")
INERTIA = Unit("moment of inertia", "kg m^2")
TORQUE = Unit("torque", "N m")
JOINT_STIFFNESS = Unit("joint stiffness", "N m/rad")
JOINT_DAMPING = Unit("joint damping", "N m s/rad")
CONTACT_STIFFNESS = Unit("contact stiffness", "N/m")
CONTACT_DAMPING = Unit("contact damping", "N s/m")

Dimensionless = Annotated[Quantity, DIMENSIONLESS]
Voltage = Annotated[Quantity, VOLTAGE]
Time = Annotated[Quantity, TIME]
Length = Annotated[Quantity, LENGTH]
Force = Annotated[Quantity, FORCE]
Angle = Annotated[Quantity, ANGLE]
Velocity = Annotated[Quantity, VELOCITY]
