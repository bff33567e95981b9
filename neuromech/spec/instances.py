"""Instances: modules with their arguments put in, mirrored or not, and changed by what the instance says itself."""

from collections.abc import Mapping

from neuromech.errors import DocumentError, Problem, did_you_mean
from neuromech.spec.builder import MAXIMAL_DEPTH, MAXIMAL_NODES
from neuromech.spec.merge import merge_maps
from neuromech.spec.mirror import mirrored
from neuromech.spec.modules import Module
from neuromech.spec.node import MISSING, Entry, MapNode, Node, ScalarNode, join, kind_of, short_text, size_within
from neuromech.spec.substitute import fill_arguments

MAXIMAL_INSTANCES = 2_000
MAXIMAL_NESTING = 20
_WORDS = ("use", "mirror", "with")


class Expander:
    """Replaces `use`, `mirror` and `with` by what they stand for; what is wrong is added to `problems`."""

    def __init__(self, modules: Mapping[str, Module], problems: list[Problem]) -> None:
        self.used: set[str] = set()
        self._modules = modules
        self._problems = problems
        self._made = 0
        self._nodes = 0

    def scope(self, node: MapNode, path: str = "", chain: tuple[str, ...] = ()) -> MapNode:
        """Return a scope with its instances expanded; `chain` names the modules around it.

        Raises:
            DocumentError: modules expand to too many instances.
        """
        instances = node.get("instances")
        if not isinstance(instances, MapNode):
            return node
        here = join(path, "instances")
        entries = {
            name: Entry(self._instance(name, entry.node, instances, here, chain), entry.mark)
            for name, entry in instances.entries.items()
        }
        return node.replacing("instances", MapNode(entries, instances.mark, instances.origins))

    def _instance(self, name: str, node: Node, siblings: MapNode, path: str, chain: tuple[str, ...]) -> Node:
        here = join(path, name)
        if not isinstance(node, MapNode):
            return node
        self._made += 1
        if self._made > MAXIMAL_INSTANCES:
            message = f"modules expand to more than {MAXIMAL_INSTANCES} instances"
            raise DocumentError([*self._problems, Problem("too-many-instances", here, message, None, None, node.mark)])
        own = self.scope(node.without(*_WORDS), here, chain)
        if "use" not in node.entries and "mirror" not in node.entries:
            if "with" in node.entries:
                hint = "say which module takes the arguments: use: NAME"
                self._problem("instance", here, "has 'with' and neither 'use' nor 'mirror'", node, "with", hint)
            return own
        base = self._base(name, node, siblings, here, chain)
        return MapNode({}, node.mark) if base is None else merge_maps(base, own, "instance", self._problems, here)

    def _base(self, name: str, node: MapNode, siblings: MapNode, path: str, chain: tuple[str, ...]) -> MapNode | None:
        if "use" in node.entries and "mirror" in node.entries:
            self._problem("instance", path, "has both 'use' and 'mirror'", node, "mirror", "keep one of them")
            return None
        if "use" in node.entries:
            return self._module(node, self._given(node, path), path, chain)
        return self._mirror(name, node, siblings, path, chain)

    def _given(self, node: MapNode, path: str) -> dict[str, Entry]:
        given = node.get("with")
        if given is None:
            return {}
        if not isinstance(given, MapNode):
            self._problem(
                "not-a-map",
                join(path, "with"),
                f"must be a map of arguments (got {kind_of(given)})",
                node,
                "with",
                None,
            )
            return {}
        return dict(given.entries)

    def _word(self, node: MapNode, key: str) -> str:
        value = node.get(key)
        return value.text if isinstance(value, ScalarNode) else short_text(value) if value else ""

    def _module(self, node: MapNode, given: Mapping[str, Entry], path: str, chain: tuple[str, ...]) -> MapNode | None:
        word = self._word(node, "use")
        module = self._modules.get(word)
        use = join(path, "use")
        if module is None:
            hint = did_you_mean(word, self._modules) if self._modules else "declare it under 'modules'"
            self._problem("unknown-module", use, f"there is no module '{word}'", node, "use", hint)
            return None
        self.used.add(word)
        if word in chain:
            way = " > ".join((*chain, word))
            self._problem("module-recursion", use, f"the module contains itself: {way}", node, "use", None)
            return None
        if len(chain) >= MAXIMAL_NESTING:
            self._problem("module-nesting", use, f"modules are nested deeper than {MAXIMAL_NESTING}", node, "use", None)
            return None
        arguments = self._bind(module, given, node, path)
        body = fill_arguments(module.body, arguments, self._problems, path)
        self._spend(body, path, node)
        return self.scope(body, path, (*chain, word)) if isinstance(body, MapNode) else None

    def _spend(self, body: Node, path: str, node: MapNode) -> None:
        size = size_within(body, MAXIMAL_NODES - self._nodes, MAXIMAL_DEPTH)
        if size is None:
            message = f"modules expand to more than {MAXIMAL_NODES} values, or deeper than {MAXIMAL_DEPTH} levels"
            raise DocumentError([*self._problems, Problem("too-many-values", path, message, None, None, node.mark)])
        self._nodes += size

    def _bind(self, module: Module, given: Mapping[str, Entry], node: MapNode, path: str) -> dict[str, Node]:
        for name, entry in given.items():
            if name not in module.arguments:
                place = join(join(path, "with"), name)
                message = f"the module '{module.name}' has no such argument"
                hint = did_you_mean(name, module.arguments)
                self._problems.append(Problem("unknown-argument", place, message, None, hint, entry.mark))
        bound: dict[str, Node] = {}
        missing: list[str] = []
        for name, argument in module.arguments.items():
            if name in given:
                bound[name] = given[name].node
            elif argument.default is not None:
                bound[name] = argument.default
            else:
                missing.append(f"'{name}'")
                bound[name] = MISSING
        if missing:
            key = "use" if "use" in node.entries else "mirror"
            message = f"the module '{module.name}' needs the argument{'s' * (len(missing) > 1)} {', '.join(missing)}"
            self._problem("missing-argument", path, message, node, key, "give it under 'with'")
        return bound

    def _mirror(self, name: str, node: MapNode, siblings: MapNode, path: str, chain: tuple[str, ...]) -> MapNode | None:
        word = self._word(node, "mirror")
        others = [other for other in siblings.entries if other != name]
        place = join(path, "mirror")
        target = siblings.get(word) if word != name else None
        if not isinstance(target, MapNode):
            hint = did_you_mean(word, others)
            self._problem("unknown-instance", place, f"there is no other instance '{word}' here", node, "mirror", hint)
            return None
        if "mirror" in target.entries:
            hint = f"mirror '{self._word(target, 'mirror')}', or use its module without a mirror"
            self._problem("mirror", place, f"'{word}' is a mirror image itself", node, "mirror", hint)
            return None
        own = self.scope(target.without(*_WORDS), path, chain)
        given = self._given(node, path)
        if "use" not in target.entries:
            if given:
                self._problem(
                    "instance", path, f"'{word}' uses no module, so it takes no arguments", node, "with", None
                )
            return self._image(own, path)
        base = self._module(target, {**self._given(target, path), **given}, path, chain)
        return None if base is None else self._image(merge_maps(base, own, "instance", self._problems, path), path)

    def _image(self, node: MapNode, path: str) -> MapNode | None:
        image = mirrored(node, self._problems, path)
        return image if isinstance(image, MapNode) else None

    def _problem(self, code: str, path: str, message: str, node: MapNode, key: str, hint: str | None) -> None:
        value = node.get(key)
        self._problems.append(Problem(code, path, message, None, hint, value.mark if value else node.mark))
