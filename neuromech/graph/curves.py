"""Curves between the nodes of a picture: quadratic Bézier curves that start and end outside the two nodes."""

from collections.abc import Iterable
from dataclasses import dataclass
from math import cos, hypot, pi, sin

from neuromech.graph.layout import Point
from neuromech.graph.model import NodeFamily

Curve = tuple[Point, Point, Point]

RADIUS = 0.36
REACH: dict[NodeFamily, Point] = {
    "neuron": (RADIUS, RADIUS),
    "population": (RADIUS, RADIUS),
    "drive": (RADIUS, RADIUS),
    "sensor": (RADIUS, RADIUS),
    "muscle": (0.49, 0.25),
}

_BENDS = (0.05, -0.05, 0.13, -0.13, 0.22, -0.22, 0.32, -0.32)
_SIDEWAYS = (0.28, -0.28, 0.2, 0.4, -0.2, -0.4)
_SAMPLES = 200
_PROBES = 24


@dataclass(frozen=True, slots=True)
class Node:
    """A node of the picture: its centre, and the family that gives its shape."""

    family: NodeFamily
    place: Point

    def covers(self, point: Point) -> bool:
        """Return whether a point lies within the node or its narrow margin."""
        width, height = (1.08 * reach for reach in REACH[self.family])
        return hypot((point[0] - self.place[0]) / width, (point[1] - self.place[1]) / height) < 1.0


def between(start: Node, end: Node, others: Iterable[Node]) -> Curve:
    """Return the curve from one node to another that hides behind the fewest others; a loop from a node to itself."""
    if start == end:
        return _outside(_loop(start.place), start, end)
    obstacles = [node for node in others if node not in (start, end)]
    bends = _SIDEWAYS if start.place[1] == end.place[1] else _BENDS
    curves = (_bent(start.place, end.place, bend) for bend in bends)
    best, fewest = None, len(obstacles) + 1
    for curve in curves:
        hidden = _hidden_by(curve, obstacles)
        if hidden < fewest:
            best, fewest = curve, hidden
        if fewest == 0:
            break
    assert best is not None
    return _outside(best, start, end)


def _hidden_by(curve: Curve, nodes: Iterable[Node]) -> int:
    """Return how many nodes a curve passes behind."""
    probes = [at(curve, i / _PROBES) for i in range(_PROBES + 1)]
    left, right = min(x for x, _ in probes) - RADIUS, max(x for x, _ in probes) + RADIUS
    low, high = min(y for _, y in probes) - RADIUS, max(y for _, y in probes) + RADIUS
    near = (node for node in nodes if left < node.place[0] < right and low < node.place[1] < high)
    return sum(any(map(node.covers, probes)) for node in near)


def _bent(start: Point, end: Point, bend: float) -> Curve:
    dx, dy = end[0] - start[0], end[1] - start[1]
    middle = (start[0] + dx / 2 - bend * dy, start[1] + dy / 2 + bend * dx)
    return start, middle, end


def _loop(place: Point) -> Curve:
    """Return a curve from one side of a node to the other, outside around its top left."""
    x, y = place
    start = (x + RADIUS * cos(0.85 * pi), y + RADIUS * sin(0.85 * pi))
    end = (x + RADIUS * cos(0.6 * pi), y + RADIUS * sin(0.6 * pi))
    return start, (x - 2.2 * RADIUS, y + 2.6 * RADIUS), end


def _outside(curve: Curve, start: Node, end: Node) -> Curve:
    """Return the part of a curve that lies outside its two nodes."""
    samples = [i / _SAMPLES for i in range(_SAMPLES + 1)]
    outside = [t for t in samples if not (start.covers(at(curve, t)) or end.covers(at(curve, t)))]
    return part(curve, outside[0], outside[-1]) if len(outside) > 1 else curve


def part(curve: Curve, begin: float, end: float) -> Curve:
    """Return the quadratic Bézier curve that is the part of another one between two parameters."""
    first, last = at(curve, begin), at(curve, end)
    control = (_blossom(curve, begin, end, 0), _blossom(curve, begin, end, 1))
    return first, control, last


def at(curve: Curve, t: float) -> Point:
    """Return the point of a curve at a parameter in 0…1."""
    return _blossom(curve, t, t, 0), _blossom(curve, t, t, 1)


def _blossom(curve: Curve, s: float, t: float, axis: int) -> float:
    a, b, c = (point[axis] for point in curve)
    return (1 - s) * (1 - t) * a + (s * (1 - t) + t * (1 - s)) * b + s * t * c


def distance(one: Point, other: Point) -> float:
    """Return the distance between two points."""
    return hypot(one[0] - other[0], one[1] - other[1])
