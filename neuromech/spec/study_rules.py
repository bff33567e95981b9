"""Rules about what a study tunes, and under which changes of the document it runs."""

import math
from collections.abc import Iterator, Mapping

from neuromech.errors import Problem, did_you_mean
from neuromech.spec.bounds import Bounds, check_value
from neuromech.spec.model import Parameter
from neuromech.spec.node import join
from neuromech.spec.study import Study, Tuned
from neuromech.units import repr_short

_TUNE = "study.tune"


def check_study(study: Study, parameters: Mapping[str, Parameter] | None) -> Iterator[Problem]:
    """Yield what is wrong with a study; `parameters` are those of the document, None where that section is broken."""
    if parameters is not None:
        for name, tuned in study.tune.items():
            yield from _tuned(name, tuned, parameters)
    yield from _tuned_twice(study)
    for name, scenario in study.scenarios.items():
        for path in scenario.set:
            yield from _changed(path, study, f"study.scenarios.{name}.set.{path}")


def _tuned(name: str, tuned: Tuned, parameters: Mapping[str, Parameter]) -> Iterator[Problem]:
    path = join(_TUNE, name)
    if name not in parameters:
        yield Problem("unknown-parameter", path, "is no parameter", None, did_you_mean(name, parameters))
        return
    bounds = Bounds.of(parameters[name])
    if bounds is None:
        return
    searched = bounds
    if tuned.range is not None:
        problems = list(_range(tuned.range, bounds, name, join(path, "range")))
        yield from problems
        if problems:
            return
        searched = Bounds.of(Parameter(value=tuned.range[0], minimum=tuned.range[0], maximum=tuned.range[1])) or bounds
    yield from _room(searched, tuned, path)
    for index, (other, sign) in enumerate(tuned.followers):
        yield from _also(other, sign, searched, parameters, f"{path}.also.{index}")


def _range(written: tuple[str | int | float, ...], bounds: Bounds, name: str, path: str) -> Iterator[Problem]:
    for index, value in enumerate(written):
        yield from check_value(value, bounds, name, join(path, str(index)))


def _room(searched: Bounds, tuned: Tuned, path: str) -> Iterator[Problem]:
    """Yield a search that has no bounds, no room between them, or none on a logarithmic scale."""
    if not (math.isfinite(searched.least) and math.isfinite(searched.most)):
        ends = [word for word, end in (("minimum", searched.least), ("maximum", searched.most)) if math.isinf(end)]
        hint = f"give the parameter its {' and '.join(ends)}, or write 'range' here"
        yield Problem("no-bounds", path, "has no bounds to search between", f"no {' and no '.join(ends)}", hint)
    elif searched.least >= searched.most:
        place = path if tuned.range is None else join(path, "range")
        got = f"{searched.least_text} to {searched.most_text}"
        yield Problem("out-of-range", place, "leaves no room to search: the upper end must be above the lower", got)
    elif tuned.scale == "log" and searched.least <= 0.0:
        message, hint = "'log' needs a lower end above 0", "write 'range' here, or use 'linear'"
        yield Problem("out-of-range", join(path, "scale"), message, searched.least_text, hint)


def _also(name: str, sign: int, searched: Bounds, parameters: Mapping[str, Parameter], path: str) -> Iterator[Problem]:
    if name not in parameters:
        yield Problem("unknown-parameter", path, "is no parameter", repr_short(name), did_you_mean(name, parameters))
        return
    bounds = Bounds.of(parameters[name])
    if bounds is None:
        return
    if bounds.dimension != searched.dimension:
        message = f"must have the dimension of what it follows, '{searched.unit}'"
        yield Problem("wrong-unit", path, message, repr_short(bounds.unit))
        return
    least, most = sorted((sign * searched.least, sign * searched.most))
    if bounds.least > least or bounds.most < most:
        message = f"may only be {bounds.least_text} to {bounds.most_text}"
        got = f"{searched.least_text} to {searched.most_text}"
        hint = "write a 'range' that fits both"
        yield Problem("out-of-range", path, message, got if sign > 0 else f"the negative of {got}", hint)


def _tuned_twice(study: Study) -> Iterator[Problem]:
    owner = {name: name for name in study.tune}
    for name, tuned in study.tune.items():
        for index, (other, _) in enumerate(tuned.followers):
            if other in owner:
                where = "is tuned itself" if owner[other] == other else f"follows '{owner[other]}' already"
                yield Problem("tuned-twice", f"{_TUNE}.{name}.also.{index}", where, repr_short(other))
            owner.setdefault(other, name)


def _changed(path: str, study: Study, place: str) -> Iterator[Problem]:
    """Yield a change that a scenario may not make."""
    tuned = {
        f"parameters.{name}"
        for first, one in study.tune.items()
        for name in (first, *(other for other, _ in one.followers))
    }
    if ".".join(path.split(".")[:2]) in tuned:
        yield Problem("scenario", place, "is what the study tunes")
    elif path.split(".")[0] == "study":
        yield Problem("scenario", place, "a scenario changes the model, not the study")
    elif path == "protocol.seed":
        yield Problem("scenario", place, "a seed is no change of the model", None, "write it under 'fixed_seeds'")
