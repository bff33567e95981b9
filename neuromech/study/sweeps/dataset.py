"""The results of a sweep as labelled arrays: one dimension for each varied parameter, and one for the seeds.

A measure is a variable. Where it has no value, `<measure>_missing` says why, in words; it is empty everywhere else. How
the runs ended is a variable of its own. So NaN stands for nothing but a missing number that is explained beside it.
"""

import json
import platform
from collections.abc import Mapping, Sequence
from importlib.metadata import version
from pathlib import Path
from typing import Any, Final

import numpy as np
import xarray as xr

from neuromech.errors import RecordingError
from neuromech.simulate.storage import write_complete
from neuromech.spec.document import Document
from neuromech.study.sweeps.checks import SweptMeasure
from neuromech.study.sweeps.design import Block, Design
from neuromech.study.sweeps.results import PointResult

FORMAT: Final = "neuromech sweep 1"
_PACKAGES: Final = ("neuromech", "numpy", "scipy", "numba", "pybullet")


def dataset(
    document: Document, name: str, design: Design, kinds: Mapping[str, SweptMeasure], results: Sequence[PointResult]
) -> xr.DataTree:
    """Return the results of a complete sweep.

    A grid is the root of the tree. Other designs have a node for each parameter, or for each pair (`drive and load`).

    Args:
        document: the document of the sweep.
        name: of the sweep.
        design: its points.
        kinds: what each measure gives.
        results: one for each point.
    """
    nodes = {"/": xr.Dataset()}
    for number, block in enumerate(design.blocks):
        found = [result for result in results if result.point.block == number]
        nodes[f"/{block.name}"] = _block(block, design.repetitions, kinds, found)
    nodes["/"] = nodes["/"].assign_attrs(_provenance(document, name, results))
    return xr.DataTree.from_dict(nodes)


def save(tree: xr.DataTree, file: Path) -> None:
    """Write the results of a sweep to a NetCDF4 file, which gets its name only when it is complete.

    Raises:
        RecordingError: the file cannot be written.
    """
    write_complete(tree, file)


def load(file: Path) -> xr.DataTree:
    """Read what `save` wrote, wholly into memory.

    Raises:
        RecordingError: the file is missing, unreadable, or no sweep of ours.
    """
    if not file.is_file():
        raise RecordingError(f"{file} does not exist. Hint: 'neuromech sweep' writes it")
    try:
        with xr.open_datatree(file, engine="h5netcdf") as opened:
            tree: xr.DataTree = opened.load()
    except (OSError, KeyError, ValueError, TypeError) as error:
        raise _foreign(file) from error
    if tree.attrs.get("format") != FORMAT:
        raise _foreign(file)
    return tree


def _block(
    block: Block, repetitions: int, kinds: Mapping[str, SweptMeasure], results: Sequence[PointResult]
) -> xr.Dataset:
    dimensions = (*(axis.name for axis in block.axes), "seed")
    shape = (*block.shape, repetitions)
    seeds = {result.point.repetition: result.seed for result in results}
    coordinates: dict[str, Any] = {
        axis.name: (axis.name, np.array(axis.values), {"units": axis.unit}) for axis in block.axes
    }
    coordinates["seed"] = ("seed", np.array([seeds[repetition] for repetition in range(repetitions)]))
    variables: dict[str, Any] = {}
    for name, kind in kinds.items():
        values = {_place(result): result.measures[name] for result in results}
        words = {place: str(value) for place, value in values.items() if kind.is_missing(value)}
        taken = {place: value for place, value in values.items() if place not in words}
        if kind.unit is None:
            variables[name] = (dimensions, _texts(shape, {place: str(value) for place, value in taken.items()}))
        else:
            numbers = {place: float(value) for place, value in taken.items()}
            variables[name] = (dimensions, _numbers(shape, numbers), {"units": kind.unit})
        variables[f"{name}_missing"] = (dimensions, _texts(shape, words), {"long_name": f"why there is no {name}"})
    ends = {_place(result): result.end for result in results}
    described = {"long_name": "simulated time at which the point was left or its run ended", "units": "s"}
    variables["outcome"] = (dimensions, _texts(shape, {_place(result): result.outcome for result in results}))
    variables["end"] = (dimensions, _numbers(shape, ends), described)
    variables["message"] = (dimensions, _texts(shape, {_place(result): result.message for result in results}))
    return xr.Dataset(variables, coordinates)


def _place(result: PointResult) -> tuple[int, ...]:
    return (*result.point.position, result.point.repetition)


def _numbers(shape: tuple[int, ...], values: Mapping[tuple[int, ...], float]) -> np.ndarray[Any, np.dtype[np.float64]]:
    found = np.full(shape, np.nan)
    for place, value in values.items():
        found[place] = value
    return found


def _texts(shape: tuple[int, ...], values: Mapping[tuple[int, ...], str]) -> np.ndarray[Any, np.dtype[np.str_]]:
    found = np.full(shape, "", dtype=object)
    for place, value in values.items():
        found[place] = value
    return found.astype(np.str_)


def _provenance(document: Document, name: str, results: Sequence[PointResult]) -> dict[str, str]:
    return {
        "format": FORMAT,
        "name": document.experiment.name,
        "sweep": name,
        "specification": document.text,
        "versions": json.dumps({package: version(package) for package in _PACKAGES}),
        "platform": f"{platform.platform()}, Python {platform.python_version()}",
        "engine": ", ".join(sorted({result.engine for result in results if result.engine})),
    }


def _foreign(file: Path) -> RecordingError:
    return RecordingError(f"{file} is no sweep of neuromech. Hint: give a file of 'neuromech sweep'")
