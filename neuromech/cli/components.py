"""`neuromech components`: the vocabulary as tables."""

from collections.abc import Iterable
from typing import get_args, get_origin

from pydantic.fields import FieldInfo
from pydantic_core import PydanticUndefined
from rich.table import Table
from rich.text import Text

from neuromech.cli.consoles import results
from neuromech.cli.terminal import FINISHED, write_line
from neuromech.components.base import Component, Port
from neuromech.components.catalogue import Catalogue
from neuromech.errors import DocumentError, Problem, did_you_mean
from neuromech.units import Quantity, Unit, unit_factor


def components(kind: str | None) -> int:
    """Show one line for each kind, or one kind (or each kind of a family) in full; return the exit code.

    Raises:
        DocumentError: there is no such kind or family.
    """
    classes = list(Catalogue.installed().classes.values())
    if kind is None:
        results().print(overview(classes))
        return FINISHED
    chosen = [cls for cls in classes if kind in (cls.kind_name(), cls.family)]
    if not chosen:
        words = {word for cls in classes for word in (cls.kind_name(), cls.family)}
        raise DocumentError([Problem("unknown-kind", "", f"'{kind}' is no kind", hint=did_you_mean(kind, words))])
    for cls in chosen:
        show(cls)
    return FINISHED


def overview(classes: Iterable[type[Component]]) -> Table:
    """Return a table of kinds: family, inputs, outputs, source."""
    table = Table("kind", "family", "inputs", "outputs", "source", box=None, pad_edge=False)
    for cls in sorted(classes, key=lambda cls: (cls.family, cls.kind_name())):
        cells = (cls.kind_name(), cls.family, _ports(cls.inputs), _ports(cls.outputs), cls.source)
        table.add_row(*(Text(cell) for cell in cells))
    return table


def show(cls: type[Component]) -> None:
    """Write one kind in full: what it is, its ports, states and parameters."""
    meaning = (cls.__doc__ or "").strip().partition("\n")[0]
    states = ", ".join(state.name for state in cls.states) or "none"
    write_line(f"{cls.kind_name()} ({cls.family}): {meaning}")
    write_line(f"source: {cls.source}")
    write_line(f"inputs: {_ports(cls.inputs) or 'none'}; outputs: {_ports(cls.outputs) or 'none'}; states: {states}")
    results().print(parameter_table(cls))
    write_line("")


def parameter_table(cls: type[Component]) -> Table:
    """Return a table of the parameters of a kind: unit, default and bounds."""
    table = Table("parameter", "unit or type", "default", "bounds", box=None, pad_edge=False)
    for name, field in cls.model_fields.items():
        if name != "kind":
            unit = _unit(field)
            cells = (name, _type(field, unit), _default(field, unit), _bounds(unit) if unit else "")
            table.add_row(*(Text(cell) for cell in cells))
    return table


def _unit(field: FieldInfo) -> Unit | None:
    return next((mark for mark in field.metadata if isinstance(mark, Unit)), None)


def _type(field: FieldInfo, unit: Unit | None) -> str:
    if unit:
        return unit.example or "number"
    reference = next((mark.to for mark in field.metadata if hasattr(mark, "wires")), None)
    return f"name of a {reference}" if reference else _type_name(field.annotation)


def _type_name(annotation: object) -> str:
    """Return a class's name, a literal's words, or those of the parts of a union."""
    if annotation is type(None):
        return "nothing"
    if isinstance(annotation, type) and not get_args(annotation):
        return annotation.kind_name() if issubclass(annotation, Component) else annotation.__name__
    parts = [part if isinstance(part, str) else _type_name(part) for part in get_args(annotation)]
    name = get_origin(annotation)
    return f"{name.__name__} of {', '.join(parts)}" if name in (dict, list, tuple) else " or ".join(parts)


def _default(field: FieldInfo, unit: Unit | None) -> str:
    if field.default is PydanticUndefined:
        return "required"
    if unit and isinstance(field.default, Quantity):
        return _in_unit(field.default, unit)
    return "none" if field.default is None else str(field.default)


def _bounds(unit: Unit) -> str:
    lower = f"> {_in_unit(unit.above, unit)}" if unit.above is not None else ""
    least = f"≥ {_in_unit(unit.least, unit)}" if unit.least is not None else ""
    most = f"≤ {_in_unit(unit.most, unit)}" if unit.most is not None else ""
    return ", ".join(bound for bound in (lower, least, most) if bound)


def _in_unit(value: float, unit: Unit) -> str:
    return f"{value / unit_factor(unit.example)[0]:g} {unit.example}".strip()


def _ports(ports: Iterable[Port]) -> str:
    return ", ".join(f"{port.name} [{port.unit}]" if port.unit else port.name for port in ports)
