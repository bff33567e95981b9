"""`explain`: where a value comes from, and what it was before."""

import pytest

from neuromech.components.catalogue import Catalogue
from neuromech.errors import DocumentError, Mark
from neuromech.spec.explain import explain

CATALOGUE = Catalogue.built_in()


@pytest.fixture
def spec(write, half_centre):
    write(half_centre, "base.yaml")
    return write("extends: base.yaml\nname: child\ninstances: {LF: {with: {tau: 500 ms}}}\nsolver: {step: 250 us}\n")


def test_value_of_a_base_document_that_was_replaced(spec):
    found = explain("name", spec, CATALOGUE)
    assert (found.written, found.mark) == ("child", Mark("document.yaml", 2, 7))
    assert [(origin.how, origin.text, str(origin.mark)) for origin in found.history] == [
        ("extends", "half centre", "base.yaml:2:7")
    ]


def test_quantity_in_si_units(spec):
    found = explain("solver.step", spec, CATALOGUE)
    assert (found.quantity, found.written) == ("time", "250 us")
    assert found.si == pytest.approx(250e-6)


def test_argument_of_a_module(spec):
    found = explain("instances.LF.network.neurons.RG-F.maximal_inactivation_time", spec, CATALOGUE)
    assert (found.written, found.mark) == ("500 ms", Mark("document.yaml", 3, 30))
    assert [(origin.how, origin.text) for origin in found.history] == [("argument", "${tau}")]


def test_parameter_and_the_value_it_had(write, half_centre):
    path = write(half_centre)
    place = "instances.RF.network.neurons.RG-F.maximal_inactivation_time"
    found = explain(place, path, CATALOGUE, ["parameters.rhythm_time.value=200 ms"])
    assert (found.written, found.parameter, found.si) == ("200 ms", "rhythm_time", pytest.approx(0.2))
    assert ("set", "300 ms") in [(origin.how, origin.text) for origin in found.history]
    assert ("argument", "${tau}") in [(origin.how, origin.text) for origin in found.history]


def test_mirror_image(spec):
    found = explain("instances.RF.body.joints.hip.position.1", spec, CATALOGUE)
    assert (found.written, found.si) == ("-20 mm", pytest.approx(-0.02))
    assert ("mirror", "20 mm") in [(origin.how, origin.text) for origin in found.history]


def test_bare_weight_of_a_synapse(spec):
    found = explain("instances.LF.network.synapses.excitatory.RG-F.In", spec, CATALOGUE)
    assert (found.written, found.si, found.quantity) == ("0.4", 0.4, "number")


def test_name_with_a_dot(spec):
    assert explain("network.synapses.excitatory.MLR.LF.RG-F", spec, CATALOGUE).written == "0.1"


@pytest.mark.parametrize(
    ("path", "written"),
    [
        ("world.gravity", "9.81 m/s^2"),
        ("solver.method", "rk4"),
        ("instances.LF.network.neurons.RG-F.capacitance", "20 pF"),
        ("world.ground", "nothing"),
    ],
)
def test_default_that_nobody_wrote(spec, path, written):
    found = explain(path, spec, CATALOGUE)
    assert (found.is_default, found.mark, found.written) == (True, None, written)


def test_map_shows_its_keys(spec):
    found = explain("instances.LF.body", spec, CATALOGUE)
    assert found.written == "{segments, joints}"
    assert str(found.mark).startswith("base.yaml:")


@pytest.mark.parametrize(
    ("path", "message"),
    [
        ("solver.stpe", "solver.stpe  is not in the document. Hint: did you mean 'step'?"),
        ("instances.RG.x", "instances.RG.x  is not in the document. Hint: allowed: LF, RF"),
        ("instances.LF.body.joints.hip.position.7", "position.7  is not in the document"),
        ("name.first", "name.first  is not in the document"),
        ("", "is not in the document"),
    ],
)
def test_path_that_does_not_exist(spec, path, message):
    with pytest.raises(DocumentError) as caught:
        explain(path, spec, CATALOGUE)
    assert message in str(caught.value)
