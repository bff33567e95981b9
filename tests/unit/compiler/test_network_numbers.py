"""The compiled network against programs of others, and the order of its methods."""

from pathlib import Path

import numpy as np
import pytest

from neuromech.pipeline import run

CAT = Path(__file__).parents[3] / "specs" / "cat"

# Period in ms of one leg's rhythm generator, by largest time constant of inactivation (ms) and drive, and of four
# coupled ones. From explicit Euler steps of 0.02 ms in a C program of others (equations 5-11, tables 2-3 to 2-6).
ONE_LEG = {(200, 2.05): 326, (300, 2.05): 451, (400, 2.05): 582, (600, 2.05): 833}
FOUR_LEGS = {(300, 1.5): 557, (300, 2.05): 456, (300, 2.5): 411}


def period(recording, signal="LF.RG-F.activity", after=3.0):
    """Mean time between upward crossings of half the largest value, interpolated between samples; s."""
    time, values = recording.signal(signal)
    time, values = time[time >= after], values[time >= after]
    level = 0.5 * values.max()
    up = np.flatnonzero((values[:-1] < level) & (values[1:] >= level))
    crossings = time[up] + (level - values[up]) / (values[up + 1] - values[up]) * (time[1] - time[0])
    return np.diff(crossings).mean()


def cat_period(name, tau, drive, *more, duration=8.0):
    changes = (f"parameters.drive.value={drive}", f"parameters.rhythm_time_constant.value={tau} ms", *more)
    return period(run(CAT / name, changes, duration=duration))


@pytest.mark.parametrize(("tau", "drive"), ONE_LEG)
def test_one_leg_has_the_period_that_others_found(tau, drive):
    assert 1e3 * cat_period("leg_cpg.yaml", tau, drive) == pytest.approx(ONE_LEG[tau, drive], rel=0.015)


@pytest.mark.parametrize(("tau", "drive"), FOUR_LEGS)
def test_four_coupled_legs_have_the_period_that_others_found(tau, drive):
    assert 1e3 * cat_period("quadruped_cpg.yaml", tau, drive) == pytest.approx(FOUR_LEGS[tau, drive], rel=0.015)


def euler_half_centre(dt, duration):
    """Activity of RG-F every step: equations 5 to 11 in mV, ms, nS and pF by explicit Euler steps; no body, one leg."""
    excitation, inhibition = np.zeros((4, 4)), np.zeros((4, 4))  # Of RG-F, RG-E, InRG-F, InRG-E, by [to, from].
    excitation[2, 0], excitation[3, 1] = 0.5, 0.41
    inhibition[1, 2] = inhibition[0, 3] = 0.87
    drive = 2.05 * np.array([0.024, 0.083, 0.0, 0.0])
    bursts = np.array([1.0, 1.0, 0.0, 0.0])
    leak = np.array([-64.0, -64.0, -60.0, -60.0])
    V, h = np.array([-60.0, -50.0, -60.0, -60.0]), np.full(4, 0.45)
    activity = np.empty(round(duration / dt))
    for step in range(len(activity)):
        f = np.where(V >= -50.0, 1 / (1 + np.exp(-(V + 30) / 8)), 0.0)
        activity[step] = f[0]
        m_NaP, m_K = 1 / (1 + np.exp(-(V + 47.1) / 3.1)), 1 / (1 + np.exp(-(V + 44.5) / 5))
        current = bursts * (3.5 * m_NaP * h * (V - 55) + 4.5 * m_K**4 * (V + 80)) + 1.6 * (V - leak)
        current += 10 * (V + 10) * (excitation @ f + drive) + 10 * (V + 70) * (inhibition @ f)
        h = h + dt * (1 / (1 + np.exp((V + 51) / 4)) - h) * np.cosh((V + 51) / 8) / 300
        V = V - dt * current / 20
    return activity


def test_kernel_agrees_with_twenty_lines_of_numpy():
    f = euler_half_centre(0.1, 3500.0)
    starts = np.flatnonzero((f[:-1] < 0.15) & (f[1:] >= 0.15)) * 0.1
    ours = cat_period("leg_cpg.yaml", 300, 2.05, "solver.step=0.1 ms", duration=6.0)
    assert 1e3 * ours == pytest.approx(np.diff(starts)[2:].mean(), rel=0.005)


def trajectories(document, method, step):
    """Potentials of all neurons every ms, without the threshold; (samples, neurons), V.

    The threshold of equation 11 makes the right-hand side jump where a potential crosses it. A step across the jump
    errs by its size times the part of the step after it, whatever the method, so no method is better than first order
    there. Far below all potentials it changes nothing but that.
    """
    neurons = "".join(f"        {name}: {{threshold: -1 V}}\n" for name in NEURONS)
    text = f"""\
extends: {CAT / "leg_cpg.yaml"}
modules:
  leg_cpg:
    network:
      neurons:
{neurons}
solver: {{method: {method}, step: {step} ms, relative_tolerance: 1e-11, absolute_tolerance: 1e-13}}
record: {{neurons: {{signals: ["*.potential"], every: 1 ms}}}}
claims: null
"""
    recording = run(document(text), duration=0.25)
    return np.column_stack([recording.signal(name)[1] for name in recording.names])


NEURONS = ["RG-F", "RG-E", *(f"PF{phase}" for phase in ("sw", "td", "st", "lo")), *(f"Mn{k}" for k in range(1, 7))]
NEURONS += ["InRG-F", "InRG-E", *(f"InPF{phase}" for phase in ("sw", "td", "st", "lo")), "Inab-E"]


def order(document, method, steps):
    """Slope of log error over log step, by linear regression; the reference is DOP853 with rtol 1e-11."""
    exact = trajectories(document, "dop853", 1)
    errors = [np.sqrt(np.mean((trajectories(document, method, step) - exact) ** 2)) for step in steps]
    return np.polyfit(np.log(steps), np.log(errors), 1)[0]


def test_runge_kutta_is_of_fourth_order_where_the_equations_are_smooth(document):
    assert order(document, "rk4", (0.5, 0.25, 0.125, 0.0625)) == pytest.approx(4.0, abs=0.2)


def test_exponential_euler_is_of_first_order(document):
    assert order(document, "exponential_euler", (0.25, 0.125, 0.0625)) == pytest.approx(1.0, abs=0.1)


def test_rush_larsen_is_of_second_order_with_one_evaluation_a_step(document):
    assert order(document, "rush_larsen", (0.25, 0.125, 0.0625)) == pytest.approx(2.0, abs=0.1)


@pytest.mark.parametrize("method", ["lsoda", "dop853"])
def test_adaptive_solvers_find_the_period_of_the_fixed_step(method):
    fixed = cat_period("leg_cpg.yaml", 300, 2.05, duration=5.0)
    adaptive = (f"solver.method={method}", "solver.relative_tolerance=1e-9")
    assert cat_period("leg_cpg.yaml", 300, 2.05, *adaptive, duration=5.0) == pytest.approx(fixed, rel=0.003)


# Period of the four coupled legs in s by step in ms; those of exponential Euler are from a program of others.
PERIODS = {
    "exponential_euler": {0.02: 0.4564, 0.1: 0.4569, 0.5: 0.4587, 1.0: 0.4603},
    "rk4": {0.1: 0.4564, 0.5: 0.4564, 1.0: 0.4563},
    "rush_larsen": {0.1: 0.4564, 0.5: 0.4566, 1.0: 0.4574},
}


PERIOD_TOLERANCE = {"exponential_euler": 1e-3, "rk4": 3e-4, "rush_larsen": 3e-4}


@pytest.mark.parametrize(("method", "step"), [(method, step) for method in PERIODS for step in PERIODS[method]])
def test_period_depends_on_the_step_as_others_found_and_hardly_with_runge_kutta(method, step):
    changes = (f"solver.method={method}", f"solver.step={step} ms")
    assert cat_period("quadruped_cpg.yaml", 300, 2.05, *changes, duration=6.0) == pytest.approx(
        PERIODS[method][step], rel=PERIOD_TOLERANCE[method]
    )


def test_lsoda_agrees_with_the_usual_step_on_the_period_of_four_legs():
    changes = ("solver.method=lsoda", "solver.relative_tolerance=1e-9")
    fixed = cat_period("quadruped_cpg.yaml", 300, 2.05, duration=5.0)
    assert cat_period("quadruped_cpg.yaml", 300, 2.05, *changes, duration=5.0) == pytest.approx(fixed, rel=0.003)
