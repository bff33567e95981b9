"""Commands that draw refuse what cannot be drawn in one line, and leave no half of a file behind."""

import json
import sys
from pathlib import Path

import numpy as np
import pytest

from neuromech.cli.main import run_arguments
from neuromech.simulate.anatomy import NO_BODY
from neuromech.simulate.recording import GroupData, Outcome, Provenance, Recording
from neuromech.simulate.storage import save

BODY = """
body:
  root: {kind: fixed, position: [0 m, 0 m, 0.3 m]}
  segments:
    base: {mass: 1 kg, inertia: [1e-3 kg m^2, 1e-3 kg m^2, 1e-3 kg m^2]}
    rod: {mass: 1 kg, inertia: [1e-3 kg m^2, 1e-3 kg m^2, 1e-3 kg m^2], center_of_mass: [0 m, 0 m, -0.1 m]}
  joints:
    hinge: {parent: base, child: rod, position: [0 m, 0 m, 0 m], axis: [0, 1, 0]}
"""


def write(specification, signal="hinge.angle"):
    time = np.arange(0.0, 1.0, 0.01)
    data = GroupData(time, (signal,), np.sin(time)[:, None], ("rad",))
    outcome = Outcome("finished", 1.0)
    source = Provenance("rod", specification, "0", {}, "hinge", "any", 0, {}, outcome, 1.0, 1.0, NO_BODY)
    save(Recording.from_groups({"all": data}, source), Path("rod.nc"))


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write(BODY)
    return tmp_path


def call(*arguments):
    with pytest.raises(SystemExit) as ended:
        run_arguments([str(argument) for argument in arguments])
    return ended.value.code


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["video", "rod.nc", "--out", "rod.avi"], "--out  must end in .mp4 (got 'rod.avi')."),
        (["video", "rod.nc", "--out", "a.mp4", "--size", "99x100"], "--size  must be two even numbers of pixels"),
        (["video", "rod.nc", "--out", "a.mp4", "--from", "5"], "--from"),
        (["video", "rod.nc", "--out", "a.mp4", "--from", "0.8 s", "--to", "0.2 s"], "leaves nothing of a run"),
        (["video", "rod.nc", "--out", "a.mp4", "--from", "3 s"], "leaves nothing of a run"),
        (["stills", "rod.nc", "--out", "rod.jpg"], "must end in .png or .svg"),
        (["stills", "none.nc", "--out", "rod.png"], "none.nc does not exist"),
        (["figures", "rod.nc", "--out", "figures", "--after", "soon"], "--after"),
    ],
)
def test_bad_arguments_are_named_in_one_line(here, capsys, arguments, message):
    assert call(*arguments) == 2
    said = capsys.readouterr().err
    assert message in said
    assert len(said.splitlines()) == 1
    assert [path.name for path in here.iterdir()] == ["rod.nc"]


def test_stills_and_films_of_a_recording(here):
    assert call("stills", "rod.nc", "--out", "strip.png", "--number", "2", "--from", "0 s", "--to", "0.5 s") == 0
    assert call("video", "rod.nc", "--out", "film.mp4", "--size", "64x48", "--to", "0.2 s") == 0
    assert sorted(path.name for path in here.iterdir()) == ["film.mp4", "rod.nc", "strip.png"]
    assert Path("strip.png").read_bytes().startswith(b"\x89PNG")
    assert Path("film.mp4").read_bytes()[4:8] == b"ftyp"


def test_a_missing_package_is_one_line(here, capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, "av", None)
    assert call("video", "rod.nc", "--out", "film.mp4") == 2
    assert capsys.readouterr().err == "av is not installed. Hint: pip install 'neuromech[video]'\n"


def test_a_body_in_a_file_of_its_own_cannot_be_drawn_from_the_recording(here, capsys):
    write("body: {file: robot.urdf}")
    assert call("stills", "rod.nc", "--out", "strip.png") == 2
    assert "the body in the recording cannot be used: body.file" in capsys.readouterr().err


def test_figures_are_drawn_again(here, capsys):
    assert call("figures", "rod.nc", "--out", "again", "--format", "svg") == 0
    assert Path("again/joint_angles.svg").read_text("utf-8").startswith("<?xml")
    assert "not drawn: activity (no activity is recorded)" in capsys.readouterr().err


def test_a_film_is_refused_before_the_run_where_nothing_will_be_seen(here, capsys):
    head = {"neuromech": 1, "name": "none", "protocol": {"duration": "1 s"}}
    head["network"] = {"neurons": {"cell": {"kind": "rate_neuron", "time_constant": "10 ms"}}}
    Path("none.yaml").write_text(json.dumps(head), encoding="utf-8")
    assert call("run", "none.yaml", "--video") == 2
    assert "--video  needs a body, and the document has none" in capsys.readouterr().err
    rod = f"neuromech: 1\nname: rod\n{BODY}\nprotocol: {{duration: 1 s}}\n"
    Path("rod.yaml").write_text(rod, encoding="utf-8")
    assert call("run", "rod.yaml", "--video") == 2
    assert "a picture of the body needs hinge.angle, not recorded" in capsys.readouterr().err
    assert not Path("results").exists()
