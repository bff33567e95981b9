"""`neuromech optimize` and `neuromech study`: what they say, refuse and leave behind."""

import json
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from neuromech.cli.main import run_arguments
from neuromech.cli.scores import score_text
from neuromech.cli.search_progress import search_progress, standing_text
from neuromech.errors import StudyError
from neuromech.study.database import Database
from neuromech.study.progress import Standing
from neuromech.study.score import Score

DOCUMENT = """
neuromech: 1
name: relaxing
parameters:
  bias: {value: 1, minimum: -2, maximum: 3}
  gain: {value: 0.5, minimum: 0.1, maximum: 2}
network:
  neurons:
    first: {kind: rate_neuron, time_constant: 10 ms, bias: "${bias}"}
    second: {kind: rate_neuron, time_constant: 10 ms}
  synapses: {excitatory: {first: {second: "${gain}"}}}
protocol: {duration: DURATION}
record:
  all: {signals: ["*.activity"], every: 1 ms}
study:
  tune: {bias: {}, gain: {}}
  algorithm: {kind: pso, population: 4}
  evaluations: 8
  objective:
    terms:
      level: {measure: {kind: final, signal: second.activity}, target: 0.3, scale: 0.1}
"""


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    Path("relaxing.yaml").write_text(DOCUMENT.replace("DURATION", "50 ms"))
    return tmp_path


def call(*arguments: str) -> int:
    with pytest.raises(SystemExit) as ended:
        run_arguments(arguments)
    return int(ended.value.code or 0)


def test_a_study_is_searched_resumed_written_back_and_looked_at(here: Path, capsys: pytest.CaptureFixture[str]):
    assert call("optimize", "relaxing.yaml", "--workers", "1", "--evaluations", "4") == 0
    said = capsys.readouterr().err
    assert "study 'relaxing' begins in results/relaxing/study.db" in said
    assert re.search(r"generation 1, 4 of 4, best -0\.\d+, median -0\.\d+, .*0 crashed, 0 fell", said)
    assert Path("results/relaxing/convergence.png").stat().st_size > 1000
    assert call("optimize", "relaxing.yaml", "--workers", "1") == 2
    assert "--resume continues it" in capsys.readouterr().err
    assert call("optimize", "relaxing.yaml", "--workers", "1", "--resume", "--write", "tuned.yaml", "--quiet") == 0
    assert "generation" not in capsys.readouterr().err
    assert call("validate", "tuned.yaml") == 0
    capsys.readouterr()
    assert call("study", "show", "results/relaxing/study.db", "--json", "--figure", "progress.svg") == 0
    shown = json.loads(capsys.readouterr().out)
    assert (shown["evaluations"], len(shown["generations"]), shown["failures"]) == (8, 2, [])
    assert Path("progress.svg").read_text().startswith("<?xml")
    assert call("study", "best", "results/relaxing/study.db", "--json") == 0
    assert json.loads(capsys.readouterr().out) == shown["best"]
    assert shown["best"]["parameters"]["gain"] in Path("tuned.yaml").read_text()
    Path("relaxing.yaml").write_text(DOCUMENT.replace("DURATION", "60 ms"))
    assert call("optimize", "relaxing.yaml", "--resume") == 2
    assert "~ protocol.duration: 50 ms → 60 ms\n" in capsys.readouterr().err


def test_the_confirmed_candidate_is_shown_and_written_back(here: Path, capsys: pytest.CaptureFixture[str]):
    drawn = DOCUMENT.replace("DURATION", '50 ms, initial: {"second.rate": {uniform: [0, 0.5]}}')
    Path("relaxing.yaml").write_text(drawn + "  scenarios: {own: {seeds: 1}}\n  confirm: {candidates: 2, seeds: 3}\n")
    assert call("optimize", "relaxing.yaml", "--workers", "1", "--write", "tuned.yaml") == 0
    said = capsys.readouterr().err
    assert re.search(r"^generation 2, 8 of 8, best ", said, re.M)
    assert re.search(r"^confirming, (\d+) of \1, best ", said, re.M)
    winner = re.search(
        r"^best: (evaluation \d+ \(confirms (evaluation \d+|the center of the search)\), score .*)$", said, re.M
    )
    assert winner is not None, said
    assert f"source: study relaxing, {winner[1]}" in Path("tuned.yaml").read_text()
    assert call("optimize", "relaxing.yaml", "--workers", "1", "--resume") == 0
    assert f"best: {winner[1]}" in capsys.readouterr().err
    assert call("study", "best", "results/relaxing/study.db") == 0
    assert capsys.readouterr().out.startswith(f"{winner[1]}\n")
    assert call("study", "show", "results/relaxing/study.db") == 0
    shown = capsys.readouterr().out
    assert re.search(r"^evaluations +8 *$", shown, re.M)
    assert re.search(r"^evaluation +confirms +score in the search +score +fell", shown, re.M)
    assert re.search(r"^\d+ +\d+ +-0\.\d+ +-0\.\d+ +0 of 3 runs", shown, re.M)
    assert call("study", "show", "results/relaxing/study.db", "--json") == 0
    found = json.loads(capsys.readouterr().out)
    assert found["best"] == found["confirmed"][0]["evaluation"]
    assert len(found["generations"]) == 2


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("optimize", "relaxing.yaml", "--storage", "postgresql://127.0.0.1:1/x"), "start the server"),
        (("optimize", "relaxing.yaml", "--dask", "tcp://127.0.0.1:1", "--workers", "2"), "--dask"),
        (("study", "show", "absent.db"), "there is no such file"),
        (("study", "best", "empty.db"), "holds no study"),
    ],
)
def test_what_cannot_be_done_is_said_in_a_sentence(
    here: Path, capsys: pytest.CaptureFixture[str], arguments: tuple[str, ...], said: str
):
    Database("empty.db")
    assert call(*arguments) == 2
    captured = capsys.readouterr()
    assert said in captured.err
    assert "Traceback" not in captured.err
    assert captured.out == ""


def test_ctrl_c_completes_what_is_under_way_and_says_how_to_go_on(here: Path):
    Path("relaxing.yaml").write_text(DOCUMENT.replace("DURATION", "40 s"))
    words = ["optimize", "relaxing.yaml", "--workers", "1", "--evaluations", "4000", "--storage", "a.db"]
    command = [sys.executable, "-m", "neuromech.cli", *words]
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as process:
        until = time.monotonic() + 300.0
        while process.poll() is None and stored() < 5:
            assert time.monotonic() < until
            time.sleep(0.1)
        process.send_signal(signal.SIGINT)
        said = process.communicate(timeout=300)[1]
    assert process.returncode == 3
    found = re.search(r"stopped after (\d+) of 4000 evaluations, all of them stored; to go on: (.*)$", said, re.M)
    assert found is not None, said
    assert int(found[1]) == stored()
    assert found[2] == f"neuromech {' '.join(words[:2])} --resume --evaluations 4000 --storage a.db --workers 1"
    assert "stopping when the evaluations under way are complete" in said


def stored() -> int:
    """Return how many evaluations are complete."""
    if not Path("a.db").exists():
        return 0
    try:
        with Database("a.db", create=False) as database:
            return len(database.open("relaxing").evaluations())
    except StudyError:
        return 0


STANDING = Standing(3, 52, 200, Score(1, 0.81234567), None, 2, 5, 3.25, 41.26, 133.2)


def test_a_line_of_progress_says_it_all():
    assert standing_text(STANDING, ("stand", "walk")) == (
        "generation 3, 52 of 200, best walk 0.81235, median none, 3.25/s, 41.3 × real time, 0:02:13 to go,"
        " 2 crashed, 5 fell"
    )
    assert score_text(Score(0, -1e-9), ()) == "-1e-09"


def test_without_a_terminal_there_is_a_line_for_each_generation(capsys: pytest.CaptureFixture[str]):
    def at(generation: int, done: int) -> Standing:
        return Standing(generation, done, 4, None, None, 0, 0, 1.0, 1.0, 1.0)

    with search_progress((), shown=True) as report:
        for generation, done in ((0, 1), (0, 2), (1, 2), (1, 3), (1, 4), (2, 4), (2, 5)):
            report(at(generation, done))
    lines = capsys.readouterr().err.splitlines()
    assert [line[:20] for line in lines] == ["generation 1, 2 of 4", "generation 2, 4 of 4", "generation 2, 5 of 4"]
