"""Neurons, drives, sensors and muscles → blocks of states, inputs, signals and parameters."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from neuromech.compiler.buffers import Buffer
from neuromech.compiler.layout import Layout
from neuromech.compiler.shape import KindShape, parameter_names
from neuromech.components.base import Component
from neuromech.graph.model import Element, ModelGraph
from neuromech.units import Quantity


@dataclass(frozen=True)
class Block:
    """All elements of one component class, sorted by name so that authored order changes nothing."""

    shape: KindShape
    elements: tuple[Element, ...]
    components: tuple[Component, ...]


def blocks(graph: ModelGraph) -> tuple[Block, ...]:
    """Return the elements with equations, grouped by class, classes sorted by kind."""
    grouped: dict[type[Component], list[Element]] = {}
    for element in graph.elements("neuron", "drive", "sensor", "muscle"):
        if isinstance(element.spec, Component):
            grouped.setdefault(type(element.spec), []).append(element)
    waiting = set(_waiting(graph))
    kinds = sorted(grouped, key=lambda cls: cls.kind_name())
    return tuple(_block(cls, grouped[cls], waiting.isdisjoint(e.name for e in grouped[cls])) for cls in kinds)


def _waiting(graph: ModelGraph) -> Iterable[str]:
    """Yield what needs an output of a muscle or a sensor."""
    late = {element.name for element in graph.elements("muscle", "sensor")}
    return (receiver for sender, receiver, _ in graph.connections("wire", "synapse") if sender in late)


def _block(cls: type[Component], elements: list[Element], early: bool) -> Block:
    ordered = tuple(sorted(elements, key=lambda element: element.name))
    components = tuple(element.spec for element in ordered if isinstance(element.spec, Component))
    uniform = frozenset(name for name in parameter_names(cls) if _is_uniform([getattr(c, name) for c in components]))
    return Block(KindShape(cls, uniform, early), ordered, components)


def _is_uniform(values: Sequence[Quantity]) -> bool:
    return len({(float(value), value.parameter) for value in values}) == 1


def place(blocks: Iterable[Block], header: dict[str, int], layout: Layout) -> None:
    """Give every state, input port and output of every element its position."""
    inputs = 0
    for block in blocks:
        cls, name, count = block.shape.cls, block.shape.name, len(block.elements)
        header[f"{name}.count"] = count
        header[f"{name}.states"] = layout.state_count
        header[f"{name}.inputs"] = inputs
        header[f"{name}.outputs"] = layout.signal_count
        for i, element in enumerate(block.elements):
            for k, state in enumerate(cls.states):
                layout.states[f"{element.name}.{state.name}"] = layout.state_count + k * count + i
            for k, port in enumerate(cls.inputs):
                layout.inputs[f"{element.name}.{port.name}"] = inputs + k * count + i
            for k, port in enumerate(cls.outputs):
                layout.signals[f"{element.name}.{port.name}"] = layout.signal_count + k * count + i
        layout.state_count += count * len(cls.states)
        layout.signal_count += count * len(cls.outputs)
        inputs += count * len(cls.inputs)
    header["states"] = layout.state_count
    header["inputs"] = inputs


def parameters(blocks: Iterable[Block], buffer: Buffer, layout: Layout) -> None:
    """Write the parameters of all equations: one number where all instances share it, else one for each."""
    for block in blocks:
        for name in parameter_names(block.shape.cls):
            values = [getattr(component, name) for component in block.components]
            shared = name in block.shape.uniform
            start = buffer.add(f"{block.shape.name}.{name}", values[:1] if shared else values)
            for i, (element, value) in enumerate(zip(block.elements, values, strict=True)):
                follow(layout, value, start if shared else start + i, f"{element.path}.{name}")


def follow(layout: Layout, value: float, position: int, path: str) -> None:
    """Note that the number at a position of p follows a parameter of the document, if it does."""
    parameter = getattr(value, "parameter", None)
    if parameter is None:
        return
    layout.followed.add(path)
    positions = layout.bound.setdefault(parameter, [])
    if position not in positions:
        positions.append(position)
