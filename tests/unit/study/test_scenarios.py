"""The runs of a candidate: scenarios, seeds and their weights."""

import pytest

from neuromech.pipeline import load_document
from neuromech.study.scenarios import Scenarios


@pytest.fixture
def scenarios(relaxing):
    def make(written=None, **study):
        return Scenarios.of(load_document(relaxing({"scenarios": written or {}, **study}), ["protocol.seed=7"]))

    return make


def test_without_scenarios_the_document_runs_once_with_its_own_seed(scenarios):
    found = scenarios()
    assert [(run.scenario, run.weight) for run in found.runs] == [("", 1.0)]
    assert found.seeds(0) == found.seeds(5) == (7,)
    assert found.overrides == {"": ()}


def test_drawn_seeds_are_common_to_scenarios_and_new_in_each_generation(scenarios):
    found = scenarios({"flat": {"seeds": 2}, "steep": {"set": {"protocol.duration": "0.1 s"}, "seeds": 2}})
    first, second = found.seeds(0), found.seeds(1)
    assert first[:2] == first[2:]
    assert first[0] != first[1]
    assert not set(first) & set(second)
    assert found.seeds(0) == first


def test_the_seed_of_the_study_decides_which_seeds_are_drawn(scenarios):
    written = {"flat": {"seeds": 1}}
    assert scenarios(written).seeds(0) != scenarios(written, seed=1).seeds(0)


def test_fixed_seeds_stay(scenarios):
    found = scenarios({"flat": {"seeds": 1, "fixed_seeds": [3, 9]}})
    assert found.seeds(4)[1:] == (3, 9)
    assert len(found.seeds(4)) == len(found.runs) == 3


def test_the_weight_of_a_scenario_is_shared_by_its_runs(scenarios):
    found = scenarios({"flat": {"seeds": 3, "weight": 3}, "steep": {"weight": 1}})
    assert found.weights == pytest.approx((0.25, 0.25, 0.25, 0.25))


def test_changes_are_written_as_on_the_command_line(scenarios):
    changes = {"network.neurons.second.bias": 0.5, "record.all.every": "2 ms"}
    assert scenarios({"other": {"set": changes}}).overrides == {
        "other": ("network.neurons.second.bias=0.5", "record.all.every=2 ms")
    }
