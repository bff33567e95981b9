"""Pictures show the body where it was recorded, and films have the length and the size that were asked for."""

import json
from dataclasses import replace
from math import cos, pi, sin
from pathlib import Path

import numpy as np
import pytest

from neuromech.errors import RecordingError
from neuromech.graph.terrain import terrain
from neuromech.pipeline import build_graph, load_document, run
from neuromech.report.camera import followed
from neuromech.report.ground import LEVEL, RAISED, ground_pieces, square
from neuromech.report.layout import NotDrawableError
from neuromech.report.meshes import box, capsule, sheet
from neuromech.report.replay import Motion, Poses, recorded_body
from neuromech.report.scene import Picture, Scene
from neuromech.report.shot import shoot
from neuromech.report.solids import LEFT, LOADED, RIGHT, body_size, outline, segment_solids
from neuromech.report.stills import stills_figure
from neuromech.report.video import Film, load_av, write_video
from neuromech.spec.world import Ground, World

LEG = {
    "segments": {
        "thigh": {"mass": "0.2 kg", "inertia": ["1e-3 kg m^2"] * 3, "center_of_mass": ["0 m", "0 m", "-50 mm"]},
        "shank": {"mass": "0.1 kg", "inertia": ["1e-3 kg m^2"] * 3, "center_of_mass": ["0 m", "0 m", "-50 mm"]},
    },
    "contacts": {"foot": {"segment": "shank", "position": ["0 m", "0 m", "-100 mm"], "radius": "10 mm"}},
}


def hinges(side):
    hip = {"parent": "trunk", "child": "thigh", "position": ["20 mm", f"{side} mm", "0 m"], "axis": [0, 1, 0]}
    knee = {"parent": "thigh", "child": "shank", "position": ["0 m", "0 m", "-100 mm"], "axis": [0, 1, 0]}
    return {"hip": hip | {"initial_angle": "20 deg"}, "knee": knee | {"initial_angle": "-30 deg"}}


def document(root="free", record=("*.angle", "trunk.*", "*.foot.*")):
    """Return a two-legged body that falls onto the ground, turning."""
    trunk = {"mass": "1 kg", "inertia": ["2e-3 kg m^2"] * 3}
    trunk["shape"] = {"kind": "box", "size": ["100 mm", "60 mm", "50 mm"]}
    return {
        "neuromech": 1,
        "name": "faller",
        "parameters": {"height": {"value": "0.3 m"}},
        "body": {
            "root": {
                "kind": root,
                "position": ["0.1 m", "0 m", "${height}"],
                "orientation": ["0 deg", "10 deg", "0 deg"] if root == "planar" else ["20 deg", "10 deg", "5 deg"],
            },
            "segments": {"trunk": trunk},
        },
        "world": {"ground": {}},
        "instances": {name: {"body": LEG | {"joints": hinges(side)}} for name, side in (("L", 40), ("R", -40))},
        "protocol": {"duration": "0.4 s"},
        "record": {"all": {"signals": list(record), "every": "2 ms"}},
    }


@pytest.fixture(scope="module")
def recordings(tmp_path_factory):
    """Run documents of `document`, each once."""
    done = {}

    def make(**options):
        key = json.dumps(options, sort_keys=True)
        if key not in done:
            file = tmp_path_factory.mktemp("faller") / "faller.yaml"
            file.write_text(json.dumps(document(**options)))
            done[key] = run(file)
        return done[key]

    return make


@pytest.mark.parametrize("root", ["free", "fixed", "planar"])
def test_feet_are_replayed_where_the_engine_had_them(recordings, root):
    recording = recordings(root=root)
    motion = Motion(recorded_body(recording), recording)
    time = recording.signal("L.foot.x")[0]
    poses = motion.at(time)
    for row, contact in enumerate(motion.body.contacts):
        for axis, quantity in enumerate("xyz"):
            expected = recording.signal(f"{contact}.{quantity}")[1]
            assert poses.contact[:, row, axis] == pytest.approx(expected, abs=1e-6)


def test_between_samples_the_body_turns_evenly(recordings):
    recording = recordings()
    motion = Motion(recorded_body(recording), recording)
    before, middle, after = motion.at([0.1, 0.101, 0.102]).rotation[:, 0]
    assert np.trace(before.T @ middle) == pytest.approx(np.trace(middle.T @ after), abs=1e-9)
    assert middle @ middle.T == pytest.approx(np.eye(3), abs=1e-12)


def test_without_the_pose_of_a_free_root_it_says_what_to_record(recordings):
    recording = recordings(record=("*.angle", "trunk.z"))
    with pytest.raises(RecordingError) as raised:
        Motion(recorded_body(recording), recording)
    assert str(raised.value) == (
        "a picture of the body needs trunk.x, trunk.y, trunk.roll, trunk.pitch, trunk.yaw, not recorded. "
        "Hint: put 'pose: {signals: [\"*.angle\", \"trunk.*\"], every: 10 ms}' under 'record:' and run it again"
    )
    with pytest.raises(NotDrawableError):
        stills_figure(recording)


def test_a_network_has_no_body_to_show(record):
    with pytest.raises(RecordingError, match="has no body"):
        recorded_body(record({"A.activity": ("", np.zeros(10))}))


def test_a_fixed_root_needs_no_pose(recordings):
    recording = recordings(root="fixed", record=("*.angle",))
    poses = Motion(recorded_body(recording), recording).at([0.0, 0.2])
    assert np.array_equal(poses.position[0, 0], [0.1, 0.0, 0.3])
    assert np.array_equal(poses.rotation[0, 0], poses.rotation[1, 0])


def test_the_body_is_seen_where_its_pose_puts_it(recordings):
    """A body that is lower by a tenth of the picture's height is drawn lower by that many rows."""
    recording = recordings()
    motion = Motion(replace(recorded_body(recording), world=World()), recording)
    shot = shoot(motion, "side", np.linspace(0.0, 0.02, 3))
    camera = shot.cameras[0]
    height = 2.0 * camera.distance * np.tan(pi / 12)
    rows = []
    for shift in (0.0, 0.1 * height):
        down = np.array([0.0, 0.0, -shift])
        poses = replace(shot.poses, position=shot.poses.position + down, contact=shot.poses.contact + down)
        with Scene(replace(shot, poses=poses), Picture(200, 200)) as scene:
            seen = np.flatnonzero((scene.image(0) < 250).any(axis=(1, 2)))
        rows.append(seen[0])
    assert rows[1] - rows[0] == pytest.approx(20.0, abs=2.5)


def test_loaded_feet_are_yellow_and_sides_have_colours(recordings):
    recording = recordings()
    motion = Motion(recorded_body(recording), recording)
    shot = shoot(motion, "front", np.linspace(0.0, 0.4, 5))
    assert not shot.loaded[0].any()
    assert shot.loaded[1:].any()
    colors = {solid.segment: solid.color for solid in segment_solids(shot.body, shot.poses, shot.size)}
    names = list(shot.body.segments)
    assert colors[names.index("L.shank")] == LEFT
    assert colors[names.index("R.thigh")] == RIGHT
    number = int(np.flatnonzero(shot.loaded.any(axis=1))[0])
    with Scene(shot, Picture(200, 150)) as scene:
        lifted, loaded = (_yellow(scene.image(k)) for k in (0, number))
    assert lifted == 0
    assert loaded > 0


def _yellow(image):
    red, green, blue = (image[:, :, k].astype(float) for k in range(3))
    wanted = LOADED[2] / LOADED[0]
    return int(
        np.sum(
            (red > 120)
            & (np.abs(green / np.maximum(red, 1) - LOADED[1] / LOADED[0]) < 0.1)
            & (blue / np.maximum(red, 1) < wanted + 0.15)
        )
    )


def test_the_same_shot_gives_the_same_picture(recordings):
    recording = recordings()
    motion = Motion(recorded_body(recording), recording)
    images = []
    for _ in range(2):
        with Scene(shoot(motion, "follow", np.linspace(0.0, 0.2, 3)), Picture(160, 90, finer=2)) as scene:
            images.append(scene.image(1))
    assert images[0].shape == (90, 160, 3)
    assert np.array_equal(*images)


def test_a_strip_has_its_pictures_with_times(recordings):
    recording = recordings()
    figure = stills_figure(recording, window=(0.1, 0.35), number=4)
    titles = [axes.get_title(loc="left") for axes in figure.axes]
    assert titles == ["1   0.10 s", "2   0.18 s", "3   0.27 s", "4   0.35 s"]
    assert len({axes.images[0].get_array().tobytes() for axes in figure.axes}) == 4


def test_a_film_has_the_length_and_size_that_were_asked_for(recordings, tmp_path):
    recording = recordings()
    motion = Motion(recorded_body(recording), recording)
    film = Film(picture=Picture(160, 96), frames_per_second=25, slower=2.0, start=0.1, end=0.3)
    told = []
    write_video(motion, tmp_path / "film.mp4", film, lambda *numbers: told.append(numbers))
    with load_av().open(str(tmp_path / "film.mp4")) as container:
        (stream,) = container.streams.video
        frames = [frame.to_ndarray(format="rgb24") for frame in container.decode(stream)]
        assert (stream.width, stream.height, stream.average_rate) == (160, 96, 25)
    assert len(frames) == 10
    assert told == [(number, 10) for number in range(1, 11)]
    assert not np.array_equal(frames[0], frames[-1])


@pytest.mark.slow
def test_a_film_drawn_by_several_processes_is_in_order(recordings, tmp_path):
    recording = recordings()
    motion = Motion(recorded_body(recording), recording)
    film = Film(picture=Picture(160, 96), frames_per_second=100, end=0.4)
    write_video(motion, tmp_path / "film.mp4", film)
    with load_av().open(str(tmp_path / "film.mp4")) as container:
        frames = [frame.to_ndarray(format="rgb24") for frame in container.decode(video=0)]
    assert len(frames) == 40
    shot = shoot(motion, "side", film.times(motion.end))
    with Scene(shot, film.picture) as scene:
        for number in (0, 20, 39):
            own = scene.image(number).astype(float)[24:]
            differences = [np.abs(frame.astype(float)[24:] - own).mean() for frame in frames]
            assert abs(int(np.argmin(differences)) - number) <= 1


@pytest.mark.parametrize(
    "mesh", [capsule(np.zeros(3), np.array([0.0, 0.3, 0.4]), 0.1), box(np.array([1.0, 2.0, 3.0]), 0.7)]
)
def test_meshes_are_closed_and_face_outwards(mesh):
    a, b, c = (mesh.vertices[mesh.triangles[:, k]] for k in range(3))
    outward = np.cross(b - a, c - a)
    normals = sum(mesh.normals[mesh.triangles[:, k]] for k in range(3))
    area = np.linalg.norm(outward, axis=1) > 1e-12
    assert (np.sum(outward * normals, axis=1)[area] > 0.0).all()
    assert outward.sum(axis=0) == pytest.approx(np.zeros(3), abs=1e-9)


def test_volumes_of_meshes_are_those_of_the_solids():
    def volume(mesh):
        a, b, c = (mesh.vertices[mesh.triangles[:, k]] for k in range(3))
        return np.sum(a * np.cross(b, c)) / 6.0

    assert volume(box(np.array([1.0, 2.0, 3.0]), 10.0)) == pytest.approx(6.0)
    ideal = pi * 0.1**2 * 0.5 + 4.0 / 3.0 * pi * 0.1**3
    assert volume(capsule(np.zeros(3), np.array([0.0, 0.3, 0.4]), 0.1)) == pytest.approx(ideal, rel=0.03)


def test_squares_lie_in_the_world_whatever_the_sheet():
    one = sheet((-1.0, -1.0), (1.0, 1.0), 0.5)
    other = one.moved(np.eye(3), np.array([0.3, 0.0, 0.2]))
    assert other.texture(0.2) - one.texture(0.2) == pytest.approx(np.tile([1.5, 0.0], (len(one.vertices), 1)))


@pytest.mark.parametrize(("size", "side"), [(0.5, 0.1), (1.9, 0.5), (0.02, 0.005)])
def test_squares_have_round_sides(size, side):
    assert square(size) == pytest.approx(side)


def test_the_camera_follows_evenly_and_keeps_its_direction(recordings):
    recording = recordings()
    motion = Motion(recorded_body(recording), recording)
    poses = motion.at(np.linspace(0.0, 0.4, 21))
    cameras = followed(poses.time, outline(motion.body, poses), "side", body_size(motion.body, poses))
    offsets = np.array([camera.eye - camera.target for camera in cameras])
    assert np.allclose(offsets, offsets[0])
    assert offsets[0][1] < 0.0
    assert np.allclose(offsets[0] / cameras[0].distance, [0.0, -cos(pi / 20), sin(pi / 20)])


def near(poses, **ground):
    return ground_pieces(Ground.model_validate(ground), poses, 0.2)


def test_the_ground_reaches_beyond_the_way(recordings):
    recording = recordings()
    poses = Motion(recorded_body(recording), recording).at([0.0, 0.2])
    (level,) = near(poses, height="0.1 m")
    assert level.mesh.vertices[:, 0].max() > poses.position[:, 0, 0].max() + 1.0
    assert np.all(level.mesh.vertices[:, 2] == 0.1)
    assert ground_pieces(None, poses, 0.2) == []


def test_slopes_and_steps_are_drawn_where_the_engines_have_them(recordings):
    recording = recordings()
    poses = Motion(recorded_body(recording), recording).at([0.0, 0.2])
    slope = {"start": "0.5 m", "length": "0.5 m", "angle": "10 deg"}
    step = {"start": "-0.5 m", "length": "0.3 m", "middle": "0.2 m", "width": "0.2 m", "height": "30 mm"}
    far = step | {"start": "-50 m"}
    ground = {"slopes": [slope], "steps": {"near": step, "far": far}}
    pieces = near(poses, **ground)
    assert [piece.color for piece in pieces] == [LEVEL, RAISED, LEVEL, RAISED]
    exact = terrain(Ground.model_validate(ground))
    tops = [piece.mesh.vertices[piece.mesh.normals[:, 2] > 0.9] for piece in pieces]
    for x, y, z in np.concatenate(tops[:3]):
        if abs(y - 0.2) > 0.15:
            assert z == pytest.approx(exact.height(x, y), abs=1e-9)
    low, high = tops[3].min(axis=0), tops[3].max(axis=0)
    assert (low, high) == (pytest.approx([-0.5, 0.1, 0.03]), pytest.approx([-0.2, 0.3, 0.03]))
    assert exact.height(-0.35, 0.2) == pytest.approx(0.03)


@pytest.fixture(scope="module")
def human():
    """The planar human, all of its segments' frames in one place."""
    body = build_graph(load_document(Path(__file__).parents[3] / "specs" / "human" / "body.yaml")).body
    count = len(body.segments)
    return body, Poses(np.zeros(1), np.zeros((1, count, 3)), np.tile(np.eye(3), (1, count, 1, 1)), np.zeros((1, 0, 3)))


def test_legs_in_the_middle_have_the_colours_of_their_names(human):
    body, poses = human
    colors = {solid.segment: solid.color for solid in segment_solids(body, poses, 1.0)}
    names = list(body.segments)
    assert [colors[names.index(name)] for name in ("left.foot", "right.foot")] == [LEFT, RIGHT]
    assert colors[names.index("trunk")] not in (LEFT, RIGHT)


def test_the_camera_looks_at_the_middle_of_all_that_is_seen(human):
    """The head of a walker is far above its highest joint."""
    body, poses = human
    points = outline(body, poses)
    assert points[0, :, 2].max() == pytest.approx(0.8)
    (camera,) = followed(poses.time, points, "side", 1.0)
    assert camera.target[2] == pytest.approx(0.5 * (0.8 - 0.5))
