"""Verdicts on claims as a table and as plain values."""

from collections.abc import Sequence

from rich.table import Table
from rich.text import Text

from neuromech.analyse.claims import Measured, Value, Verdict


def verdict_table(verdicts: Sequence[Verdict]) -> Table:
    """Return a table with one line for each claim."""
    table = Table("claim", "source", "expected", "measured", "verdict", title="Claims", title_justify="left")
    for verdict in verdicts:
        style = "green" if verdict.verdict == "met" else "bold red"
        claim = Text(f"{verdict.spec}.{verdict.id}: {verdict.claim}")
        cells = (Text(verdict.source), Text(verdict.expected), Text(measured_text(verdict.measured)))
        table.add_row(claim, *cells, Text(verdict.verdict, style))
    return table


def measured_text(measured: Measured) -> str:
    """Return median, range and number of runs in short."""
    if measured.n == 1 or measured.min == measured.max:
        spread = ""
    else:
        spread = f" ({_short(measured.min)} … {_short(measured.max)})"
    return _short(measured.median) + spread + (f", n = {measured.n}" if measured.n > 1 else "")


def all_met(verdicts: Sequence[Verdict]) -> bool:
    """Tell whether every claim is met."""
    return all(verdict.verdict == "met" for verdict in verdicts)


def _short(value: Value | None) -> str:
    return f"{value:.4g}" if isinstance(value, float | int) else str(value)
