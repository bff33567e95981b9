"""`${name}`: a module's arguments and a document's parameters put where they are asked for."""

import math
import re
from collections.abc import Iterator, Mapping
from dataclasses import replace

from neuromech.errors import Mark, Problem, did_you_mean
from neuromech.spec.node import (
    MISSING,
    Entry,
    ListNode,
    MapNode,
    Node,
    Origin,
    ScalarNode,
    is_missing,
    join,
    kind_of,
    walk,
)
from neuromech.units import measure

REFERENCE = re.compile(r"\$\{([^{}]*)\}")
MAXIMAL_TEXT = 10_000


def references(node: Node) -> Iterator[str]:
    """Yield every name that is asked for anywhere in a tree, in keys too."""
    for _, found in walk(node):
        if isinstance(found, ScalarNode):
            if "${" in found.text:
                yield from REFERENCE.findall(found.text)
        elif isinstance(found, MapNode):
            for key in found.entries:
                if "${" in key:
                    yield from REFERENCE.findall(key)


def fill_arguments(node: Node, arguments: Mapping[str, Node], problems: list[Problem], path: str = "") -> Node:
    """Return a tree with arguments put in; names that are no argument are left as they are.

    A scalar that is nothing but `${name}` becomes the argument, whatever it is; inside a longer text or a key the
    argument must be a scalar.
    """
    if isinstance(node, ScalarNode):
        return _fill_scalar(node, arguments, problems, path)
    if isinstance(node, ListNode):
        items = (fill_arguments(item, arguments, problems, join(path, at)) for at, item in enumerate(node.items))
        return replace(node, items=tuple(items))
    entries: dict[str, Entry] = {}
    for key, entry in node.entries.items():
        name = _text(key, entry.mark, arguments, problems, path)
        if name is None:
            continue
        if name in entries:
            message = f"the key '{name}' stands twice in this map after its arguments were put in"
            problems.append(Problem("duplicate-key", join(path, name), message, key, None, entry.mark))
        entries[name] = Entry(fill_arguments(entry.node, arguments, problems, join(path, name)), entry.mark)
    return MapNode(entries, node.mark, node.origins)


def fill_parameters(tree: MapNode, problems: list[Problem]) -> MapNode:
    """Return a document's tree with the text of parameters put where `${name}` asks for them.

    What asks for an unknown parameter stays as it is and is added to `problems`.
    """
    parameters = tree.get("parameters")
    found = parameters if isinstance(parameters, MapNode) else MapNode()
    filler = _Parameters(found, problems)
    return MapNode(
        {
            key: entry if key == "parameters" else Entry(filler.fill(entry.node, key), entry.mark)
            for key, entry in tree.entries.items()
        },
        tree.mark,
        tree.origins,
    )


def _fill_scalar(node: ScalarNode, arguments: Mapping[str, Node], problems: list[Problem], path: str) -> Node:
    if "${" not in node.text:
        return node
    whole = REFERENCE.fullmatch(node.text)
    if whole is None:
        text = _text(node.text, node.mark, arguments, problems, path)
        return MISSING if text is None else replace(node, text=text, quoted=True, origins=_asked(node))
    argument = arguments.get(whole[1])
    if argument is None:
        return node
    return replace(argument, origins=(*argument.origins, *_asked(node)))


def _asked(node: ScalarNode) -> tuple[Origin, ...]:
    return (*node.origins, Origin("argument", node.text, node.mark))


def _text(
    text: str, mark: Mark | None, arguments: Mapping[str, Node], problems: list[Problem], path: str
) -> str | None:
    """Return a text with arguments put in, or None where one of them is missing or is no scalar."""
    for name in REFERENCE.findall(text):
        argument = arguments.get(name)
        if argument is not None and is_missing(argument):
            return None
        if isinstance(argument, MapNode | ListNode):
            message = f"'${{{name}}}' stands inside a text, so the argument must be a single value"
            problems.append(Problem("argument", path, message, kind_of(argument), None, mark))
            return None
    words = {name: node.text for name, node in arguments.items() if isinstance(node, ScalarNode)}
    filled = REFERENCE.sub(lambda match: words.get(match[1], match[0]), text)
    if len(filled) > MAXIMAL_TEXT:
        message = f"becomes longer than {MAXIMAL_TEXT} characters"
        problems.append(Problem("too-long", path, message, None, None, mark))
        return None
    return filled


class _Parameters:
    def __init__(self, parameters: MapNode, problems: list[Problem]) -> None:
        self._parameters = parameters
        self._problems = problems

    def fill(self, node: Node, path: str) -> Node:
        """Return a tree with parameters put in."""
        if isinstance(node, ScalarNode):
            return node if "${" not in node.text or is_missing(node) else self._scalar(node, path)
        if isinstance(node, ListNode):
            return replace(node, items=tuple(self.fill(item, join(path, at)) for at, item in enumerate(node.items)))
        for key, entry in node.entries.items():
            if "${" in key:
                message = f"'{key}' asks for an argument that is not there"
                self._problems.append(Problem("reference", join(path, key), message, None, None, entry.mark))
        entries = {
            key: Entry(self.fill(entry.node, join(path, key)), entry.mark) for key, entry in node.entries.items()
        }
        return MapNode(entries, node.mark, node.origins)

    def _scalar(self, node: ScalarNode, path: str) -> Node:
        names = REFERENCE.findall(node.text)
        unknown = [name for name in names if name not in self._parameters.entries]
        for name in unknown:
            hint = did_you_mean(name, self._parameters.entries)
            self._problems.append(Problem("unknown-parameter", path, "is no parameter", repr(name), hint, node.mark))
        if unknown or not names:
            return node
        if not REFERENCE.fullmatch(node.text):
            message = "a parameter must be the whole value, not part of a text"
            self._problems.append(Problem("reference", path, message, repr(node.text[:60]), None, node.mark))
            return node
        return self._bound(node, names[0])

    def _bound(self, node: ScalarNode, name: str) -> Node:
        parameter = self._parameters.entries[name].node
        value = parameter.get("value") if isinstance(parameter, MapNode) else None
        if not isinstance(value, ScalarNode) or not _readable(value):
            return node
        origins = (*value.origins, Origin("parameter", value.text, value.mark), *node.origins)
        return replace(node, text=value.text, quoted=value.quoted, parameter=name, origins=origins)


def _readable(value: ScalarNode) -> bool:
    """Tell whether a parameter's value is a finite quantity; where it is not, that is reported once, there."""
    try:
        return math.isfinite(measure(value.text)[0])
    except ValueError:
        return False
