"""Neurons, populations, drives, sensors and muscles → blocks of states, inputs, signals and parameters."""

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

import networkx as nx
import numpy as np

from neuromech.compiler.buffers import Buffer
from neuromech.compiler.layout import Layout
from neuromech.compiler.numerics import Floats
from neuromech.compiler.shape import KindShape, evaluated_with_body, is_divided, parameter_names
from neuromech.compiler.wiring import varied
from neuromech.components.base import Component, Port, State
from neuromech.graph.model import Element, ModelGraph

_AT_A_TIME = 8


@dataclass(frozen=True)
class Block:
    """All elements of one component class, sorted by name so that authored order changes nothing.

    A population takes as many places of the block as it has neurons. Where a step is long work for each instance,
    places that nobody looks at fill the block up to a multiple of what a processor evaluates at a time: what is left
    over would take longer than all the rest.
    """

    shape: KindShape
    elements: tuple[Element, ...]
    components: tuple[Component, ...]

    @cached_property
    def starts(self) -> list[int]:
        """Place of the first neuron of each element in the block, and last the number of all."""
        return [0, *np.cumsum([element.size for element in self.elements]).tolist()]

    @property
    def count(self) -> int:
        """Number of places."""
        used = self.starts[-1]
        return -(-used // _AT_A_TIME) * _AT_A_TIME if is_divided(self.shape.cls) else used

    def values(self, parameter: str) -> Floats:
        """Return a parameter at every place; (count,), SI units."""
        found = np.empty(self.count)
        for element, component, start in zip(self.elements, self.components, self.starts, strict=False):
            found[start : start + element.size] = _of_element(element, component, parameter)
        found[self.starts[-1] :] = found[self.starts[-1] - 1]
        return found


def _of_element(element: Element, component: Component, parameter: str) -> Floats | float:
    population = element.population
    if population is None or parameter not in population.vary:
        return float(getattr(component, parameter))
    return varied(population.vary[parameter], population.size, population.seed, f"{element.name}.{parameter}")


def blocks(graph: ModelGraph) -> tuple[Block, ...]:
    """Return the elements with equations, grouped by class, classes sorted by kind."""
    grouped: dict[type[Component], list[Element]] = {}
    for element in graph.elements("neuron", "population", "drive", "sensor", "muscle"):
        if isinstance(element.spec, Component):
            grouped.setdefault(type(element.spec), []).append(element)
    turns = _turns(graph, grouped)
    return tuple(_block(cls, grouped[cls], turns.get(cls)) for cls in sorted(grouped, key=_by_kind))


def _turns(graph: ModelGraph, grouped: dict[type[Component], list[Element]]) -> dict[type[Component], int]:
    """Return the turn of each muscle or sensor class that needs only classes that had their turn before it."""
    of = {element.name: cls for cls, elements in grouped.items() if evaluated_with_body(cls) for element in elements}
    needs: nx.DiGraph[type[Component]] = nx.DiGraph()
    needs.add_nodes_from(of.values())
    for sender, receiver, _ in graph.connections("wire", "synapse", "projection"):
        if sender in of and receiver in of:
            needs.add_edge(of[sender], of[receiver])
    for circle in list(nx.strongly_connected_components(needs)):
        if len(circle) > 1 or any(needs.has_edge(cls, cls) for cls in circle):
            late = circle.union(*(nx.descendants(needs, cls) for cls in circle))
            needs.remove_nodes_from(late)
    return {cls: turn for turn, cls in enumerate(nx.lexicographical_topological_sort(needs, key=_by_kind))}


def _by_kind(cls: type[Component]) -> str:
    return cls.kind_name()


def _block(cls: type[Component], elements: list[Element], turn: int | None) -> Block:
    ordered = tuple(sorted(elements, key=lambda element: element.name))
    components = tuple(element.spec for element in ordered if isinstance(element.spec, Component))
    uniform = frozenset(name for name in parameter_names(cls) if _is_uniform(ordered, components, name))
    return Block(KindShape(cls, uniform, turn), ordered, components)


def _is_uniform(elements: Iterable[Element], components: Iterable[Component], parameter: str) -> bool:
    if any(element.population is not None and parameter in element.population.vary for element in elements):
        return False
    values = (getattr(component, parameter) for component in components)
    return len({(float(value), value.parameter) for value in values}) == 1


def place(blocks: Iterable[Block], header: dict[str, int], layout: Layout) -> None:
    """Give every state, input port and output of every element its position."""
    for block in blocks:
        cls, name, count = block.shape.cls, block.shape.name, block.count
        header[f"{name}.count"] = count
        header[f"{name}.states"] = layout.state_count
        header[f"{name}.inputs"] = layout.input_count
        header[f"{name}.outputs"] = layout.signal_count
        _place(block, cls.states, layout.state_count, layout.states, layout.state_blocks)
        _place(block, cls.inputs, layout.input_count, layout.inputs, layout.input_blocks)
        _place(block, cls.outputs, layout.signal_count, layout.signals, layout.signal_blocks)
        layout.state_count += count * len(cls.states)
        layout.signal_count += count * len(cls.outputs)
        layout.input_count += count * len(cls.inputs)
    header["states"] = layout.state_count
    header["inputs"] = layout.input_count


def _place(
    block: Block, named: tuple[State | Port, ...], first: int, single: dict[str, int], many: dict[str, range]
) -> None:
    for element, start in zip(block.elements, block.starts, strict=False):
        for k, one in enumerate(named):
            position = first + k * block.count + start
            if element.population is None:
                single[f"{element.name}.{one.name}"] = position
            else:
                many[f"{element.name}.{one.name}"] = range(position, position + element.size)


def parameters(blocks: Iterable[Block], buffer: Buffer, layout: Layout) -> None:
    """Write the parameters of all equations: one number where all instances share it, else one for each."""
    for block in blocks:
        for name in parameter_names(block.shape.cls):
            shared = name in block.shape.uniform
            values = block.values(name)
            start = buffer.add(f"{block.shape.name}.{name}", values[:1] if shared else values)
            for element, component, at in zip(block.elements, block.components, block.starts, strict=False):
                if element.population is None or name not in element.population.vary:
                    places = start if shared else range(start + at, start + at + element.size)
                    follow(layout, getattr(component, name), places, f"{element.spec_path}.{name}")


def follow(layout: Layout, value: float, positions: int | range, path: str) -> None:
    """Note that the numbers at one or several positions of p follow a parameter of the document, if they do."""
    parameter = getattr(value, "parameter", None)
    if parameter is None:
        return
    layout.followed.add(path)
    places = range(positions, positions + 1) if isinstance(positions, int) else positions
    layout.bound.setdefault(parameter, []).append(places)
