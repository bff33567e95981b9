"""Units of reflex controllers: relays that are gated, thresholds, latches, sample-and-hold, first-order units.

A reflex is a chain of connections through such units, each of them an element of the graph: a sensor, a delayed
synapse, a gated relay that is open in one phase of the cycle, a weighted synapse, a motoneuron.
"""

from typing import Annotated, ClassVar, Literal

from neuromech.components.base import Neuron, Port, State, Synapse
from neuromech.units import DIMENSIONLESS, TIME, Dimensionless, Quantity, quantity

_EXCITATION = Port("excitation", "")
_INHIBITION = Port("inhibition", "")
_GATE = Port("gate", "")
_ACTIVITY = Port("activity", "")


class GatingSynapse(Synapse):
    """Opens the gate of a gated relay or of a sample-and-hold unit by weight × activity."""

    kind: Literal["gating"] = "gating"
    source: ClassVar[str] = "Dzeladini 2013, table 2.4: the phases st, st_end, sw and Fb_g as factors"
    port: ClassVar[str] = "gate"
    sign: ClassVar[Literal["excitatory", "inhibitory"]] = "excitatory"

    weight: Annotated[Quantity, DIMENSIONLESS.non_negative]
    delay: Annotated[Quantity, TIME.non_negative] = quantity("0 ms")


class GatedRelay(Neuron):
    """Sum of its inputs times the sum of its gates, without limits: closed while nothing opens its gate."""

    kind: Literal["gated_relay"] = "gated_relay"
    source: ClassVar[str] = "Dzeladini 2013 eq. 2.39, table 2.4: one weighted feedback term of one phase"
    inputs: ClassVar[tuple[Port, ...]] = (_EXCITATION, _INHIBITION, _GATE)
    outputs: ClassVar[tuple[Port, ...]] = (_ACTIVITY,)

    bias: Dimensionless = quantity("0")

    @staticmethod
    def output(excitation: float, inhibition: float, gate: float, bias: float) -> float:
        """Return gate × (excitation − inhibition + bias)."""
        return gate * (excitation - inhibition + bias)


class ThresholdUnit(Neuron):
    """1 while its input is above a threshold, else 0; such as the stance phase of a leg."""

    kind: Literal["threshold_unit"] = "threshold_unit"
    source: ClassVar[str] = "McCulloch & Pitts 1943, doi:10.1007/BF02478259"
    inputs: ClassVar[tuple[Port, ...]] = (_EXCITATION, _INHIBITION)
    outputs: ClassVar[tuple[Port, ...]] = (_ACTIVITY,)

    threshold: Dimensionless

    @staticmethod
    def output(excitation: float, inhibition: float, threshold: float) -> float:
        """Return 1 or 0."""
        return 1.0 if excitation - inhibition > threshold else 0.0


class LatchUnit(Neuron):
    """Becomes 1 when its input is above one threshold, 0 when it is below another, and keeps its value between."""

    kind: Literal["latch_unit"] = "latch_unit"
    source: ClassVar[str] = "Schmitt 1938, doi:10.1088/0950-7671/15/1/305"
    states: ClassVar[tuple[State, ...]] = (State("latched", "", "initially_on"),)
    inputs: ClassVar[tuple[Port, ...]] = (_EXCITATION, _INHIBITION)
    outputs: ClassVar[tuple[Port, ...]] = (_ACTIVITY,)

    on_above: Dimensionless
    off_below: Dimensionless
    initially_on: Annotated[Quantity, DIMENSIONLESS.within(0.0, 1.0)] = quantity("0")

    @staticmethod
    def output(latched: float, excitation: float, inhibition: float, on_above: float, off_below: float) -> float:
        """Return 1 or 0; where both thresholds are crossed, 1."""
        value = excitation - inhibition
        return 1.0 if value > on_above else 0.0 if value < off_below else latched

    advance = output


class SampleAndHold(Neuron):
    """Passes its input on while its gate is open, and afterwards keeps the value that it had last."""

    kind: Literal["sample_and_hold"] = "sample_and_hold"
    source: ClassVar[str] = "Dzeladini 2013, table 2.4: the lean of the trunk at take-off"
    states: ClassVar[tuple[State, ...]] = (State("held", "", "initial_value"),)
    inputs: ClassVar[tuple[Port, ...]] = (_EXCITATION, _INHIBITION, _GATE)
    outputs: ClassVar[tuple[Port, ...]] = (_ACTIVITY,)

    initial_value: Dimensionless = quantity("0")

    @staticmethod
    def output(held: float, excitation: float, inhibition: float, gate: float) -> float:
        """Return excitation − inhibition while the gate is above one half, else the value that is held."""
        return excitation - inhibition if gate > 0.5 else held

    advance = output


class LowPass(Neuron):
    """First-order low pass of its input, without limits: synapses to it and from it are a first-order connection."""

    kind: Literal["low_pass"] = "low_pass"
    source: ClassVar[str] = "Dzeladini 2013 eq. 2.34 with f − F for f, first order"
    states: ClassVar[tuple[State, ...]] = (State("level", "", "initial_level"),)
    inputs: ClassVar[tuple[Port, ...]] = (_EXCITATION, _INHIBITION)
    outputs: ClassVar[tuple[Port, ...]] = (_ACTIVITY,)

    time_constant: Annotated[Quantity, TIME.positive]
    initial_level: Dimensionless = quantity("0")

    @staticmethod
    def flow(excitation: float, inhibition: float, time_constant: float) -> tuple[float, float]:
        """Return drive and rate (1/s) of the level."""
        return (excitation - inhibition) / time_constant, 1.0 / time_constant

    @staticmethod
    def output(level: float) -> float:
        """Return the level."""
        return level


class SaturatingNeuron(Neuron):
    """First-order rate neuron whose input is cut to 0 … 1, so that its rate never leaves that range."""

    kind: Literal["saturating_neuron"] = "saturating_neuron"
    source: ClassVar[str] = "Dzeladini 2013 eq. 2.39 and 2.40"
    states: ClassVar[tuple[State, ...]] = (State("rate", "", "initial_rate"),)
    inputs: ClassVar[tuple[Port, ...]] = (_EXCITATION, _INHIBITION)
    outputs: ClassVar[tuple[Port, ...]] = (_ACTIVITY,)

    time_constant: Annotated[Quantity, TIME.positive]
    bias: Dimensionless = quantity("0")
    initial_rate: Annotated[Quantity, DIMENSIONLESS.within(0.0, 1.0)] = quantity("0")

    @staticmethod
    def flow(excitation: float, inhibition: float, time_constant: float, bias: float) -> tuple[float, float]:
        """Return drive and rate (1/s) of the firing rate."""
        return min(1.0, max(0.0, excitation - inhibition + bias)) / time_constant, 1.0 / time_constant

    @staticmethod
    def output(rate: float) -> float:
        """Return the firing rate as activity."""
        return rate
