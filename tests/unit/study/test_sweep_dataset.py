"""The file of a sweep: dimensions with names and units, and words for everything that is not there."""

import json

import numpy as np
import pytest
import xarray as xr
from sweep_documents import MEASURES, results_of, task_in

from neuromech.errors import RecordingError
from neuromech.study.sweeps.dataset import dataset, load, save

GRID = "vary: {time_constant: {values: [5 ms, 0.1 ms]}, first_bias: {values: [0.3, 0.6, 0.9]}}\nseeds: 2"


def tree_of(folder, sweep, measures=MEASURES):
    task = task_in(folder, sweep, measures)
    return dataset(task.document, task.name, task.design, task.kinds, results_of(task, folder))


def test_a_grid_is_one_dataset_with_units_and_without_unexplained_gaps(tmp_path):
    tree = tree_of(tmp_path, GRID)
    save(tree, tmp_path / "sweep.nc")
    assert load(tmp_path / "sweep.nc").identical(tree)
    with xr.open_dataset(tmp_path / "sweep.nc", engine="h5netcdf") as data:
        assert dict(data.sizes) == {"time_constant": 2, "first_bias": 3, "seed": 2}
        assert data["time_constant"].values.tolist() == [5.0, 0.1]
        assert data["time_constant"].attrs["units"] == "ms"
        assert data["seed"].values.tolist() == [0, 1]
        assert data["period"].attrs["units"] == "s"
        assert data["first"].attrs["units"] == ""
        for name in ("first", "second", "period"):
            assert (np.isnan(data[name].values) == (data[f"{name}_missing"].values != "")).all()
        assert (data["outcome"].sel(time_constant=5.0) == "finished").all()
        assert (data["outcome"].sel(time_constant=0.1) == "diverged").all()
        assert (data["message"].sel(time_constant=0.1) != "").all()
        assert (data["rhythm"].sel(time_constant=5.0) == "no rhythm").all()
        assert (data["rhythm"].sel(time_constant=0.1) == "").all()
        assert (data["rhythm_missing"].sel(time_constant=0.1) != "").all()


def test_the_file_says_where_it_comes_from(tmp_path):
    attributes = tree_of(tmp_path, GRID).attrs
    assert attributes["name"] == "two cells"
    assert attributes["sweep"] == "sweep"
    assert attributes["engine"] == "none"
    assert "first_bias" in attributes["specification"]
    assert set(json.loads(attributes["versions"])) >= {"neuromech", "numpy", "numba"}


def test_other_designs_have_a_dataset_for_each_parameter_or_pair(tmp_path):
    vary = "vary: {first_bias: {values: [0.3, 0.6]}, second_bias: {values: [0.1, 0.2, 0.3]}}"
    single = tree_of(tmp_path, f"{vary}\ndesign: one_at_a_time")
    assert {name: dict(node.sizes) for name, node in single.children.items()} == {
        "first_bias": {"first_bias": 2, "seed": 1},
        "second_bias": {"second_bias": 3, "seed": 1},
    }
    (tmp_path / "unfinished.jsonl").unlink()
    pairs = tree_of(tmp_path, f"{vary}\ndesign: pairs\nfor_each: {{delay: {{values: [2 ms, 3 ms]}}}}")
    assert dict(pairs["first_bias and second_bias"].sizes) == {
        "delay": 2,
        "first_bias": 2,
        "second_bias": 3,
        "seed": 1,
    }


def test_a_file_of_something_else_is_refused(tmp_path):
    xr.Dataset({"a": 1}).to_netcdf(tmp_path / "a.nc", engine="h5netcdf")
    (tmp_path / "b.nc").write_text("hello")
    for name, said in (("a.nc", "is no sweep"), ("b.nc", "is no sweep"), ("c.nc", "does not exist")):
        with pytest.raises(RecordingError, match=said):
            load(tmp_path / name)
