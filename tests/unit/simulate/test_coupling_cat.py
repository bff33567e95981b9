"""The table of docs/numerics.md: error of the coupling in the air-stepping cat, against explicit torques at 0.02 ms.

The network has the step of 0.02 ms in all runs, so that only the coupling differs. Root mean square over 12 joints and
1.3 s, sampled every millisecond.
"""

import re
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from neuromech.pipeline import run

CAT = Path(__file__).parents[3] / "specs" / "cat" / "suspended.yaml"
NETWORK_STEP = 0.02


@cache
def angles(coupling, body_step, network_step=NETWORK_STEP):
    """Joint angles in degrees; (samples, joints)."""
    solver = {"coupling": coupling, "body_step": f"{body_step} ms", "step": f"{network_step} ms"}
    changes = [f"solver.{key}={value}" for key, value in solver.items()]
    changes += ["claims=null", "record.joints.signals=['*.angle']", "record.joints.every=1 ms"]
    changes += [f"record.{group}=null" for group in ("neurons", "muscles", "feet")]
    recording = run(CAT, changes, duration=1.3)
    assert recording.outcome.kind == "finished"
    return np.degrees(np.column_stack([recording.signal(name)[1] for name in recording.match("*.angle")]))


def error(coupling, body_step, network_step=NETWORK_STEP):
    difference = angles(coupling, body_step, network_step) - angles("explicit", 0.02)
    assert difference.shape == (1300, 12)
    return np.sqrt(np.mean(difference**2))


@pytest.mark.parametrize(("body_step", "bound"), [(1, 1.0), (0.5, 0.4)])
def test_implicit_coupling_stays_close(body_step, bound):
    assert error("observer_implicit", body_step) <= bound


def test_explicit_coupling_at_a_millisecond_does_not():
    assert error("explicit", 1) > 4.0


def documented():
    """Rows of the table in docs/numerics.md: coupling, body step in ms, error in degrees."""
    page = (CAT.parents[2] / "docs" / "numerics.md").read_text("utf-8")
    (steps,) = re.findall(r"^\| coupling \|(.*)\|$", page, re.MULTILINE)
    for coupling, errors in re.findall(r"^\| `(observer_implicit|explicit)` \|(.*)\|$", page, re.MULTILINE):
        for step, error in zip(steps.split("|"), errors.split("|"), strict=True):
            yield coupling, float(step.replace("ms", "")), float(error)


def test_the_table_has_every_cell():
    assert [cell[:2] for cell in documented()] == [
        (coupling, step) for coupling in ("observer_implicit", "explicit") for step in (0.1, 0.5, 1.0)
    ]


@pytest.mark.slow
@pytest.mark.parametrize(("coupling", "body_step", "expected"), list(documented()))
def test_documented_table_is_what_is_measured(coupling, body_step, expected):
    assert error(coupling, body_step) == pytest.approx(expected, rel=0.15, abs=0.01)


@pytest.mark.slow
def test_error_of_the_implicit_coupling_is_of_first_order():
    steps = (0.1, 0.5, 1.0)
    errors = [error("observer_implicit", step) for step in steps]
    assert np.polyfit(np.log(steps), np.log(errors), 1)[0] == pytest.approx(1.0, abs=0.25)


def test_the_usual_network_step_is_fine_enough():
    assert error("observer_implicit", 1, 0.5) <= 1.0
