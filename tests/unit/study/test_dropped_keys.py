"""What an existing document drops with `null` stays dropped when tuned values are written to it."""

from neuromech.pipeline import load_document
from neuromech.study.write_back import write_back


def test_null_is_written_as_null(relaxing, tmp_path):
    original = relaxing(
        claims={
            "level": {
                "claim": "the first is active",
                "measure": {"kind": "final", "signal": "first.activity"},
                "expected": {"at_least": 0.1},
                "source": "this test",
            }
        }
    )
    file = tmp_path / "tuned.yaml"
    file.write_text(f"neuromech: 1\nname: tuned\nextends: {original.name}\nclaims:\n  level: null  # not of this one\n")
    write_back(load_document(original), {"bias": "1.5"}, "study x, evaluation 3", file)
    assert "  level: null  # not of this one\n" in file.read_text()
    tuned = load_document(file).experiment
    assert tuned.claims == {}
    assert tuned.parameters["bias"].value == 1.5
