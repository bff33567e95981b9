"""The runs of a sweep, in whatever process: a job in, what became of its points out."""

import json
import threading
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from neuromech.analyse.measures import measure
from neuromech.components.catalogue import Catalogue
from neuromech.errors import DocumentError
from neuromech.simulate.recording import Outcome, Recording
from neuromech.simulate.run import simulate
from neuromech.spec.includes import compose
from neuromech.spec.load import load_composed
from neuromech.spec.measure import Measure
from neuromech.spec.sweep import WithinOneRun
from neuromech.study.programs import ScenarioProgram
from neuromech.study.scenarios import written_overrides
from neuromech.study.sweeps.checks import check_sweep
from neuromech.study.sweeps.design import Design, Point, SweepJob
from neuromech.study.sweeps.results import PointResult, SweepOutcome
from neuromech.units import Quantity

_OUTCOMES: Mapping[str, SweepOutcome] = {"finished": "finished", "fell": "fell", "diverged": "diverged"}


class SweepTask:
    """Runs the points of a sweep; the same answer in every thread, process and machine.

    The files of the document are read once, here; a copy in another process does not read them again.

    Args:
        file: the document.
        name: of the sweep.
        overrides: changes of the document, each as in `--set`.

    Raises:
        DocumentError: the document, or its sweep, is wrong.
    """

    def __init__(self, file: Path, name: str, overrides: Sequence[str] = ()) -> None:
        self.name = name
        self._composed = compose(file)
        self._overrides = tuple(overrides)
        self.document = load_composed(self._composed, catalogue=Catalogue.installed(), overrides=overrides)
        self.kinds = check_sweep(self.document, name, self._composed, self._overrides)
        self.sweep = self.document.experiment.sweeps[name]
        self.design = Design.of(self.sweep)
        self._forget()

    def __getstate__(self) -> dict[str, Any]:
        """Leave out what is built from the document."""
        return {key: value for key, value in self.__dict__.items() if key not in ("_building", "_program")}

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Begin with nothing built."""
        self.__dict__.update(state)
        self._forget()

    def prepare(self) -> None:
        """Build the document and run one step, so that compiled code is there before many processes need it."""
        program = self._built().program({})
        simulate(program, duration=program.tick)

    def __call__(self, job: SweepJob) -> tuple[PointResult, ...]:
        """Run the points of a job.

        Within one run the values change from point to point. Where that run ends early, another one begins at the next
        point.

        Raises:
            KeyboardInterrupt: the user stopped a run.
            MeasureError: a measure does not fit what was recorded.
        """
        if self.sweep.within_one_run is None:
            return tuple(self._single(point) for point in job.points)
        found: list[PointResult] = []
        while len(found) < len(job.points):
            found += self._visited(job.points[len(found) :], self.sweep.within_one_run)
        return tuple(found)

    def seed(self, point: Point) -> int:
        """Return the seed of the run of a point."""
        return self.document.experiment.protocol.seed + point.repetition

    def _single(self, point: Point) -> PointResult:
        try:
            program = self._built().program(self._parameters(point))
        except DocumentError as error:
            return self._refused(point, error)
        duration = None if self.sweep.duration is None else float(self.sweep.duration)
        recording = _finished(simulate(program, seed=self.seed(point), duration=duration))
        return self._result(point, recording, recording.outcome, self.sweep.measures)

    def _visited(self, points: Sequence[Point], held: WithinOneRun) -> list[PointResult]:
        """Run through points until the last one, or until the run ends; return those that were begun."""
        ends = [float(held.lead_in) + float(held.every) * (1 + index) for index in range(len(points))]
        changes = {
            f"sweep_{index}": {"at": f"{end!r} s", "set": self._varied(point)}
            for index, (end, point) in enumerate(zip(ends, points[1:], strict=False))
        }
        try:
            program = self._changed(points[0], [f"protocol.duration={ends[-1]!r} s"], changes)
        except DocumentError as error:
            return [self._refused(points[0], error)]
        recording = _finished(simulate(program, seed=self.seed(points[0])))
        found = []
        for point, end in zip(points, ends, strict=True):
            is_last = recording.outcome.kind != "finished" and recording.outcome.time < end
            outcome = recording.outcome if is_last else Outcome("finished", end)
            window = {"after": Quantity(end - float(held.every) + float(held.settle)), "until": Quantity(end)}
            measures = {name: one.model_copy(update=window) for name, one in self.sweep.measures.items()}
            found.append(self._result(point, recording, outcome, measures))
            if is_last:
                break
        return found

    def _changed(self, first: Point, overrides: Sequence[str], events: Mapping[str, object]) -> Any:
        """Return the program of a run that begins at a point and has these events."""
        written = [f"protocol.events.{name}={json.dumps(event)}" for name, event in events.items()]
        changes = (*self._fixed(), *_parameter_overrides(self._parameters(first)), *overrides, *written)
        return ScenarioProgram(self._composed, changes, self._measures(), ()).program({})

    def _result(
        self, point: Point, recording: Recording, outcome: Outcome, measures: Mapping[str, Measure]
    ) -> PointResult:
        return PointResult(
            point=point,
            seed=self.seed(point),
            outcome=_OUTCOMES[outcome.kind],
            end=outcome.time,
            message=outcome.message,
            measures={name: measure(recording, one).value for name, one in measures.items()},
            engine=recording.provenance.engine,
        )

    def _refused(self, point: Point, error: DocumentError) -> PointResult:
        words = "; ".join(f"{problem.path} {problem.message}" for problem in error.problems)
        missing = dict.fromkeys(self.sweep.measures, "refused")
        return PointResult(point, self.seed(point), "refused", 0.0, words, missing, "")

    def _parameters(self, point: Point) -> dict[str, str]:
        return self.design.blocks[point.block].parameters(point.position)

    def _varied(self, point: Point) -> dict[str, str]:
        return {name: text for name, text in self._parameters(point).items() if name in self.sweep.vary}

    def _fixed(self) -> tuple[str, ...]:
        # The sweep's own changes would be refused beside the section that asks for them.
        return (*self._overrides, *written_overrides(self.sweep.set), "sweeps=null")

    def _measures(self) -> list[Measure]:
        return list(self.sweep.measures.values())

    def _forget(self) -> None:
        self._building = threading.Lock()
        self._program: ScenarioProgram | None = None

    def _built(self) -> ScenarioProgram:
        with self._building:
            if self._program is None:
                names = {axis.name for block in self.design.blocks for axis in block.axes}
                self._program = ScenarioProgram(self._composed, self._fixed(), self._measures(), names)
            return self._program


def _parameter_overrides(parameters: Mapping[str, str]) -> list[str]:
    return [f"parameters.{name}.value={text}" for name, text in parameters.items()]


def _finished(recording: Recording) -> Recording:
    """Return a recording that came to its end by itself.

    Raises:
        KeyboardInterrupt: the user stopped it.
    """
    if recording.outcome.kind == "stopped":
        raise KeyboardInterrupt
    return recording
