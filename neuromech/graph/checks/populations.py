"""Rules about populations and projections: what varies, and how many synapses they make."""

from collections.abc import Iterator

from pydantic_core import PydanticCustomError

from neuromech.components.base import Component
from neuromech.errors import Problem, did_you_mean
from neuromech.graph.model import Connection, Element, ModelGraph
from neuromech.spec.model import Projection, Uniform
from neuromech.units import TIME, Unit

MAXIMAL_SYNAPSES = 1_000_000_000


def varied_parameter(graph: ModelGraph) -> Iterator[Problem]:
    """What varies is a quantity of the kind; both ends of its interval have its dimension and lie in its bounds."""
    for element in graph.elements("population"):
        if isinstance(element.spec, Component) and element.population is not None:
            yield from _varied(graph, element.spec, element.population.vary, element.path)
    for _, _, connection in graph.connections("projection"):
        if connection.spec is not None and connection.projection is not None:
            yield from _varied(graph, connection.spec, connection.projection.vary, connection.path)
            yield from _varied_delay(graph, connection.projection, connection.path)


def two_ways_of_wiring(graph: ModelGraph) -> Iterator[Problem]:
    """A projection has an in-degree or a probability."""
    for _, _, connection in graph.connections("projection"):
        projection = connection.projection
        if projection is not None and projection.in_degree is not None and projection.probability is not None:
            path = f"{connection.path}.probability"
            yield graph.document.problem("two-ways", path, "stands beside 'in_degree'", hint="keep one of the two")


def too_few_senders(graph: ModelGraph) -> Iterator[Problem]:
    """A population has at least as many neurons as each receiver gets senders."""
    for sender, _, connection in graph.connections("projection"):
        in_degree = connection.projection.in_degree if connection.projection else None
        size = graph.element(sender).size
        if in_degree is not None and in_degree > size:
            message = f"must be at most the size of '{sender}', {size}"
            path = f"{connection.path}.in_degree"
            yield graph.document.problem("out-of-range", path, message, str(in_degree))


def too_many_synapses(graph: ModelGraph) -> Iterator[Problem]:
    """Synapses can be counted and stored."""
    for sender, receiver, connection in graph.connections("synapse", "projection"):
        count = synapse_count(graph.element(sender), graph.element(receiver), connection)
        if count > MAXIMAL_SYNAPSES:
            message = f"makes more than {MAXIMAL_SYNAPSES:.0e} synapses"
            hint = "give it an in_degree or a smaller probability"
            yield graph.document.problem("too-many-synapses", connection.path, message, f"{count:.2g}", hint)


def synapse_count(sender: Element, receiver: Element, connection: Connection) -> float:
    """Return how many synapses a connection makes, on average where it is random."""
    projection = connection.projection
    if projection is None or (projection.in_degree is None and projection.probability is None):
        return float(sender.size * receiver.size)
    if projection.in_degree is not None:
        return float(projection.in_degree * receiver.size)
    return float(projection.probability or 0.0) * sender.size * receiver.size


def _varied(graph: ModelGraph, spec: Component, vary: dict[str, Uniform], path: str) -> Iterator[Problem]:
    fields = type(spec).model_fields.items()
    units = {name: unit for name, field in fields for unit in field.metadata if isinstance(unit, Unit)}
    for name, interval in vary.items():
        here = f"{path}.vary.{name}"
        if name not in units:
            message = f"is no quantity of the {spec.family} kind '{spec.kind_name()}'"
            yield graph.document.problem("unknown-parameter", here, message, hint=did_you_mean(name, units))
            continue
        for index, value in enumerate(interval.uniform):
            try:
                units[name].parse(value)
            except PydanticCustomError as error:
                context, place = error.context or {}, f"{here}.uniform.{index}"
                got, hint = context.get("got"), context.get("hint")
                yield graph.document.problem(error.type, place, error.message(), got, hint)


def _varied_delay(graph: ModelGraph, projection: Projection, path: str) -> Iterator[Problem]:
    """Delays that vary are at least one step of the solver, every one of them."""
    interval = projection.vary.get("delay")
    if interval is None:
        return
    step = graph.document.experiment.solver.step
    try:
        shortest, longest = sorted(TIME.parse(value) for value in interval.uniform)
    except PydanticCustomError:
        return
    if shortest < step and longest > 0.0:
        message = f"must be at least the solver's step of {1e3 * step:g} ms"
        here = f"{path}.vary.delay"
        hint = "lengthen the delays or shorten solver.step"
        yield graph.document.problem("delay-below-step", here, message, f"{1e3 * shortest:g} ms", hint)
