"""The muscle against Habu 2020 equations 1 to 4, its slopes against finite differences."""

from math import exp, log

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from neuromech.components.muscles import BrownMuscle

F_MAX, L_OPT, L_V = 380.0, 0.0695, 0.100

# Computed by others from tables 2-2, 3-1 and 3-2 with equations 2 and 4:
# F_max (N), L_v (mm), L_opt (mm), k_stiff in RG-F and RG-E phase; F_l, F_p in RG-F and RG-E phase (N) at L_v.
STANDING = {
    "scapula flexor": (400, 55, 43.0, 13.8, 22.8, 0.694, 478.9, 786.0),
    "scapula extensor": (200, 60, 55.0, 2.76, 2.52, 0.970, 5.1, 5.0),
    "scapula-shoulder": (300, 54, 41.0, 0.92, 0.92, 0.611, 54.1, 54.1),
    "shoulder extensor": (450, 64, 54.0, 1.15, 0.46, 0.866, 16.0, 11.8),
    "elbow flexor": (200, 126, 98.0, 11.5, 2.13, 0.680, 226.8, 45.3),
    "shoulder-elbow": (380, 100, 69.5, 1.91, 1.8, 0.340, 846.1, 797.8),
    "hip flexor": (400, 96, 75.0, 11.7, 6.91, 0.692, 414.4, 248.0),
    "hip extensor": (200, 60, 52.0, 12.1, 0.92, 0.909, 21.5, 5.3),
    "hip-knee": (300, 121, 92.0, 1.42, 1.29, 0.615, 77.8, 71.2),
    "knee extensor": (450, 76, 62.0, 9.75, 5.68, 0.799, 141.6, 86.3),
    "ankle flexor": (200, 75, 60.0, 7.16, 2.25, 0.753, 73.6, 25.9),
    "knee-ankle": (360, 104, 80.0, 2.12, 1.88, 0.649, 104.1, 93.1),
}


def outputs(length, velocity, activation=0.6, flexor=0.3, k=(1.91, 1.8), scale=1.0, passive_scale=1.0, gain=1.2):
    """Force, stiffness, damping, active and passive force, of a muscle with the extensor half at activity 0.2."""
    sizes = (F_MAX, L_OPT, L_V)
    return BrownMuscle.output(activation, flexor, 0.2, length, velocity, *sizes, *k, scale, passive_scale, gain)


def thesis(length, velocity, activation=0.6, k=1.91, gain=1.2):
    """Equations 1 to 4 as printed."""
    relative, v = length / L_OPT, velocity / L_V
    s = -5.34 * relative**2 + 8.41 * relative - 4.7
    F_l = exp(-(abs((relative**2.3 - 1) / 1.26) ** 2.0))
    F_v = (-0.69 - 0.17 * v) / (v - 0.69) if v < 0 else (0.18 - s * v) / (v + 0.18)
    F_p = k * log(exp((relative - 1.4) / 0.05) + 1.0) - 0.02 * (exp(-18.7 * (relative - 0.3)) - 1.0)
    return F_MAX * (gain * activation * F_l * F_v + F_p)


lengths = st.floats(0.5, 1.7).map(lambda relative: relative * L_OPT)
velocities = st.floats(-4.0, 8.0).map(lambda relative: relative * L_V)


@given(lengths, velocities, st.floats(0.0, 1.0))
def test_force_is_that_of_equations_1_to_4(length, velocity, activation):
    force, _, _, active, passive = outputs(length, velocity, activation)
    assert force == pytest.approx(thesis(length, velocity, activation), rel=1e-9)
    assert force == pytest.approx(active + passive)
    assert passive == pytest.approx(thesis(length, velocity, 0.0), rel=1e-9)


@pytest.mark.parametrize("name", STANDING)
def test_force_of_the_standing_cat_is_what_others_computed(name):
    F_max, L_v, L_opt, k_flexion, k_extension, F_l, passive_flexion, passive_extension = STANDING[name]
    sizes = (F_max, L_opt / 1e3, L_v / 1e3, k_flexion, k_extension, 1.0, 1.0, 1.0)
    _, _, _, active, passive = BrownMuscle.output(1.0, 0.3, 0.2, L_v / 1e3, 0.0, *sizes)
    assert active / F_max == pytest.approx(F_l, abs=6e-4)
    assert passive == pytest.approx(passive_flexion, abs=0.06)
    assert BrownMuscle.output(0.0, 0.2, 0.3, L_v / 1e3, 0.0, *sizes)[4] == pytest.approx(passive_extension, abs=0.06)


def test_active_force_is_the_maximal_one_at_optimal_length_and_no_velocity():
    assert outputs(L_OPT, 0.0, activation=1.0, gain=1.0)[3] == pytest.approx(F_MAX)
    assert all(outputs(L_OPT + d, 0.0)[3] < outputs(L_OPT, 0.0)[3] for d in (-1e-4, 1e-4))


def test_the_more_active_half_chooses_the_passive_stiffness():
    length = 1.5 * L_OPT
    in_flexion, in_extension = outputs(length, 0.0, flexor=0.3)[4], outputs(length, 0.0, flexor=0.1)[4]
    assert in_flexion == pytest.approx(thesis(length, 0.0, 0.0, k=1.91))
    assert in_extension == pytest.approx(thesis(length, 0.0, 0.0, k=1.8))
    assert outputs(length, 0.0, flexor=0.2)[4] == in_extension  # Neither is the more active one.


def test_scales_multiply_what_they_are_named_after():
    length = 1.5 * L_OPT
    assert outputs(length, 0.0, scale=0.05)[4] == pytest.approx(thesis(length, 0.0, 0.0, k=0.05 * 1.91))
    assert outputs(length, 0.0, passive_scale=0.3)[4] == pytest.approx(0.3 * outputs(length, 0.0)[4])
    assert outputs(length, 0.0, gain=2.4)[3] == pytest.approx(2.0 * outputs(length, 0.0, gain=1.2)[3])


@given(st.floats(0.3, 1.8), st.floats(-20.0, 20.0), st.floats(0.0, 1.0))
def test_a_muscle_never_pushes(length, velocity, activation):
    force, _, damping, active, passive = outputs(length * L_OPT, velocity * L_V, activation)
    assert force >= 0.0
    assert active >= 0.0
    assert passive >= -1e-12 * F_MAX
    assert damping >= 0.0


@given(lengths)
def test_force_velocity_relation_is_continuous_at_rest(length):
    shortening, lengthening = (outputs(length, v)[3] for v in (-1e-12, 1e-12))
    assert shortening == pytest.approx(outputs(length, 0.0)[3], rel=1e-9)
    assert lengthening == pytest.approx(outputs(length, 0.0)[3], rel=1e-9)


def test_active_force_ends_where_the_force_velocity_relation_crosses_zero():
    zero = -0.69 / 0.17 * L_V
    assert outputs(L_OPT, 0.999 * zero)[3] > 0.0
    _, _, damping, active, _ = outputs(L_OPT, 1.001 * zero)
    assert active == 0.0
    assert damping == 0.0


@given(lengths, velocities, st.floats(0.0, 1.0), st.booleans())
def test_slopes_are_those_of_the_force(length, velocity, activation, flexes):
    """On both branches of the force-velocity relation and beyond its cut, but not across them."""
    breaks = (0.0, -0.69 / 0.17 * L_V)
    assume(all(abs(velocity - at) > 1e-5 for at in breaks))
    flexor = 0.3 if flexes else 0.1

    def force(length, velocity):
        return outputs(length, velocity, activation, flexor)[0]

    _, stiffness, damping, _, _ = outputs(length, velocity, activation, flexor)
    h = 1e-6
    by_length = (force(length + h, velocity) - force(length - h, velocity)) / (2 * h)
    by_velocity = (force(length, velocity + h) - force(length, velocity - h)) / (2 * h)
    assert stiffness == pytest.approx(by_length, rel=1e-4, abs=1e-3 * F_MAX / L_OPT)
    assert damping == pytest.approx(by_velocity, rel=1e-4, abs=1e-3)


@pytest.mark.parametrize("relative", [1e-3, 0.3, 1.0, 3.0, 40.0])
def test_far_lengths_give_finite_numbers(relative):
    assert all(abs(number) < 1e9 for number in outputs(relative * L_OPT, 0.0))
