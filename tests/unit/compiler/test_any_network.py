"""Any valid small network compiles and steps, and its step does not depend on the order of what is written."""

from itertools import pairwise
from typing import Any

import numpy as np
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from neuromech.pipeline import run

KINDS: dict[str, dict[str, Any]] = {
    "rybak_neuron": {"sodium_conductance": "3.5 nS", "maximal_inactivation_time": "300 ms"},
    "rybak_interneuron": {"leak_reversal": "-60 mV"},
    "rate_neuron": {"time_constant": "10 ms"},
    "static_neuron": {"gain": 1},
}
# Two of each kind that differ in these, and one delay, are part of every network, so that all share one module.
TWINS = {
    "rybak_neuron": {"sodium_conductance": "0.5 nS", "maximal_inactivation_time": "600 ms"},
    "rybak_interneuron": {"leak_reversal": "-62 mV"},
    "rate_neuron": {"time_constant": "20 ms"},
    "static_neuron": {"gain": 0.5},
}
ALWAYS = {
    f"{part}-{kind}": {"kind": kind, **values}
    for part, table in (("one", KINDS), ("two", TWINS))
    for kind, values in table.items()
}

weights = st.floats(0.0, 2.0)
delays = st.sampled_from(["0 ms", "0.5 ms", "0.7 ms", "3 ms"])


@st.composite
def networks(draw):
    """Neurons of random kinds and synapses of random weights and delays, without algebraic loops."""
    kinds = draw(st.lists(st.sampled_from(sorted(KINDS)), min_size=1, max_size=6))
    names = [f"n{k}" for k in range(len(kinds))]
    neurons = {name: {"kind": kind, **KINDS[kind]} for name, kind in zip(names, kinds, strict=True)}
    synapses: dict[str, dict[str, dict[str, Any]]] = {"excitatory": {"go": {}}, "inhibitory": {}, "interlimb": {}}
    for sender in names:
        for receiver in draw(st.lists(st.sampled_from(names), unique=True)):
            kind = draw(st.sampled_from(sorted(synapses)))
            later = names.index(receiver) > names.index(sender)
            at_once = later or neurons[receiver]["kind"] != "static_neuron"
            delay = draw(delays if at_once else delays.filter(lambda text: text != "0 ms"))
            synapses[kind].setdefault(sender, {})[receiver] = {"weight": draw(weights), "delay": delay}
    synapses["excitatory"]["go"] = {name: draw(weights) for name in [*names, *ALWAYS]}
    for sender, receiver in pairwise(ALWAYS):
        synapses["inhibitory"].setdefault(sender, {})[receiver] = {"weight": 0.1, "delay": "1.5 ms"}
    return {
        "network": {
            "neurons": neurons | ALWAYS,
            "drives": {"go": {"kind": "descending_drive", "strength": 0.3}},
            "synapses": synapses,
        },
        "protocol": {
            "duration": "20 ms",
            "initial": {"*.potential": {"uniform": ["-70 mV", "-40 mV"]}, "*.inactivation": {"uniform": [0.3, 0.6]}},
        },
        "record": {"all": {"signals": ["*"], "every": "0.5 ms"}, "rates": {"signals": ["*.rate"], "every": "1 ms"}},
    }


def shuffled(value, random):
    """The same document with the keys of all its maps in another order."""
    if not isinstance(value, dict):
        return value
    keys = list(value)
    random.shuffle(keys)
    return {key: shuffled(value[key], random) for key in keys}


@settings(max_examples=25, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(network=networks(), random=st.randoms(use_true_random=False))
def test_a_network_steps_and_the_order_of_writing_changes_not_a_bit(document, network, random):
    first, second = run(document(network)), run(document(shuffled(network, random)))
    assert first.outcome.kind == second.outcome.kind == "finished"
    assert set(first.names) == set(second.names)
    for name in first.names:
        values = first.signal(name)[1]
        assert np.isfinite(values).all()
        assert values.tobytes() == second.signal(name)[1].tobytes(), name
