"""Paths of the feet."""

import numpy as np
from matplotlib.figure import Figure

from neuromech.analyse.windows import Array
from neuromech.report.layout import NotDrawableError, by_scope, panels, recent, root_of, title, trace
from neuromech.simulate.recording import Recording


def foot_path_figure(recording: Recording) -> Figure:
    """Return the sagittal path of each foot over the last few cycles, relative to the root where that was recorded.

    A foot is what has `x`, `z` and `force_z` in a leg's scope; without forces, the last element with `x` and `z`.

    Raises:
        NotDrawableError: no foot was recorded.
    """
    feet = {scope: foot for scope, foot in _feet(recording).items() if foot is not None}
    if not feet:
        raise NotDrawableError("x and z of no foot are recorded")
    start, end = recent(recording)
    figure, axes = panels([title(recording, scope) for scope in feet], 3.4, 2.2)
    root = root_of(recording, "x", "z")
    for one, foot in zip(axes, feet.values(), strict=True):
        time, x, z = _relative_path(recording, foot, root)
        chosen = (time >= start) & (time <= end)
        one.plot(x[chosen], z[chosen], linewidth=0.9)
        one.set_aspect("equal", adjustable="datalim")
        one.set_xlabel(f"x − x of {root} (mm)" if root else "x (mm)")
        one.set_ylabel(f"z − z of {root} (mm)" if root else "z (mm)")
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
