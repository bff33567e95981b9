"""Threads that share the rows of a large network inside a compiled step.

One thread runs the step; the others wait in compiled code for rows to sum. Whoever is free takes the next rows, and a
row is summed by the same code in the same order, so that results are the same bits with any number of threads. Numba's
own parallel loops are no choice: their threads serve one caller at a time, and some of them do not survive a fork.
"""

import os
from typing import Any

from llvmlite import ir
from numba.core import types
from numba.extending import intrinsic

from neuromech.compiler.numerics import equation

_WORD = ir.IntType(64)

# Positions in the section `team` of the integer buffer, a cache line apart where several threads write.
ORDER, FIRST, LAST, NEXT, DONE, HELPERS, SIZE = 0, 1, 2, 8, 16, 24, 32
STOP = -1
PART = 64
"""Rows that a thread takes at a time."""

_TURNS = 2048

_rest = types.ExternalFunction("sched_yield" if os.name == "posix" else "SwitchToThread", types.int32())


@intrinsic
def load(_typing: Any, _address: Any) -> Any:
    """Return the integer at an address, seen in the order in which all threads see it."""

    def generate(_context: Any, builder: Any, _signature: Any, given: Any) -> Any:
        return builder.load_atomic(builder.inttoptr(given[0], _WORD.as_pointer()), "seq_cst", 8)

    return types.int64(types.int64), generate


@intrinsic
def store(_typing: Any, _address: Any, _value: Any) -> Any:
    """Write the integer at an address, with all that was written before."""

    def generate(context: Any, builder: Any, _signature: Any, given: Any) -> Any:
        builder.store_atomic(given[1], builder.inttoptr(given[0], _WORD.as_pointer()), "seq_cst", 8)
        return context.get_dummy_value()

    return types.void(types.int64, types.int64), generate


@intrinsic
def add(_typing: Any, _address: Any, _value: Any) -> Any:
    """Add to the integer at an address in one go, and return what it was."""

    def generate(_context: Any, builder: Any, _signature: Any, given: Any) -> Any:
        pointer = builder.inttoptr(given[0], _WORD.as_pointer())
        return builder.atomic_rmw("add", pointer, given[1], "seq_cst")

    return types.int64(types.int64, types.int64), generate


@equation
def rest_now_and_then(turns: int) -> int:
    """Count the turns of a thread that waits; let another thread of the machine run after many of them."""
    if turns < _TURNS:
        return turns + 1
    _rest()
    return 0
