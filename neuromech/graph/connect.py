"""The edges of the graph: synapses, wires, crossings of joints by muscles, and the structure of the body."""

from collections.abc import Iterator
from itertools import pairwise

from neuromech.components.base import Component
from neuromech.components.paths import ConstantMomentArms, LeverArms, StraightLines
from neuromech.graph.declare import scopes
from neuromech.graph.model import BodyModel, Connection, Element
from neuromech.graph.names import SENDER, Resolver, qualified, receiver
from neuromech.graph.tree import chain
from neuromech.spec.model import Contact, Joint

Edge = tuple[str, str, Connection]


def synapses(resolver: Resolver) -> Iterator[Edge]:
    """Yield the synapses of every scope whose two ends exist; the resolver notes the others."""
    for scope, path, content in scopes(resolver.document.experiment):
        for kind, senders in content.network.synapses.items():
            for sender, receivers in senders.items():
                here = qualified(path, f"network.synapses.{kind}.{sender}")
                source = resolver.resolve(sender, scope, here, SENDER)
                for name, synapse in receivers.items():
                    target = resolver.resolve(name, scope, f"{here}.{name}", receiver(synapse.port))
                    if source is not None and target is not None:
                        output = _synaptic_output(source)
                        connection = Connection("synapse", f"{here}.{name}", output, synapse.port, synapse)
                        yield source.name, target.name, connection


def projections(resolver: Resolver) -> Iterator[Edge]:
    """Yield the projections of every scope whose two ends exist; the resolver notes the others."""
    for scope, path, content in scopes(resolver.document.experiment):
        for name, projection in content.network.projections.items():
            here = qualified(path, f"network.projections.{name}")
            port = projection.synapse.port
            source = resolver.resolve(projection.sender, scope, f"{here}.sender", SENDER)
            target = resolver.resolve(projection.receiver, scope, f"{here}.receiver", receiver(port))
            if source is not None and target is not None:
                output, own = _synaptic_output(source), qualified(scope, name)
                connection = Connection("projection", here, output, port, projection.synapse, projection, own)
                yield source.name, target.name, connection


def _synaptic_output(source: Element) -> str:
    assert isinstance(source.spec, Component)
    assert source.spec.synaptic_output is not None
    return source.spec.synaptic_output


def wires(elements: list[Element]) -> Iterator[Edge]:
    """Yield the connections that references of components make: (named element, component, connection)."""
    for element in elements:
        spec = element.spec
        if not isinstance(spec, Component):
            continue
        for field, reference in spec.references().items():
            other = getattr(spec, field)
            for output, port in reference.wires if other is not None else ():
                read = output.format_map(dict(spec))
                yield other, element.name, Connection("wire", f"{element.path}.{field}", read, port)


def crossings(elements: list[Element], body: BodyModel | None) -> Iterator[Edge]:
    """Yield (muscle, joint, connection) for each joint that the path of a muscle crosses."""
    for element in elements:
        way = getattr(element.spec, "path", None)
        if isinstance(way, ConstantMomentArms):
            for joint in {**way.moment_arms, **way.reference_angles}:
                yield element.name, joint, Connection("crossing", f"{element.path}.path.moment_arms")
        elif isinstance(way, LeverArms):
            for joint in way.arms:
                yield element.name, joint, Connection("crossing", f"{element.path}.path.arms")
        elif isinstance(way, StraightLines) and body is not None:
            for joint in crossed_by_lines(way, body):
                yield element.name, joint, Connection("crossing", f"{element.path}.path.points")


def crossed_by_lines(way: StraightLines, body: BodyModel) -> list[str]:
    """Return the joints between the segments of consecutive points, each once, from origin to insertion."""
    segments = [point.segment for point in way.points]
    crossed = (joint for start, end in pairwise(segments) for joint in chain(body, start, end))
    return list(dict.fromkeys(crossed))


def structure(elements: list[Element]) -> Iterator[Edge]:
    """Yield parent segment to joint, joint to child segment, and segment to contact."""
    for element in elements:
        spec = element.spec
        if isinstance(spec, Joint):
            yield spec.parent, element.name, Connection("structure", f"{element.path}.parent")
            yield element.name, spec.child, Connection("structure", f"{element.path}.child")
        elif isinstance(spec, Contact):
            yield spec.segment, element.name, Connection("structure", f"{element.path}.segment")
