"""The summary says what was measured, and in words where there was nothing to measure."""

import json
from io import StringIO

import numpy as np
import pytest
from rich.console import Console

from neuromech.report.summary import metrics, summary_table
from neuromech.simulate.recording import Outcome


def printed(table):
    console = Console(width=160, record=True, file=StringIO())
    console.print(table)
    return console.export_text()


def test_metrics_are_periods_centers_and_amplitudes_in_si_units(cat):
    found = json.loads(json.dumps(metrics(cat())))
    assert list(found) == ["period", "center", "amplitude"]
    assert list(found["period"]) == [f"{leg}.RG-F.activity" for leg in ("LF", "RF", "LH", "RH")]
    assert found["period"]["LH.RG-F.activity"] == {"value": pytest.approx(0.457, abs=1e-5), "unit": "s"}
    assert found["center"]["LH.hip.angle"] == {"value": pytest.approx(np.deg2rad(70.0), abs=0.01), "unit": "rad"}


def test_metrics_of_a_silent_network_are_words(record):
    found = metrics(record({"A.activity": ("", np.zeros(1000))}))
    assert found == {"period": {"A.activity": {"value": "no rhythm", "unit": "s"}}}


def test_the_table_shows_degrees_and_what_ended_a_run(cat):
    text = printed(summary_table(cat()))
    for word in ("suspended cat", "pybullet", "12 s in 24.00 s", "0.50", "RG-F 0.457 s", "hip 70 deg, knee 110 deg"):
        assert word in text
    ended = printed(summary_table(cat(seconds=2.0, outcome=Outcome("diverged", 1.9, "LF.[RG-F].potential"))))
    assert "the run diverged at 1.9 s" in ended
