"""Everything that a document declares, scope by scope, as elements whose references are still as written."""

from collections.abc import Iterator, Mapping
from importlib import import_module
from pathlib import Path

from neuromech.errors import Problem
from neuromech.graph.model import Element, NodeFamily, Spec
from neuromech.graph.names import qualified
from neuromech.spec.document import Document
from neuromech.spec.model import BodyParts, Experiment, Instance, Scope


def scopes(experiment: Experiment) -> Iterator[tuple[str, str, Scope]]:
    """Yield (qualified name, document path, scope) of the document itself and of every instance in it."""
    yield "", "", experiment
    yield from _instances("", "", experiment.instances)


def _instances(outer: str, path: str, instances: Mapping[str, Instance]) -> Iterator[tuple[str, str, Scope]]:
    for name, instance in instances.items():
        inner = qualified(outer, name)
        inner_path = qualified(path, f"instances.{name}")
        yield inner, inner_path, instance
        yield from _instances(inner, inner_path, instance.instances)


def declared(document: Document) -> tuple[list[Element], list[Problem]]:
    """Return every element in authored order, and what is wrong with the body file where there is one."""
    elements = list[Element]()
    problems = list[Problem]()
    for scope, path, content in scopes(document.experiment):
        elements += _of_scope(scope, path, content)
        body = content.body if isinstance(content, Experiment | Instance) else None
        if body is not None:
            elements += _of_body(scope, qualified(path, "body"), body)
    protocol = document.experiment.protocol
    elements += _of_map("", "protocol.pushes", "push", protocol.pushes)
    elements += _of_map("", "protocol.push_series", "push", protocol.push_series)
    elements += _of_map("", "world.pendulums", "pendulum", document.experiment.world.pendulums)
    try:
        elements += _of_body_file(document)
    except ValueError as error:
        problems.append(document.problem("body-file", "body.file", str(error)))
    return elements, problems


def _of_scope(scope: str, scope_path: str, content: Scope) -> Iterator[Element]:
    network = qualified(scope_path, "network")
    yield from _of_map(scope, f"{network}.neurons", "neuron", content.network.neurons)
    for name, population in content.network.populations.items():
        path = f"{network}.populations.{name}"
        yield Element(qualified(scope, name), "population", population.neuron, path, scope, population)
    yield from _of_map(scope, f"{network}.drives", "drive", content.network.drives)
    yield from _of_map(scope, qualified(scope_path, "muscles"), "muscle", content.muscles)
    yield from _of_map(scope, qualified(scope_path, "sensors"), "sensor", content.sensors)


def _of_body(scope: str, path: str, body: BodyParts) -> Iterator[Element]:
    yield from _of_map(scope, f"{path}.segments", "segment", body.segments)
    yield from _of_map(scope, f"{path}.joints", "joint", body.joints)
    yield from _of_map(scope, f"{path}.contacts", "contact", body.contacts)


def _of_map(
    scope: str,
    path: str,
    family: NodeFamily,
    specs: Mapping[str, Spec],
) -> Iterator[Element]:
    for name, spec in specs.items():
        yield Element(qualified(scope, name), family, spec, f"{path}.{name}", scope)


def body_file(document: Document) -> Path | None:
    """Return the file that segments and joints come from; it stands relative to the document that names it."""
    body = document.experiment.body
    if body is None or body.file is None:
        return None
    mark = document.mark("body.file")
    return (Path(mark.file) if mark else document.file).parent / body.file


def _of_body_file(document: Document) -> Iterator[Element]:
    file = body_file(document)
    if file is None:
        return
    # Few documents name such a file, and its geometry needs NumPy, which takes a tenth of a second to import.
    segments, joints, contacts = import_module("neuromech.graph.body_file").read_body_file(file)
    yield from _of_body("", "body.file", BodyParts(segments=segments, joints=joints, contacts=contacts))


def two_definitions(document: Document, elements: list[Element]) -> Iterator[Problem]:
    """Yield a problem for each name that its scope defines twice, as two elements or as element and instance."""
    first = {name: f"the instance at {path}" for name, path, _ in scopes(document.experiment) if name}
    for element in elements:
        name = element.name.rpartition(".")[2]
        if element.name in first:
            message = f"the name '{name}' is defined twice in its scope, first by {first[element.name]}"
            yield document.problem("two-definitions", element.path, message, hint="rename one of the two")
        first.setdefault(element.name, f"the {element.family} at {element.path}")
