"""MJCF text of a body, as MuJoCo loads it.

Nothing collides but contact spheres with the ground, and weights on strings with the segment that they hit: every such
couple is a `<pair>` of its own, so that its friction is the product of the two frictions, as in Bullet. (MuJoCo's rule
for colliding geometries is the larger of the two.) A contact sensor per sphere reports the force of the ground on it in
world axes, one per weight its force on the segment.
"""

from math import cos, sin
from typing import Final
from xml.etree import ElementTree

from neuromech.bodies.base import root_quaternion
from neuromech.compiler.tree import unit_vector
from neuromech.graph.model import BodyModel
from neuromech.graph.terrain import Terrain, terrain
from neuromech.spec.model import BoxShape, Contact, Joint, Segment
from neuromech.spec.pendulum import Pendulum

# Qualified names of a document hold no colon, so these collide with none.
CONTACT: Final = "contact:"
GROUND: Final = "ground:"
SHAPE: Final = "shape:"
WEIGHT: Final = "pendulum:"
PLANAR_JOINTS: Final = ("root:x", "root:z", "root:pitch")

# A contact that gives no stiffness: critically damped, time constant in seconds; constraint widths as measured.
TIME_CONSTANT: Final = 0.015
_SOLREF: Final = (TIME_CONSTANT, 1.0)
_SOLIMP: Final = (0.9, 0.95, 0.002)
# Rate (1/s) at which friction stops what slides slowly. MuJoCo lifts what slides fast, the more the higher the
# rate; at this one stopping distances are right within 4 % and the lift is half of that at the rate of `_SOLREF`.
SLIP_RATE: Final = 70.0
# A limit of a joint is as stiff as the step allows: MuJoCo wants time constants of two steps and more.
_LIMIT_STEPS: Final = 2.0
# Elliptic cones make friction the same in all directions. The ratio makes it a hundred times harder than the normal
# direction; at MuJoCo's 1 a foot that should stick creeps by millimetres per second.
_OPTIONS: Final = {"integrator": "Euler", "solver": "Newton", "cone": "elliptic", "impratio": "100"}
_NO_VOLUME: Final = {"contype": "0", "conaffinity": "0", "group": "2"}


def mjcf_text(body: BodyModel, step: float) -> str:
    """Return the MJCF of a body. Names of bodies and joints are the qualified names of segments and joints.

    Args:
        body: the body.
        step: in seconds.
    """
    model = ElementTree.Element("mujoco", model=body.root_segment)
    _settings(model, body, step)
    world = ElementTree.SubElement(model, "worldbody")
    elements = {body.root_segment: _root(world, body)}
    for name, joint in body.joints.items():
        elements[joint.child] = ElementTree.Element("body", name=joint.child, pos=_text(*joint.position))
        _joint(elements[joint.child], name, joint, step)
    for joint in body.joints.values():
        elements[joint.parent].append(elements[joint.child])
    for name, segment in body.segments.items():
        _segment(elements[name], name, segment)
    for name, contact in body.contacts.items():
        size, position = _text(contact.radius), _text(*contact.position)
        sphere = {"name": CONTACT + name, "type": "sphere", "size": size, "pos": position}
        ElementTree.SubElement(elements[contact.segment], "geom", sphere | _NO_VOLUME)
    for name, pendulum in body.world.pendulums.items():
        _weight(world, name, pendulum)
    pairs, sensors = ElementTree.SubElement(model, "contact"), ElementTree.SubElement(model, "sensor")
    if body.world.ground is not None:
        _ground(world, pairs, sensors, terrain(body.world.ground), body.contacts)
    for name, pendulum in body.world.pendulums.items():
        both = {"geom1": WEIGHT + name, "geom2": SHAPE + pendulum.segment}
        law = {"solref": _text(*_SOLREF), "solimp": _text(*_SOLIMP), "condim": "1"}
        ElementTree.SubElement(pairs, "pair", both | law)
        ElementTree.SubElement(sensors, "contact", both | {"data": "force", "reduce": "netforce", "num": "1"})
    ElementTree.indent(model)
    return ElementTree.tostring(model, encoding="unicode")


def _settings(model: ElementTree.Element, body: BodyModel, step: float) -> None:
    compiler = {"angle": "radian", "autolimits": "false", "inertiafromgeom": "false", "balanceinertia": "false"}
    ElementTree.SubElement(model, "compiler", compiler | {"boundmass": "0", "boundinertia": "0"})
    gravity = _text(0.0, 0.0, -float(body.world.gravity))
    option = ElementTree.SubElement(model, "option", _OPTIONS | {"timestep": _text(step), "gravity": gravity})
    # A state that diverges shall be seen to diverge: MuJoCo would start the run anew and only warn.
    ElementTree.SubElement(option, "flag", autoreset="disable")


def _root(world: ElementTree.Element, body: BodyModel) -> ElementTree.Element:
    name, root = body.root_segment, body.root
    if root.kind == "planar":
        # Joints count from the world's origin and axes, so that their angles are the root's pose.
        element = ElementTree.SubElement(world, "body", name=name, pos=_text(0.0, root.position[1], 0.0))
        for joint, kind, axis in zip(
            PLANAR_JOINTS, ("slide", "slide", "hinge"), ("1 0 0", "0 0 1", "0 1 0"), strict=True
        ):
            ElementTree.SubElement(element, "joint", name=joint, type=kind, axis=axis)
        return element
    x, y, z, w = root_quaternion(root)
    element = ElementTree.SubElement(world, "body", name=name, pos=_text(*root.position), quat=_text(w, x, y, z))
    if root.kind == "free":
        ElementTree.SubElement(element, "freejoint")
    return element


def _joint(element: ElementTree.Element, name: str, joint: Joint, step: float) -> None:
    axis = _text(*unit_vector(joint.axis, name).tolist())
    attributes = {"name": name, "type": joint.kind, "axis": axis, "armature": _text(joint.armature)}
    if joint.range is not None:
        stiff = _text(_LIMIT_STEPS * step, 1.0)
        attributes |= {"limited": "true", "range": _text(*joint.range), "solreflimit": stiff}
    ElementTree.SubElement(element, "joint", attributes)


def _segment(element: ElementTree.Element, name: str, segment: Segment) -> None:
    inertial = {"pos": _text(*segment.center_of_mass), "mass": _text(segment.mass)}
    ElementTree.SubElement(element, "inertial", inertial | {"diaginertia": _text(*segment.inertia)})
    shape = segment.shape
    if isinstance(shape, BoxShape):
        size, position = _text(*(side / 2 for side in shape.size)), _text(*shape.position)
        box = {"name": SHAPE + name, "type": "box", "size": size, "pos": position}
        ElementTree.SubElement(element, "geom", box | _NO_VOLUME)
    elif shape is not None:
        ends, size = _text(*shape.start, *shape.end), _text(shape.radius)
        capsule = {"name": SHAPE + name, "type": "capsule", "size": size, "fromto": ends}
        ElementTree.SubElement(element, "geom", capsule | _NO_VOLUME)


def ground_pieces(ground: Terrain) -> list[tuple[str, float]]:
    """Return name and friction of the geometries that the ground is made of, in the order of their contact pairs."""
    plane = [] if ground.plane is None else [(GROUND, ground.plane[1])]
    return [*plane, *((GROUND + box.name, box.friction) for box in ground.boxes)]


def _weight(world: ElementTree.Element, name: str, pendulum: Pendulum) -> None:
    element = ElementTree.SubElement(world, "body", name=WEIGHT + name)
    moment = _text(*[0.4 * pendulum.mass * pendulum.radius**2] * 3)
    ElementTree.SubElement(element, "inertial", {"pos": "0 0 0", "mass": _text(pendulum.mass), "diaginertia": moment})
    for axis, direction in zip("xyz", ("1 0 0", "0 1 0", "0 0 1"), strict=True):
        ElementTree.SubElement(element, "joint", name=f"{WEIGHT}{name}:{axis}", type="slide", axis=direction)
    ball = {"name": WEIGHT + name, "type": "sphere", "size": _text(pendulum.radius)}
    ElementTree.SubElement(element, "geom", ball | _NO_VOLUME)


def _ground(
    world: ElementTree.Element,
    pairs: ElementTree.Element,
    sensors: ElementTree.Element,
    ground: Terrain,
    contacts: dict[str, Contact],
) -> None:
    if ground.plane is not None:
        plane = {"name": GROUND, "type": "plane", "size": "0 0 1", "pos": _text(0.0, 0.0, ground.plane[0])}
        ElementTree.SubElement(world, "geom", plane | _NO_VOLUME)
    for box in ground.boxes:
        size, position = _text(*(side / 2 for side in box.size)), _text(*box.center)
        turned = _text(cos(box.angle / 2), 0.0, -sin(box.angle / 2), 0.0)
        shape = {"name": GROUND + box.name, "type": "box", "size": size, "pos": position, "quat": turned}
        ElementTree.SubElement(world, "geom", shape | _NO_VOLUME)
    for name, contact in contacts.items():
        for piece, ground_friction in ground_pieces(ground):
            ElementTree.SubElement(pairs, "pair", _pair(piece, CONTACT + name, ground_friction * contact.friction))
        both = {"body1": "world", "geom2": CONTACT + name}
        ElementTree.SubElement(sensors, "contact", both | {"data": "force", "reduce": "netforce", "num": "1"})


def _pair(ground: str, contact: str, friction: float) -> dict[str, str]:
    return {
        "geom1": ground,
        "geom2": contact,
        "solref": _text(*_SOLREF),
        "solimp": _text(*_SOLIMP),
        "friction": _text(friction, friction, 0.0, 0.0, 0.0),
        # Without friction the contact has its normal direction only: MuJoCo would raise a zero to 1e-5.
        "condim": "3" if friction > 0.0 else "1",
    }


def _text(*numbers: float) -> str:
    return " ".join(repr(float(number)) for number in numbers)
