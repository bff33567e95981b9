"""A result that one engine gives, the other gives too."""

from pathlib import Path

import numpy as np

from neuromech.pipeline import run

CAT = Path(__file__).parents[3] / "specs" / "cat" / "suspended.yaml"


def test_suspended_cat_steps_alike_in_bullet_and_mujoco():
    # Both engines step the equations of motion of a hanging tree semi-implicitly: only rounding tells them apart.
    runs = [run(CAT, [f"body.engine={engine}"], duration=5.0) for engine in ("pybullet", "mujoco")]
    assert [recording.provenance.engine.split()[0] for recording in runs] == ["pybullet", "mujoco"]
    bullet, mujoco = (np.degrees(recording.tree["joints"]["angle"].values) for recording in runs)
    assert np.ptp(bullet, axis=0).min() > 10.0, "the cat does not step"
    assert np.sqrt(np.mean((bullet - mujoco) ** 2)) < 1e-9
