"""Each rule: an example that obeys it (the two legs of `legs.py`) and one that breaks it, with the exact message."""

from pathlib import Path
from typing import ClassVar, Literal

import pytest
from legs import MOTONEURON, RG, joint, muscle, synapse, to_document

from neuromech.components.base import Synapse
from neuromech.components.catalogue import Catalogue
from neuromech.errors import DocumentError
from neuromech.graph.build import build
from neuromech.graph.check import RULES, check
from neuromech.spec.load import load

STATIC = {"kind": "static_neuron"}


def messages(raw):
    with pytest.raises(DocumentError) as caught:
        check(build(to_document(raw)))
    return [str(problem) for problem in caught.value.problems]


def without_marks(raw):
    """Messages without `file:line:col`, which stand for themselves in one test of their own."""
    return [text.split("  ", 1)[1] for text in messages(raw)]


def test_two_good_legs_obey_every_rule(raw, graph):
    good = graph(raw)
    assert [problem for rule in RULES for problem in rule(good)] == []


def test_the_leg_that_broken_documents_extend_is_good():
    leg = Path(__file__).parents[2] / "invalid" / "parts" / "leg.yaml"
    check(build(load(leg, catalogue=Catalogue.built_in())))


def test_message_carries_the_position_of_the_value(raw):
    raw["instances"]["LF"]["body"]["joints"]["hip"]["initial_angle"] = "70 deg"
    path = "instances.LF.body.joints.hip.initial_angle"
    mark = to_document(raw).marks[path]
    assert messages(raw) == [
        f"leg.yaml:{mark.line}:1  {path}  is outside the joint's range of [-60 deg, 60 deg] (got 70 deg)."
    ]


def test_two_problems_come_together(raw):
    raw["world"] = {}
    raw["instances"]["LF"]["body"]["joints"]["hip"]["axis"] = [0, 0, 0]
    assert len(messages(raw)) == 3  # the axis and the foot of each leg


def test_a_wrong_name_does_not_hide_a_wrong_value(raw):
    raw["instances"]["LF"]["sensors"]["load"]["contact"] = "fot"
    raw["instances"]["LF"]["body"]["joints"]["hip"]["axis"] = [0, 0, 0]
    assert without_marks(raw) == [
        "instances.LF.sensors.load.contact  must name a contact (got 'fot'). Hint: did you mean 'foot'?",
        "instances.LF.body.joints.hip.axis  must have a direction (got [0, 0, 0]).",
    ]


def test_range_upside_down(raw):
    raw["instances"]["LF"]["body"]["joints"]["hip"]["range"] = ["60 deg", "-60 deg"]
    assert without_marks(raw) == [
        "instances.LF.body.joints.hip.range  must have its lower limit first and its upper limit second "
        "(got [60 deg, -60 deg])."
    ]


def test_rest_angle_outside_range_matters_only_to_a_spring(raw, graph):
    knee = raw["instances"]["LF"]["body"]["joints"]["knee"]
    knee.update(range=["-90 deg", "-5 deg"], initial_angle="-10 deg")
    check(graph(raw))
    knee["stiffness"] = "1 N m/rad"
    assert without_marks(raw) == [
        "instances.LF.body.joints.knee.rest_angle  is outside the joint's range of [-90 deg, -5 deg] (got 0 deg)."
    ]


def test_inertia_of_a_flat_plate_is_possible_and_more_is_not(raw, graph):
    thigh = raw["instances"]["LF"]["body"]["segments"]["thigh"]
    thigh["inertia"] = ["1 g m^2", "2 g m^2", "3 g m^2"]
    check(graph(raw))
    thigh["inertia"] = ["1 g m^2", "2 g m^2", "3.1 g m^2"]
    assert without_marks(raw) == [
        "instances.LF.body.segments.thigh.inertia  violates the triangle inequality: each moment is at most the sum "
        "of the two others (got [0.001, 0.002, 0.0031] kg m^2)."
    ]


def test_contact_without_ground(raw):
    raw["world"] = {}
    assert without_marks(raw) == [
        f"instances.{leg}.body.contacts.foot  can touch nothing: the world has no ground. "
        "Hint: add 'ground: {}' to 'world'"
        for leg in ("LF", "RF")
    ]


def test_delay_below_step(raw, graph):
    excited = raw["instances"]["LF"]["network"]["synapses"]["excitatory"]["RG-F"]
    excited["Mn-F"]["delay"] = "0.5 ms"
    check(graph(raw))
    excited["Mn-F"]["delay"] = "0.4 ms"
    assert without_marks(raw) == [
        "instances.LF.network.synapses.excitatory.RG-F.Mn-F.delay  must be zero or at least the solver's step of "
        "0.5 ms (got 0.4 ms). Hint: lengthen the delay or shorten solver.step"
    ]


def test_hinge_engine_moves_one_joint_without_contacts(raw):
    raw["body"]["engine"] = "hinge"
    assert without_marks(raw) == [
        *(
            f"instances.{leg}.body.contacts.foot  engine 'hinge' knows no contacts. "
            "Hint: use engine 'pybullet' or 'mujoco', or remove the contact"
            for leg in ("LF", "RF")
        ),
        "body.engine  needs exactly one hinge joint on a fixed root (got 4 joints (hinge, hinge, hinge, hinge) on a "
        "free root). Hint: engines 'pybullet' and 'mujoco' move any tree",
    ]


def test_the_same_synapse_from_two_scopes(raw):
    raw["network"]["synapses"]["excitatory"] = {"LF.RG-F": {"LF.In-F": synapse("excitatory", 3.0)}}
    assert without_marks(raw) == [
        "instances.LF.network.synapses.excitatory.RG-F.In-F  defines the excitatory synapse from 'LF.RG-F' to "
        "'LF.In-F' a second time. Hint: the first stands at network.synapses.excitatory.LF.RG-F.LF.In-F"
    ]


def test_parallel_synapses_of_two_kinds_are_two_synapses(raw, graph):
    raw["network"]["synapses"]["inhibitory"] = {"LF.RG-F": {"LF.In-F": synapse("inhibitory")}}
    check(graph(raw))


class Modulation(Synapse):
    kind: Literal["modulation"] = "modulation"
    port: ClassVar[str] = "gain"
    sign: ClassVar[Literal["excitatory"]] = "excitatory"
    source: ClassVar[str] = "an example of a component from elsewhere"


def test_a_synapse_into_a_port_that_the_neuron_lacks(raw):
    raw["network"]["synapses"]["modulation"] = {"LF.RG-F": {"LF.In-F": Modulation()}}
    assert without_marks(raw) == [
        "network.synapses.modulation.LF.RG-F.LF.In-F  needs the input port 'gain' of 'LF.In-F', which has none of that "
        "name. Hint: allowed: excitation, inhibition"
    ]


def test_unit_clash_of_a_slide_and_an_angle(raw):
    raw["instances"]["LF"]["body"]["joints"]["knee"]["kind"] = "slide"
    raw["instances"]["LF"]["sensors"]["bend"] = {"kind": "joint_sensor", "joint": "knee"}
    raw["record"]["bend"] = {"signals": ["LF.bend.signal"], "every": "1 ms"}
    assert without_marks(raw) == [
        "instances.LF.sensors.bend.joint  feeds 'angle' of 'LF.bend', which is in rad (got 'angle' of joint "
        "'LF.knee', which is in mm).",
        "instances.LF.sensors.bend.joint  feeds 'velocity' of 'LF.bend', which is in rad/s (got 'velocity' of joint "
        "'LF.knee', which is in mm/s).",
    ]


def test_arms_and_reference_angles_name_the_same_joints(raw):
    raw["instances"]["LF"]["muscles"]["flexor"]["path"]["reference_angles"]["knee"] = "0 deg"
    assert without_marks(raw) == [
        "instances.LF.muscles.flexor.path.reference_angles.knee  names a joint that moment_arms lacks (got 'LF.knee'). "
        "Hint: reference_angles and moment_arms name the same joints"
    ]


def test_muscle_on_joints_of_a_fork(raw, graph):
    leg = raw["instances"]["LF"]
    path = leg["muscles"]["flexor"]["path"]
    path["moment_arms"]["RF.hip"], path["reference_angles"]["RF.hip"] = "1 mm", "0 deg"
    check(graph(raw))  # from thigh over the trunk to the other thigh: strange, but one chain
    leg["body"]["segments"]["ankle"] = leg["body"]["segments"]["thigh"]
    leg["body"]["joints"]["fork"] = joint("thigh", "ankle")
    for name in ("knee", "fork"):
        path["moment_arms"][name], path["reference_angles"][name] = "1 mm", "0 deg"
    assert without_marks(raw) == [
        "instances.LF.muscles.flexor.path.moment_arms  crosses joints that no path from one segment to another can "
        "cross (got LF.hip, RF.hip, LF.knee, LF.fork). Hint: joints of one muscle lie on one chain of segments"
    ]


def points(*segments):
    return {
        "kind": "straight_lines",
        "points": [{"segment": segment, "position": ["0 m", "10 mm", "0 m"]} for segment in segments],
    }


def test_straight_lines_cross_the_joints_between_their_points(raw, graph):
    raw["instances"]["LF"]["muscles"]["flexor"]["path"] = points("trunk", "shank")
    built = graph(raw)
    check(built)
    crossed = [joint for muscle, joint, _ in built.connections("crossing") if muscle == "LF.flexor"]
    assert crossed == ["LF.hip", "LF.knee"]


def test_straight_lines_on_one_segment(raw):
    raw["instances"]["LF"]["muscles"]["flexor"]["path"] = points("thigh", "thigh")
    assert without_marks(raw) == [
        "instances.LF.muscles.flexor.path.points  crosses no joint (got all 2 points on 'LF.thigh'). "
        "Hint: put origin and insertion on different segments"
    ]


def test_straight_lines_that_turn_back(raw):
    raw["instances"]["LF"]["muscles"]["flexor"]["path"] = points("trunk", "shank", "thigh")
    assert without_marks(raw) == [
        "instances.LF.muscles.flexor.path.points.2.segment  leads the path over joint 'LF.knee' a second time (got "
        "'LF.thigh'). Hint: list the points from origin to insertion along the chain of segments"
    ]


def test_unreachable_motoneuron(raw):
    leg = raw["instances"]["LF"]
    leg["network"]["neurons"] |= {"Mn-E": MOTONEURON, "In-E": {**MOTONEURON, "layer": "interneuron"}}
    leg["network"]["synapses"]["excitatory"]["In-E"] = {"Mn-E": synapse("excitatory")}
    leg["muscles"]["extensor"] = muscle("Mn-E")
    assert without_marks(raw) == [
        "instances.LF.network.neurons.Mn-E  no path of synapses leads to this motoneuron from a drive, a sensor or a "
        "rhythm generator. Hint: add the synapse that excites it"
    ]
    leg["network"]["synapses"]["excitatory"]["load"] = {"In-E": synapse("excitatory")}
    check(build(to_document(raw)))


def test_motoneuron_that_activates_no_muscle(raw):
    leg = raw["instances"]["LF"]
    leg["network"]["neurons"]["Mn-E"] = MOTONEURON
    leg["network"]["synapses"]["excitatory"]["RG-E"] = {"Mn-E": synapse("excitatory")}
    assert without_marks(raw) == [
        "instances.LF.network.neurons.Mn-E  activates no muscle. "
        "Hint: name it as 'motoneuron' of a muscle, or give it another layer"
    ]


def test_a_network_without_muscles_may_have_motoneurons(graph):
    network = {
        "neurons": {"RG": RG, "Mn": MOTONEURON},
        "synapses": {"excitatory": {"RG": {"Mn": synapse("excitatory")}}},
    }
    check(graph({"neuromech": 1, "name": "n", "network": network, "protocol": {"duration": "1 s"}}))


def test_sensor_without_target(raw, graph):
    raw["instances"]["LF"]["sensors"]["tilt"] = {"kind": "link_sensor", "segment": "trunk", "quantity": "pitch"}
    assert without_marks(raw) == [
        "instances.LF.sensors.tilt  nothing reads this sensor. Hint: add a synapse from it, or record it"
    ]
    raw["record"]["tilt"] = {"signals": ["*.tilt.signal"], "every": "1 ms"}
    check(graph(raw))


def loop(raw, **fields):
    network = raw["network"]
    network["neurons"] = {"A": STATIC, "B": STATIC}
    network["synapses"]["excitatory"] = {"A": {"B": synapse("excitatory")}, "B": {"A": synapse("excitatory", **fields)}}


def test_algebraic_loop(raw):
    loop(raw)
    assert without_marks(raw) == [
        "network.synapses.excitatory.A.B  closes an algebraic loop (got A → B → A). "
        "Hint: give one of its synapses a delay, or one of its neurons a time constant"
    ]


def test_a_delay_or_a_state_opens_the_loop(raw, graph):
    loop(raw, delay="1 ms")
    check(graph(raw))
    loop(raw)
    raw["network"]["neurons"]["B"] = {"kind": "rate_neuron", "time_constant": "10 ms"}
    check(graph(raw))


def test_a_unit_that_excites_itself_is_a_loop(raw):
    raw["network"]["neurons"] = {"A": STATIC}
    raw["network"]["synapses"]["excitatory"] = {"A": {"A": synapse("excitatory")}}
    assert "got A → A" in without_marks(raw)[0]


def test_record_pattern_without_match(raw):
    raw["record"]["neurons"]["signals"] = ["*.activity", "*.potentail", "LF.RGF.activity"]
    assert without_marks(raw) == [
        "record.neurons.signals.1  matches no signal (got '*.potentail'). Hint: did you mean 'potential'?",
        "record.neurons.signals.2  matches no signal (got 'LF.RGF.activity'). Hint: did you mean 'LF.RG-F'?",
    ]


def claim(**measure):
    return {"claim": "it steps", "measure": {"kind": "period", **measure}, "expected": {"value": 1}, "source": "x"}


def test_claim_on_a_signal_that_is_not_recorded(raw, graph):
    raw["claims"] = {"steps": claim(signal="LF.RG-F.activity", signals=["*.RG-?.activity"])}
    check(graph(raw))
    raw["claims"] = {"steps": claim(signal="LF.RG-F.potential", reference="LF.RG-F.activty")}
    assert without_marks(raw) == [
        "claims.steps.measure.signal  matches no recorded signal (got 'LF.RG-F.potential'). Hint: record it",
        "claims.steps.measure.reference  matches no recorded signal (got 'LF.RG-F.activty'). "
        "Hint: did you mean 'activity'?",
    ]


def test_initial_pattern_without_match(raw):
    raw["protocol"]["initial"] = {"*.activity": 0.5}
    assert without_marks(raw) == [
        "protocol.initial.*.activity  matches no state (got '*.activity'). Hint: did you mean 'inactivation'?"
    ]


def test_initial_value_has_the_dimension_of_its_states(raw, graph):
    raw["protocol"]["initial"] = {"LF.*.potential": "-60 mV"}
    check(graph(raw))
    raw["protocol"]["initial"] = {"LF.*.potential": {"uniform": ["-70 mV", "-60 ms"]}}
    assert without_marks(raw) == [
        "protocol.initial.LF.*.potential.uniform  must be a value in units like mV (got '-60 ms'). "
        "Hint: write for example '1.0 mV'"
    ]
