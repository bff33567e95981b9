"""The command line: what goes to which stream, exit codes, and that bad input ends in a sentence."""

import json
import os
import signal
import subprocess
import sys
import time
from functools import partial
from pathlib import Path

import pytest

from neuromech.cli.main import run_arguments
from neuromech.cli.terminal import report_bug

HALF_CENTRE = Path(__file__).parents[3] / "specs" / "examples" / "half_centre.yaml"

ONE_NEURON = """
neuromech: 1
name: one
network:
  neurons:
    cell: {kind: rate_neuron, time_constant: 10 ms, bias: 1}
protocol: {duration: 50 ms}
record:
  all: {signals: ["*.activity"], every: 1 ms}
claims:
  excited:
    claim: the cell becomes active
    measure: {kind: final, signal: cell.activity}
    expected: {at_least: 0.5}
    source: its bias is above half activity
"""


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    Path("one.yaml").write_text(ONE_NEURON)
    return tmp_path


def call(*arguments: str) -> int:
    with pytest.raises(SystemExit) as ended:
        run_arguments(arguments)
    return int(ended.value.code or 0)


def command(*arguments: str) -> list[str]:
    return [sys.executable, "-m", "neuromech.cli", *arguments]


def test_run_writes_one_json_object_to_stdout_and_company_to_stderr(here: Path, capsys: pytest.CaptureFixture[str]):
    assert call("run", "one.yaml", "--json", "--no-figures") == 0
    captured = capsys.readouterr()
    found = json.loads(captured.out)
    assert found["outcome"]["kind"] == "finished"
    assert found["simulated_seconds"] == pytest.approx(0.05)
    assert found["real_time_factor"] == pytest.approx(found["simulated_seconds"] / found["wall_seconds"])
    assert [claim["verdict"] for claim in found["claims"]] == ["met"]
    assert [Path(file).is_file() for file in found["files"]] == [True]
    assert "wrote results/one/recording.nc" in captured.err


def test_quiet_run_says_nothing(here: Path, capsys: pytest.CaptureFixture[str]):
    assert call("run", "one.yaml", "--quiet", "--no-figures") == 0
    assert capsys.readouterr() == ("", "")


def test_run_draws_figures_unless_told_not_to(here: Path):
    assert call("run", "one.yaml", "--quiet", "--out", "with") == 0
    assert call("run", "one.yaml", "--quiet", "--out", "without", "--no-figures") == 0
    assert list(Path("with/figures").iterdir())
    assert [path.name for path in Path("without").iterdir()] == ["recording.nc"]


def test_claim_that_is_not_met_ends_with_4(here: Path):
    assert call("run", "one.yaml", "--quiet", "--no-figures", "--set", "network.neurons.cell.bias=0") == 4
    assert call("verify", "one.yaml") == 0


def test_shortened_run_judges_no_claim(here: Path, capsys: pytest.CaptureFixture[str]):
    assert call("run", "one.yaml", "--json", "--quiet", "--no-figures", "--duration", "2 ms") == 0
    assert json.loads(capsys.readouterr().out)["claims"] == []


def test_divergence_ends_with_3_and_its_reason(here: Path, capsys: pytest.CaptureFixture[str]):
    code = call("run", "one.yaml", "--no-figures", "--set", "network.neurons.cell.time_constant=1e-320 s")
    assert code == 3
    assert "diverged at" in capsys.readouterr().err


@pytest.mark.parametrize("duration", ["5", "5 kg", "-1 s", "0 s", "inf s", "soon"])
def test_bad_duration_is_refused_before_anything_runs(duration: str, here: Path, capsys: pytest.CaptureFixture[str]):
    assert call("run", "one.yaml", "--duration", duration) == 2
    assert "--duration" in capsys.readouterr().err
    assert not Path("results").exists()


@pytest.mark.parametrize("name", ["nothing.yaml", "."])
@pytest.mark.parametrize("verb", ["run", "graph", "compile"])
def test_what_is_no_file_ends_in_a_sentence(verb: str, name: str, here: Path, capsys: pytest.CaptureFixture[str]):
    assert call(verb, name) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1


def test_output_folder_that_cannot_be_made_is_reported_before_the_run(here: Path, capsys: pytest.CaptureFixture[str]):
    assert call("run", "one.yaml", "--out", "one.yaml/results") == 2
    error = capsys.readouterr().err
    assert error.startswith("one.yaml/results: Not a directory. Hint:")


def test_name_of_a_document_cannot_lead_out_of_the_results_folder(here: Path):
    Path("one.yaml").write_text(ONE_NEURON.replace("name: one", "name: ../../my cell."))
    assert call("run", "one.yaml", "--quiet", "--no-figures") == 0
    assert [path.name for path in Path("results").iterdir()] == ["_my_cell_"]


def test_validate_reports_all_files_and_counts(here: Path, capsys: pytest.CaptureFixture[str]):
    Path("sub").mkdir()
    Path("sub/two.yaml").write_text(ONE_NEURON.replace("rate_neuron", "rate_neurn"))
    Path("three.yaml").write_text(ONE_NEURON.replace("10 ms", "10 mV").replace("50 ms", "50"))
    assert call("validate", ".") == 2
    captured = capsys.readouterr()
    assert [line.partition(":")[0] for line in captured.out.splitlines()] == ["sub/two.yaml", *2 * ["three.yaml"]]
    assert "3 documents: 3 problems" in captured.err


def test_validate_of_good_documents_is_silent_on_stdout(here: Path, capsys: pytest.CaptureFixture[str]):
    assert call("validate", "one.yaml", "one.yaml") == 0
    assert capsys.readouterr() == ("", "1 document: valid\n")


def test_validate_in_json_is_an_empty_list_for_good_documents(here: Path, capsys: pytest.CaptureFixture[str]):
    assert call("validate", "one.yaml", "--format", "json") == 0
    assert json.loads(capsys.readouterr().out) == []


def test_validate_refuses_what_is_not_there_and_empty_folders(here: Path, capsys: pytest.CaptureFixture[str]):
    Path("empty").mkdir()
    assert call("validate", "nothing", "empty") == 2
    assert len(capsys.readouterr().err.splitlines()) == 2


def test_verify_prints_the_list_that_was_promised(here: Path, capsys: pytest.CaptureFixture[str]):
    assert call("verify", "one.yaml", "--json", "--seeds", "3") == 0
    (found,) = json.loads(capsys.readouterr().out)
    assert list(found) == ["spec", "id", "claim", "source", "published", "expected", "measured", "verdict"]
    assert list(found["measured"]) == ["median", "min", "max", "n"]
    assert found["measured"]["n"] == 3


def test_verify_runs_nothing_when_a_document_is_bad(here: Path, capsys: pytest.CaptureFixture[str]):
    Path("two.yaml").write_text(ONE_NEURON.replace("rate_neuron", "rate_neurn"))
    assert call("verify", ".") == 2
    assert "did you mean 'rate_neuron'" in capsys.readouterr().err


def test_new_extends_a_shipped_document_and_is_valid(here: Path, capsys: pytest.CaptureFixture[str]):
    assert call("new", "mine", "--from", "examples/half_centre") == 0
    assert call("validate", "mine.yaml") == 0
    assert "#   drive:\n#     value: 0.05" in Path("mine.yaml").read_text()


def test_knobs_of_a_new_document_work_when_uncommented(here: Path):
    assert call("new", "mine", "--from", "examples/half_centre") == 0
    text = Path("mine.yaml").read_text().replace("# parameters", "parameters").replace("#   ", "  ")
    Path("mine.yaml").write_text(text.replace("0.05", "0.06"))
    assert call("validate", "mine.yaml") == 0


def test_new_never_overwrites(here: Path, capsys: pytest.CaptureFixture[str]):
    before = Path("one.yaml").read_text()
    assert call("new", "one", "--from", "examples/half_centre") == 2
    assert Path("one.yaml").read_text() == before


@pytest.mark.parametrize("name", ["../up", "a b", ""])
def test_new_refuses_names_that_are_none(name: str, here: Path, capsys: pytest.CaptureFixture[str]):
    assert call("new", name, "--from", "examples/half_centre") == 2


def test_graph_writes_both_forms_and_refuses_others(here: Path, capsys: pytest.CaptureFixture[str]):
    assert call("graph", "one.yaml", "--out", "a/one.svg") == 0
    assert call("graph", "one.yaml", "--out", "one.graphml") == 0
    assert call("graph", "one.yaml", "--out", "one.png") == 2
    assert Path("a/one.svg").read_text().startswith("<?xml")
    assert sorted(path.name for path in here.iterdir()) == ["a", "one.graphml", "one.yaml"]


def test_explain_names_the_file_and_line(here: Path, capsys: pytest.CaptureFixture[str]):
    assert call("explain", "one.yaml", "network.neurons.cell.bias") == 0
    assert "one.yaml:6:" in capsys.readouterr().out


def test_schema_and_compile_write_to_stdout(here: Path, capsys: pytest.CaptureFixture[str]):
    assert call("schema") == 0
    assert json.loads(capsys.readouterr().out)["$schema"].endswith("2020-12/schema")
    assert call("compile", "one.yaml") == 0
    compile(capsys.readouterr().out, "generated", "exec")


def test_components_shows_units_bounds_and_ports(capsys: pytest.CaptureFixture[str]):
    assert call("components", "leg_load_sensor") == 0
    found = capsys.readouterr().out
    assert "contact_force [N]" in found
    assert any(line.split() == ["time_constant", "ms", "5", "ms", ">", "0", "ms"] for line in found.splitlines())


def test_unknown_component_gets_a_suggestion(capsys: pytest.CaptureFixture[str]):
    assert call("components", "rybak_neurn") == 2
    assert "did you mean 'rybak_neuron'" in capsys.readouterr().err


@pytest.mark.parametrize("arguments", [("run",), ("fly",), ("validate", "one.yaml", "--format", "xml")])
def test_wrong_usage_ends_with_2(arguments: tuple[str, ...], here: Path, capsys: pytest.CaptureFixture[str]):
    assert call(*arguments) == 2
    assert "Traceback" not in capsys.readouterr().err


def test_closed_pipe_is_no_error(here: Path):
    with subprocess.Popen(command("schema"), stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        assert process.stdout is not None
        assert process.stderr is not None
        process.stdout.close()
        assert process.stderr.read() == b""
    assert process.returncode == 0


def test_stdout_holds_nothing_but_the_result(here: Path):
    done = subprocess.run(
        command("run", "one.yaml", "--json", "--no-figures"), capture_output=True, text=True, check=True
    )
    assert json.loads(done.stdout)["outcome"]["kind"] == "finished"


def test_interrupted_run_ends_with_3_and_keeps_what_was_recorded(here: Path):
    long = ONE_NEURON.replace("50 ms", "100000 s").replace("every: 1 ms", "every: 1 s")
    Path("long.yaml").write_text(long)
    # A shell that runs the tests in the background makes its children ignore SIGINT.
    interruptible = partial(signal.signal, signal.SIGINT, signal.default_int_handler)
    arguments = command("run", "long.yaml", "--json", "--no-figures")
    with subprocess.Popen(arguments, stdout=subprocess.PIPE, preexec_fn=interruptible) as process:
        while not Path("results/one").exists():
            time.sleep(0.05)
        time.sleep(4.0)
        process.send_signal(signal.SIGINT)
        output = process.communicate(timeout=60)[0]
    assert process.returncode == 3
    assert json.loads(output)["outcome"]["kind"] == "stopped"
    assert [path.name for path in Path("results/one").iterdir()] == ["recording.nc"]


def test_killed_run_leaves_no_results_file(here: Path):
    Path("long.yaml").write_text(ONE_NEURON.replace("50 ms", "100000 s").replace("every: 1 ms", "every: 1 s"))
    with subprocess.Popen(command("run", "long.yaml", "--no-figures", "--quiet")) as process:
        while not Path("results/one").exists():
            time.sleep(0.05)
        process.kill()
    assert not Path("results/one/recording.nc").exists()


def test_bug_is_one_line_that_says_how_to_see_more(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch):
    monkeypatch.delenv("NEUROMECH_TRACEBACK", raising=False)
    report_bug(ZeroDivisionError, ZeroDivisionError("oops\nmore"), None)
    line = "this is a bug in neuromech: ZeroDivisionError: oops. Hint: NEUROMECH_TRACEBACK=1 shows where\n"
    assert capsys.readouterr().err == line


def test_bug_shows_its_traceback_on_demand(here: Path):
    environment = {**os.environ, "NEUROMECH_TRACEBACK": "1"}
    code = "from neuromech.cli import main; import sys; sys.excepthook = main.report_bug; 1 / 0"
    done = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert "Traceback" in done.stderr
