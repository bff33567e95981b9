"""Kinds and settings of algorithms as a document writes them."""

import pytest

from neuromech.errors import DocumentError, Mark
from neuromech.study.algorithms import catalogue as module
from neuromech.study.algorithms.catalogue import AlgorithmCatalogue
from neuromech.study.algorithms.pso import Pso, PsoSettings
from neuromech.study.score import Score, ranks

CATALOGUE = AlgorithmCatalogue.installed()


@pytest.mark.parametrize(
    ("written", "said"),
    [
        ({}, ["study.algorithm  'kind' is missing. Hint: allowed: cma_es, pso, real_coded_ga"]),
        (
            {"kind": "csa_es"},
            ["study.algorithm.kind  is no algorithm (got 'csa_es'). Hint: did you mean 'cma_es'?"],
        ),
        ({"kind": 3}, ["study.algorithm.kind  is no algorithm (got 3). Hint: allowed: cma_es, pso, real_coded_ga"]),
        (
            {"kind": "pso", "populatoin": 3},
            ["study.algorithm.populatoin  is not known here. Hint: did you mean 'population'?"],
        ),
        (
            {"kind": "pso", "population": 0, "constricts": "none", "inertia": "3 mm"},
            [
                "study.algorithm.constricts  must be one of velocity, all (got 'none').",
                "study.algorithm.inertia  must be a number without a unit (got '3 mm'). "
                "Hint: write a bare number, for example 1.0",
                "study.algorithm.population  must be at least 1 (got 0).",
            ],
        ),
        ({"kind": "pso", "population": 3.5}, ["study.algorithm.population  must be a whole number (got 3.5)."]),
        ({"kind": "pso", "population": True}, ["study.algorithm.population  must be a whole number (got true)."]),
        ({"kind": "pso", "population": None}, ["study.algorithm.population  must be a whole number (got nothing)."]),
        ({"kind": "pso", "social": -1}, ["study.algorithm.social  must be at least 0 (got -1)."]),
        ({"kind": "cma_es", "step": 0}, ["study.algorithm.step  must be greater than 0 (got 0)."]),
        ({"kind": "cma_es", "step": "150 %"}, ["study.algorithm.step  must be at most 1 (got 150 %)."]),
        (
            {"kind": "real_coded_ga", "population": 5, "elites": 5},
            ["study.algorithm.elites  must be fewer than the individuals of the population (got 5)."],
        ),
        (
            {"kind": "real_coded_ga", "expansion": 0.5},
            ["study.algorithm.expansion  must be at least 1 (got 0.5)."],
        ),
    ],
)
def test_wrong_settings_are_told_all_at_once(written, said):
    with pytest.raises(DocumentError) as caught:
        CATALOGUE.settings(written)
    assert sorted(str(problem) for problem in caught.value.problems) == said


def test_problems_have_their_position():
    marks = {"study.algorithm.populatoin": Mark("a.yaml", 3, 7)}
    with pytest.raises(DocumentError, match=r"^a\.yaml:3:7  study\.algorithm\.populatoin  is not known here"):
        CATALOGUE.settings({"kind": "pso", "populatoin": 3}, mark=marks.get)


def test_settings_choose_the_algorithm():
    search = CATALOGUE.create(CATALOGUE.settings({"kind": "pso", "population": 7, "inertia": "50 %"}), 3, 0)
    assert isinstance(search, Pso)
    assert search.ask().shape == (7, 3)
    assert search.settings.inertia == 0.5


def test_a_kind_belongs_to_one_class():
    with pytest.raises(ValueError, match="two algorithms claim the kind 'pso': Pso and Other"):
        AlgorithmCatalogue([Pso, type("Other", (Pso,), {})])


def test_installed_plug_ins_join(monkeypatch):
    class FastSettings(PsoSettings):
        kind: module.Any = "fast"

    class Point:
        def load(self):
            return Fast

    class Fast(Pso):
        settings_type = FastSettings

        @classmethod
        def kind_name(cls):
            return "fast"

    monkeypatch.setattr(module, "entry_points", lambda group: [Point()] if group == "neuromech.algorithms" else [])
    assert AlgorithmCatalogue.installed().kinds() == ("cma_es", "fast", "pso", "real_coded_ga")


@pytest.mark.parametrize("value", [float("nan"), float("inf"), -float("inf")])
def test_a_score_is_finite(value):
    with pytest.raises(ValueError, match="finite"):
        Score(0, value)


def test_a_stage_counts_from_zero():
    with pytest.raises(ValueError, match="counts from 0"):
        Score(-1, 0.0)


def test_ranks_put_stages_first_equals_together_and_failures_last():
    scores = [Score(0, 9.0), None, Score(1, -2.0), Score(0, 9.0), Score(1, -1.0), None]
    assert ranks(scores) == [2, 3, 1, 2, 0, 3]
