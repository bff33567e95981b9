"""Laws of a difference: nothing from a model to itself, mirrored the other way round, everything that was changed."""

import json

import pytest
from legs import RG, synapse, to_document

from neuromech.graph.build import build
from neuromech.graph.diff import Change, Difference, Item, diff


def stiffen(raw):
    raw["instances"]["LF"]["muscles"]["flexor"]["maximal_force"] = "60 N"


def slow_down(raw):
    raw["instances"]["LF"]["network"]["synapses"]["excitatory"]["RG-F"]["Mn-F"]["delay"] = "5 ms"


def exchange(raw):
    raw["instances"]["RF"]["network"]["neurons"]["In-F"] = {"kind": "rate_neuron", "time_constant": "10 ms"}


def lame(raw):
    del raw["instances"]["RF"]
    raw["network"]["synapses"] = {}


def invert(raw):
    network = raw["instances"]["LF"]["network"]["synapses"]
    network["excitatory"]["brain"].pop("RG-E")
    network["inhibitory"]["brain"] = {"RG-E": synapse("inhibitory")}


def float_away(raw):
    raw["world"] = {"gravity": "0 m/s^2", "ground": {"height": "-1 m"}}
    raw["body"]["root"]["kind"] = "planar"
    raw["protocol"]["duration"] = "2 s"
    raw["solver"] = {"method": "exponential_euler"}
    raw["parameters"] = {"drive": {"value": 2.05}}


CHANGES = [stiffen, slow_down, exchange, lame, invert, float_away]


def graph_after(*changes):
    from legs import QUADRUPED_HALF

    raw = json.loads(json.dumps(QUADRUPED_HALF))
    for change in changes:
        change(raw)
    return build(to_document(raw))


def test_nothing_differs_between_a_model_and_itself():
    assert diff(graph_after(), graph_after()) == Difference((), (), ())


@pytest.mark.parametrize("change", CHANGES)
def test_the_way_back_mirrors_the_way_there(change):
    there = diff(graph_after(), graph_after(change))
    assert not there.is_empty
    assert diff(graph_after(change), graph_after()) == there.mirrored()


def test_a_parameter_is_shown_in_the_unit_of_its_field():
    assert diff(graph_after(), graph_after(stiffen, slow_down)).changed == (
        Change("instances.LF.muscles.flexor.maximal_force", "50 N", "60 N"),
        Change("instances.LF.network.synapses.excitatory.RG-F.Mn-F.delay", "2 ms", "5 ms"),
    )


def test_the_same_value_in_another_unit_is_no_difference(raw, graph):
    raw["instances"]["LF"]["network"]["neurons"]["RG-F"]["maximal_inactivation_time"] = "0.3 s"
    assert diff(graph_after(), graph(raw)).is_empty


def test_another_kind_is_one_change_not_a_list_of_parameters():
    assert diff(graph_after(), graph_after(exchange)) == Difference(
        (), (), (Change("instances.RF.network.neurons.In-F.kind", "rybak_interneuron", "rate_neuron"),)
    )


def test_a_synapse_of_another_sign_is_another_synapse():
    assert diff(graph_after(), graph_after(invert)) == Difference(
        (Item("synapse", "brain → LF.RG-E", "excitatory"),), (Item("synapse", "brain → LF.RG-E", "inhibitory"),), ()
    )


def test_settings_of_the_document_are_compared():
    assert str(diff(graph_after(), graph_after(float_away))) == (
        "~ body.root.kind: free → planar\n"
        "~ parameters.drive.description: – → \n"
        "~ parameters.drive.source: – → \n"
        "~ parameters.drive.value: – → 2.05\n"
        "~ protocol.duration: 1000 ms → 2000 ms\n"
        "~ solver.method: rk4 → exponential_euler\n"
        "~ world.gravity: 9.81 m/s^2 → 0 m/s^2"
    )


def test_an_added_neuron_comes_with_its_synapses(raw, graph):
    raw["network"]["neurons"] = {"RG": RG}
    raw["network"]["synapses"]["excitatory"] = {"RG": {"LF.In-F": synapse("excitatory")}}
    assert [str(item) for item in diff(graph_after(), graph(raw)).added] == [
        "neuron RG (rybak_neuron)",
        "synapse RG → LF.In-F (excitatory)",
    ]
