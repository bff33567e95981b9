"""How runs end, and that the same run is the same run."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from relays import relays

from neuromech.compiler.lower import lower
from neuromech.pipeline import build_graph, load_document, run
from neuromech.simulate.run import simulate

CAT = Path(__file__).parents[3] / "specs" / "cat"


def bits(recording):
    return {name: recording.signal(name)[1].tobytes() for name in recording.names}


def test_a_run_that_comes_to_its_end_is_finished(document):
    recording = run(document(relays()))
    assert (recording.outcome.kind, recording.outcome.message) == ("finished", "")
    assert recording.outcome.time == pytest.approx(0.06)


def test_divergence_names_the_state_and_the_time():
    """The time constant that the thesis prints for the rhythm generators, 0.3 ms, is too stiff for RK4 at 0.5 ms."""
    recording = run(CAT / "leg_cpg.yaml", ["parameters.rhythm_time_constant.value=0.3 ms"], seed=2, duration=5.0)
    outcome = recording.outcome
    assert outcome.kind == "diverged"
    assert outcome.message == "state LF.RG-E.inactivation is not a finite number any more"
    assert 0.0 < outcome.time < 5.0
    length = len(recording.signal("LF.RG-F.activity")[0])
    assert length == pytest.approx(outcome.time / 1e-3, abs=1)
    assert all(np.isfinite(recording.signal(name)[1][:-1]).all() for name in recording.names)


def test_ctrl_c_keeps_what_was_recorded(document):
    def interrupt(now):
        if now > 0.01:
            raise KeyboardInterrupt

    whole, part = run(document(relays())), run(document(relays()), progress=interrupt)
    assert part.outcome.kind == "stopped"
    assert 0.01 < part.outcome.time < 0.06
    time_, values = part.signal("sender.rate")
    assert len(time_) == round(part.outcome.time / 0.5e-3)
    assert values.tobytes() == whole.signal("sender.rate")[1][: len(time_)].tobytes()


def test_progress_comes_in_order_and_ends_at_the_end(document):
    told = []
    run(document(relays()), progress=told.append)
    assert told == sorted(told)
    assert told[-1] == pytest.approx(0.06)


def block(**fall):
    return {
        "body": {
            "root": {"kind": "free", "position": ["0 m", "0 m", "1 m"], "orientation": ["0 deg", "30 deg", "0 deg"]},
            "segments": {"block": {"mass": "1 kg", "inertia": ["2 g m^2", "2 g m^2", "2 g m^2"]}},
        },
        "protocol": {"duration": "0.5 s", "fall": fall},
        "record": {"all": {"signals": ["block.*"], "every": "1 ms"}},
    }


def test_a_falling_body_without_joints_fell_when_it_was_too_low(document):
    outcome = run(document(block(height="0.5 m"))).outcome
    assert outcome.kind == "fell"
    assert outcome.time == pytest.approx(np.sqrt(2 * 0.5 / 9.81), abs=2e-3)
    assert outcome.message.startswith("the root is 0.")
    assert outcome.message.endswith("m high, below 0.5 m")


@pytest.mark.parametrize(("tilt", "kind"), [("29 deg", "fell"), ("31 deg", "finished")])
def test_a_tilted_body_fell_from_the_limit_on(document, tilt, kind):
    assert run(document(block(tilt=tilt))).outcome.kind == kind


def test_the_same_seed_gives_the_same_bits_and_another_seed_others():
    first, second, other = (run(CAT / "leg_cpg.yaml", seed=seed, duration=0.2) for seed in (4, 4, 5))
    assert bits(first) == bits(second)
    assert all(bits(first)[name] != bits(other)[name] for name in ("LF.RG-F.activity", "LF.InRG-F.activity"))


def test_a_body_repeats_a_run_bit_for_bit():
    first, second = (run(CAT / "suspended.yaml", ["claims=null"], duration=0.1) for _ in range(2))
    assert bits(first) == bits(second)


def test_the_length_of_a_piece_of_the_loop_changes_nothing(document):
    program = lower(build_graph(load_document(document(relays()))))
    whole = simulate(program)
    memory = program.memory()
    program.module.begin(*memory.buffers)
    samples = np.full(120 * len(whole.names), np.nan)
    reached = 0
    for last in (1, 2, 7, 50, 120):
        reached, bad = program.module.run(reached, last, program.tick, *memory.buffers, samples)
        assert (reached, bad) == (last, -1)
    columns = samples.reshape(120, -1)
    assert sorted(column.tobytes() for column in columns.T) == sorted(bits(whole).values())


def test_signals_recorded_at_two_rates_have_the_same_samples(document):
    fine, coarse = relays(), relays()
    coarse["record"] = {"all": {"signals": ["*"], "every": "2.5 ms"}}
    fine, coarse = run(document(fine)), run(document(coarse))
    for name in fine.names:
        (time_fine, values_fine), (time_coarse, values_coarse) = fine.signal(name), coarse.signal(name)
        assert time_coarse == pytest.approx(time_fine[::5])
        assert values_coarse.tobytes() == values_fine[::5].tobytes()


def test_a_killed_run_leaves_no_results_file(tmp_path):
    """Killed while it runs, and while it compiles or starts if that takes longer."""
    command = [sys.executable, "-m", "neuromech.cli", "run", str(CAT / "leg_cpg.yaml"), "--out", str(tmp_path / "out")]
    process = subprocess.Popen(
        [*command, "--duration", "100000 s"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    )
    try:
        deadline = time.monotonic() + 30.0
        while not (tmp_path / "out").exists() and time.monotonic() < deadline:
            time.sleep(0.05)
        time.sleep(0.5)
        assert process.poll() is None
        os.kill(process.pid, signal.SIGKILL)
    finally:
        process.kill()
        assert process.wait() == -signal.SIGKILL
    assert (tmp_path / "out").is_dir()
    assert list((tmp_path / "out").rglob("*")) == []
