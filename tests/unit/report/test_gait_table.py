"""The gait of a cat that steps at a known rhythm."""

import numpy as np
import pytest
from rich.console import Console

from neuromech.report.gait import gait_measures, gait_table
from neuromech.simulate.recording import Outcome

PERIOD = 0.457
"""Period of the synthetic cat (s)."""


def printed(table):
    console = Console(width=120, color_system=None)
    with console.capture() as capture:
        console.print(table)
    return capture.get()


@pytest.mark.parametrize("outcome", [None, Outcome("fell", 12.0, "the root is low")])
def test_gait_of_a_trotting_cat_also_where_it_fell_at_last(cat, outcome):
    found = gait_measures(cat(load=3.0, outcome=outcome))
    assert [found["cycle_duration"][leg].value for leg in ("LF", "RH")] == pytest.approx([PERIOD, PERIOD], abs=2e-3)
    assert found["duty_factor"]["LH"].value == pytest.approx(0.55, abs=0.02)  # forces are sampled every 5 ms
    assert found["interlimb_phase"]["RF"].value == pytest.approx(0.5, abs=5e-3)
    assert found["gait"]["body"].value == "trot"
    assert found["speed"]["trunk"].value == 0.0


def test_a_table_with_a_line_for_each_leg(cat):
    lines = printed(gait_table(cat(load=3.0))).splitlines()
    assert lines[0].strip() == "gait: trot, 0 m/s"
    legs = [[cell.strip() for cell in line.split("│")[1:-1]] for line in lines if line.startswith("│")]
    assert [leg[0] for leg in legs] == ["LF", "RF", "LH", "RH"]
    assert [float(leg[1]) for leg in legs] == pytest.approx(4 * [PERIOD], abs=2e-3)
    assert [float(leg[2]) + float(leg[3]) for leg in legs] == pytest.approx(4 * [PERIOD], abs=4e-3)
    assert legs[0][-1] == "0"
    assert [float(leg[-1]) for leg in legs[1:3]] == pytest.approx([0.5, 0.5], abs=5e-3)


def test_heel_and_toe_of_a_biped_are_one_foot(record):
    time = np.arange(8000) * 0.001
    phase = time / 0.5
    signals = {}
    for leg, shift in (("L", 0.0), ("R", 0.5)):
        for contact, late in (("heel", 0.0), ("toe", 0.2)):
            signals[f"{leg}.{contact}.force_z"] = ("N", np.where((phase - shift - late) % 1.0 < 0.4, 300.0, 0.0))
    found = gait_measures(record(signals, outcome=Outcome("finished", 8.0), mass=70.0))
    assert [value.value for value in found["duty_factor"].values()] == pytest.approx([0.6, 0.6], abs=2e-3)
    assert "gait" not in found
    assert "speed" not in found


def test_what_cannot_be_measured_is_a_dash_with_its_reason_below(cat):
    lines = printed(gait_table(cat(load=3.0, seconds=2.0))).splitlines()
    assert lines[0].strip() == "gait: 0 m/s"
    assert [cell.strip() for cell in lines[4].split("│")[1:-1]] == ["LF", "–", "–", "–", "–", "0"]
    assert " ".join(lines[-2:]).strip().startswith("LF.* makes fewer than 3 strides; RF.* makes")


def test_feet_in_the_air_have_no_gait(cat):
    assert gait_table(cat(load=0.0)) is None


def test_a_network_alone_has_no_gait(record):
    assert gait_table(record({"A.activity": ("", np.zeros(1000))})) is None
