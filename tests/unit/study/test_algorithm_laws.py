"""The algorithms of this package keep the laws of `neuromech.testing.algorithms`; the laws catch what breaks them."""

from typing import Literal

import numpy as np
import pytest

from neuromech.study.algorithms.base import Generational, Settings
from neuromech.study.algorithms.catalogue import AlgorithmCatalogue
from neuromech.testing import algorithms as laws

CATALOGUE = AlgorithmCatalogue.installed()


def maker(dimension=4, start=None, **written):
    settings = CATALOGUE.settings(written)
    return lambda seed: CATALOGUE.create(settings, dimension, seed, start)


MAKERS = {
    "real_coded_ga": maker(kind="real_coded_ga", population=30),
    "real_coded_ga_in_one_dimension": maker(1, kind="real_coded_ga", population=12, spread=1.0),
    "real_coded_ga_from_a_corner": maker(3, np.array([0.0, 1.0, 0.95]), kind="real_coded_ga", population=40, spread=1),
    "pso": maker(kind="pso", population=20, constricts="all"),
    "pso_from_the_start": maker(5, np.full(5, 0.1), kind="pso", population=30, constricts="all"),
    "cma_es": maker(kind="cma_es"),
    "cma_es_from_a_corner": maker(3, np.array([0.0, 1.0, 0.3]), kind="cma_es", population=9),
    "cma_es_separable": maker(kind="cma_es", covariance="separable"),
    "cma_es_separable_in_one_dimension": maker(1, kind="cma_es", covariance="separable"),
    "cma_es_separable_from_a_corner": maker(
        3, np.array([0.0, 1.0, 0.3]), kind="cma_es", population=9, covariance="separable", restarts="ipop"
    ),
    "cma_es_with_restarts": maker(3, kind="cma_es", population=4, restarts="ipop"),
}
EACH = pytest.mark.parametrize("make", MAKERS.values(), ids=MAKERS)


@EACH
@pytest.mark.parametrize("law", laws.ALL, ids=lambda law: law.__name__)
def test_algorithms_keep_the_laws(law, make):
    law(make)


@pytest.mark.parametrize("name", ["pso", "cma_es", "cma_es_separable"])
def test_only_the_order_of_scores_matters(name):
    laws.only_the_order_matters(MAKERS[name])


def test_elites_are_carried_over():
    laws.best_are_carried_over(MAKERS["real_coded_ga"], elites=2)


class RandomSettings(Settings):
    kind: Literal["random"] = "random"


class RandomSearch(Generational):
    """Anywhere, always: keeps every law but those that need a search."""

    settings_type = RandomSettings

    def first(self, random):
        return random.random((6, self.dimension))

    def advance(self, points, scores, random):
        return self.first(random)


class Outside(RandomSearch):
    def first(self, random):
        return 1.1 * random.random((6, self.dimension))


class Exposed(RandomSearch):
    def ask(self):
        return self._points


class Forgetful(RandomSearch):
    def state(self):
        return super().state() | {"generation": 0}


class Global(RandomSearch):
    def first(self, random):
        return np.random.random((6, self.dimension))


class Undefined(RandomSearch):
    def memory(self):
        return {"value": float("nan")}


class Tolerant(RandomSearch):
    def tell(self, scores):
        super().tell([None] * len(self._points))


class ValueBased(RandomSearch):
    def advance(self, points, scores, random):
        values = np.array([0.0 if score is None else score.value for score in scores])
        return np.clip(points + 0.01 * values[:, None], 0.0, 1.0)


@pytest.mark.parametrize(
    ("cls", "law"),
    [
        (RandomSearch, laws.it_gets_better),
        (RandomSearch, lambda make: laws.best_are_carried_over(make, elites=1)),
        (Outside, laws.candidates_stay_inside),
        (Exposed, laws.asking_again_changes_nothing),
        (Forgetful, laws.state_goes_on_exactly),
        (Global, laws.seed_decides),
        (Undefined, laws.state_goes_on_exactly),
        (Tolerant, laws.wrong_number_of_scores_is_refused),
        (ValueBased, laws.only_the_order_matters),
    ],
)
def test_the_laws_catch(cls, law):
    with pytest.raises((AssertionError, ValueError)):
        law(lambda seed: cls(RandomSettings(), 3, seed, None))


def test_a_sound_random_search_keeps_what_it_can():
    for law in (laws.candidates_stay_inside, laws.asking_again_changes_nothing, laws.state_goes_on_exactly):
        law(lambda seed: RandomSearch(RandomSettings(), 3, seed, None))
