"""Strokes of a network picture: curves between nodes that end in an arrowhead (excites) or a dot (inhibits)."""

from dataclasses import dataclass
from math import pi
from typing import Any, Literal

from matplotlib.axes import Axes
from matplotlib.patches import Circle, FancyBboxPatch, PathPatch, Polygon, RegularPolygon
from matplotlib.path import Path

from neuromech.graph.curves import REACH, Curve, Node, distance, part
from neuromech.graph.layout import Point

Sign = Literal["excitatory", "inhibitory", "wire"]


INK = {"excitatory": "#14507a", "inhibitory": "#b8321f", "wire": "#a8a8a8"}
FILL = {"neuron": "#ffffff", "population": "#ffffff", "drive": "#f6dd8b", "sensor": "#cfe5c8", "muscle": "#eac5c0"}
_HEAD = 0.13
_DOT = 0.075


@dataclass(frozen=True, slots=True)
class Stroke:
    """How a connection looks: its sign gives colour, dashes and end; width in points."""

    sign: Sign
    width: float


def draw_node(axes: Axes, node: Node) -> None:
    """Draw a node: circle (neuron), double one (population), hexagon (drive), square (sensor) or long box (muscle)."""
    style: dict[str, Any] = {"facecolor": FILL[node.family], "edgecolor": "#303030", "linewidth": 0.8, "zorder": 3}
    x, y = node.place
    width, height = REACH[node.family]
    if node.family == "muscle":
        rounding = f"round,pad=0,rounding_size={height}"
        axes.add_patch(FancyBboxPatch((x - width, y - height), 2 * width, 2 * height, boxstyle=rounding, **style))
    elif node.family == "sensor":
        axes.add_patch(RegularPolygon(node.place, 4, radius=1.3 * width, orientation=pi / 4, **style))
    elif node.family == "drive":
        axes.add_patch(RegularPolygon(node.place, 6, radius=1.25 * width, orientation=pi / 6, **style))
    else:
        axes.add_patch(Circle(node.place, width, **style))
        if node.family == "population":
            axes.add_patch(Circle(node.place, 0.88 * width, **style))


def draw_stroke(axes: Axes, curve: Curve, stroke: Stroke) -> None:
    """Draw a quadratic Bézier curve with the ending of its sign at its last point."""
    tip, control = curve[2], curve[1]
    length = distance(control, tip)
    direction = ((tip[0] - control[0]) / length, (tip[1] - control[1]) / length)
    ending = _ending(tip, direction, stroke)
    line = part(curve, 0.0, max(0.0, 1.0 - 0.8 * _size(stroke) / distance(curve[0], tip)))
    outline = PathPatch(
        Path(line, [Path.MOVETO, Path.CURVE3, Path.CURVE3]),
        fill=False,
        edgecolor=INK[stroke.sign],
        linewidth=stroke.width,
        linestyle=(0, (3.2, 1.4)) if stroke.sign == "inhibitory" else "solid",
        capstyle="butt",
        zorder=1 if stroke.sign == "wire" else 2,
    )
    axes.add_patch(outline)
    axes.add_patch(ending)


def _size(stroke: Stroke) -> float:
    """Return the length of the ending."""
    if stroke.sign == "inhibitory":
        return 2 * _DOT
    return 0.1 if stroke.sign == "wire" else _HEAD + 0.03 * stroke.width


def _ending(tip: Point, direction: Point, stroke: Stroke) -> Circle | Polygon:
    (x, y), (u, v) = tip, direction
    style: dict[str, Any] = {"facecolor": INK[stroke.sign], "linewidth": 0, "zorder": 1 if stroke.sign == "wire" else 4}
    if stroke.sign == "inhibitory":
        return Circle((x - _DOT * u, y - _DOT * v), _DOT, **style)
    size = _size(stroke)
    back, side = (x - size * u, y - size * v), 0.4 * size
    corners = [tip, (back[0] - side * v, back[1] + side * u), (back[0] + side * v, back[1] - side * u)]
    return Polygon(corners, **style)
