"""Every signal of a model: what a run can record, and in which unit it is shown."""

import re
from collections.abc import Collection, Mapping
from dataclasses import replace
from fnmatch import translate
from types import MappingProxyType

from neuromech.components.base import Component, Port, State
from neuromech.graph.mechanics import inputs, outputs
from neuromech.graph.model import Element, ModelGraph
from neuromech.units import Unit

_INDEXED = re.compile(r"(.+)\[(\*|\d+|\d*:\d*(?::[1-9]\d*)?)\]\.([^.\[\]]+)$")
_WILDCARD = re.compile(r"[*?\[]")
_NONE: Mapping[str, int] = MappingProxyType({})


def signals(graph: ModelGraph) -> dict[str, str]:
    """Return name → unit to show (empty for a number) of every signal, in authored order of the elements.

    A name is the element's qualified name, a dot, and the name of one of its states, outputs or input ports; for
    joints, segments and contacts one of the quantities of `neuromech.graph.mechanics`. The signals of a population are
    means over its neurons; those of a single neuron, such as `pool[17].activity`, are not listed.
    """
    found = dict[str, str]()
    for element in graph.elements():
        for port in (*_states(element), *outputs(element), *inputs(element)):
            unit = _unit_of_source(graph, element, port) if port.unit == "*" else port.unit
            found.setdefault(f"{element.name}.{port.name}", unit)
    return found


def states(graph: ModelGraph) -> dict[str, Unit]:
    """Return name → unit, with its bounds, of every state that `protocol.initial` can set."""
    return {
        f"{element.name}.{state.name}": _unit(element.spec, state)
        for element in graph.elements()
        if isinstance(element.spec, Component)
        for state in element.spec.states
    }


def _unit(component: Component, state: State) -> Unit:
    """Return the unit of a state, with the bounds of the parameter that holds its value at time zero."""
    marks = type(component).model_fields[state.initial].metadata
    bounds = next(mark for mark in marks if isinstance(mark, Unit))
    return replace(bounds, name="value", example=state.unit)


def sizes(graph: ModelGraph) -> dict[str, int]:
    """Return the number of neurons of each population."""
    return {element.name: element.size for element in graph.elements("population")}


def matching(pattern: str, names: Collection[str], populations: Mapping[str, int] = _NONE) -> list[str]:
    """Return the names that a pattern matches, in their order; `*` stands for any text, `?` for one character.

    Neurons of a population are chosen by index or slice: `pool[17].activity`, `pool[0:100].activity`,
    `pool[*].activity`. They match such names in `names`, and the neurons of `populations` whose mean is in `names`.

    Args:
        pattern: the pattern.
        names: of signals.
        populations: number of neurons of each population whose single neurons have no names in `names`.
    """
    indexed = _INDEXED.match(pattern)
    if indexed is None and not _WILDCARD.search(pattern):
        return [pattern] if pattern in names else []
    if indexed is None:
        return list(filter(re.compile(translate(pattern)).match, names))
    element, index, quantity = indexed.groups()
    matches = re.compile(translate(f"{element}.{quantity}")).match
    found = list[str]()
    for name in names:
        own, number, signal = split(name)
        if not matches(f"{own}.{signal}"):
            continue
        if number is not None:
            found += [name] if number in _indices(index, number + 1) else []
        else:
            found += (f"{own}[{i}].{signal}" for i in _indices(index, populations.get(own, 0)))
    return found


def split(name: str) -> tuple[str, int | None, str]:
    """Return element, index in its population (None without one) and quantity of a signal's name."""
    element, _, quantity = name.rpartition(".")
    if not element.endswith("]"):
        return element, None, quantity
    element, _, number = element[:-1].rpartition("[")
    return element, int(number), quantity


def _indices(text: str, size: int) -> range:
    """Return the indices below `size` that `*`, a number or a slice `first:last:step` stands for."""
    if text == "*":
        return range(size)
    if ":" not in text:
        return range(int(text), min(int(text) + 1, size))
    return range(size)[slice(*(int(part) if part else None for part in text.split(":")))]


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
