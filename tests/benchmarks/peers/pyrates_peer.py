"""The network in PyRates: `pyrates_peer.py NETWORK (jax|numba)`.

PyRates generates the right-hand side, vectorised over the neurons of a kind; its own fixed-step solvers are Euler and
Heun. So that the scheme is the same, the generated function is stepped by RK4 within what compiles it: `jax.lax.scan`,
or a loop in numba. The activity function is cut at the threshold by a factor 0 or 1.
"""

import os
import sys
import tempfile
import time
from importlib.metadata import version

import numpy as np
from pyrates import CircuitTemplate, NodeTemplate, OperatorTemplate
from talk import network, own_stdout, serve

ACTIVITY = "f = (0.5 + 0.5*sign(v - threshold)) / (1.0 + exp((half_activity_potential - v)/activity_slope))"
INTERNEURON = [
    ACTIVITY,
    "v' = (leak_conductance*(leak_reversal - v)"
    " + excitatory_conductance*(excitation + excitation_constant)*(excitatory_reversal - v)"
    " + inhibitory_conductance*(inhibition + inhibition_constant)*(inhibitory_reversal - v))/capacitance",
]
BURSTER = [
    ACTIVITY,
    "v' = (sodium_conductance*h*(sodium_reversal - v)"
    "/(1.0 + exp((sodium_activation_half - v)/sodium_activation_slope))"
    " + potassium_conductance*(potassium_reversal - v)"
    "/(1.0 + exp((potassium_activation_half - v)/potassium_activation_slope))^4"
    " + leak_conductance*(leak_reversal - v)"
    " + excitatory_conductance*(excitation + excitation_constant)*(excitatory_reversal - v)"
    " + inhibitory_conductance*(inhibition + inhibition_constant)*(inhibitory_reversal - v))/capacitance",
    "h' = (1.0/(1.0 + exp((v - sodium_inactivation_half)/sodium_inactivation_slope)) - h)"
    "*cosh((v - sodium_inactivation_half)/inactivation_time_slope)/maximal_inactivation_time",
]
EQUATIONS = {"rybak_interneuron": INTERNEURON, "rybak_neuron": BURSTER}


def operator(net: dict, kind: str) -> OperatorTemplate:
    """Return the equations of a kind with placeholders for what each neuron has of its own."""
    one = next(one for one in net["neurons"] if one["kind"] == kind)
    variables: dict = {name: 1.0 for name in one["parameters"]}
    variables |= {"excitation_constant": 0.0, "inhibition_constant": 0.0}
    variables |= {"excitation": "input(0.0)", "inhibition": "input(0.0)", "f": "output(0.0)", "v": "variable(0.0)"}
    if kind == "rybak_neuron":
        variables["h"] = "variable(0.0)"
    return OperatorTemplate(name=kind, path=None, equations=EQUATIONS[kind], variables=variables)


def node(net: dict, index: int, shared: dict[str, OperatorTemplate]) -> NodeTemplate:
    """Return the node of one neuron: the equations of its kind with its own numbers."""
    one = net["neurons"][index]
    values = {name: float(value) for name, value in one["parameters"].items()}
    values |= {f"{port}_constant": float(net[port]["constant"][index]) for port in ("excitation", "inhibition")}
    values["v"] = float(one["initial"]["potential"])
    if one["kind"] == "rybak_neuron":
        values["h"] = float(one["initial"]["inactivation"])
    return NodeTemplate(name=f"node{index}", path=None, operators={shared[one["kind"]]: values})


def build(net: dict) -> CircuitTemplate:
    """Return the circuit."""
    kinds = [one["kind"] for one in net["neurons"]]
    shared = {kind: operator(net, kind) for kind in EQUATIONS}
    nodes = {f"n{index}": node(net, index, shared) for index in range(len(kinds))}
    edges = [
        (f"n{sender}/{kinds[sender]}/f", f"n{receiver}/{kinds[receiver]}/{port}", None, {"weight": float(weight)})
        for port in ("excitation", "inhibition")
        for receiver, sender, weight in net[port]["synapses"]
    ]
    return CircuitTemplate(name="network", path=None, nodes=nodes, edges=edges)


def numba_run(func, args: list, net: dict, place: int):
    """Return the run of the generated function in a loop that numba compiles, called once so that it is compiled."""
    import numba

    flow = numba.njit(func, fastmath=True)
    dt, every = net["step"], net["sampling_steps"]

    @numba.njit(fastmath=True)
    def loop(count, y, trace, dy, rest):
        for number in range(count):
            if number % every == 0:
                trace[number // every] = y[place]
            k1 = flow(0, y, dy, *rest).copy()
            k2 = flow(0, y + 0.5 * dt * k1, dy, *rest).copy()
            k3 = flow(0, y + 0.5 * dt * k2, dy, *rest).copy()
            k4 = flow(0, y + dt * k3, dy, *rest)
            y += dt / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)

    _, first, dy, *rest = args
    rest = tuple(rest)

    def run(count: int) -> tuple[float, np.ndarray]:
        y, trace = np.array(first, dtype=float), np.empty(-(-count // every))
        started = time.perf_counter()
        loop(count, y, trace, dy, rest)
        return time.perf_counter() - started, trace

    run(1)
    return run


def jax_run(func, args: list, net: dict, place: int):
    """Return the run of the generated function in `jax.lax.scan`; compiled outside the clock."""
    import jax

    dt, every = net["step"], net["sampling_steps"]
    first, rest = args[1], tuple(args[2:])

    def step(y, _):
        k1 = func(0, y, *rest)
        k2 = func(0, y + 0.5 * dt * k1, *rest)
        k3 = func(0, y + 0.5 * dt * k2, *rest)
        k4 = func(0, y + dt * k3, *rest)
        return y + dt / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4), None

    def sample(y, _):
        return jax.lax.scan(step, y, None, length=every)[0], y[place]

    compiled = {}

    def run(count: int) -> tuple[float, np.ndarray]:
        samples = -(-count // every)
        if samples not in compiled:
            whole = jax.jit(lambda y: jax.lax.scan(sample, y, None, length=samples)[1])
            compiled[samples] = whole.lower(first).compile()
        started = time.perf_counter()
        trace = compiled[samples](first).block_until_ready()
        return time.perf_counter() - started, np.asarray(trace)

    return run


def main() -> None:
    """Serve runs of the generated function."""
    answers, net, back_end = own_stdout(), network(), sys.argv[2]
    os.chdir(tempfile.mkdtemp(prefix="pyrates-"))
    func, args, _, _ = build(net).get_run_func(
        "flow",
        step_size=net["step"],
        backend="jax" if back_end == "jax" else "default",
        float_precision="float64",
        verbose=False,
    )
    # Potentials come first, kind by kind, in the order in which the nodes were given.
    index = net["reference"]
    run = (jax_run if back_end == "jax" else numba_run)(func, list(args), net, index)
    serve(answers, f"PyRates {back_end}", version("pyrates"), "RK4 of the generated function", run)


if __name__ == "__main__":
    main()
