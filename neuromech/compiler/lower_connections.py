"""Synapses and wires → weighted rows over signals, delay lines, and the order of what passes inputs straight on."""

import math
from collections import defaultdict
from dataclasses import dataclass

import networkx as nx
import numpy as np

from neuromech.compiler.buffers import Buffer, Reserve, halves
from neuromech.compiler.bundles import Bundle, bundles, joined
from neuromech.compiler.layout import Layout
from neuromech.compiler.lower_components import Block, follow
from neuromech.compiler.numerics import Floats, Integers
from neuromech.compiler.shape import argument_names, evaluated_with_body, is_scheduled
from neuromech.compiler.slots import MOST_ENTRIES, slotted
from neuromech.components.base import Component
from neuromech.graph.model import Connection, ModelGraph


@dataclass(frozen=True)
class Connected:
    """What the code of a step must know about the connections, and how many synapses and wires there are."""

    has_delays: bool
    has_shared_weights: bool
    has_short_rows: bool
    synapses: int


def connections(
    graph: ModelGraph,
    blocks: tuple[Block, ...],
    layout: Layout,
    step: float,
    integers: Buffer,
    floats: Buffer,
    work: Reserve,
) -> Connected:
    """Write all rows, weights and delay lines.

    Weights stand in three parts: those of single synapses and of what varies, sorted by row; one for each bundle that
    shares it; those of what is delayed.
    """
    found = bundles(graph, layout)
    apart = [one for one in found if one.is_weighted_apart]
    together = [one for one in found if one.is_weighted_together]
    delayed = [one for one in found if one.delays is not None]
    first_shared = _rows(apart, layout, integers, floats)
    first_delayed = _segments(together, first_shared, layout, integers, floats)
    _delay_lines(delayed, first_delayed, layout, step, integers, floats, work)
    short = not together and _are_short(apart)
    _short_rows(apart if short else [], blocks, layout, integers, floats, work)
    return Connected(bool(delayed), bool(together), short, sum(len(one.sources) for one in found))


def _are_short(apart: list[Bundle]) -> bool:
    rows = joined([one.rows for one in apart], np.int64)
    return len(rows) <= MOST_ENTRIES * len(np.unique(rows))


def _short_rows(
    apart: list[Bundle],
    blocks: tuple[Block, ...],
    layout: Layout,
    integers: Buffer,
    floats: Buffer,
    work: Reserve,
) -> None:
    """Write rows slot by slot, weights of their own included."""
    header = integers.header
    first = [header[f"{block.shape.name}.inputs"] for block in blocks]
    counts = [block.count * len(block.shape.cls.inputs) for block in blocks]
    ranges = [range(start, start + count) for start, count in zip(first, counts, strict=True)]
    found = slotted(joined([one.rows for one in apart], np.int64), ranges)
    tables = integers.add("slot_tables", found.tables)
    for block, start in zip(blocks, found.starts, strict=True):
        header[f"{block.shape.name}.table"] = tables + start
        integers.sections.add(f"{block.shape.name}.table")
    integers.add("slot_order", found.order)
    back = np.argsort(found.place)
    integers.add("slot_source", joined([one.sources for one in apart], np.int64)[back])
    weights = floats.add("slot_weights", joined([_weights(one) for one in apart], np.float64)[back])
    position = 0
    for one in apart:
        if one.weights is None:
            follow(layout, one.weight, weights + int(found.place[position]), one.path)
        position += len(one.sources)
    work.add("slot_sums", max(counts, default=0))


def _rows(apart: list[Bundle], layout: Layout, integers: Buffer, floats: Buffer) -> int:
    rows = joined([one.rows for one in apart], np.int64)
    order = np.argsort(rows, kind="stable")
    weights = joined([_weights(one) for one in apart], np.float64)[order]
    start = floats.add("weights", weights)
    place = np.empty(len(order), dtype=np.int64)
    place[order] = np.arange(len(order))
    position = 0
    for one in apart:
        if one.weights is None:
            follow(layout, one.weight, start + int(place[position]), one.path)
        position += len(one.sources)
    counts = np.bincount(rows, minlength=layout.input_count)
    integers.add("row_start", np.concatenate([[0], np.cumsum(counts)]))
    integers.add("row_source", halves(joined([one.sources for one in apart], np.int32)[order]))
    return len(weights)


def _weights(one: Bundle) -> Floats:
    return np.full(len(one.sources), float(one.weight)) if one.weights is None else one.weights


def _segments(together: list[Bundle], first: int, layout: Layout, integers: Buffer, floats: Buffer) -> int:
    """Write what shares weights: for each row its segments, for each of these its sources and its weight."""
    start = floats.add("shared_weights", [float(one.weight) for one in together])
    for k, one in enumerate(together):
        follow(layout, one.weight, start + k, one.path)
    rows = joined([np.arange(one.row, one.row + len(one.counts)) for one in together], np.int64)
    counts = joined([one.counts for one in together], np.int64)
    weights = np.repeat(first + np.arange(len(together)), [len(one.counts) for one in together])
    ends = np.cumsum(counts)
    order = np.argsort(rows, kind="stable")
    of_row = np.bincount(rows, minlength=layout.input_count)
    integers.add("segment_start", np.concatenate([[0], np.cumsum(of_row)]))
    integers.add("segment_first", (ends - counts)[order])
    integers.add("segment_last", ends[order])
    integers.add("segment_weight", weights[order])
    integers.add("segment_source", halves(joined([one.sources for one in together], np.int32)))
    return first + len(together)


def _delay_lines(
    delayed: list[Bundle],
    first: int,
    layout: Layout,
    step: float,
    integers: Buffer,
    floats: Buffer,
    work: Reserve,
) -> None:
    signals = joined([one.sources for one in delayed], np.int32)
    delays = joined([one.delays for one in delayed if one.delays is not None], np.float64)
    rows = joined([one.rows for one in delayed], np.int64)
    order = np.argsort(rows, kind="stable")
    sources, slots = np.unique(signals, return_inverse=True)
    length = math.ceil(float(delays.max()) / step) + 2 if len(delays) else 0
    integers.header["delayed"] = len(signals)
    integers.header["history_length"] = length
    integers.header["history_width"] = len(sources)
    integers.add("delayed_row", rows[order])
    integers.add("delayed_source", slots[order])
    integers.add("delayed_weight", _delayed_weights(delayed, first, layout, floats)[order])
    integers.add("history_slot", sources)
    floats.add("delay_steps", (delays / step)[order])
    work.add("history", length * len(sources))


def _delayed_weights(delayed: list[Bundle], first: int, layout: Layout, floats: Buffer) -> Integers:
    """Write the weights of what is delayed, once where they are shared; return which one each synapse has."""
    values = [np.array([float(one.weight)]) if one.weights is None else one.weights for one in delayed]
    start = floats.add("delayed_weights", joined(values, np.float64))
    which, position = [], 0
    for one, some in zip(delayed, values, strict=True):
        if one.weights is None:
            follow(layout, one.weight, start + position, one.path)
        step = 0 if one.weights is None else 1
        which.append(first + position + step * np.arange(len(one.sources)))
        position += len(some)
    return joined(which, np.int64)


def evaluation_order(graph: ModelGraph, blocks: tuple[Block, ...], integers: Buffer) -> None:
    """Write what is evaluated one by one, senders before receivers: groups of one kind that need none of each other.

    Each group is its kind and the first and last of its members; members are places in the block of the kind. Neurons
    come in one order, evaluated with the network; muscles and sensors in another, evaluated with the body.
    """
    places: dict[str, tuple[int, Integers]] = {}
    passing: dict[bool, set[str]] = defaultdict(set)
    for k, block in enumerate(blocks):
        if is_scheduled(block.shape):
            passing[evaluated_with_body(block.shape.cls)].update(element.name for element in block.elements)
            for element, start in zip(block.elements, block.starts, strict=False):
                places[element.name] = k, np.arange(start, start + element.size)
    for with_body, name in ((False, "network"), (True, "mechanics")):
        groups = [
            (kind, joined([places[element][1] for element in group if places[element][0] == kind], np.int64))
            for group in _generations(graph, passing[with_body])
            for kind in sorted({places[element][0] for element in group})
        ]
        ends = np.cumsum([0, *(len(members) for _, members in groups)], dtype=np.int64)
        kinds = np.array([kind for kind, _ in groups], dtype=np.int64)
        integers.add(f"{name}_order", np.column_stack([kinds, ends[:-1], ends[1:]]).ravel())
        integers.add(f"{name}_members", joined([members for _, members in groups], np.int64))
        integers.header[f"{name}_ordered"] = len(groups)


def _generations(graph: ModelGraph, names: set[str]) -> list[list[str]]:
    """Return the names in groups, each of which needs only groups before it."""
    inner = nx.DiGraph()
    inner.add_nodes_from(sorted(names))
    for sender, receiver, connection in graph.connections("synapse", "projection", "wire"):
        if sender in names and receiver in names and _passes_at_once(graph, receiver, connection):
            inner.add_edge(sender, receiver)
    return [sorted(generation) for generation in nx.topological_generations(inner)]


def _passes_at_once(graph: ModelGraph, receiver: str, connection: Connection) -> bool:
    spec = graph.element(receiver).spec
    if not isinstance(spec, Component) or spec.output is None or getattr(connection.spec, "delay", 0.0) > 0.0:
        return False
    return connection.port in argument_names(spec.output)
