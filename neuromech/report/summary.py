"""What a run came to: a table for people and numbers for programs."""

from typing import Any

from rich.table import Table
from rich.text import Text

from neuromech.analyse.measures import MeasuredValue, measure
from neuromech.report.gait import gait_measures
from neuromech.report.layout import by_scope, in_shown_unit, shown_unit
from neuromech.simulate.recording import Recording
from neuromech.spec.measure import Measure
from neuromech.units import Quantity


def summary_table(recording: Recording) -> Table:
    """Return where a recording comes from and what it shows, one line per fact."""
    origin = recording.provenance
    table = Table(title=Text(origin.name, "bold"), title_justify="left", show_header=False, box=None, pad_edge=False)
    table.add_column(style="dim")
    table.add_column(overflow="fold")
    table.add_row("simulated", f"{origin.simulated_seconds:g} s in {origin.wall_seconds:.2f} s")
    if origin.wall_seconds > 0.0:
        table.add_row("real-time factor", f"{origin.simulated_seconds / origin.wall_seconds:.2f}")
    table.add_row("engine", Text(origin.engine))
    table.add_row("seed", str(origin.seed))
    for kind, found in _measured(recording).items():
        for scope, values in _by_scope(found).items():
            table.add_row(f"{kind} {scope}".rstrip(), Text(", ".join(values)))
    return table


def metrics(recording: Recording) -> dict[str, Any]:
    """Return {measure: {signal: {value, unit}}} over the second half of a run, in SI units.

    The period of the first neuron of each leg, centre and amplitude of each joint angle, and the gait where feet carry
    load (see `gait_measures`). `value` is a text where there was nothing to measure (`no rhythm`).
    """
    return {
        kind: {name: {"value": value.value, "unit": value.unit} for name, value in found.items()}
        for kind, found in (*_measured(recording).items(), *gait_measures(recording).items())
    }


def _measured(recording: Recording) -> dict[str, dict[str, MeasuredValue]]:
    first_neurons = [names[0] for names in by_scope(recording, "activity").values()]
    angles = recording.match("*.angle")
    half = Quantity(recording.outcome.time / 2.0)
    return {
        kind: {name: measure(recording, Measure(kind=kind, signal=name, after=half)) for name in names}
        for kind, names in (("period", first_neurons), ("center", angles), ("amplitude", angles))
        if names
    }


def _by_scope(found: dict[str, MeasuredValue]) -> dict[str, list[str]]:
    """Return {scope: texts like `hip 70 deg`}."""
    texts: dict[str, list[str]] = {}
    for name, value in found.items():
        *scope, element, _ = name.split(".")
        texts.setdefault(".".join(scope), []).append(f"{element} {_text(value)}")
    return texts


def _text(value: MeasuredValue) -> str:
    if isinstance(value.value, str):
        return value.value
    unit = value.unit or ""
    return f"{in_shown_unit(value.value, unit):.4g} {shown_unit(unit)}".rstrip()
