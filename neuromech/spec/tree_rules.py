"""Rules that need the tree: what a parameter may stand for, and names that only `--set` mentions."""

from collections.abc import Iterator

from neuromech.components.catalogue import Catalogue
from neuromech.errors import Problem, did_you_mean
from neuromech.spec.model import Experiment
from neuromech.spec.node import MapNode, Node, ScalarNode, join
from neuromech.spec.resolve import Resolved
from neuromech.spec.shape import Leaf, Names, shape_of, typed

# Values at time zero have the unit of what they set, which the document's types don't know.
_START = "protocol.initial."


def check_tree(resolved: Resolved, catalogue: Catalogue) -> Iterator[Problem]:
    """Yield what is wrong with references to parameters and with paths of `--set`."""
    for path, node, annotation in typed(resolved.tree, Experiment, catalogue):
        if isinstance(node, ScalarNode) and node.parameter is not None:
            shape = shape_of(annotation, catalogue)
            if (not isinstance(shape, Leaf) or shape.unit is None) and not path.startswith(_START):
                yield _no_quantity(node, path)
        elif isinstance(node, MapNode) and resolved.through and isinstance(shape_of(annotation, catalogue), Names):
            yield from _new_names(node, path, resolved.through)


def _no_quantity(node: ScalarNode, path: str) -> Problem:
    message = "is not a quantity of the model, so it cannot follow a parameter"
    return Problem("reference", path, message, f"${{{node.parameter}}}", "write the value itself", node.mark)


def _new_names(node: MapNode, path: str, through: frozenset[str]) -> Iterator[Problem]:
    known = [key for key, entry in node.entries.items() if entry.mark is not None]
    for key, entry in node.entries.items():
        if entry.mark is None and key in through and _came_from_set(entry.node):
            yield Problem("unknown-name", join(path, key), "does not exist", None, did_you_mean(key, known))


def _came_from_set(node: Node) -> bool:
    return isinstance(node, MapNode) and node.mark is None
