"""Problems of documents as text, JSON, SARIF 2.1.0 and annotations of GitHub workflows."""

import json
from collections.abc import Callable, Sequence
from enum import StrEnum
from importlib.metadata import version
from typing import Any
from urllib.parse import quote

from neuromech.errors import Problem


class Format(StrEnum):
    """How problems are written."""

    TEXT = "text"
    JSON = "json"
    SARIF = "sarif"
    GITHUB = "github"


def write(problems: Sequence[Problem], form: Format) -> str:
    """Return the problems as text in one of the forms, without a final line end."""
    return WRITERS[form](problems)


def as_text(problems: Sequence[Problem]) -> str:
    """Return one line for each problem."""
    return "\n".join(str(problem) for problem in problems)


def as_json(problems: Sequence[Problem]) -> str:
    """Return a JSON list of flat objects; what is not known is null."""
    return json.dumps([_flat(problem) for problem in problems], indent=2, ensure_ascii=False)


def as_sarif(problems: Sequence[Problem]) -> str:
    """Return a SARIF 2.1.0 log with one run (docs.oasis-open.org/sarif/sarif/v2.1.0)."""
    rules = sorted({problem.code for problem in problems})
    driver = {"name": "neuromech", "version": version("neuromech"), "rules": [{"id": rule} for rule in rules]}
    results = [_sarif_result(problem, rules.index(problem.code)) for problem in problems]
    log = {
        "$schema": "https://json.schemastore.org/sarif-2.1.0.json",
        "version": "2.1.0",
        "runs": [{"tool": {"driver": driver}, "columnKind": "unicodeCodePoints", "results": results}],
    }
    return json.dumps(log, indent=2, ensure_ascii=False)


def as_github(problems: Sequence[Problem]) -> str:
    """Return one workflow command for each problem, which GitHub shows at the line of the file."""
    return "\n".join(_github_command(problem) for problem in problems)


def sentence(problem: Problem) -> str:
    """Return path, what is wrong, what was found and the hint, without the position."""
    return str(Problem(problem.code, problem.path, problem.message, problem.got, problem.hint))


def _flat(problem: Problem) -> dict[str, Any]:
    mark = problem.mark
    return {
        "file": mark.file if mark else None,
        "line": mark.line if mark else None,
        "column": mark.column if mark else None,
        "code": problem.code,
        "path": problem.path,
        "message": problem.message,
        "got": problem.got,
        "hint": problem.hint,
    }


def _sarif_result(problem: Problem, rule_index: int) -> dict[str, Any]:
    result: dict[str, Any] = {
        "ruleId": problem.code,
        "ruleIndex": rule_index,
        "level": "error",
        "message": {"text": sentence(problem)},
    }
    if problem.mark:
        place = {
            "artifactLocation": {"uri": quote(problem.mark.file)},
            "region": {"startLine": problem.mark.line, "startColumn": problem.mark.column},
        }
        result["locations"] = [{"physicalLocation": place}]
    return result


def _github_command(problem: Problem) -> str:
    mark = problem.mark
    place = {"file": mark.file, "line": mark.line, "col": mark.column} if mark else {}
    properties = {**place, "title": problem.code}
    listed = ",".join(f"{key}={_escape_property(str(value))}" for key, value in properties.items())
    return f"::error {listed}::{_escape_data(sentence(problem))}"


def _escape_data(text: str) -> str:
    return text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def _escape_property(text: str) -> str:
    return _escape_data(text).replace(":", "%3A").replace(",", "%2C")


WRITERS: dict[Format, Callable[[Sequence[Problem]], str]] = {
    Format.TEXT: as_text,
    Format.JSON: as_json,
    Format.SARIF: as_sarif,
    Format.GITHUB: as_github,
}
