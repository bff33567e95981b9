"""Rules about sweeps: which values parameters get, and when they are measured."""

import math
from collections.abc import Iterator, Mapping

from neuromech.errors import Problem, did_you_mean
from neuromech.spec.bounds import Bounds, check_value
from neuromech.spec.clocks import time_text, whole_multiple
from neuromech.spec.model import Parameter, Protocol
from neuromech.spec.node import join
from neuromech.spec.sweep import Sweep, Varied
from neuromech.units import Quantity, measure, repr_short

RESERVED = frozenset({"seed", "outcome", "end", "message"})
"""Names of a sweep's results that no measure and no varied parameter can have."""

MOST_POINTS = 1_000_000


def check_sweep(
    name: str, sweep: Sweep, parameters: Mapping[str, Parameter] | None, protocol: Protocol | None
) -> Iterator[Problem]:
    """Yield what is wrong with a sweep; sections of the document that are broken are None."""
    path = join("sweeps", name)
    for key, varied in (("vary", sweep.vary), ("for_each", sweep.for_each)):
        for parameter, one in varied.items():
            yield from _varied(parameter, one, parameters, f"{path}.{key}.{parameter}")
    yield from _varied_twice(sweep, path)
    yield from _names(sweep, path)
    if sweep.design == "pairs" and len(sweep.vary) < 2:
        yield Problem("too-few", join(path, "vary"), "must be at least two parameters for pairs", str(len(sweep.vary)))
    if points(sweep) > MOST_POINTS:
        yield Problem("too-many", path, f"must have at most {MOST_POINTS} points", str(points(sweep)))
    if sweep.within_one_run is not None:
        yield from _within_one_run(sweep, path)
        yield from _moved(sweep, protocol, path)


def points(sweep: Sweep) -> int:
    """Return how many points a sweep has, seeds not counted."""
    counts = [size(varied) for varied in sweep.vary.values()]
    if sweep.design == "one_at_a_time":
        found = sum(counts)
    elif sweep.design == "pairs":
        found = sum(one * other for index, one in enumerate(counts) for other in counts[index + 1 :])
    else:
        found = math.prod(counts)
    return found * math.prod(size(varied) for varied in sweep.for_each.values())


def size(varied: Varied) -> int:
    """Return how many values a parameter gets."""
    return varied.count or len(varied.values)


def sweep_clocks(name: str, sweep: Sweep, tick: Quantity, tick_name: str) -> Iterator[Problem]:
    """Yield the times of a sweep that no step of the run falls on."""
    times: list[tuple[str, Quantity | None]] = [("duration", sweep.duration)]
    if sweep.within_one_run is not None:
        times += [(f"within_one_run.{key}", getattr(sweep.within_one_run, key)) for key in ("every", "lead_in")]
    for key, time in times:
        problem = whole_multiple(time, tick, f"sweeps.{name}.{key}", tick_name) if time else None
        if problem is not None:
            yield problem


def _varied(name: str, varied: Varied, parameters: Mapping[str, Parameter] | None, path: str) -> Iterator[Problem]:
    problems = list(_form(varied, path))
    yield from problems
    if parameters is None:
        return
    if name not in parameters:
        yield Problem("unknown-parameter", path, "is no parameter", None, did_you_mean(name, parameters))
        return
    bounds = Bounds.of(parameters[name])
    if bounds is None or problems:
        return
    written, key = (varied.range, "range") if varied.range is not None else (varied.values, "values")
    wrong = [
        one for index, value in enumerate(written) for one in check_value(value, bounds, name, f"{path}.{key}.{index}")
    ]
    yield from wrong
    if not wrong:
        yield from _numbers(varied, path)


def _form(varied: Varied, path: str) -> Iterator[Problem]:
    if bool(varied.values) == (varied.range is not None):
        hint = "write 'values: [1, 2]', or 'range: [1, 2]' with 'count: 5'"
        yield Problem("sweep-values", path, "needs 'values' or a 'range', and not both", None, hint)
    elif varied.values and (varied.count is not None or varied.scale is not None):
        given = "count" if varied.count is not None else "scale"
        yield Problem("sweep-values", join(path, given), "belongs to a 'range', not to 'values'")
    elif varied.range is not None and varied.count is None:
        yield Problem("missing-key", path, "'count' is missing", None, "say how many values the range has")


def _numbers(varied: Varied, path: str) -> Iterator[Problem]:
    """Yield values that are given twice, and ranges without room or without a logarithm."""
    if varied.range is None:
        seen: dict[float, str] = {}
        for index, value in enumerate(varied.values):
            number, _ = measure(value)
            if number in seen:
                yield Problem("sweep-values", f"{path}.values.{index}", "is there already", repr_short(value))
            seen[number] = str(value)
        return
    first, last = (measure(value)[0] for value in varied.range)
    if first == last:
        got = f"{varied.range[0]} to {varied.range[1]}"
        yield Problem("sweep-values", join(path, "range"), "must have two different ends", got)
    elif varied.scale == "log" and min(first, last) <= 0.0:
        message = "'log' needs a range above 0"
        yield Problem("out-of-range", join(path, "scale"), message, f"{varied.range[0]} to {varied.range[1]}")


def _varied_twice(sweep: Sweep, path: str) -> Iterator[Problem]:
    for name in sweep.for_each:
        if name in sweep.vary:
            yield Problem("varied-twice", f"{path}.for_each.{name}", "is varied already, under 'vary'")
    for changed in sweep.set:
        place = f"{path}.set.{changed}"
        if any(".".join(changed.split(".")[:2]) == f"parameters.{name}" for name in (*sweep.vary, *sweep.for_each)):
            yield Problem("varied-twice", place, "is what the sweep varies")
        elif changed == "protocol.seed":
            yield Problem("varied-twice", place, "is what the sweep repeats, with 'seeds'")


def _names(sweep: Sweep, path: str) -> Iterator[Problem]:
    taken = {name: "a varied parameter" for name in (*sweep.vary, *sweep.for_each)}
    taken |= dict.fromkeys(RESERVED, "another result of every sweep")
    for name in sweep.measures:
        if name in taken:
            message = f"is the name of {taken[name]}"
            yield Problem("name-taken", f"{path}.measures.{name}", message, None, "choose another name")
        elif name.endswith("_missing"):
            message = "ends like the name of what says why a value is missing"
            yield Problem("name-taken", f"{path}.measures.{name}", message, None, "choose another name")


def _within_one_run(sweep: Sweep, path: str) -> Iterator[Problem]:
    held = sweep.within_one_run
    if held is not None and held.settle >= held.every:
        message = f"must be shorter than a point is held, {time_text(held.every)}"
        yield Problem("protocol-time", f"{path}.within_one_run.settle", message, time_text(held.settle))
    if sweep.duration is not None:
        message = "follows from the points and 'within_one_run.every'"
        yield Problem("protocol-time", join(path, "duration"), message, time_text(sweep.duration), "remove it")
    for name, one in sweep.measures.items():
        for key in ("after", "until"):
            if key in one.model_fields_set:
                message = "follows from 'within_one_run': a measure looks at each point after it has settled"
                yield Problem("protocol-time", f"{path}.measures.{name}.{key}", message, None, "remove it")


def _moved(sweep: Sweep, protocol: Protocol | None, path: str) -> Iterator[Problem]:
    """Yield parameters that change within a run twice: by the sweep and by the protocol."""
    if protocol is None:
        return
    moved = {ramp.parameter: f"protocol.ramps.{name}" for name, ramp in protocol.ramps.items()}
    moved |= {
        parameter: f"protocol.events.{name}" for name, event in protocol.events.items() for parameter in event.set
    }
    for name in sweep.vary:
        if name in moved:
            yield Problem("varied-twice", f"{path}.vary.{name}", f"is changed during the run already, by {moved[name]}")
