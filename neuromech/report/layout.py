"""What all figures share: style, colours, units on axes, grouping by leg, the window of a few cycles, files."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Any, Literal

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from neuromech.analyse.cycles import Cycles, cycles
from neuromech.analyse.oscillation import LEAST_AMPLITUDE
from neuromech.analyse.windows import Array, NotMeasurableError
from neuromech.simulate.recording import Recording

BLUE, RED, GREEN = "#0072B2", "#D55E00", "#009E73"
TIME_COLORS = "viridis"
SHOWN_CYCLES = 4
SHOWN_WITHOUT_RHYTHM = 2.0
"""Length (s) of the window where nothing is rhythmic."""

SHORTEST_WINDOW = 1e-3
"""Least length (s) of a time axis, for a run of a single sample."""

_DISPLAY: Mapping[str, tuple[str, float]] = MappingProxyType(
    {"rad": ("deg", 180.0 / np.pi), "rad/s": ("deg/s", 180.0 / np.pi), "m": ("mm", 1e3), "V": ("mV", 1e3)}
)
_STYLE = Path(__file__).with_name("figures.mplstyle")

FileFormat = Literal["png", "svg"]


class NotDrawableError(Exception):
    """A recording does not hold what a figure shows; the text says what is missing (`no joint angle is recorded`)."""


@contextmanager
def style() -> Iterator[None]:
    """Draw and save with the package's style; the user's own settings are back afterwards."""
    with mpl.rc_context(fname=_STYLE):
        yield


def grid(rows: int, columns: int, width: float, height: float, **options: Any) -> tuple[Figure, list[list[Axes]]]:
    """Return a figure with rows × columns panels of a size (inches) each."""
    figure = Figure(figsize=(columns * width, rows * height), layout="constrained")
    axes = figure.subplots(rows, columns, squeeze=False, **options)
    return figure, [list(row) for row in axes]


def panels(
    names: Sequence[str], width: float, height: float, columns: int = 2, **options: Any
) -> tuple[Figure, list[Axes]]:
    """Return a figure with one titled panel of a size (inches) per name, filled row by row."""
    columns = min(columns, len(names))
    figure, axes = grid(-(-len(names) // columns), columns, width, height, **options)
    flat = [one for row in axes for one in row]
    for unused in flat[len(names) :]:
        unused.remove()
    for name, one in zip(names, flat, strict=False):
        one.set_title(name, loc="left")
    return figure, flat[: len(names)]


def save(figure: Figure, file: Path, formats: Sequence[FileFormat] = ("png",)) -> list[Path]:
    """Write a figure under a name without suffix, once per format, and return the files."""
    written = []
    for suffix in formats:
        target = file.with_name(f"{file.name}.{suffix}")
        figure.savefig(target, metadata={"Date": None} if suffix == "svg" else None)
        written.append(target)
    return written


@dataclass(frozen=True, slots=True)
class Trace:
    """A signal ready to be drawn: times (s), values in a unit that readers use, NaN where they were not finite."""

    element: str
    time: Array
    values: Array
    unit: str

    def between(self, start: float, end: float) -> "Trace":
        """Return the samples between two times (s)."""
        chosen = (self.time >= start) & (self.time <= end)
        return Trace(self.element, self.time[chosen], self.values[chosen], self.unit)


def trace(recording: Recording, name: str) -> Trace:
    """Return a recorded signal as it is drawn: angles in degrees, lengths in millimetres, potentials in millivolts."""
    time, values = recording.signal(name)
    unit = recording.unit(name)
    finite = np.where(np.isfinite(values), values, np.nan)
    return Trace(name.split(".")[-2], time, finite * in_shown_unit(1.0, unit), shown_unit(unit))


def in_shown_unit(value: float, unit: str) -> float:
    """Return a number of a recorded unit in the unit that it is drawn in."""
    return value * _DISPLAY.get(unit, (unit, 1.0))[1]


def shown_unit(unit: str) -> str:
    """Return the unit in which numbers of a recorded unit are drawn."""
    return _DISPLAY.get(unit, (unit, 1.0))[0]


def by_scope(recording: Recording, quantity: str, unit: str | None = None) -> dict[str, list[str]]:
    """Return {scope: signal names} of one quantity (`LF.RG-F.activity` has scope LF), all in recorded order."""
    found: dict[str, list[str]] = {}
    for name in recording.match(f"*.{quantity}"):
        if unit is None or recording.unit(name) == unit:
            found.setdefault(".".join(name.split(".")[:-2]), []).append(name)
    return found


def root_of(recording: Recording, *quantities: str) -> str:
    """Return the first segment that stands in no scope and has all quantities: the trunk; empty without one."""
    elements = [name.rpartition(".")[0] for name in by_scope(recording, quantities[0]).get("", [])]
    segments = [element for element in elements if f"{element}.force_z" not in recording.names]
    return next((one for one in segments if all(f"{one}.{quantity}" in recording.names for quantity in quantities)), "")


def title(recording: Recording, scope: str) -> str:
    """Return the title of a scope's panel: its name, or the document's for what stands in no scope."""
    return scope or recording.provenance.name


def axis_label(quantity: str, unit: str) -> str:
    """Return the label of an axis."""
    return f"{quantity} ({unit})" if unit else quantity


def rhythm_of(recording: Recording, name: str) -> Cycles | None:
    """Return the cycles of a signal, None where it has no rhythm."""
    time, values = recording.signal(name)
    if not np.all(np.isfinite(values)):
        return None
    try:
        return cycles(time, values, LEAST_AMPLITUDE)
    except NotMeasurableError:
        return None


def recent(recording: Recording) -> tuple[float, float]:
    """Return start and end (s) of the last few cycles of the first rhythmic signal, else of the last seconds."""
    for name in recording.match("*.activity", "*.angle"):
        found = rhythm_of(recording, name)
        if found is not None:
            return float(found.onsets[-min(SHOWN_CYCLES + 1, len(found.onsets))]), float(found.onsets[-1])
    end = max(float(recording.signal(name)[0][-1]) for name in recording.names)
    return max(0.0, end - SHOWN_WITHOUT_RHYTHM), max(end, SHORTEST_WINDOW)
