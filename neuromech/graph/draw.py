"""A picture of the network: a panel for each instance, a row for each layer, signs that need no colour."""

import re
from math import sqrt
from pathlib import Path

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import FancyBboxPatch

from neuromech.components.base import Synapse
from neuromech.graph.curves import Node, between
from neuromech.graph.layout import DRAWN, Layout, Panel, bounds, layout
from neuromech.graph.model import Connection, Element, ModelGraph, NodeFamily
from neuromech.graph.strokes import INK, Sign, Stroke, draw_node, draw_stroke

_INCHES = 0.62
_LEGEND = 2.2
_LEGEND_WIDTH = 7.1
_TEXT_SIZE: dict[str, tuple[float, float]] = {
    "neuron": (30, 24),
    "population": (26, 21),
    "drive": (34, 22),
    "sensor": (30, 24),
    "muscle": (40, 20),
}
_MARKED = (1.0, 0.1, 0.01)
_WIRE = 0.5


def draw(graph: ModelGraph, file: Path) -> None:
    """Write the picture of a network as SVG; the same graph gives the same file.

    Raises:
        OSError: the file cannot be written.
    """
    with mpl.rc_context({"svg.fonttype": "none", "svg.hashsalt": "neuromech"}):
        figure(graph).savefig(file, format="svg", metadata={"Date": None, "Title": graph.document.experiment.name})


def figure(graph: ModelGraph) -> Figure:
    """Return the picture as a Matplotlib figure.

    Excitatory synapses are solid and end in an arrowhead, inhibitory ones are dashed and end in a dot; their width
    grows with the square root of the weight. Thin grey arrows are signals that are passed on as they are.
    """
    found = layout(graph)
    left, right, bottom, top = bounds(found)
    bottom -= _LEGEND
    right = max(right, left + _LEGEND_WIDTH)
    result = Figure(figsize=(_INCHES * (right - left), _INCHES * (top - bottom)))
    axes = result.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set(xlim=(left, right), ylim=(bottom, top), aspect="equal")
    axes.set_axis_off()
    for panel in found.panels:
        _draw_panel(axes, panel)
    _draw_connections(axes, graph, found)
    for name, place in found.places.items():
        node = Node(graph.element(name).family, place)
        draw_node(axes, node)
        _write(axes, node, _label(graph.element(name)))
    _write_crossed_joints(axes, graph, found)
    families = [family for family in DRAWN if any(graph.elements(family))]
    _draw_legend(axes, left, bottom, families, _largest_weight(graph))
    return result


def _draw_panel(axes: Axes, panel: Panel) -> None:
    frame = FancyBboxPatch(
        (panel.left, panel.bottom),
        panel.width,
        panel.height,
        boxstyle="round,pad=0,rounding_size=0.25",
        facecolor="#f7f7f5",
        edgecolor="#c9c9c4",
        linewidth=0.8,
        zorder=0,
    )
    axes.add_patch(frame)
    corner = (panel.left + 0.1, panel.bottom + panel.height + 0.08)
    axes.text(*corner, panel.title, fontsize=10, fontweight="bold", va="bottom", ha="left", zorder=5)
    for title, y in panel.rows:
        place = (panel.left + 0.16, y)
        axes.text(*place, title, fontsize=5.5, color="#6b6b6b", rotation=90, va="center", ha="center", zorder=5)


def _draw_connections(axes: Axes, graph: ModelGraph, found: Layout) -> None:
    largest = _largest_weight(graph)
    nodes = {name: Node(graph.element(name).family, place) for name, place in found.places.items()}
    drawn = set[tuple[str, str]]()
    for sender, receiver, connection in graph.connections("wire", "synapse", "projection"):
        repeated_wire = connection.kind == "wire" and (sender, receiver) in drawn
        if sender in nodes and receiver in nodes and not repeated_wire:
            curve = between(nodes[sender], nodes[receiver], nodes.values())
            draw_stroke(axes, curve, _stroke(connection, largest))
            drawn.add((sender, receiver))


def _largest_weight(graph: ModelGraph) -> float:
    return max((_weight(connection) for _, _, connection in graph.connections("synapse", "projection")), default=0.0)


def _stroke(connection: Connection, largest: float) -> Stroke:
    if isinstance(connection.spec, Synapse):
        return Stroke(connection.spec.sign, _width(_weight(connection), largest))
    return Stroke("wire", _WIRE)


def _weight(connection: Connection) -> float:
    return float(getattr(connection.spec, "weight", 1.0))


def _width(weight: float, largest: float) -> float:
    """Return the width in points of a synapse."""
    return 0.5 + 2.3 * sqrt(weight / largest) if largest > 0.0 else 0.5


def _write(axes: Axes, node: Node, name: str) -> None:
    lines = _lines(name)
    width, height = _TEXT_SIZE[node.family]
    size = min(7.0, width / (0.62 * max(map(len, lines))), height / (1.15 * len(lines)))
    axes.text(*node.place, "\n".join(lines), fontsize=size, ha="center", va="center", linespacing=0.95, zorder=6)


def _write_crossed_joints(axes: Axes, graph: ModelGraph, found: Layout) -> None:
    """Write the joints that a muscle crosses at its far side."""
    joints: dict[str, list[str]] = {}
    for muscle, joint, _ in graph.connections("crossing"):
        joints.setdefault(muscle, []).append(joint.rpartition(".")[2])
    for muscle, names in joints.items():
        x, y = found.places[muscle]
        side = 1.0 if y > 0.0 else -1.0
        axes.text(x, y + 0.38 * side, ", ".join(names), fontsize=5, color="#6b6b6b", ha="center", va="center", zorder=6)


def _label(element: Element) -> str:
    name = element.name.rpartition(".")[2]
    return f"{name}_×{element.size}" if element.population else name


def _lines(name: str) -> list[str]:
    """Return a name as lines of a label, broken after `_` and `-` where it is long."""
    lines = [""]
    for part in re.findall(r"[^_-]+[_-]?|[_-]", name):
        if lines[-1] and len(lines[-1]) + len(part) > 7:
            lines.append("")
        lines[-1] += part
    return lines


def _draw_legend(axes: Axes, left: float, bottom: float, families: list[NodeFamily], largest: float) -> None:
    """Draw three lines of marks with their meaning, with the strokes and nodes of the picture itself."""
    for index, family in enumerate(families):
        place = (left + 0.65 + 1.75 * index, bottom + 1.65)
        draw_node(axes, Node(family, place))
        axes.text(place[0] + 0.55, place[1], family, fontsize=7, va="center")
    marks: tuple[tuple[Sign, float, str], ...] = (
        ("excitatory", 1.4, "excites"),
        ("inhibitory", 1.4, "inhibits"),
        ("wire", _WIRE, "is read by"),
    )
    x, y = left + 0.2, bottom + 0.85
    for sign, width, words in marks:
        draw_stroke(axes, ((x, y), (x + 0.4, y), (x + 0.8, y)), Stroke(sign, width))
        axes.text(x + 0.9, y, words, fontsize=7, va="center")
        x += 1.95
    x, y = left + 0.2, bottom + 0.35
    axes.text(x, y, "weight", fontsize=7, va="center")
    for relative in _MARKED if largest > 0.0 else ():
        axes.plot(
            [x + 0.9, x + 1.3], [y, y], color=INK["excitatory"], linewidth=_width(relative, 1.0), solid_capstyle="butt"
        )
        axes.text(x + 1.36, y, f"{relative * largest:.2g}", fontsize=7, va="center")
        x += 0.95
