"""The picture and the GraphML file hold what the graph holds."""

import subprocess
import sys
from itertools import combinations
from math import hypot
from xml.etree import ElementTree

import networkx as nx
from legs import BRICK, RG, synapse

from neuromech.graph.curves import RADIUS, Node, between
from neuromech.graph.draw import draw, figure
from neuromech.graph.graphml import export_graphml, plain
from neuromech.graph.layout import layout
from neuromech.graph.strokes import INK


def test_every_neuron_drive_sensor_and_muscle_has_a_place_of_its_own(raw, graph):
    built = graph(raw)
    places = layout(built).places
    assert set(places) == {one.name for one in built.elements("neuron", "drive", "sensor", "muscle")}
    assert all(hypot(a[0] - b[0], a[1] - b[1]) > 2 * RADIUS for a, b in combinations(places.values(), 2))


def test_each_element_stands_in_the_panel_of_its_leg(raw, graph):
    found = layout(graph(raw))
    for panel in found.panels:
        for name, (x, y) in found.places.items():
            inside = panel.left < x < panel.left + panel.width and panel.bottom < y < panel.bottom + panel.height
            assert inside == name.startswith(f"{panel.title}.")


def test_rhythm_generators_of_four_legs_face_each_other(raw, graph):
    raw["instances"] |= {"LH": raw["instances"]["LF"], "RH": raw["instances"]["RF"]}
    places = layout(graph(raw)).places
    height = {leg: places[f"{leg}.RG-F"][1] - places[f"{leg}.Mn-F"][1] for leg in ("LF", "RF", "LH", "RH")}
    assert height["LF"] == height["RF"] < 0.0 < height["LH"] == height["RH"]


def test_a_network_without_instances_fills_one_panel(graph):
    raw = {"neuromech": 1, "name": "n", "network": {"neurons": {"RG": RG}}, "protocol": {"duration": "1 s"}}
    found = layout(graph(raw))
    assert [panel.title for panel in found.panels] == [""]
    assert [title for title, _ in found.panels[0].rows] == ["Rhythm generator"]


def test_a_curve_goes_around_a_node_in_its_way():
    start, middle, end = (Node("neuron", (0.0, y)) for y in (0.0, 1.35, 2.7))
    assert abs(between(start, end, [start, middle, end])[1][0]) > RADIUS
    assert abs(between(start, end, [start, end])[1][0]) < RADIUS


def test_signs_differ_in_the_end_of_the_line_and_in_its_dashes(raw, graph):
    patches = figure(graph(raw)).axes[0].patches
    lines = {
        sign: {patch.get_linestyle() for patch in patches if patch.get_edgecolor() == colour and not patch.get_fill()}
        for sign, colour in ((sign, patch_colour(INK[sign])) for sign in INK)
    }
    assert all(len(styles) == 1 for styles in lines.values())
    assert lines["excitatory"] == lines["wire"] != lines["inhibitory"]
    ends = {
        sign: {type(patch).__name__ for patch in patches if patch.get_facecolor() == patch_colour(INK[sign])}
        for sign in INK
    }
    assert (ends["excitatory"], ends["inhibitory"]) == ({"Polygon"}, {"Circle"})


def patch_colour(text):
    from matplotlib.colors import to_rgba

    return to_rgba(text)


def test_the_svg_is_the_same_each_time_and_names_every_neuron(raw, graph, tmp_path):
    built = graph(raw)
    draw(built, tmp_path / "one.svg")
    draw(built, tmp_path / "two.svg")
    assert (tmp_path / "one.svg").read_bytes() == (tmp_path / "two.svg").read_bytes()
    texts = [
        element.text for element in ElementTree.parse(tmp_path / "one.svg").iter("{http://www.w3.org/2000/svg}text")
    ]
    assert texts.count("RG-F") == 2
    assert {"LF", "RF", "brain", "excites", "inhibits"} <= set(texts)


def test_a_neuron_that_excites_itself_is_drawn(graph, tmp_path):
    network = {"neurons": {"RG": RG}, "synapses": {"excitatory": {"RG": {"RG": synapse("excitatory")}}}}
    draw(graph({"neuromech": 1, "name": "n", "network": network, "protocol": {"duration": "1 s"}}), tmp_path / "n.svg")
    assert ">RG<" in (tmp_path / "n.svg").read_text()


def test_a_body_without_network_has_an_empty_picture(graph, tmp_path):
    body = {"segments": {"trunk": BRICK}}
    draw(graph({"neuromech": 1, "name": "n", "body": body, "protocol": {"duration": "1 s"}}), tmp_path / "n.svg")
    assert "trunk" not in (tmp_path / "n.svg").read_text()


def test_graphml_comes_back_as_it_was_written(raw, graph, tmp_path):
    built = graph(raw)
    export_graphml(built, tmp_path / "legs.graphml")
    read = nx.read_graphml(tmp_path / "legs.graphml", force_multigraph=True)
    written = plain(built)
    assert dict(read.nodes(data=True)) == dict(written.nodes(data=True))
    assert edge_list(read) == edge_list(written)
    assert read.edges["LF.RG-F", "LF.Mn-F", 0]["delay_ms"] == 2.0


def edge_list(graph):
    return sorted((u, v, sorted(data.items())) for u, v, data in graph.edges(data=True))


def test_building_and_checking_imports_nothing_heavy():
    code = "import sys, neuromech.graph.build, neuromech.graph.diff; print({'matplotlib', 'numba'} & set(sys.modules))"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout.strip() == "set()"
