"""A small network of delays, as plain values of a document: what a relaxing unit sends, and how it arrives."""

DELAYS = {"none": 0.0, "step": 0.5, "whole": 2.0, "broken": 3.3, "long": 10.0}


def relays(method="rk4", duration=60, **more):
    """One rate neuron whose drive jumps, and units without memory that get its activity after each delay (ms)."""
    receivers = {name: {"weight": "${weight}", "delay": f"{delay} ms"} for name, delay in DELAYS.items()}
    return {
        "parameters": {"drive": {"value": 0.2, "minimum": 0, "maximum": 2}, "weight": {"value": 1}},
        "network": {
            "neurons": {
                "sender": {"kind": "rate_neuron", "time_constant": "5 ms", "initial_rate": 0.3},
                **{name: {"kind": "static_neuron"} for name in DELAYS},
            },
            "drives": {"go": {"kind": "descending_drive", "strength": "${drive}"}},
            "synapses": {"excitatory": {"go": {"sender": 1}, "sender": receivers}},
        },
        "solver": {"method": method, "step": "0.5 ms"},
        "protocol": {
            "duration": f"{duration} ms",
            "events": {"on": {"at": "15 ms", "set": {"drive": 0.9}}, "off": {"at": "32.5 ms", "set": {"drive": 0.3}}},
        },
        "record": {"all": {"signals": ["*"], "every": "0.5 ms"}},
        **more,
    }
