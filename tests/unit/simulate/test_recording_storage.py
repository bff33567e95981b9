"""Results files come back bit for bit, and are complete or not there at all."""

import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
import xarray as xr

from neuromech.errors import RecordingError
from neuromech.simulate import storage
from neuromech.simulate.recording import GroupData, Outcome, Provenance, Recording


def recording(samples=200):
    random = np.random.default_rng(1)
    values = random.standard_normal((samples, 3))
    values[0] = [np.nan, -np.inf, -0.0]
    values[1, 0] = 5e-324
    neurons = GroupData(np.arange(samples) * 1e-3, ("A.activity", "B.ä.activity", "C.force"), values, ("", "", "N"))
    body = GroupData(np.arange(7) * 0.1, ("hip.angle",), random.standard_normal((7, 1)), ("rad",))
    outcome = Outcome("finished", 0.2)
    origin = Provenance("cat", "name: x\n" * 20000, "0.1.0", {"numpy": "2"}, "none", "Linux", 0, {}, outcome, 0.2, 0.1)
    return Recording.from_groups({"neurons": neurons, "body": body}, origin)


def test_a_results_file_comes_back_bit_for_bit(tmp_path):
    written = recording()
    storage.save(written, tmp_path / "run.nc")
    read = storage.load(tmp_path / "run.nc")
    assert read.names == written.names
    assert read.provenance == written.provenance
    for name in written.names:
        for ours, theirs in zip(written.signal(name), read.signal(name), strict=True):
            assert ours.tobytes() == theirs.tobytes()
        assert read.unit(name) == written.unit(name)


def test_any_netcdf_reader_finds_the_names_and_units(tmp_path):
    storage.save(recording(), tmp_path / "run.nc")
    with xr.open_datatree(tmp_path / "run.nc", engine="h5netcdf") as tree:
        assert tree["neurons/force"].attrs["units"] == "N"
        assert list(tree["neurons/activity_element"].values) == ["A", "B.ä"]


def test_saving_again_replaces_the_file_and_leaves_nothing_else(tmp_path):
    file = tmp_path / "folder" / "run.nc"
    storage.save(recording(50), file)
    storage.save(recording(60), file)
    assert len(storage.load(file).signal("C.force")[0]) == 60
    assert [path.name for path in file.parent.iterdir()] == ["run.nc"]


@pytest.mark.parametrize("content", [b"", b"no netcdf at all", b"\x89HDF\r\n\x1a\n" + b"\0" * 100])
def test_a_foreign_file_is_refused_with_a_hint(tmp_path, content):
    file = tmp_path / "other.nc"
    file.write_bytes(content)
    with pytest.raises(RecordingError, match=r"no recording of neuromech. Hint: give a results file"):
        storage.load(file)


def test_a_netcdf_file_of_someone_else_is_refused(tmp_path):
    file = tmp_path / "other.nc"
    xr.Dataset({"a": ("x", np.zeros(3))}).to_netcdf(file, engine="h5netcdf")
    with pytest.raises(RecordingError, match="no recording of neuromech"):
        storage.load(file)


def test_a_missing_file_is_said_to_be_missing(tmp_path):
    with pytest.raises(RecordingError, match=r"run.nc does not exist"):
        storage.load(tmp_path / "run.nc")


def test_a_folder_that_cannot_be_written_is_an_error_with_words(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(RecordingError, match="cannot be written"):
        storage.save(recording(), tmp_path / "file" / "run.nc")


def test_an_interrupted_write_keeps_the_old_file_and_removes_the_partial_one(tmp_path, monkeypatch):
    file = tmp_path / "run.nc"
    storage.save(recording(50), file)
    before = file.read_bytes()
    write = storage._write

    def interrupted(recording, partial):
        write(recording, partial)
        raise KeyboardInterrupt

    monkeypatch.setattr(storage, "_write", interrupted)
    with pytest.raises(KeyboardInterrupt):
        storage.save(recording(60), file)
    assert file.read_bytes() == before
    assert list(tmp_path.iterdir()) == [file]


KILLED = """
import sys, time
from pathlib import Path
sys.path.insert(0, {folder!r})
from test_recording_storage import recording
from neuromech.simulate import storage

write = storage._write

def slow(recording, partial):
    write(recording, partial)
    with partial.open("r+b") as opened:
        opened.truncate(1000)
    print("writing", flush=True)
    time.sleep(60)

storage._write = slow
storage.save(recording(), Path({file!r}))
"""


def test_a_killed_write_leaves_nothing_under_the_final_name(tmp_path):
    file = tmp_path / "run.nc"
    code = KILLED.format(folder=os.path.dirname(__file__), file=str(file))
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout.readline() == "writing\n"
        process.send_signal(signal.SIGKILL)
    assert not file.exists()
    storage.save(recording(), file)
    assert len(storage.load(file).names) == 4


def test_twenty_seconds_of_a_cat_are_written_within_seconds(tmp_path):
    samples, signals = 20000, 100
    values = np.sin(np.arange(samples)[:, None] * np.linspace(0.001, 0.01, signals))
    names = tuple(f"N{i}.activity" for i in range(signals))
    groups = {"all": GroupData(np.arange(samples) * 1e-3, names, values, ("",) * signals)}
    started = time.perf_counter()
    storage.save(Recording.from_groups(groups, recording().provenance), tmp_path / "run.nc")
    assert time.perf_counter() - started < 10.0
