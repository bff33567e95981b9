"""The pushes of a run, drawn from its seed."""

from collections.abc import Iterator
from math import cos, inf, sin

import numpy as np

from neuromech.compiler.program import Program
from neuromech.compiler.pushes import NO_PUSHES, Pushes
from neuromech.compiler.wiring import generator
from neuromech.graph.model import BodyModel, Element
from neuromech.spec.pushes import Push, PushSeries, RandomAngle, RandomLength, RandomTime

Vector = tuple[float, float, float]
Acting = tuple[float, float, Vector, Vector]


def drawn_pushes(program: Program, body: BodyModel, seed: int, duration: float) -> Pushes:
    """Return the pushes of a run of a body.

    Each element draws from a generator of its own, made from the seed and its name, push after push, so that a
    shorter run has the same pushes.

    Args:
        program: what is run.
        body: the body.
        seed: of the run.
        duration: of the run in s.
    """
    numbers: list[tuple[float, ...]] = []
    places: list[tuple[int, int]] = []
    segments = list(body.segments)
    for element in program.graph.elements("push"):
        assert isinstance(element.spec, Push | PushSeries)
        center = _vector(body.segments[element.spec.segment].center_of_mass)
        row = segments.index(element.spec.segment)
        for start, end, force, point in _acting(element, center, seed, duration):
            numbers.append((start, end, *force, *point, *center))
            places.append((row, program.layout.signals[f"{element.name}.force_x"]))
    return Pushes(np.array(numbers), np.array(places, dtype=np.int64)) if numbers else NO_PUSHES


def _acting(element: Element, center: Vector, seed: int, duration: float) -> Iterator[Acting]:
    random = generator(seed, element.name)
    if isinstance(element.spec, Push):
        yield _single(element.spec, center, random)
    elif isinstance(element.spec, PushSeries):
        yield from _series(element.spec, random, min(duration, float(element.spec.end or inf)))


def _single(push: Push, center: Vector, random: np.random.Generator) -> Acting:
    start = float(push.start) + (0.0 if push.delay is None else _time(push.delay, random))
    point = center if push.point is None else _vector(push.point)
    return start, start + float(push.duration), _vector(push.force), point


def _series(series: PushSeries, random: np.random.Generator, last: float) -> Iterator[Acting]:
    now, number = float(series.start), 0
    x, y, z = _vector(series.point)
    while True:
        number += 1
        growth = min(1.0, number / series.growing_over)
        now += _time(series.interval, random)
        length = _time(series.duration, random)
        force = growth * random.normal(float(series.force), float(series.deviation))
        angle = length_or_angle(series.angle, random)
        heading = 0.0 if series.heading is None else length_or_angle(series.heading, random)
        height = length_or_angle(series.height, random)
        if now >= last:
            return
        flat = force * cos(angle)
        yield now, now + length, (flat * cos(heading), flat * sin(heading), force * sin(angle)), (x, y, z + height)
        now += length


def _time(time: RandomTime, random: np.random.Generator) -> float:
    if time.uniform is not None:
        return float(random.uniform(*time.uniform))
    if time.gamma is not None:
        return float(random.gamma(*time.gamma))
    if time.f is not None:
        above, below, scale = time.f
        return float(scale * random.f(above, below))
    raise ValueError("a random time without a distribution")


def length_or_angle(value: RandomLength | RandomAngle, random: np.random.Generator) -> float:
    """Draw a length in m or an angle in rad."""
    if value.uniform is not None:
        return float(random.uniform(*value.uniform))
    if value.normal is not None:
        return float(random.normal(*value.normal))
    raise ValueError("a random length or angle without a distribution")


def _vector(values: tuple[float, float, float]) -> Vector:
    return float(values[0]), float(values[1]), float(values[2])
