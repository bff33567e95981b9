"""What a component is: one frozen class with parameters, states, ports, equations and a source.

Equations are plain static functions of numbers. The names of their arguments say what they need: a state, an input
port, or a parameter of the class; the compiler looks them up by name and hands the functions to numba. They may use
`math` and functions of their own module that do the same, nothing else.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar, Literal, get_args

from pydantic import BaseModel, ConfigDict

Family = Literal["neuron", "drive", "synapse", "muscle", "path", "sensor"]
Target = Literal["neuron", "drive", "muscle", "sensor", "joint", "segment", "contact"]
Layer = Literal["rhythm_generator", "pattern_formation", "motoneuron", "interneuron"]


@dataclass(frozen=True, slots=True)
class State:
    """A continuous state.

    Args:
        name: its name, which is also its argument name in equations.
        unit: unit of its SI value as text of `units.txt`; empty for a number.
        initial: name of the parameter field that holds the value at time zero.
    """

    name: str
    unit: str
    initial: str


@dataclass(frozen=True, slots=True)
class Port:
    """An input (sum of what is connected to it, 0 without a connection) or an output of a component."""

    name: str
    unit: str


@dataclass(frozen=True, slots=True)
class Reference:
    """Marks a text field as the name of another element, and says which of its outputs feed which of our inputs.

    Args:
        to: what kind of element the name must belong to.
        wires: pairs (output of the other element, input port of this component). `{field}` in an output is replaced
            by the value of that field.
    """

    to: Target
    wires: tuple[tuple[str, str], ...]


class SpecModel(BaseModel):
    """Frozen, unknown keys refused: what every part of a document is made of."""

    model_config = ConfigDict(frozen=True, extra="forbid", validate_default=False, arbitrary_types_allowed=True)


class Component(SpecModel):
    """Base of the vocabulary. A concrete class has a `kind` field with one literal value."""

    family: ClassVar[Family]
    source: ClassVar[str]
    states: ClassVar[tuple[State, ...]] = ()
    inputs: ClassVar[tuple[Port, ...]] = ()
    outputs: ClassVar[tuple[Port, ...]] = ()
    synaptic_output: ClassVar[str | None] = None

    output: ClassVar[Callable[..., Any] | None] = None
    """Outputs in the order of `outputs`: one number, or a tuple of several."""

    flow: ClassVar[Callable[..., Any] | None] = None
    """For each state, in order, the pair (drive, rate) of `dx/dt = drive - rate * x`, flattened to one tuple."""

    advance: ClassVar[Callable[..., Any] | None] = None
    """For states that no differential equation of the network moves: their values one body step later, in order.

    Evaluated once per body step (per network step where there is no body), with the inputs of its start. With an
    argument `duration` (s) the step is divided into equal parts that are no longer than the solver's `muscle_step`: it
    is evaluated for each of them, with the states of its start; `elapsed` (s) is the time since the start of the body
    step. What a component gives besides its states are the last of its `outputs`, which `output` then leaves out.
    """

    advanced_outputs: ClassVar[int] = 0
    """How many of the last outputs `advance` gives. They hold for the coming step; of its parts they are the mean."""

    @classmethod
    def kind_name(cls) -> str:
        """Return the word that a document uses for this class."""
        return str(get_args(cls.model_fields["kind"].annotation)[0])

    @classmethod
    def references(cls) -> dict[str, Reference]:
        """Return the fields that name other elements, with their marks."""
        found: dict[str, Reference] = {}
        for name, field in cls.model_fields.items():
            for mark in field.metadata:
                if isinstance(mark, Reference):
                    found[name] = mark
        return found


class Neuron(Component):
    """A neuron, or a population described by its mean activity. Synapses read `activity`."""

    family: ClassVar[Family] = "neuron"
    synaptic_output: ClassVar[str | None] = "activity"

    layer: Layer | None = None


class Drive(Component):
    """A tonic input from higher centres. Synapses read `signal`."""

    family: ClassVar[Family] = "drive"
    synaptic_output: ClassVar[str | None] = "signal"


class Sensor(Component):
    """Turns mechanics into a signal. Evaluated once per body step and held between. Synapses read `signal`."""

    family: ClassVar[Family] = "sensor"
    synaptic_output: ClassVar[str | None] = "signal"


class Path(Component):
    """The way of a muscle over its joints: gives length, velocity and moment arms."""

    family: ClassVar[Family] = "path"


class Muscle(Component):
    """Pulls along its path. Its outputs include `force`, `stiffness` (dF/dl) and `damping` (dF/dv)."""

    family: ClassVar[Family] = "muscle"
    applied_force: ClassVar[str] = "force"
    """The output (N) that acts on the joints during a body step."""

    def states_at_rest(self, length: float) -> dict[str, float]:
        """Return the states at time zero that depend on the length of the path (m); a muscle without such has none.

        Raises:
            ValueError: there is no such state; the text is a whole message.
        """
        del length
        return {}


class Synapse(Component):
    """A weighted connection into one input port of the receiving neuron."""

    family: ClassVar[Family] = "synapse"
    port: ClassVar[str]
    sign: ClassVar[Literal["excitatory", "inhibitory"]]
