"""Names and units of signals."""

from neuromech.graph.signals import matching, signals, states
from neuromech.units import si_unit, unit_factor


def test_every_signal_has_a_known_unit(raw, graph):
    for unit in signals(graph(raw)).values():
        assert unit_factor(unit)[0] > 0.0


def test_each_family_has_its_signals(raw, graph):
    found = signals(graph(raw))
    assert found["LF.RG-F.potential"] == "mV"
    assert found["LF.RG-F.activity"] == found["LF.RG-F.excitation"] == found["brain.signal"] == ""
    assert found["RF.knee.angle"] == "deg"
    assert found["RF.flexor.length"] == "mm"
    assert found["RF.flexor.force"] == found["LF.load.filtered_load"] == found["LF.foot.force_z"] == "N"
    assert found["trunk.pitch"] == "deg"


def test_a_port_of_any_unit_takes_the_unit_of_what_feeds_it(raw, graph):
    raw["sensors"] = {
        "tilt": {"kind": "link_sensor", "segment": "trunk", "quantity": "pitch"},
        "speed": {"kind": "link_sensor", "segment": "trunk", "quantity": "velocity_x"},
    }
    found = signals(graph(raw))
    assert (found["tilt.value"], found["speed.value"]) == ("deg", "m/s")


def test_states_are_signals(raw, graph):
    built = graph(raw)
    assert {name: unit.example for name, unit in states(built).items()}.items() <= signals(built).items()
    assert "LF.load.filtered_load" in states(built)


def test_a_star_crosses_scopes_and_a_question_mark_does_not_vanish():
    names = ["LF.RG-F.activity", "RG-F.activity", "LF.RG.activity"]
    assert matching("*.activity", names) == names
    assert matching("RG-?.activity", names) == ["RG-F.activity"]


def test_the_si_unit_of_a_signal_keeps_its_meaning(raw, graph):
    found = signals(graph(raw))
    assert si_unit(found["LF.knee.torque"]) == "N m"
    assert {si_unit(found[name]) for name in ("LF.knee.angle", "LF.knee.velocity")} == {"rad", "rad/s"}
