"""How every Python peer talks: one greeting, then one answer for each line that it reads.

`run N` simulates N steps from the initial state and answers the seconds that it took; `trace` answers the reference
neuron's potential of the last run (V, every `sampling_steps` steps). Whatever a peer prints besides goes to stderr.
"""

import json
import os
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

Run = Callable[[int], tuple[float, Sequence[float]]]


def network() -> dict:
    """Return the exported network that the first argument names."""
    return json.loads(Path(sys.argv[1]).read_text("utf-8"))


def parameters(network: dict, kind: str) -> dict[str, list[float]]:
    """Return name -> values of all neurons of a kind; parameters, and initial states as `initial_<state>`."""
    members = [neuron for neuron in network["neurons"] if neuron["kind"] == kind]
    found = {name: [one["parameters"][name] for one in members] for name in members[0]["parameters"]}
    found |= {f"initial_{name}": [one["initial"][name] for one in members] for name in members[0]["initial"]}
    return found


def own_stdout():
    """Keep stdout for answers and send everything else that is printed to stderr."""
    answers = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)
    return answers


def serve(answers, name: str, version: str, scheme: str, run: Run) -> None:
    """Greet, then answer until there is nothing more to read."""
    print(json.dumps({"name": name, "version": version, "scheme": scheme}), file=answers, flush=True)
    trace: Sequence[float] = ()
    for line in sys.stdin:
        word, *rest = line.split()
        if word == "run":
            seconds, trace = run(int(rest[0]))
            print(seconds, file=answers, flush=True)
        else:
            print(json.dumps([float(value) for value in trace]), file=answers, flush=True)
