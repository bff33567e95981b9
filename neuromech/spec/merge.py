"""The deep merge: what a document, an instance or `--set` says about a tree that exists already.

Maps merge key by key, everything else is replaced, and a written `null` removes the key.
"""

from dataclasses import replace
from typing import Literal

from neuromech.errors import Problem
from neuromech.spec.node import Entry, MapNode, Node, Origin, is_empty, is_null, join, kind_of, short_text

How = Literal["extends", "instance", "set"]


def merge_maps(base: MapNode, over: MapNode, how: How, problems: list[Problem], path: str = "") -> MapNode:
    """Return `base` changed by `over`; what cannot be merged is added to `problems`.

    A key keeps the position where it was first introduced, a value has the position of the last that gave it.
    """
    entries = dict(base.entries)
    for key, entry in over.entries.items():
        old = entries.get(key)
        if old is None:
            entries[key] = entry
        elif is_null(entry.node):
            del entries[key]
        else:
            entries[key] = Entry(merge(old.node, entry.node, how, problems, join(path, key)), old.mark)
    return MapNode(entries, over.mark or base.mark, base.origins)


def merge(base: Node, over: Node, how: How, problems: list[Problem], path: str) -> Node:
    """Return one value changed by another; a map and anything else do not merge."""
    if isinstance(base, MapNode) and isinstance(over, MapNode):
        return merge_maps(base, over, how, problems, path)
    if isinstance(base, MapNode) != isinstance(over, MapNode) and not (is_empty(base) or is_null(base)):
        problems.append(_clash(base, over, path))
        return base
    origin = Origin(how, short_text(base), base.mark)
    return replace(over, origins=(*base.origins, origin, *over.origins))


def _clash(base: Node, over: Node, path: str) -> Problem:
    place = f" at {base.mark}" if base.mark else ""
    given = "nothing" if is_empty(over) else kind_of(over)
    message = f"cannot merge {given} into {kind_of(base)}{place}"
    hint = f"write {kind_of(base)}, or null to remove the key"
    return Problem("merge", path, message, short_text(over) or None, hint, over.mark)
