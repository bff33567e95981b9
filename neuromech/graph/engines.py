"""What an engine cannot move, told before a run: no engine puts something else in the place of what is written."""

from collections.abc import Iterator
from dataclasses import dataclass

from neuromech.graph.model import BodyModel


@dataclass(frozen=True, slots=True)
class Refusal:
    """One thing that the engine of a body does not know.

    Args:
        element: qualified name of the joint or contact, empty for the root.
        field: where in the element it stands.
        message: what is wrong.
        hint: what to do.
    """

    element: str
    field: str
    message: str
    hint: str | None = None


def refusals(body: BodyModel, engine: str) -> Iterator[Refusal]:
    """Yield what an engine that moves trees, `pybullet` or `mujoco`, does not know of a body."""
    if engine == "pybullet":
        yield from _armatures(body)
    yield from _half_soft_contacts(body)
    yield from _tilted_plane(body)


def _armatures(body: BodyModel) -> Iterator[Refusal]:
    for name, joint in body.joints.items():
        if joint.armature > 0.0:
            message = f"joint '{name}' has an armature, and PyBullet knows none"
            yield Refusal(name, "armature", message, f"leave out armature of '{name}', or use engine 'mujoco'")


def _half_soft_contacts(body: BodyModel) -> Iterator[Refusal]:
    for name, contact in body.contacts.items():
        if (contact.stiffness is None) != (contact.damping is None):
            given = "damping" if contact.stiffness is None else "stiffness"
            message = f"contact '{name}' has {given} only"
            yield Refusal(name, given, message, "give both stiffness and damping, or none")


def _tilted_plane(body: BodyModel) -> Iterator[Refusal]:
    roll, _, yaw = body.root.orientation
    if body.root.kind == "planar" and (roll or yaw):
        message = "a planar root moves in the x–z plane, so its roll and yaw must be zero"
        yield Refusal("", "orientation", message)
