"""Every signal of a model: what a run can record, and in which unit it is shown."""

import re
from collections.abc import Iterable
from fnmatch import translate

from neuromech.components.base import Component, Port
from neuromech.graph.mechanics import inputs, outputs
from neuromech.graph.model import Element, ModelGraph


def signals(graph: ModelGraph) -> dict[str, str]:
    """Return name → unit to show (empty for a number) of every signal, in authored order of the elements.

    A name is the element's qualified name, a dot, and the name of one of its states, outputs or input ports; for
    joints, segments and contacts one of the quantities of `neuromech.graph.mechanics`.
    """
    found = dict[str, str]()
    for element in graph.elements():
        for port in (*_states(element), *outputs(element), *inputs(element)):
            unit = _unit_of_source(graph, element, port) if port.unit == "*" else port.unit
            found.setdefault(f"{element.name}.{port.name}", unit)
    return found


def states(graph: ModelGraph) -> dict[str, str]:
    """Return name → unit to show of every state that `protocol.initial` can set."""
    return {f"{element.name}.{port.name}": port.unit for element in graph.elements() for port in _states(element)}


def matching(pattern: str, names: Iterable[str]) -> list[str]:
    """Return the names that a pattern matches, in their order; `*` stands for any text, `?` for one character."""
    matches = re.compile(translate(pattern)).match
    return [name for name in names if matches(name)]


def _states(element: Element) -> tuple[Port, ...]:
    spec = element.spec
    found = spec.states if isinstance(spec, Component) else ()
    return tuple(Port(state.name, state.unit) for state in found)


def _unit_of_source(graph: ModelGraph, element: Element, port: Port) -> str:
    """Return the unit of what feeds a port that accepts any unit."""
    for sender, _, connection in graph.graph.in_edges(element.name, data="connection"):
        if connection.port == port.name:
            return next(found.unit for found in outputs(graph.element(sender)) if found.name == connection.output)
    return ""
