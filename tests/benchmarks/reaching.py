"""How many evaluations, and how much processor time, a search takes until a candidate reaches each of some goals."""

import json
import sys
import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict, dataclass, field, replace
from statistics import median

from neuromech.study.evaluate import Evaluator
from neuromech.study.evaluation import Evaluation, Job
from neuromech.study.plan import Plan


@dataclass(frozen=True)
class Goal:
    """What a candidate may reach.

    Args:
        name: of the goal.
        is_reached: tells it of an evaluation.
    """

    name: str
    is_reached: Callable[[Evaluation], bool]


@dataclass
class Search:
    """What became of one search: for each goal, (evaluations, processor seconds) until it was reached.

    Args:
        seed: of the search.
        evaluations: in the end.
        reached: by goal; without those that were not reached.
        seconds: of processor time in the end.
    """

    seed: int
    evaluations: int = 0
    reached: dict[str, tuple[int, float]] = field(default_factory=dict)
    seconds: float = 0.0


def reached(evaluator: Evaluator, plan: Plan, seed: int, goals: Sequence[Goal]) -> Search:
    """Search with a seed until all goals are reached, or the evaluations of the plan are over."""
    found, algorithm, started = Search(seed), replace(plan, seed=seed).algorithm(), time.process_time()
    generation = 0
    while found.evaluations < plan.evaluations and len(found.reached) < len(goals):
        scores = []
        for point in algorithm.ask():
            seeds = evaluator.scenarios.seeds(generation)
            evaluation = evaluator(Job(0, generation, 0, evaluator.space.parameters(point), seeds))
            found.evaluations += 1
            found.seconds = time.process_time() - started
            for goal in goals:
                if goal.is_reached(evaluation):
                    found.reached.setdefault(goal.name, (found.evaluations, found.seconds))
            scores.append(evaluation.score)
        algorithm.tell(scores)
        generation += 1
    return found


def report(name: str, goals: Sequence[Goal], searches: Iterable[Search]) -> None:
    """Write a line of JSON for each search, and for each goal how many reached it and the medians of those."""
    done = []
    for search in searches:
        done.append(search)
        _say(json.dumps({"search": name, **asdict(search)}))
    for goal in goals:
        these = [one.reached[goal.name] for one in done if goal.name in one.reached]
        words = "".join(f", median {median(column):.0f}" for column in zip(*these, strict=True))
        _say(f"{name}, {goal.name}: {len(these)} of {len(done)}{words} (evaluations, core seconds)")


def _say(line: str) -> None:
    sys.stdout.write(f"{line}\n")
    sys.stdout.flush()
