"""Whether measures exist, fit the signals that they are about, and look at a part of the run."""

from neuromech.analyse.kinds import RESULT_UNITS, MeasureKind
from neuromech.analyse.table import measure_kind
from neuromech.errors import MeasureError, Problem
from neuromech.graph.model import ModelGraph
from neuromech.graph.signals import matching, signals, sizes, split
from neuromech.spec.document import Document
from neuromech.spec.measure import Measure
from neuromech.spec.node import join
from neuromech.units import si_unit


class MeasureChecker:
    """Collects problems of measures; `kinds` has those that are right, with their units.

    Args:
        graph: the model.
        duration: of the runs (s).
    """

    def __init__(self, graph: ModelGraph, duration: float) -> None:
        self.problems: list[Problem] = []
        self.kinds: dict[Measure, tuple[MeasureKind, str | None]] = {}
        self._document: Document = graph.document
        self._signals = signals(graph)
        self._sizes = sizes(graph)
        self._duration = duration

    def check_measure(self, measure: Measure, path: str) -> None:
        """Check that a measure can be taken of a run."""
        try:
            kind = measure_kind(measure)
            unit = self._unit(measure, kind)
        except MeasureError as error:
            message, _, hint = str(error).partition(". Hint: ")
            self.add("bad-measure", path, message, hint=hint or None)
            return
        self.kinds[measure] = kind, unit
        if measure.after >= self._duration:
            message = f"begins when a run is over, at {self._duration:g} s"
            self.add("impossible", join(path, "after"), message, f"{float(measure.after):g} s")
        elif measure.until is not None and measure.until <= measure.after:
            message = f"ends before it begins, at {float(measure.after):g} s"
            self.add("impossible", join(path, "until"), message, f"{float(measure.until):g} s")

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

    def add(self, code: str, path: str, message: str, got: str | None = None, hint: str | None = None) -> None:
        """Add a problem at a path of the document."""
        self.problems.append(self._document.problem(code, path, message, got, hint))


def _listed(name: str) -> str:
    """Return the name of a signal in the list of all, which has populations as wholes."""
    element, _, quantity = split(name)
    return f"{element}.{quantity}"
