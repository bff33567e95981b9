"""Signals against reference curves over one cycle."""

import numpy as np

from neuromech.analyse.contacts import footfalls
from neuromech.analyse.levels import pearson
from neuromech.analyse.windows import View


def curve_correlation(view: View) -> float:
    """Return the least correlation of a signal and its reference curve over the last whole cycle, in −1…1.

    Pearson's correlation of each of the `signals` and its column of `curve`, at the phases of the curve, the signal
    interpolated linearly; then the least of them (Dzeladini 2013 eq. 2.48–2.51; covariance and variance both with 1/N).
    The cycle is that of the foot in `feet`, from touchdown to touchdown, or from liftoff to liftoff where the curve
    begins at liftoff.
    """
    curve = view.curve()
    strides = footfalls(view)[0].strides()
    events = strides.cycles.onsets if curve.begins_at == "touchdown" else strides.liftoffs
    times = events[-2] + np.array(curve.phases) / 100.0 * (events[-1] - events[-2])
    return min(
        pearson(signal.at(times), np.array(values)) for signal, values in zip(view.signals(), curve.values, strict=True)
    )
