"""One network for all peers: taken from the graph that we compile, so that nobody has tables of their own."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from neuromech.analyse.cycles import cycles
from neuromech.compiler.numerics import Floats
from neuromech.compiler.program import Program
from neuromech.compiler.shape import parameter_names
from neuromech.components.base import Component
from neuromech.graph.model import Element, ModelGraph
from neuromech.simulate.initial import initial_states

SAMPLING_STEPS = 2
"""Steps between two samples of the reference neuron's potential."""

_TRANSIENT_SECONDS = 3.0
_LEAST_SWING = 1e-3


def export(program: Program, seed: int, reference: str) -> dict[str, Any]:
    """Return a network as plain values, SI units, for peers to build it from.

    Args:
        program: a network of Rybak neurons and interneurons with drives, without a body.
        seed: of the initial states.
        reference: name of the neuron whose potential is compared.

    Returns:
        `step` (s), `sampling_steps`, `reference` (index), `neurons` (name, kind, parameters, initial), and for each of
        the ports `excitation` and `inhibition` its `synapses` (receiver, sender, weight) and `constant` (one value for
        each neuron: what drives add).
    """
    graph = program.graph
    neurons = sorted(graph.elements("neuron"), key=lambda element: (element.spec.kind, element.name))  # type: ignore[union-attr]
    place = {element.name: k for k, element in enumerate(neurons)}
    states = initial_states(program, seed)
    return {
        "step": program.tick,
        "sampling_steps": SAMPLING_STEPS,
        "reference": place[reference],
        "neurons": [_neuron(element, states, program.layout.states) for element in neurons],
        "excitation": _port(graph, "excitation", place),
        "inhibition": _port(graph, "inhibition", place),
    }


def header(network: Mapping[str, Any]) -> str:
    """Return an exported network as a C header: counts, parameters of each kind, initial states, synapses in CSR.

    A parameter that all neurons of a kind share becomes one number, as in our own compiled step.
    """
    lines = [f"#define STEP {network['step']!r}", f"#define SAMPLING_STEPS {network['sampling_steps']}"]
    lines += [f"#define REFERENCE {network['reference']}", f"#define NEURONS {len(network['neurons'])}"]
    for kind in ("rybak_interneuron", "rybak_neuron"):
        members = [neuron for neuron in network["neurons"] if neuron["kind"] == kind]
        lines.append(f"#define {kind.upper()}S {len(members)}")
        for name in members[0]["parameters"]:
            lines.append(_parameter(f"{kind}_{name}", [neuron["parameters"][name] for neuron in members]))
        for name in members[0]["initial"]:
            lines.append(_array("double", f"{kind}_initial_{name}", [n["initial"][name] for n in members]))
    for port in ("excitation", "inhibition"):
        lines += _compressed_rows(port, network[port])
    return "\n".join(lines) + "\n"


def period(potential: Sequence[float] | Floats, interval: float) -> float:
    """Return the median period (s) of a potential after its transient.

    Args:
        potential: samples (V) from time zero on.
        interval: time between samples (s).

    Raises:
        NotMeasurableError: there is no rhythm.
    """
    values = np.asarray(potential, dtype=np.float64)
    time: Floats = np.arange(len(values), dtype=np.float64) * interval
    late = time >= _TRANSIENT_SECONDS
    return cycles(time[late], values[late], _LEAST_SWING).period


def _neuron(element: Element, states: Floats, places: Mapping[str, int]) -> dict[str, Any]:
    spec = _component(element)
    return {
        "name": element.name,
        "kind": spec.kind_name(),
        "parameters": {name: float(getattr(spec, name)) for name in parameter_names(type(spec))},
        "initial": {state.name: float(states[places[f"{element.name}.{state.name}"]]) for state in spec.states},
    }


def _port(graph: ModelGraph, port: str, place: Mapping[str, int]) -> dict[str, Any]:
    synapses: list[tuple[int, int, float]] = []
    constant = [0.0] * len(place)
    for sender, receiver, connection in graph.connections("synapse"):
        if connection.port != port:
            continue
        weight = float(getattr(connection.spec, "weight"))  # noqa: B009
        if sender in place:
            synapses.append((place[receiver], place[sender], weight))
        else:
            constant[place[receiver]] += weight * _drive(_component(graph.element(sender)))
    return {"synapses": sorted(synapses), "constant": constant}


def _drive(spec: Component) -> float:
    if spec.output is None:
        raise ValueError(f"a {spec.kind_name()} has no output")
    return float(type(spec).output(*(float(getattr(spec, name)) for name in parameter_names(type(spec)))))  # type: ignore[misc]


def _component(element: Element) -> Component:
    if not isinstance(element.spec, Component):
        raise TypeError(f"{element.name} is no component")
    return element.spec


def _parameter(name: str, values: list[float]) -> str:
    if len(set(values)) == 1:
        return f"#define {name}(i) ({values[0]!r})"
    return f"{_array('double', f'{name}_values', values)}\n#define {name}(i) {name}_values[i]"


def _array(kind: str, name: str, values: Iterable[float]) -> str:
    some = list(values)
    return f"static const {kind} {name}[{len(some)}] = {{{', '.join(map(repr, some))}}};"


def _compressed_rows(port: str, connected: Mapping[str, Any]) -> list[str]:
    receivers = [receiver for receiver, _, _ in connected["synapses"]]
    starts = np.searchsorted(receivers, np.arange(len(connected["constant"]) + 1)).tolist()
    return [
        _array("int", f"{port}_start", starts),
        _array("int", f"{port}_sender", [sender for _, sender, _ in connected["synapses"]]),
        _array("double", f"{port}_weight", [weight for _, _, weight in connected["synapses"]]),
        _array("double", f"{port}_constant", connected["constant"]),
    ]
