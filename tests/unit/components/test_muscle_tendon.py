"""The muscle–tendon unit against Dzeladini 2013 equations 2.1 to 2.30, and its integration against a fine one."""

from math import exp, isclose, log

import numba
import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from neuromech.compiler.numerics import elementwise
from neuromech.components.muscle_tendon import (
    MuscleTendonUnit,
    fibre_factor,
    force_length,
    force_velocity,
    velocity_of_force,
)
from neuromech.units import quantity

WIDTH, RESIDUAL, ECCENTRIC, CURVATURE, STRAIN = 0.56, 0.05, 1.5, 5.0, 0.04
PATH = {"kind": "lever_arms", "reference_length": "1 m"}
ARM = {"kind": "constant", "radius": "1 m", "reference_angle": "0 deg"}

# F_max (N), l_opt (m), l_slack (m), v_max (1/s) of table 2.2.
SIZES = {
    "HF": (2000.0, 0.11, 0.10, 12.0),
    "GLU": (1500.0, 0.11, 0.13, 12.0),
    "VAS": (6000.0, 0.08, 0.23, 12.0),
    "HAM": (3000.0, 0.10, 0.31, 12.0),
    "GAS": (1500.0, 0.05, 0.40, 12.0),
    "SOL": (4000.0, 0.04, 0.26, 6.0),
    "TA": (800.0, 0.06, 0.24, 12.0),
}
names = st.sampled_from(sorted(SIZES))
speeds = st.sampled_from([6.0, 12.0])


def unit(name, activation=0.01):
    force, optimal, slack, speed = SIZES[name]
    return MuscleTendonUnit(
        motoneuron="pool",
        path={**PATH, "arms": {"knee": ARM}},
        maximal_force=f"{force} N",
        optimal_length=f"{optimal} m",
        tendon_slack_length=f"{slack} m",
        maximal_velocity=f"{speed} 1/s",
        initial_activation=activation,
    )


@pytest.mark.parametrize("side", [-1.0, 1.0])
@pytest.mark.parametrize("name", SIZES)
def test_a_fibre_one_width_from_its_optimal_length_has_five_percent_of_its_force(name, side):
    optimal = SIZES[name][1]
    assert force_length(optimal * (1.0 + side * WIDTH), optimal, WIDTH, RESIDUAL) == pytest.approx(0.05, rel=1e-12)
    assert force_length(optimal, optimal, WIDTH, RESIDUAL) == 1.0


@pytest.mark.parametrize("fastest", [6.0, 12.0])
def test_force_velocity_relation_has_its_three_known_values(fastest):
    found = [force_velocity(v, fastest, CURVATURE, ECCENTRIC) for v in (-fastest, 0.0, fastest)]
    assert found == pytest.approx([0.0, 1.0, 1.5], abs=1e-12)


@given(speeds, st.floats(-1.0, 1.0))
def test_velocity_of_force_inverts_the_force_velocity_relation(fastest, share):
    velocity = share * fastest
    factor = force_velocity(velocity, fastest, CURVATURE, ECCENTRIC)
    assert velocity_of_force(factor, fastest, CURVATURE, ECCENTRIC) == pytest.approx(velocity, abs=1e-9 * fastest)


@given(speeds, st.floats(-5.0, 5.0))
def test_a_fibre_is_never_faster_than_its_fastest_whatever_the_force(fastest, factor):
    velocity = velocity_of_force(factor, fastest, CURVATURE, ECCENTRIC)
    assert -fastest <= velocity <= fastest * (1.0 + 1e-12)


def balance(name, fibre, length, activation):
    """Tendon plus buffer minus contractile and parallel element (eq. 2.2 at rest), in maximal forces."""
    _, optimal, slack, _ = SIZES[name]
    strain = (length - fibre - slack) / slack
    tendon = (strain / STRAIN) ** 2 if strain > 0.0 else 0.0
    short = optimal * (1.0 - WIDTH)
    buffer = ((short - fibre) / (0.5 * optimal * WIDTH)) ** 2 if fibre < short else 0.0
    parallel = ((fibre - optimal) / (optimal * WIDTH)) ** 2 if fibre > optimal else 0.0
    return tendon + buffer - parallel - activation * exp(log(0.05) * abs((fibre - optimal) / (optimal * WIDTH)) ** 3)


@given(names, st.floats(0.3, 2.0), st.floats(0.0, 1.0))
def test_a_run_starts_in_equilibrium(name, stretch, activation):
    """From a slack unit to a fibre of twice its optimal length, from no activation to full."""
    _, optimal, slack, _ = SIZES[name]
    length = slack + stretch * optimal
    assume(balance(name, length, length, activation) <= 0.0)
    fibre = unit(name, activation).states_at_rest(length)["fibre_length"]
    assert 0.0 < fibre <= length
    assert abs(balance(name, fibre, length, activation)) < 1e-9


@given(names, st.floats(0.7, 1.5), st.floats(0.01, 1.0))
def test_in_equilibrium_the_fibre_stands_still(name, stretch, activation):
    _, optimal, slack, speed = SIZES[name]
    length = slack + stretch * optimal
    fibre = unit(name, activation).states_at_rest(length)["fibre_length"]
    sizes = (optimal, slack, STRAIN, WIDTH, RESIDUAL, ECCENTRIC)
    factor = fibre_factor(activation, fibre, length, *sizes)
    assert abs(velocity_of_force(factor, speed, CURVATURE, ECCENTRIC)) < 1e-5 * speed


@pytest.mark.parametrize(
    ("slack", "length", "message"),
    [("230 mm", 0.2, "slack tendon alone is longer"), ("10 mm", 0.03, "shorter than the")],
)
def test_a_path_too_short_for_its_tendon_or_its_fibre_has_no_equilibrium(slack, length, message):
    vastus = unit("VAS").model_copy(update={"tendon_slack_length": quantity(slack)})
    with pytest.raises(ValueError, match=message):
        vastus.states_at_rest(length)


@given(names, st.floats(0.6, 1.4), st.floats(0.2, 1.0), st.floats(0.001, 0.03))
def test_forces_of_the_elements_add_up_to_that_of_the_tendon(name, share, activation, strain):
    """F_se = F_ce + F_pe − F_be (eq. 2.2) at any fibre length at which the fibre can hold the tendon."""
    force, optimal, slack, speed = SIZES[name]
    fibre = share * optimal
    length = fibre + slack * (1.0 + strain)
    shape = (WIDTH, RESIDUAL, CURVATURE, ECCENTRIC, STRAIN)
    total, _, _, active, relative, relative_length, velocity = MuscleTendonUnit.output(
        activation, fibre, length, force, optimal, slack, speed, *shape
    )
    f_v = force_velocity(velocity / optimal, speed, CURVATURE, ECCENTRIC)
    assume(0.0 < f_v < 1.49)
    contractile = activation * force_length(fibre, optimal, WIDTH, RESIDUAL) * f_v
    assert isclose(active, force * contractile, rel_tol=1e-6, abs_tol=1e-6 * force)
    parallel = (max(0.0, fibre - optimal) / (optimal * WIDTH)) ** 2 * f_v
    buffer = (max(0.0, 0.44 * optimal - fibre) / (0.28 * optimal)) ** 2
    assert relative == pytest.approx(contractile + parallel - buffer, abs=1e-6)
    assert (total, relative_length) == pytest.approx((force * relative, share))


@given(names, st.floats(0.5, 1.2), st.floats(0.0, 0.06))
def test_stiffness_is_the_slope_of_force_over_length(name, share, strain):
    force, optimal, slack, speed = SIZES[name]
    fibre = share * optimal
    length = fibre + slack * (1.0 + strain)
    shape = (WIDTH, RESIDUAL, CURVATURE, ECCENTRIC, STRAIN)

    def output(at):
        return MuscleTendonUnit.output(0.3, fibre, at, force, optimal, slack, speed, *shape)

    step = 1e-7 * slack
    assume(strain > 1e-6)
    slope = (output(length + step)[0] - output(length - step)[0]) / (2.0 * step)
    assert output(length)[1] == pytest.approx(slope, rel=1e-5)


advance = elementwise(MuscleTendonUnit.advance)


@numba.njit
def trial(tick, longest, force, optimal, slack, speed, fibre, base):
    """Mean force (N) in each millisecond of a stretch and a release at up to 0.17 m/s, while activity jumps twice.

    Length is piecewise linear with corners at whole milliseconds, so that nothing but the integration errs.
    """
    steps = round(1e-3 / tick)
    parts = max(1, round(tick / longest))
    found = np.zeros(300)
    activation, length = 0.01, base
    for k in range(300):
        velocity = 0.15 * np.sin(0.04 * k) + 0.02 * np.sin(0.31 * k)
        stimulation = 0.9 if 50 <= k < 180 else 0.02
        for _ in range(steps):
            for part in range(parts):
                activation, fibre, mean = advance(
                    activation, fibre, stimulation, length, velocity, force, optimal, slack, speed,
                    0.56, 0.05, 5.0, 1.5, 0.04, 0.01, tick / parts, part * tick / parts,
                )  # fmt: skip
                found[k] += mean / steps / parts
            length += velocity * tick
    return found


@pytest.fixture(scope="module")
def error():
    """A function: largest error of the mean force, in maximal forces, against steps of 2 µs."""

    def of(name, longest):
        base = SIZES[name][1] + SIZES[name][2]
        start = unit(name).states_at_rest(base)["fibre_length"]
        fine = trial(2e-6, 1.0, *SIZES[name], start, base)
        assert 0.3 < fine.max() / SIZES[name][0] < 3.0
        return np.abs(trial(1e-3, longest, *SIZES[name], start, base) - fine).max() / SIZES[name][0]

    return of


@pytest.mark.parametrize("name", ["VAS", "SOL", "GAS"])
def test_force_errs_by_less_than_a_hundredth_at_half_a_millisecond_and_a_thousandth_at_a_quarter(error, name):
    assert error(name, 0.5e-3) < 1e-2
    assert error(name, 0.25e-3) < 1e-3


def test_error_of_the_mean_force_falls_with_the_square_of_the_step(error):
    """The fibre is integrated to fourth order, its force averaged by the trapezoid rule, which is of second."""
    assert error("VAS", 0.125e-3) / error("VAS", 0.0625e-3) == pytest.approx(4.0, rel=0.15)
