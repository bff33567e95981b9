"""Our search algorithms solve the usual problems as often as docs/studies.md says."""

import math

import pytest
from search_rates import PAIRS, PROBLEMS, cell, runs, solved

SPHERE, ROSENBROCK, RASTRIGIN = PROBLEMS


@pytest.mark.parametrize("name", PAIRS)
def test_both_sides_of_a_pair_search(name):
    pair = PAIRS[name]
    for solver in (pair.ours, pair.peer):
        (short,) = runs(solver, SPHERE, 300, range(1))
        (longer,) = runs(solver, SPHERE, 2400, range(1))
        assert short.count >= 300
        assert longer.best < short.best < math.inf


def test_what_is_solved_is_counted():
    pair = PAIRS["`cma_es`"]
    searches = runs(pair.ours, SPHERE, 2000, range(3))
    assert len(solved(searches)) == 3
    assert cell(searches).startswith("3/3 (")
    assert cell(runs(pair.ours, SPHERE, 50, range(2))).startswith("0/2 (–; ")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "problem", "least"),
    [
        ("`real_coded_ga`", SPHERE, 18),
        ("`pso`", SPHERE, 20),
        ("`pso`, `constricts: all`", SPHERE, 20),
        ("`pso`, `constricts: all`", ROSENBROCK, 15),
        ("`cma_es`", SPHERE, 20),
        ("`cma_es`", ROSENBROCK, 16),
        ("`cma_es`, `restarts: ipop`", RASTRIGIN, 4),
    ],
)
def test_our_rates_are_not_below_those_of_the_table(name, problem, least):
    pair = PAIRS[name]
    assert len(solved(runs(pair.ours, problem, pair.most))) >= least
