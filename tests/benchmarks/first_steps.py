"""How many evaluations, and how much processor time, the search for a walk takes from gains that fall.

Two goals: the first 20 m, and then 1.3 m/s within 0.05 m/s with step lengths whose ln(mean/variance) is above 5. A
search is that of `specs/human/experiments/first_steps.yaml` with a seed of its own; it ends where both are reached, or
after the evaluations of the study. Each gives one line of JSON, and all of them the medians.

    python tests/benchmarks/first_steps.py pso 0 20
"""

import sys
from pathlib import Path

from reaching import Goal, reached, report

from neuromech.study.evaluate import Evaluator
from neuromech.study.evaluation import Evaluation
from neuromech.study.plan import Plan

SPEC = Path(__file__).parents[2] / "specs" / "human" / "experiments" / "first_steps.yaml"
POPULATIONS = {"cma_es": 14, "pso": 60}


def is_far(evaluation: Evaluation) -> bool:
    """Return whether a candidate walked 20 m."""
    return evaluation.score is not None and evaluation.score.stage >= 1


def is_regular(evaluation: Evaluation) -> bool:
    """Return whether a candidate walked at the asked speed with regular steps."""
    return evaluation.score is not None and evaluation.score.stage >= 2 and evaluation.score.value > 5.0


def main() -> None:
    """Search with an algorithm and each of some seeds."""
    kind, first, last = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    changes = [f"study.algorithm={{kind: {kind}, population: {POPULATIONS[kind]}}}"]
    evaluator = Evaluator(SPEC, changes)
    evaluator.prepare()
    goals = [Goal("20 m", is_far), Goal("1.3 m/s, SNR > 5", is_regular)]
    report(kind, goals, (reached(evaluator, Plan.of(evaluator.document), seed, goals) for seed in range(first, last)))


if __name__ == "__main__":
    main()
