"""What arrives after a delay is what was sent, shifted."""

import numpy as np
import pytest
from relays import DELAYS, relays

from neuromech.errors import DocumentError
from neuromech.pipeline import run

METHODS = ["rk4", "exponential_euler", "rush_larsen"]


@pytest.mark.parametrize("method", METHODS)
def test_a_delayed_signal_is_the_signal_shifted(document, method):
    """Also a delay of exactly one step, parts of a step, and long after the ring of the longest delay went round."""
    recording = run(document(relays(method)))
    time, sent = recording.signal("sender.activity")
    assert len(time) == 120
    for name, delay in DELAYS.items():
        expected = np.interp(time - delay / 1e3, time, sent)
        assert recording.signal(f"{name}.activity")[1] == pytest.approx(expected, abs=1e-12), name


@pytest.mark.parametrize("method", METHODS)
def test_a_delay_line_starts_filled_with_the_first_value(document, method):
    recording = run(document(relays(method)))
    assert recording.signal("long.activity")[1][:20] == pytest.approx(0.3)


def test_delays_along_a_chain_add_up(document):
    chain = relays()
    chain["network"]["synapses"]["excitatory"]["whole"] = {"none": {"weight": 1, "delay": "3 ms"}}
    chain["network"]["synapses"]["excitatory"]["sender"].pop("none")
    recording = run(document(chain))
    time, sent = recording.signal("sender.activity")
    assert recording.signal("none.activity")[1] == pytest.approx(np.interp(time - 5e-3, time, sent), abs=1e-12)


def test_units_without_memory_may_form_a_loop_through_a_delay(document):
    """Each turn adds a quarter of what went round: 0.5 + 0.125 + 0.03125 …"""
    loop = relays()
    loop["network"]["synapses"]["excitatory"] = {
        "go": {"step": 1},
        "step": {"whole": {"weight": 0.5, "delay": "1 ms"}},
        "whole": {"step": 0.5},
    }
    loop["parameters"]["drive"]["value"] = 0.5
    loop["protocol"]["events"] = {}
    loop["parameters"].pop("weight")
    recording = run(document(loop))
    assert recording.signal("step.activity")[1][-1] == pytest.approx(0.5 / (1.0 - 0.25), abs=1e-9)


def test_a_weight_that_jumps_is_felt_through_a_delay_at_once(document):
    """The weight belongs to the receiving end of the delay line."""
    jump = relays()
    jump["protocol"]["events"] = {"half": {"at": "20 ms", "set": {"weight": 0.5}}}
    recording = run(document(jump))
    time, sent = recording.signal("sender.activity")
    weight = np.where(time >= 0.02 - 1e-12, 0.5, 1.0)
    for name, delay in DELAYS.items():
        expected = weight * np.interp(time - delay / 1e3, time, sent)
        assert recording.signal(f"{name}.excitation")[1] == pytest.approx(expected, abs=1e-12)


def test_adaptive_solvers_refuse_delays(document):
    with pytest.raises(DocumentError, match=r"solver.method  an adaptive solver cannot run a network with delays"):
        run(document(relays("lsoda")))
