"""Which points a sweep has, in which order runs visit them, and which values they have."""

from itertools import pairwise

import pytest

from neuromech.spec.sweep import Sweep, Varied, WithinOneRun
from neuromech.spec.sweep_rules import points
from neuromech.study.sweeps.design import Axis, Design
from neuromech.units import quantity

THREE = {"a": Varied(values=(1, 2)), "b": Varied(values=(3, 4, 5)), "c": Varied(values=("6 ms", "7 ms"))}
HELD = WithinOneRun(every=quantity("1 s"), settle=quantity("0.5 s"))


def sweep(**keys):
    return Sweep(**{"vary": THREE, "measures": {"m": {"kind": "mean"}}} | keys)


@pytest.mark.parametrize(
    ("keys", "blocks", "count"),
    [
        ({}, {"": ("a", "b", "c")}, 12),
        ({"design": "one_at_a_time"}, {"a": ("a",), "b": ("b",), "c": ("c",)}, 7),
        ({"design": "pairs"}, {"a and b": ("a", "b"), "a and c": ("a", "c"), "b and c": ("b", "c")}, 16),
        ({"design": "pairs", "for_each": {"f": Varied(values=(1, 2, 3))}}, None, 48),
        ({"design": "one_at_a_time", "for_each": {"f": Varied(values=(1, 2))}, "seeds": 5}, None, 70),
    ],
)
def test_every_point_is_visited_exactly_once(keys, blocks, count):
    for held in (None, HELD):
        one = sweep(**keys, within_one_run=held)
        design = Design.of(one)
        visited = [point for job in design.jobs() for point in job.points]
        assert len(visited) == len(set(visited)) == design.size() == count == points(one) * one.seeds
        if blocks is not None:
            assert {block.name: tuple(axis.name for axis in block.axes) for block in design.blocks} == blocks


def test_the_outer_parameters_stand_first_and_the_others_keep_their_own_value():
    design = Design.of(sweep(design="pairs", for_each={"f": Varied(values=(8, 9))}))
    block = design.blocks[2]
    assert block.name == "b and c"
    assert block.shape == (2, 3, 2)
    assert block.parameters((1, 2, 0)) == {"f": "9", "b": "5", "c": "6 ms"}


def test_runs_are_points_in_the_order_of_writing_unless_the_sweep_goes_on_within_a_run():
    jobs = Design.of(sweep(vary={"a": THREE["a"], "b": THREE["b"]}, seeds=2)).jobs()
    places = [(job.points[0].repetition, *job.points[0].position) for job in jobs]
    assert places == sorted(places)
    assert [job.number for job in jobs] == list(range(12))
    assert {len(job.points) for job in jobs} == {1}


def test_within_a_run_only_one_parameter_moves_and_by_one_step():
    design = Design.of(sweep(within_one_run=HELD, for_each={"f": Varied(values=(8, 9))}))
    jobs = design.jobs()
    assert len(jobs) == 2
    for job in jobs:
        assert len({point.position[0] for point in job.points}) == 1
        for before, after in pairwise(job.points):
            moved = [abs(new - old) for old, new in zip(before.position, after.position, strict=True)]
            assert sum(moved) == 1


@pytest.mark.parametrize(
    ("varied", "texts", "values", "unit"),
    [
        ({"range": (1.0, 2.5), "count": 4}, ("1.0", "1.5", "2.0", "2.5"), (1.0, 1.5, 2.0, 2.5), ""),
        ({"range": ("0.1 mV", "0.3 mV"), "count": 3}, ("0.1 mV", "0.2 mV", "0.3 mV"), (0.1, 0.2, 0.3), "mV"),
        ({"range": ("5 ms", "0.003 s"), "count": 3}, ("5 ms", "4.0 ms", "0.003 s"), (5.0, 4.0, 3.0), "ms"),
        ({"range": (1, 100), "count": 3, "scale": "log"}, ("1", "10.0", "100"), (1.0, 10.0, 100.0), ""),
        ({"values": (3, 1, "20 %")}, ("3", "1", "20 %"), (3.0, 1.0, 0.2), ""),
    ],
)
def test_values_are_round_and_in_the_unit_of_the_first(varied, texts, values, unit):
    axis = Axis.of("a", Varied(**varied))
    assert axis.texts == texts
    assert axis.unit == unit
    assert axis.values == pytest.approx(values, rel=1e-15)
