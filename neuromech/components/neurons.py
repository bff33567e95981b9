"""Neurons: activity-based Hodgkin–Huxley populations, rate neurons, static units."""

from math import cosh, exp
from typing import Annotated, ClassVar, Literal

from neuromech.components.base import Neuron, Port, State
from neuromech.units import (
    CAPACITANCE,
    CONDUCTANCE,
    DIMENSIONLESS,
    TIME,
    VOLTAGE,
    Dimensionless,
    Quantity,
    Voltage,
    quantity,
)

_EXCITATION = Port("excitation", "")
_INHIBITION = Port("inhibition", "")
_ACTIVITY = Port("activity", "")


class ActivityBasedNeuron(Neuron):
    """What the two activity-based neurons share: leak, synaptic currents and the activity function.

    Synaptic input is a sum of weighted activities, drives and feedback signals; it multiplies a maximal conductance
    (Habu 2020 eq. 7).
    """

    inputs: ClassVar[tuple[Port, ...]] = (_EXCITATION, _INHIBITION)
    outputs: ClassVar[tuple[Port, ...]] = (_ACTIVITY,)

    capacitance: Annotated[Quantity, CAPACITANCE.positive] = quantity("20 pF")
    leak_conductance: Annotated[Quantity, CONDUCTANCE.positive] = quantity("1.6 nS")
    excitatory_conductance: Annotated[Quantity, CONDUCTANCE.non_negative] = quantity("10 nS")
    inhibitory_conductance: Annotated[Quantity, CONDUCTANCE.non_negative] = quantity("10 nS")
    leak_reversal: Voltage = quantity("-64 mV")
    excitatory_reversal: Voltage = quantity("-10 mV")
    inhibitory_reversal: Voltage = quantity("-70 mV")
    threshold: Voltage = quantity("-50 mV")
    half_activity_potential: Voltage = quantity("-30 mV")
    activity_slope: Annotated[Quantity, VOLTAGE.positive] = quantity("8 mV")
    initial_potential: Voltage = quantity("-60 mV")

    @staticmethod
    def output(potential: float, threshold: float, half_activity_potential: float, activity_slope: float) -> float:
        """Return the mean activity f(V) in 0…1: a logistic function, zero below the threshold (Habu 2020 eq. 11)."""
        if potential < threshold:
            return 0.0
        return 1.0 / (1.0 + exp(-(potential - half_activity_potential) / activity_slope))


class RybakNeuron(ActivityBasedNeuron):
    """Population with persistent sodium and delayed-rectifier potassium current, able to burst by itself."""

    kind: Literal["rybak_neuron"] = "rybak_neuron"
    source: ClassVar[str] = "Habu 2020 eq. 5, 7–11; Markin et al. 2010, doi:10.1111/j.1749-6632.2010.05435.x"
    states: ClassVar[tuple[State, ...]] = (
        State("potential", "mV", "initial_potential"),
        State("inactivation", "", "initial_inactivation"),
    )

    sodium_conductance: Annotated[Quantity, CONDUCTANCE.non_negative]
    potassium_conductance: Annotated[Quantity, CONDUCTANCE.non_negative] = quantity("4.5 nS")
    sodium_reversal: Voltage = quantity("55 mV")
    potassium_reversal: Voltage = quantity("-80 mV")
    sodium_activation_half: Voltage = quantity("-47.1 mV")
    sodium_activation_slope: Annotated[Quantity, VOLTAGE.positive] = quantity("3.1 mV")
    potassium_activation_half: Voltage = quantity("-44.5 mV")
    potassium_activation_slope: Annotated[Quantity, VOLTAGE.positive] = quantity("5 mV")
    sodium_inactivation_half: Voltage = quantity("-51 mV")
    sodium_inactivation_slope: Annotated[Quantity, VOLTAGE.positive] = quantity("4 mV")
    maximal_inactivation_time: Annotated[Quantity, TIME.positive]
    inactivation_time_slope: Annotated[Quantity, VOLTAGE.positive] = quantity("8 mV")
    initial_inactivation: Annotated[Quantity, DIMENSIONLESS.within(0.0, 1.0)] = quantity("0.45")

    @staticmethod
    def flow(
        potential: float,
        inactivation: float,
        excitation: float,
        inhibition: float,
        capacitance: float,
        leak_conductance: float,
        excitatory_conductance: float,
        inhibitory_conductance: float,
        leak_reversal: float,
        excitatory_reversal: float,
        inhibitory_reversal: float,
        sodium_conductance: float,
        potassium_conductance: float,
        sodium_reversal: float,
        potassium_reversal: float,
        sodium_activation_half: float,
        sodium_activation_slope: float,
        potassium_activation_half: float,
        potassium_activation_slope: float,
        sodium_inactivation_half: float,
        sodium_inactivation_slope: float,
        maximal_inactivation_time: float,
        inactivation_time_slope: float,
    ) -> tuple[float, float, float, float]:
        """Return drive and rate of potential (V/s, 1/s) and of inactivation (1/s, 1/s); Habu 2020 eq. 5 and 7–10."""
        m_sodium = 1.0 / (1.0 + exp(-(potential - sodium_activation_half) / sodium_activation_slope))
        m_potassium = 1.0 / (1.0 + exp(-(potential - potassium_activation_half) / potassium_activation_slope))
        g_sodium = sodium_conductance * m_sodium * inactivation
        g_potassium = potassium_conductance * (m_potassium * m_potassium) * (m_potassium * m_potassium)
        g_excitatory = excitatory_conductance * excitation
        g_inhibitory = inhibitory_conductance * inhibition
        current = (
            g_sodium * sodium_reversal
            + g_potassium * potassium_reversal
            + leak_conductance * leak_reversal
            + g_excitatory * excitatory_reversal
            + g_inhibitory * inhibitory_reversal
        )
        conductance = g_sodium + g_potassium + leak_conductance + g_excitatory + g_inhibitory
        shifted = potential - sodium_inactivation_half
        steady = 1.0 / (1.0 + exp(shifted / sodium_inactivation_slope))
        rate = cosh(shifted / inactivation_time_slope) / maximal_inactivation_time
        return current / capacitance, conductance / capacitance, steady * rate, rate


class RybakInterneuron(ActivityBasedNeuron):
    """Population with leak and synaptic currents only."""

    kind: Literal["rybak_interneuron"] = "rybak_interneuron"
    source: ClassVar[str] = "Habu 2020 eq. 6, 7, 11; Markin et al. 2010, doi:10.1111/j.1749-6632.2010.05435.x"
    states: ClassVar[tuple[State, ...]] = (State("potential", "mV", "initial_potential"),)

    leak_reversal: Voltage = quantity("-60 mV")

    @staticmethod
    def flow(
        excitation: float,
        inhibition: float,
        capacitance: float,
        leak_conductance: float,
        excitatory_conductance: float,
        inhibitory_conductance: float,
        leak_reversal: float,
        excitatory_reversal: float,
        inhibitory_reversal: float,
    ) -> tuple[float, float]:
        """Return drive (V/s) and rate (1/s) of the potential; Habu 2020 eq. 6 and 7."""
        g_excitatory = excitatory_conductance * excitation
        g_inhibitory = inhibitory_conductance * inhibition
        current = (
            leak_conductance * leak_reversal + g_excitatory * excitatory_reversal + g_inhibitory * inhibitory_reversal
        )
        return current / capacitance, (leak_conductance + g_excitatory + g_inhibitory) / capacitance


class RateNeuron(Neuron):
    """First-order rate neuron with a logistic activation."""

    kind: Literal["rate_neuron"] = "rate_neuron"
    source: ClassVar[str] = "Wilson & Cowan 1972, doi:10.1016/S0006-3495(72)86068-5, one population, no refractory term"
    states: ClassVar[tuple[State, ...]] = (State("rate", "", "initial_rate"),)
    inputs: ClassVar[tuple[Port, ...]] = (_EXCITATION, _INHIBITION)
    outputs: ClassVar[tuple[Port, ...]] = (_ACTIVITY,)

    time_constant: Annotated[Quantity, TIME.positive]
    bias: Dimensionless = quantity("0")
    half_activity_input: Dimensionless = quantity("0.5")
    activity_slope: Annotated[Quantity, DIMENSIONLESS.positive] = quantity("0.1")
    initial_rate: Annotated[Quantity, DIMENSIONLESS.within(0.0, 1.0)] = quantity("0")

    @staticmethod
    def flow(
        excitation: float,
        inhibition: float,
        time_constant: float,
        bias: float,
        half_activity_input: float,
        activity_slope: float,
    ) -> tuple[float, float]:
        """Return drive and rate (1/s) of the firing rate in 0…1."""
        drive = excitation - inhibition + bias - half_activity_input
        return 1.0 / (1.0 + exp(-drive / activity_slope)) / time_constant, 1.0 / time_constant

    @staticmethod
    def output(rate: float) -> float:
        """Return the firing rate as activity."""
        return rate


class StaticNeuron(Neuron):
    """Instantaneous unit: a weighted sum clipped to 0…1. A loop of such units is an algebraic loop."""

    kind: Literal["static_neuron"] = "static_neuron"
    source: ClassVar[str] = "McCulloch & Pitts 1943, doi:10.1007/BF02478259, with a linear range"
    inputs: ClassVar[tuple[Port, ...]] = (_EXCITATION, _INHIBITION)
    outputs: ClassVar[tuple[Port, ...]] = (_ACTIVITY,)

    gain: Dimensionless = quantity("1")
    bias: Dimensionless = quantity("0")

    @staticmethod
    def output(excitation: float, inhibition: float, gain: float, bias: float) -> float:
        """Return the activity in 0…1."""
        return min(1.0, max(0.0, gain * (excitation - inhibition) + bias))
