"""Rules about what a study strives for: terms that say one thing, and stages that can be entered."""

from collections.abc import Iterator, Mapping

from neuromech.errors import Problem
from neuromech.spec.measure import Expected
from neuromech.spec.node import join
from neuromech.spec.scalars import Written
from neuromech.spec.study import Objective, Term
from neuromech.units import measure, repr_short

_OBJECTIVE = "study.objective"
_FORMS = "'target', 'at_least' and/or 'at_most', 'goal' or 'equals'"
_NUMBERS = ("scale", "target", "within", "at_least", "at_most", "center", "up_to")
_FORM_KEYS = {
    "target": ("target",),
    "bounds": ("at_least", "at_most"),
    "goal": ("goal",),
    "equals": ("equals",),
}
_SHAPES = {"target": ("saturating", "linear"), "bounds": ("saturating", "linear"), "goal": ("linear", "logistic")}
_HINTS = {
    "scale": "the difference that counts as one point",
    "worst": "the points that count where the measure cannot be taken, for example -10",
    "center": "the value at which a half point counts",
}


def check_objective(objective: Objective) -> Iterator[Problem]:
    """Yield what is wrong with the objective of a study in itself."""
    if bool(objective.terms) == bool(objective.stages):
        got = "both" if objective.terms else "neither"
        yield Problem("objective", _OBJECTIVE, "must have either 'terms' or 'stages'", got)
    for index, (name, stage) in enumerate(objective.stages.items()):
        path = f"{_OBJECTIVE}.stages.{name}"
        if index == 0 and stage.enter:
            message = "the first stage is open to all"
            yield Problem("stage", join(path, "enter"), message, None, "put the condition under the second stage")
        if index > 0 and not stage.enter:
            hint = "the measure that lets a candidate into this stage, and what is expected of it"
            yield Problem("missing-key", path, "'enter' is missing", None, hint)
    for path, condition in objective.all_conditions():
        yield from check_expected(condition.expected, f"{_OBJECTIVE}.{path}.expected")
    for path, term in objective.all_terms():
        yield from _term(term, f"{_OBJECTIVE}.{path}")


def check_expected(expected: Expected, path: str) -> Iterator[Problem]:
    """Yield what is wrong with an expectation in itself."""
    given = expected.model_dump(exclude_none=True)
    if not given:
        words = ", ".join(type(expected).model_fields)
        yield Problem("claim", path, "demands nothing", None, f"give at least one of {words}")
    if "within" in given and "value" not in given:
        yield Problem("claim", join(path, "within"), "needs 'value' beside it", None, "within what of which value?")
    if "value" in given and "within" not in given:
        yield Problem("claim", join(path, "value"), "needs 'within' beside it", None, "for example 'within: 10 %'")
    yield from _crossed(expected.at_least, expected.at_most, path)


def _term(term: Term, path: str) -> Iterator[Problem]:
    forms = [form for form, keys in _FORM_KEYS.items() if any(getattr(term, key) is not None for key in keys)]
    if len(forms) != 1:
        got = " and ".join(f"'{key}'" for key in _given(term)) if forms else "none of them"
        yield Problem("term", path, f"must have one of {_FORMS}", got)
    elif term.within is not None and term.target is None:
        yield Problem("term", join(path, "within"), "needs 'target' beside it")
    elif forms != ["equals"] and term.curve not in _SHAPES[forms[0]]:
        words = " or ".join(f"'{shape}'" for shape in _SHAPES[forms[0]])
        yield Problem("term", join(path, "shape"), f"must be {words} here", f"'{term.curve}'")
    else:
        yield from _keys(term, forms[0], path)
        yield from _numbers(term, path)
        yield from _crossed(term.at_least, term.at_most, path)


def _given(term: Term) -> list[str]:
    return [key for keys in _FORM_KEYS.values() for key in keys if getattr(term, key) is not None]


def _keys(term: Term, form: str, path: str) -> Iterator[Problem]:
    """Yield keys that are missing, and keys that would do nothing."""
    needed = _needed(term, form)
    optional = {"up_to"} if term.goal == "maximize" and term.curve == "linear" else set[str]()
    for key in needed:
        if getattr(term, key) is None:
            yield Problem("missing-key", path, f"'{key}' is missing", None, _HINTS[key])
    beside = f"'{form}'" if form == "equals" else f"the shape '{term.curve}'"
    beside = "'goal: minimize'" if term.goal == "minimize" and term.curve == "linear" else beside
    for key in ("scale", "shape", "worst", "center", "up_to", "times", "per"):
        useless = form == "equals" if key in ("shape", "times", "per") else key not in {*needed, *optional}
        if getattr(term, key) is not None and useless:
            yield Problem("term", join(path, key), f"means nothing beside {beside}", None, "remove it")
    if form in ("target", "bounds") and term.worst is not None and term.worst >= 0.0:
        message = "must be below 0, which is what a term counts that has reached its goal"
        yield Problem("out-of-range", join(path, "worst"), message, f"{term.worst:g}")


def _needed(term: Term, form: str) -> tuple[str, ...]:
    if form == "equals":
        return ()
    return {"saturating": ("scale",), "linear": ("scale", "worst"), "logistic": ("scale", "center")}[term.curve]


def _numbers(term: Term, path: str) -> Iterator[Problem]:
    """Yield what is no quantity, what has another dimension than the scale, and what must be positive and is not."""
    if term.scale is None:
        return
    written: Mapping[str, Written] = {key: getattr(term, key) for key in _NUMBERS if getattr(term, key) is not None}
    dimension: str | None = None
    for key, value in written.items():
        here = join(path, key)
        try:
            number, found = measure(value)
        except ValueError as error:
            yield Problem("not-a-quantity", here, f"must be a quantity: {error}", repr_short(value))
            continue
        dimension = found if dimension is None else dimension
        if found != dimension:
            yield Problem(
                "wrong-unit", here, f"must have the dimension of the scale, '{term.scale}'", repr_short(value)
            )
        elif not abs(number) < float("inf"):
            yield Problem("out-of-range", here, "must be a finite number", repr_short(value))
        elif key == "scale" and number <= 0.0:
            yield Problem("out-of-range", here, "must be greater than 0", repr_short(value))
        elif key == "within" and number < 0.0:
            yield Problem("out-of-range", here, "must be at least 0", repr_short(value))


def _crossed(low: Written | None, high: Written | None, path: str) -> Iterator[Problem]:
    """Yield bounds that no value can keep; what cannot be read or compared is reported elsewhere."""
    if low is None or high is None:
        return
    try:
        (least, dimension), (most, other) = measure(low), measure(high)
    except ValueError:
        return
    if dimension == other and least > most:
        message = f"no value is at least {low} and at most {high}"
        yield Problem("impossible", join(path, "at_least"), message)
