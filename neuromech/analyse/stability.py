"""Measures of how a rhythm goes back to itself: Floquet multiplier, recovery after a perturbation."""

import numpy as np

from neuromech.analyse.contacts import footfalls
from neuromech.analyse.cycles import FEWEST_CYCLES
from neuromech.analyse.oscillation import reference_cycles
from neuromech.analyse.windows import Array, NotMeasurableError, View

LEAST_DEVIATION = 1e-9
"""Least standard deviation of a state at the section, relative to its largest size, that tells of its dynamics."""


def floquet_multiplier(view: View) -> float:
    """Return the largest |λ| of the map from cycle to cycle; below 1 the rhythm is stable, and the faster the less.

    The state x is that of `signals` at the start of each cycle, which is the touchdown of the foot in `feet` or the
    onset of `reference`. λ are the eigenvalues of J in x_{k+1} = J x_k + c, by least squares over all cycles; Hurmuzlu
    & Basdogan 1994, doi:10.1115/1.2895744. It tells most where the run holds the way back from a perturbation.
    """
    onsets = reference_cycles(view).onsets
    states = np.column_stack([signal.at(onsets) for signal in view.signals()])
    if len(states) - 1 < states.shape[1] + 1:
        raise NotMeasurableError(f"{len(states) - 1} cycles are too few for {states.shape[1]} signals")
    deviations = states - states.mean(axis=0)
    sizes = deviations.std(axis=0)
    if np.any(sizes <= LEAST_DEVIATION * np.abs(states).max(axis=0)):
        raise NotMeasurableError("the cycles do not differ")
    scaled = deviations / sizes
    before = np.column_stack((scaled[:-1], np.ones(len(scaled) - 1)))
    solution = np.linalg.lstsq(before, scaled[1:], rcond=None)[0]
    return float(np.max(np.abs(np.linalg.eigvals(solution[:-1]))))


def recovery_steps(view: View) -> float:
    """Return how many steps after `perturbed_at` the mean of `signal` in a step is back for good.

    A step goes from a touchdown of one of the `feet` to the next. Back is what lies within `tolerance` of the mean of
    the whole steps before the perturbation; zero where no step leaves it. The step in which the perturbation lies is
    the first. At least three steps must have passed before it, and the last three of the run must be back.
    """
    seen = view.signal()
    tolerance = view.argument("tolerance", seen.unit)
    starts = np.sort(np.concatenate([foot.touchdowns for foot in footfalls(view)]))
    if len(starts) <= FEWEST_CYCLES:
        raise NotMeasurableError("too few steps")
    means = np.diff(seen.integral(starts)) / np.diff(starts)
    disturbed = int(np.searchsorted(starts[1:], view.number("perturbed_at"), side="right"))
    return float(_steps_back(means, disturbed, tolerance))


def _steps_back(means: Array, disturbed: int, tolerance: float) -> int:
    if disturbed < FEWEST_CYCLES:
        raise NotMeasurableError("too few steps before the perturbation")
    outside = np.flatnonzero(np.abs(means[disturbed:] - means[:disturbed].mean()) > tolerance)
    back = 0 if len(outside) == 0 else int(outside[-1]) + 1
    if back > len(means) - disturbed - FEWEST_CYCLES:
        raise NotMeasurableError("not recovered")
    return back
