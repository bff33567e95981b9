"""Signals over one cycle against the curves that the claims of the recorded document compare them with."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from neuromech.analyse.contacts import footfalls
from neuromech.analyse.cycles import Cycles
from neuromech.analyse.measures import measure
from neuromech.analyse.windows import Array, NotMeasurableError, View
from neuromech.report.layout import BLUE, NotDrawableError, panels, trace
from neuromech.report.references import compared_measures
from neuromech.report.steps import last_cycles
from neuromech.simulate.recording import Recording
from neuromech.spec.measure import Measure

AVERAGED_CYCLES = 10


@dataclass(frozen=True, slots=True)
class _Compared:
    """One signal and its curve: values at phases in percent, both about zero and in standard deviations."""

    title: str
    phases: Array
    expected: Array
    measured: Array


def correlation_figure(recording: Recording) -> Figure:
    """Return each signal that a claim correlates with a curve, over the last ten cycles, beside that curve.

    Both are shown less their mean and over their standard deviation, which is how a correlation sees them; the dashed
    line is the curve. The title gives the correlation as the claim measures it, of the last cycle (Dzeladini 2013,
    figures 3.1, 3.2 and 3.5).

    Raises:
        NotDrawableError: no claim has a curve, or none of its signals is rhythmic.
    """
    claimed = list(compared_measures(recording))
    if not claimed:
        raise NotDrawableError("no claim compares a signal with a curve")
    found = [one for spec in claimed for one in _compared(recording, spec)]
    if not found:
        raise NotDrawableError("no foot makes strides to compare over")
    figure, axes = panels([one.title for one in found], 2.6, 1.7, columns=3, sharex=True)
    for panel, one in zip(axes, found, strict=True):
        _draw(panel, one)
    return figure


def _compared(recording: Recording, spec: Measure) -> Iterator[_Compared]:
    """Yield the signals of a measure; none where they were not recorded or the foot makes no strides."""
    curve, names = spec.curve, spec.signals or ()
    if curve is None or not set(names) <= set(recording.names):
        return
    try:
        strides = footfalls(View(recording, spec))[0].strides()
    except NotMeasurableError:
        return
    onsets = strides.cycles.onsets if curve.begins_at == "touchdown" else strides.liftoffs
    cycles = last_cycles(Cycles(onsets), AVERAGED_CYCLES)
    phases = np.array(curve.phases)
    for name, column, values in zip(names, curve.columns, curve.values, strict=True):
        one = curve.model_copy(update={"columns": (column,), "values": (values,)})
        found = measure(recording, spec.model_copy(update={"signals": (name,), "curve": one})).value
        signal = trace(recording, name)
        times = cycles.onsets[:-1, None] + cycles.durations[:, None] * phases / 100.0
        words = found if isinstance(found, str) else f"r = {found:.2f}"
        yield _Compared(
            f"{name}, {words}",
            phases,
            _standard(np.array(values)),
            _standard(np.interp(times, signal.time, signal.values)),
        )


def _standard(values: Array) -> Array:
    """Return values less their mean, over their standard deviation; zero where they are all alike."""
    spread = float(np.std(values))
    return np.asarray((values - np.mean(values)) / spread) if spread > 0.0 else np.zeros_like(values)


def _draw(axes: Axes, one: _Compared) -> None:
    mean, deviation = one.measured.mean(axis=0), one.measured.std(axis=0)
    axes.fill_between(one.phases, mean - deviation, mean + deviation, color=BLUE, alpha=0.25, linewidth=0.0)
    axes.plot(one.phases, mean, color=BLUE)
    axes.plot(one.phases, one.expected, color="black", linestyle="--", linewidth=0.9)
    axes.set_xlim(0.0, 100.0)
    axes.set_xlabel("% of cycle")
    axes.set_ylabel("standard deviations")
