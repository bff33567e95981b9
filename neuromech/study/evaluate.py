"""One candidate in, everything that became of it out."""

import threading
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from neuromech.compiler.program import Program
from neuromech.components.catalogue import Catalogue
from neuromech.errors import DocumentError
from neuromech.graph.build import build
from neuromech.graph.check import check
from neuromech.simulate.recording import Outcome, Recording
from neuromech.simulate.run import Checkpoint, simulate
from neuromech.spec.includes import compose
from neuromech.spec.load import load_composed
from neuromech.spec.study import EarlyStop
from neuromech.study.checks import check_study
from neuromech.study.confirmation import Confirmation
from neuromech.study.evaluation import Evaluation, Job, RunResult
from neuromech.study.objective import Grade, Objective
from neuromech.study.programs import ScenarioProgram
from neuromech.study.scenarios import PlannedRun, Scenarios
from neuromech.study.score import Score
from neuromech.study.space import Space


class Evaluator:
    """Evaluates candidates of a study; the same answer in every thread, process and machine.

    The files of the document are read once, here; a copy in another process does not read them again. What is built
    from them is built when it is first needed, and shared by threads.

    Args:
        file: the document.
        overrides: changes of the document, each as in `--set`.
        engine: engine of the body; the document's where None is given.

    Raises:
        DocumentError: the document has no study, or it or its study is wrong.
    """

    def __init__(self, file: Path, overrides: Sequence[str] = (), engine: str | None = None) -> None:
        self._composed = compose(file)
        self._overrides = (*overrides, *([f"body.engine={engine}"] if engine else []))
        self.document = load_composed(self._composed, catalogue=Catalogue.installed(), overrides=self._overrides)
        graph = build(self.document)
        check(graph)
        self.study = check_study(graph, self._composed, self._overrides)
        self.space = Space.of(self.document)
        self.scenarios = Scenarios.of(self.document)
        self.confirmation = Confirmation.of(self.document)
        self.objective = Objective.of(self.study)
        self._forget()

    def __getstate__(self) -> dict[str, Any]:
        """Leave out what is built from the document."""
        return {key: value for key, value in self.__dict__.items() if key not in ("_building", "_programs")}

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Begin with nothing built."""
        self.__dict__.update(state)
        self._forget()

    def prepare(self) -> None:
        """Build all scenarios and run one step of each, so that compiled code is there before many processes need it.

        Raises:
            DocumentError: a scenario is wrong.
        """
        own = self.space.parameters(self.space.point(self.document))
        for name in self.scenarios.overrides:
            program = self._scenario(name).program(own)
            simulate(program, duration=program.tick)

    def __call__(self, job: Job) -> Evaluation:
        """Run a candidate in every scenario with every seed, and judge it.

        Where a run diverges, or the document is wrong with these values, that is the failure of the candidate, which
        then has no score. A fall is no failure.

        Raises:
            KeyboardInterrupt: the user stopped a run.
            MeasureError: a measure does not fit what was recorded.
        """
        started = time.perf_counter()
        scenarios = self._scenarios(job)
        runs: list[RunResult] = []
        grades: list[Grade] = []
        failure = self._failure(job, scenarios, runs, grades)
        return Evaluation(
            number=job.number,
            generation=job.generation,
            index=job.index,
            parameters=job.parameters,
            runs=tuple(runs),
            score=self.objective.score(grades, scenarios.weights) if failure is None else None,
            failure=failure,
            wall_seconds=time.perf_counter() - started,
            simulated_seconds=sum(run.time for run in runs),
            confirms=job.confirms,
        )

    def _scenarios(self, job: Job) -> Scenarios:
        """Return the runs of a job.

        Raises:
            ValueError: it confirms another one, and the study does not ask for that.
        """
        if job.confirms is None:
            return self.scenarios
        if self.confirmation is None:
            raise ValueError("a study without 'confirm' has no runs that confirm a candidate")
        return self.confirmation.scenarios

    def _failure(self, job: Job, scenarios: Scenarios, runs: list[RunResult], grades: list[Grade]) -> str | None:
        """Run the candidate, adding to `runs` and `grades`; return what failed, if anything did."""
        thresholds = job.thresholds or (None,) * len(job.seeds)
        programs: dict[str, Program] = {}
        for planned, seed, threshold in zip(scenarios.runs, job.seeds, thresholds, strict=True):
            try:
                if planned.scenario not in programs:
                    programs[planned.scenario] = self._scenario(planned.scenario).program(job.parameters)
                look = _Look(self.objective, threshold)
                recording = self._simulate(programs[planned.scenario], seed, look)
            except DocumentError as error:
                return str(error)
            end = recording.outcome
            if end.kind == "stopped" and not look.is_hopeless:
                raise KeyboardInterrupt
            if end.kind == "diverged":
                runs.append(_result(planned, seed, end, Grade({}, {}, (), ()), look.partial))
                return f"{_words(planned, seed)}{end.message}"
            grades.append(self.objective.grade(recording))
            runs.append(_result(planned, seed, end, grades[-1], look.partial))
        return None

    def _simulate(self, program: Program, seed: int, look: "_Look") -> Recording:
        stop: EarlyStop | None = self.study.stop_early
        checkpoint = None if stop is None else Checkpoint(float(stop.at), look)
        duration = None if self.study.duration is None else float(self.study.duration)
        return simulate(program, seed=seed, duration=duration, checkpoint=checkpoint)

    def _forget(self) -> None:
        self._building = threading.Lock()
        self._programs: dict[str, ScenarioProgram] = {}

    def _scenario(self, name: str) -> ScenarioProgram:
        with self._building:
            if name not in self._programs:
                changes = (*self._overrides, *self.scenarios.overrides[name])
                self._programs[name] = ScenarioProgram(
                    self._composed, changes, self.objective.measures(), self.space.all_names
                )
            return self._programs[name]


class _Look:
    """Looks at a run while it goes on, keeps its score so far, and ends it where that is below a threshold."""

    def __init__(self, objective: Objective, threshold: Score | None) -> None:
        self._objective = objective
        self._threshold = threshold
        self.partial: Score | None = None
        self.is_hopeless = False

    def __call__(self, recording: Recording) -> str:
        self.partial = self._objective.score([self._objective.grade(recording)], [1.0])
        self.is_hopeless = self._threshold is not None and self.partial < self._threshold
        return "below the median of the earlier generations" if self.is_hopeless else ""


def _result(planned: PlannedRun, seed: int, end: Outcome, grade: Grade, partial: Score | None) -> RunResult:
    return RunResult(
        planned.scenario, seed, end.kind, end.time, end.message, dict(grade.measures), dict(grade.points), partial
    )


def _words(planned: PlannedRun, seed: int) -> str:
    """Return which run it is, as the beginning of a message."""
    return f"scenario {planned.scenario}, seed {seed}: " if planned.scenario else f"seed {seed}: "
