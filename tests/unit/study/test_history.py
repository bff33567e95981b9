"""What a study found, in words and numbers for people and programs."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from searches import plan_in

from neuromech.errors import StudyError
from neuromech.study.evaluation import Evaluation, RunResult
from neuromech.study.export import dataset, export, table
from neuromech.study.header import Header
from neuromech.study.history import best_of, failures, generations
from neuromech.study.progress import Tally, median
from neuromech.study.score import Score


def evaluation(number: int, score: float | None, stage: int = 0, fell: bool = False) -> Evaluation:
    run = RunResult(
        "plain", 5, "fell" if fell else "finished", 2.0, "", {"speed": 0.1 * number, "gait": "trot"}, {"speed": 1.0}
    )
    return Evaluation(
        number,
        number // 3,
        number % 3,
        {"gain": repr(0.1 * number), "delay": f"{number}.5 ms"},
        () if score is None else (run, replace(run, seed=6, measures={"speed": "no rhythm", "gait": "pace"})),
        None if score is None else Score(stage, score),
        "it broke" if score is None else None,
        0.5,
        4.0,
    )


EVALUATIONS = [
    evaluation(0, 1.0),
    evaluation(1, None),
    evaluation(2, 3.0),
    evaluation(3, -5.0, stage=1, fell=True),
    evaluation(4, None),
    evaluation(5, None),
    evaluation(6, None),
]


def test_generations_rank_stages_first_and_failures_last():
    found = generations(EVALUATIONS)
    assert [one.best for one in found] == [Score(0, 3.0), Score(1, -5.0), None]
    assert [one.best_so_far for one in found] == [Score(0, 3.0), Score(1, -5.0), Score(1, -5.0)]
    assert [one.median for one in found] == [Score(0, 1.0), None, None]
    assert [(one.evaluations, one.failed, one.fell) for one in found] == [(3, 1, 0), (3, 2, 1), (1, 1, 0)]


def test_the_best_is_the_earliest_of_equals():
    best = best_of(EVALUATIONS)
    assert best is not None
    assert best.number == 3
    twins = [evaluation(2, 1.0), evaluation(1, 1.0), evaluation(0, 0.5)]
    assert best_of(twins) == twins[1]
    assert best_of([evaluation(0, None)]) is None


def test_failures_are_gathered_by_their_message():
    other = replace(evaluation(7, None), failure="it fell apart")
    assert failures([other, *EVALUATIONS]) == [("it broke", [1, 4, 5, 6]), ("it fell apart", [7])]


def test_the_median_counts_failures_as_worst():
    scores = [Score(0, float(value)) for value in (1, 2, 3)]
    assert median(scores) == scores[1]
    assert median([*scores, None]) == scores[0]
    assert median([*scores, None, None]) == scores[0]
    assert median([*scores, None, None, None, None]) is None
    assert median([]) is None


def test_rates_count_this_session_only():
    now = [100.0]
    tally = Tally(10, clock=lambda: now[0])
    tally.add(EVALUATIONS[0], fresh=False)
    tally.start()
    now[0] += 2.0
    assert tally.standing().remaining is None
    for one in EVALUATIONS[1:4]:
        tally.add(one)
    standing = tally.standing()
    assert (standing.done, standing.crashed, standing.fallen) == (4, 1, 1)
    assert standing.rate == pytest.approx(1.5)
    assert standing.real_time_factor == pytest.approx(6.0)
    assert standing.remaining == pytest.approx(4.0)
    assert standing.best == Score(1, -5.0)


@pytest.fixture
def header(tmp_path: Path) -> Header:
    return plan_in(tmp_path).header


def test_a_table_has_a_row_for_each_evaluation_and_columns_with_units(header: Header):
    found = table(header, EVALUATIONS)
    assert list(found["evaluation"]) == list(range(7))
    assert list(found["parameter:delay [ms]"])[:2] == [0.5, 1.5]
    assert found["measure:speed[0]"][3] == pytest.approx(0.3)
    assert np.isnan(found["measure:speed[1]"][3])
    assert list(found["measure:gait[1]"])[:3] == ["pace", "", "pace"]
    assert list(found["stage"]) == [0, -1, 0, 1, -1, -1, -1]


def test_each_format_holds_the_same_numbers(header: Header, tmp_path: Path):
    for name in ("a.csv", "a.parquet", "a.nc"):
        export(header, EVALUATIONS, tmp_path / name)
    expected = table(header, EVALUATIONS)
    pd.testing.assert_frame_equal(pd.read_parquet(tmp_path / "a.parquet"), expected)
    read = pd.read_csv(tmp_path / "a.csv", keep_default_na=False, na_values={name: [""] for name in ("score",)})
    assert list(read["score"].dropna()) == [1.0, 3.0, -5.0]
    with xr.open_dataset(tmp_path / "a.nc", engine="h5netcdf") as opened:
        assert opened["parameter:delay"].attrs["units"] == "ms"
        np.testing.assert_array_equal(opened["score"], dataset(header, EVALUATIONS)["score"])
        assert opened["outcome"].values[3, 0] == "fell"


def test_an_unknown_format_and_a_study_without_evaluations(header: Header, tmp_path: Path):
    with pytest.raises(StudyError, match=r"no format for '\.xls'.*\.csv, \.parquet, \.nc"):
        export(header, EVALUATIONS, tmp_path / "a.xls")
    assert len(table(header, [])) == 0
