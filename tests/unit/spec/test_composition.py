"""Laws of composition: extends, modules, mirror, parameters and --set."""

import pickle
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from neuromech.components.catalogue import Catalogue
from neuromech.errors import DocumentError, Mark
from neuromech.spec.load import load
from neuromech.spec.merge import merge_maps
from neuromech.spec.mirror import mirrored
from neuromech.spec.node import Entry, ListNode, MapNode, ScalarNode
from neuromech.spec.plain import plain, to_yaml
from neuromech.spec.reader import parse

SCALARS = st.builds(
    ScalarNode, st.sampled_from(["1", "2 mm", "-3.5 mV", "0", "+4 mm", "word", "1e-3 m"]), st.booleans(), st.none()
)
KEYS = st.sampled_from(["a", "b", "position", "axis", "start", "center_of_mass"])
NODES = st.recursive(
    SCALARS,
    lambda inner: st.one_of(
        st.lists(inner, max_size=4).map(lambda items: ListNode(tuple(items), None)),
        st.dictionaries(KEYS, inner, max_size=4).map(
            lambda found: MapNode({key: Entry(node, None) for key, node in found.items()})
        ),
    ),
    max_leaves=15,
)
MAPS = st.dictionaries(KEYS, NODES, max_size=4).map(
    lambda found: MapNode({key: Entry(node, None) for key, node in found.items()})
)


@given(MAPS)
def test_merging_a_tree_into_itself_changes_nothing(tree):
    problems = []
    assert plain(merge_maps(tree, tree, "extends", problems)) == plain(tree)
    assert problems == []


@given(MAPS)
def test_the_empty_tree_is_neutral(tree):
    assert plain(merge_maps(MapNode(), tree, "extends", [])) == plain(tree)
    assert plain(merge_maps(tree, MapNode(), "extends", [])) == plain(tree)


@given(MAPS, MAPS)
def test_what_is_merged_last_wins(base, over):
    problems = []
    merged = merge_maps(base, over, "extends", problems)
    again = merge_maps(merged, over, "extends", problems)
    if not problems:
        assert plain(again) == plain(merged)


@given(MAPS)
def test_mirror_image_of_the_mirror_image_is_the_original(tree):
    twice = mirrored(mirrored(tree, []), [])
    assert _values(twice) == _values(tree)


def _values(node):
    """Plain values with a leading plus dropped, which a second change of sign cannot bring back."""
    if isinstance(node, ScalarNode):
        return node.text.removeprefix("+")
    if isinstance(node, ListNode):
        return [_values(item) for item in node.items]
    return {key: _values(entry.node) for key, entry in node.entries.items()}


def test_mirror_changes_y_of_vectors_and_x_and_z_of_rotation_axes(loaded, half_centre):
    instances = loaded(half_centre).experiment.instances
    left, right = instances["LF"].body, instances["RF"].body
    assert left.joints["hip"].position == pytest.approx((0.01, 0.02, 0.0))
    assert right.joints["hip"].position == pytest.approx((0.01, -0.02, 0.0))
    assert right.joints["hip"].axis == pytest.approx((-0.1, 1.0, -0.2))
    assert right.segments["thigh"].center_of_mass == pytest.approx((0.0, 0.005, -0.03))
    assert right.segments["thigh"].inertia == left.segments["thigh"].inertia


def test_axis_of_a_sliding_joint_is_mirrored_like_a_position(loaded, half_centre):
    text = half_centre.replace("hip: {parent", "hip: {kind: slide, parent")
    assert loaded(text).experiment.instances["RF"].body.joints["hip"].axis == pytest.approx((0.1, -1.0, 0.2))


def test_parameter_in_a_mirrored_vector_is_refused(loaded, half_centre):
    text = half_centre.replace("[10 mm, 20 mm, 0 mm]", '[10 mm, "${width}", 0 mm]')
    text = text.replace("parameters:", "parameters:\n  width: {value: 20 mm}")
    with pytest.raises(DocumentError, match="has no mirror image"):
        loaded(text)


def test_arguments_are_put_into_values_keys_and_lists(loaded, half_centre):
    instances = loaded(half_centre).experiment.instances
    assert instances["LF"].network.synapses["interlimb"]["RG-F"]["RF.RG-F"].weight == 0.1
    assert instances["RF"].network.synapses["interlimb"]["RG-F"]["LF.RG-F"].weight == 0.1


def test_argument_hides_a_parameter_of_the_same_name(loaded, half_centre):
    text = half_centre.replace("      other:\n", "      other:\n      drive: {default: 3.5 nS}\n")
    text = text.replace("sodium_conductance: 3.5 nS", 'sodium_conductance: "${drive}"')
    neuron = loaded(text).experiment.instances["LF"].network.neurons["RG-F"]
    assert neuron.sodium_conductance == pytest.approx(3.5e-9)
    assert neuron.sodium_conductance.parameter is None


def test_modules_instantiate_modules(loaded, half_centre):
    text = half_centre.replace(
        "instances:\n  LF",
        "  pair:\n    instances:\n      inner: {use: leg, with: {other: RF}}\ninstances:\n  both: {use: pair}\n  LF",
    )
    inner = loaded(text).experiment.instances["both"].instances["inner"]
    assert inner.network.neurons["RG-F"].sodium_conductance == pytest.approx(3.5e-9)


def test_what_an_instance_says_itself_wins_over_its_module_and_is_not_mirrored(loaded, half_centre):
    own = "body: {joints: {hip: {position: [1 mm, 2 mm, 3 mm]}}}"
    text = half_centre.replace("with: {other: LF}}", f"with: {{other: LF}}, {own}}}")
    assert loaded(text).experiment.instances["RF"].body.joints["hip"].position == pytest.approx((1e-3, 2e-3, 3e-3))


def test_what_the_original_says_itself_is_mirrored(loaded, half_centre):
    own = "body: {joints: {hip: {position: [1 mm, 2 mm, 3 mm]}}}"
    text = half_centre.replace("with: {other: RF}}", f"with: {{other: RF}}, {own}}}")
    assert loaded(text).experiment.instances["RF"].body.joints["hip"].position == pytest.approx((1e-3, -2e-3, 3e-3))


def test_quantity_remembers_the_parameter_it_follows_through_a_pickle(loaded, half_centre):
    experiment = pickle.loads(pickle.dumps(loaded(half_centre).experiment))
    neuron = experiment.instances["LF"].network.neurons["RG-F"]
    assert neuron.maximal_inactivation_time == pytest.approx(0.3)
    assert neuron.maximal_inactivation_time.parameter == "rhythm_time"
    assert neuron.sodium_conductance.parameter is None
    assert experiment.network.drives["MLR"].strength.parameter == "drive"


def test_extending_document_wins_and_null_removes(write, half_centre):
    write(half_centre, "base.yaml")
    path = write("extends: base.yaml\nname: other\nprotocol: {duration: 1 s}\nrecord: {all: null}\n")
    experiment = load(path, catalogue=Catalogue.built_in()).experiment
    assert (experiment.name, experiment.protocol.duration, experiment.record) == ("other", 1.0, {})


def test_last_of_several_base_documents_wins(write, half_centre):
    write(half_centre, "base.yaml")
    write("solver: {step: 0.25 ms}\nname: second\n", "second.yaml")
    path = write("extends: [base.yaml, second.yaml]\nprotocol: {duration: 1 s}\n")
    document = load(path, catalogue=Catalogue.built_in())
    assert document.experiment.name == "second"
    assert document.experiment.solver.step == pytest.approx(0.25e-3)
    assert document.files == (Path("document.yaml"), Path("base.yaml"), Path("second.yaml"))


def test_paths_of_extends_are_relative_to_the_file_that_says_it(write, half_centre, tmp_path):
    (tmp_path / "shared").mkdir()
    (tmp_path / "shared" / "base.yaml").write_text(half_centre)
    (tmp_path / "shared" / "middle.yaml").write_text("extends: base.yaml\n")
    path = write("extends: shared/middle.yaml\nprotocol: {duration: 1 km}\n")
    with pytest.raises(DocumentError, match=r"^document.yaml:2:22  protocol.duration  must be a time"):
        load(path, catalogue=Catalogue.built_in())


def test_diamond_of_base_documents_is_no_cycle(write, half_centre):
    write(half_centre, "base.yaml")
    write("extends: base.yaml\n", "left.yaml")
    write("extends: base.yaml\n", "right.yaml")
    path = write("extends: [left.yaml, right.yaml]\nname: diamond\n")
    assert load(path, catalogue=Catalogue.built_in()).experiment.name == "diamond"


def test_very_long_chain_of_documents_is_stopped(write):
    for number in range(60):
        write(f"extends: d{number + 1}.yaml\n", f"d{number}.yaml")
    with pytest.raises(DocumentError, match="over more than 50 files"):
        load(Path("d0.yaml"), catalogue=Catalogue.built_in())


def test_marks_point_to_what_was_written(write, half_centre):
    write(half_centre, "base.yaml")
    path = write("extends: base.yaml\nsolver:\n  step: 0.25 ms\n")
    document = load(path, catalogue=Catalogue.built_in())
    lines = {"base.yaml": half_centre.splitlines(), "document.yaml": path.read_text().splitlines()}

    def written(place):
        mark = document.marks[place]
        return lines[mark.file][mark.line - 1][mark.column - 1 :]

    assert written("solver.step") == "0.25 ms"
    assert written("solver") == "solver:"
    assert written("instances.LF.network.neurons.RG-F.sodium_conductance").startswith("3.5 nS")
    assert written("instances.RF.network.neurons.In").startswith("In: {kind")
    assert written("instances.RF.body.segments.thigh.center_of_mass.1").startswith("-5 mm")
    assert written("instances.RF.body.joints.hip.position.1").startswith("20 mm")
    assert (
        document.mark("instances.LF.network.neurons.RG-F.capacitance")
        == document.marks["instances.LF.network.neurons.RG-F"]
    )


def test_resolved_text_is_a_document_of_the_same_experiment(write, loaded, half_centre):
    document = loaded(half_centre)
    again = load(write(document.text, "again.yaml"), catalogue=Catalogue.built_in(), overrides=["parameters=null"])
    assert again.experiment == document.experiment.model_copy(update={"parameters": {}})
    assert "${" not in document.text


@given(MAPS)
def test_written_trees_are_read_back(tree):
    if tree.entries:
        assert plain(parse(to_yaml(tree).encode(), "x.yaml")) == plain(tree)


def test_override_wins_over_extends_and_the_last_override_wins(write, half_centre):
    write(half_centre, "base.yaml")
    path = write("extends: base.yaml\nname: extended\nsolver: {step: 1 ms}\n")
    overrides = ["solver.step=0.25 ms", "solver.step=0.125 ms", "name=changed"]
    experiment = load(path, catalogue=Catalogue.built_in(), overrides=overrides).experiment
    assert experiment.solver.step == pytest.approx(0.125e-3)
    assert experiment.name == "changed"


def test_override_reaches_into_instances_of_modules(loaded, half_centre):
    experiment = loaded(half_centre, "instances.RF.network.neurons.RG-F.sodium_conductance=1 nS").experiment
    assert experiment.instances["RF"].network.neurons["RG-F"].sodium_conductance == pytest.approx(1e-9)
    assert experiment.instances["LF"].network.neurons["RG-F"].sodium_conductance == pytest.approx(3.5e-9)


def test_override_of_an_item_of_a_list_and_of_a_parameter(loaded, half_centre):
    experiment = loaded(half_centre, "record.all.signals.0=LF.*", "parameters.drive.value=1.5").experiment
    assert experiment.record["all"].signals == ("LF.*",)
    assert experiment.network.drives["MLR"].strength == 1.5


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("solver.stpe=1 ms", "solver.stpe  is not known here. Hint: did you mean 'step'?"),
        ("parameters.driev.value=1", "parameters.driev  does not exist. Hint: did you mean 'drive'?"),
        ("instances.LG.with.other=RF", "instances.LG  does not exist. Hint: allowed: LF, RF"),
        ("modules.lge.network.neurons=1", "modules.lge  does not exist. Hint: did you mean 'leg'?"),
        ("instances.LF.network.neurons.RGF.layer=motoneuron",
         "instances.LF.network.neurons.RGF  does not exist. Hint: did you mean 'RG-F'?"),
        ("record.all.signals.3=x", "record.all.signals.3  is no position in the list (got a list of 1). "
         "Hint: positions count from 0"),
        ("solver.step", "'--set' needs a path and a value (got 'solver.step'). Hint: --set a.b=1"),
        ("name.first=x", "name  is a single value and has no 'first'. Hint: set the value as a whole"),
        ("solver.step=[1", "solver.step  the value is not YAML (got '[1')."),
        ("name=!!python/name:os.system", "name  tags are not allowed (got !!python/name:os.system). "
         "Hint: remove the tag"),
        ("solver.step=1 mV",
         "solver.step  must be a time in units like ms (got '1 mV'). Hint: write for example '1.0 ms'"),
    ],
)  # fmt: skip
def test_override_that_leads_nowhere_is_told(loaded, half_centre, text, message):
    with pytest.raises(DocumentError) as caught:
        loaded(half_centre, text)
    assert message in str(caught.value).splitlines()


def test_problem_in_a_module_is_told_once_however_many_instances_it_has(loaded, half_centre):
    with pytest.raises(DocumentError) as caught:
        loaded(half_centre.replace("3.5 nS", "3.5 mV"))
    assert len(caught.value.problems) == 1
    assert caught.value.problems[0].mark == Mark("document.yaml", 14, 56)


def test_modules_that_multiply_are_stopped(loaded):
    levels = "".join(
        f"  m{level}: {{instances: {{a: {{use: m{level + 1}}}, b: {{use: m{level + 1}}}}}}}\n" for level in range(15)
    )
    text = f"neuromech: 1\nname: bomb\nmodules:\n{levels}  m15: {{network: {{}}}}\n"
    with pytest.raises(DocumentError, match="more than 2000 instances"):
        loaded(text + "instances: {x: {use: m0}}\nprotocol: {duration: 1 s}\n")


def test_text_that_doubles_with_each_module_is_stopped(loaded):
    levels = "".join(
        f'  m{level}: {{arguments: {{t: }}, instances: {{a: {{use: m{level + 1}, with: {{t: "${{t}}${{t}}"}}}}}}}}\n'
        for level in range(15)
    )
    last = '  m15: {arguments: {t: }, network: {neurons: {A: {kind: "${t}"}}}}\n'
    text = f"neuromech: 1\nname: bomb\nmodules:\n{levels}{last}"
    with pytest.raises(DocumentError, match="longer than 10000 characters"):
        loaded(text + "instances: {x: {use: m0, with: {t: ab}}}\nprotocol: {duration: 1 s}\n")


def test_chain_of_very_many_modules_is_stopped(loaded):
    levels = "".join(f"  m{level}: {{instances: {{a: {{use: m{level + 1}}}}}}}\n" for level in range(2000))
    text = f"neuromech: 1\nname: bomb\nmodules:\n{levels}  m2000: {{network: {{}}}}\n"
    with pytest.raises(DocumentError, match="nested deeper than 20"):
        loaded(text + "instances: {x: {use: m0}}\nprotocol: {duration: 1 s}\n")


@pytest.mark.parametrize("row", [", ".join(['"${t}"'] * 50), "[" * 9 + '"${t}"' + "]" * 9])
def test_argument_that_grows_with_each_module_is_stopped(loaded, row):
    levels = "".join(
        f"  m{level}: {{arguments: {{t: }}, instances: {{a: {{use: m{level + 1}, with: {{t: [{row}]}}}}}}}}\n"
        for level in range(15)
    )
    last = '  m15: {arguments: {t: }, network: "${t}"}\n'
    text = f"neuromech: 1\nname: bomb\nmodules:\n{levels}{last}"
    with pytest.raises(DocumentError, match="more than 200000 values, or deeper than 60 levels"):
        loaded(text + "instances: {x: {use: m0, with: {t: 1}}}\nprotocol: {duration: 1 s}\n")
