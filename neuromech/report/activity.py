"""Activity of rhythm generator, pattern formation and motoneurons, stacked as in Habu 2020 Fig. 3-4."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from neuromech.report.layout import (
    BLUE,
    GREEN,
    RED,
    NotDrawableError,
    Trace,
    by_scope,
    grid,
    recent,
    rhythm_of,
    title,
    trace,
)
from neuromech.simulate.recording import Recording

LAYERS = ("RG", "PF", "Mn")
_LAYER_COLORS = (BLUE, GREEN, RED)
_MOST_ROWS = 24
_ROW_FILL = 0.85
"""Part of a row's height that the largest activity of its layer takes."""


def activity_figure(recording: Recording) -> Figure:
    """Return stacked activities, one column per leg, over the last few cycles.

    Rows are RG, PF and Mn neurons from top to bottom, each layer to its own scale. Grey bands show where the first
    row is the more active of the first two (the flexor phase); a dashed frame marks one cycle of the motoneurons.

    Raises:
        NotDrawableError: no activity was recorded.
    """
    scopes = {scope: _rows(names) for scope, names in by_scope(recording, "activity").items()}
    if not scopes:
        raise NotDrawableError("no activity is recorded")
    height = max(len(names) for names in scopes.values()) * 0.36 + 1.0
    figure, axes = grid(1, len(scopes), 3.1 if len(scopes) > 1 else 5.5, height)
    window = recent(recording)
    for one, (scope, names) in zip(axes[0], scopes.items(), strict=True):
        one.set_title(title(recording, scope), loc="left")
        _stack(one, [trace(recording, name).between(*window) for name in names])
        _mark_cycle(one, recording, names, window)
        one.set_xlim(*window)
        one.set_xlabel("time (s)")
    return figure


def _rows(names: list[str]) -> list[str]:
    """Return the neurons of the three layers, layer by layer; of a network that has none of them, all neurons."""
    layered = [name for layer in LAYERS for name in names if _element(name).startswith(layer)]
    return (layered or names)[:_MOST_ROWS]


def _element(name: str) -> str:
    return name.split(".")[-2]


def _layer(element: str) -> int:
    return next((number for number, layer in enumerate(LAYERS) if element.startswith(layer)), 0)


def _stack(axes: Axes, traces: Sequence[Trace]) -> None:
    scales = _scales(traces)
    for row, one in enumerate(traces):
        base, scale = -float(row), scales[_layer(one.element)]
        color = _LAYER_COLORS[_layer(one.element)]
        shape = base + _ROW_FILL * one.values / scale
        axes.fill_between(one.time, base, shape, color=color, alpha=0.35, linewidth=0.0)
        axes.plot(one.time, shape, color=color, linewidth=0.9)
        axes.axhline(base, color="0.8", linewidth=0.4, zorder=0)
    axes.set_yticks([0.4 - row for row in range(len(traces))], [one.element for one in traces])
    axes.tick_params(axis="y", length=0.0)
    axes.set_ylim(-len(traces) + 0.85, 1.05)
    axes.spines["left"].set_visible(False)
    _scale_bars(axes, traces, scales)
    _flexor_phases(axes, traces)


def _scales(traces: Sequence[Trace]) -> dict[int, float]:
    """Return the activity that fills a row, for each layer: its largest, rounded up to one digit."""
    scales: dict[int, float] = {}
    for one in traces:
        largest = float(np.nanmax(one.values, initial=0.0))
        scales[_layer(one.element)] = max(scales.get(_layer(one.element), 0.1), float(np.ceil(largest * 10.0) / 10.0))
    return scales


def _scale_bars(axes: Axes, traces: Sequence[Trace], scales: dict[int, float]) -> None:
    """Draw, right of the first row of each layer, a bar that says what its height means."""
    first: dict[int, int] = {}
    for row, one in enumerate(traces):
        first.setdefault(_layer(one.element), row)
    for layer, row in first.items():
        transform = axes.get_yaxis_transform()
        axes.plot(
            [1.015, 1.015], [-row, _ROW_FILL - row], color="0.3", linewidth=1.2, transform=transform, clip_on=False
        )
        axes.text(1.03, 0.42 - row, f"{scales[layer]:g}", transform=transform, va="center", color="0.3", fontsize=7)


def _flexor_phases(axes: Axes, traces: Sequence[Trace]) -> None:
    if len(traces) < 2 or len(traces[0].time) != len(traces[1].time):
        return
    first, second = traces[0], traces[1]
    active = first.values > second.values
    transform = axes.get_xaxis_transform()
    axes.fill_between(
        first.time, 0.0, 1.0, where=active.tolist(), color="0.92", linewidth=0.0, zorder=-1, transform=transform
    )


def _mark_cycle(axes: Axes, recording: Recording, names: Sequence[str], window: tuple[float, float]) -> None:
    """Frame one cycle of the first row, the last but one where there are several, over the motoneurons' rows."""
    found = rhythm_of(recording, names[0])
    rows = [row for row, name in enumerate(names) if _element(name).startswith(LAYERS[-1])] or list(range(len(names)))
    if found is None:
        return
    inside = found.onsets[(found.onsets >= window[0]) & (found.onsets <= window[1])]
    if len(inside) < 2:
        return
    start, end = (float(value) for value in inside[-3:][:2])
    low, high = -rows[-1] - 0.05, 0.95 - rows[0]
    frame = Rectangle((start, low), end - start, high - low, fill=False, linestyle="--", linewidth=0.9, zorder=3)
    axes.add_patch(frame)
