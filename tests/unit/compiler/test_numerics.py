"""What compiled functions make of arithmetic."""

import numpy as np

from neuromech.compiler.numerics import compiled, exactly


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
