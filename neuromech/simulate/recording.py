"""What a run leaves behind: its outcome, its provenance, and the recorded signals with dimensions and units."""

import json
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from neuromech.errors import RecordingError, did_you_mean
from neuromech.graph.signals import matching
from neuromech.simulate.anatomy import NO_BODY, Anatomy
from neuromech.units import unit_factor

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]
OutcomeKind = Literal["finished", "fell", "diverged", "stopped"]
ParameterValue = str | int | float


@dataclass(frozen=True, slots=True)
class Outcome:
    """How a run ended.

    Args:
        kind: `finished` when the protocol came to its end, else what ended it.
        time: simulated time of the end (s).
        message: what happened, naming for example the state that diverged; empty for a finished run.
    """

    kind: OutcomeKind
    time: float
    message: str = ""


@dataclass(frozen=True, slots=True)
class Provenance:
    """Where a recording comes from.

    Args:
        name: name of the document.
        specification: the resolved document as YAML.
        version: version of neuromech.
        versions: versions of the packages that did the numbers, by name.
        engine: engine of the body, `none` for a network alone.
        platform: operating system, machine and Python.
        seed: seed of the run.
        parameters: values of the named parameters, as written in the resolved document.
        outcome: how the run ended.
        simulated_seconds: simulated time (s).
        wall_seconds: time that the run took on the clock (s).
        anatomy: what measures must know about the body.
    """

    name: str
    specification: str = field(repr=False)
    version: str
    versions: Mapping[str, str]
    engine: str
    platform: str
    seed: int
    parameters: Mapping[str, ParameterValue]
    outcome: Outcome
    simulated_seconds: float
    wall_seconds: float
    anatomy: Anatomy = NO_BODY

    def to_attributes(self) -> dict[str, Any]:
        """Return flat attributes of a results file; maps become JSON text."""
        attributes = asdict(self)
        for key in ("versions", "parameters", "outcome", "anatomy"):
            attributes[key] = json.dumps(attributes[key], ensure_ascii=False)
        return attributes

    @classmethod
    def from_attributes(cls, attributes: Mapping[Any, Any]) -> "Provenance":
        """Read back what `to_attributes` wrote.

        Raises:
            KeyError: an attribute is missing.
            ValueError: an attribute is malformed.
        """
        return cls(
            name=str(attributes["name"]),
            specification=str(attributes["specification"]),
            version=str(attributes["version"]),
            versions=json.loads(attributes["versions"]),
            engine=str(attributes["engine"]),
            platform=str(attributes["platform"]),
            seed=int(attributes["seed"]),
            parameters=json.loads(attributes["parameters"]),
            outcome=Outcome(**json.loads(attributes["outcome"])),
            simulated_seconds=float(attributes["simulated_seconds"]),
            wall_seconds=float(attributes["wall_seconds"]),
            anatomy=Anatomy(**json.loads(attributes["anatomy"])),
        )


@dataclass(frozen=True, slots=True)
class GroupData:
    """Signals sampled together.

    Args:
        time: sample times, shape (n,) (s), strictly increasing.
        names: qualified signal names (`LF.RG-F.activity`), k of them, in authored order.
        values: shape (n, k), column order as `names`, each in its unit.
        units: unit of each column as text of `units.txt`, empty for a number.
    """

    time: Array
    names: tuple[str, ...]
    values: Array
    units: tuple[str, ...]

    def __post_init__(self) -> None:
        """Refuse shapes that do not belong together.

        Raises:
            ValueError: shapes differ, time does not increase, a name repeats or has no dot, or a unit is unknown.
        """
        expected = (len(self.time), len(self.names))
        if self.values.shape != expected or len(self.units) != len(self.names):
            raise ValueError(f"values must be {expected} with {len(self.names)} units (got {self.values.shape})")
        if np.any(np.diff(self.time) <= 0.0):
            raise ValueError("time must increase strictly")
        if len(set(self.names)) < len(self.names) or not all("." in name for name in self.names):
            raise ValueError("signal names must differ and have the form element.quantity")
        for unit in set(self.units):
            unit_factor(unit)


@dataclass(frozen=True, slots=True)
class _Block:
    """Signals side by side: times (n,), values (n, k), k units, and the time from sample to sample (s)."""

    time: Array
    values: Array
    units: Sequence[str]

    @property
    def step(self) -> float:
        return float((self.time[-1] - self.time[0]) / (len(self.time) - 1)) if len(self.time) > 1 else np.inf


_Places = dict[str, tuple[_Block, int]]


class Recording:
    """Recorded signals and their provenance.

    A search looks at a few signals of thousands of recordings, so that labels are put on when somebody asks for them,
    and xarray is imported then.
    """

    def __init__(self, provenance: Provenance, places: _Places, tree: "Callable[[], xr.DataTree]") -> None:
        """Take what `from_groups` and `from_tree` found; `tree` is called at most once."""
        self.provenance = provenance
        self._places = places
        self._labelled = tree

    @classmethod
    def from_groups(cls, groups: Mapping[str, GroupData], provenance: Provenance) -> "Recording":
        """Build a recording from arrays, one entry per record group."""
        return cls(provenance, _places_in_groups(groups.values()), lambda: _tree(groups, provenance))

    @classmethod
    def from_tree(cls, tree: "xr.DataTree") -> "Recording":
        """Wrap a tree that was read from a results file.

        Raises:
            KeyError: the tree has no provenance of ours.
            ValueError: its provenance is malformed.
        """
        return cls(Provenance.from_attributes(tree.attrs), _places_in_tree(tree), lambda: tree)

    @cached_property
    def tree(self) -> "xr.DataTree":
        """All of it as an xarray tree with one node per record group.

        A node has a coordinate `time` (s) and one variable per quantity with the dimensions (time, element):
        `activity` has the coordinate `activity_element` that holds the qualified names of its elements.
        """
        return self._labelled()

    @property
    def outcome(self) -> Outcome:
        """How the run ended."""
        return self.provenance.outcome

    @property
    def names(self) -> list[str]:
        """Qualified names of all signals, in recorded order."""
        return list(self._places)

    def match(self, *patterns: str) -> list[str]:
        """Return the signals that match any of the patterns (`*`, `?`, `pool[0:10]`), in recorded order."""
        found = {name for pattern in patterns for name in matching(pattern, self._places)}
        return [name for name in self._places if name in found]

    def signal(self, name: str) -> tuple[Array, Array]:
        """Return the times (s), shape (n,), and values, shape (n,), of a signal.

        Of a signal recorded in several groups, the samples of the finest rate are returned.

        Raises:
            RecordingError: the signal was not recorded.
        """
        block, column = self._place(name)
        return block.time, np.ascontiguousarray(block.values[:, column])

    def unit(self, name: str) -> str:
        """Return the unit of a signal, empty for a number.

        Raises:
            RecordingError: the signal was not recorded.
        """
        block, column = self._place(name)
        return block.units[column]

    def _place(self, name: str) -> tuple[_Block, int]:
        if name not in self._places:
            raise RecordingError(f"signal '{name}' was not recorded. Hint: {did_you_mean(name, self._places)}")
        return self._places[name]


def _tree(groups: Mapping[str, GroupData], provenance: Provenance) -> "xr.DataTree":
    import xarray as xr

    nodes = {f"/{name}": _dataset(data) for name, data in groups.items()}
    return xr.DataTree.from_dict({"/": xr.Dataset(attrs=provenance.to_attributes()), **nodes})


def _dataset(data: GroupData) -> "xr.Dataset":
    import xarray as xr

    variables: dict[str, xr.Variable] = {}
    coordinates: dict[str, xr.Variable] = {"time": xr.Variable("time", data.time, {"units": "s"})}
    for (quantity, unit, variable), columns in _variables(data).items():
        dimension = f"{variable}_element"
        elements = np.array([data.names[column].rpartition(".")[0] for column in columns], dtype=np.str_)
        coordinates[dimension] = xr.Variable(dimension, elements)
        attributes = {"units": unit, "quantity": quantity}
        variables[variable] = xr.Variable(("time", dimension), data.values[:, _slice(columns)], attributes)
    return xr.Dataset(variables, coordinates, {"signals": json.dumps(data.names)})


def _slice(columns: list[int]) -> slice | list[int]:
    """Return neighbouring columns as a slice, which copies nothing."""
    neighbours = columns == list(range(columns[0], columns[0] + len(columns)))
    return slice(columns[0], columns[-1] + 1) if neighbours else columns


def _variables(data: GroupData) -> dict[tuple[str, str, str], list[int]]:
    """Return {(quantity, unit, variable name): columns}; the unit joins the name where one quantity has several."""
    quantities = [name.rpartition(".")[2] for name in data.names]
    units_of: dict[str, set[str]] = {}
    for quantity, unit in zip(quantities, data.units, strict=True):
        units_of.setdefault(quantity, set()).add(unit)
    found: dict[tuple[str, str, str], list[int]] = {}
    for column, (quantity, unit) in enumerate(zip(quantities, data.units, strict=True)):
        suffix = "_" + _word(unit) if len(units_of[quantity]) > 1 else ""
        found.setdefault((quantity, unit, quantity + suffix), []).append(column)
    return found


def _word(unit: str) -> str:
    return unit.replace("/", " per ").replace("^", "").replace("  ", " ").strip().replace(" ", "_") or "number"


def _places_in_groups(groups: Iterable[GroupData]) -> _Places:
    """Return where each signal is, of several places the one with the finest steps."""
    found: _Places = {}
    for group in groups:
        block = _Block(group.time, group.values, group.units)
        _add_finer(found, {name: (block, column) for column, name in enumerate(group.names)})
    return found


def _places_in_tree(tree: "xr.DataTree") -> _Places:
    """Return the same for a tree; the recorded order of a group is in its attribute `signals`."""
    found: _Places = {}
    for node in tree.children.values():
        data = node.to_dataset()
        time, places = np.asarray(data["time"].values), _Places()
        for name in data.data_vars:
            variable = data.variables[name]
            elements, quantity = data.variables[f"{name}_element"].values.tolist(), variable.attrs["quantity"]
            block = _Block(time, variable.values, [str(variable.attrs["units"])] * len(elements))
            places |= {f"{element}.{quantity}": (block, column) for column, element in enumerate(elements)}
        ordered = {signal: places[signal] for signal in json.loads(node.attrs["signals"])}
        _add_finer(found, ordered)
    return found


def _add_finer(found: _Places, places: _Places) -> None:
    for name, (block, column) in places.items():
        if name not in found or block.step < found[name][0].step:
            found[name] = (block, column)
