"""The benchmark harness without heavy peers: what it measures, in which order, and when it refuses to give a ratio."""

import json
import math
import sys
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest

from neuromech.bench.body_loop import SEED as BODY_SEED
from neuromech.bench.body_loop import TORQUES, Engine, Scene, applied_torques, body
from neuromech.bench.catalogue import BENCHMARKS, run, worst
from neuromech.bench.network import export, header, period
from neuromech.bench.network_speed import REFERENCE, SEED, against_script, compared, small_network
from neuromech.bench.pairing import Comparison, Result, failed, measure
from neuromech.bench.peers import Peer, PeerError
from neuromech.bench.workspace import Workspace
from neuromech.bodies.factory import open_body
from neuromech.cli.bench import as_markdown
from neuromech.cli.main import run_arguments
from neuromech.simulate.run import simulate
from neuromech.simulate.start import drawn_body

ROOT = Path(__file__).parents[2]
PEERS = Path(__file__).parent / "peers"
TABLE = {
    "pybullet_loop_over_bare_step",
    "mujoco_loop_over_bare_step",
    "human_loop_over_bare_step_pybullet",
    "human_loop_over_bare_step_mujoco",
    "human_real_time_factor_pybullet",
    "human_real_time_factor_mujoco",
    "network_over_c",
    "network_over_brian2_cpp",
    "network_over_brian2_cython",
    "network_over_sns_numpy",
    "network_over_pyrates",
    "two_threads_throughput",
    "record_all_over_none",
    "cost_per_neuron_7600_over_76",
    "run_to_first_step_seconds",
    "cold_compile_seconds",
}
FAKE = """
import json, math, sys
sys.path.insert(0, {folder!r})
from talk import network, own_stdout, serve
answers, net = own_stdout(), network()
print("chatter that must not reach the answers")
def run(count):
    interval = net["step"] * net["sampling_steps"]
    samples = -(-count // net["sampling_steps"])
    return 0.25, [-0.05 + 0.02 * math.sin(2 * math.pi * n * interval / {period}) for n in range(samples)]
serve(answers, "fake", "1", "none", run)
"""


@pytest.fixture
def workspace(tmp_path: Path) -> Workspace:
    return Workspace(ROOT / "specs", tmp_path, Path(sys.executable), tmp_path, steps=10_000, body_seconds=0.05)


def fake_peer(workspace: Workspace, period: float) -> str:
    (workspace.peers / "fake.py").write_text(FAKE.format(folder=str(PEERS), period=period), encoding="utf-8")
    return "fake.py"


def counted(calls: list[str], name: str, values: list[float]):
    def side() -> float:
        calls.append(name)
        return values[(len(calls) - 1) // 2 % len(values)]

    return side


def test_the_sides_are_measured_in_turn_after_one_unmeasured_pair():
    calls: list[str] = []
    result = measure(
        "x", Comparison(counted(calls, "A", [9.0, 1.0, 2.0]), counted(calls, "B", [9.0, 2.0, 8.0]), "s", ""), 2
    )
    assert calls == ["A", "B"] * 3
    assert (result.ours, result.peer) == ((1.0, 2.0), (2.0, 8.0))


def test_the_ratio_is_the_median_of_the_pairs_so_that_a_slow_moment_of_the_machine_cancels():
    result = Result("x", "s", "", (1.0, 10.0, 1.0), (2.0, 20.0, 2.0), {})
    assert result.as_dict()["ratio"] == 0.5
    assert result.as_dict()["ratio_range"] == [0.5, 0.5]


def test_what_has_no_peer_has_no_ratio():
    values = measure("x", Comparison(lambda: 3.0, None, "s", "", largest_repetitions=2), 5).as_dict()
    assert (values["ours"], values["peer"], values["ratio"], values["repetitions"]) == (3.0, None, None, 2)


def test_every_name_of_the_table_is_a_benchmark():
    assert BENCHMARKS.keys() >= TABLE


def test_of_two_scenes_the_worse_one_gives_the_name_and_a_failure_is_never_hidden():
    good, bad = (Result(name, "s", "", (ours,), (1.0,), {}) for name, ours in (("x_a", 1.1), ("x_b", 1.4)))
    assert worst("x", [good, bad]).as_dict()["ratio"] == 1.4
    assert worst("x", [good, failed("x_b", "no engine")]).problem == "no engine"


def test_a_peer_whose_period_is_ours_is_measured(workspace: Workspace):
    script = fake_peer(workspace, 0.4564)
    with against_script(workspace, script=script) as comparison:
        assert comparison.peer is not None
        assert comparison.peer() == 0.25 / workspace.steps
        assert math.isclose(comparison.notes["period_ours"], 0.4564, rel_tol=1e-3)


def test_a_peer_that_computes_something_else_is_reported_instead_of_a_ratio(workspace: Workspace):
    script = fake_peer(workspace, 0.47)
    opener = {"x": {"": lambda place: against_script(place, script=script)}}
    (result,) = run(["x"], workspace, 1, opener)
    assert result.as_dict()["ratio"] is None
    assert "0.47" in result.problem
    assert "2 %" in result.problem


def test_a_peer_without_rhythm_is_reported(workspace: Workspace):
    with (
        Peer([sys.executable, workspace.peers / fake_peer_of_silence(workspace)]) as peer,
        pytest.raises(PeerError) as error,
    ):
        compared(small_network(workspace), peer, workspace.steps, 0.02)
    assert "silent 1, none has no rhythm" in str(error.value)


def fake_peer_of_silence(workspace: Workspace) -> str:
    text = FAKE.format(folder=str(PEERS), period=1.0)
    text = text.replace("net = own_stdout(), network()", 'net = own_stdout(), {"step": 0.0005, "sampling_steps": 2}')
    text = text.replace("0.02 * math", "0.0 * math").replace('"fake"', '"silent"')
    (workspace.peers / "silent.py").write_text(text, encoding="utf-8")
    return "silent.py"


def test_a_missing_peer_is_reported_with_the_reason(workspace: Workspace):
    (workspace.peers / "broken.py").write_text("import a_package_that_nobody_has", encoding="utf-8")
    openers = {
        "script": {"": lambda place: against_script(place, script="absent.py")},
        "package": {"": lambda place: against_script(place, script="broken.py")},
    }
    absent, broken = run(["script", "package"], workspace, 1, openers)
    assert "absent.py is not there" in absent.problem
    assert "a_package_that_nobody_has" in broken.problem


def test_a_missing_environment_says_how_it_is_made(tmp_path: Path):
    place = Workspace(ROOT / "specs", PEERS, tmp_path / "python", tmp_path)
    (result,) = run(["network_over_sns_numpy"], place, 1)
    assert "make bench" in result.problem


def test_the_exported_network_is_the_compiled_one(workspace: Workspace):
    net = export(small_network(workspace), SEED, REFERENCE)
    assert len(net["neurons"]) == 76
    assert net["step"] == 0.0005
    drives = 4 * 2 + 1
    assert len(net["excitation"]["synapses"]) + len(net["inhibition"]["synapses"]) == 193 - drives
    rhythm = next(k for k, one in enumerate(net["neurons"]) if one["name"] == "LF.RG-E")
    assert math.isclose(net["excitation"]["constant"][rhythm], 2.05 * 0.083)
    assert net["neurons"][net["reference"]]["name"] == REFERENCE
    assert json.loads(json.dumps(net)) == json.loads(json.dumps(net, allow_nan=False))


def test_shared_parameters_are_one_number_in_the_header_and_others_an_array(workspace: Workspace):
    text = header(export(small_network(workspace), SEED, REFERENCE))
    assert "#define rybak_neuron_capacitance(i) (2e-11)" in text
    assert "#define rybak_neuron_activity_slope(i) rybak_neuron_activity_slope_values[i]" in text
    assert "#define NEURONS 76" in text


@pytest.mark.parametrize("scene", ["suspended", "human"])
@pytest.mark.parametrize("engine", ["pybullet", "mujoco"])
def test_bare_steps_with_the_torques_of_the_loop_move_the_body_as_the_loop_did(
    workspace: Workspace, scene: Scene, engine: Engine
):
    program = body(workspace, scene, engine, TORQUES[scene])
    torques = applied_torques(program, workspace.body_seconds)
    recording = simulate(program, seed=BODY_SEED, duration=workspace.body_seconds)
    model = drawn_body(program.graph, BODY_SEED)
    assert model is not None
    with open_body(model, program.tick) as opened:
        for torque in torques[:-1]:
            opened.step(torque)
        state = np.zeros(opened.layout.size)
        opened.read(state)
        wanted = [recording.signal(f"{joint}.angle")[1][-1] for joint in opened.joints]
    assert state[opened.layout.angles].tolist() == wanted


def test_the_period_of_a_sine_is_its_period():
    values = [math.sin(2 * math.pi * n * 1e-3 / 0.4) for n in range(8000)]
    assert math.isclose(period(values, 1e-3), 0.4, rel_tol=1e-6)


def test_the_command_writes_a_list_of_names_and_ratios(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
):
    @contextmanager
    def opener(_: Workspace):
        yield Comparison(lambda: 1e-6, lambda: 2e-6, "s/step", "a peer")

    monkeypatch.setitem(BENCHMARKS, "network_over_c", {"": opener})
    arguments = ["bench", "--json", "--only", "network_over_c", "--repetitions", "2", "--out", str(tmp_path)]
    with pytest.raises(SystemExit) as ended:
        run_arguments(arguments)
    assert ended.value.code == 0
    (found,) = json.loads(capsys.readouterr().out)
    assert {name: found[name] for name in ("name", "ours", "peer", "ratio", "unit")} == {
        "name": "network_over_c",
        "ours": 1e-6,
        "peer": 2e-6,
        "ratio": 0.5,
        "unit": "s/step",
    }
    (file,) = tmp_path.glob("*.json")
    raw = json.loads(file.read_text("utf-8"))
    assert raw["machine"]["cores"] >= 1
    assert raw["results"][0]["measurements_ours"] == [1e-6, 1e-6]


def test_an_unknown_benchmark_is_a_bad_argument(capsys: pytest.CaptureFixture[str]):
    with pytest.raises(SystemExit) as ended:
        run_arguments(["bench", "--only", "network_over_d"])
    assert ended.value.code == 2
    assert "did you mean 'network_over_c'?" in capsys.readouterr().err


def test_the_table_shows_ratios_first_and_failures_with_their_reason():
    found = [Result("x", "s/step", "C", (1e-6,), (4e-6,), {}), failed("y", "no engine")]
    described = {"processor": "p", "cores": 2, "load": [0.0], "python": "3", "versions": {}}
    rows = as_markdown(found, described).splitlines()
    assert "| `x` | 0.25 | 0.25 – 0.25 | 1 µs/step | 4 µs/step | C |" in rows
    assert "| `y` | not measured |  |  |  | no engine |" in rows
