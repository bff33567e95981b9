"""A soft limit is a damper of up to hundreds of N m s/rad: it must be stable at the steps of a walker."""

import numpy as np
import pytest
from rods import rod

from neuromech.pipeline import run


def falling(document, step, stiffness="17.19 N m/rad"):
    """Angle (rad) every 4 ms of a rod that falls from 40° into a limit at 20°, and its rate."""
    content = rod(step=step, passive=0, duration=0.4)
    content["body"]["joints"]["hinge"]["soft_limit"] = {
        "range": ["20 deg", "90 deg"],
        "stiffness": stiffness,
        "reference_velocity": "1 deg/s",
    }
    recording = run(document(content))
    every = round(4 / step)
    return [recording.signal(f"hinge.{name}")[1][::every] for name in ("angle", "velocity")]


def test_a_rod_creeps_into_a_soft_limit_the_same_at_any_step(document):
    """The damping rate reaches 10³ 1/s; with an explicit torque the rod would chatter at 1 ms."""
    (fine, _), (coarse, _) = falling(document, 0.1), falling(document, 1)
    assert 5e-3 < np.radians(20) - fine.min() < 0.1
    assert coarse == pytest.approx(fine, abs=4e-3)


def test_a_soft_limit_throws_nothing_back(document):
    """Stiff enough to lift the rod, it does so at no more than its reference velocity."""
    _, speed = falling(document, 1, "171.9 N m/rad")
    assert 0.0 < speed.max() <= np.radians(1.0)
