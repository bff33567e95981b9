"""Which engine moves a body.

The one place where a module is imported by name: an engine is a large library, and only a run whose document names it
needs it, or needs to have it installed at all.
"""

from importlib import import_module
from typing import Final

from neuromech.bodies.base import Body
from neuromech.graph.model import BodyModel

_ENGINES: Final = {
    "hinge": ("neuromech.bodies.hinge", "HingeBody"),
    "pybullet": ("neuromech.bodies.pybullet", "PyBulletBody"),
    "mujoco": ("neuromech.bodies.mujoco", "MujocoBody"),
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
    module, name = _ENGINES[body.engine]
    opened: Body = getattr(import_module(module), name)(body, step)
    return opened
