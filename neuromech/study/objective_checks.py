"""Whether what a study strives for can be measured, and whether its stages can be entered."""

from neuromech.analyse.expectations import Expectation
from neuromech.analyse.kinds import MeasureKind
from neuromech.analyse.reach import Possible
from neuromech.errors import MeasureError, Problem, did_you_mean
from neuromech.graph.model import ModelGraph
from neuromech.spec.measure import Measure
from neuromech.spec.node import join
from neuromech.spec.study import Condition, Study, Term
from neuromech.study.measure_checks import MeasureChecker
from neuromech.study.terms import Points
from neuromech.units import measure as si_value
from neuromech.units import repr_short, unit_factor

_OBJECTIVE = "study.objective"


def objective_problems(graph: ModelGraph, study: Study) -> list[Problem]:
    """Return measures that do not exist or can never be taken, units that do not fit, stages that none can enter."""
    checker = _Checker(graph, study)
    for path, measure in study.objective.all_measures():
        checker.check_measure(measure, join(_OBJECTIVE, path))
    for path, term in study.objective.all_terms():
        checker.check_term(term, join(_OBJECTIVE, path))
    for path, condition in study.objective.all_conditions():
        checker.check_condition(condition, join(_OBJECTIVE, path))
    return checker.problems


class _Checker(MeasureChecker):
    """Collects problems; of what was found wrong once, nothing else is said."""

    def __init__(self, graph: ModelGraph, study: Study) -> None:
        super().__init__(graph, float(study.duration or graph.document.experiment.protocol.duration))
        self._demanded: dict[Measure, tuple[Possible, str]] = {}

    def check_term(self, term: Term, path: str) -> None:
        """Check that a term fits what it measures."""
        if not all(factor in self.kinds for factor in term.factors.values()):
            return
        kind, _ = self.kinds[term.measure]
        units = {key: self.kinds[factor][1] for key, factor in term.factors.items()}
        if term.equals is not None:
            self._check_word(term.equals, kind, term.measure, join(path, "equals"))
        elif None in units.values():
            key = next(key for key, unit in units.items() if unit is None)
            words = f"measure '{term.factors[key].kind}' gives a text, which has no scale"
            self.add("term", join(path, key), words, hint="use 'equals'" if key == "measure" else None)
        elif term.scale is not None and si_value(term.scale)[1] != _dimension({k: u or "" for k, u in units.items()}):
            unit = _product({key: unit or "" for key, unit in units.items()})
            message = f"must have the dimension of what is measured, {unit or 'a number'}"
            self.add("wrong-unit", join(path, "scale"), message, repr_short(term.scale))
        else:
            self._check_goal(term, kind, path)

    def check_condition(self, condition: Condition, path: str) -> None:
        """Check that a condition can be met, together with all conditions before it on the same measure."""
        if condition.measure not in self.kinds:
            return
        kind, unit = self.kinds[condition.measure]
        try:
            expectation = Expectation(condition.expected, unit)
        except MeasureError as error:
            message, _, hint = str(error).partition(". Hint: ")
            self.add("bad-condition", join(path, "expected"), message, hint=hint or None)
            return
        possible = Possible.of(kind, self._duration)
        word = condition.expected.equals
        if possible.meeting(expectation, word) is None:
            self.add(
                "impossible", join(path, "expected"), possible.refusal(condition.measure.kind, unit), expectation.text()
            )
            return
        before, where = self._demanded.get(condition.measure, (possible, ""))
        left = before.meeting(expectation, word)
        if left is None:
            message = f"can never be met after {where}, which demands the opposite"
            self.add("impossible", join(path, "expected"), message, expectation.text())
        else:
            self._demanded[condition.measure] = left, join(path, "expected")

    def _check_goal(self, term: Term, kind: MeasureKind, path: str) -> None:
        """Check that the value or the bounds that a term strives for are not beyond all that its measure can give."""
        points = Points.of(term)
        if points.direction or len(term.factors) > 1:
            return
        possible = Possible.of(kind)
        if max(points.low, possible.low) > min(points.high, possible.high):
            key = "target" if term.target is not None else "at_least" if points.low > possible.high else "at_most"
            self.add(
                "impossible",
                join(path, key),
                possible.refusal(term.measure.kind, self.kinds[term.measure][1]),
                repr_short(getattr(term, key)),
            )

    def _check_word(self, word: str, kind: MeasureKind, measure: Measure, path: str) -> None:
        if kind.result != "text":
            message = f"measure '{measure.kind}' gives a number, no word"
            self.add("term", path, message, repr_short(word), "use 'target', 'at_least', 'at_most' or 'goal'")
        elif kind.words and word not in kind.words:
            hint = did_you_mean(word, kind.words)
            self.add("impossible", path, f"is no word that measure '{measure.kind}' gives", repr_short(word), hint)


def _product(units: dict[str, str]) -> str:
    """Return the unit of `measure` times `times` by `per`."""
    above = " ".join(f"({units[key]})" for key in ("measure", "times") if units.get(key))
    below = f"/({units['per']})" if units.get("per") else ""
    return (above or "1" if below else above) + below if len(units) > 1 else units["measure"]


def _dimension(units: dict[str, str]) -> str:
    return unit_factor(_product(units))[1]
