"""The motion of a body as it was recorded: joint angles and root pose, and the poses of all segments that follow."""

import json
import tempfile
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from ruamel.yaml import YAML
from scipy.spatial.transform import Rotation, Slerp

from neuromech.analyse.windows import Array
from neuromech.bodies.base import root_quaternion
from neuromech.compiler.kinematics import contact_positions, forward_kinematics
from neuromech.compiler.tree import lower_tree
from neuromech.components.catalogue import BUILT_IN, Catalogue
from neuromech.errors import DocumentError, RecordingError
from neuromech.graph.build import build
from neuromech.graph.model import BodyModel
from neuromech.simulate.recording import Recording
from neuromech.spec.load import load

NO_BODY = "the document has no body"
PLACE = ("x", "y", "z")
TURN = ("yaw", "pitch", "roll")
_MOVING = {"fixed": (), "planar": ("x", "z", *reversed(TURN)), "free": (*PLACE, *reversed(TURN))}
"""What of the root's pose changes, by the kind of root; beyond a pitch of 90 deg roll and yaw of a planar root too."""


@dataclass(frozen=True, slots=True)
class Poses:
    """Where a body is at n times, in world axes.

    Args:
        time: (n,) in s.
        position: (n, segments, 3) of the segments' frames in m, segments in the order of `BodyModel.segments`.
        rotation: (n, segments, 3, 3), its columns are the axes of a segment in the world.
        contact: (n, contacts, 3) centres of the contact spheres in m.
    """

    time: Array
    position: Array
    rotation: Array
    contact: Array

    def __len__(self) -> int:
        return len(self.time)


@dataclass(frozen=True, slots=True)
class Motion:
    """What was recorded of a body's motion, ready to be asked for any time of the run.

    Args:
        body: the body that moved.
        recording: of its joint angles and, unless it is fixed, of the pose of its root.
    """

    body: BodyModel
    recording: Recording

    def __post_init__(self) -> None:
        """Refuse a recording that lacks a joint or the root.

        Raises:
            RecordingError: names what is missing, and what the document must record.
        """
        check_recorded(self.body, self.recording.names)

    @property
    def end(self) -> float:
        """Time (s) of the last sample that all signals have."""
        names = needed(self.body)
        return min((float(self.recording.signal(name)[0][-1]) for name in names), default=self.recording.outcome.time)

    def at(self, times: Sequence[float] | Array) -> Poses:
        """Return the poses at some times (s), interpolated between samples; orientations along the shortest turn."""
        time = np.asarray(times, dtype=np.float64)
        angles = np.column_stack([np.empty((len(time), 0)), *(self._values(name, time) for name in _angles(self.body))])
        return _poses(self.body, time, angles, np.hstack((self._place(time), self._orientation(time))))

    def _values(self, name: str, time: Array) -> Array:
        return np.interp(time, *self.recording.signal(name))

    def _place(self, time: Array) -> Array:
        """Return the position of the root's frame, shape (n, 3) (m); what was not recorded stays as it started."""
        columns = []
        for axis, start in zip(PLACE, self.body.root.position, strict=True):
            name = f"{self.body.root_segment}.{axis}"
            recorded = name in self.recording.names
            columns.append(self._values(name, time) if recorded else np.full(len(time), float(start)))
        return np.column_stack(columns)

    def _orientation(self, time: Array) -> Array:
        """Return the orientation of the root as unit quaternions x, y, z, w, shape (n, 4)."""
        names = [f"{self.body.root_segment}.{angle}" for angle in TURN]
        if not set(names) <= set(self.recording.names):
            return np.tile(root_quaternion(self.body.root), (len(time), 1))
        clock = self.recording.signal(names[0])[0]
        turns = Rotation.from_euler("ZYX", np.column_stack([self._values(name, clock) for name in names]))
        if len(clock) == 1:
            return np.tile(turns.as_quat(), (len(time), 1))
        return np.asarray(Slerp(clock, turns)(np.clip(time, clock[0], clock[-1])).as_quat())


def needed(body: BodyModel) -> list[str]:
    """Return the signals that a body's motion consists of: its joint angles, and what moves of its root's pose."""
    return [*_angles(body), *(f"{body.root_segment}.{quantity}" for quantity in _MOVING[body.root.kind])]


def check_recorded(body: BodyModel, names: Collection[str]) -> None:
    """Check that signals of these names tell the motion of a body.

    Raises:
        RecordingError: names what is missing, and what the document must record.
    """
    missing = [name for name in needed(body) if name not in names]
    if missing:
        shown = ", ".join(missing[:6]) + (", …" if len(missing) > 6 else "")
        wanted = json.dumps(["*.angle", *([] if body.root.kind == "fixed" else [f"{body.root_segment}.*"])])
        hint = f"put 'pose: {{signals: {wanted}, every: 10 ms}}' under 'record:' and run it again"
        raise RecordingError(f"a picture of the body needs {shown}, not recorded. Hint: {hint}")


def _angles(body: BodyModel) -> list[str]:
    return [f"{joint}.angle" for joint in body.joints]


def recorded_body(recording: Recording) -> BodyModel:
    """Return the body of a recording's document.

    Raises:
        RecordingError: there is none, or it stands in a file of its own, which recordings do not hold.
    """
    parts = _recorded_parts(recording)
    if "body" not in parts:
        raise RecordingError(NO_BODY)
    with tempfile.TemporaryDirectory(prefix="neuromech-") as folder:
        file = Path(folder, "body.yaml")
        file.write_text(json.dumps(_ALONE | parts), encoding="utf-8")
        try:
            body = build(load(file, catalogue=Catalogue(BUILT_IN))).body
        except DocumentError as error:
            first = error.problems[0]
            raise RecordingError(f"the body in the recording cannot be used: {first.path} {first.message}") from error
    if body is None:
        raise ValueError("a document with a body has a model of it")
    return body


def has_body(recording: Recording) -> bool:
    """Return whether a recording's document has a body."""
    return "body" in _recorded_parts(recording)


_ALONE = {"neuromech": 1, "name": "body", "protocol": {"duration": "1 s"}}
_PARTS = ("body", "world")


def _recorded_parts(recording: Recording) -> dict[str, Any]:
    return _body_parts(YAML(typ="safe").load(recording.provenance.specification) or {})


def _body_parts(values: dict[str, Any]) -> dict[str, Any]:
    """Return what belongs to the body, of a whole document or an instance: only that must be understood to draw it."""
    parts = {name: values[name] for name in _PARTS if name in values}
    instances = {name: _body_parts(one) for name, one in values.get("instances", {}).items()}
    return parts | ({"instances": instances} if instances else {})


def _poses(body: BodyModel, time: Array, angles: Array, root: Array) -> Poses:
    tree = lower_tree(body)
    n, segments = len(time), len(tree.segments)
    position, rotation = np.zeros((n, segments, 3)), np.zeros((n, segments, 3, 3))
    contact = np.zeros((n, len(tree.contacts), 3))
    for k in range(n):
        forward_kinematics(tree.topology, tree.geometry, angles[k], root[k], rotation[k], position[k])
        contact_positions(tree.contact_segment, tree.contact_position, rotation[k], position[k], contact[k])
    return Poses(time, position, rotation, contact)
