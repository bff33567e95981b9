"""The rule about delays."""

from collections.abc import Iterator

from neuromech.errors import Problem
from neuromech.graph.model import ModelGraph


def delay_below_step(graph: ModelGraph) -> Iterator[Problem]:
    """A delay is zero or at least one step of the solver, which cannot see anything shorter."""
    step = graph.document.experiment.solver.step
    for _, _, connection in graph.connections("synapse", "projection"):
        delay = getattr(connection.spec, "delay", 0.0)
        if 0.0 < delay < step:
            path = f"{connection.spec_path}.delay"
            message = f"must be zero or at least the solver's step of {1e3 * step:g} ms"
            hint = "lengthen the delay or shorten solver.step"
            yield graph.document.problem("delay-below-step", path, message, f"{1e3 * delay:g} ms", hint)
