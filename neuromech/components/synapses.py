"""Synapses and drives: how signals reach a neuron's input ports."""

from typing import Annotated, ClassVar, Literal

from neuromech.components.base import Drive, Port, Synapse
from neuromech.units import DIMENSIONLESS, FORCE, INVERSE_FORCE, TIME, Dimensionless, Quantity, quantity


class _ConductanceSynapse(Synapse):
    source: ClassVar[str] = "Habu 2020 eq. 7"

    weight: Annotated[Quantity, DIMENSIONLESS.non_negative]
    delay: Annotated[Quantity, TIME.non_negative] = quantity("0 ms")


class ExcitatorySynapse(_ConductanceSynapse):
    """Adds weight × activity to the excitatory conductance of the receiver (a and c of eq. 7)."""

    kind: Literal["excitatory"] = "excitatory"
    port: ClassVar[str] = "excitation"
    sign: ClassVar[Literal["excitatory", "inhibitory"]] = "excitatory"


class InhibitorySynapse(_ConductanceSynapse):
    """Adds weight × activity to the inhibitory conductance of the receiver (b of eq. 7)."""

    kind: Literal["inhibitory"] = "inhibitory"
    port: ClassVar[str] = "inhibition"
    sign: ClassVar[Literal["excitatory", "inhibitory"]] = "inhibitory"


class InterlimbSynapse(_ConductanceSynapse):
    """Inhibition between the rhythm generators of two limbs (α and β of eq. 7)."""

    kind: Literal["interlimb"] = "interlimb"
    port: ClassVar[str] = "inhibition"
    sign: ClassVar[Literal["excitatory", "inhibitory"]] = "inhibitory"


class DescendingDrive(Drive):
    """Tonic drive from the brain stem (d of eq. 7)."""

    kind: Literal["descending_drive"] = "descending_drive"
    source: ClassVar[str] = "Habu 2020 eq. 7"
    outputs: ClassVar[tuple[Port, ...]] = (Port("signal", ""),)

    strength: Dimensionless

    @staticmethod
    def output(strength: float) -> float:
        """Return the strength as the signal."""
        return strength


class FictiveLoad(Drive):
    """A constant load on a leg that is not there, as leg-load feedback would report it."""

    kind: Literal["fictive_load"] = "fictive_load"
    source: ClassVar[str] = "Habu 2020 eq. 14 with a constant force"
    outputs: ClassVar[tuple[Port, ...]] = (Port("signal", ""),)

    force: Annotated[Quantity, FORCE.non_negative]
    gain: Annotated[Quantity, INVERSE_FORCE.non_negative]

    @staticmethod
    def output(force: float, gain: float) -> float:
        """Return feedback₂ = gain × force."""
        return gain * force
