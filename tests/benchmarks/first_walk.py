"""How many evaluations, and how much processor time, the searches of the cat take to the first walk of 10 s.

A walk is one of 10 s and 3 m on level ground. The searches are those of `specs/cat/tuning_thesis.yaml` (real-coded
genetic algorithm, equation 15 of Habu 2020) and `specs/cat/tuning.yaml` (CMA-ES, terms that grow with each step
ahead), or one of them with another algorithm, with runs of 10 s, each with seeds of its own. Each gives one line of
JSON, and all of them the medians of those that found a walk.

    python tests/benchmarks/first_walk.py tuning_thesis 0 5 2400
    python tests/benchmarks/first_walk.py tuning 0 5 2400
    python tests/benchmarks/first_walk.py tuning_thesis 0 5 2400 '{kind: cma_es, covariance: separable, step: 0.1}'
"""

import sys
from pathlib import Path

from reaching import Goal, reached, report

from neuromech.study.evaluate import Evaluator
from neuromech.study.evaluation import Evaluation
from neuromech.study.plan import Plan

CAT = Path(__file__).parents[2] / "specs" / "cat"
SECONDS, METRES = 10.0, 3.0
WAY = "{measure: {kind: distance, segment: trunk}, goal: maximize, scale: 1 m, worst: -1, weight: 1e-9}"


def walks(evaluation: Evaluation) -> bool:
    """Return whether a candidate walks in each of its runs."""
    ways = [run.measures["way"] for run in evaluation.runs if run.kind == "finished"]
    return len(ways) == len(evaluation.runs) and all(isinstance(way, float) and way >= METRES for way in ways)


def main() -> None:
    """Search with one of the documents, each of some seeds and perhaps an algorithm, up to a number of evaluations."""
    name, first, last, most = sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), int(sys.argv[4])
    changes = [f"study.duration={SECONDS} s", f"study.evaluations={most}"]
    changes += [f"study.algorithm={words}" for words in sys.argv[5:]]
    evaluator = Evaluator(
        CAT / f"{name}.yaml", changes if name == "tuning" else [*changes, f"study.objective.terms.way={WAY}"]
    )
    evaluator.prepare()
    goals = [Goal(f"{SECONDS:g} s, {METRES:g} m", walks)]
    report(name, goals, (reached(evaluator, Plan.of(evaluator.document), seed, goals) for seed in range(first, last)))


if __name__ == "__main__":
    main()
