"""Rules about what signals reach: motoneurons are driven and pull, sensors are heard."""

from collections.abc import Iterator
from typing import Final

import networkx as nx

from neuromech.components.base import Component, Neuron
from neuromech.errors import Problem
from neuromech.graph.model import Element, ModelGraph, NodeFamily
from neuromech.graph.signals import matching, signals

_BEFORE: Final = 0
"""No name: the node before all sources."""


def unreachable_motoneuron(graph: ModelGraph) -> Iterator[Problem]:
    """Synapses lead to each motoneuron from a drive, a sensor, or a neuron that is active by itself."""
    links = nx.DiGraph()
    links.add_nodes_from(element.name for element in graph.elements())
    links.add_edges_from((sender, receiver) for sender, receiver, _ in graph.connections("synapse", "projection"))
    # From one place before all sources the network is gone through once.
    links.add_edges_from((_BEFORE, element.name) for element in graph.elements() if _is_source(element))
    reached = nx.descendants(links, _BEFORE) if _BEFORE in links else set()
    for element in _motoneurons(graph, "neuron", "population"):
        if element.name not in reached:
            message = "no path of synapses leads to this motoneuron from a drive, a sensor or a rhythm generator"
            hint = "add the synapse that excites it"
            yield graph.document.problem("unreachable-motoneuron", element.path, message, hint=hint)


def idle_motoneuron(graph: ModelGraph) -> Iterator[Problem]:
    """Where there are muscles, each motoneuron activates one."""
    if not any(graph.elements("muscle")):
        return
    pulling = {sender for sender, receiver, _ in graph.connections("wire") if _family(graph, receiver) == "muscle"}
    for element in _motoneurons(graph, "neuron"):
        if element.name not in pulling:
            hint = "name it as 'motoneuron' of a muscle, or give it another layer"
            yield graph.document.problem("idle-motoneuron", element.path, "activates no muscle", hint=hint)


def sensor_without_target(graph: ModelGraph) -> Iterator[Problem]:
    """A sensor has a synapse, another component reads it, or it is recorded."""
    heard = {sender for sender, _, _ in graph.connections("synapse", "projection", "wire")}
    every = list(signals(graph))
    patterns = [pattern for group in graph.document.experiment.record.values() for pattern in group.signals]
    heard |= {name.rpartition(".")[0] for pattern in patterns for name in matching(pattern, every)}
    for element in graph.elements("sensor"):
        if element.name not in heard:
            hint = "add a synapse from it, or record it"
            yield graph.document.problem("sensor-without-target", element.path, "nothing reads this sensor", hint=hint)


def _motoneurons(graph: ModelGraph, *families: NodeFamily) -> Iterator[Element]:
    for element in graph.elements(*families):
        if isinstance(element.spec, Neuron) and element.spec.layer == "motoneuron":
            yield element


def _is_source(element: Element) -> bool:
    """Return whether an element is active without input.

    With no input, one first-order state settles: a neuron needs a second state, or a bias, to act by itself.
    """
    spec = element.spec
    if not isinstance(spec, Component):
        return False
    if not isinstance(spec, Neuron):
        return spec.synaptic_output is not None
    biased = bool(getattr(spec, "bias", 0.0))
    return biased or (spec.layer != "motoneuron" and (spec.layer == "rhythm_generator" or len(spec.states) > 1))


def _family(graph: ModelGraph, name: str) -> str:
    return graph.element(name).family
