"""`neuromech new`: a document of one's own that extends a shipped one."""

import os
import re
from pathlib import Path

from neuromech.cli.documents import shipped_specs
from neuromech.cli.terminal import FINISHED, note
from neuromech.components.catalogue import Catalogue
from neuromech.errors import DocumentError, Problem, did_you_mean
from neuromech.spec.load import load
from neuromech.spec.model import Parameter
from neuromech.spec.scalars import NAME_PATTERN


def new(name: str, base: str) -> int:
    """Write NAME.yaml in the current folder; return the exit code.

    Raises:
        DocumentError: the name is no name, the file exists already, or there is no such shipped document.
    """
    if not re.match(NAME_PATTERN, name):
        raise _refusal("bad-name", f"'{name}' is no name", "start with a letter, then letters, digits, '_', '-' or '+'")
    source = shipped_file(base)
    file = Path(f"{name}.yaml")
    text = stub(
        name, Path(os.path.relpath(source)), load(source, catalogue=Catalogue.installed()).experiment.parameters
    )
    try:
        with file.open("x", encoding="utf-8") as stream:
            stream.write(text)
    except FileExistsError as error:
        raise _refusal("file-exists", f"{file} exists already", "choose another name") from error
    note(f"wrote {file}")
    return FINISHED


def shipped_file(base: str) -> Path:
    """Return the file of a shipped document named like `cat/suspended`.

    Raises:
        DocumentError: there is none.
    """
    folder = shipped_specs()
    names = {path.relative_to(folder).with_suffix("").as_posix(): path for path in folder.rglob("*.yaml")}
    found = names.get(base.removesuffix(".yaml"))
    if found is None:
        raise _refusal("unknown-document", f"there is no shipped document '{base}'", did_you_mean(base, names))
    return found


def stub(name: str, base: Path, parameters: dict[str, Parameter]) -> str:
    """Return a document that extends another and shows the other's parameters as comments, ready to uncomment."""
    lines = ["neuromech: 1", f"name: {name}", f"extends: {base.as_posix()}", ""]
    if parameters:
        lines += ["# To turn a knob, remove the '# ' of its two lines and of the line 'parameters:'.", "# parameters:"]
    for knob, parameter in parameters.items():
        lines += [f"#   # {comment}" for comment in _comments(parameter)]
        lines += [f"#   {knob}:", f"#     value: {parameter.value}"]
    return "\n".join(lines).rstrip() + "\n"


def _comments(parameter: Parameter) -> list[str]:
    bounds = f"{parameter.minimum} … {parameter.maximum}" if parameter.minimum is not None else ""
    return [text for text in (parameter.description, bounds, parameter.source) if text]


def _refusal(code: str, message: str, hint: str) -> DocumentError:
    return DocumentError([Problem(code, "", message, hint=hint)])
