"""Rules about the two ends of a connection: the ports exist, and their units have one dimension."""

from collections.abc import Iterator

from neuromech.components.base import Port
from neuromech.errors import Problem, did_you_mean
from neuromech.graph.mechanics import inputs, outputs
from neuromech.graph.model import Connection, Element, ModelGraph
from neuromech.units import unit_factor

Ends = tuple[Element, Element, Connection]


def port_missing(graph: ModelGraph) -> Iterator[Problem]:
    """The sender has the output that is read, and the receiver the input port that is fed."""
    for sender, receiver, connection in _signal_connections(graph):
        for element, wanted, side, ports in (
            (sender, connection.output, "output", outputs(sender)),
            (receiver, connection.port, "input port", inputs(receiver)),
        ):
            names = [port.name for port in ports]
            if wanted not in names:
                message = f"needs the {side} '{wanted}' of '{element.name}', which has none of that name"
                hint = did_you_mean(wanted, names)
                yield graph.document.problem("no-such-port", connection.path, message, hint=hint)


def unit_clash(graph: ModelGraph) -> Iterator[Problem]:
    """An output feeds a port of the same dimension; a port with the unit `*` accepts any."""
    for sender, receiver, connection in _signal_connections(graph):
        output = _port(outputs(sender), connection.output)
        port = _port(inputs(receiver), connection.port)
        if output is not None and port is not None and not _compatible(output.unit, port.unit):
            message = f"feeds '{port.name}' of '{receiver.name}', which is {_words(port.unit)}"
            got = f"'{output.name}' of {sender.family} '{sender.name}', which is {_words(output.unit)}"
            yield graph.document.problem("unit-clash", connection.path, message, got)


def _signal_connections(graph: ModelGraph) -> Iterator[Ends]:
    for sender, receiver, connection in graph.connections("synapse", "projection", "wire"):
        yield graph.element(sender), graph.element(receiver), connection


def _port(ports: tuple[Port, ...], name: str) -> Port | None:
    return next((port for port in ports if port.name == name), None)


def _compatible(output: str, port: str) -> bool:
    return "*" in (output, port) or unit_factor(output)[1] == unit_factor(port)[1]


def _words(unit: str) -> str:
    return f"in {unit}" if unit else "a number"
