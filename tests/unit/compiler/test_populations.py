"""Populations against the same network as dense matrices, and their wiring against what it promises."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from neuromech.compiler.lower import lower
from neuromech.compiler.wiring import by_probability, fixed_in_degree, generator
from neuromech.pipeline import build_graph, load_document
from neuromech.simulate.run import simulate

POOL = """
network:
  populations:
    pool:
      size: 40
      neuron: {kind: rybak_interneuron, initial_potential: -50 mV}
      vary: {leak_reversal: {uniform: [-60 mV, -40 mV]}}
  projections:
    excitation: {sender: pool, receiver: pool, in_degree: 7, synapse: {kind: excitatory, weight: 0.05}}
    inhibition:
      sender: pool
      receiver: pool
      probability: 0.2
      synapse: {kind: inhibitory, weight: 1}
      vary: {weight: {uniform: [0.01, 0.2]}}
  neurons:
    reader: {kind: rybak_interneuron}
  drives:
    brain: {kind: descending_drive, strength: 0.1}
  synapses:
    excitatory: {brain: {pool: 0.5}, pool: {reader: 0.01}}
protocol: {duration: 50 ms, initial: {pool.potential: {uniform: [-60 mV, -30 mV]}}}
record:
  mean: {signals: [pool.activity, reader.potential], every: 0.5 ms}
  single: {signals: ["pool[*].potential", "pool[3:5].activity"], every: 0.5 ms}
"""


def program(file):
    return lower(build_graph(load_document(file)))


def of_pool(recording, quantity="potential", size=40):
    return np.column_stack([recording.signal(f"pool[{i}].{quantity}")[1] for i in range(size)])


def dense(made, port, size=41):
    """Weights from every signal to an input port of the interneurons, read from the rows of the compiled step."""
    header, offsets, p = made.header, made.integers, made.parameters
    sources, shared = (offsets[header[name] :].view(np.int32) for name in ("row_source", "segment_source"))
    weights = np.zeros((size, made.layout.signal_count))
    for neuron in range(size):
        row = header["rybak_interneuron.inputs"] + port * size + neuron
        for k in range(*offsets[header["row_start"] + row :][:2]):
            weights[neuron, sources[k]] += p[header["weights"] + k]
        for g in range(*offsets[header["segment_start"] + row :][:2]):
            first, last = offsets[header["segment_first"] + g], offsets[header["segment_last"] + g]
            np.add.at(weights[neuron], shared[first:last], p[header["weights"] + offsets[header["segment_weight"] + g]])
    return weights


def dense_run(made, initial, steps, dt=5e-4):
    """Potentials of all interneurons by RK4 with matrices: equations 6, 7 and 11 in SI units."""
    excitation, inhibition = dense(made, 0), dense(made, 1)
    header = made.header
    first = header["rybak_interneuron.outputs"]
    leak = np.full(41, -0.06)
    leak[:40] = made.parameters[header["rybak_interneuron.leak_reversal"] :][:40]
    signal = np.full(made.layout.signal_count, 0.1)

    def slope(V):
        signal[first : first + 41] = np.where(V < -0.05, 0.0, 1.0 / (1.0 + np.exp(-(V + 0.03) / 0.008)))
        e, i = 10e-9 * excitation @ signal, 10e-9 * inhibition @ signal
        return (1.6e-9 * (leak - V) + e * (-0.01 - V) + i * (-0.07 - V)) / 20e-12

    V = [initial]
    for _ in range(steps - 1):
        a = slope(V[-1])
        b = slope(V[-1] + 0.5 * dt * a)
        c = slope(V[-1] + 0.5 * dt * b)
        d = slope(V[-1] + dt * c)
        V.append(V[-1] + dt / 6.0 * (a + 2 * b + 2 * c + d))
    return np.array(V)


def test_population_is_the_network_of_dense_matrices(document):
    made = program(document(POOL))
    recording = simulate(made)
    potentials = np.column_stack([of_pool(recording), recording.signal("reader.potential")[1]])
    assert np.ptp(potentials[0, :40]) > 0.02
    assert potentials == pytest.approx(dense_run(made, potentials[0], len(potentials)), abs=1e-12)


def test_rows_hold_what_the_projections_promise(document):
    made = program(document(POOL))
    first = made.header["rybak_interneuron.outputs"]
    excitation, inhibition = (dense(made, port)[:, first : first + 40] for port in (0, 1))
    assert (np.count_nonzero(excitation[:40], axis=1) == 7).all()
    assert set(excitation[:40][excitation[:40] > 0.0]) == {0.05}
    assert excitation[40].tolist() == [0.01] * 40
    varied = inhibition[inhibition > 0.0]
    assert 0.01 <= varied.min() < 0.05 < 0.15 < varied.max() <= 0.2
    assert len(varied) == pytest.approx(0.2 * 1600, abs=4 * (0.16 * 1600) ** 0.5)


def test_mean_and_single_neurons_agree(document):
    recording = simulate(program(document(POOL)))
    assert recording.match("pool[*].activity") == ["pool[3].activity", "pool[4].activity"]
    potential = of_pool(recording)
    activity = np.where(potential < -0.05, 0.0, 1.0 / (1.0 + np.exp(-(potential + 0.03) / 0.008)))
    assert recording.signal("pool.activity")[1] == pytest.approx(activity.mean(axis=1), abs=1e-12)
    assert recording.signal("pool[4].activity")[1] == pytest.approx(activity[:, 4], abs=1e-12)


def test_wiring_depends_neither_on_the_order_of_the_document_nor_on_the_seed_of_the_run(document):
    lines = POOL.split("    inhibition:\n")
    inhibition, rest = lines[1].split("  neurons:\n")
    excitation = lines[0].splitlines(keepends=True)[-1]
    other = lines[0].removesuffix(excitation) + "    inhibition:\n" + inhibition + excitation + "  neurons:\n" + rest
    assert other != POOL
    one, two = program(document(POOL)), program(document(other.replace("50 ms,", "50 ms, seed: 5,")))
    assert np.array_equal(one.integers, two.integers)
    assert np.array_equal(one.parameters, two.parameters)
    changed = program(document(POOL.replace("in_degree: 7,", "in_degree: 7, seed: 1,")))
    assert not np.array_equal(one.integers, changed.integers)


@pytest.mark.parametrize("delay", ["0 ms", "1.3 ms"])
def test_population_is_its_neurons_one_by_one(document, delay):
    ramp = "protocol: {duration: 40 ms, ramps: {more: {parameter: w, start: 0 s, end: 40 ms, to: 0.3}}}\n"
    ramp += "parameters: {w: {value: 0.04}}\n"
    neuron = "{kind: rybak_interneuron, leak_reversal: -45 mV, initial_potential: -40 mV}"
    alone = {name: neuron for name in ("a0", "a1", "b0", "b1")}
    synapse = f"{{weight: '${{w}}', delay: {delay}}}"
    singles = "network:\n  neurons:\n" + "".join(f"    {name}: {text}\n" for name, text in alone.items())
    singles += "  synapses:\n    inhibitory:\n"
    singles += "".join(f"      {a}: {{b0: {synapse}, b1: {synapse}}}\n" for a in ("a0", "a1"))
    singles += ramp + "record: {all: {signals: [b0.potential], every: 0.5 ms}}\n"
    pools = f"network:\n  populations:\n    a: {{size: 2, neuron: {neuron}}}\n    b: {{size: 2, neuron: {neuron}}}\n"
    kind = f"{{kind: inhibitory, weight: '${{w}}', delay: {delay}}}"
    pools += f"  projections:\n    p: {{sender: a, receiver: b, synapse: {kind}}}\n"
    pools += ramp + "record: {all: {signals: ['b[1].potential'], every: 0.5 ms}}\n"
    expected = simulate(program(document(singles))).signal("b0.potential")[1]
    assert np.ptp(expected) > 1e-3
    assert simulate(program(document(pools))).signal("b[1].potential")[1] == pytest.approx(expected, abs=1e-13)


def test_static_population_passes_signals_on_at_once(document):
    text = """
    network:
      drives: {d: {kind: descending_drive, strength: 0.4}}
      populations: {relays: {size: 3, neuron: {kind: static_neuron}}, last: {size: 2, neuron: {kind: static_neuron}}}
      projections: {p: {sender: relays, receiver: last, synapse: {kind: excitatory, weight: 0.5}}}
      synapses: {excitatory: {d: {relays: 1}}}
    protocol: {duration: 1 ms}
    record: {all: {signals: [last.activity], every: 0.5 ms}}
    """
    assert simulate(program(document(text))).signal("last.activity")[1] == pytest.approx([0.6, 0.6])


LARGE = """
network:
  populations: {pool: {size: 700, neuron: {kind: rybak_interneuron, leak_reversal: -45 mV}}}
  projections:
    one: {sender: pool, receiver: pool, in_degree: 30, synapse: {kind: excitatory, weight: 0.005}}
    two:
      sender: pool
      receiver: pool
      in_degree: 9
      synapse: {kind: inhibitory, weight: 0.1}
      vary: {weight: {uniform: [0, 0.1]}}
solver: {threads: %d}
protocol: {duration: 30 ms, initial: {pool.potential: {uniform: [-60 mV, -30 mV]}}}
record: {all: {signals: ["pool[*].potential"], every: 1 ms}}
"""


def test_threads_give_the_same_bits_also_in_two_runs_at_once(document):
    serial = of_pool(simulate(program(document(LARGE % 1))), size=700)
    assert np.ptp(serial[-1]) > 1e-3
    shared = program(document(LARGE % 3))
    assert shared.threads == 3
    with ThreadPoolExecutor(2) as pool:
        for recording in pool.map(lambda _: simulate(shared), range(2)):
            assert np.array_equal(of_pool(recording, size=700), serial)


@pytest.mark.parametrize(("senders", "count"), [(50, 1), (50, 10), (50, 24), (50, 40), (50, 50)])
def test_senders_of_a_receiver_differ_and_are_equally_likely(senders, count):
    chosen = fixed_in_degree(senders, 4000, count, generator(1, "test")).reshape(4000, count)
    assert (np.diff(chosen, axis=1) > 0).all()
    share = np.bincount(chosen.ravel(), minlength=senders) / 4000
    spread = (count / senders * (1.0 - count / senders) / 4000) ** 0.5
    assert np.abs(share - count / senders).max() <= 4.5 * spread


@pytest.mark.parametrize("probability", [0.0, 0.03, 0.5, 1.0])
def test_each_possible_synapse_has_its_probability(probability):
    wiring = by_probability(60, 3000, probability, generator(1, "test"))
    assert wiring.counts.shape == (3000,)
    assert wiring.counts.sum() == len(wiring.senders)
    spread = (probability * (1.0 - probability) / 3000) ** 0.5
    assert np.abs(np.bincount(wiring.senders, minlength=60) / 3000 - probability).max() <= 4.5 * spread
    assert wiring.counts.var() == pytest.approx(60 * probability * (1.0 - probability), rel=0.15)


def test_document_of_ten_million_synapses_becomes_arrays_and_nothing_else(document):
    text = LARGE.replace("size: 700", "size: 100000").replace("in_degree: 30", "in_degree: 100")
    made = program(document(text.replace('"pool[*].potential"', "pool.activity") % 2))
    assert len(made.layout.states) == 0
    assert made.integers.nbytes + made.parameters.nbytes < 12 * 10_900_000
