"""`neuromech explain`: where a value comes from."""

from collections.abc import Sequence
from pathlib import Path

from neuromech.cli.terminal import FINISHED, write_line
from neuromech.components.catalogue import Catalogue
from neuromech.spec.explain import Explanation
from neuromech.spec.explain import explain as explained
from neuromech.spec.node import Origin


def explain(spec: Path, path: str, overrides: Sequence[str]) -> int:
    """Write where the value at a path comes from, and what it was before; return the exit code.

    Raises:
        DocumentError: the document cannot be composed, or has no such path.
    """
    for line in lines(explained(path, spec, Catalogue.installed(), overrides)):
        write_line(line)
    return FINISHED


def lines(explanation: Explanation) -> list[str]:
    """Return an explanation as lines: the value, its place, its meaning, and what stood there before."""
    found = [f"{explanation.path} = {explanation.written}", f"  {_place(explanation)}"]
    if explanation.quantity is not None and explanation.si is not None:
        found.append(f"  a {explanation.quantity}, {explanation.si:g} in SI units")
    if explanation.parameter is not None:
        found.append(f"  follows the parameter '{explanation.parameter}'")
    found += [f"  {_step(origin)}" for origin in reversed(explanation.history)]
    return found


def _place(explanation: Explanation) -> str:
    if explanation.is_default:
        return "the default of its kind; no file says anything"
    return f"written at {explanation.mark}" if explanation.mark else "given by --set"


def _step(origin: Origin) -> str:
    words = {
        "extends": "replaces, by 'extends',",
        "instance": "replaces, in the instance,",
        "set": "replaces, by --set,",
        "argument": "stands in the module as",
        "parameter": "is the value that the parameter has,",
        "mirror": "is the mirror image of",
    }
    place = f" at {origin.mark}" if origin.mark else ""
    return f"{words[origin.how]} '{origin.text}'{place}"
