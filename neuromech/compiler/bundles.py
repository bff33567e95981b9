"""Connections of the graph as bundles of synapses: arrays of signals that reach rows of input ports."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from neuromech.compiler.layout import Layout
from neuromech.compiler.numerics import Floats, Integers
from neuromech.compiler.wiring import Sources, varied, wire
from neuromech.graph.model import Connection, ModelGraph
from neuromech.units import Quantity

_ONE = Quantity(1.0)
_Number = TypeVar("_Number", bound=np.generic)


@dataclass(frozen=True)
class Bundle:
    """The synapses of one connection, receiver after receiver, or the one of a wire.

    Args:
        row: input port of the first receiver.
        counts: synapses of each receiver; (receivers,).
        sources: the signals that they read; (synapses,).
        weight: of all of them.
        weights: of each of them, where they vary; then `weight` means nothing.
        delays: of each of them (s), None without delays.
        path: of the weight in the document.
        key: gives the order of bundles, whatever that of the document.
        alone: whether sender and receiver are single elements.
    """

    row: int
    counts: Integers
    sources: Sources
    weight: Quantity
    weights: Floats | None
    delays: Floats | None
    path: str
    key: tuple[str, ...]
    alone: bool

    @cached_property
    def rows(self) -> Integers:
        """Input port of each synapse."""
        return np.repeat(np.arange(self.row, self.row + len(self.counts)), self.counts)

    @property
    def is_weighted_apart(self) -> bool:
        """Whether each synapse has a weight of its own in the compiled step."""
        return self.delays is None and (self.alone or self.weights is not None)

    @property
    def is_weighted_together(self) -> bool:
        """Whether all synapses share one weight in the compiled step."""
        return self.delays is None and not self.is_weighted_apart


def bundles(graph: ModelGraph, layout: Layout) -> list[Bundle]:
    """Return all synapses, projections, wires, and the paths that muscles read, in an order by names."""
    found = [_of_connection(graph, layout, *edge) for edge in graph.connections("synapse", "projection", "wire")]
    return sorted([*found, *_of_paths(graph, layout)], key=lambda bundle: bundle.key)


def joined(arrays: Sequence[NDArray[Any]], dtype: type[_Number]) -> NDArray[_Number]:
    """Return arrays one behind the other, also where there are none."""
    return np.concatenate([np.zeros(0, dtype=dtype), *arrays]).astype(dtype, copy=False)


def _of_paths(graph: ModelGraph, layout: Layout) -> Iterator[Bundle]:
    for element in graph.elements("muscle"):
        for port in ("length", "velocity"):
            name = f"{element.name}.{port}"
            if name in layout.inputs:
                key = (element.name, name, element.path)
                yield _single(layout.inputs[name], layout.signals[name], _ONE, 0.0, element.path, key)


def _single(row: int, source: int, weight: Quantity, delay: float, path: str, key: tuple[str, ...]) -> Bundle:
    delays = np.array([delay]) if delay > 0.0 else None
    one = np.array([1])
    return Bundle(row, one, np.array([source], dtype=np.int32), weight, None, delays, path, key, alone=True)


def _of_connection(graph: ModelGraph, layout: Layout, sender: str, receiver: str, connection: Connection) -> Bundle:
    weight = getattr(connection.spec, "weight", _ONE)
    delay = float(getattr(connection.spec, "delay", 0.0))
    path = connection.path if connection.kind == "wire" else f"{connection.spec_path}.weight"
    signal, port = f"{sender}.{connection.output}", f"{receiver}.{connection.port}"
    key = (sender, signal, connection.name or path)
    if signal in layout.signals and port in layout.inputs and connection.projection is None:
        return _single(layout.inputs[port], layout.signals[signal], weight, delay, path, key)
    rows = _places(port, layout.inputs, layout.input_blocks)
    signals = _places(signal, layout.signals, layout.signal_blocks)
    wiring = wire(connection.projection, len(signals), len(rows), connection.name)
    count = len(wiring.senders)
    weights, delays = _varied(connection, "weight", count), _varied(connection, "delay", count)
    if delays is None and delay > 0.0:
        delays = np.full(count, delay)
    sources = wiring.senders + np.int32(signals.start)
    return Bundle(rows.start, wiring.counts, sources, weight, weights, delays, path, key, alone=False)


def _places(name: str, single: dict[str, int], many: dict[str, range]) -> range:
    return many[name] if name in many else range(single[name], single[name] + 1)


def _varied(connection: Connection, parameter: str, count: int) -> Floats | None:
    projection = connection.projection
    if projection is None or parameter not in projection.vary:
        return None
    return varied(projection.vary[parameter], count, projection.seed, f"{connection.name}.{parameter}")
