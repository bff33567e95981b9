"""Measures of one oscillating signal: rhythm, period, centre, amplitude, settling."""

from dataclasses import dataclass

import numpy as np

from neuromech.analyse.contacts import footfalls
from neuromech.analyse.cycles import NO_RHYTHM, Cycles, bursts, cycles
from neuromech.analyse.windows import Array, NotMeasurableError, View, Window

LEAST_AMPLITUDE = 0.01
"""Least span from minimum to maximum of a rhythm, in SI units of the signal, where a measure names none."""

FINAL_CYCLES = 3


def cycles_of(view: View, seen: Window) -> Cycles:
    """Return the cycles of a signal, with the least amplitude that the measure names.

    Raises:
        MeasureError: `least_amplitude` does not fit the signal's unit.
        NotMeasurableError: there is no rhythm.
    """
    least = LEAST_AMPLITUDE
    if view.spec.least_amplitude is not None:
        least = view.argument("least_amplitude", seen.unit)
    return cycles(seen.time, seen.values, least)


def reference_cycles(view: View) -> Cycles:
    """Return the cycles that a measure refers to: strides of the foot in its `feet`, or cycles of its `reference`.

    Raises:
        MeasureError: neither is given, or as for `cycles_of` and `footfalls`.
        NotMeasurableError: there is no rhythm, or there are too few strides.
    """
    if view.spec.feet is not None:
        return footfalls(view)[0].strides().cycles
    return cycles_of(view, view.reference())


def period(view: View) -> float:
    """Return the median duration of the cycles of `signal` (s), from rise to rise through half amplitude."""
    return cycles_of(view, view.signal()).period


def rhythm(view: View) -> str:
    """Return `rhythm` or `no rhythm`.

    A rhythm spans at least `least_amplitude` (0.01 of the signal's SI unit where none is given) from minimum to
    maximum, has at least three cycles, and goes on to the end of the run.
    """
    seen = view.signal()
    try:
        cycles_of(view, seen)
    except NotMeasurableError:
        return NO_RHYTHM
    return "rhythm"


def center(view: View) -> float:
    """Return the centre of oscillation: (max + min) / 2 in each cycle, averaged over cycles; unit of the signal.

    Cycles are the strides of the foot in `feet` or the cycles of `reference` where one is given, else those of
    `signal` itself.
    """
    found = _extremes_by_cycle(view)
    return float(np.mean(found.centers))


def amplitude(view: View) -> float:
    """Return half the span from minimum to maximum of each cycle, averaged over cycles; cycles as for `center`."""
    found = _extremes_by_cycle(view)
    return float(np.mean(found.high - found.low) / 2.0)


def cycle_range(view: View) -> float:
    """Return the span from minimum to maximum of each cycle, averaged over cycles; cycles as for `center`."""
    return 2.0 * amplitude(view)


def settling_time(view: View) -> float:
    """Return the time (s) from the start of the window to the first cycle from which the centre stays settled.

    Settled means that the centre of each cycle (see `center`) lies within `tolerance` of its final value, which is
    the mean over the last three cycles. A signal that leaves this band in one of the last three cycles, or that
    enters it with them, is not settled.
    """
    found = _extremes_by_cycle(view)
    tolerance = view.argument("tolerance", found.signal.unit)
    if len(found.centers) <= FINAL_CYCLES:
        raise NotMeasurableError("too few cycles to settle")
    outside = np.flatnonzero(np.abs(found.centers - np.mean(found.centers[-FINAL_CYCLES:])) > tolerance)
    first = 0 if len(outside) == 0 else int(outside[-1]) + 1
    if first >= len(found.centers) - FINAL_CYCLES:
        raise NotMeasurableError("not settled")
    return float(found.starts[first] - found.signal.time[0])


def burst_duration(view: View) -> float:
    """Return the median duration (s) of the stretches that `signal` spends above `level`, whole ones only."""
    seen = view.signal()
    found = bursts(seen.time, seen.values, view.argument("level", seen.unit))
    whole = [burst.duration for burst in found if burst.onset > seen.time[0] and burst.end < seen.time[-1]]
    if not whole:
        raise NotMeasurableError("no burst")
    return float(np.median(whole))


@dataclass(frozen=True, slots=True)
class _Extremes:
    """A signal with start (s), minimum and maximum of each cycle, shape (n,)."""

    signal: Window
    starts: Array
    low: Array
    high: Array

    @property
    def centers(self) -> Array:
        return (self.low + self.high) / 2.0


def _extremes_by_cycle(view: View) -> _Extremes:
    seen = view.signal()
    alone = view.spec.reference is None and view.spec.feet is None
    found = cycles_of(view, seen) if alone else reference_cycles(view)
    slices = found.slices(seen.time)
    if len(slices) < len(found.durations):
        raise NotMeasurableError("a cycle holds no sample")
    low = np.array([seen.values[part].min() for part in slices])
    high = np.array([seen.values[part].max() for part in slices])
    return _Extremes(seen, found.onsets[:-1], low, high)
