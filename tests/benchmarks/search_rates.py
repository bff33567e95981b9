"""How often each search algorithm solves sphere, Rosenbrock and Rastrigin in ten dimensions, beside a library's own.

A search is solved where its best value reaches the target within the evaluations. The optimum lies off the middle of
the box, where no algorithm begins. Ours see the score 1 / (1 + f), which roulette needs to be positive. Words on the
command line choose the algorithms whose names they are part of.
"""

import random
import sys
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from statistics import median

import cmaes
import numpy as np
from deap import base, creator, tools
from pymoo.algorithms.soo.nonconvex.pso import PSO
from pymoo.core.problem import Problem as PymooProblem

from neuromech.study.algorithms.base import Floats
from neuromech.study.algorithms.catalogue import AlgorithmCatalogue
from neuromech.study.score import Score

DIMENSION = 10
SEEDS = range(20)


@dataclass(frozen=True)
class Problem:
    """A function to minimise over a box, whose coordinates run over 0…1, down to a target."""

    name: str
    function: Callable[[Floats], Floats]
    low: float
    high: float
    target: float

    def values(self, points: Floats) -> Floats:
        """Return the value at each point of the unit cube; (points,)."""
        return self.function(self.low + (self.high - self.low) * points)


PROBLEMS = (
    Problem("sphere", lambda x: (x**2).sum(axis=1), -3.0, 7.0, 1e-3),
    Problem(
        "Rosenbrock",
        lambda x: (100.0 * (x[:, 1:] - x[:, :-1] ** 2) ** 2 + (1.0 - x[:, :-1]) ** 2).sum(axis=1),
        -2.0,
        3.0,
        1.0,
    ),
    Problem("Rastrigin", lambda x: (x**2 - 10.0 * np.cos(2.0 * np.pi * x) + 10.0).sum(axis=1), -3.0, 7.0, 0.9),
)


class Solved(Exception):  # noqa: N818 (it ends a search, it is no error)
    """The target is reached."""


class Counted:
    """A problem that counts evaluations, remembers the best, and ends a search that has reached the target."""

    def __init__(self, problem: Problem, most: int) -> None:
        self.problem = problem
        self.most = most
        self.count = 0
        self.best = np.inf

    def __call__(self, points: Floats) -> Floats:
        values = self.problem.values(points)
        self.count += len(values)
        self.best = min(self.best, float(values.min()))
        if self.best <= self.problem.target:
            raise Solved
        return values


Solver = Callable[[Counted, int], None]


def ours(**written: object) -> Solver:
    catalogue = AlgorithmCatalogue.installed()
    settings = catalogue.settings(written)

    def solve(counted: Counted, seed: int) -> None:
        search = catalogue.create(settings, DIMENSION, seed)
        while counted.count < counted.most:
            search.tell([Score(0, 1.0 / (1.0 + float(value))) for value in counted(search.ask())])

    return solve


def deap_ga(counted: Counted, seed: int) -> None:
    """Roulette, blend crossover of 30 % of the loci with α = 0.5, and two elites, of DEAP's operators."""
    random.seed(seed)
    if not hasattr(creator, "Individual"):
        creator.create("Fitness", base.Fitness, weights=(1.0,))
        creator.create("Individual", list, fitness=creator.Fitness)

    def rated(individuals: list[list[float]]) -> list[list[float]]:
        values = counted(np.array(individuals))
        for individual, value in zip(individuals, values, strict=True):
            individual.fitness.values = (1.0 / (1.0 + float(value)),)
        return individuals

    def child(first: list[float], second: list[float]) -> list[float]:
        first = creator.Individual(first)
        loci = [locus for locus in range(DIMENSION) if random.random() < 0.3] or [random.randrange(DIMENSION)]
        drawn, _ = tools.cxBlend([first[locus] for locus in loci], [second[locus] for locus in loci], 0.5)
        for locus, value in zip(loci, drawn, strict=True):
            first[locus] = min(max(value, 0.0), 1.0)
        return first

    population = rated([creator.Individual(random.random() for _ in range(DIMENSION)) for _ in range(300)])
    while counted.count < counted.most:
        elites = [creator.Individual(elite) for elite in tools.selBest(population, 2)]
        parents = tools.selRoulette(population, 2 * 298)
        population = rated([*elites, *map(child, parents[::2], parents[1::2])])


def pymoo_pso(acceleration: float) -> Solver:
    class Box(PymooProblem):
        def __init__(self, counted: Counted) -> None:
            super().__init__(n_var=DIMENSION, n_obj=1, xl=0.0, xu=1.0)
            self.counted = counted

        def _evaluate(self, points, out, *_args, **_kwargs):
            out["F"] = self.counted(points)[:, None]

    def solve(counted: Counted, seed: int) -> None:
        swarm = PSO(
            pop_size=60,
            w=0.729,
            c1=acceleration,
            c2=acceleration,
            max_velocity_rate=0.3,
            initial_velocity="random",
            adaptive=False,
            pertube_best=False,
        )
        swarm.setup(Box(counted), seed=seed, termination=("n_gen", counted.most))
        while counted.count < counted.most:
            swarm.next()

    return solve


def library_cma_es(restarts: bool) -> Solver:
    """Return the library's own loop, with the values themselves."""

    def solve(counted: Counted, seed: int) -> None:
        bounds = np.tile([0.0, 1.0], (DIMENSION, 1))
        stream = np.random.default_rng(seed)
        optimizer = cmaes.CMA(np.full(DIMENSION, 0.5), 0.3, bounds, seed=seed)
        while counted.count < counted.most:
            points = np.array([optimizer.ask() for _ in range(optimizer.population_size)])
            optimizer.tell(list(zip(points, counted(points), strict=True)))
            if restarts and optimizer.should_stop():
                size = 2 * optimizer.population_size
                mean = stream.random(DIMENSION)
                optimizer = cmaes.CMA(mean, 0.3, bounds, seed=seed + counted.count, population_size=size)

    return solve


@dataclass(frozen=True)
class Pair:
    """One of our algorithms and a library's, with the evaluations that each may take."""

    most: int
    ours: Solver
    peer_name: str
    peer: Solver


PAIRS = {
    "`real_coded_ga`": Pair(60_000, ours(kind="real_coded_ga", spread=1.0), "DEAP", deap_ga),
    "`pso`": Pair(60_000, ours(kind="pso"), "pymoo", pymoo_pso(2.05)),
    "`pso`, `constricts: all`": Pair(60_000, ours(kind="pso", constricts="all"), "pymoo", pymoo_pso(0.729 * 2.05)),
    "`cma_es`": Pair(10_000, ours(kind="cma_es"), "cmaes", library_cma_es(False)),
    "`cma_es`, `restarts: ipop`": Pair(60_000, ours(kind="cma_es", restarts="ipop"), "cmaes", library_cma_es(True)),
}


def runs(solver: Solver, problem: Problem, most: int, seeds: range = SEEDS) -> list[Counted]:
    """Return what became of a search from each seed."""
    found = []
    for seed in seeds:
        counted = Counted(problem, most)
        with suppress(Solved):
            solver(counted, seed)
        found.append(counted)
    return found


def solved(searches: list[Counted]) -> list[int]:
    """Return the evaluations that each solved search took."""
    return [search.count for search in searches if search.best <= search.problem.target]


def cell(searches: list[Counted]) -> str:
    """Return rate, evaluations of the solved, and the median of the best values."""
    counts = solved(searches)
    took = f"{median(counts):.0f}" if counts else "–"
    return f"{len(counts)}/{len(searches)} ({took}; {median(search.best for search in searches):.2g})"


def main(words: list[str]) -> None:
    """Print a Markdown table."""
    print(f"| algorithm | | {' | '.join(f'{one.name} ≤ {one.target:g}' for one in PROBLEMS)} |")  # noqa: T201
    print("|---|---|" + "---|" * len(PROBLEMS))  # noqa: T201
    for name, pair in PAIRS.items():
        if words and not any(word in name for word in words):
            continue
        for label, solver in (("neuromech", pair.ours), (pair.peer_name, pair.peer)):
            cells = " | ".join(cell(runs(solver, problem, pair.most)) for problem in PROBLEMS)
            print(f"| {name}, {pair.most} | {label} | {cells} |", flush=True)  # noqa: T201


if __name__ == "__main__":
    main(sys.argv[1:])
