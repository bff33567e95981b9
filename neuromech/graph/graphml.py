"""The graph as GraphML, for other programs."""

from pathlib import Path

import networkx as nx

from neuromech.components.base import Component, Synapse
from neuromech.graph.mechanics import inputs
from neuromech.graph.model import Connection, Element, ModelGraph


def export_graphml(graph: ModelGraph, file: Path) -> None:
    """Write the graph with plain attributes.

    Nodes have family, kind, layer, scope, path and size (1, but for populations); edges have connection, path, output,
    port and unit, synapses and projections kind, sign, weight and delay_ms besides.

    Raises:
        OSError: the file cannot be written.
    """
    nx.write_graphml(plain(graph), file)


def plain(graph: ModelGraph) -> "nx.MultiDiGraph[str]":
    """Return the graph with attributes that are text and numbers only."""
    result = nx.MultiDiGraph(name=graph.document.experiment.name)
    for element in graph.elements():
        result.add_node(element.name, **_node(element))
    for sender, receiver, connection in graph.connections():
        result.add_edge(sender, receiver, **_edge(connection, graph.element(receiver)))
    return result


def _node(element: Element) -> dict[str, str | int]:
    kind = element.spec.kind_name() if isinstance(element.spec, Component) else element.family
    layer = getattr(element.spec, "layer", None) or ""
    return {
        "family": element.family,
        "kind": kind,
        "layer": layer,
        "scope": element.scope,
        "path": element.path,
        "size": element.size,
    }


def _edge(connection: Connection, receiver: Element) -> dict[str, str | float]:
    found: dict[str, str | float] = {
        "connection": connection.kind,
        "path": connection.path,
        "output": connection.output,
        "port": connection.port,
        "unit": next((port.unit for port in inputs(receiver) if port.name == connection.port), ""),
    }
    synapse = connection.spec
    if isinstance(synapse, Synapse):
        found |= {"kind": synapse.kind_name(), "sign": synapse.sign}
        found |= {
            "weight": float(getattr(synapse, "weight", 1.0)),
            "delay_ms": 1e3 * float(getattr(synapse, "delay", 0.0)),
        }
    return found
