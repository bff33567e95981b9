"""Which values of a typed document follow a parameter, and what may stand there."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, get_args

from pydantic.fields import FieldInfo

from neuromech.components.base import SpecModel
from neuromech.spec.model import Experiment
from neuromech.units import BoundText, Quantity, Unit

_SECTIONS = ("network", "muscles", "sensors", "instances", "body", "world", "protocol", "solver", "record")


@dataclass(frozen=True, slots=True)
class Follower:
    """A value that follows a parameter: its path, the parameter's name, and what its field allows."""

    path: str
    parameter: str
    unit: Unit | None


def followers(experiment: Experiment) -> Iterator[Follower]:
    """Yield every value of a document that follows a parameter, in authored order."""
    for section in _SECTIONS:
        yield from _walk(getattr(experiment, section), section, None)


def field_unit(field: FieldInfo) -> Unit | None:
    """Return the unit that stands anywhere inside a field's annotation."""
    return next(_units([*field.metadata, field.annotation]), None)


def _walk(value: object, path: str, unit: Unit | None) -> Iterator[Follower]:
    if isinstance(value, Quantity):
        if value.parameter is not None:
            yield Follower(path, value.parameter, unit)
    elif isinstance(value, BoundText):
        yield Follower(path, value.parameter, unit)
    elif isinstance(value, SpecModel):
        for name, field in type(value).model_fields.items():
            yield from _walk(getattr(value, name), f"{path}.{name}", field_unit(field))
    elif isinstance(value, dict):
        for name, item in value.items():
            yield from _walk(item, f"{path}.{name}", unit)
    elif isinstance(value, tuple):
        for index, item in enumerate(value):
            yield from _walk(item, f"{path}.{index}", unit)


def _units(marks: list[Any]) -> Iterator[Unit]:
    for mark in marks:
        if isinstance(mark, Unit):
            yield mark
        else:
            yield from _units([*get_args(mark)])
