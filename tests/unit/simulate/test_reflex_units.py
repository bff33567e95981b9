"""Units of reflex controllers in a run: delays in seconds, phases that open gates, what is held."""

import numpy as np
import pytest

from neuromech.errors import DocumentError
from neuromech.pipeline import run

UNITS = """\
parameters:
  level: {value: 0, minimum: 0, maximum: 1}
  open: {value: 1, minimum: 0, maximum: 1}
network:
  drives:
    slope: {kind: descending_drive, strength: "${level}"}
    phase: {kind: descending_drive, strength: "${open}"}
  neurons:
    delayed: {kind: gated_relay}
    gated: {kind: gated_relay}
    held: {kind: sample_and_hold, initial_value: 7}
    high: {kind: threshold_unit, threshold: 0.6}
    between: {kind: latch_unit, on_above: 0.6, off_below: 0.3, initially_on: 1}
    smooth: {kind: low_pass, time_constant: 50 ms}
    one: {kind: threshold_unit, threshold: -0.5}
  synapses:
    excitatory:
      smooth: {delayed: {weight: 2, delay: DELAY}}
      slope:
        gated: 1
        held: 1
        high: 1
        between: 1
        smooth: 1
    gating:
      phase: {gated: 1, held: 1}
      one: {delayed: 1}
protocol:
  duration: 1 s
  ramps:
    up: {parameter: level, start: 0 ms, end: 400 ms, to: 1}
    down: {parameter: level, start: 500 ms, end: 900 ms, to: 0}
  events:
    close: {at: 300 ms, set: {open: 0}}
    reopen: {at: 800 ms, set: {open: 1}}
solver: {method: METHOD, step: STEP}
record: {all: {signals: ["*.activity", "*.signal"], every: 1 ms}}
"""


@pytest.fixture(scope="module")
def units(tmp_path_factory):
    """A function: activity of a unit over time, in a run with a delay, a method and a step."""

    def of(*names, delay="20 ms", method="exponential_euler", step="1 ms"):
        file = tmp_path_factory.mktemp("units") / "units.yaml"
        text = UNITS.replace("DELAY", delay).replace("METHOD", method).replace("STEP", step)
        file.write_text("neuromech: 1\nname: units\n" + text, encoding="utf-8")
        recording = run(file)
        return [recording.signal(name)[1] for name in names]

    return of


@pytest.mark.parametrize(("delay", "ticks"), [("5 ms", 5), ("10 ms", 10), ("20 ms", 20)])
@pytest.mark.parametrize("step", ["1 ms", "0.25 ms"])
def test_a_delayed_connection_delivers_what_was_there_a_delay_ago(units, delay, ticks, step):
    now, later = units("smooth.activity", "delayed.activity", delay=delay, step=step)
    assert now.max() > 0.9
    assert later[ticks:] == pytest.approx(2.0 * now[:-ticks], abs=1e-12)
    assert np.all(later[:ticks] == 0.0)


def test_a_delay_between_two_steps_is_interpolated(units):
    now, later = units("smooth.activity", "delayed.activity", delay="7.25 ms")
    between = 2.0 * (0.75 * now[1:-7] + 0.25 * now[:-8])
    assert later[8:] == pytest.approx(between, abs=1e-12)


def test_a_phase_opens_and_closes_a_gate(units):
    now, gated = units("slope.signal", "gated.activity")
    expected = now.copy()
    expected[300:800] = 0.0
    assert gated == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("method", ["exponential_euler", "rk4"])
def test_the_last_value_before_the_gate_closed_is_held_until_it_opens(units, method):
    now, held = units("slope.signal", "held.activity", method=method)
    assert held[:300] == pytest.approx(now[:300], abs=1e-12)
    assert np.all(held[300:800] == now[299])
    assert held[800:] == pytest.approx(now[800:], abs=1e-12)


def test_threshold_and_latch_differ_on_the_way_down_and_before_the_first_crossing(units):
    now, high, between = units("slope.signal", "high.activity", "between.activity")
    assert np.array_equal(high, now > 0.6)
    first = np.flatnonzero(now >= 0.3)[0]
    last = np.flatnonzero(now >= 0.3)[-1]
    rise = np.flatnonzero(now > 0.6)[0]
    assert between[0] == 0.0  # At zero the input is below the lower threshold already.
    assert np.all(between[first:rise] == 0.0)
    assert np.all(between[rise : last + 1] == 1.0)
    assert np.all(between[last + 1 :] == 0.0)


def test_a_first_order_connection_lags_a_ramp_by_its_time_constant(units):
    now, smooth = units("slope.signal", "smooth.activity")
    assert smooth[390] == pytest.approx(now[390] - 0.05 / 0.4, abs=2e-3)


def test_an_adaptive_solver_refuses_what_remembers_from_step_to_step(tmp_path):
    file = tmp_path / "units.yaml"
    text = UNITS.replace("delay: DELAY", "delay: 0 ms").replace("METHOD", "lsoda").replace("STEP", "1 ms")
    file.write_text("neuromech: 1\nname: units\n" + text, encoding="utf-8")
    with pytest.raises(DocumentError, match="adaptive solver cannot run units that remember"):
        run(file)
