"""Memory of compiled code: no line of the cache is shared, stretches are views, and nothing is allocated."""

import numpy as np
import pytest
from numba.core.errors import NumbaError

from neuromech.compiler.memory import apart
from neuromech.compiler.numerics import compiled
from neuromech.compiler.span import places_of, span_of

LINES = 128


@pytest.mark.parametrize("shape", [(1,), (17,), (3, 5), (2, 3, 3)])
@pytest.mark.parametrize("dtype", [np.float64, np.int64])
def test_arrays_apart_hold_the_same_numbers_in_lines_of_their_own(shape, dtype):
    values = np.arange(np.prod(shape), dtype=dtype).reshape(shape)
    found = [apart(values) for _ in range(20)]
    lines = [{(one.ctypes.data + byte) // LINES for byte in range(one.nbytes)} for one in found]
    assert all(np.array_equal(one, values) and one.dtype == dtype and one.flags.c_contiguous for one in found)
    assert sum(map(len, lines)) == len(set().union(*lines))
    assert all(one.ctypes.data % LINES == 0 for one in found)


def test_writing_to_a_stretch_writes_to_the_buffer():
    def fill(buffer, numbers):
        stretch, where = span_of(buffer, 2, 3), places_of(numbers, 1, 3)
        for k in range(stretch.shape[0]):
            stretch[k] = 10.0 + where[k]
        return where.shape[0]

    buffer = np.zeros(6)
    assert compiled(fill)(buffer, np.array([0, 4, 5, 6])) == 3
    assert buffer.tolist() == [0.0, 0.0, 14.0, 15.0, 16.0, 0.0]


def test_a_kernel_that_allocates_is_refused():
    def allocate(count):
        return np.zeros(count).sum()

    with pytest.raises(NumbaError, match=r"No implementation of function .*zeros"):
        compiled(allocate)(3)
