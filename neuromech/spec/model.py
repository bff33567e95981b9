"""The typed document: what an author may write, after composition, in SI units.

Names inside a scope (the document itself, or an instance of a module) are plain; an element's qualified name is its
scope's name, a dot, and its own (`LF.RG-F`). A reference is looked up in its own scope first, then outwards.
"""

from collections.abc import Mapping
from typing import Annotated, Literal

from pydantic import Field, field_validator

from neuromech.components.base import Drive, Muscle, Neuron, Sensor, SpecModel, Synapse
from neuromech.spec.fields import KindFromKey, OfCatalogue
from neuromech.spec.measure import Expected, Measure
from neuromech.spec.pushes import Push, PushSeries
from neuromech.spec.scalars import Following, Name, PositiveTime, Seed, Vector, Written
from neuromech.spec.study import Study
from neuromech.spec.sweep import Sweep
from neuromech.spec.world import World
from neuromech.units import (
    ANGLE,
    ANGULAR_VELOCITY,
    CONTACT_DAMPING,
    CONTACT_STIFFNESS,
    DIMENSIONLESS,
    INERTIA,
    JOINT_DAMPING,
    JOINT_STIFFNESS,
    LENGTH,
    MASS,
    TIME,
    Angle,
    Dimensionless,
    Length,
    Quantity,
    quantity,
)


class Parameter(SpecModel):
    """A named, bounded knob. `value`, `minimum` and `maximum` keep the author's text: its users check the unit."""

    value: Written
    minimum: Written | None = None
    maximum: Written | None = None
    description: str = ""
    source: str = ""


class Uniform(SpecModel):
    """A uniform distribution over an interval; the unit is that of the value it stands for."""

    uniform: tuple[Following, Following]


class Population(SpecModel):
    """Many neurons of one kind. `vary` gives each its own value of a parameter; all else is as `neuron` says."""

    size: Annotated[int, Field(ge=1, le=10_000_000, strict=True, description="number of neurons")]
    neuron: Annotated[Neuron, OfCatalogue("neuron")]
    vary: Annotated[dict[str, Uniform], Field(description="parameters of the neuron that differ")] = {}
    seed: Annotated[Seed, Field(description="of the values that vary")] = 0


class Projection(SpecModel):
    """Synapses of one kind from a population to another, or between a population and a single element.

    Each receiver gets `in_degree` different senders, or each sender with `probability`; all senders where neither is
    given. A neuron of a population may be a sender to itself. The seed of the run does not change the wiring.
    """

    sender: str
    receiver: str
    synapse: Annotated[Synapse, OfCatalogue("synapse")]
    in_degree: Annotated[int | None, Field(ge=1, strict=True, description="senders of each receiver")] = None
    probability: Annotated[Quantity, DIMENSIONLESS.within(0.0, 1.0)] | None = None
    vary: Annotated[dict[str, Uniform], Field(description="parameters of the synapse that differ")] = {}
    seed: Annotated[Seed, Field(description="of the wiring and of the values that vary")] = 0


class Network(SpecModel):
    """Neurons, populations, drives and what connects them; synapses as {kind: {sender: {receiver: synapse}}}."""

    neurons: dict[Name, Annotated[Neuron, OfCatalogue("neuron")]] = {}
    drives: dict[Name, Annotated[Drive, OfCatalogue("drive")]] = {}
    populations: dict[Name, Population] = {}
    projections: dict[Name, Projection] = {}
    synapses: Annotated[
        dict[str, dict[str, dict[str, Annotated[Synapse, OfCatalogue("synapse")]]]], KindFromKey("synapse", "weight")
    ] = {}

    @field_validator("synapses", mode="before")
    @classmethod
    def _kind_from_key(cls, value: object) -> object:
        """Give each synapse the kind of the table it stands in; a bare value is its weight."""
        if not isinstance(value, Mapping):
            return value
        return {kind: _with_kind(kind, senders) for kind, senders in value.items()}


def _with_kind(kind: str, senders: object) -> object:
    if not isinstance(senders, Mapping):
        return senders
    return {
        sender: {receiver: _synapse(kind, value) for receiver, value in receivers.items()}
        if isinstance(receivers, Mapping)
        else receivers
        for sender, receivers in senders.items()
    }


def _synapse(kind: str, value: object) -> object:
    if isinstance(value, Synapse):
        return value
    return {"kind": kind, **value} if isinstance(value, Mapping) else {"kind": kind, "weight": value}


class BoxShape(SpecModel):
    """A box, for pictures only."""

    kind: Literal["box"] = "box"
    size: tuple[Length, Length, Length]
    position: Vector = (quantity("0 m"), quantity("0 m"), quantity("0 m"))


class CapsuleShape(SpecModel):
    """A capsule between two points, for pictures only."""

    kind: Literal["capsule"] = "capsule"
    start: Vector
    end: Vector
    radius: Annotated[Quantity, LENGTH.positive]


class Segment(SpecModel):
    """A rigid segment. Its frame sits at the joint to its parent, axes parallel to the parent's at angle zero."""

    mass: Annotated[Quantity, MASS.positive]
    center_of_mass: Vector = (quantity("0 m"), quantity("0 m"), quantity("0 m"))
    inertia: Annotated[
        tuple[
            Annotated[Quantity, INERTIA.positive],
            Annotated[Quantity, INERTIA.positive],
            Annotated[Quantity, INERTIA.positive],
        ],
        Field(description="principal moments about the centre of mass, along the segment's x, y and z axes"),
    ]
    shape: Annotated[BoxShape | CapsuleShape, Field(discriminator="kind")] | None = None


class SoftLimit(SpecModel):
    """Ligaments that resist a joint beyond a range, as a damper that grows with the excess (Dzeladini 2013 eq. 2.38).

    The torque is stiffness × excess × (1 + ω/reference_velocity), ω positive when the joint moves on, and none when it
    comes back faster than `reference_velocity`.
    """

    range: tuple[Angle, Angle]
    stiffness: Annotated[Quantity, JOINT_STIFFNESS.non_negative]
    reference_velocity: Annotated[Quantity, ANGULAR_VELOCITY.positive]


class Joint(SpecModel):
    """A joint between two segments. Positive rotation follows the right-hand rule about `axis`."""

    kind: Literal["hinge", "slide"] = "hinge"
    parent: str
    child: str
    position: Annotated[Vector, Field(description="of the joint in the parent's frame")]
    axis: tuple[Dimensionless, Dimensionless, Dimensionless]
    range: tuple[Angle, Angle] | None = None
    soft_limit: SoftLimit | None = None
    damping: Annotated[Quantity, JOINT_DAMPING.non_negative] = quantity("0 N m s/rad")
    stiffness: Annotated[Quantity, JOINT_STIFFNESS.non_negative] = quantity("0 N m/rad")
    rest_angle: Angle = quantity("0 deg")
    armature: Annotated[Quantity, INERTIA.non_negative] = quantity("0 kg m^2")
    initial_angle: Angle = quantity("0 deg")


class Contact(SpecModel):
    """A sphere fixed to a segment that can touch the ground."""

    segment: str
    position: Vector
    radius: Annotated[Quantity, LENGTH.positive]
    friction: Annotated[Quantity, DIMENSIONLESS.non_negative] = quantity("1")
    stiffness: Annotated[Quantity, CONTACT_STIFFNESS.positive] | None = None
    damping: Annotated[Quantity, CONTACT_DAMPING.non_negative] | None = None


class BodyParts(SpecModel):
    """The parts of a body that a module may hold."""

    segments: dict[Name, Segment] = {}
    joints: dict[Name, Joint] = {}
    contacts: dict[Name, Contact] = {}


class Root(SpecModel):
    """How the root segment is held, and where its frame starts."""

    kind: Literal["fixed", "planar", "free"] = "fixed"
    position: Vector = (quantity("0 m"), quantity("0 m"), quantity("0 m"))
    orientation: Annotated[tuple[Angle, Angle, Angle], Field(description="roll, pitch, yaw")] = (
        quantity("0 deg"),
        quantity("0 deg"),
        quantity("0 deg"),
    )


class Body(BodyParts):
    """The body and the engine that moves it. With `file`, segments and joints come from a URDF or SDF file."""

    engine: Literal["hinge", "pybullet", "mujoco"] = "pybullet"
    file: str | None = None
    root: Root = Root()


class Scope(SpecModel):
    """What a module holds, and the document holds too."""

    network: Network = Network()
    muscles: dict[Name, Annotated[Muscle, OfCatalogue("muscle")]] = {}
    sensors: dict[Name, Annotated[Sensor, OfCatalogue("sensor")]] = {}


class Instance(Scope):
    """An instance of a module, as it stands after its arguments were put in."""

    body: BodyParts = BodyParts()
    instances: dict[Name, "Instance"] = {}


class Solver(SpecModel):
    """Numerical method of the network and the coupling with the body."""

    method: Literal["rk4", "exponential_euler", "rush_larsen", "lsoda", "radau", "dop853"] = "rk4"
    step: PositiveTime = quantity("0.5 ms")
    body_step: PositiveTime = quantity("1 ms")
    muscle_step: Annotated[
        PositiveTime, Field(description="longest step in which muscles with a tendon integrate their fibres")
    ] = quantity("0.5 ms")
    coupling: Literal["observer_implicit", "explicit"] = "observer_implicit"
    threads: Annotated[
        int | None,
        Field(ge=1, strict=True, description="that share the synapses; by default all cores for large networks"),
    ] = None
    relative_tolerance: Annotated[Quantity, DIMENSIONLESS.positive] = quantity("1e-6")
    absolute_tolerance: Annotated[Quantity, DIMENSIONLESS.positive] = quantity("1e-9")


class Ramp(SpecModel):
    """A parameter moves linearly from one value to another."""

    parameter: str
    start: Annotated[Quantity, TIME.non_negative]
    end: PositiveTime
    to: Written


class Event(SpecModel):
    """Parameters jump to new values at a time."""

    at: Annotated[Quantity, TIME.non_negative]
    set: dict[str, Written] = Field(min_length=1)


class Fall(SpecModel):
    """When a body with a moving root counts as fallen: root too low, or tilted too far."""

    height: Annotated[Length | None, Field(description="lowest height of the root above the ground below it")] = None
    tilt: Annotated[Quantity, ANGLE.positive] | None = None


class Protocol(SpecModel):
    """What happens in time. `initial` sets states by name pattern at time zero: a value, or a distribution.

    A value may be that of a parameter.
    """

    duration: PositiveTime
    seed: Seed = 0
    initial: dict[str, Following | Uniform] = {}
    ramps: dict[Name, Ramp] = {}
    events: dict[Name, Event] = {}
    pushes: dict[Name, Push] = {}
    push_series: dict[Name, PushSeries] = {}
    fall: Fall | None = None


class RecordGroup(SpecModel):
    """Signals recorded together, at one rate; `signals` are name patterns with * and ?."""

    signals: Annotated[tuple[str, ...], Field(min_length=1)]
    every: PositiveTime


class Claim(SpecModel):
    """A checked statement about a run of this document.

    `set` changes the document for this claim alone, `seeds` repeats it, `sweep` repeats it over values of one path and
    judges the successive differences, `compare` judges the ratio of the measured value to that of a changed document.
    `share` says in which part of the judged values the expectation must hold.
    """

    claim: str
    measure: Measure
    expected: Expected
    published: Written | None = None
    source: str
    set: dict[str, Written | bool] = {}
    seeds: Annotated[int, Field(ge=1, strict=True)] = 1
    share: Annotated[Quantity, DIMENSIONLESS.within(0.0, 1.0)] = quantity("1")
    sweep: dict[str, list[Written]] = {}
    compare: dict[str, Written | bool] = {}
    compare_with: str | None = None


class Experiment(Scope):
    """A whole document."""

    neuromech: Literal[1]
    name: str
    description: str = ""
    references: dict[str, str] = {}
    parameters: dict[Name, Parameter] = {}
    instances: dict[Name, Instance] = {}
    body: Body | None = None
    world: World = World()
    protocol: Protocol
    solver: Solver = Solver()
    record: dict[Name, RecordGroup] = {}
    study: Study | None = None
    sweeps: dict[Name, Sweep] = {}
    claims: dict[Name, Claim] = {}
