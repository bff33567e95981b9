"""Energy of passive mechanics on the exact hinge: what the coupling adds is bounded and falls with the step."""

import numpy as np
import pytest
from rods import ARM, GRAVITY, INERTIA, MASS, START_DEGREES, rod
from scipy.integrate import cumulative_trapezoid

from neuromech.pipeline import run

WEIGHT = MASS * GRAVITY * ARM
FALLEN = WEIGHT * (1.0 - np.cos(np.radians(START_DEGREES)))


@pytest.fixture
def energy(document):
    """A function: kinetic and potential energy of rod and spring (J) over time, the spring's as ∫F dl."""

    def of(**choices):
        recording = run(document(rod(**choices)))
        names = ("hinge.angle", "hinge.velocity", "spring.length", "spring.passive_force")
        q, v, length, force = (recording.signal(name)[1] for name in names)
        spring = cumulative_trapezoid(force, length, initial=0.0)
        return 0.5 * INERTIA * v**2 + WEIGHT * (1.0 - np.cos(q)) + spring

    return of


@pytest.mark.parametrize("coupling", ["observer_implicit", "explicit"])
@pytest.mark.parametrize("step", [0.25, 2])
def test_energy_of_a_pendulum_is_conserved_to_rounding(energy, step, coupling):
    assert np.abs(energy(step=step, passive=0, coupling=coupling) - FALLEN).max() < 1e-12 * FALLEN


def test_energy_of_a_pendulum_on_a_spring_drifts_by_less_than_two_and_a_half_percent(energy):
    """In 3 s at 1 ms, about six swings, while the spring stores nearly all of the energy twice in each."""
    total = energy(step=1)
    assert np.abs(total - FALLEN).max() < 0.025 * FALLEN


def test_that_drift_is_of_first_order_in_the_step(energy):
    steps = (1.0, 0.5, 0.25, 0.125)
    drifts = [np.abs(energy(step=step) - FALLEN).max() for step in steps]
    assert np.polyfit(np.log(steps), np.log(drifts), 1)[0] == pytest.approx(1.0, abs=0.1)


def test_a_damper_takes_the_energy_that_it_takes_at_any_step(energy):
    """At 2 ms, of the third of the energy that a damper takes in 3 s, at most a thousandth more or less."""
    damping = "2 mN m s/rad"
    coarse, fine = (energy(step=step, passive=0, damping=damping)[-1] for step in (2, 0.125))
    assert 0.3 < 1.0 - fine / FALLEN < 0.4
    assert coarse == pytest.approx(fine, abs=1e-3 * (FALLEN - fine))


def test_a_damper_far_too_stiff_for_the_step_lets_the_rod_creep(document):
    """The damping rate d/I is 3.6e4 1/s; the rod creeps at v = torque of gravity / d, as it would with any step."""
    damping = 500.0
    recording = run(document(rod(passive=0, damping=f"{damping} N m s/rad", duration=0.2)))
    _, velocity = recording.signal("hinge.velocity")
    creep = -WEIGHT * np.sin(np.radians(START_DEGREES)) / damping
    assert velocity[20:] == pytest.approx(creep, rel=1e-3)


def test_the_explicit_scheme_does_not_survive_that_damper(document):
    recording = run(document(rod(passive=0, damping="500 N m s/rad", duration=0.2, coupling="explicit")))
    assert recording.outcome.kind == "diverged"
