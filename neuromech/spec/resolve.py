"""A file to one resolved tree: composed, overridden, instances expanded, parameters put in."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from neuromech.components.catalogue import Catalogue
from neuromech.errors import Problem, did_you_mean
from neuromech.spec.curves import fill_curves
from neuromech.spec.includes import Composed
from neuromech.spec.instances import Expander
from neuromech.spec.model import Instance
from neuromech.spec.modules import Module, read_modules
from neuromech.spec.node import MapNode, ScalarNode, join, kind_of
from neuromech.spec.overrides import override
from neuromech.spec.shape import model_of, typed
from neuromech.spec.substitute import fill_parameters, references


@dataclass(frozen=True)
class Resolved:
    """What a document says after composition, before it is typed.

    Args:
        tree: only keys of an `Experiment` and what the author misspelt.
        files: every file that took part.
        asked: every name that stood in `${…}`.
        through: names that only a path of `--set` went through.
        problems: what was wrong so far.
    """

    tree: MapNode
    files: tuple[Path, ...]
    asked: frozenset[str]
    through: frozenset[str]
    problems: tuple[Problem, ...]


def resolve(composed: Composed, overrides: Sequence[str], catalogue: Catalogue) -> Resolved:
    """Return the resolved tree of a document.

    Raises:
        DocumentError: an override leads nowhere; nothing more can be said then.
    """
    overridden = override(composed.tree, overrides)
    problems: list[Problem] = []
    _check_schema_key(overridden.tree, problems)
    modules = read_modules(overridden.tree.get("modules"), problems)
    expander = Expander(modules, problems)
    expanded = expander.scope(overridden.tree.without("$schema", "modules"))
    for name in sorted(modules.keys() - expander.used):
        problems.extend(_unknown_keys(modules[name], catalogue))
    asked = frozenset((*references(expanded), *_asked_by(modules)))
    filled = fill_curves(fill_parameters(expanded, problems), composed.files[0], problems)
    return Resolved(filled, composed.files, asked, overridden.through, tuple(problems))


def _check_schema_key(tree: MapNode, problems: list[Problem]) -> None:
    schema = tree.get("$schema")
    if schema is not None and not isinstance(schema, ScalarNode):
        problems.append(Problem("wrong-type", "$schema", "must be text", kind_of(schema), None, schema.mark))


def _asked_by(modules: Mapping[str, Module]) -> set[str]:
    return {name for module in modules.values() for name in references(module.body) if name not in module.arguments}


def _unknown_keys(module: Module, catalogue: Catalogue) -> list[Problem]:
    found: list[Problem] = []
    for path, node, annotation in typed(module.body, Instance, catalogue, join("modules", module.name)):
        model = model_of(annotation, node, catalogue)
        if not isinstance(node, MapNode) or model is None:
            continue
        allowed = {*model.model_fields, *(("use", "mirror", "with") if model is Instance else ())}
        for key, entry in node.entries.items():
            if key not in allowed:
                hint = did_you_mean(key, allowed)
                found.append(Problem("unknown-key", join(path, key), "is not known here", None, hint, entry.mark))
    return found
