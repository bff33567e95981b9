"""The rule about algebraic loops."""

import inspect
from collections.abc import Callable, Iterator
from functools import cache

import networkx as nx

from neuromech.components.base import Component
from neuromech.errors import Problem
from neuromech.graph.model import Connection, Element, ModelGraph


def algebraic_loop(graph: ModelGraph) -> Iterator[Problem]:
    """No output depends on itself at the same instant.

    Sensors are evaluated once per body step and held, so a loop through neurons and sensors is none.
    """
    for families in (("neuron", "population"), ("sensor",)):
        links = _instant_links(graph, families)
        for component in nx.strongly_connected_components(links):
            inner = [edge for edge in links.edges if component.issuperset(edge)]
            if inner:
                yield _problem(graph, links, inner)


def _problem(graph: ModelGraph, links: "nx.DiGraph[str]", inner: list[tuple[str, str]]) -> Problem:
    edges = nx.find_cycle(nx.DiGraph(inner))
    around = " → ".join([edges[0][0], *(receiver for _, receiver in edges)])
    hint = "give one of its synapses a delay, or one of its neurons a time constant"
    path = links.edges[edges[0]]["path"]
    return graph.document.problem("algebraic-loop", path, "closes an algebraic loop", around, hint)


def _instant_links(graph: ModelGraph, families: tuple[str, ...]) -> "nx.DiGraph[str]":
    links = nx.DiGraph()
    for sender, receiver, connection in graph.connections("synapse", "projection", "wire"):
        ends = graph.element(sender), graph.element(receiver)
        if all(end.family in families for end in ends) and _passes_at_once(ends[1], connection):
            links.add_edge(sender, receiver, path=connection.path)
    return links


def _passes_at_once(receiver: Element, connection: Connection) -> bool:
    spec = receiver.spec
    if not isinstance(spec, Component) or spec.output is None or getattr(connection.spec, "delay", 0.0) > 0.0:
        return False
    return connection.port in _arguments(spec.output)


@cache
def _arguments(equation: Callable[..., object]) -> frozenset[str]:
    return frozenset(inspect.signature(equation).parameters)
