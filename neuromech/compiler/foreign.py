"""Calls of C functions by address from compiled code.

The address is data, an int64 that the caller reads from an array, so the machine code holds none of it and may be kept
on disk: another process finds the same function elsewhere. Neither calls nor loads check anything; what an address
points to, and for how long, is the caller's business.
"""

from typing import Any

from llvmlite import ir
from numba.core import types
from numba.extending import intrinsic

ADDRESS = types.int64
INT = types.int32
DOUBLE = types.float64
NOTHING = types.void


def foreign_function(result: Any, *arguments: Any) -> Any:
    """Return what calls C functions of one signature from compiled code: `call(address, (first, second, …))`.

    Args:
        result: type of the result, `NOTHING` without one.
        arguments: types of the arguments; integers and floats are converted to them. Pointers are `ADDRESS`.
    """

    @intrinsic
    def call(_typing: Any, address: Any, values: Any) -> Any:
        if len(values) != len(arguments):
            return None

        def generate(context: Any, builder: Any, signature: Any, given: Any) -> Any:
            pointer, packed = given
            passed = [
                context.cast(builder, builder.extract_value(packed, place), source, target)
                for place, (source, target) in enumerate(zip(signature.args[1], arguments, strict=True))
            ]
            returned = ir.VoidType() if result is NOTHING else context.get_value_type(result)
            kind = ir.FunctionType(returned, [context.get_value_type(argument) for argument in arguments])
            value = builder.call(builder.inttoptr(pointer, kind.as_pointer()), passed)
            return context.get_dummy_value() if result is NOTHING else value

        return result(types.int64, values), generate

    return call


def _load(kind: Any) -> Any:
    @intrinsic
    def load(_typing: Any, _address: Any) -> Any:
        def generate(context: Any, builder: Any, _signature: Any, given: Any) -> Any:
            return builder.load(builder.inttoptr(given[0], context.get_value_type(kind).as_pointer()))

        return kind(types.int64), generate

    return load


load_double = _load(DOUBLE)
load_int = _load(INT)
load_address = _load(ADDRESS)
