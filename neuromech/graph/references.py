"""Elements with every reference in them replaced by the qualified name that it means."""

from collections.abc import Iterable
from dataclasses import replace

from neuromech.components.base import Component
from neuromech.components.muscles import ConstantMomentArms, PathPoint, StraightLines
from neuromech.graph.model import Element
from neuromech.graph.names import Resolver, wanted
from neuromech.spec.model import Contact, Joint, Segment

_JOINT = wanted("joint")
_SEGMENT = wanted("segment")


def resolved(elements: Iterable[Element], resolver: Resolver) -> list[Element]:
    """Return the elements with qualified references; names that mean nothing stay, and the resolver notes them."""
    return [replace(element, spec=_resolved_spec(element, resolver)) for element in elements]


def _resolved_spec(element: Element, resolver: Resolver) -> Component | Segment | Joint | Contact:
    spec = element.spec
    if isinstance(spec, Joint):
        fields = {
            name: _segment(getattr(spec, name), f"{element.path}.{name}", element, resolver)
            for name in ("parent", "child")
        }
        return spec.model_copy(update=fields)
    if isinstance(spec, Contact):
        segment = _segment(spec.segment, f"{element.path}.segment", element, resolver)
        return spec.model_copy(update={"segment": segment})
    if isinstance(spec, Component):
        return spec.model_copy(update=_component_fields(spec, element, resolver))
    return spec


def _segment(name: str, path: str, element: Element, resolver: Resolver) -> str:
    return resolver.resolve(name, element.scope, path, _SEGMENT) or name


def _component_fields(spec: Component, element: Element, resolver: Resolver) -> dict[str, object]:
    fields: dict[str, object] = {}
    for name, reference in spec.references().items():
        value = getattr(spec, name)
        if value is not None:
            found = resolver.resolve(value, element.scope, f"{element.path}.{name}", wanted(reference.to))
            fields[name] = found or value
    way = getattr(spec, "path", None)
    if isinstance(way, ConstantMomentArms):
        fields["path"] = _resolved_arms(way, element, resolver)
    elif isinstance(way, StraightLines):
        fields["path"] = _resolved_points(way, element, resolver)
    return fields


def _resolved_arms(way: ConstantMomentArms, element: Element, resolver: Resolver) -> ConstantMomentArms:
    fields = {}
    for field in ("reference_angles", "moment_arms"):
        path = f"{element.path}.path.{field}"
        fields[field] = {
            resolver.resolve(joint, element.scope, f"{path}.{joint}", _JOINT) or joint: value
            for joint, value in getattr(way, field).items()
        }
    return way.model_copy(update=fields)


def _resolved_points(way: StraightLines, element: Element, resolver: Resolver) -> StraightLines:
    points = tuple(
        _resolved_point(point, f"{element.path}.path.points.{index}", element, resolver)
        for index, point in enumerate(way.points)
    )
    return way.model_copy(update={"points": points})


def _resolved_point(point: PathPoint, path: str, element: Element, resolver: Resolver) -> PathPoint:
    segment = _segment(point.segment, f"{path}.segment", element, resolver)
    return point.model_copy(update={"segment": segment})
