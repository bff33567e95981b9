"""One study in a database, by Optuna; `optuna-dashboard` shows it.

A study is a study of Optuna. Evaluation n is its trial n. The trials of a generation are made in one transaction before
its first evaluation starts, and wait; each gets all its results in one transaction. So a trial that does not wait any
more is complete. The state of the algorithm is an attribute of the study, written as a whole after each generation.

Trials are written as rows of Optuna's tables: its own functions ask the database several times for each parameter,
which may take longer than a simulation. Everything is read through them.
"""

import json
import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from datetime import UTC, datetime, timedelta
from types import MappingProxyType
from typing import Any

from optuna.distributions import FloatDistribution, distribution_to_json
from optuna.exceptions import StorageInternalError
from optuna.storages import RDBStorage
from optuna.storages._rdb import models
from optuna.trial import FrozenTrial, TrialState
from sqlalchemy import Connection, Table, bindparam, insert, select, update
from sqlalchemy.exc import SQLAlchemyError

from neuromech.errors import StudyError
from neuromech.study.evaluation import Confirms, Evaluation, Job, Parameters
from neuromech.study.header import Header
from neuromech.study.score import Score
from neuromech.study.space import Space
from neuromech.units import unit_factor

BOUNDARY = "algorithm"
_STUDIES: Table = models.StudyModel.__table__
_TRIALS: Table = models.TrialModel.__table__
_PARAMETERS: Table = models.TrialParamModel.__table__
_ATTRIBUTES: Table = models.TrialUserAttributeModel.__table__
_VALUES: Table = models.TrialValueModel.__table__
_ONLY_OBJECTIVE: Mapping[str, Any] = MappingProxyType(
    {"objective": 0, "value_type": models.TrialValueModel.TrialValueType.FINITE}
)
_LOCK = select(_STUDIES.c.study_id).where(_STUDIES.c.study_id == bindparam("study")).with_for_update()
_NEW_TRIALS, _NEW_PARAMETERS = insert(_TRIALS), insert(_PARAMETERS)
_NEW_ATTRIBUTES, _NEW_VALUE = insert(_ATTRIBUTES), insert(_VALUES)
_ADDED = (
    select(_TRIALS.c.number, _TRIALS.c.trial_id)
    .where(_TRIALS.c.study_id == bindparam("study"), _TRIALS.c.trial_id > bindparam("latest"))
    .order_by(_TRIALS.c.trial_id)
)
_FINISHED = update(_TRIALS).where(_TRIALS.c.trial_id == bindparam("trial"), _TRIALS.c.state == TrialState.WAITING)
"""Statements are made once: making one takes longer than carrying it out."""

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
        generation: that it belongs to.
        index: its place there.
        parameters: what it sets, name -> value with unit.
        seeds: of its runs.
        confirms: what it confirms, None for one of the search.
        evaluation: what became of it, None while it runs or where its process was killed.
    """

    number: int
    generation: int
    index: int
    parameters: Parameters
    seeds: tuple[int, ...]
    confirms: Confirms | None
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
        return list(map(_stored, trials))

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

    def begin(self, jobs: Sequence[Job], space: Space) -> None:
        """Store which evaluations come next, in one transaction; those that are stored already are left as they are.

        Raises:
            StudyError: the database fails, or another process works on the study.
        """
        new = [job for job in jobs if job.number not in self._trials]
        if not new:
            return
        with working(self.place), self._storage.engine.begin() as connection:
            # Whoever else begins evaluations of this study waits here, so that what he began is seen below.
            connection.execute(_LOCK, {"study": self._study})
            rows = [{"number": job.number, "study_id": self._study, "state": TrialState.WAITING} for job in new]
            connection.execute(_NEW_TRIALS, rows)
            added = self._after(connection, max(self._trials.values(), default=0))
            if [number for number, _ in added] != [job.number for job in new]:
                raise StudyError(_ELSEWHERE)
            ids = dict(added)
            rows = [row for job in new for row in _parameter_rows(ids[job.number], job, space)]
            connection.execute(_NEW_PARAMETERS, rows)
            rows = [row for job in new for row in _attribute_rows(ids[job.number], _known(job))]
            connection.execute(_NEW_ATTRIBUTES, rows)
        self._trials |= ids

    def finish(self, evaluations: Sequence[Evaluation]) -> None:
        """Store complete evaluations that were begun, in one transaction.

        Raises:
            StudyError: the database fails, or another process works on the study.
        """
        staged = bool(self.header.stages)
        trials = [(self._trials[one.number], one) for one in evaluations]
        values = [
            {"trial_id": trial, "value": shown_value(one.score, staged), **_ONLY_OBJECTIVE}
            for trial, one in trials
            if one.score is not None
        ]
        with working(self.place), self._storage.engine.begin() as connection:
            for trial, one in trials:
                if not connection.execute(_FINISHED, {"trial": trial, **_ending(one)}).rowcount:
                    raise StudyError(_ELSEWHERE)
            rows = [row for trial, one in trials for row in _attribute_rows(trial, _results(one))]
            connection.execute(_NEW_ATTRIBUTES, rows)
            if values:
                connection.execute(_NEW_VALUE, values)

    def _after(self, connection: Connection, latest: int) -> list[tuple[int, int]]:
        """Return (number, id) of the trials of this study that were added after one, in order."""
        found = connection.execute(_ADDED, {"study": self._study, "latest": latest})
        return [(number, trial) for number, trial in found]


def shown_value(score: Score, staged: bool) -> float:
    """Return the number that Optuna's tools show: the value, or with stages the stage plus the value mapped to 0…1."""
    return score.stage + 0.5 + math.atan(score.value) / math.pi if staged else score.value


def _known(job: Job) -> dict[str, Any]:
    """Return what is known of an evaluation before it starts."""
    known = {"generation": job.generation, "index": job.index, "seeds": job.seeds, "parameters": job.parameters}
    return known if job.confirms is None else known | {"confirms": job.confirms}


def _parameter_rows(trial: int, job: Job, space: Space) -> list[dict[str, Any]]:
    """Return the parameters as Optuna's tools show them: numbers in the unit of the document, with their bounds."""
    rows = []
    for one in space.dimensions:
        factor = unit_factor(one.unit)[0]
        bounds = FloatDistribution(one.least / factor, one.most / factor, log=one.log)
        value = float(job.parameters[one.name].partition(" ")[0])
        row = {"param_name": one.name, "param_value": value, "distribution_json": distribution_to_json(bounds)}
        rows.append({"trial_id": trial, **row})
    return rows


def _attribute_rows(trial: int, attributes: Mapping[str, Any]) -> list[dict[str, Any]]:
    return [{"trial_id": trial, "key": key, "value_json": json.dumps(value)} for key, value in attributes.items()]


def _results(evaluation: Evaluation) -> dict[str, Any]:
    """Return what `begin` did not know yet."""
    known = ("number", "generation", "index", "parameters", "confirms")
    return {name: value for name, value in evaluation.to_dict().items() if name not in known}


def _ending(evaluation: Evaluation) -> dict[str, Any]:
    now = datetime.now(UTC).replace(tzinfo=None)
    return {
        "state": TrialState.FAIL if evaluation.score is None else TrialState.COMPLETE,
        "datetime_start": now - timedelta(seconds=evaluation.wall_seconds),
        "datetime_complete": now,
    }


def _stored(trial: FrozenTrial) -> StoredTrial:
    known = trial.user_attrs
    return StoredTrial(
        number=trial.number,
        generation=known["generation"],
        index=known["index"],
        parameters=known["parameters"],
        seeds=tuple(known["seeds"]),
        confirms=known.get("confirms"),
        evaluation=_evaluation(trial),
    )


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
    except (StorageInternalError, SQLAlchemyError) as error:
        hint = "what is stored is safe; resume when the database works again"
        raise StudyError(f"{shown} fails: {reason(error)}. Hint: {hint}") from error


def reason(error: BaseException) -> str:
    """Return the first line of what the database itself says."""
    cause = error.__cause__ if isinstance(error, StorageInternalError) and error.__cause__ else error
    said = str(getattr(cause, "orig", None) or cause).strip()
    return said.partition("\n")[0].rstrip(".")
