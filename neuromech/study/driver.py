"""The loop of a search: a generation is asked for, evaluated, stored and told, then the next one.

Whatever ends the process, and whenever, a search that is resumed gives the same evaluations as one that was not
interrupted. Its numbers depend on what is stored in order: an evaluation counts once it is stored as a whole, the state
of the algorithm is stored after the last evaluation of a generation and before the first one of the next. From a state
the algorithm asks for the same candidates again, and those that are stored are not evaluated a second time.
"""

from collections import Counter
from collections.abc import Callable, Sequence
from typing import Literal

import numpy as np

from neuromech.errors import RunError, StudyError
from neuromech.study.evaluation import Evaluation, Job
from neuromech.study.executors import Done, Executor, Stop
from neuromech.study.plan import Plan
from neuromech.study.progress import Report, Tally
from neuromech.study.stopping import thresholds
from neuromech.study.storage import Boundary, StoredStudy
from neuromech.study.writer import Writer

Ending = Literal["complete", "stopped"]
Task = Callable[[Job], Evaluation]


class Search:
    """A study on its way from where it is stored to its end."""

    def __init__(self, plan: Plan, stored: StoredStudy, report: Report) -> None:
        """Take up the study where it stands.

        Args:
            plan: what is searched.
            stored: the study in its database, new or to be continued.
            report: gets the standing after each evaluation.

        Raises:
            MissingExtraError: the algorithm needs a library that is not installed.
            StudyError: the database fails, or the algorithm does not give the stored candidates again.
        """
        self._plan = plan
        self._stored = stored
        self._report = report
        self._algorithm = plan.algorithm()
        trials = stored.trials()
        self._begun = {trial.number: trial.parameters for trial in trials}
        self._found = {trial.number: trial.evaluation for trial in trials if trial.evaluation is not None}
        self._at = stored.boundary() or Boundary(0, 0, {})
        if self._at.generation:
            self._algorithm.restore(self._at.state)
        self._tally = self._counted()

    @property
    def evaluations(self) -> list[Evaluation]:
        """The complete evaluations so far, by number."""
        return [self._found[number] for number in sorted(self._found)]

    @property
    def is_complete(self) -> bool:
        """Whether the evaluations are used up."""
        return len(self._found) >= self._plan.evaluations

    def run(self, executor: Executor, task: Task, stop: Stop) -> Ending:
        """Search until the evaluations are used up, or `stop` turns true.

        Args:
            executor: where evaluations run.
            task: what evaluates a job.
            stop: when it turns true, evaluations under way are completed and stored, and no other begins.

        Raises:
            StudyError: the database or the executor fails.
            RunError: no candidate at all could be simulated.
            NeuromechError, ImportError, OSError: what the task raised, where it is not about a single candidate.
        """
        self._tally.start()
        with Writer(self._stored, self._plan.space) as writer:
            while self._at.evaluations < self._plan.evaluations:
                jobs = self._jobs()
                asked = jobs[: self._plan.evaluations - self._at.evaluations]
                self._evaluate(asked, executor, task, stop, writer)
                if not all(job.number in self._found for job in asked):
                    return "stopped"
                if len(asked) < len(jobs):
                    break
                self._tell(jobs, writer)
        return "complete"

    def _counted(self) -> Tally:
        """Return the tally of what earlier sessions did."""
        tally = Tally(self._plan.evaluations)
        for evaluation in self.evaluations:
            tally.add(evaluation, fresh=False)
        tally.generation = self._at.generation
        return tally

    def _jobs(self) -> list[Job]:
        """Return the jobs of the generation.

        Raises:
            StudyError: they are not those that an earlier session stored.
        """
        first, generation = self._at.evaluations, self._at.generation
        seeds = self._plan.scenarios.seeds(generation)
        limits = thresholds([one for one in self.evaluations if one.generation < generation])
        points = self._algorithm.ask()
        jobs = [
            Job(first + index, generation, index, tuple(map(float, point)), seeds, limits)
            for index, point in enumerate(points)
        ]
        for job in jobs:
            stored = self._begun.get(job.number)
            if stored is not None and stored != self._plan.space.parameters(np.array(job.point)):
                hint = "resume with the versions of the packages that the study was begun with"
                raise StudyError(
                    f"evaluation {job.number} is stored with other parameters than it has now. Hint: {hint}"
                )
        return jobs

    def _evaluate(self, jobs: Sequence[Job], executor: Executor, task: Task, stop: Stop, writer: Writer) -> None:
        """Carry out the jobs that are not stored yet."""
        missing = [job for job in jobs if job.number not in self._found]
        if not missing or stop():
            return
        writer.begin(missing)
        for done in executor.run(task, missing, stop):
            evaluation = done.result or self._crashed(done)
            self._found[evaluation.number] = evaluation
            writer.finish(evaluation)
            self._tally.add(evaluation)
            self._report(self._tally.standing())

    def _crashed(self, done: Done[Job, Evaluation]) -> Evaluation:
        """Return the evaluation of a candidate whose process or whose Python code crashed."""
        job = done.job
        return Evaluation(
            number=job.number,
            generation=job.generation,
            index=job.index,
            parameters=self._plan.space.parameters(np.array(job.point)),
            runs=(),
            score=None,
            failure=done.crash,
            wall_seconds=done.seconds,
            simulated_seconds=0.0,
        )

    def _tell(self, jobs: Sequence[Job], writer: Writer) -> None:
        """End a generation."""
        found = [self._found[job.number] for job in jobs]
        scores = [one.score for one in found]
        if self._tally.best is None:
            most, _ = Counter(str(one.failure) for one in found).most_common(1)[0]
            raise RunError(f"every candidate of generation {self._at.generation} failed, most often by: {most}")
        self._algorithm.tell(scores)
        self._at = Boundary(self._at.generation + 1, self._at.evaluations + len(jobs), self._algorithm.state())
        writer.set_boundary(self._at)
        self._tally.end_generation(scores)
        self._report(self._tally.standing())
