"""The loop of a search: a generation is asked for, evaluated, stored and told, then the next one.

Whatever ends the process, and whenever, a search that is resumed gives the same evaluations as one that was not
interrupted. Its numbers depend on what is stored in order: an evaluation counts once it is stored as a whole, the state
of the algorithm is stored after the last evaluation of a generation and before the first one of the next. From a state
the algorithm asks for the same candidates again, and those that are stored are not evaluated a second time.

Where the study confirms its best candidates, they are evaluated as another generation, which nobody is told of.
"""

from collections import Counter
from collections.abc import Callable, Sequence
from typing import Literal

from neuromech.errors import RunError
from neuromech.study.confirmation import Confirmation, contenders
from neuromech.study.evaluation import Evaluation, Job
from neuromech.study.executors import Done, Executor, Stop
from neuromech.study.plan import Plan
from neuromech.study.progress import Report, Tally
from neuromech.study.register import Register
from neuromech.study.stopping import thresholds
from neuromech.study.storage import Boundary, StoredStudy
from neuromech.study.tasks import Packed
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
        self._register = Register(stored.trials())
        self._at = stored.boundary() or Boundary(0, 0, {})
        if self._at.generation:
            self._algorithm.restore(self._at.state)
        self._tally = self._counted()

    @property
    def evaluations(self) -> list[Evaluation]:
        """The complete evaluations so far, by number; those that confirm others included."""
        return self._register.evaluations

    @property
    def is_complete(self) -> bool:
        """Whether the evaluations are used up, and the best are confirmed where that is asked for."""
        if len(self._register.searched) < self._plan.evaluations:
            return False
        return all(map(self._register.is_complete, self._confirming_jobs()))

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
        packed = Packed.of(task)
        with Writer(self._stored, self._plan.space) as writer:

            def evaluate(jobs: Sequence[Job]) -> bool:
                self._evaluate(jobs, executor, packed, stop, writer)
                return all(map(self._register.is_complete, jobs))

            while self._at.evaluations < self._plan.evaluations:
                jobs = self._jobs()
                asked = jobs[: self._plan.evaluations - self._at.evaluations]
                if not evaluate(asked):
                    return "stopped"
                if len(asked) < len(jobs):
                    break
                self._tell(jobs, writer)
            return "complete" if evaluate(self._confirming_jobs()) else "stopped"

    def _counted(self) -> Tally:
        """Return the tally of what was done before."""
        tally = Tally(self._plan.evaluations)
        for evaluation in self.evaluations:
            tally.add(evaluation, fresh=False)
        tally.generation = self._at.generation
        return tally

    def _jobs(self) -> list[Job]:
        """Return the jobs of the generation.

        Raises:
            StudyError: they are not those that were stored before.
        """
        generation = self._at.generation
        seeds = self._plan.scenarios.seeds(generation)
        limits = thresholds([one for one in self._register.searched if one.generation < generation])
        jobs = [
            Job(0, generation, index, self._plan.space.parameters(point), seeds, limits)
            for index, point in enumerate(self._algorithm.ask())
        ]
        return self._register.numbered(jobs)

    def _confirming_jobs(self) -> list[Job]:
        """Return the jobs that confirm the best candidates, where that is asked for: a generation after the last."""
        confirmation: Confirmation | None = self._plan.confirmation
        if confirmation is None:
            return []
        searched = self._register.searched
        generation = 1 + max((one.generation for one in searched), default=-1)
        seeds = confirmation.scenarios.seeds(generation)
        found = contenders(searched, self._algorithm.centers(), self._plan.space, confirmation.candidates)
        return self._register.numbered(
            [
                Job(0, generation, index, parameters, seeds, confirms=origin)
                for index, (origin, parameters) in enumerate(found)
            ]
        )

    def _evaluate(self, jobs: Sequence[Job], executor: Executor, task: Packed, stop: Stop, writer: Writer) -> None:
        """Carry out the jobs that are not stored yet."""
        missing = [job for job in jobs if not self._register.is_complete(job)]
        if not missing or stop():
            return
        self._tally.expect(missing)
        writer.begin(missing)
        self._register.begin(missing)
        done: Done[Job, Evaluation]
        for done in executor.run(task, missing, stop):
            evaluation = done.result or _crashed(done)
            self._register.finish(evaluation)
            writer.finish(evaluation)
            self._tally.add(evaluation)
            self._report(self._tally.standing())

    def _tell(self, jobs: Sequence[Job], writer: Writer) -> None:
        """End a generation."""
        found = [self._register.of(job) for job in jobs]
        scores = [one.score for one in found]
        if self._tally.best is None:
            most, _ = Counter(str(one.failure) for one in found).most_common(1)[0]
            raise RunError(f"every candidate of generation {self._at.generation} failed, most often by: {most}")
        self._algorithm.tell(scores)
        self._at = Boundary(self._at.generation + 1, self._at.evaluations + len(jobs), self._algorithm.state())
        writer.set_boundary(self._at)
        self._tally.end_generation(scores)
        self._report(self._tally.standing())


def _crashed(done: Done[Job, Evaluation]) -> Evaluation:
    """Return the evaluation of a candidate whose process or whose Python code crashed."""
    job = done.job
    return Evaluation(
        number=job.number,
        generation=job.generation,
        index=job.index,
        parameters=job.parameters,
        runs=(),
        score=None,
        failure=done.crash,
        wall_seconds=done.seconds,
        simulated_seconds=0.0,
        confirms=job.confirms,
    )
