"""One study in a database, by Optuna; `optuna-dashboard` shows it.

A study is a study of Optuna. Evaluation n is its trial n, which is made (running) before the evaluation starts and gets
its results after it: what was measured first, its final state last. So a trial that does not run any more is complete.
The state of the algorithm is an attribute of the study, written as a whole after each generation.
"""

import math
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from datetime import datetime
from typing import Any

import numpy as np
from optuna.distributions import BaseDistribution, FloatDistribution
from optuna.exceptions import StorageInternalError, UpdateFinishedTrialError
from optuna.storages import RDBStorage
from optuna.trial import FrozenTrial, TrialState
from sqlalchemy.exc import SQLAlchemyError

from neuromech.errors import StudyError
from neuromech.study.evaluation import Evaluation, Job
from neuromech.study.header import Header
from neuromech.study.score import Score
from neuromech.study.space import Space
from neuromech.units import unit_factor

BOUNDARY = "algorithm"
_ELSEWHERE = "another process continues this study at the same time. Hint: end one of them, then resume"


@dataclass(frozen=True, slots=True)
class Boundary:
    """Where a study stands between two generations.

    Args:
        generation: number of the generation that comes next.
        evaluations: how many evaluations the generations before it have.
        state: of the algorithm, before that generation.
    """

    generation: int
    evaluations: int
    state: Mapping[str, Any]


@dataclass(frozen=True, slots=True)
class StoredTrial:
    """An evaluation that was begun.

    Args:
        number: of the evaluation.
        parameters: what it sets: name -> value with unit.
        evaluation: what became of it, None while it runs or where its process was killed.
    """

    number: int
    parameters: Mapping[str, str]
    evaluation: Evaluation | None


class StoredStudy:
    """One study in a database; `Database.create` and `Database.open` give it."""

    def __init__(self, storage: RDBStorage, shown: str, number: int, header: Header) -> None:
        """Take over what `Database` found; `trials` tells what is there."""
        self.header = header
        self.place = shown
        self._storage = storage
        self._study = number
        self._trials: dict[int, int] = {}

    def trials(self) -> list[StoredTrial]:
        """Return the evaluations that were begun, by number.

        Raises:
            StudyError: the database fails.
        """
        with working(self.place):
            trials = sorted(self._storage.get_all_trials(self._study), key=lambda trial: trial.number)
        self._trials = {trial.number: trial._trial_id for trial in trials}
        return [StoredTrial(one.number, one.user_attrs["parameters"], _evaluation(one)) for one in trials]

    def evaluations(self) -> list[Evaluation]:
        """Return the evaluations that are complete, by number.

        Raises:
            StudyError: the database fails.
        """
        return [trial.evaluation for trial in self.trials() if trial.evaluation is not None]

    def boundary(self) -> Boundary | None:
        """Return where the study stands; None before the first generation is complete.

        Raises:
            StudyError: the database fails.
        """
        with working(self.place):
            found = self._storage.get_study_user_attrs(self._study).get(BOUNDARY)
        return None if found is None else Boundary(**found)

    def set_boundary(self, boundary: Boundary) -> None:
        """Store where the study stands, in one step.

        Raises:
            StudyError: the database fails.
        """
        with working(self.place):
            self._storage.set_study_user_attr(self._study, BOUNDARY, asdict(boundary))

    def begin(self, job: Job, space: Space) -> None:
        """Store that an evaluation is about to start, in one step; nothing happens where that is stored already.

        Raises:
            StudyError: the database fails, or another process works on the study.
        """
        if job.number in self._trials:
            return
        with working(self.place):
            made = self._storage.create_new_trial(self._study, _trial(job, space))
            number = self._storage.get_trial_number_from_id(made)
        if number != job.number:
            raise StudyError(_ELSEWHERE)
        self._trials[job.number] = made

    def finish(self, evaluation: Evaluation) -> None:
        """Store a complete evaluation that was begun; the last step makes it count.

        Raises:
            StudyError: the database fails, or another process works on the study.
        """
        trial = self._trials[evaluation.number]
        with working(self.place):
            for name, value in _results(evaluation).items():
                self._storage.set_trial_user_attr(trial, name, value)
            if evaluation.score is None:
                self._storage.set_trial_state_values(trial, TrialState.FAIL)
            else:
                value = shown_value(evaluation.score, bool(self.header.stages))
                self._storage.set_trial_state_values(trial, TrialState.COMPLETE, [value])


def shown_value(score: Score, staged: bool) -> float:
    """Return the number that Optuna's tools show: the value, or with stages the stage plus the value mapped to 0…1."""
    return score.stage + 0.5 + math.atan(score.value) / math.pi if staged else score.value


def _trial(job: Job, space: Space) -> FrozenTrial:
    """Return a running trial. Made without Optuna's check of bounds, which units may round by one bit."""
    written = space.parameters(np.array(job.point))
    numbers = {name: float(text.partition(" ")[0]) for name, text in written.items()}
    attributes = {"generation": job.generation, "index": job.index, "seeds": job.seeds, "parameters": written}
    return FrozenTrial(
        number=-1,
        state=TrialState.RUNNING,
        value=None,
        datetime_start=datetime.now(),
        datetime_complete=None,
        params={dimension.name: numbers[dimension.name] for dimension in space.dimensions},
        distributions=_distributions(space),
        user_attrs=attributes,
        system_attrs={},
        intermediate_values={},
        trial_id=-1,
    )


def _distributions(space: Space) -> dict[str, BaseDistribution]:
    found: dict[str, BaseDistribution] = {}
    for one in space.dimensions:
        factor = unit_factor(one.unit)[0]
        found[one.name] = FloatDistribution(one.least / factor, one.most / factor, log=one.log)
    return found


def _results(evaluation: Evaluation) -> dict[str, Any]:
    """Return what `begin` did not know yet."""
    known = ("number", "generation", "index", "parameters")
    return {name: value for name, value in evaluation.to_dict().items() if name not in known}


def _evaluation(trial: FrozenTrial) -> Evaluation | None:
    if not trial.state.is_finished():
        return None
    stored = {name: value for name, value in trial.user_attrs.items() if name != "seeds"}
    return Evaluation.from_dict({"number": trial.number, **stored})


@contextmanager
def working(shown: str) -> Iterator[None]:
    """Turn what goes wrong in a database into a `StudyError`."""
    try:
        yield
    except UpdateFinishedTrialError as error:
        raise StudyError(_ELSEWHERE) from error
    except (StorageInternalError, SQLAlchemyError) as error:
        hint = "what is stored is safe; resume when the database works again"
        raise StudyError(f"{shown} fails: {reason(error)}. Hint: {hint}") from error


def reason(error: BaseException) -> str:
    """Return the first line of what the database itself says."""
    cause = error.__cause__ if isinstance(error, StorageInternalError) and error.__cause__ else error
    said = str(getattr(cause, "orig", None) or cause).strip()
    return said.partition("\n")[0].rstrip(".")
