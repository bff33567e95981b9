"""The ground as engines build it, boxes or a plane, and as our own code asks for it, its height below a point."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import cos, sin, tan
from typing import Any, Final

from neuromech.spec.world import Ground, Slope
from neuromech.units import Quantity

# Where the ground ends that has slopes and is not told where, along x and y.
FARTHEST: Final = ((-100.0, 1000.0), (-10.0, 10.0))
_THICKNESS: Final = 1.0
# How far steps reach into the ground, so that a foot that sinks into one is pushed up.
_DEPTH: Final = 0.1
_TOUCHING: Final = 1e-9


@dataclass(frozen=True, slots=True)
class Stretch:
    """Ground of one angle.

    Args:
        start: x of its beginning in m.
        end: x of its end in m.
        height: at its beginning, in m.
        angle: by which it rises along x, in rad.
        friction: of its surface.
        path: where it stands in the ground of the document, empty for the level ground around slopes.
    """

    start: float
    end: float
    height: float
    angle: float
    friction: float
    path: str = ""

    def height_at(self, x: float) -> float:
        """Return the height at an x in m."""
        return self.height + (x - self.start) * tan(self.angle)


@dataclass(frozen=True, slots=True)
class Box:
    """A piece of the ground.

    Args:
        name: of the piece.
        center: in m.
        size: along x, y and z before it is turned, in m.
        angle: by which its top rises along x, in rad: it is turned by −angle about y.
        friction: of its surface.
    """

    name: str
    center: tuple[float, float, float]
    size: tuple[float, float, float]
    angle: float
    friction: float


@dataclass(frozen=True, slots=True)
class Terrain:
    """The ground.

    Args:
        plane: height in m and friction of the level plane without end, None where the ground is made of boxes only.
        boxes: slopes, level ground with an end, steps.
        corners: (corners, 2) x and height in m along which the ground without steps is straight.
        steps: for `ground_height`; (steps, 8) x and height of the middle, half length, half thickness, sine and
            cosine of the angle, lowest and highest y.
    """

    plane: tuple[float, float] | None
    boxes: tuple[Box, ...]
    corners: tuple[tuple[float, float], ...]
    steps: tuple[tuple[float, ...], ...]

    def height(self, x: float, y: float) -> float:
        """Return the height in m at a point; beyond an end of the ground that of the end."""
        return ground_height(x, y, self.corners, self.steps)

    @property
    def highest(self) -> float:
        """No point of the ground is higher, in m."""
        steps = (row[1] + row[2] * abs(row[4]) + row[3] * row[5] for row in self.steps)
        return max(*(height for _, height in self.corners), *steps, self.corners[0][1])


def terrain(ground: Ground) -> Terrain:
    """Return the ground of a document as pieces; it is as the graph's rules want it."""
    parts = stretches(ground)
    width = ground.y or FARTHEST[1]
    steps = [_step(name, parts, ground) for name in ground.steps]
    level = len(parts) == 1 and not parts[0].path and ground.x is None and ground.y is None
    boxes = [] if level else [_slab(part, width, number) for number, part in enumerate(parts)]
    corners = [(parts[0].start, parts[0].height), *((part.end, part.height_at(part.end)) for part in parts)]
    return Terrain(
        plane=(float(ground.height), float(ground.friction)) if level else None,
        boxes=(*boxes, *steps),
        corners=((0.0, float(ground.height)),) if level else tuple(corners),
        steps=tuple(_row(box) for box in steps),
    )


def stretches(ground: Ground) -> list[Stretch]:
    """Return the slopes of the ground with the level ground around them, in order along x; waves must be drawn."""
    start, end = map(float, ground.x or FARTHEST[0])
    height = float(ground.height)
    found: list[Stretch] = []
    for index, slope in enumerate(all_slopes(ground)):
        first, last = float(slope.start), float(slope.start) + float(slope.length)
        if first - start > _TOUCHING:
            found.append(Stretch(start, first, height, 0.0, float(ground.friction)))
        friction = float(ground.friction if slope.friction is None else slope.friction)
        found.append(Stretch(first, last, height, float(slope.angle), friction, f"slopes.{index}"))
        start, height = last, found[-1].height_at(last)
    if end - start > _TOUCHING:
        found.append(Stretch(start, end, height, 0.0, float(ground.friction)))
    return found


def all_slopes(ground: Ground) -> tuple[Slope, ...]:
    """Return the slopes of the ground; those of an incline where it has one, of equal length and growing angle."""
    incline = ground.incline
    if incline is None:
        return ground.slopes
    length = float(incline.length) / incline.pieces
    return tuple(
        Slope(
            start=Quantity(float(incline.start) + length * number),
            length=Quantity(length),
            angle=Quantity(float(incline.angle) * (number + 1) / incline.pieces),
        )
        for number in range(incline.pieces)
    )


def ground_height(x: float, y: float, corners: Sequence[Any], steps: Sequence[Any]) -> float:
    """Return the height of the ground in m below a point; for `corners` and `steps` see `Terrain`.

    Each of both may be an array too, and the function may be compiled.
    """
    first, last = 0, len(corners) - 1
    while last - first > 1:
        middle = (first + last) // 2
        if corners[middle][0] <= x:
            first = middle
        else:
            last = middle
    start, end = corners[first], corners[last]
    share = min(1.0, max(0.0, (x - start[0]) / (end[0] - start[0]))) if last > first else 0.0
    height: float = start[1] + share * (end[1] - start[1])
    for k in range(len(steps)):
        row = steps[k]
        if y < row[6] or y > row[7]:
            continue
        # Heights between which the vertical line runs inside: between top and bottom, then between the ends.
        d, length, thickness, sine, cosine = x - row[0], row[2], row[3], row[4], row[5]
        high, low = (thickness + sine * d) / cosine, (sine * d - thickness) / cosine
        if sine == 0.0:
            high = high if abs(d) <= length else low - 1.0
        else:
            one, other = (length - cosine * d) / sine, (-length - cosine * d) / sine
            high, low = min(high, max(one, other)), max(low, min(one, other))
        if high >= low:
            height = max(height, row[1] + high)
    return height


def stretch_below(parts: Sequence[Stretch], start: float, end: float) -> Stretch | None:
    """Return the stretch on which something stands from one x to another, None where it is not a single one."""
    for part in parts:
        if part.start - _TOUCHING <= start and end <= part.end + _TOUCHING:
            return part
    return None


def overlaps(ground: Ground) -> Iterator[tuple[int, float]]:
    """Yield the index of each slope that begins before the one before it ends, and where that one ends."""
    for index, (one, next_one) in enumerate(pairwise(ground.slopes), start=1):
        end = float(one.start) + float(one.length)
        if next_one.start < end - _TOUCHING:
            yield index, end


def _slab(part: Stretch, width: tuple[float, float], number: int) -> Box:
    middle = 0.5 * (part.start + part.end)
    length = (part.end - part.start) / cos(part.angle)
    return _box(f"{number}", part, middle, (length, width[1] - width[0], 0.0), 0.5 * (width[0] + width[1]), _THICKNESS)


def _step(name: str, parts: Sequence[Stretch], ground: Ground) -> Box:
    step = ground.steps[name]
    start, end = float(step.start), float(step.start) + float(step.length)
    part = stretch_below(parts, start, end)
    if part is None:
        raise ValueError(f"step '{name}' stands on no single slope")
    friction = ground.friction if step.friction is None else step.friction
    size = (float(step.length) / cos(part.angle), float(step.width), float(step.height))
    box = _box(f"step:{name}", part, 0.5 * (start + end), size, float(step.middle), _DEPTH)
    return Box(box.name, box.center, box.size, box.angle, float(friction))


def _box(name: str, part: Stretch, x: float, size: tuple[float, float, float], y: float, depth: float) -> Box:
    """Return a box that rises from a stretch by its size and reaches into the ground by a depth."""
    length, width, height = size
    shift = 0.5 * (height - depth)
    center = (x - shift * sin(part.angle), y, part.height_at(x) + shift * cos(part.angle))
    return Box(name, center, (length, width, height + depth), part.angle, part.friction)


def _row(box: Box) -> tuple[float, ...]:
    x, y, z = box.center
    length, width, thickness = (0.5 * side for side in box.size)
    return (x, z, length, thickness, sin(box.angle), cos(box.angle), y - width, y + width)
