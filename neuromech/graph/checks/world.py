"""Rules about the ground: its ends, slopes and steps."""

from collections.abc import Iterator

from neuromech.errors import Problem
from neuromech.graph.model import ModelGraph
from neuromech.graph.terrain import FARTHEST, overlaps, stretch_below, stretches
from neuromech.spec.pushes import RandomLength
from neuromech.spec.world import Ground, Incline, Slope, Step

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
    named: list[tuple[str, Slope | Incline]] = [(f"slopes.{index}", one) for index, one in enumerate(ground.slopes)]
    named += [] if ground.incline is None else [("incline", ground.incline)]
    for field, slope in named:
        ends = (float(slope.start), float(slope.start) + float(slope.length))
        if ends[0] < low - _ROUNDING or ends[1] > high + _ROUNDING:
            message = f"is outside the ground, which reaches from {low:g} m to {high:g} m"
            hint = "let the ground reach farther with 'x'"
            yield graph.document.problem("outside-ground", f"world.ground.{field}", message, _interval(ends), hint)
    if ground.waves is not None and not low <= ground.waves.start < high:
        message = f"is outside the ground, which reaches from {low:g} m to {high:g} m"
        got = f"{float(ground.waves.start):g} m"
        yield graph.document.problem("outside-ground", "world.ground.waves.start", message, got)


def step_misplaced(graph: ModelGraph) -> Iterator[Problem]:
    """A step stands on the ground, and on one slope or on level ground."""
    ground = graph.document.experiment.world.ground
    if ground is None or not _sound(ground):
        return
    parts = None if any(overlaps(ground)) or ground.incline is not None else stretches(ground)
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


def two_grounds(graph: ModelGraph) -> Iterator[Problem]:
    """Slopes, an incline and waves exclude each other; steps stand before an incline or waves."""
    ground = graph.document.experiment.world.ground
    if ground is None:
        return
    kinds = [kind for kind in ("slopes", "incline", "waves") if getattr(ground, kind)]
    for kind in kinds[1:]:
        message = f"stands beside '{kinds[0]}'"
        yield graph.document.problem("two-ways", f"world.ground.{kind}", message, hint="keep one of the two")
    for kind, random in (("incline", ground.incline), ("waves", ground.waves)):
        for name, step in ground.steps.items():
            if random is not None and _footprint(step)["x"][1] > random.start + _ROUNDING:
                path, message = f"world.ground.steps.{name}", f"reaches over the beginning of '{kind}'"
                got = f"x {_interval(_footprint(step)['x'])}"
                yield graph.document.problem("step-between-slopes", path, message, got, f"end it before '{kind}'")


def wave_without_length(graph: ModelGraph) -> Iterator[Problem]:
    """Lengths and spaces of waves have one distribution, which gives positive lengths."""
    ground = graph.document.experiment.world.ground
    if ground is None or ground.waves is None:
        return
    for field in ("length", "space"):
        value: RandomLength = getattr(ground.waves, field)
        path = f"world.ground.waves.{field}"
        given = [kind for kind in ("uniform", "normal") if getattr(value, kind) is not None]
        if len(given) != 1:
            got, hint = " and ".join(given) or "none", "give one of uniform, normal"
            yield graph.document.problem("one-distribution", path, "needs one distribution", got, hint)
        elif value.uniform is not None and not 0.0 < value.uniform[0] <= value.uniform[1]:
            message = "must be positive, its lowest value first and its highest second"
            yield graph.document.problem("one-distribution", f"{path}.uniform", message, _interval(value.uniform))
        elif value.normal is not None and not value.normal[0] > 0.0:
            message, got = "must have a positive mean", f"{float(value.normal[0]):g} m"
            yield graph.document.problem("one-distribution", f"{path}.normal", message, got)


def hinge_engine_knows_no_ground(graph: ModelGraph) -> Iterator[Problem]:
    """The engine `hinge` has nothing that could stand on slopes or steps."""
    ground = graph.document.experiment.world.ground
    if graph.body is None or graph.body.engine != "hinge" or ground is None:
        return
    for field in ("slopes", "incline", "waves", "steps"):
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
    if axis in given or not (given or ground.slopes or ground.incline or ground.waves):
        return given.get(axis)
    return FARTHEST[0] if axis == "x" else FARTHEST[1]


def _sound(ground: Ground) -> bool:
    return all(low < high for low, high in _given_ends(ground).values())


def _footprint(step: Step) -> dict[str, tuple[float, float]]:
    start, middle, half = float(step.start), float(step.middle), 0.5 * float(step.width)
    return {"x": (start, start + float(step.length)), "y": (middle - half, middle + half)}


def _interval(ends: tuple[float, float]) -> str:
    return f"{ends[0]:g} m to {ends[1]:g} m"
