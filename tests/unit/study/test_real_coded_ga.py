"""The real-coded GA of thesis A 2.4, against what its text and figure 2-22 say."""

import numpy as np
import pytest

from neuromech.study.algorithms.real_coded_ga import (
    RealCodedGa,
    RealCodedGaSettings,
    blend,
    crossing_loci,
    roulette_pairs,
    roulette_weights,
)
from neuromech.study.score import Score

MANY = 200_000


def random():
    return np.random.default_rng(7)


def ga(dimension=3, start=None, **settings):
    return RealCodedGa(RealCodedGaSettings(**settings), dimension, 0, start)


def test_defaults_are_those_of_the_thesis():
    settings = RealCodedGaSettings()
    assert (settings.population, settings.elites) == (300, 2)
    assert (settings.crossover_rate, settings.locus_rate, settings.expansion) == (1.0, 0.3, 2.0)
    assert settings.alpha == 0.5


@pytest.mark.parametrize(
    ("first", "second", "alpha", "least", "most"),
    [
        (0.4, 0.6, 0.5, 0.3, 0.7),  # twice as wide, around the same middle
        (0.6, 0.4, 0.5, 0.3, 0.7),
        (0.4, 0.6, 0.0, 0.4, 0.6),
        (0.45, 0.5, 2.0, 0.35, 0.6),
        (0.1, 0.7, 0.5, 0.0, 1.0),  # -0.2 … 1.0, cut to the bounds
        (0.8, 0.9, 0.5, 0.75, 0.95),
        (0.5, 0.5, 0.5, 0.5, 0.5),
    ],
)
def test_blx_alpha_draws_uniformly_from_exactly_its_interval(first, second, alpha, least, most):
    drawn = blend(np.full((MANY, 1), first), np.full((MANY, 1), second), alpha, random())
    width = most - least
    assert drawn.min() >= least - 1e-15
    assert drawn.max() <= most + 1e-15
    assert drawn.min() <= least + 1e-4 * width + 1e-15
    assert drawn.max() >= most - 1e-4 * width - 1e-15
    for share in (0.25, 0.5, 0.75):
        assert (drawn < least + share * width).mean() == pytest.approx(share if width else 0.0, abs=5e-3)


def test_each_locus_crosses_with_its_rate_and_one_of_each_child_at_least():
    loci = crossing_loci((MANY, 20), 0.3, random())
    assert loci.mean(axis=0) == pytest.approx(np.full(20, 0.3), abs=5e-3)
    rare = crossing_loci((MANY, 4), 0.0, random())
    assert (rare.sum(axis=1) == 1).all()
    assert rare.mean(axis=0) == pytest.approx(np.full(4, 0.25), abs=5e-3)


def test_roulette_draws_in_proportion_to_the_scores():
    scores = (Score(0, 1.0), Score(0, 0.0), Score(0, 3.0), None, Score(0, 6.0))
    weights = roulette_weights(scores)
    assert weights / weights.sum() == pytest.approx([0.1, 0.0, 0.3, 0.0, 0.6])
    pairs = roulette_pairs(weights, np.array([0, 1, 2, 4]), 20_000, random())
    shares = np.bincount(pairs[:, 0], minlength=5) / len(pairs)
    assert shares == pytest.approx([0.1, 0.0, 0.3, 0.0, 0.6], abs=0.015)
    after_best = np.bincount(pairs[pairs[:, 0] == 4, 1], minlength=5)
    assert after_best / after_best.sum() == pytest.approx([0.25, 0.0, 0.75, 0.0, 0.0], abs=0.02)
    assert (pairs[:, 0] != pairs[:, 1]).all()


@pytest.mark.parametrize(
    ("scores", "expected"),
    [
        ([(0, 2.0), (0, 4.0)], [1.0, 2.0]),
        ([(3, 2.0), (3, 4.0)], [1.0, 2.0]),
        ([(0, -4.0), (0, -1.0), None], [0.0, 3.0, 0.0]),
        ([(0, 1.0), (0, 3.0), (1, 0.0), (1, 2.0)], [1.0, 3.0, 3.0, 5.0]),
        ([(1, 5.0), (0, -2.0), (0, 2.0), None], [9.0, 0.0, 4.0, 0.0]),
        ([(0, 0.0), (0, 0.0)], [0.0, 0.0]),
        ([None, None], [0.0, 0.0]),
        ([(0, 1e308), (0, -1e308)], [2.0, 0.0]),
    ],
)
def test_weights_of_stages_and_negative_scores(scores, expected):
    weights = roulette_weights(tuple(None if score is None else Score(*score) for score in scores))
    largest = max(expected) or 1.0
    assert weights / (weights.max() or 1.0) == pytest.approx(np.array(expected) / largest)


def test_those_without_weight_are_equally_likely():
    pairs = roulette_pairs(np.array([0.0, 5.0, 0.0, 0.0]), np.array([0, 1, 3]), 10_000, random())
    assert (pairs[:, 0] == 1).all()
    assert (pairs[:, 1] == 0).mean() == pytest.approx(0.5, abs=0.02)
    assert set(pairs[:, 1]) == {0, 3}


def test_individuals_begin_around_the_documents_values_and_within_the_bounds():
    points = ga(start=np.array([0.5, 0.05, 1.0]), population=2000, spread=0.2).ask()
    assert points.min(axis=0) == pytest.approx([0.3, 0.0, 0.8], abs=1e-3)
    assert points.max(axis=0) == pytest.approx([0.7, 0.25, 1.0], abs=1e-3)
    anywhere = ga(population=2000).ask()
    assert (anywhere.min(), anywhere.max()) == pytest.approx((0.0, 1.0), abs=1e-3)


def test_children_come_from_the_boxes_of_scored_parents():
    search = ga(dimension=2, population=40, elites=0, spread=1.0)
    points = search.ask()
    search.tell([Score(0, 1.0) if index in (3, 8) else None for index in range(40)])
    children = search.ask()
    low, high = points[[3, 8]].min(axis=0), points[[3, 8]].max(axis=0)
    margin = (high - low) / 2.0
    assert (children >= np.maximum(low - margin, 0.0)).all()
    assert (children <= np.minimum(high + margin, 1.0)).all()
    assert len(np.unique(children, axis=0)) == 40


def test_a_pair_that_does_not_cross_has_the_first_parent_as_child():
    search = ga(population=20, crossover_rate=0.0)
    points = search.ask()
    search.tell([Score(0, 1.0)] * 20)
    assert all((points == child).all(axis=1).any() for child in search.ask())


@pytest.mark.parametrize("alive", [0, 1])
def test_without_a_pair_new_individuals_are_drawn(alive):
    search = ga(start=np.full(3, 0.5), population=20, spread=0.1)
    points = search.ask()
    search.tell([Score(0, 1.0) if index == 5 and alive else None for index in range(20)])
    fresh = search.ask()
    assert (fresh[0] == points[5]).all() == bool(alive)
    assert len(np.unique(np.concatenate([points, fresh[alive:]]), axis=0)) == 40 - alive
    assert ((fresh >= 0.4) & (fresh <= 0.6)).all()
