"""Small bodies whose motion is known, for the laws in `neuromech.testing.bodies`. All numbers in SI units."""

from collections.abc import Sequence
from dataclasses import replace
from math import cos, sin

from neuromech.graph.model import BodyModel
from neuromech.graph.terrain import terrain
from neuromech.spec.model import Contact, Joint, Root, Segment
from neuromech.spec.world import Ground, World
from neuromech.units import Quantity

PENDULUM_MASS = 0.3
PENDULUM_ARM = 0.2
PENDULUM_INERTIA = 2e-3 + PENDULUM_MASS * PENDULUM_ARM**2
GRAVITY = 9.81
BLOCK_MASS = 2.0
SLED_MASS = 1.5
BLOCK_CENTER = (0.01, -0.005, 0.02)


def vector(x: float, y: float, z: float) -> tuple[Quantity, Quantity, Quantity]:
    """Return three quantities from three numbers."""
    return Quantity(x), Quantity(y), Quantity(z)


def segment(mass: float, inertia: Sequence[float], center: Sequence[float] = (0.0, 0.0, 0.0)) -> Segment:
    """Return a segment from plain numbers."""
    xx, yy, zz = inertia
    x, y, z = center
    return Segment(mass=Quantity(mass), inertia=vector(xx, yy, zz), center_of_mass=vector(x, y, z))


def pendulum(
    angle: float = 0.0, gravity: float = GRAVITY, limits: tuple[float, float] | None = None, engine: str = "pybullet"
) -> BodyModel:
    """Return a rod on a hinge about y, its centre of mass below the hinge at angle zero."""
    joint = Joint(
        parent="base",
        child="rod",
        position=vector(0.1, 0.0, 0.0),
        axis=vector(0.0, 2.0, 0.0),
        initial_angle=Quantity(angle),
        range=None if limits is None else (Quantity(limits[0]), Quantity(limits[1])),
    )
    rod = segment(PENDULUM_MASS, (2e-3, 2e-3, 1e-4), (0.0, 0.0, -PENDULUM_ARM))
    return BodyModel(
        engine=engine,
        file=None,
        root=Root(position=vector(0.2, 0.1, 1.0)),
        root_segment="base",
        segments={"base": segment(1.0, (1.0, 1.0, 1.0)), "rod": rod},
        joints={"hinge": joint},
        contacts={},
        world=World(gravity=Quantity(gravity)),
    )


def block(
    height: float,
    root: str = "free",
    orientation: tuple[float, float, float] = (0.0, 0.0, 0.0),
    friction: float = 1.0,
    stiffness: float | None = None,
    damping: float | None = None,
) -> BodyModel:
    """Return a rigid block on four spheres above the ground, its centre of mass off the middle; no joints."""
    contacts = {
        f"foot{number}": Contact(
            segment="block",
            position=vector(x, y, -0.05),
            radius=Quantity(0.01),
            friction=Quantity(friction),
            stiffness=None if stiffness is None else Quantity(stiffness),
            damping=None if damping is None else Quantity(damping),
        )
        for number, (x, y) in enumerate(((0.1, 0.06), (0.1, -0.06), (-0.1, 0.06), (-0.1, -0.06)))
    }
    return BodyModel(
        engine="pybullet",
        file=None,
        root=Root.model_validate(
            {"kind": root, "position": vector(0.3, -0.2, height), "orientation": vector(*orientation)}
        ),
        root_segment="block",
        segments={"block": segment(BLOCK_MASS, (0.01, 0.02, 0.025), BLOCK_CENTER)},
        joints={},
        contacts=contacts,
        world=World(gravity=Quantity(GRAVITY), ground=Ground()),
    )


def block_on(
    ground: Ground,
    x: float,
    height: float,
    friction: float = 1.0,
    angle: float = 0.0,
    stiffness: float | None = None,
    damping: float | None = None,
) -> BodyModel:
    """Return the block with its feet parallel to ground that rises by an angle along x.

    Args:
        ground: without steps, or with steps as high as the ground is meant to be.
        x: of the root frame, in m.
        height: of the undersides of the feet above the ground, along its normal, in m.
        friction: of the feet.
        angle: of the ground, in rad.
        stiffness: of the feet, in N/m.
        damping: of the feet, in N s/m.
    """
    lying = block(0.0, "free", (0.0, -angle, 0.0), friction, stiffness, damping)
    normal = (-sin(angle), cos(angle))
    away = 0.06 + height
    z = terrain(ground).height(x, 0.0) + away * normal[1]
    root = lying.root.model_copy(update={"position": vector(x + away * normal[0], 0.0, z)})
    return replace(lying, root=root, world=World(gravity=Quantity(GRAVITY), ground=ground))


def sled(friction: float) -> BodyModel:
    """Return a sled that slides along x on one sphere. What holds it slides along z: the sphere bears all weight.

    Args:
        friction: of the sphere; that of the ground is 0.5.
    """
    slide = {"kind": "slide", "position": vector(0.0, 0.0, 0.0)}
    lift = Joint.model_validate(slide | {"parent": "base", "child": "carriage", "axis": vector(0.0, 0.0, 1.0)})
    run = Joint.model_validate(slide | {"parent": "carriage", "child": "sled", "axis": vector(1.0, 0.0, 0.0)})
    foot = Contact(segment="sled", position=vector(0.0, 0.0, 0.0), radius=Quantity(0.1), friction=Quantity(friction))
    return BodyModel(
        engine="pybullet",
        file=None,
        root=Root(position=vector(0.0, 0.0, 0.1)),
        root_segment="base",
        segments={
            "base": segment(1.0, (1.0, 1.0, 1.0)),
            "carriage": segment(BLOCK_MASS - SLED_MASS, (1e-3, 1e-3, 1e-3)),
            "sled": segment(SLED_MASS, (1e-3, 1e-3, 1e-3)),
        },
        joints={"lift": lift, "run": run},
        contacts={"foot": foot},
        world=World(gravity=Quantity(GRAVITY), ground=Ground(friction=Quantity(0.5))),
    )


def chains(root: str, gravity: float = 0.0) -> BodyModel:
    """Return two three-joint chains on one trunk, joints bent; no contacts. Axes are y where the root is planar."""
    segments = {"trunk": segment(4.0, (0.02, 0.05, 0.05), (0.02, 0.0, 0.01))}
    joints = {}
    for side, x in (("fore", 0.13), ("hind", -0.13)):
        parent = "trunk"
        for number in range(3):
            name = f"{side}{number}"
            segments[name] = segment(0.2 - 0.05 * number, (4e-4, 5e-4, 3e-4), (0.005, 0.0, -0.04))
            joints[f"{side}.{number}"] = Joint(
                kind="slide" if name == "hind2" else "hinge",
                parent=parent,
                child=name,
                position=vector(x, 0.0, -0.02) if number == 0 else vector(0.01, 0.0, -0.09),
                axis=vector(0.0, 1.0, 0.0) if name != "hind2" else vector(0.0, 0.0, 1.0),
                initial_angle=Quantity(0.4 - 0.3 * number if name != "hind2" else 0.02),
            )
            if root == "free":
                joints[f"{side}.{number}"] = joints[f"{side}.{number}"].model_copy(
                    update={"axis": vector(0.3 * number, 1.0, 0.5 if side == "fore" else -0.2)}
                )
            parent = name
    return BodyModel(
        engine="pybullet",
        file=None,
        root=Root.model_validate({"kind": root, "position": vector(0.0, 0.1, 1.0)}),
        root_segment="trunk",
        segments=segments,
        joints=joints,
        contacts={},
        world=World(gravity=Quantity(gravity)),
    )
