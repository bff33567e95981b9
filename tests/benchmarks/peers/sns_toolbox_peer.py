"""The network in SNS-Toolbox, NumPy back end: `sns_toolbox_peer.py NETWORK`. Its only scheme is forward Euler.

Its chemical synapse is piecewise linear in the sender's potential where ours is logistic: here it rises from two slopes
below to one slope above half activity, with which there is a rhythm, of 0.42 s. So its period may differ by 10 %.
Everything else maps exactly: two gated channels for each bursting neuron, and drives as part of the leak.

The package imports torch, which its NumPy back end never uses; an empty module stands in for it.
"""

import sys
import time
from importlib.metadata import version
from types import ModuleType

sys.modules["torch"] = ModuleType("torch")
sys.modules["torch"].Tensor = type("Tensor", (), {})

from sns_toolbox.connections import NonSpikingSynapse  # noqa: E402
from sns_toolbox.networks import Network  # noqa: E402
from sns_toolbox.neurons import NonSpikingNeuron, NonSpikingNeuronWithGatedChannels  # noqa: E402
from talk import network, own_stdout, serve  # noqa: E402


def leak(p: dict, excitation: float, inhibition: float) -> dict[str, float]:
    """Return capacitance, conductance and resting potential with the constant input of drives folded in."""
    excitatory = p["excitatory_conductance"] * excitation
    inhibitory = p["inhibitory_conductance"] * inhibition
    total = p["leak_conductance"] + excitatory + inhibitory
    current = p["leak_conductance"] * p["leak_reversal"]
    current += excitatory * p["excitatory_reversal"] + inhibitory * p["inhibitory_reversal"]
    return {
        # Its step is dt g/C times the current, not dt/C: the factor g is taken out again here.
        "membrane_capacitance": p["capacitance"] * total,
        "membrane_conductance": total,
        "resting_potential": current / total,
    }


def neuron(one: dict, excitation: float, inhibition: float) -> NonSpikingNeuron:
    """Return a neuron; with sodium (gate A activates, gate B inactivates) and potassium channels where it bursts."""
    p = one["parameters"]
    membrane = leak(p, excitation, inhibition)
    if one["kind"] == "rybak_interneuron":
        return NonSpikingNeuron(**membrane)
    # Lists, because the constructor asks for the truth of its arguments, which an array of two has none of.
    ones, zeros = [1.0, 1.0], [0.0, 0.0]
    return NonSpikingNeuronWithGatedChannels(
        g_ion=[p["sodium_conductance"], p["potassium_conductance"]],
        e_ion=[p["sodium_reversal"], p["potassium_reversal"]],
        pow_a=[1.0, 4.0],
        k_a=ones,
        slope_a=[1.0 / p["sodium_activation_slope"], 1.0 / p["potassium_activation_slope"]],
        e_a=[p["sodium_activation_half"], p["potassium_activation_half"]],
        pow_b=[1.0, 0.0],
        k_b=ones,
        slope_b=[-1.0 / p["sodium_inactivation_slope"], 0.0],
        e_b=[p["sodium_inactivation_half"], 0.0],
        tau_max_b=[2.0 * p["maximal_inactivation_time"], 1.0],
        pow_c=zeros,
        k_c=ones,
        slope_c=zeros,
        e_c=zeros,
        tau_max_c=ones,
        **membrane,
    )


def build(net: dict):
    """Return the compiled network, started at the exported initial state."""
    made = Network()
    constants = zip(net["excitation"]["constant"], net["inhibition"]["constant"], strict=True)
    for one, (excitation, inhibition) in zip(net["neurons"], constants, strict=True):
        made.add_neuron(
            neuron(one, excitation, inhibition), name=one["name"], initial_value=one["initial"]["potential"]
        )
    for port, sign in (("excitation", "excitatory"), ("inhibition", "inhibitory")):
        for receiver, sender, weight in net[port]["synapses"]:
            p, source = net["neurons"][receiver]["parameters"], net["neurons"][sender]["parameters"]
            half, slope = source["half_activity_potential"], source["activity_slope"]
            synapse = NonSpikingSynapse(
                max_conductance=weight * p[f"{sign}_conductance"],
                reversal_potential=p[f"{sign}_reversal"],
                e_lo=half - 2.0 * slope,
                e_hi=half + slope,
            )
            made.add_connection(synapse, net["neurons"][sender]["name"], net["neurons"][receiver]["name"])
    made.add_output(net["neurons"][net["reference"]]["name"])
    return made.compile(dt=net["step"], backend="numpy")


def main() -> None:
    """Serve runs of the network."""
    answers, net = own_stdout(), network()
    model = build(net)
    first_gate = model.b_gate.copy()
    first_gate[0] = [one["initial"].get("inactivation", 0.0) for one in net["neurons"]]

    def run(count: int) -> tuple[float, list[float]]:
        model.reset()
        model.b_gate = first_gate.copy()
        trace = [model.V[net["reference"]]]
        started = time.perf_counter()
        for number in range(1, count + 1):
            model.forward()
            if number % net["sampling_steps"] == 0:
                trace.append(model.outputs[0])
        return time.perf_counter() - started, trace[: -(-count // net["sampling_steps"])]

    serve(answers, "SNS-Toolbox NumPy", version("sns_toolbox"), "forward Euler, piecewise-linear synapses", run)


if __name__ == "__main__":
    main()
