"""Rules about how a body starts: within the ranges of its joints, and not below the ground, whatever the seed."""

from collections.abc import Iterable, Iterator, Mapping
from itertools import chain
from math import degrees

from pydantic_core import PydanticCustomError

from neuromech.errors import Problem
from neuromech.graph.checks.world import ends_upside_down, slope_misplaced, step_misplaced, two_grounds
from neuromech.graph.model import BodyModel, ModelGraph
from neuromech.graph.pose import clearances, sunk
from neuromech.graph.signals import matching
from neuromech.graph.start import CLEARANCE, start_units, started, written_start
from neuromech.spec.model import Uniform
from neuromech.spec.scalars import Written
from neuromech.units import Unit

Start = Mapping[str, tuple[str, float, float]]


def angle_starts_outside_range(graph: ModelGraph) -> Iterator[Problem]:
    """What `protocol.initial` says of a joint's angle is in the joint's range."""
    for name, (pattern, low, high) in _start(graph).items():
        joint = graph.body.joints.get(name.removesuffix(".angle")) if graph.body else None
        if joint is None or not name.endswith(".angle") or joint.range is None:
            continue
        for angle in dict.fromkeys((low, high)):
            if not joint.range[0] <= angle <= joint.range[1]:
                path = _path(graph, pattern)
                limits = f"[{degrees(joint.range[0]):g} deg, {degrees(joint.range[1]):g} deg]"
                message = f"is outside the range of joint '{name.removesuffix('.angle')}', {limits}"
                yield graph.document.problem("joint-range", path, message, f"{degrees(angle):g} deg")


def two_heights(graph: ModelGraph) -> Iterator[Problem]:
    """The height of the root is given by itself or by the clearance of its contacts, not by both."""
    start = _start(graph)
    for name, (pattern, _, _) in start.items():
        if name.endswith(f".{CLEARANCE}") and name.removesuffix(CLEARANCE) + "z" in start:
            message = f"stands beside the height of '{name.removesuffix('.' + CLEARANCE)}', which follows from it"
            yield graph.document.problem("two-ways", f"protocol.initial.{pattern}", message, hint="keep one of the two")


def start_below_ground(graph: ModelGraph) -> Iterator[Problem]:
    """No contact starts in the ground, nor at the extremes of a random start."""
    body = graph.body
    if body is None or body.engine == "hinge" or any(not any(joint.axis) for joint in body.joints.values()):
        return
    if any(chain(ends_upside_down(graph), slope_misplaced(graph), step_misplaced(graph), two_grounds(graph))):
        return
    found = sunk(_lowest(body, _start(graph)))
    if found is None:
        return
    name, depth = found
    extreme = " at an extreme of the random start" if any(low < high for _, low, high in _start(graph).values()) else ""
    path = _height_path(graph, body) or graph.element(name).path
    message = f"contact '{name}' starts {1e3 * depth:.3g} mm below the ground{extreme}"
    hint = f"raise the root, or give '{body.root_segment}.{CLEARANCE}' in protocol.initial"
    yield graph.document.problem("start-below-ground", path, message, hint=hint)


def _height_path(graph: ModelGraph, body: BodyModel) -> str:
    """Return the place in the document that decides most on the height of the body at time zero."""
    start = _start(graph)
    for name in (f"{body.root_segment}.{CLEARANCE}", f"{body.root_segment}.z"):
        if name in start:
            return _path(graph, start[name][0])
    return next((_path(graph, pattern) for pattern, low, high in start.values() if low < high), "")


def _path(graph: ModelGraph, pattern: str) -> str:
    value = graph.document.experiment.protocol.initial[pattern]
    return f"protocol.initial.{pattern}" + (".uniform" if isinstance(value, Uniform) else "")


def _lowest(body: BodyModel, start: Start) -> BodyModel:
    """Return the body as it starts where each value stands at that end which brings a contact lower.

    One value after the other goes to its lower end, round after round until none brings a contact lower any more.
    """
    values = {name: low for name, (_, low, _) in start.items()}
    lowest = started(body, values)
    gap = min(clearances(lowest).values(), default=0.0)
    improved = True
    while improved:
        improved = False
        for name, (_, low, high) in start.items():
            other = values | {name: high if values[name] == low else low}
            tried = started(body, other)
            found = min(clearances(tried).values(), default=0.0)
            if found < gap:
                values, lowest, gap, improved = other, tried, found, True
    return lowest


def _start(graph: ModelGraph) -> Start:
    """Return what the document says of the body's start, without what other rules refuse."""
    if graph.body is None:
        return {}
    units = start_units(graph.body)
    initial = graph.document.experiment.protocol.initial
    sound = {pattern: value for pattern, value in initial.items() if _is_sound(matching(pattern, units), units, value)}
    return written_start(graph.body, sound)


def _is_sound(names: Iterable[str], units: Mapping[str, str], value: Written | Uniform) -> bool:
    ends = value.uniform if isinstance(value, Uniform) else (value,)
    try:
        for unit in {units[name] for name in names}:
            for end in ends:
                Unit("value", unit).parse(end)
    except PydanticCustomError:
        return False
    return True
