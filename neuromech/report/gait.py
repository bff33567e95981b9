"""The gait of a run as the field tabulates it: speed, cycle, duty factors, phases, gait class."""

from collections.abc import Mapping

from rich.table import Table
from rich.text import Text

from neuromech.analyse.measures import MeasuredValue, measure
from neuromech.analyse.phases import GAITS
from neuromech.report.layout import by_scope
from neuromech.report.steps import foot_patterns
from neuromech.simulate.recording import Recording
from neuromech.spec.measure import Measure
from neuromech.units import Quantity

QUADRUPED = ("LF", "RF", "LH", "RH")
"""Names of the legs of which a gait class can be told, in the order that the measure `gait` takes."""

_OF_EACH_FOOT = ("cycle_duration", "stance_duration", "swing_duration", "duty_factor")

Found = Mapping[str, Mapping[str, MeasuredValue]]


def gait_measures(recording: Recording) -> Found:
    """Return {measure: {leg or segment: value}} over the second half of a run; empty where no foot carries load.

    A foot is all the contacts in the scope of a leg. Phases are those after the first leg. `speed` is that of the
    segment that stands in no scope, `gait` has the entry `body`.
    """
    feet = foot_patterns(recording)
    if recording.provenance.anatomy.weight == 0.0 or not feet:
        return {}
    counts = {leg: _take(recording, "touchdowns", feet=[foot]) for leg, foot in feet.items()}
    if not any(isinstance(count.value, float) and count.value > 0.0 for count in counts.values()):
        return {}
    found: dict[str, Mapping[str, MeasuredValue]] = {
        kind: {leg: _take(recording, kind, feet=[foot]) for leg, foot in feet.items()} for kind in _OF_EACH_FOOT
    }
    first, *others = feet
    found["interlimb_phase"] = {
        leg: _take(recording, "interlimb_phase", feet=[feet[first], feet[leg]]) for leg in others
    }
    return found | _of_body(recording, feet)


def gait_table(recording: Recording) -> Table | None:
    """Return the gait, one line for each leg; None where no foot carries load.

    What cannot be measured is a dash, and the caption says why.
    """
    found = gait_measures(recording)
    if not found:
        return None
    table = Table(title=_title(found), title_justify="left", caption=_reasons(found) or None, caption_justify="left")
    table.add_column("leg")
    for heading in ("cycle (s)", "stance (s)", "swing (s)", "duty factor", "phase"):
        table.add_column(heading, justify="right", overflow="fold")
    for leg in found[_OF_EACH_FOOT[0]]:
        cells = [_text(found[kind][leg]) for kind in _OF_EACH_FOOT]
        phase = found["interlimb_phase"].get(leg)
        table.add_row(Text(leg), *(Text(cell) for cell in cells), Text("0" if phase is None else _text(phase)))
    return table


def _of_body(recording: Recording, feet: Mapping[str, str]) -> dict[str, Mapping[str, MeasuredValue]]:
    found: dict[str, Mapping[str, MeasuredValue]] = {}
    roots = [name.removesuffix(".x") for name in by_scope(recording, "x").get("", [])]
    if roots:
        found["speed"] = {roots[0]: _take(recording, "speed", segment=roots[0])}
    if set(feet) == set(QUADRUPED):
        found["gait"] = {"body": _take(recording, "gait", feet=[feet[leg] for leg in QUADRUPED])}
    return found


def _take(recording: Recording, kind: str, **arguments: object) -> MeasuredValue:
    end = recording.outcome.time
    window = {"after": Quantity(end / 2.0), "until": Quantity(end)} if end > 0.0 else {}
    return measure(recording, Measure.model_validate({"kind": kind, **window, **arguments}))


def _title(found: Found) -> str:
    gaits = [value.value for value in found.get("gait", {}).values() if value.value in GAITS]
    speeds = [value.value for value in found.get("speed", {}).values()]
    words = [str(name) for name in gaits] + [f"{speed:.3g} m/s" for speed in speeds if isinstance(speed, float)]
    return f"gait: {', '.join(words)}" if words else "gait"


def _reasons(found: Found) -> str:
    """Return why some of the table is empty, each reason once."""
    values = [value.value for kind in (*_OF_EACH_FOOT, "interlimb_phase") for value in found[kind].values()]
    return "; ".join(dict.fromkeys(value for value in values if isinstance(value, str)))


def _text(value: MeasuredValue) -> str:
    return "–" if isinstance(value.value, str) else f"{value.value:.3g}"
