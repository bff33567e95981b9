"""Networks of 10 to 100 000 neurons with up to 100 synapses each: time and memory to a program, time for a step.

Each size has a process of its own, so that its peak memory is its own; runs with one thread and with two alternate.
"""

import json
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from statistics import median

from neuromech.bench.machine import machine
from neuromech.compiler.lower import lower
from neuromech.pipeline import build_graph, load_document
from neuromech.simulate.run import simulate

SIZES = (10, 100, 1_000, 10_000, 100_000)
IN_DEGREE = 100
REPETITIONS = 5
SUMMED_IN_A_RUN = 400_000_000

DOCUMENT = """
neuromech: 1
name: scale
network:
  populations:
    pool: {{size: {size}, neuron: {{kind: rybak_interneuron}}, vary: {{leak_reversal: {{uniform: [-62 mV, -48 mV]}}}}}}
  projections:
    recurrent:
      sender: pool
      receiver: pool
      in_degree: {in_degree}
      synapse: {{kind: excitatory, weight: {weight}}}
      vary: {vary}
solver: {{threads: {threads}}}
protocol: {{duration: 1 s, initial: {{pool.potential: {{uniform: [-60 mV, -30 mV]}}}}}}
record: {{means: {{signals: [pool.activity], every: 1 ms}}}}
"""


def measured(size: int, vary: str) -> dict[str, float]:
    """Return seconds to document and graph, to arrays, to machine code; peak memory; microseconds for a step."""
    in_degree = min(size, IN_DEGREE)
    steps = max(10, SUMMED_IN_A_RUN // (4 * size * in_degree))
    found: dict[str, float] = {"synapses": float(size * in_degree)}
    programs = {}
    for threads in (1, 2):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder, "scale.yaml")
            weight = 4.5 / in_degree
            file.write_text(DOCUMENT.format(size=size, in_degree=in_degree, weight=weight, threads=threads, vary=vary))
            started = time.perf_counter()
            graph = build_graph(load_document(file))
            built = time.perf_counter()
            programs[threads] = lower(graph)
            lowered = time.perf_counter()
        if threads == 1:
            simulate(programs[1], duration=2 * programs[1].tick)
            compiled = time.perf_counter() - lowered
            found |= {"graph": built - started, "lower": lowered - built, "compile": compiled, "memory": _megabytes()}
    times: dict[int, list[float]] = {1: [], 2: []}
    for _ in range(REPETITIONS + 1):
        for threads, program in programs.items():
            provenance = simulate(program, duration=steps * program.tick).provenance
            times[threads].append(1e6 * provenance.wall_seconds / steps)
    return found | {f"step{threads}": median(some[1:]) for threads, some in times.items()}


def _megabytes() -> float:
    """Return the peak memory of this process."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0


def main() -> None:
    """Write the table, or, given a size, the numbers of that size."""
    if len(sys.argv) > 1:
        sys.stdout.write(json.dumps(measured(int(sys.argv[1]), sys.argv[2])))
        return
    sys.stdout.write(f"{machine()['processor']}, load {machine()['load']}\n\n")
    sys.stdout.write(
        "| neurons | synapses | weights | graph | arrays | machine code | peak memory | step, 1 thread | 2 |\n"
    )
    sys.stdout.write("|--:|--:|---|--:|--:|--:|--:|--:|--:|\n")
    for name, vary in (("one", "{}"), ("each its own", "{weight: {uniform: [0.01, 0.08]}}")):
        for size in SIZES if name == "one" else SIZES[-1:]:
            done = subprocess.run(
                [sys.executable, __file__, str(size), vary], check=True, capture_output=True, text=True
            )
            row = json.loads(done.stdout)
            cells = [f"{size}", f"{row['synapses']:.0f}", name]
            cells += [f"{1e3 * row[part]:.0f} ms" for part in ("graph", "lower")]
            cells += [f"{row['compile']:.1f} s", f"{row['memory']:.0f} MB"]
            cells += [f"{row[part]:.0f} µs" for part in ("step1", "step2")]
            sys.stdout.write(f"| {' | '.join(cells)} |\n")


if __name__ == "__main__":
    main()
