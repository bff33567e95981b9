"""Laws of the graph: names resolve outwards, order doesn't matter, wrong names and wrong trees are told."""

import copy
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from legs import BRICK, RG, joint, synapse, to_document

from neuromech.components.catalogue import Catalogue
from neuromech.errors import DocumentError
from neuromech.graph.build import build
from neuromech.graph.tree import chain
from neuromech.spec.load import load


def problems(raw):
    with pytest.raises(DocumentError) as caught:
        build(to_document(raw))
    return [str(problem).split("  ", 1)[1] for problem in caught.value.problems]


def edges(graph):
    return sorted(
        (sender, receiver, one.kind, one.path, one.output, one.port) for sender, receiver, one in graph.connections()
    )


def test_every_reference_inside_the_elements_is_qualified(raw, graph):
    built = graph(raw)
    assert built.element("LF.flexor").spec.motoneuron == "LF.Mn-F"
    assert list(built.element("LF.flexor").spec.path.moment_arms) == ["LF.hip"]
    assert built.element("RF.foot").spec.segment == "RF.shank"
    assert (built.element("RF.hip").spec.parent, built.element("RF.hip").spec.child) == ("trunk", "RF.thigh")


def test_a_path_in_the_document_stands_at_each_element_and_connection(raw, graph):
    built = graph(raw)
    marks = built.document.marks
    assert all(element.path in marks for element in built.elements())
    assert all(connection.path in marks for _, _, connection in built.connections())


def test_the_own_scope_hides_the_outer_one(raw, graph):
    raw["network"]["neurons"] = {"In-F": RG}
    built = graph(raw)
    assert built.graph.has_edge("LF.RG-F", "LF.In-F")
    assert not built.graph.has_edge("LF.RG-F", "In-F")


def test_an_instance_inside_an_instance_sees_all_scopes_around_it(raw, graph):
    toe = {
        "network": {
            "neurons": {"N": RG},
            "synapses": {"excitatory": {"brain": {"N": synapse("excitatory")}, "RG-F": {"N": synapse("excitatory")}}},
        }
    }
    raw["instances"]["LF"]["instances"] = {"toe": toe}
    built = graph(raw)
    assert built.graph.has_edge("brain", "LF.toe.N")
    assert built.graph.has_edge("LF.RG-F", "LF.toe.N")
    assert built.element("LF.toe.N").path == "instances.LF.instances.toe.network.neurons.N"


def shuffled(value, random):
    if isinstance(value, dict):
        keys = list(value)
        random.shuffle(keys)
        return {key: shuffled(value[key], random) for key in keys}
    return value


@settings(max_examples=10, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.randoms(use_true_random=False))
def test_the_order_of_the_document_does_not_change_the_graph(raw, random):
    one = build(to_document(raw))
    other = build(to_document(shuffled(copy.deepcopy(raw), random)))
    assert {element.name: element for element in one.elements()} == {
        element.name: element for element in other.elements()
    }
    assert edges(one) == edges(other)
    assert one.body.segments == other.body.segments
    assert one.body.root_segment == other.body.root_segment


def test_parents_come_before_children_and_authored_order_is_kept_otherwise(raw, graph):
    leg = raw["instances"]["LF"]["body"]
    leg["segments"] = {"shank": BRICK, "thigh": BRICK}
    leg["joints"] = {name: leg["joints"][name] for name in ("knee", "hip")}
    body = graph(raw).body
    assert list(body.segments) == ["trunk", "LF.thigh", "LF.shank", "RF.thigh", "RF.shank"]
    assert list(body.joints) == ["LF.hip", "LF.knee", "RF.hip", "RF.knee"]


def test_the_chain_between_two_segments_goes_over_their_common_ancestor(raw, graph):
    body = graph(raw).body
    assert chain(body, "LF.shank", "RF.thigh") == ["LF.knee", "LF.hip", "RF.hip"]
    assert chain(body, "LF.shank", "LF.shank") == []


def test_dangling_synapse_and_its_hint(raw):
    raw["instances"]["LF"]["network"]["synapses"]["excitatory"]["RG-F"] = {"Mn_F": synapse("excitatory")}
    raw["network"]["synapses"]["interlimb"]["LF.RG-f"] = {"RF.RG-F": synapse("interlimb")}
    assert problems(raw) == [
        "network.synapses.interlimb.LF.RG-f  must name a neuron, a drive or a sensor (got 'LF.RG-f'). "
        "Hint: did you mean 'LF.RG-F'?",
        "instances.LF.network.synapses.excitatory.RG-F.Mn_F  must name a neuron (got 'Mn_F'). "
        "Hint: did you mean 'Mn-F'?",
    ]


def test_a_name_of_the_wrong_family_says_what_it_is(raw):
    raw["instances"]["LF"]["muscles"]["flexor"]["motoneuron"] = "hip"
    assert problems(raw) == [
        "instances.LF.muscles.flexor.motoneuron  must name a neuron (got 'hip', a joint). "
        "Hint: allowed: In-F, Mn-F, RF.In-F, RF.Mn-F, RF.RG-E, RF.RG-F, RG-E, RG-F"
    ]


def test_a_name_defined_twice_in_one_scope(raw):
    raw["network"]["neurons"] = {"trunk": RG, "LF": RG}
    assert problems(raw) == [
        "network.neurons.LF  the name 'LF' is defined twice in its scope, first by the instance at instances.LF. "
        "Hint: rename one of the two",
        "body.segments.trunk  the name 'trunk' is defined twice in its scope, first by the neuron at "
        "network.neurons.trunk. Hint: rename one of the two",
    ]


def test_a_body_with_two_roots(raw):
    raw["body"]["segments"]["head"] = BRICK
    assert problems(raw) == [
        "body.segments.head  is a second root beside 'trunk': it is the child of no joint. "
        "Hint: add the joint that holds it"
    ]


def test_a_segment_with_two_parents(raw):
    raw["body"]["joints"] = {"weld": joint("trunk", "LF.shank")}
    assert problems(raw) == [
        "instances.LF.body.joints.knee.child  gives a segment a second parent (got 'LF.shank', already the child of "
        "joint 'weld'). Hint: a body is a tree: each segment is the child of one joint"
    ]


def test_a_cycle_of_segments(raw):
    raw["instances"]["LF"]["body"]["joints"]["hip"]["parent"] = "shank"
    assert problems(raw) == [
        "instances.LF.body.joints.hip.parent  closes a cycle of segments, a body is a tree "
        "(got LF.thigh → LF.shank → LF.thigh)."
    ]


def test_parts_of_a_body_need_a_body(raw):
    del raw["body"]
    raw["instances"]["LF"]["body"]["joints"]["hip"]["parent"] = "shank"
    raw["instances"]["RF"]["body"]["joints"]["hip"]["parent"] = "shank"
    assert problems(raw) == [
        "instances.LF.body.segments.thigh  needs a body, and the document has none. "
        "Hint: add 'body:' to the document, with its engine and root"
    ]


def test_a_muscle_without_any_body_hears_that_there_is_no_joint(raw):
    del raw["body"]
    for leg in raw["instances"].values():
        del leg["body"]
        leg["sensors"] = {}
        leg["network"]["synapses"] = {}
    raw["instances"]["LF"]["muscles"] = {}
    assert problems(raw) == [
        f"instances.RF.muscles.flexor.path.{field}.hip  must name a joint (got 'hip'). Hint: the document has no joint"
        for field in ("reference_angles", "moment_arms")
    ]


def test_one_joint_under_two_spellings(raw):
    arms = raw["instances"]["LF"]["muscles"]["flexor"]["path"]["moment_arms"]
    arms["LF.hip"] = "3 mm"
    assert problems(raw) == [
        "instances.LF.muscles.flexor.path.moment_arms.LF.hip  gives a second value for joint 'LF.hip'."
    ]


INERTIAL = "<inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>"
URDF = f"""<robot name="leg">
  <link name="trunk">{INERTIAL}</link>
  <link name="thigh">{INERTIAL}</link>
  <joint name="hip" type="continuous">
    <parent link="trunk"/><child link="thigh"/><axis xyz="0 1 0"/>
  </joint>
</robot>"""


def test_a_body_file_stands_relative_to_the_document_that_names_it(tmp_path, monkeypatch):
    (tmp_path / "specs").mkdir()
    (tmp_path / "specs" / "leg.urdf").write_text(URDF)
    lines = ["neuromech: 1", "name: leg", "body: {file: leg.urdf}", "protocol: {duration: 1 s}"]
    lines += ["sensors: {bend: {kind: joint_sensor, joint: hip}}"]
    (tmp_path / "specs" / "leg.yaml").write_text("\n".join(lines))
    monkeypatch.chdir(tmp_path)
    built = build(load(Path("specs/leg.yaml"), catalogue=Catalogue.built_in()))
    assert built.body.root_segment == "trunk"
    assert built.graph.has_edge("hip", "bend")
    assert built.document.mark(built.element("hip").path).line == 3
