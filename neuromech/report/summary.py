"""Tables for the terminal: how a run went, and which claims are met. Nothing is computed here."""

from collections.abc import Sequence

from rich.table import Table
from rich.text import Text

from neuromech.analyse.claims import Measured, Verdict
from neuromech.analyse.expectations import Value
from neuromech.simulate.recording import Recording

_COLORS = {True: "green", False: "bold red"}


def run_table(recording: Recording) -> Table:
    """Return where a recording comes from and how its run ended, one line per fact."""
    origin = recording.provenance
    outcome = origin.outcome
    table = Table(show_header=False, box=None, pad_edge=False)
    table.add_column(style="dim")
    table.add_column(overflow="fold")
    ending = f"{outcome.kind} at {outcome.time:g} s" + (f": {outcome.message}" if outcome.message else "")
    table.add_row("document", Text(origin.name))
    table.add_row("outcome", Text(ending, _COLORS[outcome.kind == "finished"]))
    table.add_row("simulated", f"{origin.simulated_seconds:g} s in {origin.wall_seconds:.2f} s")
    if origin.wall_seconds > 0.0:
        table.add_row("real-time factor", f"{origin.simulated_seconds / origin.wall_seconds:.2f}")
    table.add_row("engine", Text(origin.engine))
    table.add_row("seed", str(origin.seed))
    return table


def claims_table(verdicts: Sequence[Verdict]) -> Table:
    """Return the verdicts, one row per claim, those that are not met included."""
    met = sum(verdict.verdict == "met" for verdict in verdicts)
    table = Table(title=f"{met} of {len(verdicts)} claims met", title_justify="left")
    for heading in ("claim", "source", "published", "expected", "measured", "verdict"):
        table.add_column(heading, overflow="fold")
    for verdict in verdicts:
        published = "" if verdict.published is None else str(verdict.published)
        cells = (verdict.source, published, verdict.expected, measured_text(verdict.measured))
        claim = Text.assemble((f"{verdict.spec}: {verdict.id}\n", "bold"), verdict.claim)
        table.add_row(claim, *map(Text, cells), Text(verdict.verdict, _COLORS[verdict.verdict == "met"]))
    return table


def measured_text(measured: Measured) -> str:
    """Return a measured value in short: `0.4571`, `0.4571 (0.4569 … 0.4573), n = 20`, `trot, n = 20`."""
    text = _short(measured.median)
    if measured.min != measured.max:
        text += f" ({_short(measured.min)} … {_short(measured.max)})"
    return text if measured.n == 1 else f"{text}, n = {measured.n}"


def _short(value: Value | None) -> str:
    return f"{value:.4g}" if isinstance(value, float | int) else str(value)
