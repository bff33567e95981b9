"""Reference curves: the numbers of a table are part of the document that names it."""

from pathlib import Path

import pytest
from diagnose import diagnose

from neuromech.components.catalogue import Catalogue
from neuromech.spec.load import load

TABLE = "# source: nobody\n\npercent, hip_deg,knee_deg\n0,20,5\n50,-10.5,1e1\n80,5,60\n"
DOCUMENT = """\
neuromech: 1
name: curve
network:
  neurons:
    cell: {kind: rate_neuron, time_constant: 10 ms}
protocol: {duration: 1 s}
record: {all: {signals: ["*"], every: 1 ms}}
claims:
  knee:
    claim: the knee moves as measured
    measure:
      kind: curve_correlation
      signals: [cell.activity, cell.activity]
      feet: [foot]
      curve: {file: tables/walk.csv, columns: [-hip_deg, knee_deg], begins_at: liftoff}
    expected: {at_least: 0.8}
    source: nobody
"""


@pytest.fixture
def folder(tmp_path, monkeypatch):
    (tmp_path / "parts" / "tables").mkdir(parents=True)
    (tmp_path / "parts" / "tables" / "walk.csv").write_text(TABLE, encoding="utf-8")
    (tmp_path / "parts" / "curve.yaml").write_text(DOCUMENT, encoding="utf-8")
    (tmp_path / "own.yaml").write_text("neuromech: 1\nname: own\nextends: parts/curve.yaml\n", encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def curve_of(file):
    return load(file, catalogue=Catalogue.built_in()).experiment.claims["knee"].measure.curve


@pytest.mark.parametrize("file", ["parts/curve.yaml", "own.yaml"])
def test_a_table_stands_relative_to_the_file_that_names_it(folder, file):
    curve = curve_of(folder / file)
    assert curve.phases == (0.0, 50.0, 80.0)
    assert curve.values == ((-20.0, 10.5, -5.0), (5.0, 10.0, 60.0))


def test_the_resolved_document_holds_the_numbers(folder):
    document = load(folder / "own.yaml", catalogue=Catalogue.built_in())
    (folder / "parts" / "tables" / "walk.csv").unlink()
    (folder / "resolved.yaml").write_text(document.text, encoding="utf-8")
    assert curve_of(folder / "resolved.yaml").values == document.experiment.claims["knee"].measure.curve.values


@pytest.mark.parametrize(
    ("name", "column", "size", "peak", "at"),
    [
        ("human_walking", "knee_deg", 50, 60.0, 72.0),
        ("human_walking", "vertical_force_bw", 50, 1.10, 14.0),
        ("cat_forelimb_walking", "vertical_force_bw", 101, 0.58, 82.0),
    ],
)
def test_shipped_tables_hold_what_their_sources_tell(folder, name, column, size, peak, at):
    table = Path(__file__).parents[3] / "specs" / "data" / f"{name}.csv"
    text = DOCUMENT.replace("tables/walk.csv", str(table)).replace("[-hip_deg, knee_deg]", f"[{column}]")
    (folder / "shipped.yaml").write_text(text, encoding="utf-8")
    curve = curve_of(folder / "shipped.yaml")
    assert len(curve.phases) == size
    (values,) = curve.values
    assert max(values) == pytest.approx(peak, rel=0.15)
    assert curve.phases[values.index(max(values))] == pytest.approx(at, abs=5.0)


def test_a_curve_with_a_file_and_values(folder):
    text = DOCUMENT.replace("begins_at: liftoff", "values: [[1, 2, 3]]")
    (folder / "both.yaml").write_text(text, encoding="utf-8")
    (line,) = diagnose((folder / "both.yaml").relative_to(folder)).splitlines()
    assert line == (
        "both.yaml:15:21  claims.knee.measure.curve  has 'values' of its own beside 'file'. Hint: remove one of them"
    )


@pytest.mark.parametrize(
    ("table", "message"),
    [
        (TABLE.replace("hip_deg", "hip"), "the table has no column 'hip_deg'. Hint: did you mean 'hip'?"),
        (TABLE.replace("-10.5", "nan"), "line 5 must hold 3 numbers."),
        (TABLE.replace("80,5,60", "80,5"), "line 6 must hold 3 numbers."),
        ("percent,hip_deg,knee_deg\n0,1,2\n", "must be a table of column names and at least three phases."),
    ],
)
def test_tables_that_are_none(folder, table, message):
    (folder / "parts" / "tables" / "walk.csv").write_text(table, encoding="utf-8")
    lines = diagnose((folder / "parts" / "curve.yaml").relative_to(folder)).splitlines()
    assert lines == [f"parts/curve.yaml:15:21  claims.knee.measure.curve.file  {message}"]
