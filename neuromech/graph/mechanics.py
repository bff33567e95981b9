"""What the mechanical elements of a graph can be asked for: quantities that other elements read and runs record."""

from neuromech.components.base import Component, Port
from neuromech.graph.model import Element
from neuromech.spec.model import Joint

HINGE_OUTPUTS = (Port("angle", "deg"), Port("velocity", "deg/s"), Port("torque", "N m"))
SLIDE_OUTPUTS = (Port("angle", "mm"), Port("velocity", "mm/s"), Port("torque", "N"))
SEGMENT_OUTPUTS = (
    Port("x", "m"),
    Port("y", "m"),
    Port("z", "m"),
    Port("roll", "deg"),
    Port("pitch", "deg"),
    Port("yaw", "deg"),
    Port("velocity_x", "m/s"),
    Port("velocity_y", "m/s"),
    Port("velocity_z", "m/s"),
    Port("angular_velocity_x", "deg/s"),
    Port("angular_velocity_y", "deg/s"),
    Port("angular_velocity_z", "deg/s"),
)
CONTACT_OUTPUTS = (
    Port("force_x", "N"),
    Port("force_y", "N"),
    Port("force_z", "N"),
    Port("x", "m"),
    Port("y", "m"),
    Port("z", "m"),
)
PUSH_OUTPUTS = (Port("force_x", "N"), Port("force_y", "N"), Port("force_z", "N"))
PENDULUM_OUTPUTS = (
    Port("x", "m"),
    Port("y", "m"),
    Port("z", "m"),
    Port("velocity_x", "m/s"),
    Port("velocity_y", "m/s"),
    Port("velocity_z", "m/s"),
    Port("force_x", "N"),
    Port("force_y", "N"),
    Port("force_z", "N"),
)
PATH_OUTPUTS = (Port("length", "mm"), Port("velocity", "mm/s"))
_OUTPUTS = {
    "segment": SEGMENT_OUTPUTS,
    "contact": CONTACT_OUTPUTS,
    "push": PUSH_OUTPUTS,
    "pendulum": PENDULUM_OUTPUTS,
}


def outputs(element: Element) -> tuple[Port, ...]:
    """Return what can be read from an element: outputs of its equations, then quantities of the mechanics.

    The unit of a port is the one to show; values are in SI units everywhere. Of a slide joint, `angle` is the
    displacement and `torque` the force; of a pendulum, `force` is that on the segment that it hits.
    """
    spec = element.spec
    if isinstance(spec, Component):
        return spec.outputs + (PATH_OUTPUTS if element.family == "muscle" else ())
    if isinstance(spec, Joint):
        return HINGE_OUTPUTS if spec.kind == "hinge" else SLIDE_OUTPUTS
    return _OUTPUTS[element.family]


def inputs(element: Element) -> tuple[Port, ...]:
    """Return the input ports of an element; segments, joints, contacts, pushes and pendulums have none."""
    return element.spec.inputs if isinstance(element.spec, Component) else ()
