"""Every value of a part of a document as text in the unit of its field, by dotted path."""

from collections.abc import Mapping

from pydantic import BaseModel

from neuromech.spec.follow import field_unit
from neuromech.units import Quantity, Unit, unit_factor


def values(part: BaseModel, path: str, leave_out: frozenset[str] = frozenset()) -> dict[str, str]:
    """Return path → text of every value in a part of a document, without those that are absent.

    Args:
        part: any typed part.
        path: its own dotted path, with which the paths of the values begin.
        leave_out: fields of the part itself that are not wanted.
    """
    found: dict[str, str] = {}
    for name, field in type(part).model_fields.items():
        if name not in leave_out:
            found |= _values(getattr(part, name), f"{path}.{name}", field_unit(field))
    return found


def _values(value: object, path: str, unit: Unit | None) -> dict[str, str]:
    if value is None:
        return {}
    if isinstance(value, BaseModel):
        return values(value, path)
    if isinstance(value, Mapping):
        return {
            key: text for name, inner in value.items() for key, text in _values(inner, f"{path}.{name}", unit).items()
        }
    if isinstance(value, tuple | list):
        if any(isinstance(item, BaseModel) for item in value):
            indexed = {str(index): item for index, item in enumerate(value)}
            return _values(indexed, path, unit)
        return {path: f"[{', '.join(_text(item, unit) for item in value)}]"}
    return {path: _text(value, unit)}


def _text(value: object, unit: Unit | None) -> str:
    """Return a value as an author would write it; what follows a parameter is written as `${name}`."""
    if isinstance(value, Quantity):
        if value.parameter is not None:
            return f"${{{value.parameter}}}"
        symbol = unit.example if unit is not None else ""
        return f"{float(value) / unit_factor(symbol)[0]:.10g} {symbol}".strip()
    return str(value)
