"""Rules about pushes: an engine that can push, distributions that say one thing, times within the run."""

from collections.abc import Iterator

from neuromech.errors import Problem
from neuromech.graph.model import ModelGraph
from neuromech.spec.pushes import Push, PushSeries, RandomAngle, RandomLength, RandomTime


def hinge_engine_knows_no_push(graph: ModelGraph) -> Iterator[Problem]:
    """The engine `hinge` moves its joint by torques alone."""
    if graph.body is not None and graph.body.engine == "hinge":
        for element in graph.elements("push"):
            hint = "use engine 'pybullet' or 'mujoco'"
            yield graph.document.problem("hinge-engine", element.path, "engine 'hinge' knows no pushes", hint=hint)


def one_distribution(graph: ModelGraph) -> Iterator[Problem]:
    """A random value has one distribution, and an interval has its lower end first."""
    for element in graph.elements("push"):
        for field in type(element.spec).model_fields:
            value = getattr(element.spec, field)
            if not isinstance(value, RandomTime | RandomAngle | RandomLength):
                continue
            path, kinds = f"{element.path}.{field}", list(type(value).model_fields)
            given = [kind for kind in kinds if getattr(value, kind) is not None]
            if len(given) != 1:
                got, hint = " and ".join(given) or "none", f"give one of {', '.join(kinds)}"
                yield graph.document.problem("one-distribution", path, "needs one distribution", got, hint)
            elif value.uniform is not None and value.uniform[0] > value.uniform[1]:
                message = "must have its lowest value first and its highest second"
                yield graph.document.problem("one-distribution", f"{path}.uniform", message)


def push_after_the_end(graph: ModelGraph) -> Iterator[Problem]:
    """A push begins before the run ends, a series before its last push may begin."""
    duration = float(graph.document.experiment.protocol.duration)
    for element in graph.elements("push"):
        spec = element.spec
        last = min(duration, float(spec.end)) if isinstance(spec, PushSeries) and spec.end is not None else duration
        if isinstance(spec, Push | PushSeries) and spec.start >= last:
            message = f"must be before {last:g} s, when the run or the series ends"
            yield graph.document.problem("after-the-end", f"{element.path}.start", message, f"{float(spec.start):g} s")


def series_that_never_advances(graph: ModelGraph) -> Iterator[Problem]:
    """Intervals and pushes of a series take time."""
    for element in graph.elements("push"):
        spec = element.spec
        if isinstance(spec, PushSeries) and _is_nothing(spec.interval) and _is_nothing(spec.duration):
            message = "and duration are both zero, so that the series never ends"
            yield graph.document.problem("no-time", f"{element.path}.interval", message)


def _is_nothing(time: RandomTime) -> bool:
    return time.uniform is not None and time.uniform[1] == 0.0
