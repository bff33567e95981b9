"""Recorded signals as labelled arrays of xarray, with dimensions and units."""

import json
from collections.abc import Mapping

import numpy as np
import xarray as xr

from neuromech.simulate.recording import GroupData, Provenance


def labelled_tree(groups: Mapping[str, GroupData], provenance: Provenance) -> xr.DataTree:
    """Return recorded groups and where they come from as one tree, laid out as `Recording.tree` says."""
    nodes = {f"/{name}": _dataset(data) for name, data in groups.items()}
    return xr.DataTree.from_dict({"/": xr.Dataset(attrs=provenance.to_attributes()), **nodes})


def _dataset(data: GroupData) -> xr.Dataset:
    variables: dict[str, xr.Variable] = {}
    coordinates: dict[str, xr.Variable] = {"time": xr.Variable("time", data.time, {"units": "s"})}
    for (quantity, unit, variable), columns in _variables(data).items():
        dimension = f"{variable}_element"
        elements = np.array([data.names[column].rpartition(".")[0] for column in columns], dtype=np.str_)
        coordinates[dimension] = xr.Variable(dimension, elements)
        attributes = {"units": unit, "quantity": quantity}
        variables[variable] = xr.Variable(("time", dimension), data.values[:, _slice(columns)], attributes)
    return xr.Dataset(variables, coordinates, {"signals": json.dumps(data.names)})


def _slice(columns: list[int]) -> slice | list[int]:
    """Return neighbouring columns as a slice, which copies nothing."""
    neighbours = columns == list(range(columns[0], columns[0] + len(columns)))
    return slice(columns[0], columns[-1] + 1) if neighbours else columns


def _variables(data: GroupData) -> dict[tuple[str, str, str], list[int]]:
    """Return {(quantity, unit, variable name): columns}; the unit joins the name where one quantity has several."""
    quantities = [name.rpartition(".")[2] for name in data.names]
    units_of: dict[str, set[str]] = {}
    for quantity, unit in zip(quantities, data.units, strict=True):
        units_of.setdefault(quantity, set()).add(unit)
    found: dict[tuple[str, str, str], list[int]] = {}
    for column, (quantity, unit) in enumerate(zip(quantities, data.units, strict=True)):
        suffix = "_" + _word(unit) if len(units_of[quantity]) > 1 else ""
        found.setdefault((quantity, unit, quantity + suffix), []).append(column)
    return found


def _word(unit: str) -> str:
    return unit.replace("/", " per ").replace("^", "").replace("  ", " ").strip().replace(" ", "_") or "number"
