"""Particle swarm optimisation against equations 2.45 and 2.46 of thesis B, computed by hand."""

import numpy as np
import pytest
from numpy.random import SeedSequence

from neuromech.study.algorithms.pso import Pso, PsoSettings
from neuromech.study.score import Score


def swarm(dimension=2, seed=0, start=None, **settings):
    return Pso(PsoSettings(**settings), dimension, seed, start)


def put(search, points, velocities):
    """Place the particles, without best places so far."""
    state = search.state()
    state["points"] = points
    state["memory"] |= {"velocities": velocities, "best_points": points, "best_scores": [None] * len(points)}
    search.restore(state)


def drawn(search, generation, shape):
    stream = np.random.default_rng(SeedSequence(search.seed, spawn_key=(generation,)))
    return stream.random(shape), stream.random(shape)


def test_defaults_are_those_of_the_thesis():
    settings = PsoSettings()
    assert settings.population == 60
    assert (settings.inertia, settings.cognitive, settings.social) == (0.729, 2.05, 2.05)
    assert settings.maximum_velocity == 0.3


@pytest.mark.parametrize(("constricts", "factor"), [("velocity", 1.0), ("all", 0.729)])
def test_two_steps_are_the_equations(constricts, factor):
    search = swarm(population=2, constricts=constricts)
    points = np.array([[0.4, 0.5], [0.45, 0.52]])
    velocities = np.array([[0.01, -0.02], [0.0, 0.03]])
    put(search, points.tolist(), velocities.tolist())
    search.tell([Score(0, 1.0), Score(0, 2.0)])
    own, swarm_best = points.copy(), points[1]
    r1, r2 = drawn(search, 1, points.shape)
    velocities = 0.729 * velocities + factor * (2.05 * r1 * (own - points) + 2.05 * r2 * (swarm_best - points))
    points = points + velocities
    assert search.ask() == pytest.approx(points, abs=1e-15)
    search.tell([Score(0, 0.5), Score(0, 3.0)])
    own[1] = swarm_best = points[1].copy()
    r1, r2 = drawn(search, 2, points.shape)
    velocities = 0.729 * velocities + factor * (2.05 * r1 * (own - points) + 2.05 * r2 * (swarm_best - points))
    assert np.abs(velocities).max() < 0.3
    assert search.ask() == pytest.approx(points + velocities, abs=1e-15)


def test_a_particle_alone_coasts_and_slows_down():
    search = swarm(population=1, dimension=1, cognitive=0, social=0)
    put(search, [[0.2]], [[0.1]])
    for expected in (0.2 + 0.0729, 0.2 + 0.0729 + 0.729 * 0.0729):
        search.tell([Score(0, 1.0)])
        assert search.ask()[0, 0] == pytest.approx(expected, abs=1e-15)


def test_without_inertia_and_pull_nothing_moves():
    search = swarm(population=5, inertia=0, cognitive=0, social=0)
    points = search.ask()
    search.tell([Score(0, float(index)) for index in range(5)])
    assert np.array_equal(search.ask(), points)


def test_velocity_is_limited_in_each_component():
    search = swarm(population=2, inertia=1, cognitive=0, social=0, maximum_velocity=0.05)
    put(search, [[0.5, 0.5], [0.5, 0.5]], [[0.2, 0.01], [-0.2, -0.04]])
    search.tell([Score(0, 0.0)] * 2)
    assert search.ask() == pytest.approx(np.array([[0.55, 0.51], [0.45, 0.46]]), abs=1e-15)
    assert np.abs(search.state()["memory"]["velocities"]).max() == 0.05


def test_particles_begin_anywhere_with_velocities_within_the_limit():
    search = swarm(population=5000, start=np.array([0.3, 0.8]))
    velocities = np.array(search.state()["memory"]["velocities"])
    assert (velocities.min(), velocities.max()) == pytest.approx((-0.3, 0.3), abs=1e-3)
    assert search.ask()[0].tolist() == [0.3, 0.8]
    assert search.ask()[1:].mean(axis=0) == pytest.approx([0.5, 0.5], abs=0.02)


def test_a_particle_stops_at_the_bound_and_slides_along_it():
    search = swarm(population=1, inertia=1, cognitive=0, social=0)
    put(search, [[0.95, 0.5]], [[0.2, 0.1]])
    search.tell([Score(0, 0.0)])
    assert search.ask()[0].tolist() == [1.0, 0.6]
    assert search.state()["memory"]["velocities"] == [[0.0, 0.1]]


def test_failed_candidates_are_never_a_best_place():
    search = swarm(population=3)
    search.tell([None, None, None])
    assert search.state()["memory"]["best_scores"] == [None, None, None]
    points = search.ask()
    search.tell([None, Score(0, -5.0), None])
    memory = search.state()["memory"]
    assert memory["best_scores"] == [None, [0, -5.0], None]
    assert memory["best_points"][1] == points[1].tolist()


def test_a_later_stage_beats_every_value_of_an_earlier_one():
    search = swarm(population=2)
    search.tell([Score(0, 1e6), Score(0, 2.0)])
    points = search.ask()
    search.tell([Score(1, -3.0), Score(0, 1.0)])
    memory = search.state()["memory"]
    assert memory["best_scores"] == [[1, -3.0], [0, 2.0]]
    assert memory["best_points"][0] == points[0].tolist()
    search.tell([Score(0, 1e9), Score(1, -4.0)])
    assert search.state()["memory"]["best_scores"] == [[1, -3.0], [1, -4.0]]


def test_all_are_drawn_to_the_best_of_the_swarm_and_not_to_equals_that_came_later():
    search = swarm(population=2, dimension=1, inertia=0, cognitive=0, social=2)
    put(search, [[0.4], [0.5]], [[0.0], [0.0]])
    search.tell([Score(0, 1.0), Score(0, 1.0)])
    moved = search.ask()
    assert moved[0, 0] == 0.4
    assert 0.3 <= moved[1, 0] < 0.5
