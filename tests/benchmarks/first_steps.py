"""How many evaluations, and how much processor time, the search for a walk takes from gains that fall.

Two goals: the first 20 m, and then 1.3 m/s within 0.05 m/s with step lengths whose ln(mean/variance) is above 5. A
search is that of `specs/human/experiments/first_steps.yaml` with a seed of its own; it ends where both are reached, or
after the evaluations of the study. Each gives one line of JSON, and all of them the medians.

    python tests/benchmarks/first_steps.py pso 0 20
"""

import json
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path
from statistics import median

from neuromech.spec.study import Study
from neuromech.study.algorithms.base import Algorithm
from neuromech.study.algorithms.catalogue import AlgorithmCatalogue
from neuromech.study.evaluate import Evaluator
from neuromech.study.evaluation import Evaluation, Job

SPEC = Path(__file__).parents[2] / "specs" / "human" / "experiments" / "first_steps.yaml"
GOALS = ("20 m", "1.3 m/s, SNR > 5")
POPULATIONS = {"cma_es": 14, "pso": 60}


@dataclass
class Search:
    """What became of one search: for each goal, (evaluations, processor seconds) until it was reached.

    Args:
        algorithm: its kind.
        seed: of the search.
        evaluations: in the end.
        reached: by goal; without those that were not reached.
    """

    algorithm: str
    seed: int
    evaluations: int = 0
    reached: dict[str, tuple[int, float]] = field(default_factory=dict)


def goals(evaluation: Evaluation) -> list[str]:
    """Return the goals that a candidate has reached."""
    if evaluation.score is None:
        return []
    far = evaluation.score.stage >= 1
    regular = evaluation.score.stage >= 2 and evaluation.score.value > 5.0
    return [goal for goal, is_reached in zip(GOALS, (far, regular), strict=True) if is_reached]


def algorithm(evaluator: Evaluator, kind: str, seed: int) -> Algorithm:
    """Return a search from the document's own values on."""
    catalogue, start = AlgorithmCatalogue.installed(), evaluator.space.point(evaluator.document)
    settings = catalogue.settings({"kind": kind, "population": POPULATIONS[kind]})
    return catalogue.create(settings, len(start), seed, start)


def search(evaluator: Evaluator, kind: str, seed: int) -> Search:
    """Search until all goals are reached, or the evaluations of the study are over."""
    study: Study = evaluator.study
    found, one, started = Search(kind, seed), algorithm(evaluator, kind, seed), time.process_time()
    while found.evaluations < study.evaluations and len(found.reached) < len(GOALS):
        scores = []
        for point in one.ask():
            job = Job(0, 0, 0, evaluator.space.parameters(point), evaluator.scenarios.seeds(0))
            evaluation = evaluator(job)
            found.evaluations += 1
            for goal in goals(evaluation):
                found.reached.setdefault(goal, (found.evaluations, time.process_time() - started))
            scores.append(evaluation.score)
        one.tell(scores)
    return found


def main() -> None:
    """Search with an algorithm and each of some seeds."""
    kind, first, last = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    evaluator = Evaluator(SPEC)
    evaluator.prepare()
    done = []
    for seed in range(first, last):
        done.append(search(evaluator, kind, seed))
        sys.stdout.write(json.dumps(vars(done[-1])) + "\n")
        sys.stdout.flush()
    for goal in GOALS:
        reached = [one.reached[goal] for one in done if goal in one.reached]
        words = "".join(f", median {median(column):.0f}" for column in zip(*reached, strict=True))
        sys.stdout.write(f"{kind}, {goal}: {len(reached)} of {len(done)}{words} (evaluations, core seconds)\n")


if __name__ == "__main__":
    main()
