"""Muscle paths → sections of the buffers."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from neuromech.compiler.buffers import Buffer, Reserve
from neuromech.compiler.layout import Layout
from neuromech.compiler.lower_body import moved
from neuromech.compiler.lower_components import follow
from neuromech.compiler.paths import CONSTANT, CONSTANT_ARMS, COSINE, GEOMETRIC, LEVER_ARMS, STRAIGHT_LINES
from neuromech.compiler.tree import Tree
from neuromech.components.paths import ConstantMomentArms, LeverArms, StraightLines
from neuromech.graph.model import Element, ModelGraph
from neuromech.units import Quantity

_KINDS = {ConstantMomentArms: CONSTANT_ARMS, StraightLines: STRAIGHT_LINES, LeverArms: LEVER_ARMS}
_FORMS = {"constant": CONSTANT, "cosine": COSINE, "geometric": GEOMETRIC}
_NUMBERS = {
    "path_arm": "radius",
    "path_reference": "reference_angle",
    "path_peak": "angle_of_maximum",
    "path_zero": "zero_angle",
}
_ZERO = Quantity(0.0)
_ONE = Quantity(1.0)

_Way = ConstantMomentArms | StraightLines | LeverArms


@dataclass(frozen=True)
class _Arm:
    """How a muscle crosses one joint: the form of its lever arm, and (value, document path) of each of its numbers."""

    form: int
    numbers: dict[str, tuple[Quantity, str]]


def paths(
    elements: list[Element],
    tree: Tree,
    graph: ModelGraph,
    layout: Layout,
    integers: Buffer,
    floats: Buffer,
    work: Reserve,
) -> int:
    """Write joints, arms and points of every muscle path; return the largest number of points of one path."""
    crossed = [_crossed(element, tree, graph) for element in elements]
    specs = [_path(element) for element in elements]
    integers.add("path_first", _starts(len(joints) for joints in crossed))
    integers.add("path_joint", [tree.joints.index(joint) for joints in crossed for joint in joints])
    integers.add("path_kind", [_KINDS[type(path)] for path in specs])
    _lengths(elements, specs, layout, floats)
    _arms(elements, specs, crossed, layout, integers, floats)
    points = [path.points if isinstance(path, StraightLines) else () for path in specs]
    integers.add("path_point_first", _starts(len(some) for some in points))
    integers.add("path_segment", [tree.segments.index(point.segment) for some in points for point in some])
    start = floats.add("path_point", [x for some in points for point in some for x in point.position])
    for element, some in zip(elements, points, strict=True):
        for i, point in enumerate(some):
            for k, x in enumerate(point.position):
                follow(layout, x, start, f"{element.path}.path.points.{i}.position.{k}")
                start += 1
    work.add("arms", sum(len(joints) for joints in crossed))
    integers.add("coupled", _first_coupled(tree, crossed))
    return max((len(some) for some in points), default=0)


def _first_coupled(tree: Tree, crossed: list[list[str]]) -> list[int]:
    """Return for each joint the first joint whose acceleration or damping it can feel, itself at the latest.

    These are the joints of its own limb, and those that a muscle joins. A root that moves feels all joints; its rows
    come last, and the joints feel each other through it only there.
    """
    n = len(tree.joints)
    carried = moved(tree)
    coupled = carried @ carried.T > 0
    for joints in crossed:
        places = [tree.joints.index(joint) for joint in joints]
        coupled[np.ix_(places, places)] = True
    return [*(min(j, int(np.argmax(coupled[j]))) for j in range(n)), *(0 for _ in range(tree.root))]


def _path(element: Element) -> _Way:
    path = getattr(element.spec, "path", None)
    if not isinstance(path, _Way):
        raise TypeError(f"muscle '{element.name}' has no path of a kind that can be lowered")
    return path


def _crossed(element: Element, tree: Tree, graph: ModelGraph) -> list[str]:
    joints = {joint for _, joint, c in graph.graph.out_edges(element.name, data="connection") if c.kind == "crossing"}
    return [joint for joint in tree.joints if joint in joints]


def _starts(counts: Iterable[int]) -> list[int]:
    return [0, *np.cumsum([*counts], dtype=int).tolist()]


def _lengths(elements: list[Element], specs: list[_Way], layout: Layout, floats: Buffer) -> None:
    """Write the reference length of each path, and the factor from lever arms to changes of length."""
    for section, field, default in (
        ("path_length", "reference_length", _ZERO),
        ("path_factor", "pennation_factor", _ONE),
    ):
        values = [getattr(path, field, default) for path in specs]
        start = floats.add(section, values)
        for i, (element, value) in enumerate(zip(elements, values, strict=True)):
            follow(layout, value, start + i, f"{element.path}.path.{field}")


def _arms(
    elements: list[Element],
    specs: list[_Way],
    crossed: list[list[str]],
    layout: Layout,
    integers: Buffer,
    floats: Buffer,
) -> None:
    arms = [
        _arm(element, path, joint)
        for element, path, joints in zip(elements, specs, crossed, strict=True)
        for joint in joints
    ]
    integers.add("path_form", [arm.form for arm in arms])
    for section, field in _NUMBERS.items():
        start = floats.add(section, [arm.numbers.get(field, (_ZERO, ""))[0] for arm in arms])
        for i, arm in enumerate(arms):
            if field in arm.numbers:
                value, path = arm.numbers[field]
                follow(layout, value, start + i, path)


def _arm(element: Element, path: _Way, joint: str) -> _Arm:
    here, written = f"{element.path}.path", joint.removeprefix(f"{element.scope}.")
    if isinstance(path, ConstantMomentArms):
        radius = (path.moment_arms.get(joint, _ZERO), f"{here}.moment_arms.{written}")
        reference = (path.reference_angles.get(joint, _ZERO), f"{here}.reference_angles.{written}")
        return _Arm(CONSTANT, {"radius": radius, "reference_angle": reference})
    if isinstance(path, LeverArms):
        arm = path.arms[joint]
        fields = [field for field in _NUMBERS.values() if hasattr(arm, field)]
        return _Arm(
            _FORMS[arm.kind], {field: (getattr(arm, field), f"{here}.arms.{written}.{field}") for field in fields}
        )
    return _Arm(CONSTANT, {})
