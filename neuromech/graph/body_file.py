"""Segments, joints and contacts of a body from a URDF or SDF file.

Links that fixed joints hold together become one segment with the name of the link nearest to the root. All segment
frames take the axes of the root link at angle zero, and stand at their joints. Collision spheres become contacts.
"""

from pathlib import Path
from re import fullmatch
from typing import Final

import numpy as np

from neuromech.graph.robot_parts import Floats, Link, Pose, Robot, RobotJoint, parse_xml
from neuromech.graph.sdf_file import read_sdf
from neuromech.graph.urdf_file import read_urdf
from neuromech.spec.model import Contact, Joint, Segment
from neuromech.spec.scalars import NAME_PATTERN
from neuromech.units import Quantity

_READERS: Final = {"robot": read_urdf, "sdf": read_sdf}
# Files write right angles as 1.5708, which tilts principal axes by less than this.
_PRINCIPAL_TOLERANCE: Final = 1e-5
_Vector = tuple[Quantity, Quantity, Quantity]


def read_body_file(path: Path) -> tuple[dict[str, Segment], dict[str, Joint], dict[str, Contact]]:
    """Read a URDF or SDF file.

    Args:
        path: the file.

    Returns:
        Segments, joints and contacts by name. A joint's damping is taken over; friction of contacts is the default.

    Raises:
        ValueError: the file cannot be read, is wrong, or holds something that is not supported; the text says what.
    """
    try:
        text = path.read_bytes()
    except OSError as error:
        raise ValueError(f"'{path.name}' cannot be read: {error.strerror}") from error
    try:
        element = parse_xml(text)
        if element.tag not in _READERS:
            raise ValueError(f"is neither URDF (<robot>) nor SDF (<sdf>) but <{element.tag}>")
        return _body(_READERS[element.tag](element))
    except ValueError as error:
        raise ValueError(f"'{path.name}': {error}") from error


def _body(robot: Robot) -> tuple[dict[str, Segment], dict[str, Joint], dict[str, Contact]]:
    holder = _holders(robot)
    seen_from_root = robot.link_pose[robot.root].inverse()
    moving = {joint.child: joint for joint in robot.joints.values() if joint.kind != "fixed"}
    frames = {
        link: (robot.joint_pose[moving[link].name] if link in moving else robot.link_pose[link]).after(seen_from_root)
        for link in dict.fromkeys(holder[link] for link in robot.links)
    }
    members = {segment: [robot.links[link] for link in holder if holder[link] == segment] for segment in frames}
    poses = {link: pose.after(seen_from_root) for link, pose in robot.link_pose.items()}
    segments = {
        _name(segment): _segment(segment, links, poses, frames[segment].translation)
        for segment, links in members.items()
    }
    joints = {
        _name(joint.name): _joint(joint, frames[joint.child], frames[holder[joint.parent]], holder[joint.parent])
        for joint in robot.joints.values()
        if joint.kind != "fixed"
    }
    contacts = dict[str, Contact]()
    for segment, links in members.items():
        contacts |= _contacts(segment, links, poses, frames[segment].translation)
    return segments, joints, contacts


def _holders(robot: Robot) -> dict[str, str]:
    held = {joint.child: joint.parent for joint in robot.joints.values() if joint.kind == "fixed"}
    holder = {}
    for link in robot.links:
        top = link
        while top in held:
            top = held[top]
        holder[link] = top
    return holder


def _segment(name: str, links: list[Link], poses: dict[str, Pose], origin: Floats) -> Segment:
    mass = sum(link.mass for link in links)
    if not mass > 0.0:
        raise ValueError(f"link '{name}' needs a mass")
    centers = [poses[link.name].point(link.center) - origin for link in links]
    center = sum((link.mass * place for link, place in zip(links, centers, strict=True)), np.zeros(3)) / mass
    inertia = np.zeros((3, 3))
    for link, place in zip(links, centers, strict=True):
        rotation, arm = poses[link.name].rotation, place - center
        inertia += rotation @ link.inertia @ rotation.T + link.mass * (arm @ arm * np.eye(3) - np.outer(arm, arm))
    moments = np.diag(inertia)
    if not (moments > 0.0).all():
        raise ValueError(f"link '{name}' needs moments of inertia greater than zero")
    if np.abs(inertia - np.diag(moments)).max() > _PRINCIPAL_TOLERANCE * moments.max():
        raise ValueError(
            f"the principal axes of inertia of link '{name}' are not parallel to the axes of the root link"
        )
    return Segment(mass=Quantity(mass), center_of_mass=_quantities(center), inertia=_quantities(moments))


def _joint(joint: RobotJoint, frame: Pose, parent_frame: Pose, parent: str) -> Joint:
    if not joint.axis.any():
        raise ValueError(f"the axis of joint '{joint.name}' has no direction")
    if joint.limits is not None and not joint.limits[0] < joint.limits[1]:
        raise ValueError(f"joint '{joint.name}' needs a lower limit below its upper one (got {joint.limits})")
    if joint.damping < 0.0:
        raise ValueError(f"the damping of joint '{joint.name}' must not be negative (got {joint.damping})")
    return Joint(
        kind="slide" if joint.kind == "slide" else "hinge",
        parent=parent,
        child=joint.child,
        position=_quantities(frame.translation - parent_frame.translation),
        axis=_quantities(frame.rotation @ joint.axis / np.linalg.norm(joint.axis)),
        range=None if joint.limits is None else (Quantity(joint.limits[0]), Quantity(joint.limits[1])),
        damping=Quantity(joint.damping),
    )


def _contacts(segment: str, links: list[Link], poses: dict[str, Pose], origin: Floats) -> dict[str, Contact]:
    contacts = {}
    for link in links:
        for number, (place, radius) in enumerate(link.spheres, start=1):
            if not radius > 0.0:
                raise ValueError(f"a sphere of link '{link.name}' needs a radius greater than zero (got {radius})")
            name = f"{_name(link.name)}_contact" + (str(number) if len(link.spheres) > 1 else "")
            position = _quantities(poses[link.name].point(place) - origin)
            contacts[name] = Contact(segment=segment, position=position, radius=Quantity(radius))
    return contacts


def _name(name: str) -> str:
    if fullmatch(NAME_PATTERN, name) is None:
        raise ValueError(f"the name '{name}' must start with a letter and have only letters, digits, '_', '+', '-'")
    return name


def _quantities(vector: Floats) -> _Vector:
    x, y, z = (Quantity(value) for value in vector.tolist())
    return x, y, z
