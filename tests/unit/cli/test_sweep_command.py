"""`neuromech sweep`: what it writes, what it says, and that it goes on where it was stopped."""

import json
import os
import signal
import subprocess
import sys
import time
from concurrent.futures import Future
from pathlib import Path

import pytest

from neuromech.cli import sweep as command
from neuromech.cli.main import run_arguments
from neuromech.study.executors import Executor
from neuromech.study.sweeps.dataset import load
from neuromech.study.tasks import call as carried_out

DOCUMENT = """
neuromech: 1
name: one cell
parameters:
  bias: {value: 0.5, minimum: 0, maximum: 1}
network:
  neurons:
    cell: {kind: rate_neuron, time_constant: 10 ms, bias: "${bias}"}
protocol: {duration: 100 ms}
record:
  all: {signals: ["*.activity"], every: 1 ms}
sweeps:
  levels:
    vary: {bias: {range: [0.2, 0.8], count: 4}}
    measures:
      level: {kind: final, signal: cell.activity}
      rhythm: {kind: rhythm, signal: cell.activity}
      period: {kind: period, signal: cell.activity}
  two:
    vary: {bias: {values: [0.3, 0.4]}}
    measures: {level: {kind: final, signal: cell.activity}}
"""


class InlineExecutor(Executor):
    """Carries out runs in this process."""

    workers = 1

    def prepare(self, function):
        function()

    def close(self):
        """Nothing to let go."""

    def _slots(self):
        return 1

    def _submit(self, pickled, job):
        future = Future()
        future.set_result(carried_out(pickled, job))
        return future

    def _release(self, future):
        return False


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(command, "open_executor", lambda workers, dask: InlineExecutor())
    Path("one.yaml").write_text(DOCUMENT)
    return tmp_path


def call(*arguments):
    with pytest.raises(SystemExit) as ended:
        run_arguments(arguments)
    return int(ended.value.code or 0)


def test_every_sweep_has_its_file_figures_and_line(here, capsys):
    assert call("sweep", "one.yaml") == 0
    said = capsys.readouterr().err
    assert "levels: 4 points, 4 finished" in said
    assert "two: 2 points, 2 finished" in said
    assert "wrote results/one_cell/sweeps/levels/sweep.nc" in said
    folder = here / "results" / "one_cell" / "sweeps"
    assert sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file()) == [
        "levels/figures/level.png",
        "levels/figures/period.png",
        "levels/figures/rhythm.png",
        "levels/sweep.nc",
        "two/figures/level.png",
        "two/sweep.nc",
    ]


def test_json_says_what_was_found(here, capsys):
    assert call("sweep", "one.yaml", "levels", "--json", "--quiet", "--no-figures", "--out", "there") == 0
    captured = capsys.readouterr()
    assert captured.err == ""
    (found,) = json.loads(captured.out)
    assert found["sweep"] == "levels"
    assert found["outcomes"] == {"finished": 4}
    assert found["measures"]["period"] == {"unit": "s", "least": None, "greatest": None, "missing": 4}
    assert found["measures"]["rhythm"] == {"words": {"no rhythm": 4}, "missing": 0}
    assert found["measures"]["level"]["least"] == pytest.approx(0.0474, abs=1e-3)
    assert found["files"] == ["there/levels/sweep.nc"]


def test_changes_of_the_document_are_swept(here):
    assert call("sweep", "one.yaml", "two", "--quiet", "--set", "sweeps.two.vary.bias.values=[0.1, 0.9, 1.0]") == 0
    assert load(Path("results/one_cell/sweeps/two/sweep.nc"))["bias"].values.tolist() == [0.1, 0.9, 1.0]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (
            ("sweep", "one.yaml", "levls"),
            "one.yaml:12:1  sweeps  there is no sweep 'levls'. Hint: did you mean 'levels'?\n",
        ),
        (
            ("sweep", "one.yaml", "--workers", "2", "--dask", "tcp://127.0.0.1:1"),
            "--dask  goes with '--workers' only on this machine. Hint: the cluster says how many workers it has\n",
        ),
        (
            ("sweep", "one.yaml", "--set", "sweeps=null"),
            "the document has no sweep. Hint: write a section 'sweeps', see docs/studies.md\n",
        ),
        (
            ("sweep", "one.yaml", "levels", "--set", "sweeps.levels.measures.level.signal=cell.rate"),
            "sweeps.levels.measures.level.signal  matches no recorded signal (got 'cell.rate'). Hint: record it\n",
        ),
        (
            ("sweep", "one.yaml", "levels", "--set", "sweeps.levels.vary.bias.range=[0, 2]"),
            "sweeps.levels.vary.bias.range.1  is above the maximum of the parameter 'bias', 1 (got 2).\n",
        ),
    ],
)
def test_bad_input_is_a_sentence(here, capsys, arguments, said):
    assert call(*arguments) == 2
    assert capsys.readouterr().err.endswith(said)


def test_a_stopped_sweep_says_how_to_go_on_and_does_so(here, capsys, monkeypatch):
    class Pressed(InlineExecutor):
        def _submit(self, pickled, job):
            if job.number == 2:
                os.kill(os.getpid(), signal.SIGINT)
            return super()._submit(pickled, job)

    with monkeypatch.context() as patched:
        patched.setattr(command, "open_executor", lambda workers, dask: Pressed())
        assert call("sweep", "one.yaml", "levels", "--set", "parameters.bias.value=0.6", "--quiet") == 3
    said = capsys.readouterr().err
    journal = "results/one_cell/sweeps/levels/unfinished.jsonl"
    assert said == (
        "stopping when the runs under way are complete; Ctrl-C once more drops them\n"
        f"stopped; 3 of 4 points are kept in {journal}\n"
        "go on with: neuromech sweep one.yaml levels --set parameters.bias.value=0.6\n"
    )
    assert call("sweep", "one.yaml", "levels", "--quiet") == 2
    assert "parameters.bias.value: 0.6 → 0.5" in capsys.readouterr().err
    assert call("sweep", "one.yaml", "levels", "--set", "parameters.bias.value=0.6", "--no-figures") == 0
    assert "3 of 4 runs were finished before" in capsys.readouterr().err
    assert not Path(journal).exists()
    assert load(Path(journal).with_name("sweep.nc"))["level_missing"].values.tolist() == [[""]] * 4


def test_restart_forgets_what_was_finished(here, capsys):
    folder = Path("results/one_cell/sweeps/two")
    folder.mkdir(parents=True)
    (folder / "unfinished.jsonl").write_text("of another program\n")
    assert call("sweep", "one.yaml", "two", "--quiet") == 2
    assert "is no journal of a sweep" in capsys.readouterr().err
    assert call("sweep", "one.yaml", "two", "--quiet", "--restart") == 0


@pytest.mark.slow
def test_a_killed_sweep_goes_on_to_the_results_of_one_that_was_not(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    spec = Path(__file__).parents[3] / "specs" / "cat" / "quadruped_cpg_sweeps.yaml"
    words = [sys.executable, "-m", "neuromech.cli", "sweep", str(spec), "period_against_drive", "--no-figures"]
    options = ["--set", "sweeps.period_against_drive.duration=8 s", "--workers", "2", "--out"]
    subprocess.run([*words, *options, "whole"], check=True, capture_output=True)
    journal = Path("killed/period_against_drive/unfinished.jsonl")
    for least in (2, 5, 9):
        process = subprocess.Popen([*words, *options, "killed"], stderr=subprocess.DEVNULL)
        while not (journal.exists() and journal.read_bytes().count(b"\n") > least):
            assert process.poll() is None
            time.sleep(0.02)
        process.send_signal(signal.SIGKILL)
        process.wait()
    ended = subprocess.run([*words, *options, "killed"], check=True, capture_output=True, text=True)
    assert "of 16 runs were finished before" in ended.stderr
    whole, killed = (load(Path(one, "period_against_drive", "sweep.nc")) for one in ("whole", "killed"))
    assert killed.identical(whole)
