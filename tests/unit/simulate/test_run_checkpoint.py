"""A look at a run while it goes on: what it sees, and that it changes nothing unless it ends the run."""

import numpy as np
import pytest
from relays import relays

from neuromech.compiler.lower import lower
from neuromech.pipeline import build_graph, load_document
from neuromech.simulate.run import Checkpoint, simulate


@pytest.fixture(params=["rk4", "lsoda"])
def program(request, document):
    content = relays(request.param)
    if request.param == "lsoda":
        content["network"]["synapses"]["excitatory"]["sender"] = {"none": {"weight": "${weight}"}}
    return lower(build_graph(load_document(document(content))))


def signals(recording):
    return {name: recording.signal(name)[1] for name in recording.names}


def test_a_run_that_is_looked_at_sees_its_beginning_and_goes_on(program):
    seen = []
    looked_at = simulate(program, checkpoint=Checkpoint(0.02, lambda so_far: seen.append(so_far) or ""))
    (so_far,) = seen
    assert so_far.outcome.kind == looked_at.outcome.kind == "finished"
    assert so_far.outcome.time == pytest.approx(0.02)
    assert looked_at.outcome.time == pytest.approx(0.06)
    shorter = simulate(program, duration=0.02)
    for name, values in signals(so_far).items():
        np.testing.assert_allclose(values, signals(shorter)[name], rtol=1e-6)
        np.testing.assert_allclose(values, signals(looked_at)[name][: len(values)], rtol=0.0)


def test_a_run_is_ended_where_the_look_says_so(program):
    recording = simulate(program, checkpoint=Checkpoint(0.02, lambda _: "it leads nowhere"))
    assert (recording.outcome.kind, recording.outcome.message) == ("stopped", "it leads nowhere")
    assert recording.outcome.time == pytest.approx(0.02)
    assert len(recording.signal("sender.activity")[0]) == 40


def test_there_is_no_look_at_a_run_that_is_over(program):
    def never(_):
        raise AssertionError

    assert simulate(program, checkpoint=Checkpoint(0.06, never)).outcome.kind == "finished"
    assert simulate(program, checkpoint=Checkpoint(1.0, never)).outcome.kind == "finished"
    assert simulate(program, duration=0.01, checkpoint=Checkpoint(0.02, never)).outcome.kind == "finished"
