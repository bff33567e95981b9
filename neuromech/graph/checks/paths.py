"""Rules about the ways of muscles over joints."""

from collections.abc import Iterator
from itertools import pairwise, product

from neuromech.components.base import Path
from neuromech.components.paths import ConstantMomentArms, LeverArms, StraightLines
from neuromech.errors import Problem
from neuromech.graph.model import BodyModel, Element, ModelGraph
from neuromech.graph.names import enclosing
from neuromech.graph.tree import chain


def arms_and_angles_differ(graph: ModelGraph) -> Iterator[Problem]:
    """Each joint with a moment arm has a reference angle, and the other way round."""
    for element, way in _paths(graph):
        if not isinstance(way, ConstantMomentArms):
            continue
        for joint in sorted(way.moment_arms.keys() ^ way.reference_angles.keys()):
            has, lacks = "moment_arms", "reference_angles"
            if joint in way.reference_angles:
                has, lacks = lacks, has
            path = _as_written(graph, element, has, joint)
            hint = f"{has} and {lacks} name the same joints"
            yield graph.document.problem("path-joints", path, f"names a joint that {lacks} lacks", f"'{joint}'", hint)


def joints_off_one_chain(graph: ModelGraph) -> Iterator[Problem]:
    """A muscle's path runs from one segment to another and so crosses joints of one chain only."""
    for element, way in _paths(graph):
        if isinstance(way, ConstantMomentArms | LeverArms) and graph.body is not None:
            field = "arms" if isinstance(way, LeverArms) else "moment_arms"
            joints = list(getattr(way, field))
            if not _on_one_chain(graph.body, joints):
                path = f"{element.path}.path.{field}"
                message = "crosses joints that no path from one segment to another can cross"
                hint = "joints of one muscle lie on one chain of segments"
                yield graph.document.problem("path-joints", path, message, ", ".join(joints), hint)


def path_crosses_no_joint(graph: ModelGraph) -> Iterator[Problem]:
    """Straight lines join at least two segments."""
    for element, way in _paths(graph):
        if isinstance(way, StraightLines) and len({point.segment for point in way.points}) == 1:
            got = f"all {len(way.points)} points on '{way.points[0].segment}'"
            hint = "put origin and insertion on different segments"
            yield graph.document.problem("path-joints", f"{element.path}.path.points", "crosses no joint", got, hint)


def path_turns_back(graph: ModelGraph) -> Iterator[Problem]:
    """Straight lines cross each joint once: they follow the chain of segments and don't return."""
    for element, way in _paths(graph):
        if not isinstance(way, StraightLines) or graph.body is None:
            continue
        crossed = set[str]()
        for index, (start, end) in enumerate(pairwise(way.points), start=1):
            joints = chain(graph.body, start.segment, end.segment)
            again = [joint for joint in joints if joint in crossed]
            if again:
                path = f"{element.path}.path.points.{index}.segment"
                message = f"leads the path over joint '{again[0]}' a second time"
                hint = "list the points from origin to insertion along the chain of segments"
                yield graph.document.problem("path-joints", path, message, f"'{end.segment}'", hint)
            crossed.update(joints)


def _as_written(graph: ModelGraph, element: Element, field: str, joint: str) -> str:
    """Return the document path of a joint's entry, whose key the author may have written as seen from any scope."""
    path = f"{element.path}.path.{field}"
    keys = [joint.removeprefix(f"{scope}.") for scope in enclosing(element.scope)]
    return next((f"{path}.{key}" for key in keys if f"{path}.{key}" in graph.document.marks), path)


def _paths(graph: ModelGraph) -> Iterator[tuple[Element, Path]]:
    for element in graph.elements("muscle"):
        way = getattr(element.spec, "path", None)
        if isinstance(way, Path):
            yield element, way


def _on_one_chain(body: BodyModel, joints: list[str]) -> bool:
    ends = [(body.joints[joint].parent, body.joints[joint].child) for joint in joints]
    wanted = set(joints)
    return any(
        wanted <= set(chain(body, start, end))
        for first, last in product(ends, repeat=2)
        for start, end in product(first, last)
    )
