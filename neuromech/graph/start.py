"""What `protocol.initial` may say about a body at time zero, and the body that starts so."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Final

from neuromech.graph.mechanics import SEGMENT_OUTPUTS
from neuromech.graph.model import BodyModel, Motion
from neuromech.graph.pose import clearances
from neuromech.graph.signals import matching
from neuromech.spec.model import Joint, Uniform
from neuromech.spec.scalars import Written
from neuromech.units import Quantity, quantity

CLEARANCE: Final = "clearance"
"""Of the root: how high its lowest contact is above the ground. The root's height follows from it."""

_POSITION: Final = ("x", "y", "z")
_ORIENTATION: Final = ("roll", "pitch", "yaw")
_VELOCITY: Final = ("velocity_x", "velocity_y", "velocity_z")
_OF_ROOT: Final = {
    "fixed": (*_POSITION, *_ORIENTATION),
    "planar": (*_POSITION, "pitch", "velocity_x", "velocity_z"),
    "free": (*_POSITION, *_ORIENTATION, *_VELOCITY),
}
_UNITS: Final = {port.name: port.unit for port in SEGMENT_OUTPUTS}


def start_units(body: BodyModel) -> dict[str, str]:
    """Return name → unit of what can be set at time zero: pose and velocity of the root, angles of joints."""
    names = _OF_ROOT[body.root.kind]
    found = {f"{body.root_segment}.{name}": _UNITS[name] for name in names}
    if body.contacts:
        found[f"{body.root_segment}.{CLEARANCE}"] = "mm"
    for name, joint in body.joints.items():
        units = ("deg", "deg/s") if joint.kind == "hinge" else ("mm", "mm/s")
        found |= {f"{name}.angle": units[0], f"{name}.velocity": units[1]}
    return found


def written_start(body: BodyModel, initial: Mapping[str, Written | Uniform]) -> dict[str, tuple[str, float, float]]:
    """Return what `protocol.initial` says of a body: name → its pattern, lowest and highest value in SI units.

    A later pattern takes the place of an earlier one, and each name counts by itself.
    """
    names = start_units(body)
    found: dict[str, tuple[str, float, float]] = {}
    for pattern, value in initial.items():
        ends = value.uniform if isinstance(value, Uniform) else (value, value)
        low, high = (float(quantity(str(end))) for end in ends)
        found |= {name: (pattern, low, high) for name in matching(pattern, names)}
    return found


def started(body: BodyModel, values: Mapping[str, float]) -> BodyModel:
    """Return a body that starts with given values, by the names of `start_units`, in SI units."""
    root = body.root_segment
    position = _chosen(values, root, _POSITION, body.root.position)
    orientation = _chosen(values, root, _ORIENTATION, body.root.orientation)
    velocity = _chosen(values, root, _VELOCITY, body.motion.root)
    begun = replace(
        body,
        root=body.root.model_copy(update={"position": position, "orientation": orientation}),
        joints={name: _joint(joint, values.get(f"{name}.angle")) for name, joint in body.joints.items()},
        motion=Motion(body.motion.joints | _velocities(body, values), velocity),
    )
    clearance = values.get(f"{root}.{CLEARANCE}")
    return begun if clearance is None else _lifted(begun, clearance)


def _chosen(
    values: Mapping[str, float], root: str, names: tuple[str, ...], otherwise: tuple[float, ...]
) -> tuple[Quantity, Quantity, Quantity]:
    x, y, z = (Quantity(values.get(f"{root}.{name}", old)) for name, old in zip(names, otherwise, strict=True))
    return x, y, z


def _joint(joint: Joint, angle: float | None) -> Joint:
    return joint if angle is None else joint.model_copy(update={"initial_angle": Quantity(angle)})


def _velocities(body: BodyModel, values: Mapping[str, float]) -> dict[str, float]:
    return {name: values[f"{name}.velocity"] for name in body.joints if f"{name}.velocity" in values}


def _lifted(body: BodyModel, clearance: float) -> BodyModel:
    """Put the root to the height at which the lowest contact is so far above the ground."""
    lift = clearance - min(clearances(body).values())
    x, y, z = body.root.position
    return replace(body, root=body.root.model_copy(update={"position": (x, y, Quantity(z + lift))}))
