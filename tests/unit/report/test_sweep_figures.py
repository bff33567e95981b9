"""Figures of sweeps show what was measured, in the units of the field, and say why something is missing."""

import numpy as np
import pytest
import xarray as xr
from matplotlib.collections import QuadMesh

from neuromech.report import sweep
from neuromech.report.layout import style
from neuromech.report.sweep import cells, sweep_figure, write_sweep_figures


def swept(values, dimensions, units="m/s", missing=None, outcome=None, **coordinates):
    values = np.array(values)
    missing = np.full(values.shape, "") if missing is None else np.array(missing)
    outcome = np.where(missing == "", "finished", "finished") if outcome is None else np.array(outcome)
    variables = {
        "speed": (dimensions, values, {} if values.dtype.kind == "U" else {"units": units}),
        "speed_missing": (dimensions, missing),
        "outcome": (dimensions, outcome),
    }
    given = {name: (name, values, {"units": "N"}) for name, values in coordinates.items()}
    return xr.Dataset(variables, given | {"seed": ("seed", np.arange(values.shape[-1]))})


def texts(legend):
    return [text.get_text() for text in legend.get_texts()]


def drawn(data):
    with style():
        return sweep_figure(data, "speed")


def test_one_parameter_gives_a_line_through_the_medians_in_rising_order():
    data = swept([[3.0, 5.0, 4.0], [1.0, 1.0, 2.0]], ("load", "seed"), load=[20.0, 10.0])
    (axes,) = drawn(data).axes
    assert list(axes.lines[0].get_xdata()) == [10.0, 20.0]
    assert list(axes.lines[0].get_ydata()) == [1.0, 4.0]
    assert axes.get_xlabel() == "load (N)"
    assert axes.get_ylabel() == "speed (m/s)"
    assert axes.get_title(loc="left") == "speed, median of 3 seeds"
    assert axes.get_legend() is None


def test_angles_are_drawn_in_degrees():
    (axes,) = drawn(swept([[np.pi], [0.0]], ("load", "seed"), "rad", load=[1.0, 2.0])).axes
    assert axes.lines[0].get_ydata() == pytest.approx([180.0, 0.0])
    assert axes.get_ylabel() == "speed (deg)"


def test_missing_values_are_marked_with_the_outcome_or_else_the_words_of_the_measure():
    data = swept(
        [[np.nan], [np.nan], [2.0]],
        ("load", "seed"),
        missing=[["the run ended in a fall at 2 s"], ["no rhythm"], [""]],
        outcome=[["fell"], ["finished"], ["finished"]],
        load=[1.0, 2.0, 3.0],
    )
    (axes,) = drawn(data).axes
    assert texts(axes.get_legend()) == ["fell", "no rhythm"]
    assert [list(line.get_xdata()) for line in axes.lines[1:]] == [[1.0], [2.0]]


def test_words_are_rows():
    data = swept([["trot", "trot", "walk"], ["walk"] * 3], ("load", "seed"), load=[1.0, 2.0])
    (axes,) = drawn(data).axes
    assert [label.get_text() for label in axes.get_yticklabels()] == ["trot", "walk"]
    assert list(axes.lines[0].get_ydata()) == [0, 1]
    assert axes.get_title(loc="left") == "speed, commonest of 3 seeds"


def test_two_parameters_give_a_map_with_the_first_across_and_both_rising():
    data = swept(np.arange(6.0).reshape(2, 3, 1), ("load", "push", "seed"), load=[2.0, 1.0], push=[5.0, 3.0, 4.0])
    figure = drawn(data)
    axes, bar = figure.axes
    (mesh,) = [one for one in axes.collections if isinstance(one, QuadMesh)]
    assert mesh.get_array().tolist() == [[4.0, 1.0], [5.0, 2.0], [3.0, 0.0]]
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("load (N)", "push (N)")
    assert [label.get_text() for label in axes.get_xticklabels()] == ["1", "2"]
    assert [label.get_text() for label in axes.get_yticklabels()] == ["3", "4", "5"]
    assert bar.get_ylabel() == "speed (m/s)"


def test_cells_without_any_value_are_hatched_and_those_without_some_are_dotted():
    data = swept(
        [[[np.nan, np.nan], [1.0, np.nan]], [[2.0, 3.0], [4.0, 4.0]]],
        ("load", "push", "seed"),
        missing=[[["no rhythm", "no rhythm"], ["", "no rhythm"]], [["", ""], ["", ""]]],
        load=[1.0, 2.0],
        push=[3.0, 4.0],
    )
    assert cells(data, "speed")[0, 0].value is None
    assert cells(data, "speed")[1, 0].value == 2.5
    figure = drawn(data)
    (legend,) = figure.legends
    assert texts(legend) == ["no rhythm", "no value for some seeds"]
    assert [line.get_xydata().tolist() for line in figure.axes[0].lines] == [[[0.5, 1.5]]]


def test_words_have_colours_that_a_legend_explains():
    data = swept(
        [[["trot"], ["walk"]], [["trot"], ["pace"]]], ("load", "push", "seed"), load=[1.0, 2.0], push=[1.0, 2.0]
    )
    figure = drawn(data)
    assert len(figure.axes) == 1
    assert texts(figure.legends[0]) == ["pace", "trot", "walk"]
    (mesh,) = [one for one in figure.axes[0].collections if isinstance(one, QuadMesh)]
    assert mesh.get_array().tolist() == [[1.0, 1.0], [2.0, 0.0]]


def test_further_parameters_give_panels_and_too_many_are_told(monkeypatch):
    frequency = [float(index) for index in range(5)]
    values = np.arange(4.0 * len(frequency)).reshape(-1, 2, 2, 1)
    data = swept(values, ("frequency", "load", "push", "seed"), frequency=frequency, load=[1.0, 2.0], push=[1.0, 2.0])
    few = drawn(data.isel(frequency=slice(0, 3)))
    assert [one.get_title(loc="left") for one in few.axes[:3]] == [f"frequency = {index} N" for index in range(3)]
    monkeypatch.setattr(sweep, "MOST_PANELS", 4)
    many = drawn(data)
    assert len(many.axes) == 4 + 1
    assert many.get_suptitle() == "speed, the first 4 of 5"
    assert "15" not in [label.get_text() for label in many.axes[-1].get_yticklabels()], "colours of what is left out"


def test_a_sweep_without_any_value_is_drawn():
    missing = np.full((2, 2, 1), "no rhythm")
    data = swept(np.full((2, 2, 1), np.nan), ("a", "b", "seed"), missing=missing, a=[1.0, 2.0], b=[1.0, 2.0])
    assert texts(drawn(data).legends[0]) == ["no rhythm"]
    (axes,) = drawn(data.isel(b=0, drop=True)).axes
    assert texts(axes.get_legend()) == ["no rhythm"]


def test_every_measure_of_every_block_has_a_file(tmp_path):
    one = swept([[1.0], [2.0]], ("load", "seed"), load=[1.0, 2.0])
    two = swept([[[1.0]]], ("load", "push", "seed"), load=[1.0], push=[1.0])
    written = write_sweep_figures(xr.DataTree.from_dict({"/": one}), tmp_path)
    assert [file.name for file in written] == ["speed.png"]
    written = write_sweep_figures(xr.DataTree.from_dict({"/load": one, "/load and push": two}), tmp_path)
    assert [file.name for file in written] == ["speed_by_load.png", "speed_by_load_and_push.png"]
    assert all(file.read_bytes().startswith(b"\x89PNG") for file in written)
