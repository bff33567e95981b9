"""Figures of a sweep: a line where one parameter is varied, heat maps where several are (Dzeladini 2013, Fig. 7.6).

Of several seeds the median is shown, or the commonest word. Where a value is missing, the figure says why.
"""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from statistics import median
from typing import Any

import matplotlib as mpl
import numpy as np
import xarray as xr
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import ListedColormap, Normalize
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from neuromech.report.layout import FileFormat, axis_label, in_shown_unit, panels, save, shown_unit, style

MOST_PANELS = 48
"""How many heat maps one figure has at most; its title says where there are more."""

MOST_TICKS = 7
LEGEND_WIDTH = 1.7
"""Room for a word of the legend (inches)."""

NUMBER_COLORS = "viridis"
MISSING_COLOR = "#DDDDDD"
HATCHES = ("//", "..", "xx", "--", "\\\\", "++", "oo", "||")


@dataclass(frozen=True, slots=True)
class Cell:
    """What all seeds of a point gave together.

    Args:
        value: median of the numbers as shown, or the commonest word; None where there is none at all.
        spread: least and greatest number; both NaN for words.
        reason: the commonest reason for a missing value, empty where none is missing: how the run ended, or else what
            the measure says.
    """

    value: float | str | None
    spread: tuple[float, float]
    reason: str


def write_sweep_figures(tree: xr.DataTree, folder: Path, formats: Sequence[FileFormat] = ("png",)) -> list[Path]:
    """Draw every measure of a sweep and return the files.

    Args:
        tree: results from `neuromech.study.sweeps.dataset`.
        folder: made where it is not there.
        formats: of the files.

    Raises:
        OSError: the folder cannot be written.
    """
    folder.mkdir(parents=True, exist_ok=True)
    written: list[Path] = []
    with style():
        for node in tree.subtree:
            for name in measures(node.to_dataset(inherit=False)):
                suffix = f"_by_{node.name.replace(' ', '_')}" if node.name else ""
                figure = sweep_figure(node.to_dataset(inherit=False), name)
                written += save(figure, folder / f"{name}{suffix}", formats)
    return written


def measures(data: xr.Dataset) -> list[str]:
    """Return the measures of a dataset, in authored order."""
    return [str(name) for name in data.data_vars if f"{name}_missing" in data.data_vars]


def sweep_figure(data: xr.Dataset, name: str) -> Figure:
    """Return the figure of a measure."""
    axes = [str(dimension) for dimension in data[name].dims if dimension != "seed"]
    if len(axes) == 1:
        return _line_figure(data, name, axes[0])
    return _map_figure(data, name, axes)


def cells(data: xr.Dataset, name: str) -> dict[tuple[int, ...], Cell]:
    """Return what each point gave, by its position along the varied parameters."""
    unit = str(data[name].attrs.get("units", ""))
    values = data[name].transpose(..., "seed").values
    missing, outcome = (data[one].transpose(..., "seed").values for one in (f"{name}_missing", "outcome"))
    reasons = np.where((missing != "") & (outcome != "finished"), outcome, missing)
    return {place: _cell(values[place], reasons[place], unit) for place in np.ndindex(*values.shape[:-1])}


def _cell(values: Any, reasons: Any, unit: str) -> Cell:
    taken = [value for value, reason in zip(values.tolist(), reasons.tolist(), strict=True) if not reason]
    words = [reason for reason in reasons.tolist() if reason]
    reason = Counter(words).most_common(1)[0][0] if words else ""
    if not taken:
        return Cell(None, (np.nan, np.nan), reason)
    if isinstance(taken[0], str):
        return Cell(Counter(taken).most_common(1)[0][0], (np.nan, np.nan), reason)
    shown = [in_shown_unit(value, unit) for value in taken]
    return Cell(median(shown), (min(shown), max(shown)), reason)


def _line_figure(data: xr.Dataset, name: str, axis: str) -> Figure:
    found = cells(data, name)
    order = np.argsort(data[axis].values, kind="stable")
    places = [float(data[axis].values[index]) for index in order]
    ordered = [found[(int(index),)] for index in order]
    figure, (axes,) = panels([_title(data, name)], 4.2, 2.8, columns=1)
    if any(isinstance(cell.value, str) for cell in ordered):
        _draw_words(axes, places, ordered)
    else:
        _draw_numbers(axes, places, ordered)
        axes.set_ylabel(axis_label(name, _unit(data, name)))
    _draw_missing(axes, places, ordered, "no value" if data.sizes["seed"] == 1 else "no value for some seeds")
    axes.set_xlabel(axis_label(axis, str(data[axis].attrs.get("units", ""))))
    return figure


def _draw_numbers(axes: Axes, places: Sequence[float], found: Sequence[Cell]) -> None:
    middle = [np.nan if cell.value is None else float(cell.value) for cell in found]
    low, high = ([cell.spread[end] for cell in found] for end in (0, 1))
    axes.fill_between(places, low, high, alpha=0.25, linewidth=0.0)
    axes.plot(places, middle, marker="o", markersize=3.5)


def _draw_words(axes: Axes, places: Sequence[float], found: Sequence[Cell]) -> None:
    words = list(dict.fromkeys(cell.value for cell in found if isinstance(cell.value, str)))
    rows = [(place, words.index(cell.value)) for place, cell in zip(places, found, strict=True) if cell.value in words]
    axes.plot(*zip(*rows, strict=True), linestyle="none", marker="s", markersize=4.5)
    axes.set_yticks(range(len(words)), [str(word) for word in words])
    axes.set_ylim(-0.6, len(words) - 0.4)


def _draw_missing(axes: Axes, places: Sequence[float], found: Sequence[Cell], heading: str) -> None:
    """Mark on the lower edge where a value is missing, at all or for some seeds."""
    reasons = dict.fromkeys(cell.reason for cell in found if cell.reason)
    for reason, marker in zip(reasons, ("x", "v", "^", "s", "D", "P", "*", "<"), strict=False):
        where = [place for place, cell in zip(places, found, strict=True) if cell.reason == reason]
        options: dict[str, Any] = {"transform": axes.get_xaxis_transform(), "clip_on": False, "linestyle": "none"}
        axes.plot(where, [0.02] * len(where), marker=marker, color="0.35", markersize=5, label=reason, **options)
    if reasons:
        axes.legend(loc="upper left", bbox_to_anchor=(0.0, -0.2), title=heading, alignment="left")


def _map_figure(data: xr.Dataset, name: str, dimensions: Sequence[str]) -> Figure:
    outer, across, up = dimensions[:-2], dimensions[-2], dimensions[-1]
    heads = list(product(*(range(data.sizes[one]) for one in outer)))
    found = cells(data, name)
    shown = heads[:MOST_PANELS]
    titles = [_panel_title(data, outer, head) for head in shown] if outer else [_title(data, name)]
    figure, axes = panels(titles, 3.4, 2.7, columns=min(4, len(titles)))
    painter = _painter(data, name, [cell for place, cell in found.items() if place[: len(outer)] in set(shown)])
    for one, head in zip(axes, shown, strict=True):
        ordered = {key: [found[(*head, *place)] for place in row] for key, row in _rows(data, across, up)}
        _draw_map(one, list(ordered.values()), painter)
        _label(one, data, across, up)
    if outer:
        left_out = f", the first {MOST_PANELS} of {len(heads)}" if len(heads) > MOST_PANELS else ""
        figure.suptitle(f"{_title(data, name)}{left_out}")
    painter.explain(figure, axes, axis_label(name, _unit(data, name)))
    return figure


def _rows(data: xr.Dataset, across: str, up: str) -> Iterator[tuple[int, list[tuple[int, int]]]]:
    """Yield (row, positions) from the lowest value of `up` on, each from the lowest value of `across` on."""
    columns = np.argsort(data[across].values, kind="stable")
    for row, y in enumerate(np.argsort(data[up].values, kind="stable")):
        yield row, [(int(x), int(y)) for x in columns]


@dataclass(frozen=True)
class _Painter:
    """Which colour a value has, and which hatch a reason for its absence.

    Args:
        words: word → index of its colour; empty for numbers.
        scale: of numbers.
        hatches: reason → hatch.
        dotted: whether some cells are dotted.
        has_numbers: whether any cell has a number.
    """

    words: Mapping[str, int]
    scale: Normalize
    hatches: Mapping[str, str]
    dotted: bool
    has_numbers: bool

    @property
    def colors(self) -> Any:
        """The colours of numbers, or of words."""
        if not self.words:
            return mpl.colormaps[NUMBER_COLORS]
        cycle = mpl.rcParams["axes.prop_cycle"].by_key()["color"]
        return ListedColormap([cycle[index % len(cycle)] for index in range(len(self.words))])

    def number(self, cell: Cell) -> float:
        """Return what is painted in a cell, NaN for nothing."""
        if cell.value is None:
            return np.nan
        return float(self.words[cell.value]) if isinstance(cell.value, str) else cell.value

    def explain(self, figure: Figure, axes: Sequence[Axes], label: str) -> None:
        """Add the colour bar, or the words, and the reasons for missing values."""
        colors = self.colors
        handles: list[Artist] = [Patch(facecolor=colors(index), label=word) for word, index in self.words.items()]
        handles += [
            Patch(facecolor=MISSING_COLOR, edgecolor="0.4", linewidth=0.0, hatch=hatch, label=reason)
            for reason, hatch in self.hatches.items()
        ]
        if self.dotted:
            options: dict[str, Any] = {"linestyle": "none", "color": "white", "markeredgecolor": "black"}
            handles.append(Line2D([], [], marker="o", markersize=3, label="no value for some seeds", **options))
        if self.has_numbers:
            figure.colorbar(ScalarMappable(self.scale, colors), ax=list(axes), label=label, shrink=0.9)
        if handles:
            columns = max(1, int(figure.get_figwidth() // LEGEND_WIDTH))
            figure.legend(handles=handles, loc="outside lower center", ncols=min(columns, len(handles)))


def _painter(data: xr.Dataset, name: str, found: Sequence[Cell]) -> _Painter:
    words = sorted({cell.value for cell in found if isinstance(cell.value, str)})
    numbers = [cell.value for cell in found if isinstance(cell.value, float)]
    reasons = dict.fromkeys(cell.reason for cell in found if cell.value is None)
    dotted = any(cell.reason and cell.value is not None for cell in found)
    hatches = {reason: HATCHES[index % len(HATCHES)] for index, reason in enumerate(reasons)}
    if words:
        scale = Normalize(-0.5, len(words) - 0.5)
    else:
        scale = Normalize(min(numbers, default=0.0), max(numbers, default=1.0))
    return _Painter({word: index for index, word in enumerate(words)}, scale, hatches, dotted, bool(numbers))


def _draw_map(axes: Axes, rows: Sequence[Sequence[Cell]], painter: _Painter) -> None:
    """Paint cells; hatch those without a value, and dot those where it is missing for some seeds."""
    numbers = np.array([[painter.number(cell) for cell in row] for row in rows])
    if painter.words:
        axes.pcolormesh(numbers, cmap=painter.colors, vmin=-0.5, vmax=len(painter.words) - 0.5)
    else:
        axes.pcolormesh(numbers, cmap=painter.colors, norm=painter.scale)
    for y, row in enumerate(rows):
        for x, cell in enumerate(row):
            if cell.value is None:
                hatch = painter.hatches[cell.reason]
                axes.fill_between(
                    [x, x + 1], y, y + 1, facecolor=MISSING_COLOR, edgecolor="0.4", hatch=hatch, linewidth=0.0
                )
            elif cell.reason:
                axes.plot(x + 0.5, y + 0.5, marker="o", markersize=3, color="white", markeredgecolor="black")


def _label(axes: Axes, data: xr.Dataset, across: str, up: str) -> None:
    for name, set_ticks, set_label in (
        (across, axes.set_xticks, axes.set_xlabel),
        (up, axes.set_yticks, axes.set_ylabel),
    ):
        values = np.sort(data[name].values)
        step = -(-len(values) // MOST_TICKS)
        chosen = range(0, len(values), step)
        set_ticks([index + 0.5 for index in chosen], [f"{values[index]:.3g}" for index in chosen])
        set_label(axis_label(name, str(data[name].attrs.get("units", ""))))


def _title(data: xr.Dataset, name: str) -> str:
    middle = "median" if data[name].dtype.kind == "f" else "commonest"
    return f"{name}, {middle} of {data.sizes['seed']} seeds" if data.sizes["seed"] > 1 else name


def _panel_title(data: xr.Dataset, outer: Sequence[str], head: Sequence[int]) -> str:
    values = [
        (one, data[one].values[index], str(data[one].attrs.get("units", "")))
        for one, index in zip(outer, head, strict=True)
    ]
    return ", ".join(f"{one} = {value:.4g} {unit}".strip() for one, value, unit in values)


def _unit(data: xr.Dataset, name: str) -> str:
    return shown_unit(str(data[name].attrs.get("units", "")))
