"""The model as a graph: every element a node, every connection an edge, all names resolved and qualified."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Literal

import networkx as nx

from neuromech.components.base import Component
from neuromech.spec.document import Document
from neuromech.spec.model import Contact, Joint, Population, Projection, Root, Segment
from neuromech.spec.pendulum import Pendulum
from neuromech.spec.pushes import Push, PushSeries
from neuromech.spec.world import World

NodeFamily = Literal[
    "neuron", "population", "drive", "muscle", "sensor", "joint", "segment", "contact", "push", "pendulum"
]
Spec = Component | Segment | Joint | Contact | Push | PushSeries | Pendulum
EdgeKind = Literal["synapse", "projection", "wire", "crossing", "structure"]


@dataclass(frozen=True, slots=True)
class Element:
    """What a node of the graph stands for. Stored as the node attribute `element`.

    Args:
        name: qualified name, which is the node itself.
        family: what kind of thing it is.
        spec: the component, or the segment, joint, contact, push or pendulum as written; of a population, its neuron.
        path: dotted path in the document.
        scope: qualified name of the instance that holds it, empty for the document.
        population: size and variation of a population, None for anything else.
    """

    name: str
    family: NodeFamily
    spec: Spec
    path: str
    scope: str
    population: Population | None = None

    @property
    def size(self) -> int:
        """How many there are: the neurons of a population, else one."""
        return self.population.size if self.population else 1

    @property
    def spec_path(self) -> str:
        """Dotted path of `spec` in the document."""
        return f"{self.path}.neuron" if self.population else self.path


@dataclass(frozen=True, slots=True)
class Connection:
    """What an edge of the graph stands for. Stored as the edge attribute `connection`.

    `synapse`: weighted and possibly delayed, from an output of the sender into an input port of a neuron; where an end
    is a population, from or to each of its neurons. `projection`: the same, wired as `projection` says; `name` is its
    qualified name. `wire`: an output feeds an input port as it is (weight 1). `crossing`: a muscle's path crosses a
    joint. `structure`: parent segment to joint, joint to child segment, segment to contact.
    """

    kind: EdgeKind
    path: str
    output: str = ""
    port: str = ""
    spec: Component | None = None
    projection: Projection | None = None
    name: str = ""

    @property
    def spec_path(self) -> str:
        """Dotted path of `spec` in the document."""
        return f"{self.path}.synapse" if self.projection else self.path


@dataclass(frozen=True, slots=True)
class Motion:
    """Velocities at time zero.

    Args:
        joints: joint → velocity in rad/s, of a slide in m/s; those not named are at rest.
        root: velocity of the root frame's origin in m/s, world axes.
    """

    joints: dict[str, float] = field(default_factory=dict)
    root: tuple[float, float, float] = (0.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True)
class BodyModel:
    """A body with qualified names throughout, in authored order; parents come before their children."""

    engine: str
    file: str | None
    root: Root
    root_segment: str
    segments: dict[str, Segment]
    joints: dict[str, Joint]
    contacts: dict[str, Contact]
    world: World
    motion: Motion = Motion()


@dataclass(frozen=True, slots=True)
class ModelGraph:
    """The whole model. `graph` is a MultiDiGraph over qualified names, nodes in authored order."""

    document: Document
    graph: "nx.MultiDiGraph[str]"
    body: BodyModel | None

    def elements(self, *families: NodeFamily) -> Iterator[Element]:
        """Yield the elements of the given families (all families where none is given), in authored order."""
        for _, element in self.graph.nodes(data="element"):
            if not families or element.family in families:
                yield element

    def element(self, name: str) -> Element:
        """Return the element with a qualified name.

        Raises:
            KeyError: there is none.
        """
        return self.graph.nodes[name]["element"]  # type: ignore[no-any-return]

    def connections(self, *kinds: EdgeKind) -> Iterator[tuple[str, str, Connection]]:
        """Yield (sender, receiver, connection) of the given kinds (all where none is given), in authored order."""
        for sender, receiver, connection in self.graph.edges(data="connection"):
            if not kinds or connection.kind in kinds:
                yield sender, receiver, connection
