"""What compiled functions make of arithmetic."""

import numpy as np
import pytest

from neuromech.compiler.numerics import compiled, exactly
from neuromech.compiler.sines import sine_and_cosine


@exactly
def scalar_product(a, b):
    total = 0.0
    for k in range(len(a)):
        total += a[k] * b[k]
    return total


@compiled
def twice(a, b):
    return 2.0 * scalar_product(a, b)


def test_a_function_as_written_stays_so_where_fast_mathematics_calls_it_first():
    # Numba hands the liberties of the first caller on to a function that says nothing about them.
    random = np.random.default_rng(0)
    a, b = random.normal(size=(2, 40))
    total = 0.0
    for first, second in zip(a.tolist(), b.tolist(), strict=True):
        total += first * second
    assert twice(a, b) == 2.0 * total
    assert scalar_product(a, b) == total


@compiled
def sines_and_cosines(angles, sines, cosines):
    for k in range(len(angles)):
        sines[k], cosines[k] = sine_and_cosine(angles[k])


def test_sine_and_cosine_are_those_of_the_library():
    random = np.random.default_rng(1)
    angles = np.concatenate([random.uniform(-1e3, 1e3, 200_000), np.arange(-8, 9) * np.pi / 4, [0.0, -0.0, 1e-300]])
    sines, cosines = np.zeros((2, len(angles)))
    sines_and_cosines(angles, sines, cosines)
    assert np.abs(sines - np.sin(angles)).max() < 3e-16
    assert np.abs(cosines - np.cos(angles)).max() < 3e-16
    small = np.abs(angles) < 0.1
    assert sines[small] == pytest.approx(np.sin(angles[small]), rel=3e-16, abs=0.0)


def test_what_is_no_angle_has_no_sine():
    angles, sines, cosines = np.array([np.nan, np.inf, -np.inf]), np.zeros(3), np.zeros(3)
    sines_and_cosines(angles, sines, cosines)
    assert np.isnan(sines).all()
    assert np.isnan(cosines).all()


def test_each_angle_has_the_same_bits_alone_and_among_others():
    angles = np.linspace(-7.0, 7.0, 37)
    sines, cosines = np.zeros((2, 37))
    sines_and_cosines(angles, sines, cosines)
    for k in range(37):
        one, other = np.zeros((2, 1))
        sines_and_cosines(angles[k : k + 1], one, other)
        assert (one[0], other[0]) == (sines[k], cosines[k])
