"""A tuned candidate as a document: small, extending the original, with the origin of each of its numbers."""

import io
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ruamel.yaml import YAML
from ruamel.yaml.comments import CommentedMap
from ruamel.yaml.nodes import ScalarNode
from ruamel.yaml.representer import RoundTripRepresenter

from neuromech.components.catalogue import Catalogue
from neuromech.errors import StudyError
from neuromech.spec.document import Document
from neuromech.spec.load import load

WIDTH = 4096
"""Columns before a line of an existing file would be wrapped anew."""


def write_back(document: Document, parameters: Mapping[str, str], origin: str, file: Path) -> None:
    """Write tuned values to a document.

    A new file gets `extends` with the way to the original. One that exists already keeps its comments and everything
    else. What is written has been read back: it is valid, and its parameters have these values to the last bit.

    Args:
        document: the original.
        parameters: name -> value with unit.
        origin: where the values come from, like `study x, evaluation 12`; the `source` of each parameter.
        file: to write.

    Raises:
        DocumentError: the result would be no valid document, for example because it does not extend the original.
        StudyError: the existing file cannot hold the values.
        OSError: the file cannot be written.
    """
    content = _existing(file) if file.exists() else _new(document, file, origin)
    section = content.setdefault("parameters", CommentedMap())
    for name, text in parameters.items():
        parameter = section.setdefault(name, CommentedMap())
        if not isinstance(parameter, CommentedMap):
            raise StudyError(f"{file}: parameters.{name} is no map, so its value cannot be replaced there")
        parameter["value"] = text if " " in text else float(text)
        parameter["source"] = origin
    _replace(file, _text(content), parameters)


def _new(document: Document, file: Path, origin: str) -> CommentedMap:
    original = Path(os.path.relpath(document.file.resolve(), file.resolve().parent)).as_posix()
    content = CommentedMap(neuromech=1, name=f"{document.experiment.name} tuned", extends=original)
    content.yaml_set_start_comment(f"Tuned by 'neuromech optimize': {origin}.")
    content.yaml_set_comment_before_after_key("parameters", before="\n")
    return content


class _Representer(RoundTripRepresenter):
    """Writes `null` in so many words: a key with nothing after it would no longer drop what a base document says."""

    def represent_null(self, _data: None) -> ScalarNode:
        return self.represent_scalar("tag:yaml.org,2002:null", "null")


_Representer.add_representer(type(None), _Representer.represent_null)


def _yaml() -> YAML:
    yaml = YAML()
    yaml.Representer = _Representer
    yaml.preserve_quotes = True
    yaml.width = WIDTH
    return yaml


def _existing(file: Path) -> CommentedMap:
    # Read as a document first, so that what is wrong is said in the usual words.
    load(file, catalogue=Catalogue.installed())
    content: Any = _yaml().load(file.read_text("utf-8"))
    section = content.get("parameters")
    if section is not None and not isinstance(section, CommentedMap):
        raise StudyError(f"{file}: 'parameters' is no map, so values cannot be replaced there")
    return CommentedMap(content) if not isinstance(content, CommentedMap) else content


def _text(content: CommentedMap) -> str:
    stream = io.StringIO()
    _yaml().dump(content, stream)
    return stream.getvalue()


def _replace(file: Path, text: str, parameters: Mapping[str, str]) -> None:
    """Give a file its new content, after that was read from a file beside it."""
    file.parent.mkdir(parents=True, exist_ok=True)
    partial = file.with_name(f".{file.stem}.partial{file.suffix}")
    try:
        partial.write_text(text, "utf-8")
        _check(load(partial, catalogue=Catalogue.installed()), parameters, file)
        os.replace(partial, file)
    finally:
        partial.unlink(missing_ok=True)


def _check(document: Document, parameters: Mapping[str, str], file: Path) -> None:
    """Raise `StudyError` where a document has other values than were meant."""
    for name, text in parameters.items():
        value = document.experiment.parameters[name].value
        number = float(value.partition(" ")[0]) if isinstance(value, str) else float(value)
        if number != float(text.partition(" ")[0]):
            raise StudyError(f"{file}: parameters.{name} would be {value} instead of {text}")
