"""Elements with every reference in them replaced by the qualified name that it means."""

from collections.abc import Iterable
from dataclasses import replace
from typing import TypeVar

from neuromech.components.base import Component
from neuromech.components.paths import ConstantMomentArms, LeverArms, PathPoint, StraightLines
from neuromech.graph.model import Element, Spec
from neuromech.graph.names import Resolver, wanted
from neuromech.spec.model import Contact, Joint
from neuromech.spec.pendulum import Pendulum
from neuromech.spec.pushes import Push, PushSeries

_JOINT = wanted("joint")
_SEGMENT = wanted("segment")
_Value = TypeVar("_Value")


def resolved(elements: Iterable[Element], resolver: Resolver) -> list[Element]:
    """Return the elements with qualified references; names that mean nothing stay, and the resolver notes them."""
    return [replace(element, spec=_resolved_spec(element, resolver)) for element in elements]


def _resolved_spec(element: Element, resolver: Resolver) -> Spec:
    spec = element.spec
    if isinstance(spec, Joint):
        names = {field: _segment(getattr(spec, field), field, element, resolver) for field in ("parent", "child")}
        return spec.model_copy(update=names)
    if isinstance(spec, Contact | Push | PushSeries | Pendulum):
        return spec.model_copy(update={"segment": _segment(spec.segment, "segment", element, resolver)})
    if isinstance(spec, Component):
        return spec.model_copy(update=_component_fields(spec, element, resolver))
    return spec


def _segment(name: str, field: str, element: Element, resolver: Resolver) -> str:
    return resolver.qualify(name, element.scope, f"{element.path}.{field}", _SEGMENT)


def _component_fields(spec: Component, element: Element, resolver: Resolver) -> dict[str, object]:
    fields: dict[str, object] = {}
    for name, reference in spec.references().items():
        value = getattr(spec, name)
        if value is not None:
            path = f"{element.path}.{name}"
            fields[name] = resolver.qualify(value, element.scope, path, wanted(reference.to))
    way = getattr(spec, "path", None)
    if isinstance(way, ConstantMomentArms):
        maps = {
            field: _joints(getattr(way, field), field, element, resolver)
            for field in ("reference_angles", "moment_arms")
        }
        fields["path"] = way.model_copy(update=maps)
    elif isinstance(way, LeverArms):
        fields["path"] = way.model_copy(update={"arms": _joints(way.arms, "arms", element, resolver)})
    elif isinstance(way, StraightLines):
        points = tuple(_point(point, index, element, resolver) for index, point in enumerate(way.points))
        fields["path"] = way.model_copy(update={"points": points})
    return fields


def _joints(values: dict[str, _Value], field: str, element: Element, resolver: Resolver) -> dict[str, _Value]:
    found: dict[str, _Value] = {}
    for joint, value in values.items():
        path = f"{element.path}.path.{field}.{joint}"
        name = resolver.qualify(joint, element.scope, path, _JOINT)
        if name in found:
            resolver.problems.append(
                resolver.document.problem("two-definitions", path, f"gives a second value for joint '{name}'")
            )
        found[name] = value
    return found


def _point(point: PathPoint, index: int, element: Element, resolver: Resolver) -> PathPoint:
    segment = _segment(point.segment, f"path.points.{index}.segment", element, resolver)
    return point.model_copy(update={"segment": segment})
