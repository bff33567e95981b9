"""Rules about what is defined twice."""

from collections.abc import Iterator

from neuromech.components.base import Component
from neuromech.errors import Problem
from neuromech.graph.model import ModelGraph


def synapse_defined_twice(graph: ModelGraph) -> Iterator[Problem]:
    """A synapse of one kind between two neurons is written once: two would silently add up."""
    first: dict[tuple[str, str, str], str] = {}
    for sender, receiver, connection in graph.connections("synapse"):
        assert isinstance(connection.spec, Component)
        key = (connection.spec.kind_name(), sender, receiver)
        if key in first:
            message = f"defines the {key[0]} synapse from '{sender}' to '{receiver}' a second time"
            hint = f"the first stands at {first[key]}"
            yield graph.document.problem("two-definitions", connection.path, message, hint=hint)
        first.setdefault(key, connection.path)
