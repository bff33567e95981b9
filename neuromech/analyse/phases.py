"""Measures of several signals in one rhythm: phases, their order, gait."""

import numpy as np

from neuromech.analyse.contacts import footfalls
from neuromech.analyse.cycles import Cycles, onsets
from neuromech.analyse.oscillation import cycles_of, reference_cycles
from neuromech.analyse.windows import Array, NotMeasurableError, View, Window, in_unit

LEAST_LOCKING = 0.8
"""Least length of the mean of unit phase vectors, which is 1 for a constant phase and 0 for an arbitrary one."""

GAIT_TOLERANCE = 0.05

_GAITS = {
    "trot": (0.5, 0.5, 0.0),
    "pace": (0.5, 0.0, 0.5),
    "bound": (0.0, 0.5, 0.5),
    "pronk": (0.0, 0.0, 0.0),
}
"""Phases of RF, LH and RH after LF; Alexander 1984, doi:10.1177/027836498400300205."""

LATERAL_WALK, DIAGONAL_WALK = "lateral-sequence walk", "diagonal-sequence walk"
GALLOP = "gallop"
NO_GAIT = "no symmetrical gait"

GAITS = (*_GAITS, LATERAL_WALK, DIAGONAL_WALK, GALLOP, NO_GAIT)


def circular_mean(phases: Array) -> float:
    """Return the mean of phases on the circle, in 0…1 (1 excluded); Fisher 1993, Statistical Analysis of Circular Data.

    Raises:
        NotMeasurableError: there is no phase, or the phases have no common direction.
    """
    vectors = np.exp(2j * np.pi * phases)
    if len(vectors) == 0 or abs(np.mean(vectors)) < LEAST_LOCKING:
        raise NotMeasurableError("no phase locking")
    return float(np.angle(np.mean(vectors)) / (2.0 * np.pi) % 1.0) % 1.0


def circular_distance(phase: float, other: float) -> float:
    """Return the distance of two phases on the circle, in 0…0.5."""
    return abs((phase - other + 0.5) % 1.0 - 0.5)


def onset_phase(reference: Cycles, seen: Window) -> float:
    """Return where in the cycle a signal rises through half amplitude, in 0…1 after the reference's onset.

    Raises:
        NotMeasurableError: the signal keeps no phase to the reference.
    """
    return circular_mean(reference.phases(onsets(seen.time, seen.values))[1])


def center_phase(reference: Cycles, seen: Window) -> float:
    """Return where in the cycle the centre of a signal's activity lies, in 0…1 after the reference's onset.

    The centre of one cycle is the direction of Σ a exp(2πi φ), with the activity a above its minimum.

    Raises:
        NotMeasurableError: the signal is constant, or keeps no phase to the reference.
    """
    index, phases = reference.phases(seen.time)
    first = int(np.searchsorted(seen.time, reference.onsets[0]))
    weights = (seen.values - seen.values.min())[first : first + len(index)]
    size = len(reference.durations)
    cosine = np.bincount(index, weights * np.cos(2.0 * np.pi * phases), minlength=size)
    sine = np.bincount(index, weights * np.sin(2.0 * np.pi * phases), minlength=size)
    active = np.hypot(cosine, sine) > 0.0
    return circular_mean(np.arctan2(sine[active], cosine[active]) / (2.0 * np.pi))


def phase(view: View) -> float:
    """Return the phase of `signal` in the cycle of `reference` or the stride of the foot in `feet`, in 0…1.

    Circular mean over cycles.

    `event` chooses what the phase is about: `onset` (see `onset_phase`) or `center` (see `center_phase`).
    """
    reference = reference_cycles(view)
    return (onset_phase if view.spec.event == "onset" else center_phase)(reference, view.signal())


def phase_order(view: View) -> str:
    """Return `signals` in the order of their activity centres after the onset of a cycle: `PFlo < PFsw < PFtd`.

    Cycles are those of `reference`, or the strides of the foot in `feet`.
    """
    reference = reference_cycles(view)
    seen = view.signals()
    labels = _labels([signal.name for signal in seen])
    found = sorted((center_phase(reference, signal), label) for signal, label in zip(seen, labels, strict=True))
    return " < ".join(label for _, label in found)


def interlimb_phase(view: View) -> float:
    """Return when the second of two `feet` touches down in the stride of the first, circular mean, in 0…1."""
    return _onset_phases(view)[0]


def interlimb_phases(view: View) -> str:
    """Return the phases of the other `feet` or `signals` after the first, two digits each: `0.50 0.50 0.00`.

    A phase is that of the touchdown of a foot, or of the rise of a signal through half amplitude.
    """
    return " ".join(f"{round(value, 2) % 1.0:.2f}" for value in _onset_phases(view))


def gait(view: View) -> str:
    """Return the gait of four `feet` or `signals` in the order left fore, right fore, left hind, right hind.

    Phases are those of `interlimb_phases`. `trot`, `pace`, `bound` and `pronk` where all phases are within `tolerance`
    (0.05 where none is given) of the ideal; `lateral-sequence walk` and `diagonal-sequence walk` where only fore and
    hind pairs alternate (Hildebrand 1965, doi:10.1126/science.150.3697.701); `gallop` where the limbs of neither pair
    alternate or move together (Hildebrand 1977, doi:10.2307/1379571); else `no symmetrical gait`.
    """
    phases = _onset_phases(view)
    if len(phases) != 3:
        raise NotMeasurableError("a gait takes four signals")
    tolerance = GAIT_TOLERANCE if view.spec.tolerance is None else in_unit(view.spec.tolerance, "", "tolerance")
    for name, ideal in _GAITS.items():
        if all(circular_distance(p, q) <= tolerance for p, q in zip(phases, ideal, strict=True)):
            return name
    return _gait_of_pairs(phases, tolerance)


def _gait_of_pairs(phases: list[float], tolerance: float) -> str:
    right_fore, left_hind, right_hind = phases
    lags = circular_distance(right_fore, 0.0), circular_distance(right_hind, left_hind)
    if all(lag >= 0.5 - tolerance for lag in lags):
        return LATERAL_WALK if left_hind > 0.5 else DIAGONAL_WALK
    if all(tolerance < lag < 0.5 - tolerance for lag in lags):
        return GALLOP
    return NO_GAIT


def _onset_phases(view: View) -> list[float]:
    if view.spec.feet is not None:
        leader, *followers = footfalls(view)
        strides = leader.strides().cycles
        return [circular_mean(strides.phases(foot.strides().cycles.onsets)[1]) for foot in followers]
    first, *others = view.signals()
    reference = cycles_of(view, first)
    for signal in others:
        cycles_of(view, signal)
    return [onset_phase(reference, signal) for signal in others]


def _labels(names: list[str]) -> list[str]:
    """Return the element's own name without its scope, or the qualified name where scopes differ."""
    elements = [name.rpartition(".")[0] for name in names]
    own = [element.rpartition(".")[2] for element in elements]
    return own if len({element.rpartition(".")[0] for element in elements}) == 1 else elements
