"""What a sensor says reaches a muscle within the tick, or after exactly the delay that is written."""

import numpy as np
import pytest
from rods import rod

from neuromech.pipeline import run


@pytest.fixture
def reflex(document):
    """A rod that swings; its sensor reaches the muscle through a unit without memory, and another one after 5 ms."""
    content = rod(duration=0.3)
    content["network"]["neurons"] = {name: {"kind": "static_neuron", "bias": 0.5} for name in ("pool", "later")}
    content["network"]["synapses"] = {"excitatory": {"sense": {"pool": 1, "later": {"weight": 1, "delay": "5 ms"}}}}
    content["sensors"] = {"sense": {"kind": "joint_sensor", "joint": "hinge", "angle_gain": "0.1 1/rad"}}
    content["record"]["all"]["signals"] = ["*"]
    return run(document(content))


def test_a_reflex_through_a_unit_without_memory_has_no_hidden_delay(reflex):
    angle = reflex.signal("hinge.angle")[1]
    assert np.ptp(angle) > 0.5
    assert reflex.signal("sense.signal")[1] == pytest.approx(0.1 * angle)
    assert reflex.signal("pool.activity")[1] == pytest.approx(0.5 + 0.1 * angle)
    assert reflex.signal("spring.activation")[1] == pytest.approx(0.5 + 0.1 * angle)


def test_a_delayed_reflex_is_delayed_by_what_is_written_and_starts_filled(reflex):
    time, angle = reflex.signal("hinge.angle")
    assert reflex.signal("later.activity")[1] == pytest.approx(
        0.5 + 0.1 * np.interp(time - 5e-3, time, angle), abs=1e-9
    )
