"""Reading SDF: one model, each pose in its default frame (link: model, joint: child link). Visuals are not read."""

from typing import Final
from xml.etree import ElementTree

import numpy as np

from neuromech.errors import did_you_mean
from neuromech.graph.robot_parts import (
    IDENTITY,
    JOINT_KINDS,
    Floats,
    Link,
    Pose,
    Robot,
    RobotJoint,
    by_name,
    number,
    numbers,
    root_link,
    symmetric,
    turned,
)

_UNLIMITED: Final = 1e15  # SDF writes ±1e16 for a joint without limits.
_FOREIGN_FRAMES: Final = ("relative_to", "expressed_in", "frame")


def read_sdf(sdf: ElementTree.Element) -> Robot:
    """Return the parts of the one model of an `<sdf>`.

    Raises:
        ValueError: something is wrong or not supported.
    """
    models = sdf.findall("model") + sdf.findall("world/model")
    if len(models) != 1:
        raise ValueError(f"must have exactly one model (got {len(models)})")
    _refuse_foreign_frames(models[0])
    elements = dict(by_name(models[0].findall("link"), "link"))
    links = {name: _link(name, element) for name, element in elements.items()}
    joint_elements = dict(by_name(models[0].findall("joint"), "joint"))
    joints = {name: _joint(name, element) for name, element in joint_elements.items()}
    root = root_link(links, joints)
    link_pose = {name: _pose(element, f"pose of link '{name}'") for name, element in elements.items()}
    joint_pose = {
        name: _pose(element, f"pose of joint '{name}'").after(link_pose[joints[name].child])
        for name, element in joint_elements.items()
    }
    return Robot(root, links, joints, link_pose, joint_pose)


def _refuse_foreign_frames(model: ElementTree.Element) -> None:
    for element in model.iter():
        for key in _FOREIGN_FRAMES:
            if element.get(key):
                raise ValueError(f"<{element.tag} {key}='{element.get(key)}'> is not supported; use the default frame")
        if element.tag == "use_parent_model_frame" and (element.text or "").strip() not in ("", "0", "false"):
            raise ValueError("<use_parent_model_frame> is not supported; give the axis in the joint's frame")


def _link(name: str, element: ElementTree.Element) -> Link:
    spheres = tuple(_sphere(name, collision) for collision in element.findall("collision"))
    inertial = element.find("inertial")
    if inertial is None:
        return Link(name, 0.0, np.zeros(3), np.zeros((3, 3)), spheres)
    pose = _pose(inertial, f"inertial pose of link '{name}'")
    mass = number(inertial.findtext("mass"), f"mass of link '{name}'")
    moments = [
        number(inertial.findtext(f"inertia/{key}", default), f"{key} of link '{name}'")
        for key, default in (("ixx", ""), ("iyy", ""), ("izz", ""), ("ixy", "0"), ("ixz", "0"), ("iyz", "0"))
    ]
    inertia = pose.rotation @ symmetric(*moments) @ pose.rotation.T
    return Link(name, mass, pose.translation, inertia, spheres)


def _sphere(link: str, collision: ElementTree.Element) -> tuple[Floats, float]:
    if collision.find("geometry/sphere") is None:
        raise ValueError(f"link '{link}' has a collision shape that is no sphere; replace it by spheres or remove it")
    radius = number(collision.findtext("geometry/sphere/radius"), f"radius of a sphere of link '{link}'")
    return _pose(collision, f"collision pose of link '{link}'").translation, radius


def _joint(name: str, element: ElementTree.Element) -> RobotJoint:
    kind = element.get("type", "")
    if kind not in JOINT_KINDS:
        raise ValueError(
            f"joint '{name}' has a type that is not supported (got '{kind}'; {did_you_mean(kind, JOINT_KINDS)})"
        )
    parent = (element.findtext("parent") or "").strip()
    if parent == "world":
        raise ValueError(f"joint '{name}' holds the model to the world; remove it and write 'root: {{kind: fixed}}'")
    if number(element.findtext("axis/dynamics/friction", "0"), f"friction of joint '{name}'") != 0.0:
        raise ValueError(f"joint '{name}' has dry friction, which is not supported")
    return RobotJoint(
        name=name,
        kind=JOINT_KINDS[kind],
        parent=parent,
        child=(element.findtext("child") or "").strip(),
        axis=numbers(element.findtext("axis/xyz", "0 0 1"), 3, f"axis of joint '{name}'"),
        limits=_limits(name, element),
        damping=number(element.findtext("axis/dynamics/damping", "0"), f"damping of joint '{name}'"),
    )


def _limits(name: str, element: ElementTree.Element) -> tuple[float, float] | None:
    lower = number(element.findtext("axis/limit/lower", "-1e16"), f"lower limit of joint '{name}'")
    upper = number(element.findtext("axis/limit/upper", "1e16"), f"upper limit of joint '{name}'")
    if lower < -_UNLIMITED and upper > _UNLIMITED:
        return None
    return lower, upper


def _pose(element: ElementTree.Element, what: str) -> Pose:
    text = element.findtext("pose")
    if text is None:
        return IDENTITY
    x, y, z, roll, pitch, yaw = numbers(text, 6, what).tolist()
    return Pose(turned(roll, pitch, yaw), np.array([x, y, z]))
