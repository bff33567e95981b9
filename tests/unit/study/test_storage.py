"""What is stored: exact, readable by Optuna's own tools, and refused in words where it cannot be."""

import sqlite3
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from threading import Barrier

import numpy as np
import optuna
import pytest
from searches import plan_in
from sqlalchemy import Engine, create_engine, inspect, text
from sqlalchemy.pool import NullPool

from neuromech.errors import StudyError
from neuromech.study.database import Database
from neuromech.study.evaluation import Evaluation, Job, RunResult
from neuromech.study.plan import Plan
from neuromech.study.score import Score
from neuromech.study.storage import Boundary, shown_value

AWKWARD = 0.1 + 0.2


@pytest.fixture(scope="module")
def plan(tmp_path_factory: pytest.TempPathFactory) -> Plan:
    return plan_in(tmp_path_factory.mktemp("document"))


def job(plan: Plan, number: int) -> Job:
    return Job(number, 0, number, plan.space.parameters(np.array([AWKWARD, 1.0])), (4294967295, 7))


def evaluation(plan: Plan, number: int, score: Score | None) -> Evaluation:
    run = RunResult("plain", 7, "fell", AWKWARD, "too low", {"a": AWKWARD, "b": "no rhythm"}, {"a": -AWKWARD}, score)
    parameters = {"gain": "0.6700000000000002", "delay": "100.0 ms"}
    failure = None if score else "state x is not a finite number any more"
    return Evaluation(number, 0, number, parameters, (run,), score, failure, 1.5, AWKWARD)


def test_what_is_read_back_is_what_was_stored_to_the_last_bit(plan: Plan, tmp_path: Path):
    stored = Database(str(tmp_path / "a.db")).create("study", plan.header)
    assert stored.trials() == []
    given = [evaluation(plan, 0, Score(0, -AWKWARD)), evaluation(plan, 1, None)]
    for one in given:
        stored.begin([job(plan, one.number)], plan.space)
        stored.finish([one])
    stored.begin([job(plan, 2)], plan.space)
    boundary = Boundary(3, 12, {"points": [[AWKWARD]], "memory": {"velocity": [5e-324]}})
    stored.set_boundary(boundary)
    again = Database(str(tmp_path / "a.db"), create=False).open("study")
    assert again.header == plan.header
    assert again.boundary() == boundary
    assert [trial.evaluation is None for trial in again.trials()] == [False, False, True]
    known = job(plan, 0).parameters
    for one, found in zip(given, again.evaluations(), strict=True):
        assert found.parameters == known
        assert {**found.to_dict(), "parameters": one.parameters} == one.to_dict()


def test_optuna_sees_parameters_with_bounds_and_failures_as_failures(plan: Plan, tmp_path: Path):
    stored = Database(str(tmp_path / "a.db")).create("study", plan.header)
    for one in (evaluation(plan, 0, Score(0, -2.5)), evaluation(plan, 1, Score(0, -1.5)), evaluation(plan, 2, None)):
        stored.begin([job(plan, one.number)], plan.space)
        stored.finish([one])
    stored.begin([job(plan, 3)], plan.space)
    study = optuna.load_study(study_name="study", storage=f"sqlite:///{tmp_path / 'a.db'}")
    assert [trial.state.name for trial in study.trials] == ["COMPLETE", "COMPLETE", "FAIL", "WAITING"]
    assert [trial.number for trial in study.trials] == [0, 1, 2, 3]
    assert study.best_trial.number == 1
    assert study.best_value == -1.5
    assert study.best_params["delay"] == pytest.approx(100.0)
    assert study.best_trial.distributions["delay"] == optuna.distributions.FloatDistribution(1.0, 100.0, log=True)
    assert study.best_trial.user_attrs["runs"][0]["measures"] == {"a": AWKWARD, "b": "no rhythm"}
    assert study.best_trial.user_attrs["seeds"] == [4294967295, 7]
    assert study.trials[2].user_attrs["failure"] == "state x is not a finite number any more"
    assert study.trials[0].duration.total_seconds() == pytest.approx(1.5)


def test_optunas_number_keeps_the_order_of_staged_scores():
    scores = [Score(0, -1e6), Score(0, 0.0), Score(0, 1e6), Score(1, -1e6), Score(1, 0.5), Score(2, -3.0)]
    numbers = [shown_value(score, staged=True) for score in scores]
    assert numbers == sorted(numbers)
    assert [int(number) for number in numbers] == [score.stage for score in scores]
    assert shown_value(Score(0, -7.25), staged=False) == -7.25


def test_a_study_is_begun_once(plan: Plan, tmp_path: Path):
    database = Database(str(tmp_path / "a.db"))
    database.create("study", plan.header)
    stored = database.create("study", plan.header)
    stored.begin([job(plan, 0)], plan.space)
    with pytest.raises(StudyError, match=r"a\.db holds a study 'study' already.*--resume"):
        database.create("study", plan.header)
    with pytest.raises(StudyError, match=r"holds no study 'other' \(it holds 'study'\)"):
        database.open("other")


def test_a_study_that_was_killed_before_it_said_what_it_is_can_be_begun(plan: Plan, tmp_path: Path):
    file = tmp_path / "a.db"
    optuna.create_study(study_name="study", storage=f"sqlite:///{file}", direction="maximize")
    assert Database(str(file)).names() == []
    assert Database(str(file)).create("study", plan.header).trials() == []
    assert Database(str(file)).names() == ["study"]


def test_evaluations_of_another_process_are_noticed(plan: Plan, tmp_path: Path):
    first = Database(str(tmp_path / "a.db")).create("study", plan.header)
    second = Database(str(tmp_path / "a.db")).open("study")
    first.begin([job(plan, 0)], plan.space)
    with pytest.raises(StudyError, match="another process"):
        second.begin([job(plan, 0)], plan.space)
    second.trials()
    first.finish([evaluation(plan, 0, Score(0, 1.0))])
    with pytest.raises(StudyError, match="another process"):
        second.finish([evaluation(plan, 0, Score(0, 1.0))])
    assert len(first.trials()) == 1


@pytest.mark.parametrize(
    ("place", "said"),
    [
        ("postgresql://me:secret@127.0.0.1:1/db", r"127\.0\.0\.1:1/db.*refused.*start the server"),
        ("mysql://host/db", r"'mysql' is no database.*postgresql://"),
        ("nothing://host:port:1", r"is no database URL.*postgresql://"),
        ("no/such/folder/study.db", "unable to open database file.*another file"),
    ],
)
def test_a_database_that_cannot_be_used_is_named_without_its_password(place: str, said: str):
    with pytest.raises(StudyError, match=said) as refused:
        Database(place)
    assert "secret" not in str(refused.value)


def test_a_file_of_something_else_is_refused_and_left_alone(tmp_path: Path):
    file = tmp_path / "letter.txt"
    file.write_text("Dear reader, this is no database." * 9)
    before = file.read_bytes()
    with pytest.raises(StudyError, match="not a database"):
        Database(str(file))
    assert file.read_bytes() == before
    with pytest.raises(StudyError, match="there is no such file"):
        Database(str(tmp_path / "absent.db"), create=False)
    assert not (tmp_path / "absent.db").exists()


@pytest.mark.parametrize("place", ["file", "server"])
def test_processes_may_begin_in_a_new_database_and_look_at_it_at_the_same_moment(
    place: str, server: str, tmp_path: Path
):
    for number in range(3):
        url = str(tmp_path / f"{number}.db") if place == "file" else _new_database(server, f"new{number}")
        together = Barrier(8)

        def use(one: int, url: str = url, together: Barrier = together) -> list[str]:
            together.wait()
            try:
                with Database(url, create=one % 2 == 0) as database:
                    return database.names()
            except StudyError as error:
                assert one % 2, error
                assert "holds no studies" in str(error) or "there is no such file" in str(error)
                return []

        with ThreadPoolExecutor(8) as pool:
            assert list(pool.map(use, range(8))) == [[]] * 8


def test_who_looks_makes_no_tables(server: str):
    url = _new_database(server, "empty")
    with pytest.raises(StudyError, match="empty holds no studies"):
        Database(url, create=False)
    assert inspect(_engine(url)).get_table_names() == []


def _new_database(server: str, name: str) -> str:
    with _engine(server).connect() as connection:
        connection.execute(text(f"CREATE DATABASE {name}"))
    return f"{server.rpartition('/')[0]}/{name}"


def _engine(url: str) -> Engine:
    address = url.replace("postgresql:", "postgresql+psycopg:")
    return create_engine(address, poolclass=NullPool, isolation_level="AUTOCOMMIT")


def test_a_database_that_fails_says_what_is_safe(plan: Plan, tmp_path: Path):
    stored = Database(str(tmp_path / "a.db")).create("study", plan.header)
    with sqlite3.connect(tmp_path / "a.db") as connection:
        connection.execute("DROP TABLE trial_params")
    with pytest.raises(StudyError, match=r"a\.db fails: no such table.*resume"):
        stored.begin([job(plan, 0)], plan.space)
