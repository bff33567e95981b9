"""The network in Brian2: `brian2_peer.py NETWORK (numpy|cython|cpp) STEPS`.

Brian2's RK4 holds synaptic sums (`summed` variables) during a step. The C++ standalone program is compiled for one
duration, so that every run has STEPS steps; its time is that of the program's own simulation loop.
"""

import shutil
import sys
import tempfile
import time
from pathlib import Path

import brian2 as b
import numpy as np
from talk import network, own_stdout, parameters, serve

KINDS = ("rybak_interneuron", "rybak_neuron")
SHARED = """
f = int(v >= threshold) / (1 + exp(-(v - half_activity_potential) / activity_slope)) : 1
{sums}
{parameters}
"""
INTERNEURON = """
dv/dt = (leak_conductance * (leak_reversal - v)
         + excitatory_conductance * excitation * (excitatory_reversal - v)
         + inhibitory_conductance * inhibition * (inhibitory_reversal - v)) / (capacitance * second) : 1
"""
BURSTER = """
dv/dt = (sodium_conductance * h * (sodium_reversal - v)
           / (1 + exp(-(v - sodium_activation_half) / sodium_activation_slope))
         + potassium_conductance * (potassium_reversal - v)
           / (1 + exp(-(v - potassium_activation_half) / potassium_activation_slope))**4
         + leak_conductance * (leak_reversal - v)
         + excitatory_conductance * excitation * (excitatory_reversal - v)
         + inhibitory_conductance * inhibition * (inhibitory_reversal - v)) / (capacitance * second) : 1
dh/dt = (1 / (1 + exp((v - sodium_inactivation_half) / sodium_inactivation_slope)) - h)
        * cosh((v - sodium_inactivation_half) / inactivation_time_slope)
        / (maximal_inactivation_time * second) : 1
"""


def sums(net: dict, first: dict[str, int], size: dict[str, int], kind: str) -> tuple[str, dict[tuple[str, str], list]]:
    """Return the equations of both ports of a kind, and (port, sender's kind) -> (sender, receiver, weight)."""
    text, found = "", {}
    for port in ("excitation", "inhibition"):
        terms = [f"{port}_constant"]
        for sender in KINDS:
            chosen = [
                (s - first[sender], r - first[kind], w)
                for r, s, w in net[port]["synapses"]
                if 0 <= s - first[sender] < size[sender] and 0 <= r - first[kind] < size[kind]
            ]
            if chosen:
                found[port, sender] = chosen
                terms.append(f"{port}_{sender}")
                text += f"{port}_{sender} : 1\n"
        text += f"{port} = {' + '.join(terms)} : 1\n{port}_constant : 1 (constant)\n"
    return text, found


def group(net: dict, kind: str, text: str, start: int) -> b.NeuronGroup:
    """Return the neurons of a kind; what they share is one number."""
    values = parameters(net, kind)
    initial = {name: values.pop(name) for name in list(values) if name.startswith("initial_")}
    shared = {name: some[0] for name, some in values.items() if len(set(some)) == 1}
    own = {name: some for name, some in values.items() if name not in shared}
    declared = [f"{name} : 1 (constant)" for name in own] + [f"{name} : 1 (shared, constant)" for name in shared]
    equations = SHARED.format(sums=text, parameters="\n".join(declared))
    equations += BURSTER if kind == "rybak_neuron" else INTERNEURON
    count = len(initial["initial_potential"])
    made = b.NeuronGroup(count, equations, method="rk4")
    for name, some in (own | shared).items():
        setattr(made, name, some)
    for port in ("excitation", "inhibition"):
        setattr(made, f"{port}_constant", net[port]["constant"][start : start + count])
    made.v = initial["initial_potential"]
    if kind == "rybak_neuron":
        made.h = initial["initial_inactivation"]
    return made


def build(net: dict) -> tuple[b.Network, b.StateMonitor]:
    """Return the network with a monitor of the reference neuron."""
    b.defaultclock.dt = net["step"] * b.second
    size = {kind: sum(one["kind"] == kind for one in net["neurons"]) for kind in KINDS}
    first = {KINDS[0]: 0, KINDS[1]: size[KINDS[0]]}
    connected = {kind: sums(net, first, size, kind) for kind in KINDS}
    groups = {kind: group(net, kind, connected[kind][0], first[kind]) for kind in KINDS}
    parts: list = list(groups.values())
    for kind, (_, found) in connected.items():
        for (port, sender), chosen in found.items():
            sources, targets, weights = map(np.array, zip(*chosen, strict=True))
            model = f"w : 1 (constant)\n{port}_{sender}_post = w * f_pre : 1 (summed)"
            synapses = b.Synapses(groups[sender], groups[kind], model)
            synapses.connect(i=sources, j=targets)
            synapses.w = weights
            parts.append(synapses)
    kind = KINDS[net["reference"] >= first[KINDS[1]]]
    index = net["reference"] - first[kind]
    monitor = b.StateMonitor(groups[kind], "v", record=[index], dt=net["sampling_steps"] * net["step"] * b.second)
    return b.Network(*parts, monitor), monitor


def main() -> None:
    """Serve runs of the network on one target."""
    answers, net, target, steps = own_stdout(), network(), sys.argv[2], int(sys.argv[3])
    b.prefs.codegen.cpp.extra_compile_args_gcc = ["-w", "-O3", "-ffast-math", "-march=native", "-std=c++11"]
    if target == "cpp":
        folder = tempfile.mkdtemp(prefix="brian2-")
        b.set_device("cpp_standalone", directory=folder, build_on_run=False)
    else:
        b.prefs.codegen.target = target
    simulation, monitor = build(net)
    if target == "cpp":
        simulation.run(steps * net["step"] * b.second)
        b.device.build(directory=folder, run=False)
    else:
        simulation.store()
        simulation.run(10 * net["step"] * b.second)

    def run(count: int) -> tuple[float, list[float]]:
        if target != "cpp":
            simulation.restore()
            started = time.perf_counter()
            simulation.run(count * net["step"] * b.second)
            return time.perf_counter() - started, monitor.v[0]
        if count != steps:
            raise SystemExit(f"this program was built for {steps} steps")
        b.device.run(folder, with_output=False, run_args=[])
        seconds, _ = Path(folder, "results", "last_run_info.txt").read_text().split()
        return float(seconds), monitor.v[0]

    serve(answers, f"Brian2 {target}", b.__version__, "RK4, synaptic sums held during a step", run)
    if target == "cpp":
        shutil.rmtree(folder)


if __name__ == "__main__":
    main()
