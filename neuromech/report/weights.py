"""The weights on strings that hit a body, as pictures show them: only while they swing."""

from dataclasses import dataclass
from math import cos, sin

import numpy as np
from numpy.typing import NDArray

from neuromech.analyse.windows import Array
from neuromech.graph.model import BodyModel
from neuromech.graph.swing import HEADINGS
from neuromech.report.replay import PLACE
from neuromech.simulate.recording import Recording
from neuromech.spec.pendulum import Pendulum

_STILL = 1e-3
"""How far (m) from the place of its release a weight that swings is."""


@dataclass(frozen=True, slots=True)
class Swing:
    """The way of one weight whose place was recorded.

    Args:
        pendulum: the weight and its string.
        pivot: (3,) in m, world axes.
        time: (samples,) in s.
        place: (samples, 3) of the middle of the weight in m.
    """

    pendulum: Pendulum
    pivot: Array
    time: Array
    place: Array

    def at(self, times: Array) -> tuple[Array, NDArray[np.bool_]]:
        """Return places, shape (n, 3) (m), at times (s), and whether the weight swings then."""
        places = np.column_stack([np.interp(times, self.time, self.place[:, axis]) for axis in range(3)])
        return places, (times >= self.begin) & (times <= self.end)

    @property
    def begin(self) -> float:
        """When it is released (s)."""
        return float(self.pendulum.release)

    @property
    def end(self) -> float:
        """When it is last away from where it was released (s): at the end of the run, or when it is put back."""
        first = _released(self.pendulum, self.time)
        away = np.linalg.norm(self.place[first:] - self.place[first], axis=1) > _STILL
        swinging = self.time[first:][away]
        return float(swinging[-1]) if len(swinging) else self.begin


def recorded_swings(body: BodyModel, recording: Recording) -> list[Swing]:
    """Return the ways of the weights that were released, of those whose place was recorded."""
    found = []
    for name, pendulum in body.world.pendulums.items():
        signals = [f"{name}.{axis}" for axis in PLACE]
        if not set(signals) <= set(recording.names):
            continue
        time = recording.signal(signals[0])[0]
        if len(time) == 0 or time[-1] < float(pendulum.release):
            continue
        place = np.column_stack([recording.signal(one)[1] for one in signals])
        found.append(Swing(pendulum, _pivot(pendulum, recording, time, place), time, place))
    return found


def _pivot(pendulum: Pendulum, recording: Recording, time: Array, place: Array) -> Array:
    """Return the pivot: one string to the side of the weight as it is released, at the same height."""
    if pendulum.pivot is not None:
        return np.array(pendulum.pivot, dtype=np.float64)
    after = _released(pendulum, time)
    heading = HEADINGS[pendulum.side] + _yaw(recording, pendulum.segment, float(time[after]))
    string = float(pendulum.string)
    return np.asarray(place[after] - string * np.array([cos(heading), sin(heading), 0.0]))


def _released(pendulum: Pendulum, time: Array) -> int:
    """Return the first sample after the release: with a target, the weight is put to its place at the release."""
    return min(int(np.searchsorted(time, float(pendulum.release), side="right")), len(time) - 1)


def _yaw(recording: Recording, segment: str, at: float) -> float:
    name = f"{segment}.yaw"
    return float(np.interp(at, *recording.signal(name))) if name in recording.names else 0.0
