"""What differs between two models: elements, synapses and projections, their values, and settings of the document."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Self

from neuromech.components.base import Component
from neuromech.graph.model import Connection, Element, ModelGraph
from neuromech.graph.values import values

ABSENT = "–"
_PARTS_OF_BODY = frozenset({"segments", "joints", "contacts"})
_ELEMENTS = frozenset({"pushes", "push_series", "pendulums"})
_SECTIONS = ("protocol", "solver", "world")


@dataclass(frozen=True, slots=True)
class Item:
    """An element, a synapse or a projection that only one of two models has."""

    what: str
    name: str
    kind: str

    def __str__(self) -> str:
        return f"{self.what} {self.name}" + (f" ({self.kind})" if self.kind else "")


@dataclass(frozen=True, slots=True)
class Change:
    """A value that differs; an absent one is shown as a dash. Quantities are in the unit of their field."""

    path: str
    old: str
    new: str

    def __str__(self) -> str:
        return f"{self.path}: {self.old} → {self.new}"


@dataclass(frozen=True, slots=True)
class Difference:
    """What one has to remove, add and change in a first model to get a second one."""

    removed: tuple[Item, ...]
    added: tuple[Item, ...]
    changed: tuple[Change, ...]

    @property
    def is_empty(self) -> bool:
        """Whether the two models are the same."""
        return not (self.removed or self.added or self.changed)

    def mirrored(self) -> Self:
        """Return the difference the other way round."""
        changed = tuple(Change(change.path, change.new, change.old) for change in self.changed)
        return type(self)(self.added, self.removed, changed)

    def __str__(self) -> str:
        signs = (("-", self.removed), ("+", self.added), ("~", self.changed))
        return "\n".join(f"{sign} {one}" for sign, ones in signs for one in ones)


@dataclass(frozen=True, slots=True)
class _Entry:
    """An element, a synapse or a projection on its own: what to call it, where it stands, and its values by field."""

    item: Item
    path: str
    values: Mapping[str, str]


def diff(one: ModelGraph, other: ModelGraph) -> Difference:
    """Return the difference from one model to another. Wires and crossings follow from the fields of elements."""
    first, second = _entries(one), _entries(other)
    removed = [first[name].item for name in first if name not in second]
    added = [second[name].item for name in second if name not in first]
    changed = [change for name in first if name in second for change in _changes(first[name], second[name])]
    changed += _value_changes(_settings(one), _settings(other))
    return Difference(tuple(sorted(removed, key=str)), tuple(sorted(added, key=str)), tuple(sorted(changed, key=_path)))


def _path(change: Change) -> str:
    return change.path


def _entries(graph: ModelGraph) -> dict[tuple[str, ...], _Entry]:
    entries: dict[tuple[str, ...], _Entry] = {
        (element.family, element.name): _element(element) for element in graph.elements()
    }
    synapses = (_synapse(*edge) for edge in graph.connections("synapse"))
    entries |= {("synapse", entry.item.kind, entry.item.name): entry for entry in synapses}
    projections = (_projection(connection) for _, _, connection in graph.connections("projection"))
    return entries | {("projection", entry.item.name): entry for entry in projections}


def _element(element: Element) -> _Entry:
    kind = element.spec.kind_name() if isinstance(element.spec, Component) else ""
    found = values(element.population or element.spec, "")
    return _Entry(Item(element.family, element.name, kind), element.path, found)


def _synapse(sender: str, receiver: str, connection: Connection) -> _Entry:
    assert isinstance(connection.spec, Component)
    item = Item("synapse", f"{sender} → {receiver}", connection.spec.kind_name())
    return _Entry(item, connection.path, values(connection.spec, ""))


def _projection(connection: Connection) -> _Entry:
    assert connection.projection is not None
    item = Item("projection", connection.name, connection.projection.synapse.kind_name())
    return _Entry(item, connection.path, values(connection.projection, ""))


def _changes(one: _Entry, other: _Entry) -> Iterator[Change]:
    """Yield what differs in one thing; of a thing whose kind changed, only that."""
    path = min(one.path, other.path)
    if one.item.kind != other.item.kind:
        yield Change(f"{path}.kind", one.item.kind, other.item.kind)
    else:
        for change in _value_changes(one.values, other.values):
            yield Change(f"{path}{change.path}", change.old, change.new)


def _value_changes(one: Mapping[str, str], other: Mapping[str, str]) -> list[Change]:
    changes = (Change(path, one.get(path, ABSENT), other.get(path, ABSENT)) for path in {**one, **other})
    return [change for change in changes if change.old != change.new]


def _settings(graph: ModelGraph) -> dict[str, str]:
    experiment = graph.document.experiment
    found: dict[str, str] = {}
    for name, parameter in experiment.parameters.items():
        found |= values(parameter, f"parameters.{name}")
    for section in _SECTIONS:
        found |= values(getattr(experiment, section), section, _ELEMENTS)
    if experiment.body is not None:
        found |= values(experiment.body, "body", _PARTS_OF_BODY)
    return found
