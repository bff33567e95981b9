"""Which engine moves a body."""

from collections.abc import Callable

from neuromech.bodies.base import Body
from neuromech.bodies.hinge import HingeBody
from neuromech.bodies.mujoco import MujocoBody
from neuromech.bodies.pybullet import PyBulletBody
from neuromech.graph.model import BodyModel

_ENGINES: dict[str, Callable[[BodyModel, float], Body]] = {
    "hinge": HingeBody,
    "pybullet": PyBulletBody,
    "mujoco": MujocoBody,
}


def open_body(body: BodyModel, step: float) -> Body:
    """Open a body with the engine that its document names; use it in a `with` block.

    Args:
        body: the body.
        step: time in seconds by which each step advances it.

    Raises:
        DocumentError: the engine cannot move this body.
        MissingExtraError: the engine is not installed.
    """
    return _ENGINES[body.engine](body, step)
