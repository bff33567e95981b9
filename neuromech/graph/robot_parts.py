"""What a robot file holds, whatever its format: links and joints with their poses in one common frame."""

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Final, Literal
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from neuromech.errors import did_you_mean

Floats = NDArray[np.float64]

JOINT_KINDS: Final[dict[str, Literal["hinge", "slide", "fixed"]]] = {
    "revolute": "hinge",
    "continuous": "hinge",
    "prismatic": "slide",
    "fixed": "fixed",
}
"""What URDF and SDF call a joint -> what it is here."""


@dataclass(frozen=True, slots=True)
class Pose:
    """A frame in another one: (3, 3) rotation and (3,) translation in metres."""

    rotation: Floats
    translation: Floats

    def after(self, outer: "Pose") -> "Pose":
        """Return this pose, given in the frame `outer`, in the frame in which `outer` is given."""
        return Pose(outer.rotation @ self.rotation, outer.point(self.translation))

    def point(self, position: Floats) -> Floats:
        """Return a point of this frame in the frame in which the pose is given."""
        moved: Floats = self.translation + self.rotation @ position
        return moved

    def inverse(self) -> "Pose":
        """Return the outer frame as seen from this one."""
        return Pose(self.rotation.T, -(self.rotation.T @ self.translation))


IDENTITY = Pose(np.eye(3), np.zeros(3))


@dataclass(frozen=True, slots=True)
class Link:
    """A rigid part: mass in kg, centre of mass and (3, 3) inertia about it in the link's axes, contact spheres."""

    name: str
    mass: float
    center: Floats
    inertia: Floats
    spheres: tuple[tuple[Floats, float], ...]


@dataclass(frozen=True, slots=True)
class RobotJoint:
    """A joint between two links; the axis is in the axes of the joint's frame, damping in SI units."""

    name: str
    kind: Literal["hinge", "slide", "fixed"]
    parent: str
    child: str
    axis: Floats
    limits: tuple[float, float] | None
    damping: float


@dataclass(frozen=True, slots=True)
class Robot:
    """Links and joints of a file, and the poses of their frames at angle zero in one common frame."""

    root: str
    links: dict[str, Link]
    joints: dict[str, RobotJoint]
    link_pose: dict[str, Pose]
    joint_pose: dict[str, Pose]


class _NoDoctype(ElementTree.TreeBuilder):
    def doctype(self, name: str, pubid: str | None, system: str | None) -> None:
        """Refuse a document type, whose entities could grow without bound or read other files."""
        raise ValueError("has a document type declaration, which is not allowed")


def parse_xml(text: bytes) -> ElementTree.Element:
    """Return the root element of XML text.

    Raises:
        ValueError: the text is not well-formed, or declares a document type.
    """
    try:
        return ElementTree.fromstring(text, parser=ElementTree.XMLParser(target=_NoDoctype()))
    except ElementTree.ParseError as error:
        raise ValueError(f"is not well-formed XML: {error}") from error


def numbers(text: str | None, count: int, what: str) -> Floats:
    """Return `count` finite numbers from text.

    Raises:
        ValueError: there are not as many, or they are no finite numbers.
    """
    words = (text or "").split()
    try:
        values = [float(word) for word in words]
    except ValueError:
        values = []
    if len(values) != count or not all(map(math.isfinite, values)):
        wanted = "a finite number" if count == 1 else f"{count} finite numbers"
        raise ValueError(f"{what} must be {wanted} (got '{' '.join(words)}')")
    return np.array(values)


def number(text: str | None, what: str) -> float:
    """Return one finite number from text.

    Raises:
        ValueError: it is none.
    """
    return float(numbers(text, 1, what)[0])


def turned(roll: float, pitch: float, yaw: float) -> Floats:
    """Return the (3, 3) rotation Rz(yaw) Ry(pitch) Rx(roll)."""
    (cr, cp, cy), (sr, sp, sy) = np.cos((roll, pitch, yaw)), np.sin((roll, pitch, yaw))
    return np.array(
        [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]
    )


def symmetric(xx: float, yy: float, zz: float, xy: float, xz: float, yz: float) -> Floats:
    """Return the (3, 3) symmetric matrix of six elements."""
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def by_name(elements: Iterable[ElementTree.Element], what: str) -> Iterator[tuple[str, ElementTree.Element]]:
    """Yield (name, element).

    Raises:
        ValueError: a name is missing or used twice.
    """
    seen = set[str]()
    for element in elements:
        name = element.get("name", "")
        if not name:
            raise ValueError(f"has a {what} without a name")
        if name in seen:
            raise ValueError(f"has two {what}s with the name '{name}'")
        seen.add(name)
        yield name, element


def root_link(links: dict[str, Link], joints: dict[str, RobotJoint]) -> str:
    """Return the one link that is the child of no joint, from which joints lead to every other link.

    Raises:
        ValueError: the links and joints are no such tree.
    """
    if not links:
        raise ValueError("has no links")
    parents = dict[str, str]()
    for joint in joints.values():
        for end, link in (("parent", joint.parent), ("child", joint.child)):
            if link not in links:
                hint = did_you_mean(link, links)
                raise ValueError(f"joint '{joint.name}' names a {end} link that is not there (got '{link}'; {hint})")
        if joint.child in parents:
            raise ValueError(f"link '{joint.child}' is the child of two joints, a body is a tree")
        parents[joint.child] = joint.parent
    roots = [link for link in links if link not in parents]
    if len(roots) != 1:
        found = "none" if not roots else ", ".join(f"'{root}'" for root in roots)
        raise ValueError(f"must have exactly one link that is the child of no joint (got {found})")
    for link in links:
        _climb(link, parents)
    return roots[0]


def _climb(link: str, parents: dict[str, str]) -> None:
    seen = {link}
    at = link
    while at in parents:
        at = parents[at]
        if at in seen:
            raise ValueError(f"joints close a cycle at link '{link}', a body is a tree")
        seen.add(at)
