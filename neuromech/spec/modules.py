"""Modules: what `modules` declares, read and checked before anything is made of it."""

from collections.abc import Mapping
from dataclasses import dataclass

from neuromech.errors import Mark, Problem, did_you_mean
from neuromech.spec.model import Instance
from neuromech.spec.node import MapNode, Node, is_empty, is_null, join, kind_of
from neuromech.spec.substitute import references

SECTIONS = tuple(Instance.model_fields)
_ARGUMENT_KEYS = ("default", "description")


@dataclass(frozen=True)
class Argument:
    """An argument of a module; without a default it must be given."""

    default: Node | None
    mark: Mark | None


@dataclass(frozen=True)
class Module:
    """A template: a scope with `${argument}` in it."""

    name: str
    arguments: Mapping[str, Argument]
    body: MapNode
    mark: Mark | None


def read_modules(node: Node | None, problems: list[Problem]) -> dict[str, Module]:
    """Return the modules of a document by name; what is wrong with them is added to `problems`."""
    if node is None or is_empty(node):
        return {}
    if not isinstance(node, MapNode):
        problems.append(Problem("not-a-map", "modules", "must be a map", kind_of(node), None, node.mark))
        return {}
    found: dict[str, Module] = {}
    for name, entry in node.entries.items():
        path = join("modules", name)
        if isinstance(entry.node, MapNode):
            found[name] = _module(name, entry.node, entry.mark, path, problems)
        else:
            problems.append(Problem("not-a-map", path, "must be a map", kind_of(entry.node), None, entry.node.mark))
    return found


def _module(name: str, node: MapNode, mark: Mark | None, path: str, problems: list[Problem]) -> Module:
    body = node.without("arguments")
    for key, entry in body.entries.items():
        if key not in SECTIONS:
            hint = did_you_mean(key, ("arguments", *SECTIONS))
            problems.append(Problem("unknown-key", join(path, key), "is not known here", None, hint, entry.mark))
    arguments = _arguments(node.get("arguments"), join(path, "arguments"), problems)
    used = set(references(body))
    for argument, declared in arguments.items():
        if argument not in used:
            message = f"nothing in the module '{name}' uses this argument"
            hint = f"write ${{{argument}}} where it belongs, or remove it"
            place = join(join(path, "arguments"), argument)
            problems.append(Problem("unused-argument", place, message, None, hint, declared.mark))
    sections = {key: entry for key, entry in body.entries.items() if key in SECTIONS}
    return Module(name, arguments, MapNode(sections, node.mark), mark)


def _arguments(node: Node | None, path: str, problems: list[Problem]) -> dict[str, Argument]:
    if node is None or is_empty(node):
        return {}
    if not isinstance(node, MapNode):
        problems.append(Problem("not-a-map", path, "must be a map", kind_of(node), None, node.mark))
        return {}
    return {
        name: Argument(_default(entry.node, join(path, name), problems), entry.mark)
        for name, entry in node.entries.items()
    }


def _default(node: Node, path: str, problems: list[Problem]) -> Node | None:
    if is_empty(node) or is_null(node):
        return None
    if not isinstance(node, MapNode):
        hint = "write {default: …}, or nothing where the argument is required"
        problems.append(Problem("not-a-map", path, "must be a map", kind_of(node), hint, node.mark))
        return node
    for key, entry in node.entries.items():
        if key not in _ARGUMENT_KEYS:
            hint = did_you_mean(key, _ARGUMENT_KEYS)
            problems.append(Problem("unknown-key", join(path, key), "is not known here", None, hint, entry.mark))
    return node.get("default")
