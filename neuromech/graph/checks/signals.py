"""Rules about name patterns: what is recorded, judged or set at time zero exists."""

from collections.abc import Iterable, Iterator

from pydantic_core import PydanticCustomError

from neuromech.errors import Problem, did_you_mean
from neuromech.graph.model import ModelGraph
from neuromech.graph.signals import matching, signals, sizes, split, states
from neuromech.graph.start import start_units
from neuromech.spec.measure import Measure
from neuromech.spec.model import Experiment, Uniform
from neuromech.units import Unit


def record_matches_nothing(graph: ModelGraph) -> Iterator[Problem]:
    """Each pattern of a record group matches a signal."""
    every, populations = list(signals(graph)), sizes(graph)
    for name, group in graph.document.experiment.record.items():
        for index, pattern in enumerate(group.signals):
            if not matching(pattern, every, populations):
                path = f"record.{name}.signals.{index}"
                hint = _closest(pattern, every)
                yield graph.document.problem("no-such-signal", path, "matches no signal", f"'{pattern}'", hint)


def measure_of_unrecorded(graph: ModelGraph) -> Iterator[Problem]:
    """What a claim, the objective of a study or a sweep measures is recorded."""
    every, populations = list(signals(graph)), sizes(graph)
    groups = graph.document.experiment.record.values()
    recorded = [name for group in groups for pattern in group.signals for name in matching(pattern, every, populations)]
    for place, measure in _measures(graph.document.experiment):
        for path, pattern in measure.patterns():
            if not matching(pattern, recorded):
                hint = "record it" if matching(pattern, every, populations) else _closest(pattern, recorded)
                message = "matches no recorded signal"
                yield graph.document.problem("not-recorded", f"{place}.{path}", message, f"'{pattern}'", hint)


def _measures(experiment: Experiment) -> Iterator[tuple[str, Measure]]:
    yield from ((f"claims.{name}.measure", claim.measure) for name, claim in experiment.claims.items())
    if experiment.study is not None:
        objective = experiment.study.objective
        yield from ((f"study.objective.{path}", measure) for path, measure in objective.all_measures())
    for name, sweep in experiment.sweeps.items():
        yield from ((f"sweeps.{name}.measures.{key}", measure) for key, measure in sweep.measures.items())


def initial_matches_nothing(graph: ModelGraph) -> Iterator[Problem]:
    """Each pattern of `protocol.initial` matches a state, or how a body can start."""
    every = list(_starts(graph))
    for pattern in graph.document.experiment.protocol.initial:
        if not matching(pattern, every, sizes(graph)):
            path = f"protocol.initial.{pattern}"
            hint = _closest(pattern, every)
            yield graph.document.problem("no-such-state", path, "matches no state", f"'{pattern}'", hint)


def initial_outside_bounds(graph: ModelGraph) -> Iterator[Problem]:
    """A value at time zero has the dimension of the states that it sets, and is one that they can have."""
    every = _starts(graph)
    for pattern, value in graph.document.experiment.protocol.initial.items():
        path = f"protocol.initial.{pattern}"
        values: tuple[object, ...] = (value,)
        if isinstance(value, Uniform):
            path, values = f"{path}.uniform", value.uniform
        for unit in dict.fromkeys(_units(pattern, every, sizes(graph))):
            yield from _unit_problems(graph, path, values, unit)


def _starts(graph: ModelGraph) -> dict[str, Unit]:
    body = start_units(graph.body) if graph.body else {}
    return states(graph) | {name: Unit("value", unit) for name, unit in body.items()}


def _units(pattern: str, every: dict[str, Unit], populations: dict[str, int]) -> Iterator[Unit]:
    for name in matching(pattern, every, populations):
        element, _, quantity = split(name)
        yield every[f"{element}.{quantity}"]


def _unit_problems(graph: ModelGraph, path: str, values: tuple[object, ...], unit: Unit) -> Iterator[Problem]:
    for value in values:
        try:
            unit.parse(value)
        except PydanticCustomError as error:
            context = error.context or {}
            yield graph.document.problem(error.type, path, error.message(), context.get("got"), context.get("hint"))
            return


def _closest(pattern: str, names: Iterable[str]) -> str:
    """Return a hint about the part of a pattern that matches nothing: the quantity, or else the element before it."""
    every = list(names)
    element, _, quantity = pattern.rpartition(".")
    quantities = {name.rpartition(".")[2] for name in every}
    if not matching(quantity, quantities):
        return did_you_mean(quantity, quantities)
    return did_you_mean(element, {name.rpartition(".")[0] for name in matching(f"*.{quantity}", every)})
