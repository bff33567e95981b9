"""The measures that a claim may name, and how to take one."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Literal

from neuromech.analyse.levels import (
    correlation,
    final,
    fraction_active,
    held,
    maximum,
    mean,
    minimum,
    outcome,
    rms_difference,
    silence,
    span,
)
from neuromech.analyse.oscillation import amplitude, burst_duration, center, period, rhythm, settling_time
from neuromech.analyse.phases import gait, interlimb_phases, phase, phase_order
from neuromech.analyse.windows import NotMeasurableError, View
from neuromech.errors import MeasureError, did_you_mean
from neuromech.simulate.recording import Recording
from neuromech.spec.measure import Measure

Result = Literal["signal", "time", "number", "text"]
Argument = Literal["signal", "signals", "reference", "level", "tolerance"]


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


@dataclass(frozen=True, slots=True)
class MeasureKind:
    """A kind of measure: how to take it, what it gives, and the arguments that it needs."""

    take: Callable[[View], float | str]
    result: Result
    needs: tuple[Argument, ...]


MEASURES: Mapping[str, MeasureKind] = MappingProxyType(
    {
        "outcome": MeasureKind(outcome, "text", ()),
        "period": MeasureKind(period, "time", ("signal",)),
        "rhythm": MeasureKind(rhythm, "text", ("signal",)),
        "center": MeasureKind(center, "signal", ("signal",)),
        "amplitude": MeasureKind(amplitude, "signal", ("signal",)),
        "settling_time": MeasureKind(settling_time, "time", ("signal", "tolerance")),
        "burst_duration": MeasureKind(burst_duration, "time", ("signal", "level")),
        "phase": MeasureKind(phase, "number", ("signal", "reference")),
        "phase_order": MeasureKind(phase_order, "text", ("signals", "reference")),
        "interlimb_phases": MeasureKind(interlimb_phases, "text", ("signals",)),
        "gait": MeasureKind(gait, "text", ("signals",)),
        "silence": MeasureKind(silence, "signal", ("signals",)),
        "held": MeasureKind(held, "text", ("signal", "level")),
        "fraction_active": MeasureKind(fraction_active, "number", ("signal",)),
        "mean": MeasureKind(mean, "signal", ("signal",)),
        "minimum": MeasureKind(minimum, "signal", ("signal",)),
        "maximum": MeasureKind(maximum, "signal", ("signal",)),
        "range": MeasureKind(span, "signal", ("signal",)),
        "final": MeasureKind(final, "signal", ("signal",)),
        "rms_difference": MeasureKind(rms_difference, "signal", ("signal", "reference")),
        "correlation": MeasureKind(correlation, "number", ("signal", "reference")),
    }
)


def measure_kind(spec: Measure) -> MeasureKind:
    """Return the kind that a measure names.

    Raises:
        MeasureError: there is no such kind, or an argument is missing.
    """
    if spec.kind not in MEASURES:
        raise MeasureError(f"'{spec.kind}' is not a measure. Hint: {did_you_mean(spec.kind, MEASURES)}")
    kind = MEASURES[spec.kind]
    for argument in kind.needs:
        if getattr(spec, argument) is None:
            raise MeasureError(f"measure '{spec.kind}' needs '{argument}'")
    return kind


def measure(recording: Recording, spec: Measure) -> MeasuredValue:
    """Take a measure of a recording.

    Of a run that ended before the measure's `until` (before its protocol's end, where none is given), only `outcome`
    can be measured.

    Raises:
        MeasureError: there is no such kind, an argument is missing or does not fit the signal.
        RecordingError: a signal was not recorded.
    """
    kind = measure_kind(spec)
    unit = _unit(View(recording, spec), kind)
    end = recording.outcome
    if spec.kind != "outcome" and end.kind != "finished" and (spec.until is None or end.time < spec.until):
        return MeasuredValue(f"the run {_ENDED[end.kind]} at {end.time:g} s", unit)
    try:
        return MeasuredValue(kind.take(View(recording, spec)), unit)
    except NotMeasurableError as reason:
        return MeasuredValue(str(reason), unit)


_ENDED = {"fell": "ended in a fall", "diverged": "diverged", "stopped": "was stopped"}


def _unit(view: View, kind: MeasureKind) -> str | None:
    if kind.result != "signal":
        return {"time": "s", "number": "", "text": None}[kind.result]
    names = [view.spec.signal] if view.spec.signal is not None else view.signal_names()
    units = {view.recording.unit(name) for name in names}
    if len(units) != 1:
        raise MeasureError(f"measure '{view.spec.kind}' needs signals of one unit (got {', '.join(sorted(units))})")
    return units.pop()
