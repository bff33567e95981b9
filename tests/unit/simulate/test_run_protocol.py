"""Ramps and events: every parameter that may move does so where it is used; the others refuse."""

import numpy as np
import pytest
from relays import relays
from rods import ARM, GRAVITY, INERTIA, MASS, muscle, rod

from neuromech.errors import DocumentError
from neuromech.pipeline import run


def with_protocol(content, **protocol):
    return content | {"protocol": content["protocol"] | protocol}


RAMP = {"up": {"parameter": "drive", "start": "10 ms", "end": "30 ms", "to": 1.2}}
JUMP = {"back": {"at": "45 ms", "set": {"drive": 0.1}}}


def expected_drive(time):
    ramp = np.interp(time, [0.01, 0.03], [0.2, 1.2])
    return np.where(time >= 0.045 - 1e-12, 0.1, ramp)


@pytest.mark.parametrize("method", ["rk4", "exponential_euler", "rush_larsen"])
def test_a_drive_follows_its_ramps_and_events(document, method):
    recording = run(document(with_protocol(relays(method), ramps=RAMP, events=JUMP)))
    time, signal = recording.signal("go.signal")
    assert signal == pytest.approx(expected_drive(time), abs=1e-12)
    assert recording.signal("sender.excitation")[1] == pytest.approx(signal)


def prompt(method, step):
    """The relays without delays, so that every solver can take them."""
    content = with_protocol(relays(method), ramps=RAMP, events=JUMP)
    for synapse in content["network"]["synapses"]["excitatory"]["sender"].values():
        synapse["delay"] = "0 ms"
    content["solver"] |= {"step": f"{step} ms", "relative_tolerance": 1e-9, "absolute_tolerance": 1e-12}
    return content


@pytest.mark.parametrize("method", ["lsoda", "dop853", "radau"])
def test_adaptive_solvers_see_the_same_protocol(document, method):
    """Between the events as well: what is recorded just before a jump is the value before it."""
    exact, fine = run(document(prompt(method, 0.5))), run(document(prompt("rk4", 0.125)))
    time, drive = exact.signal("go.signal")
    assert drive == pytest.approx(expected_drive(time), abs=1e-12)
    for name in ("sender.rate", "none.activity"):
        assert exact.signal(name)[1] == pytest.approx(fine.signal(name)[1], abs=5e-5)


def test_a_ramp_is_followed_to_second_order_by_fixed_steps(document):
    def rate(method, step):
        content = with_protocol(prompt(method, step), ramps=RAMP, events={})
        content["record"]["all"]["every"] = "2 ms"
        return run(document(content)).signal("sender.rate")[1]

    exact, steps = rate("dop853", 0.5), (2.0, 1.0, 0.5, 0.25)
    errors = [abs(rate("rk4", step) - exact).max() for step in steps]
    assert np.polyfit(np.log(steps), np.log(errors), 1)[0] == pytest.approx(2.0, abs=0.2)


def test_an_event_between_two_ticks_is_exact_for_adaptive_solvers_and_late_for_fixed_steps(document):
    event = {"between": {"at": "10.25 ms", "set": {"drive": 0.9}}}
    found = {}
    for method, step in (("lsoda", 0.5), ("rk4", 0.5), ("rk4", 0.25)):
        content = with_protocol(prompt(method, step), ramps={}, events=event)
        _, found[method, step] = run(document(content)).signal("sender.rate")
    assert found["lsoda", 0.5] == pytest.approx(found["rk4", 0.25], abs=1e-6)
    assert abs(found["rk4", 0.5] - found["rk4", 0.25]).max() > 1e-3


def damped_rod(**protocol):
    content = rod(passive=0, damping="${damping}", duration=1)
    content["muscles"]["spring"] = muscle("100 mm", 0.2, 0, arm="${arm}")
    content["parameters"] = {"damping": {"value": "0 N m s/rad"}, "arm": {"value": "20 mm"}}
    return with_protocol(content, **protocol)


def test_joint_damping_can_change_during_a_run(document):
    content = damped_rod(events={"brake": {"at": "0.5 s", "set": {"damping": "5 mN m s/rad"}}})
    recording = run(document(content))
    (time, q), (_, v) = recording.signal("hinge.angle"), recording.signal("hinge.velocity")
    energy = 0.5 * INERTIA * v**2 + MASS * GRAVITY * ARM * (1 - np.cos(q))
    assert energy[time <= 0.5] == pytest.approx(energy[0], rel=1e-9)
    assert energy[-1] < 0.9 * energy[0]


def test_moment_arms_can_change_during_a_run(document):
    content = damped_rod(ramps={"shift": {"parameter": "arm", "start": "0.2 s", "end": "0.6 s", "to": "-10 mm"}})
    recording = run(document(content))
    (time, q), (_, length) = recording.signal("hinge.angle"), recording.signal("spring.length")
    arm = np.interp(time, [0.2, 0.6], [0.02, -0.01])
    assert length == pytest.approx(0.14 - arm * q, abs=1e-12)


def problems(document, content):
    with pytest.raises(DocumentError) as caught:
        run(document(content))
    return [str(problem).split("  ", 1)[1] for problem in caught.value.problems]


@pytest.mark.parametrize(
    ("protocol", "message"),
    [
        (
            {"ramps": RAMP, "events": {"on": {"at": "20 ms", "set": {"drive": 1}}}},
            "protocol.events.on.set.drive  changes parameter 'drive' while protocol.ramps.up still does, until 0.03 s "
            "(got a start at 0.02 s).",
        ),
        (
            {"ramps": {}, "events": {name: {"at": "20 ms", "set": {"drive": 1}} for name in ("a", "b")}},
            "protocol.events.b.set.drive  changes parameter 'drive' while protocol.events.a.set.drive still does, "
            "until 0.02 s (got a start at 0.02 s).",
        ),
    ],
    ids=["jump in a ramp", "two jumps"],
)
def test_overlapping_changes_are_refused(document, protocol, message):
    assert problems(document, with_protocol(relays(), **protocol)) == [message]


def test_changes_may_touch(document):
    events = {"before": {"at": "10 ms", "set": {"drive": 0.5}}, "after": {"at": "30 ms", "set": {"drive": 0.7}}}
    recording = run(document(with_protocol(relays(), ramps=RAMP, events=events)))
    time, signal = recording.signal("go.signal")
    expected = np.where(time < 0.01, 0.2, np.interp(time, [0.01, 0.03], [0.5, 1.2]))
    assert signal == pytest.approx(np.where(time >= 0.03 - 1e-12, 0.7, expected), abs=1e-12)


def test_what_cannot_change_during_a_run_is_refused(document):
    content = relays()
    content["parameters"]["start"] = {"value": 0.3}
    content["network"]["neurons"]["sender"]["initial_rate"] = "${start}"
    content["protocol"]["events"] = {"late": {"at": "20 ms", "set": {"start": 0.5}}}
    assert problems(document, content) == [
        "protocol.events.late.set.start  parameter 'start' cannot change during a run, because it sets "
        "network.neurons.sender.initial_rate. Hint: give it one value for the whole run"
    ]


def test_masses_cannot_change_during_a_run(document):
    content = rod()
    content["parameters"] = {"mass": {"value": "0.3 kg"}}
    content["body"]["segments"]["rod"]["mass"] = "${mass}"
    content["protocol"]["events"] = {"late": {"at": "20 ms", "set": {"mass": "0.5 kg"}}}
    assert problems(document, content) == [
        "protocol.events.late.set.mass  parameter 'mass' cannot change during a run, because it sets "
        "body.segments.rod.mass. Hint: give it one value for the whole run"
    ]
