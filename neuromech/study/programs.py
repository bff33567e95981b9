"""Documents of a study as programs: each scenario is lowered once and then gets the values of each candidate."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

from neuromech.compiler.lower import lower
from neuromech.compiler.program import Program
from neuromech.compiler.rebind import Rebinding, lowered_uses
from neuromech.compiler.records import recorded
from neuromech.components.catalogue import Catalogue
from neuromech.graph.build import build
from neuromech.graph.check import check, check_start
from neuromech.graph.model import ModelGraph
from neuromech.graph.signals import matching
from neuromech.spec.includes import Composed
from neuromech.spec.load import load_composed
from neuromech.spec.measure import Measure


class ScenarioProgram:
    """A document with the changes of one scenario.

    Where every tuned parameter is one that could also move during a run, or that says how the run starts, a candidate
    costs a copy of the parameter buffer; otherwise its document is resolved and lowered anew.

    Args:
        composed: the files of the document.
        overrides: changes of the scenario.
        measures: what the study measures; nothing else is recorded.
        names: of the tuned parameters.

    Raises:
        DocumentError: the changed document is wrong.
    """

    def __init__(
        self, composed: Composed, overrides: Sequence[str], measures: Sequence[Measure], names: Iterable[str]
    ) -> None:
        self._composed = composed
        self._overrides = tuple(overrides)
        self._measures = tuple(measures)
        self._program = self._lowered(())
        tuned = frozenset(names)
        self._rebinding = None if lowered_uses(self._program, tuned) else Rebinding(self._program, tuned)

    def program(self, parameters: Mapping[str, str]) -> Program:
        """Return the program of a candidate.

        Args:
            parameters: name → value as written.

        Raises:
            DocumentError: these values make a document that is wrong.
        """
        if self._rebinding:
            return _startable(self._rebinding.program_with(parameters))
        return self._lowered([f"parameters.{name}.value={text}" for name, text in parameters.items()])

    def _lowered(self, overrides: Sequence[str]) -> Program:
        changes = (*self._overrides, *overrides)
        graph = build(load_composed(self._composed, catalogue=Catalogue.installed(), overrides=changes))
        check(graph)
        return lower(recording_only(graph, self._measures))


def _startable(program: Program) -> Program:
    """Return a program of which no rule about the start of a body says that it is wrong."""
    check_start(program.graph)
    return program


def recording_only(graph: ModelGraph, measures: Iterable[Measure]) -> ModelGraph:
    """Return a model that records nothing but what some measures are about, in the groups of its document."""
    experiment = graph.document.experiment
    names = {group: recorded(one.signals, graph) for group, one in experiment.record.items()}
    wanted = {
        name
        for some in names.values()
        for measure in measures
        for _, pattern in measure.patterns()
        for name in matching(pattern, some)
    }
    record = {
        group: one.model_copy(update={"signals": tuple(name for name in names[group] if name in wanted)})
        for group, one in experiment.record.items()
        if wanted.intersection(names[group])
    }
    document = replace(graph.document, experiment=experiment.model_copy(update={"record": record}))
    return replace(graph, document=document)
