"""Sine and cosine that a loop can evaluate for several angles at once; the library's cannot be.

With n the nearest whole number to 2 x/π and r = x − n π/2 both are polynomials in r on |r| ≤ π/4, those of fdlibm
(https://www.netlib.org/fdlibm), exchanged and with signs as n says. Nothing is fused or reordered, so that the bits
are the same on every machine. Errors stay below 3e-16 up to 1000 rad (measured by a test).
"""

from neuromech.compiler.exponential import ROUNDER, bits
from neuromech.compiler.numerics import exact_part

_TWO_OVER_PI = 0.6366197723675814
# π/2 in three parts, of which the first two have so few digits that their products with n are exact.
_FIRST = 1.57079632673412561417
_SECOND = 6.07710050630396597660e-11
_THIRD = 2.02226624879595063154e-21


@exact_part
def sine_and_cosine(x: float) -> tuple[float, float]:
    """Return the sine and the cosine of an angle in rad; not numbers where it is none."""
    shifted = x * _TWO_OVER_PI + ROUNDER
    n = shifted - ROUNDER
    r = ((x - n * _FIRST) - n * _SECOND) - n * _THIRD
    z = r * r
    s = 1.58969099521155010221e-10
    s = s * z - 2.50507602534068634195e-08
    s = s * z + 2.75573137070700676789e-06
    s = s * z - 1.98412698298579493134e-04
    s = s * z + 8.33333333332248946124e-03
    s = s * z - 1.66666666666666324348e-01
    s = r + r * z * s
    c = -1.13596475577881948265e-11
    c = c * z + 2.08757232129817482790e-09
    c = c * z - 2.75573143513906633035e-07
    c = c * z + 2.48015872894767294178e-05
    c = c * z - 1.38888888888741095749e-03
    c = c * z + 4.16666666666666019037e-02
    c = 1.0 - (0.5 * z - z * z * c)
    quarter = bits(shifted) & 3
    sine = c if quarter & 1 else s
    cosine = s if quarter & 1 else c
    return -sine if quarter & 2 else sine, -cosine if (quarter + 1) & 2 else cosine
