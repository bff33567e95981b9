"""What a run records: the signals of each record group in order, their units, and where the step finds them."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from neuromech.compiler.buffers import Buffer
from neuromech.compiler.layout import Layout
from neuromech.graph.model import ModelGraph
from neuromech.graph.signals import matching, signals, sizes, split
from neuromech.units import si_unit

# Number of the array of inputs among those that are recorded from; behind it come the means.
_INPUTS = 2


@dataclass(frozen=True, slots=True)
class RecordGroup:
    """Signals that are sampled together.

    Args:
        name: of the group.
        signals: qualified names in the order of the samples.
        units: of the samples, one for each signal.
        every: ticks from one sample to the next.
    """

    name: str
    signals: tuple[str, ...]
    units: tuple[str, ...]
    every: int


def record_groups(graph: ModelGraph, tick: float) -> tuple[RecordGroup, ...]:
    """Return the record groups of a model whose ticks take `tick` seconds."""
    units = signals(graph)
    groups = list[RecordGroup]()
    for name, group in graph.document.experiment.record.items():
        names = recorded(group.signals, graph)
        shown = tuple(si_unit(units[_listed(signal)]) for signal in names)
        groups.append(RecordGroup(name, tuple(names), shown, round(float(group.every) / tick)))
    return tuple(groups)


def record_sections(groups: Sequence[RecordGroup], layout: Layout, integers: Buffer) -> None:
    """Write where the samples of record groups come from and how often they are taken."""
    integers.header["groups"] = len(groups)
    integers.add("group_every", [group.every for group in groups])
    starts = [0, *np.cumsum([len(group.signals) for group in groups], dtype=int).tolist()]
    integers.add("group_start", starts)
    integers.add("group_row", [0] * len(groups))
    _stretches(layout, [layout.slot(name) for group in groups for name in group.signals], starts, integers)
    integers.add("mean_first", [some.start for some in layout.means()])
    integers.add("mean_count", [len(some) for some in layout.means()])


def recorded(patterns: Iterable[str], graph: ModelGraph) -> list[str]:
    """Return the names that a record group asks for, each once, quantity by quantity.

    Within a quantity they stand in authored order, then neurons of populations: a quantity's samples are one block.
    """
    every, populations = list(signals(graph)), sizes(graph)
    wanted = dict.fromkeys(name for pattern in patterns for name in matching(pattern, every, populations))
    listed = [name for name in every if name in wanted]
    names = [*listed, *(name for name in wanted if split(name)[1] is not None)]
    quantities = {quantity: k for k, quantity in enumerate(dict.fromkeys(name.rpartition(".")[2] for name in names))}
    return sorted(names, key=lambda name: quantities[name.rpartition(".")[2]])


def recorded_names(graph: ModelGraph) -> Iterable[str]:
    """Yield the names of all signals that any record group asks for."""
    every = list(signals(graph))
    for group in graph.document.experiment.record.values():
        for pattern in group.signals:
            yield from matching(pattern, every)


def _stretches(layout: Layout, slots: list[int], starts: list[int], integers: Buffer) -> None:
    """Write the places of recorded signals, and where stretches begin that stand in one array: x, s, u or the means."""
    ends = np.cumsum([layout.state_count, layout.signal_count, layout.input_count])
    arrays = np.searchsorted(ends, slots, side="right")
    integers.add("place", np.asarray(slots, dtype=np.int64) - np.array([0, *ends])[arrays])
    changes = np.flatnonzero(np.diff(arrays)) + 1
    stretches = np.unique([*starts, *changes])
    integers.add("stretch_start", stretches)
    integers.add("stretch_array", arrays[stretches[:-1]])
    integers.add("group_stretch", np.searchsorted(stretches, starts))
    integers.header["inputs_recorded"] = int((arrays >= _INPUTS).any())


def _listed(name: str) -> str:
    """Return the name that a signal has in the list of all, which has populations as wholes."""
    element, _, quantity = split(name)
    return f"{element}.{quantity}"
