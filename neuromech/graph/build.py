"""Document → ModelGraph: scopes flattened, names resolved, structure made explicit."""

from collections.abc import Iterable
from itertools import chain

import networkx as nx

from neuromech.errors import DocumentError
from neuromech.graph.check import VALUE_RULES, broken
from neuromech.graph.connect import Edge, crossings, projections, structure, synapses, wires
from neuromech.graph.declare import declared, two_definitions
from neuromech.graph.model import Element, ModelGraph
from neuromech.graph.names import Names, Resolver
from neuromech.graph.references import resolved
from neuromech.graph.tree import body_model
from neuromech.spec.document import Document


def build(document: Document) -> ModelGraph:
    """Return the graph of a document.

    Every reference inside its elements is a qualified name afterwards.

    Raises:
        DocumentError: names that are defined twice or mean nothing, a body that is no tree; all of them at once.
    """
    written, problems = declared(document)
    if problems:
        raise DocumentError(problems)
    problems += two_definitions(document, written)
    resolver = Resolver(document, Names(written))
    elements = resolved(written, resolver)
    synaptic = [*synapses(resolver), *projections(resolver)]
    body, body_problems = (None, []) if _dangling_joint(elements, resolver) else body_model(document, elements)
    problems += resolver.problems + body_problems
    if problems:
        partial = ModelGraph(document, _graph(elements, synaptic), None)
        raise DocumentError([*problems, *broken(partial, VALUE_RULES)])
    edges = chain(synaptic, wires(elements), crossings(elements, body), structure(elements))
    return ModelGraph(document, _graph(elements, edges), body)


def _dangling_joint(elements: Iterable[Element], resolver: Resolver) -> bool:
    joints = tuple(f"{element.path}." for element in elements if element.family == "joint")
    return any(problem.path.startswith(joints) for problem in resolver.problems)


def _graph(elements: Iterable[Element], edges: Iterable[Edge]) -> "nx.MultiDiGraph[str]":
    graph = nx.MultiDiGraph()
    for element in elements:
        graph.add_node(element.name, element=element)
    for sender, receiver, connection in edges:
        graph.add_edge(sender, receiver, connection=connection)
    return graph
