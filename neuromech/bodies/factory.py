"""Which engine moves a body."""

from neuromech.bodies.base import Body
from neuromech.bodies.hinge import HingeBody
from neuromech.bodies.pybullet import PyBulletBody
from neuromech.graph.model import BodyModel

_ENGINES: dict[str, type[HingeBody] | type[PyBulletBody]] = {"hinge": HingeBody, "pybullet": PyBulletBody}


def open_body(body: BodyModel, step: float) -> Body:
    """Open a body with the engine that its document names; use it in a `with` block.

    Args:
        body: the body.
        step: time in seconds by which each step advances it.

    Raises:
        DocumentError: the engine cannot move this body.
    """
    return _ENGINES[body.engine](body, step)
