"""One self-describing results file per run: NetCDF4, complete or not there at all."""

import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import xarray as xr

from neuromech.errors import RecordingError
from neuromech.simulate.recording import Recording

FORMAT = "neuromech recording 1"
_COMPRESSION = {"zlib": True, "complevel": 1, "shuffle": True, "_FillValue": None}


def save(recording: Recording, file: Path) -> None:
    """Write a recording to a NetCDF4 file.

    The file gets its name only when it is complete. A killed process leaves at most a file whose name ends in
    `.partial` beside it.

    Raises:
        RecordingError: the file cannot be written.
    """
    tree = recording.tree.copy()
    tree.attrs = {**tree.attrs, "format": FORMAT}
    write_complete(tree, file)


def write_complete(tree: xr.DataTree, file: Path) -> None:
    """Write labelled arrays to a NetCDF4 file that gets its name only when it is complete.

    Raises:
        RecordingError: the file cannot be written.
    """
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
        _write_and_rename(tree, file)
    except OSError as error:
        raise RecordingError(f"{file} cannot be written: {error}") from error


def load(file: Path) -> Recording:
    """Read a recording from a file that `save` wrote, wholly into memory.

    Raises:
        RecordingError: the file is missing, unreadable, or no recording of ours.
    """
    if not file.is_file():
        raise RecordingError(f"{file} does not exist. Hint: 'neuromech run' writes results files")
    try:
        with xr.open_datatree(file, engine="h5netcdf", decode_times=False, mask_and_scale=False) as opened:
            tree = opened.load()
        if tree.attrs.pop("format", None) != FORMAT:
            raise _foreign(file)
        return Recording.from_tree(tree)
    except (OSError, KeyError, ValueError, TypeError) as error:
        raise _foreign(file) from error


def _write_and_rename(tree: xr.DataTree, file: Path) -> None:
    partial = file.with_name(f".{file.name}.{os.getpid()}.partial")
    try:
        _write(tree, partial)
        os.replace(partial, file)
    finally:
        partial.unlink(missing_ok=True)


def _write(tree: xr.DataTree, file: Path) -> None:
    tree.to_netcdf(file, engine="h5netcdf", encoding=_encoding(tree))


def _encoding(tree: xr.DataTree) -> dict[str, dict[str, Any]]:
    """Compress variables; keep xarray from adding fill values, which would make missing data out of NaN."""
    return {node.path: dict(_of_variables(node.to_dataset())) for node in tree.subtree}


def _of_variables(data: xr.Dataset) -> Iterator[tuple[str, dict[str, Any]]]:
    for name, variable in data.variables.items():
        if variable.dtype.kind == "f":
            yield str(name), _COMPRESSION if name in data.data_vars else {"_FillValue": None}


def _foreign(file: Path) -> RecordingError:
    return RecordingError(f"{file} is no recording of neuromech. Hint: give a results file of 'neuromech run'")
