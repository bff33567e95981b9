"""Problems of documents in the forms that editors and workflows read."""

import json

import pytest

from neuromech.cli.problems import Format, as_github, as_json, as_sarif, as_text, sentence
from neuromech.errors import Mark, Problem

PLACED = Problem("wrong-unit", "a.b", "must be a time", "'5 kg'", "write '1 ms'", Mark("specs/a b.yaml", 3, 7))
BARE = Problem("override", "", "'--set' needs a path and a value")


def test_text_is_one_line_for_each_problem():
    assert as_text([PLACED, BARE]).splitlines() == [
        "specs/a b.yaml:3:7  a.b  must be a time (got '5 kg'). Hint: write '1 ms'",
        "'--set' needs a path and a value.",
    ]


def test_json_keeps_every_part():
    assert json.loads(as_json([PLACED, BARE])) == [
        {
            "file": "specs/a b.yaml",
            "line": 3,
            "column": 7,
            "code": "wrong-unit",
            "path": "a.b",
            "message": "must be a time",
            "got": "'5 kg'",
            "hint": "write '1 ms'",
        },
        {
            "file": None,
            "line": None,
            "column": None,
            "code": "override",
            "path": "",
            "message": "'--set' needs a path and a value",
            "got": None,
            "hint": None,
        },
    ]


def test_sarif_points_at_the_rule_and_the_place():
    log = json.loads(as_sarif([PLACED, BARE, PLACED]))
    (run,) = log["runs"]
    rules = [rule["id"] for rule in run["tool"]["driver"]["rules"]]
    assert log["version"] == "2.1.0"
    assert rules == ["override", "wrong-unit"]
    assert [rules[result["ruleIndex"]] for result in run["results"]] == ["wrong-unit", "override", "wrong-unit"]
    (place,) = run["results"][0]["locations"]
    assert place["physicalLocation"]["artifactLocation"] == {"uri": "specs/a%20b.yaml"}
    assert place["physicalLocation"]["region"] == {"startLine": 3, "startColumn": 7}
    assert "locations" not in run["results"][1]
    assert run["results"][1]["message"]["text"] == sentence(BARE)


def test_sarif_of_no_problem_is_a_log_without_results():
    assert json.loads(as_sarif([]))["runs"][0]["results"] == []


def test_github_annotations_escape_what_would_end_them():
    problem = Problem("a,b:c", "p", "100 % of\nlines", None, None, Mark("x:y,z%.yaml", 1, 2))
    line = "::error file=x%3Ay%2Cz%25.yaml,line=1,col=2,title=a%2Cb%3Ac::p  100 %25 of%0Alines."
    assert as_github([problem]) == line


def test_github_annotation_without_a_place_names_the_rule():
    assert as_github([BARE]).startswith("::error title=override::")


@pytest.mark.parametrize("form", Format)
def test_every_form_has_a_writer(form: Format):
    from neuromech.cli.problems import write

    assert "wrong-unit" in write([PLACED], form) or form is Format.TEXT
