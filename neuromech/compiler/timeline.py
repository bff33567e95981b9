"""Protocol → breakpoints of every parameter that moves during a run."""

from collections.abc import Iterable, Iterator, Mapping, Sized
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from neuromech.compiler.buffers import Buffer
from neuromech.compiler.layout import Layout
from neuromech.errors import DocumentError, Problem
from neuromech.spec.document import Document
from neuromech.spec.follow import followers
from neuromech.spec.model import Protocol
from neuromech.units import quantity


@dataclass(frozen=True)
class _Change:
    start: float
    end: float
    to: float
    path: str


def timeline(document: Document, layout: Layout, integers: Buffer, floats: Buffer) -> None:
    """Write breakpoints of all driven parameters, and the places that follow them.

    Raises:
        DocumentError: two changes of one parameter overlap, or a driven parameter sets something that cannot change
            during a run, such as a length of the body.
    """
    experiment = document.experiment
    driven = _changes(experiment.protocol)
    problems = [*_overlaps(document, driven), *_immovable(document, driven, layout)]
    if problems:
        raise DocumentError(problems)
    names = sorted(driven)
    points = [_breakpoints(quantity(str(experiment.parameters[name].value)), driven[name]) for name in names]
    bound = [layout.bound_to(name) for name in names]
    integers.header["driven"] = len(names)
    integers.add("driven_start", _starts(points))
    floats.add("breakpoint_time", [time for some in points for time, _ in some])
    floats.add("breakpoint_value", [value for some in points for _, value in some])
    integers.add("bound_start", _starts(bound))
    integers.add("bound_slot", np.concatenate([np.zeros(0, dtype=np.int64), *bound]))


def course(protocol: Protocol, values: Mapping[str, str | int | float]) -> dict[str, list[tuple[float, float]]]:
    """Return {parameter that moves during a run: its breakpoints}, each a time (s) and a value in SI units.

    Args:
        protocol: of the document.
        values: value of each parameter at the start, as written.
    """
    return {name: _breakpoints(quantity(str(values[name])), changes) for name, changes in _changes(protocol).items()}


def _changes(protocol: Protocol) -> dict[str, list[_Change]]:
    found: dict[str, list[_Change]] = {}
    for name, ramp in protocol.ramps.items():
        change = _Change(ramp.start, ramp.end, quantity(str(ramp.to)), f"protocol.ramps.{name}")
        found.setdefault(ramp.parameter, []).append(change)
    for name, event in protocol.events.items():
        for parameter, value in event.set.items():
            change = _Change(event.at, event.at, quantity(str(value)), f"protocol.events.{name}.set.{parameter}")
            found.setdefault(parameter, []).append(change)
    return {name: sorted(changes, key=lambda change: (change.start, change.end)) for name, changes in found.items()}


def _breakpoints(initial: float, changes: Iterable[_Change]) -> list[tuple[float, float]]:
    points = [(0.0, initial)]
    for change in changes:
        points += [(change.start, points[-1][1]), (change.end, change.to)]
    return points


def _overlaps(document: Document, driven: dict[str, list[_Change]]) -> Iterator[Problem]:
    for name, changes in driven.items():
        for earlier, later in pairwise(changes):
            if later.start < earlier.end or later.end == earlier.start:
                message = f"changes parameter '{name}' while {earlier.path} still does, until {earlier.end:g} s"
                yield document.problem("overlapping-changes", later.path, message, f"a start at {later.start:g} s")


def _immovable(document: Document, driven: dict[str, list[_Change]], layout: Layout) -> Iterator[Problem]:
    for use in followers(document.experiment):
        name = use.parameter
        if name in driven and use.path not in layout.followed:
            message = f"parameter '{name}' cannot change during a run, because it sets {use.path}"
            yield document.problem(
                "immovable-parameter", driven[name][0].path, message, None, "give it one value for the whole run"
            )


def _starts(lists: Iterable[Sized]) -> list[int]:
    starts = [0]
    for some in lists:
        starts.append(starts[-1] + len(some))
    return starts
