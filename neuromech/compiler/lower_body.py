"""Body and its signals → sections of the buffers, and the tree for the kinematics."""

from collections.abc import Iterable, Sequence
from math import inf

import numpy as np

from neuromech.compiler.buffers import Buffer
from neuromech.compiler.layout import Layout
from neuromech.compiler.lower_components import follow
from neuromech.compiler.numerics import Integers
from neuromech.compiler.tree import SLIDE, Tree
from neuromech.components.base import Muscle
from neuromech.graph.model import BodyModel, Element, ModelGraph

SEGMENT_SIGNALS = (
    *("x", "y", "z", "roll", "pitch", "yaw", "velocity_x", "velocity_y", "velocity_z"),
    *("angular_velocity_x", "angular_velocity_y", "angular_velocity_z"),
)
WEIGHT_SIGNALS = ("x", "y", "z", "velocity_x", "velocity_y", "velocity_z", "force_x", "force_y", "force_z")
_ROOT_STATE = 13


def body_signals(
    tree: Tree, layout: Layout, integers: Buffer, tracked: Iterable[str], pendulums: Sequence[str]
) -> None:
    """Place the state that an engine fills, the torques, contact centres and the segments that are looked at."""
    start = layout.signal_count
    n, m = len(tree.joints), len(tree.contacts)
    header = integers.header
    header.update(joints=n, contacts=m, segments=len(tree.segments), body=start, root=tree.root)
    for i, joint in enumerate(tree.joints):
        layout.signals[f"{joint}.angle"] = start + i
        layout.signals[f"{joint}.velocity"] = start + n + i
    contact = start + 2 * n + _ROOT_STATE
    weight = contact + 3 * m
    for i, name in enumerate(pendulums):
        for k, quantity in enumerate(WEIGHT_SIGNALS):
            layout.signals[f"{name}.{quantity}"] = weight + len(WEIGHT_SIGNALS) * i + k
    header["torque"] = torque = weight + len(WEIGHT_SIGNALS) * len(pendulums)
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


def push_signals(graph: ModelGraph, layout: Layout) -> None:
    """Place the forces of all pushes."""
    for element in graph.elements("push"):
        for axis in "xyz":
            layout.signals[f"{element.name}.force_{axis}"] = layout.signal_count
            layout.signal_count += 1


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
    forces = [
        f"{element.name}.{element.spec.applied_force}" for element in elements if isinstance(element.spec, Muscle)
    ]
    integers.add("force_slot", [layout.signals[name] for name in forces])
    for output in ("stiffness", "damping"):
        integers.add(f"{output}_slot", [layout.signals[f"{element.name}.{output}"] for element in elements])


def joint_parameters(graph: ModelGraph, body: BodyModel, layout: Layout, floats: Buffer) -> None:
    """Write damping, stiffness and rest angle of every joint."""
    for section, field in (("damping", "damping"), ("joint_stiffness", "stiffness"), ("rest_angle", "rest_angle")):
        start = floats.add(section, [getattr(joint, field) for joint in body.joints.values()])
        for i, (name, joint) in enumerate(body.joints.items()):
            follow(layout, getattr(joint, field), start + i, f"{graph.element(name).path}.{field}")
    _soft_limits(graph, body, layout, floats)


def _soft_limits(graph: ModelGraph, body: BodyModel, layout: Layout, floats: Buffer) -> None:
    """Write range, stiffness and reference velocity of every joint's soft limit; without one, never reached."""
    limits = [joint.soft_limit for joint in body.joints.values()]
    never = (-inf, inf, 0.0, 1.0)
    rows = [(*one.range, one.stiffness, one.reference_velocity) if one else never for one in limits]
    fields = ("range.0", "range.1", "stiffness", "reference_velocity")
    for k, section in enumerate(("soft_lower", "soft_upper", "soft_stiffness", "soft_velocity")):
        start = floats.add(section, [row[k] for row in rows])
        for i, name in enumerate(body.joints):
            follow(layout, rows[i][k], start + i, f"{graph.element(name).path}.soft_limit.{fields[k]}")


def structure(tree: Tree, integers: Buffer) -> None:
    """Write which joint moves which segment, the child of each joint, and which joints slide."""
    n = len(tree.joints)
    child, slide = np.zeros(n, dtype=int), np.zeros(n, dtype=int)
    for row in range(1, len(tree.segments)):
        child[tree.joint[row]] = row
        slide[tree.joint[row]] = int(tree.kind[row] == SLIDE)
    integers.add("moved", moved(tree).ravel().tolist())
    integers.add("child", child.tolist())
    integers.add("slide", slide.tolist())


def moved(tree: Tree) -> Integers:
    """Return (joints, segments): 1 where a joint moves a segment."""
    found = np.zeros((len(tree.joints), len(tree.segments)), dtype=np.int64)
    for row in range(1, len(tree.segments)):
        found[:, row] = found[:, tree.parent[row]]
        found[tree.joint[row], row] = 1
    return found
