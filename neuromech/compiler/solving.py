"""Symmetric systems of the size of a body, solved in place."""

from neuromech.compiler.numerics import Floats, Integers, equation, part
from neuromech.compiler.tree import FREE_ROOT


@equation
def solve_symmetric(matrix: Floats, first: Integers, vector: Floats) -> None:
    """Solve A x = b in place for a symmetric positive definite A (n, n) given by its lower triangle; b becomes x.

    `first` (n,) is the column of the first number of each row that may differ from zero: the factors L D Lᵀ have zeros
    in the same places, so nothing is done there (Jennings 1966, doi:10.1093/comjnl/9.3.281). A becomes its factors.
    """
    n = vector.shape[0]
    _factorise(matrix, first, vector, 0, n)
    _substitute_back(matrix, first, vector)


@equation
def solve_under_free_root(matrix: Floats, first: Integers, vector: Floats) -> None:
    """Do the same where the last six rows are full and those above fall into short blocks, as joints under a free root.

    What six rows share with all others is taken off their own block column by column: the number of steps is known when
    this is compiled, so that nothing has to be counted.
    """
    n = vector.shape[0] - FREE_ROOT
    _factorise(matrix, first, vector, 0, n)
    for j in range(n):
        for k in range(first[j], j):
            for a in range(FREE_ROOT):
                matrix[n + a, j] -= matrix[j, k] * matrix[n + a, k]
        for a in range(FREE_ROOT):
            factor = matrix[j, j] * matrix[n + a, j]
            vector[n + a] -= factor * vector[j]
            for b in range(a + 1):
                matrix[n + a, n + b] -= factor * matrix[n + b, j]
    for a in range(FREE_ROOT):
        for j in range(n):
            matrix[n + a, j] *= matrix[j, j]
    _factorise(matrix, first, vector, n, n + FREE_ROOT)
    _substitute_back(matrix, first, vector)


@part
def _factorise(matrix: Floats, first: Integers, vector: Floats, begin: int, end: int) -> None:
    """Make factors of the rows from `begin` to `end` as if those before were not there, the pivots inverted."""
    for i in range(begin, end):
        start = max(first[i], begin)
        for j in range(start, i):
            total = matrix[i, j]
            for k in range(max(start, first[j]), j):
                total -= matrix[i, k] * matrix[j, k]
            matrix[i, j] = total
        pivot = matrix[i, i]
        for j in range(start, i):
            factor = matrix[i, j] * matrix[j, j]
            pivot -= factor * matrix[i, j]
            matrix[i, j] = factor
            vector[i] -= factor * vector[j]
        matrix[i, i] = 1.0 / pivot


@part
def _substitute_back(matrix: Floats, first: Integers, vector: Floats) -> None:
    n = vector.shape[0]
    for i in range(n):
        vector[i] *= matrix[i, i]
    for i in range(n - 1, -1, -1):
        for j in range(first[i], i):
            vector[j] -= matrix[i, j] * vector[i]
