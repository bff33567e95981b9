"""Where the elements of a network stand in its picture: a panel for each instance, a row for each layer."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from itertools import product
from math import ceil

from neuromech.components.base import Neuron
from neuromech.graph.model import Element, ModelGraph, NodeFamily

DRAWN: tuple[NodeFamily, ...] = ("drive", "sensor", "neuron", "population", "muscle")
ROW_TITLES = (
    "Drives, sensors",
    "Rhythm generator",
    "Pattern formation",
    "Interneurons",
    "Motoneurons",
    "Muscles",
)
_LAYER_ROWS = {"rhythm_generator": 1, "pattern_formation": 2, "interneuron": 3, None: 3, "motoneuron": 4}

ROW_HEIGHT = 1.35
NODE_WIDTH = 1.08
MARGIN = 0.75
GAP = 1.0
BAND = 1.2
EDGE = 0.12
TITLE = 0.4
_SWEEPS = 12

Point = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Panel:
    """A frame around the elements of one instance.

    Args:
        title: name of the instance, empty for the elements of the document itself.
        left, bottom, width, height: the frame, in node widths.
        rows: title and vertical position of each row, the first layer first.
    """

    title: str
    left: float
    bottom: float
    width: float
    height: float
    rows: tuple[tuple[str, float], ...]


@dataclass(frozen=True, slots=True)
class Layout:
    """Panels, and the centre of each element by qualified name."""

    panels: tuple[Panel, ...]
    places: Mapping[str, Point]


def layout(graph: ModelGraph) -> Layout:
    """Return where everything stands: instances in two rows whose rhythm generators face each other.

    Elements of the document itself stand between the rows where there are instances.
    """
    groups = _groups(graph) or {"": {}}
    alone = groups.pop("") if "" in groups and len(groups) > 1 else {}
    rows = sorted({row for group in groups.values() for row in group})
    ordered = {name: _ordered(graph, group) for name, group in groups.items()}
    width = NODE_WIDTH * max((len(row) for group in ordered.values() for row in group.values()), default=1)
    frame = (width + 2 * MARGIN, ROW_HEIGHT * max(len(rows) - 1, 0) + 2 * MARGIN)
    columns = len(groups) if len(groups) < 3 else ceil(len(groups) / 2)
    places: dict[str, Point] = {}
    panels = []
    for index, (name, group) in enumerate(ordered.items()):
        panels.append(_panel(name, index, columns, len(groups), frame, rows, bool(alone)))
        places |= _places(panels[-1], group, rows)
    band = [element for row in sorted(alone) for element in alone[row]]
    middle = 0.5 * (columns * (frame[0] + GAP) - GAP)
    height = -0.5 * BAND if len(groups) > 2 else 0.5 * BAND
    places |= {name: (middle + NODE_WIDTH * (i - 0.5 * (len(band) - 1)), height) for i, name in enumerate(band)}
    return Layout(tuple(panels), places)


def _groups(graph: ModelGraph) -> dict[str, dict[int, list[str]]]:
    """Return the drawn elements by outermost instance and row, in authored order."""
    groups: dict[str, dict[int, list[str]]] = {}
    for element in graph.elements(*DRAWN):
        rows = groups.setdefault(element.scope.partition(".")[0], {})
        rows.setdefault(_row(element), []).append(element.name)
    return groups


def _row(element: Element) -> int:
    if isinstance(element.spec, Neuron):
        return _LAYER_ROWS[element.spec.layer]
    return len(ROW_TITLES) - 1 if element.family == "muscle" else 0


def _ordered(graph: ModelGraph, rows: Mapping[int, list[str]]) -> dict[int, list[str]]:
    """Return the rows in an order that keeps connected elements near each other (repeated barycentres)."""
    members = {name for row in rows.values() for name in row}
    links = {name: set[str]() for name in members}
    for sender, receiver, _ in graph.connections("synapse", "projection", "wire"):
        if sender in members and receiver in members and sender != receiver:
            links[sender].add(receiver)
            links[receiver].add(sender)
    best = current = {row: list(names) for row, names in rows.items()}
    for sweep in range(_SWEEPS):
        current = dict(current)
        for row in sorted(current, reverse=bool(sweep % 2)):
            current[row] = _by_barycentre(current, row, links)
        best = min(best, current, key=lambda order: _stretch(order, links))
    return {row: best[row] for row in sorted(best)}


def _by_barycentre(rows: Mapping[int, list[str]], row: int, links: Mapping[str, set[str]]) -> list[str]:
    x = _centred(rows)
    means = {name: _mean((x[other] for other in sorted(links[name])), x[name]) for name in rows[row]}
    return sorted(rows[row], key=means.__getitem__)


def _centred(rows: Mapping[int, list[str]]) -> dict[str, float]:
    """Return the horizontal position of each element, rows spread evenly over -1…1."""
    return {name: (2 * i + 1) / len(row) - 1.0 for row in rows.values() for i, name in enumerate(row)}


def _stretch(rows: Mapping[int, list[str]], links: Mapping[str, set[str]]) -> float:
    x = _centred(rows)
    return sum(abs(x[name] - x[other]) for name, others in links.items() for other in others)


def _mean(values: Iterable[float], otherwise: float) -> float:
    found = list(values)
    return sum(found) / len(found) if found else otherwise


def _panel(name: str, index: int, columns: int, count: int, frame: Point, rows: list[int], band: bool) -> Panel:
    """Return the frame of an instance; y = 0 separates the first row of panels (upside down) from the second."""
    width, height = frame
    upper = count > 2 and index < columns
    left = (index % columns) * (width + GAP)
    first = 0.0 if upper or count <= 2 else -(BAND if band else GAP)
    bottom = first if upper else first - height
    down = 1.0 if upper else -1.0
    start = first + down * MARGIN
    titles = tuple((ROW_TITLES[row], start + down * ROW_HEIGHT * i) for i, row in enumerate(rows))
    return Panel(name, left, bottom, width, height, titles)


def _places(panel: Panel, group: Mapping[int, list[str]], rows: list[int]) -> dict[str, Point]:
    inner = panel.width - 2 * MARGIN
    places = {}
    for (_, y), row in zip(panel.rows, rows, strict=True):
        names = group.get(row, [])
        for i, name in enumerate(names):
            places[name] = (panel.left + MARGIN + inner * (2 * i + 1) / (2 * len(names)), y)
    return places


def bounds(found: Layout) -> tuple[float, float, float, float]:
    """Return left, right, bottom and top of a layout."""
    xs = [x for panel in found.panels for x in (panel.left, panel.left + panel.width)]
    ys = [y for panel in found.panels for y in (panel.bottom, panel.bottom + panel.height + TITLE)]
    xs += [x + side for (x, _), side in product(found.places.values(), (-MARGIN, MARGIN))]
    ys += [y + side for (_, y), side in product(found.places.values(), (-MARGIN, MARGIN))]
    return min(xs) - EDGE, max(xs) + EDGE, min(ys) - EDGE, max(ys) + EDGE
