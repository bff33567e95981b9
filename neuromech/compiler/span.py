"""Stretches of a buffer for compiled code, without what a slice checks: an end beyond the buffer, a negative number.

Lowering has placed every stretch inside its buffer. A body step looks at some two hundred of them.
"""

from typing import Any

from numba.core import types
from numba.extending import intrinsic
from numba.np import arrayobj

_arrays: Any = arrayobj


def _stretch(dtype: Any) -> Any:
    """Return what gives a stretch of a contiguous array as an array: `stretch(array, start, count)`."""

    @intrinsic
    def stretch(_context: Any, array: Any, _start: Any, _count: Any) -> Any:
        result = array if dtype is None else array.copy(dtype=dtype)

        def generate(context: Any, builder: Any, signature: Any, given: Any) -> Any:
            buffer = _arrays.make_array(signature.args[0])(context, builder, given[0])
            made = _arrays.make_array(signature.return_type)(context, builder)
            size = context.get_constant(types.intp, context.get_abi_sizeof(context.get_data_type(result.dtype)))
            data = builder.gep(buffer.data, [given[1]])
            _arrays.populate_array(made, data=data, shape=[given[2]], strides=[size], itemsize=size, meminfo=None)
            return made._getvalue()

        return result(array, types.intp, types.intp), generate

    return stretch


span_of = _stretch(None)
places_of = _stretch(types.uint64)
"""Integers that are only used as places in other arrays, where no place is negative."""
