"""`kill -9` at random moments: the resumed study is the uninterrupted one, evaluation by evaluation."""

import random
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest
from searches import contents

from neuromech.errors import StudyError
from neuromech.study.database import Database

HALF_CENTRE = Path(__file__).parents[3] / "specs" / "examples" / "half_centre.yaml"
DOCUMENT = f"""
neuromech: 1
name: tuned
extends: {HALF_CENTRE}
study:
  tune: {{drive: {{}}}}
  algorithm: {{kind: pso, population: 8}}
  evaluations: EVALUATIONS
  duration: 3 s
  scenarios: {{plain: {{seeds: 1}}}}
  objective:
    terms:
      period:
        measure: {{kind: period, signal: flexor.burster.activity, after: 1 s}}
        target: 0.45 s
        scale: 0.05 s
"""
KILLS = 10


def command(folder: Path, storage: str, *options: str) -> "subprocess.Popen[bytes]":
    words = ["optimize", "tuned.yaml", "--resume", "--storage", storage, "--workers", "2", "--quiet", *options]
    return subprocess.Popen([sys.executable, "-m", "neuromech.cli", *words], cwd=folder)


def finish(folder: Path, storage: str) -> None:
    """Go on to the end."""
    with command(folder, storage) as process:
        assert process.wait(600) == 0


def opened(folder: Path, storage: str) -> Database:
    return Database(storage if "://" in storage else str(folder / storage), create=False)


def stored(folder: Path, storage: str) -> dict[int, dict[str, Any]]:
    """Return what is stored, with the time that each evaluation took, which a second one would not repeat."""
    try:
        with opened(folder, storage) as database:
            return {one.number: one.to_dict() for one in database.open("tuned").evaluations()}
    except StudyError:
        return {}


def killed_at(folder: Path, storage: str, evaluations: int, delay: float) -> None:
    """Kill a study a while (s) after it has stored so many evaluations."""
    with command(folder, storage) as process:
        until = time.monotonic() + 300.0
        while process.poll() is None and len(stored(folder, storage)) < evaluations:
            assert time.monotonic() < until, "nothing is stored"
            time.sleep(0.1)
        time.sleep(delay)
        process.send_signal(signal.SIGKILL)


def killed_and_resumed(folder: Path, storage: str, evaluations: int, kills: int) -> None:
    """Kill a study again and again, and compare what is left in the end with a study that was left alone."""
    (folder / "tuned.yaml").write_text(DOCUMENT.replace("EVALUATIONS", str(evaluations)))
    finish(folder, "alone.db")
    moments = random.Random(20)
    kept: dict[int, dict[str, Any]] = {}
    for target in sorted(moments.randrange(evaluations) for _ in range(kills)):
        killed_at(folder, storage, target, moments.uniform(0.0, 0.5))
        now = stored(folder, storage)
        assert now == now | kept, "what was stored is lost or has changed"
        kept = now
    finish(folder, storage)
    assert kept
    assert stored(folder, storage) == stored(folder, storage) | kept
    with opened(folder, "alone.db") as one, opened(folder, storage) as other:
        alone, resumed = one.open("tuned"), other.open("tuned")
        assert contents(resumed) == contents(alone)
        assert len(contents(alone)) == evaluations
        assert resumed.boundary() == alone.boundary()


def test_a_study_in_a_file_survives_being_killed(tmp_path: Path):
    killed_and_resumed(tmp_path, "study.db", evaluations=20, kills=1)


@pytest.mark.slow
def test_a_study_in_a_file_survives_being_killed_ten_times(tmp_path: Path):
    killed_and_resumed(tmp_path, "study.db", evaluations=150, kills=KILLS)


def test_a_study_on_a_server_survives_being_killed(server: str, tmp_path: Path):
    killed_and_resumed(tmp_path, server, evaluations=20, kills=1)


@pytest.mark.slow
def test_a_study_on_a_server_survives_being_killed_ten_times(server: str, tmp_path: Path):
    killed_and_resumed(tmp_path, server, evaluations=150, kills=KILLS)
