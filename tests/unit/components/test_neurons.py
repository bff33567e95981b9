"""Equations of neurons against independent ones in the units of Habu 2020 (mV, ms, nS, pF), equations 5 to 11."""

import numpy as np
import pytest

from neuromech.components.neurons import RateNeuron, RybakInterneuron, RybakNeuron, StaticNeuron

TABLE_2_4 = {"Na": 55.0, "K": -80.0, "SynE": -10.0, "SynI": -70.0}
TABLE_2_3 = {"K": 4.5, "Leak": 1.6, "SynE": 10.0, "SynI": 10.0}
CAPACITANCE = 20.0
VOLTAGES = np.linspace(-85.0, 20.0, 43)


def currents(V, h, excitation, inhibition, g_NaP, E_leak):
    """Sum of the currents of equation 7 in pA."""
    m_K = 1 / (1 + np.exp(-(V + 44.5) / 5))
    m_NaP = 1 / (1 + np.exp(-(V + 47.1) / 3.1))
    return (
        g_NaP * m_NaP * h * (V - TABLE_2_4["Na"])
        + (TABLE_2_3["K"] * m_K**4 * (V - TABLE_2_4["K"]) if g_NaP else 0.0)
        + TABLE_2_3["Leak"] * (V - E_leak)
        + TABLE_2_3["SynE"] * (V - TABLE_2_4["SynE"]) * excitation
        + TABLE_2_3["SynI"] * (V - TABLE_2_4["SynI"]) * inhibition
    )


def slope_of_inactivation(V, h, tau_max):
    """Equation 10 in 1/ms."""
    return (1 / (1 + np.exp((V + 51) / 4)) - h) / (tau_max / np.cosh((V + 51) / 8))


def rybak_slopes(V, h, excitation, inhibition, neuron):
    values = {name: float(getattr(neuron, name)) for name in type(neuron).model_fields if name not in ("kind", "layer")}
    names = RybakNeuron.flow.__code__.co_varnames[: RybakNeuron.flow.__code__.co_argcount]
    given = {"potential": V / 1e3, "inactivation": h, "excitation": excitation, "inhibition": inhibition}
    drive, rate, h_drive, h_rate = RybakNeuron.flow(**{name: (values | given)[name] for name in names})
    return drive - rate * V / 1e3, h_drive - h_rate * h


@pytest.mark.parametrize(("g_NaP", "tau_max"), [(3.5, 300.0), (0.5, 600.0), (0.3, 600.0)], ids=["RG", "PF", "Mn"])
@pytest.mark.parametrize(("h", "excitation", "inhibition"), [(0.45, 0.0, 0.0), (0.1, 0.3, 0.02), (0.9, 0.05, 1.7)])
def test_rybak_neuron_follows_equations_5_and_7_to_10(g_NaP, tau_max, h, excitation, inhibition):
    # Defaults are those of tables 2-3 to 2-5.
    neuron = RybakNeuron(sodium_conductance=f"{g_NaP} nS", maximal_inactivation_time=f"{tau_max} ms")
    for V in VOLTAGES:
        V_slope, h_slope = rybak_slopes(V, h, excitation, inhibition, neuron)
        current = currents(V, h, excitation, inhibition, g_NaP, -64.0)
        assert V_slope == pytest.approx(-current / CAPACITANCE, rel=1e-9, abs=1e-9)  # pA/pF = mV/ms = V/s
        assert h_slope == pytest.approx(1e3 * slope_of_inactivation(V, h, tau_max), rel=1e-9, abs=1e-9)


@pytest.mark.parametrize(("excitation", "inhibition"), [(0.0, 0.0), (0.41, 0.0), (0.2, 0.8)])
def test_interneuron_follows_equation_6(excitation, inhibition):
    cell = RybakInterneuron()
    fields = ("capacitance", "leak_conductance", "excitatory_conductance", "inhibitory_conductance")
    fields += ("leak_reversal", "excitatory_reversal", "inhibitory_reversal")
    drive, rate = RybakInterneuron.flow(excitation, inhibition, *(float(getattr(cell, name)) for name in fields))
    for V in VOLTAGES:
        current = currents(V, 0.0, excitation, inhibition, 0.0, -60.0)
        assert drive - rate * V / 1e3 == pytest.approx(-current / CAPACITANCE, rel=1e-9, abs=1e-9)


@pytest.mark.parametrize(("half", "k"), [(-30.0, 8.0), (-40.0, 2.0)], ids=["RG PF In", "Mn"])
def test_activity_follows_equation_11(half, k):
    for V in VOLTAGES:
        expected = 1 / (1 + np.exp(-(V - half) / k)) if V >= -50.0 else 0.0
        assert RybakNeuron.output(V / 1e3, -0.05, half / 1e3, k / 1e3) == pytest.approx(expected, rel=1e-9)


def test_activity_starts_at_the_threshold_with_a_jump():
    below, at = (RybakNeuron.output(V, -0.05, -0.03, 0.008) for V in (np.nextafter(-0.05, -1.0), -0.05))
    assert below == 0.0
    assert at == pytest.approx(1 / (1 + np.exp(20 / 8)))


def test_rate_neuron_relaxes_to_its_logistic_function():
    drive, rate = RateNeuron.flow(0.7, 0.1, 0.02, 0.05, 0.5, 0.1)
    assert rate == pytest.approx(1 / 0.02)
    assert drive / rate == pytest.approx(1 / (1 + np.exp(-(0.7 - 0.1 + 0.05 - 0.5) / 0.1)))
    assert RateNeuron.output(0.3) == 0.3


@pytest.mark.parametrize(("net", "expected"), [(-1.0, 0.0), (0.0, 0.1), (0.2, 0.5), (5.0, 1.0)])
def test_static_neuron_is_a_line_cut_at_zero_and_one(net, expected):
    excitation, inhibition = max(net, 0.0) + 0.3, max(-net, 0.0) + 0.3
    assert StaticNeuron.output(excitation, inhibition, 2.0, 0.1) == pytest.approx(expected)
