"""Small numeric kernels that every compiled step shares, and the one way in which we compile."""

from collections.abc import Callable
from types import FunctionType
from typing import Any

import numba
import numpy as np
from numpy.typing import NDArray

from neuromech.compiler.exponential import cosh, exp, expm1, log
from neuromech.compiler.memory import NOTHING_COUNTED

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Places = NDArray[np.uint32]

# Not-a-number and infinity keep their meaning: divergence is looked for.
_FAST_MATH = {"contract", "arcp", "nsz", "afn", "reassoc"}

_WITH_LIBERTIES: dict[str, Any] = {"nogil": True, "error_model": "numpy", "fastmath": _FAST_MATH}

# What compiled code calls and is compiled with liberties always becomes part of its caller. A copy that stood beside it
# would round otherwise, and which copy of a function serves a process is decided by what that process compiled or
# loaded before.
_INLINED: dict[str, Any] = {"forceinline": True, **_WITH_LIBERTIES}

# Numba gives a function that says nothing about fast mathematics that of whichever function calls it first.
_AS_WRITTEN: dict[str, Any] = {"nogil": True, "error_model": "numpy", "fastmath": False}

# The wrapper for C, which nobody calls, takes a tenth of the time to compile a kernel; that for Python as much.
_KEPT: dict[str, Any] = {"cache": True, "no_cfunc_wrapper": True, **NOTHING_COUNTED}
_UNKNOWN_TO_PYTHON: dict[str, Any] = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True, **NOTHING_COUNTED}


def compiled(function: Callable[..., Any]) -> Any:
    """Compile a kernel on first call; releases the interpreter lock, keeps its machine code on disk."""
    return numba.njit(**_WITH_LIBERTIES, **_KEPT)(function)


def exactly(function: Callable[..., Any]) -> Any:
    """Compile a kernel as it is written, without fast mathematics: the same bits whatever it is inlined into."""
    return numba.njit(**_AS_WRITTEN, **_KEPT)(function)


def exact_part(function: Callable[..., Any]) -> Any:
    """Compile a function as it is written that always becomes part of its caller, a compiled one."""
    return numba.njit(forceinline=True, **_AS_WRITTEN, **_UNKNOWN_TO_PYTHON)(function)


def within(kernel: Any) -> Any:
    """Return a kernel that Python calls too as text of the compiled function that calls it: compiled but once."""
    return numba.jit(**{**kernel.targetoptions, **_UNKNOWN_TO_PYTHON}, inline="always")(kernel.py_func)


def equation(function: Callable[..., Any]) -> Any:
    """Compile a function that kernels call, and tests: nothing of it is kept on disk."""
    return numba.njit(**_INLINED, **NOTHING_COUNTED)(function)


def part(function: Callable[..., Any]) -> Any:
    """Compile a function that only compiled functions call; what Python needs to call it is left out."""
    return numba.njit(**_INLINED, **_UNKNOWN_TO_PYTHON)(function)


def elementwise(function: Callable[..., Any]) -> Any:
    """Compile an equation of a component so that a loop can evaluate it for several elements at once.

    The equation's own `exp`, `cosh` and `log` are exchanged for those of `neuromech.compiler.exponential`, and the
    functions of its module that it calls are compiled in the same way.
    """
    names = {**function.__globals__, "exp": exp, "cosh": cosh, "log": log}
    for name in function.__code__.co_names:
        helper = names.get(name)
        if isinstance(helper, FunctionType) and helper.__module__ == function.__module__:
            names[name] = elementwise(helper)
    own = FunctionType(function.__code__, names, function.__name__, function.__defaults__)
    return part(own)


def _in_order(function: Callable[..., Any]) -> Any:
    """Compile a function that is inlined and whose sums are not reordered: the same bits wherever it is called.

    Compilers would turn the loops below into gather instructions, which take three times as long.
    """
    return numba.njit(**{**_INLINED, "fastmath": {"contract"}}, **_UNKNOWN_TO_PYTHON)(function)


@_in_order
def sum_at(signals: Floats, places: Places) -> float:
    """Return the sum of signals at some places."""
    fourth = len(places) // 4
    a, b, c, d = 0.0, 0.0, 0.0, 0.0
    for k in range(fourth):
        a += signals[places[4 * k]]
        b += signals[places[4 * k + 1]]
        c += signals[places[4 * k + 2]]
        d += signals[places[4 * k + 3]]
    for k in range(4 * fourth, len(places)):
        a += signals[places[k]]
    return (a + b) + (c + d)


@_in_order
def weighted_sum_at(weights: Floats, signals: Floats, places: Places, shift: int, first: int, last: int) -> float:
    """Return the weighted sum of the signals at `places` from `first` to `last`; weights stand `shift` further on."""
    fourth = first + (last - first) // 4 * 4
    a, b, c, d = 0.0, 0.0, 0.0, 0.0
    for k in range(first, fourth, 4):
        a += weights[shift + k] * signals[places[k]]
        b += weights[shift + k + 1] * signals[places[k + 1]]
        c += weights[shift + k + 2] * signals[places[k + 2]]
        d += weights[shift + k + 3] * signals[places[k + 3]]
    for k in range(fourth, last):
        a += weights[shift + k] * signals[places[k]]
    return (a + b) + (c + d)


@equation
def copy_from(array: Floats, places: Integers, target: Floats) -> None:
    """Fill `target` with the numbers at some places of an array."""
    for k in range(len(target)):
        target[k] = array[places[k]]


@equation
def relaxed(value: float, drive: float, rate: float, dt: float) -> float:
    """Return x(t + dt) of dx/dt = drive − rate x with both held: the exact solution, also where rate is zero."""
    exponent = rate * dt
    held = dt if abs(exponent) < 1e-8 else -expm1(-exponent) / rate
    return value + held * (drive - rate * value)


@equation
def interpolate(t: float, start: int, count: int, times: int, values: int, p: Floats) -> float:
    """Return the piecewise linear function with `count` breakpoints at p[times + start…]; constant outside.

    Where two breakpoints have the same time, the later one holds from that time on.
    """
    last = start + count - 1
    if t >= p[times + last]:
        return float(p[values + last])
    k = start
    while k < last and p[times + k + 1] <= t:
        k += 1
    if t <= p[times + k]:
        return float(p[values + k])
    share = (t - p[times + k]) / (p[times + k + 1] - p[times + k])
    return float(p[values + k] + share * (p[values + k + 1] - p[values + k]))
