"""Measures taken of recordings."""

from dataclasses import dataclass

from neuromech.analyse.kinds import RESULT_UNITS, MeasureKind
from neuromech.analyse.table import measure_kind
from neuromech.analyse.windows import NotMeasurableError, View
from neuromech.errors import MeasureError
from neuromech.simulate.recording import Recording
from neuromech.spec.measure import Measure


@dataclass(frozen=True, slots=True)
class MeasuredValue:
    """What a measure gave.

    Args:
        value: a number in `unit`; a text for a measure of text; for any measure that could not be taken, the words
            that say why (`no rhythm`).
        unit: SI unit of the number, empty for a plain number, None for a measure of text.
    """

    value: float | str
    unit: str | None


def measure(recording: Recording, spec: Measure) -> MeasuredValue:
    """Take a measure of a recording.

    Of a run that ended before the measure's `until` (before its protocol's end, where none is given), only those kinds
    can be measured that say so (`MeasureKind.of_early_end`).

    Raises:
        MeasureError: there is no such kind, an argument is missing or does not fit the kind or the signal.
        RecordingError: a signal was not recorded.
    """
    kind = measure_kind(spec)
    unit = _unit(View(recording, spec), kind)
    end = recording.outcome
    partial = end.kind != "finished" and (spec.until is None or end.time < spec.until)
    if partial and not kind.of_early_end:
        return MeasuredValue(f"the run {_ENDED[end.kind]} at {end.time:g} s", unit)
    try:
        return MeasuredValue(kind.take(View(recording, spec)), unit)
    except NotMeasurableError as reason:
        return MeasuredValue(str(reason), unit)


_ENDED = {"fell": "ended in a fall", "diverged": "diverged", "stopped": "was stopped"}


def _unit(view: View, kind: MeasureKind) -> str | None:
    if kind.result != "signal":
        return RESULT_UNITS[kind.result]
    names = [view.spec.signal] if view.spec.signal is not None else view.signal_names()
    units = {view.recording.unit(name) for name in names}
    if len(units) != 1:
        raise MeasureError(f"measure '{view.spec.kind}' needs signals of one unit (got {', '.join(sorted(units))})")
    return units.pop()
