"""`neuromech schema`: what an editor needs to complete and check documents."""

import json
from pathlib import Path

from neuromech.cli.files import write_text
from neuromech.cli.terminal import FINISHED, write_line
from neuromech.components.catalogue import Catalogue
from neuromech.spec.schema import json_schema


def schema(out: Path | None) -> int:
    """Write the JSON Schema of documents to a file or to stdout; return the exit code."""
    text = json.dumps(json_schema(Catalogue.installed()), indent=2, ensure_ascii=False)
    if out:
        write_text(out, f"{text}\n")
    else:
        write_line(text)
    return FINISHED
