"""Rules about the ground: its ends, slopes and steps."""

from collections.abc import Iterator

from neuromech.errors import Problem
from neuromech.graph.model import ModelGraph
from neuromech.graph.terrain import FARTHEST, overlaps, stretch_below, stretches
from neuromech.spec.world import Ground, Step

_ROUNDING = 1e-9


def ends_upside_down(graph: ModelGraph) -> Iterator[Problem]:
    """The ground ends behind where it begins."""
    ground = graph.document.experiment.world.ground
    for axis, ends in _given_ends(ground).items():
        if not ends[0] < ends[1]:
            message = "must have where the ground begins first and where it ends second"
            yield graph.document.problem("ground-ends", f"world.ground.{axis}", message, _interval(ends))


def slope_misplaced(graph: ModelGraph) -> Iterator[Problem]:
    """Slopes stand in order along x, none on another, all on the ground."""
    ground = graph.document.experiment.world.ground
    if ground is None or not _sound(ground):
        return
    for index, end in overlaps(ground):
        message = f"begins before slope {index - 1} ends, at {end:g} m"
        got = f"{float(ground.slopes[index].start):g} m"
        hint = "list the slopes in order along x, each from where the one before it ends or later"
        yield graph.document.problem("overlapping-slopes", f"world.ground.slopes.{index}.start", message, got, hint)
    low, high = ground.x or FARTHEST[0]
    for index, slope in enumerate(ground.slopes):
        ends = (float(slope.start), float(slope.start) + float(slope.length))
        if ends[0] < low - _ROUNDING or ends[1] > high + _ROUNDING:
            message = f"is outside the ground, which reaches from {low:g} m to {high:g} m"
            hint = "let the ground reach farther with 'x'"
            path = f"world.ground.slopes.{index}"
            yield graph.document.problem("outside-ground", path, message, _interval(ends), hint)


def step_misplaced(graph: ModelGraph) -> Iterator[Problem]:
    """A step stands on the ground, and on one slope or on level ground."""
    ground = graph.document.experiment.world.ground
    if ground is None or not _sound(ground):
        return
    parts = None if any(overlaps(ground)) else stretches(ground)
    for name, step in ground.steps.items():
        path = f"world.ground.steps.{name}"
        for axis, ends in _footprint(step).items():
            limits = _ends(ground, axis)
            if limits is not None and (ends[0] < limits[0] - _ROUNDING or ends[1] > limits[1] + _ROUNDING):
                message = f"is outside the ground, whose {axis} reaches from {limits[0]:g} m to {limits[1]:g} m"
                yield graph.document.problem("outside-ground", path, message, f"{axis} {_interval(ends)}")
                break
        else:
            if ground.slopes and parts is not None and stretch_below(parts, *_footprint(step)["x"]) is None:
                message = "stands on two slopes at once, or on a slope and level ground"
                hint = "move it onto one slope, or onto level ground"
                got = f"x {_interval(_footprint(step)['x'])}"
                yield graph.document.problem("step-between-slopes", path, message, got, hint)


def hinge_engine_knows_no_ground(graph: ModelGraph) -> Iterator[Problem]:
    """The engine `hinge` has nothing that could stand on slopes or steps."""
    ground = graph.document.experiment.world.ground
    if graph.body is None or graph.body.engine != "hinge" or ground is None:
        return
    for field in ("slopes", "steps"):
        if getattr(ground, field):
            hint = "use engine 'pybullet' or 'mujoco'"
            message = f"engine 'hinge' knows no {field}"
            yield graph.document.problem("hinge-engine", f"world.ground.{field}", message, hint=hint)


def _given_ends(ground: Ground | None) -> dict[str, tuple[float, float]]:
    given = {"x": ground.x, "y": ground.y} if ground is not None else {}
    return {axis: (float(ends[0]), float(ends[1])) for axis, ends in given.items() if ends is not None}


def _ends(ground: Ground, axis: str) -> tuple[float, float] | None:
    """Return where the ground ends along an axis, None where it does not."""
    given = _given_ends(ground)
    if axis in given or not (given or ground.slopes):
        return given.get(axis)
    return FARTHEST[0] if axis == "x" else FARTHEST[1]


def _sound(ground: Ground) -> bool:
    return all(low < high for low, high in _given_ends(ground).values())


def _footprint(step: Step) -> dict[str, tuple[float, float]]:
    start, middle, half = float(step.start), float(step.middle), 0.5 * float(step.width)
    return {"x": (start, start + float(step.length)), "y": (middle - half, middle + half)}


def _interval(ends: tuple[float, float]) -> str:
    return f"{ends[0]:g} m to {ends[1]:g} m"
