"""Verdicts on claims as a table."""

from collections.abc import Sequence

from rich.table import Table
from rich.text import Text

from neuromech.analyse.claims import Measured, Verdict


def claims_table(verdicts: Sequence[Verdict]) -> Table:
    """Return one line for each claim, those that are not met included."""
    met = sum(verdict.verdict == "met" for verdict in verdicts)
    table = Table(title=f"{met} of {len(verdicts)} claims met", title_justify="left")
    for heading in ("document", "claim", "source", "published", "expected", "measured", "verdict"):
        table.add_column(heading, overflow="fold")
    for verdict in verdicts:
        words = (verdict.spec, verdict.claim, verdict.source, _short(verdict.published), verdict.expected)
        style = "green" if verdict.verdict == "met" else "bold red"
        cells = (*words, measured_text(verdict.measured))
        table.add_row(*(Text(cell) for cell in cells), Text(verdict.verdict, style))
    return table


def measured_text(measured: Measured) -> str:
    """Return a measured value in words: `0.4571`, `0.4571 (0.4569 … 0.4573, n = 20)`, `trot (n = 20)`."""
    text = _short(measured.median)
    if measured.n == 1:
        return text
    same = measured.min == measured.max
    span = "" if same else f"{_short(measured.min)} … {_short(measured.max)}, "
    return f"{text} ({span}n = {measured.n})"


def _short(value: float | str | None) -> str:
    if value is None:
        return ""
    return value if isinstance(value, str) else f"{value:.4g}"
