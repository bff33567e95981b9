"""Whether what a study strives for can be measured, and whether its stages can be entered."""

from neuromech.analyse.expectations import Expectation
from neuromech.analyse.kinds import RESULT_UNITS, MeasureKind
from neuromech.analyse.table import measure_kind
from neuromech.errors import MeasureError, Problem, did_you_mean
from neuromech.graph.model import ModelGraph
from neuromech.graph.signals import matching, signals, sizes, split
from neuromech.spec.document import Document
from neuromech.spec.measure import Measure
from neuromech.spec.node import join
from neuromech.spec.study import Condition, Study, Term
from neuromech.study.reach import Possible
from neuromech.units import measure as si_value
from neuromech.units import repr_short, si_unit, unit_factor

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


class _Checker:
    """Collects problems; of what was found wrong once, nothing else is said."""

    def __init__(self, graph: ModelGraph, study: Study) -> None:
        self.problems: list[Problem] = []
        self._document: Document = graph.document
        self._signals = signals(graph)
        self._sizes = sizes(graph)
        self._duration = float(study.duration or graph.document.experiment.protocol.duration)
        self._kinds: dict[Measure, tuple[MeasureKind, str | None]] = {}
        self._demanded: dict[Measure, tuple[Possible, str]] = {}

    def check_measure(self, measure: Measure, path: str) -> None:
        """Check that a measure can be taken of a run."""
        try:
            kind = measure_kind(measure)
            unit = self._unit(measure, kind)
        except MeasureError as error:
            message, _, hint = str(error).partition(". Hint: ")
            self._add("bad-measure", path, message, hint=hint or None)
            return
        self._kinds[measure] = kind, unit
        if measure.after >= self._duration:
            message = f"begins when a run is over, at {self._duration:g} s"
            self._add("impossible", join(path, "after"), message, f"{float(measure.after):g} s")
        elif measure.until is not None and measure.until <= measure.after:
            message = f"ends before it begins, at {float(measure.after):g} s"
            self._add("impossible", join(path, "until"), message, f"{float(measure.until):g} s")

    def check_term(self, term: Term, path: str) -> None:
        """Check that a term fits what it measures."""
        if not all(factor in self._kinds for factor in term.factors.values()):
            return
        kind, _ = self._kinds[term.measure]
        units = {key: self._kinds[factor][1] for key, factor in term.factors.items()}
        if term.equals is not None:
            self._check_word(term.equals, kind, term.measure, join(path, "equals"))
        elif None in units.values():
            key = next(key for key, unit in units.items() if unit is None)
            words = f"measure '{term.factors[key].kind}' gives a text, which has no scale"
            self._add("term", join(path, key), words, hint="use 'equals'" if key == "measure" else None)
        elif term.scale is not None and si_value(term.scale)[1] != _dimension({k: u or "" for k, u in units.items()}):
            unit = _product({key: unit or "" for key, unit in units.items()})
            message = f"must have the dimension of what is measured, {unit or 'a number'}"
            self._add("wrong-unit", join(path, "scale"), message, repr_short(term.scale))

    def check_condition(self, condition: Condition, path: str) -> None:
        """Check that a condition can be met, together with all conditions before it on the same measure."""
        if condition.measure not in self._kinds:
            return
        kind, unit = self._kinds[condition.measure]
        try:
            expectation = Expectation(condition.expected, unit)
        except MeasureError as error:
            message, _, hint = str(error).partition(". Hint: ")
            self._add("bad-condition", join(path, "expected"), message, hint=hint or None)
            return
        possible = Possible.of(kind, self._duration)
        word = condition.expected.equals
        if possible.meeting(expectation, word) is None:
            got = f"measure '{condition.measure.kind}' gives {possible.text()}{f' {unit}' if unit else ''}"
            self._add("impossible", join(path, "expected"), f"can never be met: {got}", expectation.text())
            return
        before, where = self._demanded.get(condition.measure, (possible, ""))
        left = before.meeting(expectation, word)
        if left is None:
            message = f"can never be met after {where}, which demands the opposite"
            self._add("impossible", join(path, "expected"), message, expectation.text())
        else:
            self._demanded[condition.measure] = left, join(path, "expected")

    def _check_word(self, word: str, kind: MeasureKind, measure: Measure, path: str) -> None:
        if kind.result != "text":
            message = f"measure '{measure.kind}' gives a number, no word"
            self._add("term", path, message, repr_short(word), "use 'target', 'at_least', 'at_most' or 'goal'")
        elif kind.words and word not in kind.words:
            hint = did_you_mean(word, kind.words)
            self._add("impossible", path, f"is no word that measure '{measure.kind}' gives", repr_short(word), hint)

    def _unit(self, measure: Measure, kind: MeasureKind) -> str | None:
        """Return the SI unit that a measure will have.

        Raises:
            MeasureError: its signals have no common unit.
        """
        if kind.result != "signal":
            return RESULT_UNITS[kind.result]
        wanted = [measure.signal] if measure.signal is not None else list(measure.signals or ())
        found = {name for pattern in wanted for name in matching(pattern, self._signals, self._sizes)}
        units = {si_unit(self._signals[_listed(name)]) for name in found}
        if len(units) != 1:
            raise MeasureError(f"measure '{measure.kind}' needs signals of one unit (got {', '.join(sorted(units))})")
        return units.pop()

    def _add(self, code: str, path: str, message: str, got: str | None = None, hint: str | None = None) -> None:
        self.problems.append(self._document.problem(code, path, message, got, hint))


def _listed(name: str) -> str:
    """Return the name of a signal in the list of all, which has populations as wholes."""
    element, _, quantity = split(name)
    return f"{element}.{quantity}"


def _product(units: dict[str, str]) -> str:
    """Return the unit of `measure` times `times` by `per`."""
    above = " ".join(f"({units[key]})" for key in ("measure", "times") if units.get(key))
    below = f"/({units['per']})" if units.get("per") else ""
    return (above or "1" if below else above) + below if len(units) > 1 else units["measure"]


def _dimension(units: dict[str, str]) -> str:
    return unit_factor(_product(units))[1]
