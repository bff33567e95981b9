"""Exponential and logarithm that a loop can evaluate for several elements at once; the library's cannot be.

exp(x) = 2ⁿ exp(r) with n the nearest whole number to x/ln 2, and exp(r) by its Taylor polynomial on |r| ≤ ln(2)/2.
log(x) = e ln 2 + log(m) with x = m 2ᵉ and m within 1/√2…√2, and log(m) = 2 artanh((m − 1)/(m + 1)) by its series.
Errors stay below 3e-16, relative for exp and absolute or relative for log (measured by a test over the whole range).
Beyond ±708 the argument of exp is cut.
"""

import struct
from collections.abc import Callable
from math import nan
from typing import Any

import numba
from llvmlite import ir
from numba.core import types
from numba.extending import intrinsic

from neuromech.compiler.memory import NOTHING_COUNTED

# Adding this to a number smaller than 2⁵¹ leaves its nearest whole number in the lowest bits of the sum.
ROUNDER = 6755399441055744.0
_LOG2_E = 1.4426950408889634
_LN2_HIGH = 0.693147180369123816490
_LN2_LOW = 1.90821492927058770002e-10
_LARGEST = 708.0
_EXPONENT_BITS = 52
_EXPONENT_BIAS = 1023
_MANTISSA_MASK = (1 << _EXPONENT_BITS) - 1
_ONE_BITS = _EXPONENT_BIAS << _EXPONENT_BITS
_ROUNDER_BITS = struct.unpack("<q", struct.pack("<d", ROUNDER))[0]
_SQRT_2 = 1.4142135623730951


def _reinterpreted(result: Any, argument: Any, kind: Any) -> Any:
    """Return what reads the bits of one type as another, in compiled code."""

    @intrinsic
    def reinterpret(_context: Any, _value: Any) -> Any:
        def generate(_context: Any, builder: Any, _signature: Any, arguments: Any) -> Any:
            return builder.bitcast(arguments[0], kind)

        return result(argument), generate

    return reinterpret


bits = _reinterpreted(types.int64, types.float64, ir.IntType(64))
_from_bits = _reinterpreted(types.float64, types.int64, ir.DoubleType())


def _inlined(function: Callable[[float], Any]) -> Any:
    # Sums must not be reordered here: adding and subtracting the rounder is the point.
    options = {**NOTHING_COUNTED, "forceinline": True}
    return numba.njit(nogil=True, error_model="numpy", fastmath={"contract"}, **options)(function)


@_inlined
def _parts(x: float) -> tuple[float, float]:
    """Return exp(r) − 1 and 2ⁿ of x = n ln 2 + r."""
    cut = min(max(x, -_LARGEST), _LARGEST)
    shifted = cut * _LOG2_E + ROUNDER
    n = shifted - ROUNDER
    r = (cut - n * _LN2_HIGH) - n * _LN2_LOW
    q = 1.0 / 479001600.0
    q = q * r + 1.0 / 39916800.0
    q = q * r + 1.0 / 3628800.0
    q = q * r + 1.0 / 362880.0
    q = q * r + 1.0 / 40320.0
    q = q * r + 1.0 / 5040.0
    q = q * r + 1.0 / 720.0
    q = q * r + 1.0 / 120.0
    q = q * r + 1.0 / 24.0
    q = q * r + 1.0 / 6.0
    q = q * r + 0.5
    q = q * r + 1.0
    return q * r, float(_from_bits((bits(shifted) + _EXPONENT_BIAS) << _EXPONENT_BITS))


@_inlined
def exp(x: float) -> float:
    """Return e to the power of x."""
    rest, power = _parts(x)
    return float((rest + 1.0) * power)


# exp(x) − 1 = 2ⁿ (exp(r) − 1) + (2ⁿ − 1): for small x n is zero, and nothing cancels.
@_inlined
def expm1(x: float) -> float:
    """Return e to the power of x, minus one."""
    rest, power = _parts(x)
    return float(power * rest + (power - 1.0))


@_inlined
def log(x: float) -> float:
    """Return the natural logarithm of x; not a number for a negative x, and −708 or less for zero."""
    pattern = bits(x)
    mantissa = float(_from_bits((pattern & _MANTISSA_MASK) | _ONE_BITS))
    # The exponent is put into the low bits of the rounder, which turns it into a float by one subtraction.
    exponent = float(_from_bits((pattern >> _EXPONENT_BITS) + _ROUNDER_BITS)) - (ROUNDER + _EXPONENT_BIAS)
    large = mantissa > _SQRT_2
    mantissa = 0.5 * mantissa if large else mantissa
    exponent = exponent + 1.0 if large else exponent
    f = (mantissa - 1.0) / (mantissa + 1.0)
    s = f * f
    q = 1.0 / 21.0
    q = q * s + 1.0 / 19.0
    q = q * s + 1.0 / 17.0
    q = q * s + 1.0 / 15.0
    q = q * s + 1.0 / 13.0
    q = q * s + 1.0 / 11.0
    q = q * s + 1.0 / 9.0
    q = q * s + 1.0 / 7.0
    q = q * s + 1.0 / 5.0
    q = q * s + 1.0 / 3.0
    q = q * s + 1.0
    value = exponent * _LN2_HIGH + (exponent * _LN2_LOW + 2.0 * f * q)
    return value if x >= 0.0 else nan


@_inlined
def cosh(x: float) -> float:
    """Return the hyperbolic cosine of x."""
    power: float = exp(x)
    return 0.5 * (power + 1.0 / power)
