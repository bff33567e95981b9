"""Reading URDF. Visuals, meshes and limits of effort and velocity are not read: they do not move a body."""

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


def read_urdf(robot: ElementTree.Element) -> Robot:
    """Return the parts of a `<robot>`.

    Raises:
        ValueError: something is wrong or not supported.
    """
    links = {name: _link(name, element) for name, element in by_name(robot.findall("link"), "link")}
    elements = dict(by_name(robot.findall("joint"), "joint"))
    joints = {name: _joint(name, element) for name, element in elements.items()}
    root = root_link(links, joints)
    origins = {name: _origin(element, f"origin of joint '{name}'") for name, element in elements.items()}
    link_pose = {root: IDENTITY}
    waiting = list(joints.values())
    while waiting:
        ready = [joint for joint in waiting if joint.parent in link_pose]
        for joint in ready:
            link_pose[joint.child] = origins[joint.name].after(link_pose[joint.parent])
        waiting = [joint for joint in waiting if joint.child not in link_pose]
    joint_pose = {joint.name: link_pose[joint.child] for joint in joints.values()}
    return Robot(root, links, joints, link_pose, joint_pose)


def _link(name: str, element: ElementTree.Element) -> Link:
    spheres = tuple(_sphere(name, collision) for collision in element.findall("collision"))
    inertial = element.find("inertial")
    if inertial is None:
        return Link(name, 0.0, np.zeros(3), np.zeros((3, 3)), spheres)
    pose = _origin(inertial, f"inertial origin of link '{name}'")
    mass = number(_attribute(inertial, "mass", "value"), f"mass of link '{name}'")
    moments = [
        number(_attribute(inertial, "inertia", key), f"{key} of link '{name}'")
        for key in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
    ]
    inertia = pose.rotation @ symmetric(*moments) @ pose.rotation.T
    return Link(name, mass, pose.translation, inertia, spheres)


def _sphere(link: str, collision: ElementTree.Element) -> tuple[Floats, float]:
    sphere = collision.find("geometry/sphere")
    if sphere is None:
        raise ValueError(f"link '{link}' has a collision shape that is no sphere; replace it by spheres or remove it")
    radius = number(sphere.get("radius"), f"radius of a sphere of link '{link}'")
    return _origin(collision, f"collision origin of link '{link}'").translation, radius


def _joint(name: str, element: ElementTree.Element) -> RobotJoint:
    kind = element.get("type", "")
    if kind not in JOINT_KINDS:
        raise ValueError(
            f"joint '{name}' has a type that is not supported (got '{kind}'; {did_you_mean(kind, JOINT_KINDS)})"
        )
    if element.find("mimic") is not None:
        raise ValueError(f"joint '{name}' mimics another joint, which is not supported")
    if number(_attribute(element, "dynamics", "friction", "0"), f"friction of joint '{name}'") != 0.0:
        raise ValueError(f"joint '{name}' has dry friction, which is not supported")
    return RobotJoint(
        name=name,
        kind=JOINT_KINDS[kind],
        parent=_attribute(element, "parent", "link") or "",
        child=_attribute(element, "child", "link") or "",
        axis=numbers(_attribute(element, "axis", "xyz", "1 0 0"), 3, f"axis of joint '{name}'"),
        limits=_limits(name, element) if kind in ("revolute", "prismatic") else None,
        damping=number(_attribute(element, "dynamics", "damping", "0"), f"damping of joint '{name}'"),
    )


def _limits(name: str, element: ElementTree.Element) -> tuple[float, float]:
    lower = number(_attribute(element, "limit", "lower", "0"), f"lower limit of joint '{name}'")
    upper = number(_attribute(element, "limit", "upper", "0"), f"upper limit of joint '{name}'")
    return lower, upper


def _origin(element: ElementTree.Element, what: str) -> Pose:
    xyz = numbers(_attribute(element, "origin", "xyz", "0 0 0"), 3, f"xyz of the {what}")
    roll, pitch, yaw = numbers(_attribute(element, "origin", "rpy", "0 0 0"), 3, f"rpy of the {what}").tolist()
    return Pose(turned(roll, pitch, yaw), xyz)


def _attribute(element: ElementTree.Element, tag: str, key: str, default: str | None = None) -> str | None:
    child = element.find(tag)
    return default if child is None else child.get(key, default)
