"""Body, muscle paths and their signals → sections of the buffers, and the tree for the kinematics."""

from collections.abc import Iterable

import numpy as np

from neuromech.compiler.buffers import Buffer, Reserve
from neuromech.compiler.layout import Layout
from neuromech.compiler.lower_components import follow
from neuromech.compiler.numerics import Integers
from neuromech.compiler.tree import FIXED_ROOT, SLIDE, Tree
from neuromech.components.muscles import ConstantMomentArms, StraightLines
from neuromech.graph.model import BodyModel, Element, ModelGraph
from neuromech.units import Quantity

SEGMENT_SIGNALS = ("x", "y", "z", "roll", "pitch", "yaw", "velocity_x", "velocity_y", "velocity_z")
_ROOT_STATE = 13


def body_signals(tree: Tree, layout: Layout, integers: Buffer, tracked: Iterable[str]) -> None:
    """Place the state that an engine fills, the torques, contact centres and the segments that are looked at."""
    start = layout.signal_count
    n, m = len(tree.joints), len(tree.contacts)
    header = integers.header
    header.update(joints=n, contacts=m, segments=len(tree.segments), body=start, root=tree.root)
    for i, joint in enumerate(tree.joints):
        layout.signals[f"{joint}.angle"] = start + i
        layout.signals[f"{joint}.velocity"] = start + n + i
    contact = start + 2 * n + _ROOT_STATE
    header["torque"] = torque = contact + 3 * m
    header["point"] = point = torque + n
    for i, joint in enumerate(tree.joints):
        layout.signals[f"{joint}.torque"] = torque + i
    for i, name in enumerate(tree.contacts):
        for k, axis in enumerate("xyz"):
            layout.signals[f"{name}.force_{axis}"] = contact + 3 * i + k
            layout.signals[f"{name}.{axis}"] = point + 3 * i + k
    header["segment_signal"] = first = point + 3 * m
    looked_at = set(tracked)
    names = [name for name in tree.segments if name in looked_at]
    integers.add("track", [tree.segments.index(name) for name in names])
    header["tracked"] = len(names)
    for i, name in enumerate(names):
        for k, quantity in enumerate(SEGMENT_SIGNALS):
            layout.signals[f"{name}.{quantity}"] = first + len(SEGMENT_SIGNALS) * i + k
    layout.signal_count = first + len(SEGMENT_SIGNALS) * len(names)


def muscles(graph: ModelGraph) -> list[Element]:
    """Return the muscles in the order that all muscle arrays have: by name."""
    return sorted(graph.elements("muscle"), key=lambda element: element.name)


def muscle_signals(elements: list[Element], layout: Layout, header: dict[str, int]) -> None:
    """Place lengths and velocities of all muscles."""
    header["muscles"] = len(elements)
    header["length_signal"] = layout.signal_count
    header["velocity_signal"] = layout.signal_count + len(elements)
    for i, element in enumerate(elements):
        layout.signals[f"{element.name}.length"] = layout.signal_count + i
        layout.signals[f"{element.name}.velocity"] = layout.signal_count + len(elements) + i
    layout.signal_count += 2 * len(elements)


def force_slots(elements: list[Element], layout: Layout, integers: Buffer) -> None:
    """Note where force, stiffness and damping of each muscle are found."""
    for output in ("force", "stiffness", "damping"):
        integers.add(f"{output}_slot", [layout.signals[f"{element.name}.{output}"] for element in elements])


def joint_parameters(graph: ModelGraph, body: BodyModel, layout: Layout, floats: Buffer) -> None:
    """Write damping, stiffness and rest angle of every joint."""
    for section, field in (("damping", "damping"), ("joint_stiffness", "stiffness"), ("rest_angle", "rest_angle")):
        start = floats.add(section, [getattr(joint, field) for joint in body.joints.values()])
        for i, (name, joint) in enumerate(body.joints.items()):
            follow(layout, getattr(joint, field), start + i, f"{graph.element(name).path}.{field}")


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
    integers.add("path_kind", [int(isinstance(path, StraightLines)) for path in specs])
    _constant_paths(elements, specs, crossed, layout, floats)
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

    Under a fixed root these are the joints of its own limb; a root that moves, and a muscle, couple what they join.
    """
    n = len(tree.joints)
    moved = _moved(tree)
    coupled = (moved @ moved.T > 0) if tree.root == FIXED_ROOT else np.ones((n, n), dtype=bool)
    for joints in crossed:
        places = [tree.joints.index(joint) for joint in joints]
        coupled[np.ix_(places, places)] = True
    return [min(j, int(np.argmax(coupled[j]))) for j in range(n)]


def _path(element: Element) -> ConstantMomentArms | StraightLines:
    path = getattr(element.spec, "path", None)
    if not isinstance(path, ConstantMomentArms | StraightLines):
        raise TypeError(f"muscle '{element.name}' has no path of a kind that can be lowered")
    return path


def _crossed(element: Element, tree: Tree, graph: ModelGraph) -> list[str]:
    joints = {joint for _, joint, c in graph.graph.out_edges(element.name, data="connection") if c.kind == "crossing"}
    return [joint for joint in tree.joints if joint in joints]


def _starts(counts: Iterable[int]) -> list[int]:
    return [0, *np.cumsum([*counts], dtype=int).tolist()]


def _constant_paths(
    elements: list[Element],
    specs: list[ConstantMomentArms | StraightLines],
    crossed: list[list[str]],
    layout: Layout,
    floats: Buffer,
) -> None:
    zero = Quantity(0.0)
    lengths = [path.reference_length if isinstance(path, ConstantMomentArms) else zero for path in specs]
    start = floats.add("path_length", lengths)
    for i, (element, value) in enumerate(zip(elements, lengths, strict=True)):
        follow(layout, value, start + i, f"{element.path}.path.reference_length")
    for section, field in (("path_arm", "moment_arms"), ("path_reference", "reference_angles")):
        values = [
            (element, joint, getattr(path, field, {}).get(joint, zero))
            for element, path, joints in zip(elements, specs, crossed, strict=True)
            for joint in joints
        ]
        start = floats.add(section, [value for _, _, value in values])
        for i, (element, joint, value) in enumerate(values):
            written = joint.removeprefix(f"{element.scope}.")
            follow(layout, value, start + i, f"{element.path}.path.{field}.{written}")


def structure(tree: Tree, integers: Buffer) -> None:
    """Write which joint moves which segment, the child of each joint, and which joints slide."""
    n = len(tree.joints)
    child, slide = np.zeros(n, dtype=int), np.zeros(n, dtype=int)
    for row in range(1, len(tree.segments)):
        child[tree.joint[row]] = row
        slide[tree.joint[row]] = int(tree.kind[row] == SLIDE)
    integers.add("moved", _moved(tree).ravel().tolist())
    integers.add("child", child.tolist())
    integers.add("slide", slide.tolist())


def _moved(tree: Tree) -> Integers:
    """Return (joints, segments): 1 where a joint moves a segment."""
    moved = np.zeros((len(tree.joints), len(tree.segments)), dtype=np.int64)
    for row in range(1, len(tree.segments)):
        moved[:, row] = moved[:, tree.parent[row]]
        moved[tree.joint[row], row] = 1
    return moved
