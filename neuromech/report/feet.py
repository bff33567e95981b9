"""Paths of the feet, and when they carry load."""

import numpy as np
from matplotlib.figure import Figure

from neuromech.analyse.cycles import bursts
from neuromech.analyse.windows import Array
from neuromech.report.layout import BLUE, by_scope, grid, panels, recent, title, trace
from neuromech.simulate.recording import Recording

LEAST_LOAD = 0.01
"""Vertical force (N) from which a foot counts as loaded; Habu 2020, section 2.1.3."""


def foot_path_figure(recording: Recording) -> Figure | None:
    """Return the sagittal path of each foot over the last few cycles, relative to the root where that was recorded.

    A foot is what has `x`, `z` and `force_z` in a leg's scope; without forces, the last element with `x` and `z`.
    """
    feet = {scope: foot for scope, foot in _feet(recording).items() if foot is not None}
    if not feet:
        return None
    start, end = recent(recording)
    figure, axes = panels([title(recording, scope) for scope in feet], 3.4, 2.2)
    root = _root(recording)
    for one, foot in zip(axes, feet.values(), strict=True):
        time, x, z = _relative_path(recording, foot, root)
        chosen = (time >= start) & (time <= end)
        one.plot(x[chosen], z[chosen], linewidth=0.9)
        one.set_aspect("equal", adjustable="datalim")
        one.set_xlabel(f"x − x of {root} (mm)" if root else "x (mm)")
        one.set_ylabel(f"z − z of {root} (mm)" if root else "z (mm)")
    return figure


def footfall_figure(recording: Recording) -> Figure | None:
    """Return bars where each foot is loaded, over the last few cycles; None where no foot ever is."""
    contacts = recording.match("*.force_z")
    start, end = recent(recording)
    forces = [trace(recording, name).between(start, end) for name in contacts]
    if not any(np.any(force.values > LEAST_LOAD) for force in forces):
        return None
    figure, axes = grid(1, 1, 6.5, 0.7 + 0.3 * len(contacts))
    one = axes[0][0]
    for row, force in enumerate(forces):
        loaded = bursts(force.time, force.values, LEAST_LOAD)
        spans = [(burst.onset, burst.duration) for burst in loaded]
        one.broken_barh(spans, (-row - 0.3, 0.6), color=BLUE)
    one.set_yticks([-row for row in range(len(contacts))], [_label(recording, name) for name in contacts])
    one.set_ylim(-len(contacts) + 0.4, 0.6)
    one.set_xlim(start, end)
    one.set_xlabel("time (s)")
    one.set_title("loaded feet", loc="left")
    return figure


def _feet(recording: Recording) -> dict[str, str | None]:
    heights = set(recording.match("*.z"))
    loaded = {name.removesuffix(".force_z") for name in recording.match("*.force_z")}
    found: dict[str, str | None] = {}
    for scope, names in by_scope(recording, "x").items():
        candidates = [name.removesuffix(".x") for name in names if name.removesuffix(".x") + ".z" in heights]
        feet = [element for element in candidates if element in loaded] or candidates
        found[scope] = feet[-1] if feet and scope else None
    return found


def _root(recording: Recording) -> str:
    """Return the element that stands in no scope and has a position: the trunk; empty where none was recorded."""
    elements = [name.removesuffix(".x") for name in by_scope(recording, "x").get("", [])]
    return next((element for element in elements if f"{element}.z" in recording.names), "")


def _relative_path(recording: Recording, foot: str, root: str) -> tuple[Array, Array, Array]:
    """Return times (s), x and z (mm) of a foot, relative to the root where there is one, shape (n,) each."""
    path = {}
    for axis in ("x", "z"):
        seen = trace(recording, f"{foot}.{axis}")
        path[axis] = seen.values
        if root:
            origin = trace(recording, f"{root}.{axis}")
            path[axis] = seen.values - np.interp(seen.time, origin.time, origin.values)
    return seen.time, path["x"], path["z"]


def _label(recording: Recording, name: str) -> str:
    scope = ".".join(name.split(".")[:-2])
    return scope or title(recording, scope)
