"""What a study has begun and completed, and the number of each of its evaluations."""

from collections.abc import Iterable, Sequence
from dataclasses import replace

from neuromech.errors import StudyError
from neuromech.study.evaluation import Evaluation, Job
from neuromech.study.storage import StoredTrial

_Key = tuple[object, ...]


class Register:
    """The evaluations of a study, known by their place: in the search generation and index, else parameters and seeds.

    So those of the search have the same place whenever a confirmation came between, and one that confirms a candidate
    is found again when a search that went on confirms it once more.
    """

    def __init__(self, trials: Sequence[StoredTrial]) -> None:
        """Take over what is stored."""
        self._begun = {_key(one): (one.number, one.parameters) for one in trials}
        self._found = {one.number: one.evaluation for one in trials if one.evaluation is not None}

    @property
    def evaluations(self) -> list[Evaluation]:
        """The complete evaluations, by number."""
        return [self._found[number] for number in sorted(self._found)]

    @property
    def searched(self) -> list[Evaluation]:
        """The complete evaluations of the search itself, by number."""
        return [one for one in self.evaluations if one.confirms is None]

    def numbered(self, jobs: Iterable[Job]) -> list[Job]:
        """Return jobs with their numbers: those that they were begun with, else the next ones.

        Raises:
            StudyError: one was begun with other parameters.
        """
        found = []
        following = len(self._begun)
        for job in jobs:
            number, parameters = self._begun.get(_key(job), (following, job.parameters))
            if parameters != job.parameters:
                hint = "resume with the versions of the packages that the study was begun with"
                raise StudyError(f"evaluation {number} is stored with other parameters than it has now. Hint: {hint}")
            following += number == following
            found.append(replace(job, number=number))
        return found

    def begin(self, jobs: Iterable[Job]) -> None:
        """Take note that numbered jobs have begun."""
        self._begun |= {_key(job): (job.number, job.parameters) for job in jobs}

    def finish(self, evaluation: Evaluation) -> None:
        """Take note of a complete evaluation."""
        self._found[evaluation.number] = evaluation

    def is_complete(self, job: Job) -> bool:
        """Tell whether a numbered job is evaluated."""
        return job.number in self._found

    def of(self, job: Job) -> Evaluation:
        """Return the evaluation of a numbered job that is complete."""
        return self._found[job.number]


def _key(one: Job | StoredTrial) -> _Key:
    if one.confirms is None:
        return (one.generation, one.index)
    return (*one.parameters.items(), one.seeds)
