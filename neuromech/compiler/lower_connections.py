"""Synapses and wires → weighted rows over signals, delay lines, and the order of what passes inputs straight on."""

import math
from collections import defaultdict
from collections.abc import Iterable
from dataclasses import dataclass

import networkx as nx

from neuromech.compiler.buffers import Buffer, Reserve
from neuromech.compiler.layout import Layout
from neuromech.compiler.lower_components import Block, follow
from neuromech.compiler.shape import argument_names, evaluated_with_body, is_scheduled
from neuromech.components.base import Component
from neuromech.graph.model import Connection, ModelGraph
from neuromech.units import Quantity

_ONE = Quantity(1.0)


@dataclass(frozen=True)
class _Input:
    row: int
    sender: str
    signal: str
    weight: Quantity
    delay: float
    path: str


def connections(
    graph: ModelGraph, layout: Layout, step: float, integers: Buffer, floats: Buffer, work: Reserve
) -> bool:
    """Write all rows, weights and delay lines; return whether anything is delayed."""
    found = sorted(_inputs(graph, layout), key=lambda one: (one.row, one.sender, one.signal, one.path))
    prompt = [one for one in found if one.delay == 0.0]
    delayed = [one for one in found if one.delay > 0.0]
    weights = floats.add("weights", [one.weight for one in (*prompt, *delayed)])
    for k, one in enumerate((*prompt, *delayed)):
        follow(layout, one.weight, weights + k, one.path)
    _rows(prompt, layout, integers)
    _delay_lines(delayed, len(prompt), layout, step, integers, floats, work)
    return bool(delayed)


def _inputs(graph: ModelGraph, layout: Layout) -> Iterable[_Input]:
    for sender, receiver, connection in graph.connections("synapse", "wire"):
        weight = getattr(connection.spec, "weight", _ONE)
        delay = float(getattr(connection.spec, "delay", 0.0))
        path = f"{connection.path}.weight" if connection.kind == "synapse" else connection.path
        row = layout.inputs[f"{receiver}.{connection.port}"]
        yield _Input(row, sender, f"{sender}.{connection.output}", weight, delay, path)
    for element in graph.elements("muscle"):
        for port in ("length", "velocity"):
            if f"{element.name}.{port}" in layout.inputs:
                row = layout.inputs[f"{element.name}.{port}"]
                yield _Input(row, element.name, f"{element.name}.{port}", _ONE, 0.0, element.path)


def _rows(prompt: list[_Input], layout: Layout, integers: Buffer) -> None:
    counts = [0] * (len(layout.inputs) + 1)
    for one in prompt:
        counts[one.row + 1] += 1
    for row in range(len(layout.inputs)):
        counts[row + 1] += counts[row]
    integers.add("row_start", counts)
    integers.add("row_source", [layout.signals[one.signal] for one in prompt])


def _delay_lines(
    delayed: list[_Input], first: int, layout: Layout, step: float, integers: Buffer, floats: Buffer, work: Reserve
) -> None:
    sources = sorted({layout.signals[one.signal] for one in delayed})
    longest = max((one.delay / step for one in delayed), default=0.0)
    length = math.ceil(longest) + 2 if delayed else 0
    integers.header["delayed"] = len(delayed)
    integers.header["history_length"] = length
    integers.header["history_width"] = len(sources)
    integers.add("delayed_row", [one.row for one in delayed])
    integers.add("delayed_source", [sources.index(layout.signals[one.signal]) for one in delayed])
    integers.add("delayed_weight", [first + k for k in range(len(delayed))])
    integers.add("history_slot", sources)
    floats.add("delay_steps", [one.delay / step for one in delayed])
    work.add("history", length * len(sources))


def evaluation_order(graph: ModelGraph, blocks: tuple[Block, ...], integers: Buffer) -> None:
    """Write (kind, instance) pairs of what is evaluated one by one, senders before receivers.

    Neurons come in one order, evaluated with the network; muscles and sensors in another, evaluated with the body.
    """
    place = {element.name: (k, i) for k, block in enumerate(blocks) for i, element in enumerate(block.elements)}
    passing: dict[bool, set[str]] = defaultdict(set)
    for block in blocks:
        if is_scheduled(block.shape):
            passing[evaluated_with_body(block.shape.cls)].update(element.name for element in block.elements)
    for with_body, name in ((False, "network"), (True, "mechanics")):
        order = _sorted(graph, passing[with_body])
        integers.add(f"{name}_order", [number for element in order for number in place[element]])
        integers.header[f"{name}_ordered"] = len(order)


def _sorted(graph: ModelGraph, names: set[str]) -> list[str]:
    inner = nx.DiGraph()
    inner.add_nodes_from(sorted(names))
    for sender, receiver, connection in graph.connections("synapse", "wire"):
        if sender in names and receiver in names and _passes_at_once(graph, receiver, connection):
            inner.add_edge(sender, receiver)
    return list(nx.lexicographical_topological_sort(inner))


def _passes_at_once(graph: ModelGraph, receiver: str, connection: Connection) -> bool:
    spec = graph.element(receiver).spec
    if not isinstance(spec, Component) or spec.output is None or getattr(connection.spec, "delay", 0.0) > 0.0:
        return False
    return connection.port in argument_names(spec.output)
