"""`neuromech bench`: ratios to peers and limits, measured side by side."""

import json
import tempfile
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from rich.table import Table
from rich.text import Text

from neuromech.bench.catalogue import BENCHMARKS, run
from neuromech.bench.machine import machine
from neuromech.bench.pairing import Result
from neuromech.bench.workspace import Workspace
from neuromech.cli.consoles import results
from neuromech.cli.documents import shipped_specs
from neuromech.cli.files import write_text
from neuromech.cli.terminal import FINISHED, note, write_json, write_line
from neuromech.errors import DocumentError, Problem, did_you_mean

_SHARE_OF_SECOND = ((1.0, "s"), (1e-3, "ms"), (1e-6, "µs"), (1e-9, "ns"))


@dataclass(frozen=True, slots=True)
class Request:
    """What the user asked for on the command line."""

    only: Sequence[str]
    repetitions: int
    as_json: bool
    markdown: bool
    peers: Path
    python: Path
    out: Path


def bench(request: Request) -> int:
    """Measure, keep the raw numbers, and show the ratios; return the exit code.

    Raises:
        DocumentError: a name is no benchmark.
        OSError: the numbers cannot be written.
    """
    _check(request.only)
    described, started = machine(), datetime.now(UTC)
    file = request.out / f"{started:%Y%m%dT%H%M%SZ}.json"
    found = list[Result]()
    with tempfile.TemporaryDirectory(prefix="neuromech-bench-") as folder:
        workspace = Workspace(shipped_specs(), request.peers, request.python, Path(folder))
        for result in run(request.only or BENCHMARKS, workspace, request.repetitions):
            found.append(result)
            # After each row, so that a long run that is stopped leaves what it measured.
            write_text(file, _raw(found, described, started))
            note(f"{result.name}: {_ratio(result) or result.problem or _amount(result.as_dict(), 'ours')}")
    note(f"wrote {file}")
    if request.as_json:
        write_json([result.as_dict() for result in found])
    elif request.markdown:
        write_line(as_markdown(found, described))
    else:
        results().print(as_table(found))
    return FINISHED


def as_table(found: Iterable[Result]) -> Table:
    """Return a table of ratios, what they are made of, and what could not be measured."""
    table = Table("benchmark", "ratio", "range", "ours", "peer", "against", box=None, pad_edge=False)
    for result in found:
        table.add_row(*(Text(cell) for cell in _cells(result)))
    return table


def as_markdown(found: Iterable[Result], described: dict[str, Any]) -> str:
    """Return the table of the documentation, with a line on the machine above it."""
    load = ", ".join(f"{value:.1f}" for value in described["load"] or ())
    lines = [
        f"{described['processor']}, {described['cores']} cores, load average at the start {load};"
        f" Python {described['python']}, "
        + ", ".join(f"{name} {number}" for name, number in described["versions"].items())
        + ".",
        "",
        "| benchmark | ratio | range | ours | peer | against |",
        "|---|---|---|---|---|---|",
    ]
    return "\n".join([*lines, *(f"| `{name}` | {' | '.join(rest)} |" for name, *rest in map(_cells, found))])


def _check(names: Iterable[str]) -> None:
    problems = [
        Problem("unknown-benchmark", "--only", f"'{name}' is no benchmark", hint=did_you_mean(name, BENCHMARKS))
        for name in names
        if name not in BENCHMARKS
    ]
    if problems:
        raise DocumentError(problems)


def _raw(found: Iterable[Result], described: dict[str, Any], started: datetime) -> str:
    raw = [{**result.as_dict(), "measurements_ours": result.ours, "measurements_peer": result.peer} for result in found]
    content = {"time": started.isoformat(timespec="seconds"), "machine": described, "results": raw}
    return json.dumps(content, indent=2, ensure_ascii=False) + "\n"


def _cells(result: Result) -> tuple[str, ...]:
    values = result.as_dict()
    if result.problem is not None:
        return (result.name, "not measured", "", "", "", result.problem.replace("\n", "; "))
    spread = " – ".join(map(_number, values["ratio_range"] or ()))
    return (
        result.name,
        _ratio(result),
        spread,
        _amount(values, "ours"),
        _amount(values, "peer"),
        result.against,
    )


def _ratio(result: Result) -> str:
    ratio = result.as_dict()["ratio"]
    return "" if ratio is None else _number(ratio)


def _number(value: float) -> str:
    return f"{value:.3g}"


def _amount(values: dict[str, Any], side: str) -> str:
    value, unit = values[side], values["unit"]
    if value is None:
        return ""
    if unit != "s" and not unit.startswith("s/"):
        return f"{_number(value)} {unit}"
    share, word = next((pair for pair in _SHARE_OF_SECOND if value >= pair[0]), _SHARE_OF_SECOND[-1])
    return f"{_number(value / share)} {word}{unit[1:]}"
