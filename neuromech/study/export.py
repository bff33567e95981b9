"""All evaluations of a study as one table or one dataset: CSV, Parquet, NetCDF."""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType

import numpy as np
import pandas as pd
import xarray as xr

from neuromech.errors import MissingExtraError, StudyError
from neuromech.study.evaluation import Evaluation, RunResult
from neuromech.study.header import Header


def dataset(header: Header, evaluations: Sequence[Evaluation]) -> xr.Dataset:
    """Return a study as a dataset of the dimensions `evaluation` and `run`.

    `parameter:NAME` are in the unit of the document (attribute `units`), `measure:NAME` in SI units. Where a number
    could not be measured, or a candidate failed, there is NaN; `outcome` and `failure` say what happened. `confirms` is
    the number of the evaluation that this one confirms after the search, `center`, or empty.
    """
    columns: dict[str, tuple[tuple[str, ...], object] | tuple[tuple[str, ...], object, dict[str, str]]] = {
        "generation": (("evaluation",), [one.generation for one in evaluations]),
        "index": (("evaluation",), [one.index for one in evaluations]),
        "stage": (("evaluation",), [-1 if one.score is None else one.score.stage for one in evaluations]),
        "score": (("evaluation",), [np.nan if one.score is None else one.score.value for one in evaluations]),
        "confirms": (("evaluation",), ["" if one.confirms is None else str(one.confirms) for one in evaluations]),
        "failure": (("evaluation",), [one.failure or "" for one in evaluations]),
        "wall_seconds": (("evaluation",), [one.wall_seconds for one in evaluations], {"units": "s"}),
        "simulated_seconds": (("evaluation",), [one.simulated_seconds for one in evaluations], {"units": "s"}),
    }
    for name, unit in header.units.items():
        numbers = [float(one.parameters[name].partition(" ")[0]) for one in evaluations]
        columns[f"parameter:{name}"] = (("evaluation",), numbers, {"units": unit})
    columns |= _of_runs(evaluations)
    attributes = {"study": header.document, "seed": header.seed, "specification": header.specification}
    return xr.Dataset(columns, {"evaluation": [one.number for one in evaluations]}, attributes)


def table(header: Header, evaluations: Sequence[Evaluation]) -> pd.DataFrame:
    """Return a study as a table with one row for each evaluation; what each run has gets columns like `seed[0]`."""
    content = dataset(header, evaluations)
    columns: dict[str, object] = {"evaluation": content["evaluation"].values}
    for name, values in content.data_vars.items():
        unit = f" [{values.attrs['units']}]" if values.attrs.get("units") else ""
        if values.dims == ("evaluation",):
            columns[f"{name}{unit}"] = values.values
        else:
            columns |= {f"{name}[{run}]{unit}": values.values[:, run] for run in range(values.shape[1])}
    return pd.DataFrame(columns)


def export(header: Header, evaluations: Sequence[Evaluation], file: Path) -> None:
    """Write a study to a file; its suffix chooses the format.

    Raises:
        StudyError: there is no format for this suffix.
        MissingExtraError: the library for this format is not installed.
        OSError: the file cannot be written.
    """
    write = FORMATS.get(file.suffix.lower())
    if write is None:
        raise StudyError(f"{file}: no format for '{file.suffix}'. Hint: choose one of {', '.join(FORMATS)}")
    write(header, evaluations, file)


def _csv(header: Header, evaluations: Sequence[Evaluation], file: Path) -> None:
    table(header, evaluations).to_csv(file, index=False)


def _parquet(header: Header, evaluations: Sequence[Evaluation], file: Path) -> None:
    try:
        table(header, evaluations).to_parquet(file, index=False)
    except ImportError as error:
        raise MissingExtraError("pyarrow", "export") from error


def _netcdf(header: Header, evaluations: Sequence[Evaluation], file: Path) -> None:
    dataset(header, evaluations).to_netcdf(file, engine="h5netcdf")


FORMATS: Mapping[str, Callable[[Header, Sequence[Evaluation], Path], None]] = MappingProxyType(
    {".csv": _csv, ".parquet": _parquet, ".nc": _netcdf}
)


def _of_runs(evaluations: Sequence[Evaluation]) -> dict[str, tuple[tuple[str, ...], object]]:
    """Return what every run has, (evaluation, run); a failed evaluation lacks runs."""
    runs = max((len(one.runs) for one in evaluations), default=0)
    names = dict.fromkeys(name for one in evaluations for run in one.runs for name in run.measures)
    dimensions = ("evaluation", "run")

    def column(value: Callable[[RunResult], object], absent: object) -> tuple[tuple[str, ...], object]:
        rows = [[value(run) for run in one.runs] + [absent] * (runs - len(one.runs)) for one in evaluations]
        return dimensions, np.array(rows).reshape(len(evaluations), runs)

    found = {
        "scenario": column(lambda run: run.scenario, ""),
        "seed": column(lambda run: run.seed, -1),
        "outcome": column(lambda run: run.kind, ""),
        "end": column(lambda run: run.time, np.nan),
    }
    for name in names:
        numeric = any(isinstance(run.measures.get(name), float) for one in evaluations for run in one.runs)
        found[f"measure:{name}"] = column(_number(name), np.nan) if numeric else column(_words(name), "")
    return found


def _number(name: str) -> Callable[[RunResult], object]:
    def value(run: RunResult) -> object:
        measured = run.measures.get(name)
        return measured if isinstance(measured, float) else np.nan

    return value


def _words(name: str) -> Callable[[RunResult], object]:
    return lambda run: str(run.measures.get(name, ""))
