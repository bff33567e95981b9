"""URDF text of a body, as PyBullet loads it.

Every contact is a massless link of its own, held to its segment, so that an engine's contact forces tell contacts of
one segment apart. A planar root hangs on the world by massless slides along x and z and a hinge about y.
"""

from collections.abc import Sequence
from math import atan2, dist, hypot
from typing import Final
from xml.etree import ElementTree

from neuromech.compiler.tree import unit_vector
from neuromech.graph.model import BodyModel
from neuromech.spec.model import BoxShape, CapsuleShape, Joint, Segment

# Qualified names of a document hold no colon, so these collide with none.
CONTACT: Final = "contact:"
WORLD: Final = "root:world"
PLANAR_JOINTS: Final = ("root:x", "root:z", "root:pitch")

_KINDS = {"hinge": "revolute", "slide": "prismatic"}
_NO_LIMIT = (1.0, -1.0)  # A lower limit above the upper one is Bullet's word for none.


def urdf_text(body: BodyModel) -> str:
    """Return the URDF of a body. Names of links and joints are the qualified names of segments and joints."""
    robot = ElementTree.Element("robot", name=body.root_segment)
    if body.root.kind == "planar":
        _planar_root(robot, body)
    hit = {pendulum.segment for pendulum in body.world.pendulums.values()}
    for name, segment in body.segments.items():
        _segment(robot, name, segment, name in hit)
    for name, joint in body.joints.items():
        _body_joint(robot, name, joint)
    for name, contact in body.contacts.items():
        link = _massless(robot, CONTACT + name)
        collision = ElementTree.SubElement(link, "collision")
        geometry = ElementTree.SubElement(collision, "geometry")
        ElementTree.SubElement(geometry, "sphere", radius=_text(contact.radius))
        _joint(robot, CONTACT + name, "fixed", contact.segment, CONTACT + name, contact.position)
    ElementTree.indent(robot)
    return ElementTree.tostring(robot, encoding="unicode")


def _planar_root(robot: ElementTree.Element, body: BodyModel) -> None:
    parents = (WORLD, *PLANAR_JOINTS[:2])
    children = (*PLANAR_JOINTS[:2], body.root_segment)
    kinds = ("prismatic", "prismatic", "revolute")
    axes = ((1.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.0, 1.0, 0.0))
    _massless(robot, WORLD)
    for link in children[:2]:
        _massless(robot, link)
    for name, kind, parent, child, axis in zip(PLANAR_JOINTS, kinds, parents, children, axes, strict=True):
        y = body.root.position[1] if parent == WORLD else 0.0
        joint = _joint(robot, name, kind, parent, child, (0.0, float(y), 0.0))
        _motion(joint, axis, _NO_LIMIT)


def _segment(robot: ElementTree.Element, name: str, segment: Segment, collides: bool) -> None:
    link = ElementTree.SubElement(robot, "link", name=name)
    inertial = ElementTree.SubElement(link, "inertial")
    ElementTree.SubElement(inertial, "origin", xyz=_text(*segment.center_of_mass), rpy="0 0 0")
    ElementTree.SubElement(inertial, "mass", value=_text(segment.mass))
    xx, yy, zz = (_text(moment) for moment in segment.inertia)
    ElementTree.SubElement(inertial, "inertia", ixx=xx, iyy=yy, izz=zz, ixy="0", ixz="0", iyz="0")
    if segment.shape is not None:
        for role in ("visual", "collision") if collides else ("visual",):
            _shape(ElementTree.SubElement(link, role), segment.shape)


def _shape(role: ElementTree.Element, shape: BoxShape | CapsuleShape) -> None:
    geometry = ElementTree.SubElement(role, "geometry")
    if isinstance(shape, BoxShape):
        ElementTree.SubElement(role, "origin", xyz=_text(*shape.position), rpy="0 0 0")
        ElementTree.SubElement(geometry, "box", size=_text(*shape.size))
        return
    middle = [(start + end) / 2 for start, end in zip(shape.start, shape.end, strict=True)]
    x, y, z = (end - start for start, end in zip(shape.start, shape.end, strict=True))
    ElementTree.SubElement(role, "origin", xyz=_text(*middle), rpy=_text(0.0, atan2(hypot(x, y), z), atan2(y, x)))
    ElementTree.SubElement(geometry, "capsule", radius=_text(shape.radius), length=_text(dist(shape.start, shape.end)))


def _body_joint(robot: ElementTree.Element, name: str, joint: Joint) -> None:
    element = _joint(robot, name, _KINDS[joint.kind], joint.parent, joint.child, joint.position)
    _motion(element, unit_vector(joint.axis, name).tolist(), joint.range or _NO_LIMIT)


def _joint(
    robot: ElementTree.Element, name: str, kind: str, parent: str, child: str, position: tuple[float, float, float]
) -> ElementTree.Element:
    joint = ElementTree.SubElement(robot, "joint", name=name, type=kind)
    ElementTree.SubElement(joint, "parent", link=parent)
    ElementTree.SubElement(joint, "child", link=child)
    ElementTree.SubElement(joint, "origin", xyz=_text(*position), rpy="0 0 0")
    return joint


def _motion(joint: ElementTree.Element, axis: Sequence[float], limit: tuple[float, float]) -> None:
    ElementTree.SubElement(joint, "axis", xyz=_text(*axis))
    lower, upper = limit
    ElementTree.SubElement(joint, "limit", lower=_text(lower), upper=_text(upper), effort="0", velocity="0")


def _massless(robot: ElementTree.Element, name: str) -> ElementTree.Element:
    link = ElementTree.SubElement(robot, "link", name=name)
    inertial = ElementTree.SubElement(link, "inertial")
    ElementTree.SubElement(inertial, "mass", value="0")
    ElementTree.SubElement(inertial, "inertia", ixx="0", iyy="0", izz="0", ixy="0", ixz="0", iyz="0")
    return link


def _text(*numbers: float) -> str:
    return " ".join(repr(float(number)) for number in numbers)
