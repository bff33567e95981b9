"""Generated modules on disk: written once under a name that holds everything their machine code depends on."""

import hashlib
import importlib.util
import os
import re
import sys
import tempfile
import threading
from collections.abc import Iterable
from pathlib import Path
from types import ModuleType

import numba
import numpy as np
import platformdirs

from neuromech.components.base import Component

ENVIRONMENT_VARIABLE = "NEUROMECH_CACHE_DIR"

_IMPORTING = threading.Lock()
_KERNEL = re.compile(r"^from neuromech\.compiler\.(\w+) import", re.MULTILINE)


def folder() -> Path:
    """Return where generated modules are kept: `NEUROMECH_CACHE_DIR`, or the user's cache folder."""
    return Path(os.environ.get(ENVIRONMENT_VARIABLE) or platformdirs.user_cache_path("neuromech")) / "steps"


def module_file(source: str, classes: Iterable[type[Component]], files: Iterable[Path] = ()) -> Path:
    """Write the source where it is not there yet, and return its file.

    Machine code that numba keeps beside the file does not notice a change in what the file imports, so the name is a
    hash of the source, of the files of all equations and of `files`, of the kernels that any of these import, and of
    the versions of numba and NumPy.
    """
    digest = hashlib.sha256(source.encode())
    own = {*_equations(classes), *files}
    for dependency in sorted(own | _kernels([source, *(file.read_text("utf-8") for file in own)])):
        digest.update(dependency.read_bytes())
    digest.update(f"{numba.__version__} {np.__version__} {sys.version}".encode())
    file = folder() / f"step_{digest.hexdigest()[:20]}.py"
    if not file.exists():
        _write(file, source)
    return file


def import_file(file: Path) -> ModuleType:
    """Import a generated module, once per process, whichever thread asks first."""
    with _IMPORTING:
        return _imported(file)


def _imported(file: Path) -> ModuleType:
    if file.stem in sys.modules:
        return sys.modules[file.stem]
    spec = importlib.util.spec_from_file_location(file.stem, file)
    if spec is None or spec.loader is None:
        raise ImportError(f"{file} is no Python module")
    module = importlib.util.module_from_spec(spec)
    sys.modules[file.stem] = module
    spec.loader.exec_module(module)
    return module


def _equations(classes: Iterable[type[Component]]) -> set[Path]:
    files = (getattr(sys.modules[base.__module__], "__file__", None) for cls in classes for base in cls.__mro__[:-1])
    return {Path(file) for file in files if file and "pydantic" not in file and file.endswith(".py")}


def _kernels(sources: Iterable[str]) -> set[Path]:
    """Return the files of this package that some sources import, directly or through others."""
    found: set[Path] = set()
    waiting = list(sources)
    while waiting:
        for name in _KERNEL.findall(waiting.pop()):
            file = Path(__file__).with_name(f"{name}.py")
            if file not in found:
                found.add(file)
                waiting.append(file.read_text("utf-8"))
    return found


def _write(file: Path, source: str) -> None:
    file.parent.mkdir(parents=True, exist_ok=True)
    descriptor, name = tempfile.mkstemp(dir=file.parent, suffix=".part")
    with os.fdopen(descriptor, "w", encoding="utf-8") as stream:
        stream.write(source)
    Path(name).replace(file)
