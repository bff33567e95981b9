"""Names and scopes: a reference is looked up in its own scope first, then outwards."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field

from neuromech.components.base import Component, Target
from neuromech.errors import Problem, did_you_mean
from neuromech.graph.model import Element
from neuromech.spec.document import Document


@dataclass(frozen=True, slots=True)
class Wanted:
    """What a reference must name.

    Args:
        text: the words for it in a message (`a neuron`).
        accepts: whether an element is such a thing.
    """

    text: str
    accepts: Callable[[Element], bool]


def wanted(family: Target) -> Wanted:
    """Return the requirement that an element is of one family."""
    return Wanted(f"a {family}", lambda element: element.family == family)


SENDER = Wanted(
    "a neuron, a drive or a sensor",
    lambda element: isinstance(element.spec, Component) and element.spec.synaptic_output is not None,
)


def receiver(port: str) -> Wanted:
    """Return the requirement for the receiver of a synapse into `port`: neurons, or what else has such a port."""

    def accepts(element: Element) -> bool:
        spec = element.spec
        return isinstance(spec, Component) and (
            element.family in ("neuron", "population") or any(found.name == port for found in spec.inputs)
        )

    return Wanted("a neuron", accepts)


def qualified(scope: str, name: str) -> str:
    """Return the name of something in a scope, as seen from the document."""
    return f"{scope}.{name}" if scope else name


def enclosing(scope: str) -> Iterator[str]:
    """Yield a scope and all scopes around it, the innermost first and the document's (empty) last."""
    while scope:
        yield scope
        scope = scope.rpartition(".")[0]
    yield ""


class Names:
    """The elements of a document by qualified name."""

    def __init__(self, elements: Iterable[Element]) -> None:
        """Keep the elements; where a name is defined twice, both."""
        self._elements: dict[str, list[Element]] = {}
        for element in elements:
            self._elements.setdefault(element.name, []).append(element)

    def candidates(self, reference: str, scope: str) -> Iterator[Element]:
        """Yield what a reference may mean, the closest first."""
        for around in enclosing(scope):
            yield from self._elements.get(qualified(around, reference), ())

    def visible(self, scope: str, what: Wanted) -> list[str]:
        """Return the names of acceptable elements, each as it would be written in a scope."""
        around = [f"{one}." for one in enclosing(scope) if one]
        accepted = (name for name, found in self._elements.items() if any(map(what.accepts, found)))
        return [next((name[len(one) :] for one in around if name.startswith(one)), name) for name in accepted]


@dataclass
class Resolver:
    """Turns references into qualified names and gathers those that name nothing suitable."""

    document: Document
    names: Names
    problems: list[Problem] = field(default_factory=list)

    def resolve(self, reference: str, scope: str, path: str, what: Wanted) -> Element | None:
        """Return the element that a reference at a document path means, or None after noting the problem."""
        found = list(self.names.candidates(reference, scope))
        for element in found:
            if what.accepts(element):
                return element
        allowed = self.names.visible(scope, what)
        hint = did_you_mean(reference, allowed) if allowed else f"the document has no {what.text.partition(' ')[2]}"
        got = f"'{reference}', a {found[0].family}" if found else f"'{reference}'"
        self.problems.append(self.document.problem("unknown-name", path, f"must name {what.text}", got, hint))
        return None

    def qualify(self, reference: str, scope: str, path: str, what: Wanted) -> str:
        """Return the qualified name that a reference means, or the reference itself after noting the problem."""
        element = self.resolve(reference, scope, path, what)
        return reference if element is None else element.name
