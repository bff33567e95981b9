"""The entry point: arguments and help of every command; what a command does is loaded when it is called."""

import gc
import sys
from collections.abc import Sequence
from importlib.metadata import version
from pathlib import Path
from typing import Annotated, Literal

import typer

from neuromech.cli.problems import Format
from neuromech.cli.terminal import exits, keep_stdout_for_results, of_extra, report_bug, without_banners, write_line

Spec = Annotated[Path, typer.Argument(metavar="SPEC", help="A document.")]
Paths = Annotated[list[Path], typer.Argument(metavar="PATH…", help="Documents, or folders of documents.")]
Overrides = Annotated[
    list[str] | None, typer.Option("--set", metavar="PATH=VALUE", help="Change one value of the document; repeatable.")
]
Output = Annotated[Path | None, typer.Option(metavar="FILE", help="Where to write; default: stdout.")]
AsJson = Annotated[bool, typer.Option("--json", help="Write JSON to stdout instead of a table.")]
Storage = Annotated[str, typer.Argument(metavar="STORAGE", help="Database of a study: a file or a URL.")]
StudyName = Annotated[str | None, typer.Option("--name", help="Which study, where the database has several.")]
Workers = Annotated[int | None, typer.Option(min=1, metavar="N", help="Processes on this machine; default: all cores.")]
Dask = Annotated[str | None, typer.Option(metavar="ADDRESS", help="Run on the cluster of this Dask scheduler.")]
Results = Annotated[Path, typer.Argument(metavar="RESULTS", help="Results file of a run.")]
From = Annotated[str | None, typer.Option("--from", metavar="TIME", help="Where to begin, for example '5 s'.")]
To = Annotated[str | None, typer.Option("--to", metavar="TIME", help="Where to end.")]
View = Annotated[Literal["side", "front", "follow"], typer.Option(help="Where the camera stands.")]
Seeds = Annotated[int | None, typer.Option(min=1, help="Repeat each claim over this many seeds.")]

app = typer.Typer(
    help="Neuromechanical experiments as documents.",
    epilog="Exit codes: 0 finished, 1 a bug, 2 a bad document or argument, 3 a run ended early, 4 a claim not met.",
    no_args_is_help=True,
    add_completion=False,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
)


def main() -> None:
    """Run the command line; ends the process with the command's exit code."""
    # A command makes many objects and drops few: collecting them as often as usual costs a tenth of the time.
    gc.set_threshold(100_000)
    sys.excepthook = report_bug
    keep_stdout_for_results()
    typer.main.get_command(app)(prog_name="neuromech")


def run_arguments(arguments: Sequence[str]) -> None:
    """Run the command line with these arguments in this process.

    Raises:
        SystemExit: always, with the exit code.
    """
    typer.main.get_command(app)(list(arguments), prog_name="neuromech")


@app.callback(invoke_without_command=True)
def top(shows_version: Annotated[bool, typer.Option("--version", help="Show the version.")] = False) -> None:
    """Neuromechanical experiments as documents."""
    if shows_version:
        write_line(version("neuromech"))
        raise typer.Exit


@app.command()
@exits
def run(
    spec: Spec,
    overrides: Overrides = None,
    seed: Annotated[int | None, typer.Option(min=0, help="Seed of the random initial state.")] = None,
    duration: Annotated[str | None, typer.Option(metavar="TIME", help="Simulate this long, for example '5 s'.")] = None,
    out: Annotated[Path | None, typer.Option(metavar="DIR", help="Output folder; default: results/<name>.")] = None,
    as_json: AsJson = False,
    figures: Annotated[bool, typer.Option("--figures/--no-figures", help="Draw figures.", show_default=False)] = True,
    quiet: Annotated[bool, typer.Option("--quiet", help="No progress bar and no tables.")] = False,
    video: Annotated[bool, typer.Option("--video", help="Film the body.")] = False,
) -> int:
    """Simulate a document and write its results.

    Gives a results file, figures, a summary, and the verdicts on those claims that need no other run.
    """
    with without_banners():
        from neuromech.cli.run import Request, run

    return run(Request(spec, tuple(overrides or ()), seed, duration, out, as_json, figures, quiet, video))


@app.command()
@exits
def figures(
    results: Results,
    out: Annotated[Path, typer.Option(metavar="DIR", help="Output folder.")],
    form: Annotated[Literal["png", "svg"], typer.Option("--format", help="Of the files.")] = "png",
    after: Annotated[str | None, typer.Option(metavar="TIME", help="When the run was disturbed.")] = None,
) -> int:
    """Draw the figures of a run again.

    Each figure is drawn that the recorded signals allow; for the others the command says what they lack.
    """
    with without_banners():
        from neuromech.cli.pictures import figures

    return figures(results, out, form, after)


@app.command()
@exits
def stills(
    results: Results,
    out: Annotated[Path, typer.Option(metavar="FILE", help="PNG or SVG file to write.")],
    start: From = None,
    end: To = None,
    view: View = "side",
    number: Annotated[int, typer.Option(min=1, max=60, help="Number of pictures.")] = 6,
) -> int:
    """Draw a strip of pictures of the body, by default of one cycle."""
    with without_banners():
        from neuromech.cli.pictures import Stretch, stills

    return stills(results, out, Stretch(start, end), view, number)


@app.command()
@exits
def video(
    results: Results,
    out: Annotated[Path, typer.Option(metavar="FILE", help="MP4 file to write.")],
    start: From = None,
    end: To = None,
    view: View = "side",
    size: Annotated[str, typer.Option(metavar="WxH", help="Width and height in pixels.")] = "1280x720",
    fps: Annotated[int, typer.Option(min=1, max=240, help="Pictures per second of the film.")] = 30,
    slower: Annotated[float, typer.Option(min=0.01, max=1000.0, help="Slow motion by this factor.")] = 1.0,
) -> int:
    """Film the body as it was recorded."""
    with without_banners():
        from neuromech.cli.pictures import Stretch, VideoRequest, video

    return video(VideoRequest(results, out, Stretch(start, end), view, size, fps, slower))


@app.command()
@exits
def validate(
    paths: Paths,
    form: Annotated[Format, typer.Option("--format", help="How problems are written.")] = Format.TEXT,
) -> int:
    """Report everything that is wrong in documents."""
    from neuromech.cli.validate import validate

    return validate(paths, form)


@app.command()
@exits
def verify(paths: Paths, as_json: AsJson = False, seeds: Seeds = None) -> int:
    """Run documents and judge all their claims."""
    with without_banners():
        from neuromech.cli.verify import verify

    return verify(paths, as_json, seeds)


@app.command()
@exits
def explain(
    spec: Spec,
    path: Annotated[str, typer.Argument(metavar="PATH", help="Dotted path of a value.")],
    overrides: Overrides = None,
) -> int:
    """Say which file and line gave a value."""
    from neuromech.cli.explain import explain

    return explain(spec, path, tuple(overrides or ()))


@app.command()
@exits
def schema(out: Output = None) -> int:
    """Write the JSON Schema of documents, for editors."""
    from neuromech.cli.schema import schema

    return schema(out)


@app.command()
@exits
def graph(spec: Spec, out: Output = None, overrides: Overrides = None) -> int:
    """Show the elements and connections of a model.

    With --out file.svg the model is drawn, with --out file.graphml it is exported.
    """
    from neuromech.cli.graph import graph

    return graph(spec, out, tuple(overrides or ()))


@app.command()
@exits
def diff(
    first: Annotated[Path, typer.Argument(metavar="A", help="A document.")],
    second: Annotated[Path, typer.Argument(metavar="B", help="Another document.")],
) -> int:
    """Show how two models differ in structure and parameters."""
    from neuromech.cli.diff import diff

    return diff(first, second)


@app.command(name="compile")
@exits
def compile_(spec: Spec, overrides: Overrides = None) -> int:
    """Show the generated program of a model."""
    from neuromech.cli.compile import compile_

    return compile_(spec, tuple(overrides or ()))


@app.command()
@exits
def components(
    kind: Annotated[str | None, typer.Argument(metavar="KIND", help="One kind, or one family.")] = None,
) -> int:
    """Show the vocabulary.

    Without KIND one line for each kind; with KIND its parameters with units, defaults and bounds.
    """
    from neuromech.cli.components import components

    return components(kind)


@app.command()
@exits
def sweep(
    spec: Spec,
    names: Annotated[
        list[str] | None, typer.Argument(metavar="[NAME]…", help="Sweeps of the document; default: all.")
    ] = None,
    overrides: Overrides = None,
    workers: Workers = None,
    dask: Dask = None,
    out: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Output folder; default: results/<name>/sweeps.")
    ] = None,
    restart: Annotated[bool, typer.Option("--restart", help="Forget the runs of an interrupted sweep.")] = False,
    as_json: AsJson = False,
    figures: Annotated[bool, typer.Option("--figures/--no-figures", help="Draw figures.", show_default=False)] = True,
    quiet: Annotated[bool, typer.Option("--quiet", help="No progress bar and no tables.")] = False,
) -> int:
    """Vary parameters as a document's sweeps say, and measure.

    Gives a results file with labelled arrays, and figures. An interrupted sweep goes on where it was.
    """
    with without_banners():
        from neuromech.cli.sweep import Request, sweep

    request = Request(
        spec, tuple(names or ()), tuple(overrides or ()), workers, dask, out, restart, as_json, figures, quiet
    )
    return sweep(request)


@app.command()
@exits
def new(
    name: Annotated[str, typer.Argument(metavar="NAME", help="Name of the new document; NAME.yaml is written.")],
    base: Annotated[str, typer.Option("--from", metavar="SPEC", help="A shipped document, such as cat/suspended.")],
) -> int:
    """Start a document that extends a shipped one."""
    from neuromech.cli.new import new

    return new(name, base)


@app.command()
@exits
def optimize(
    spec: Spec,
    evaluations: Annotated[
        int | None, typer.Option(min=1, help="Evaluate this many candidates; default: what the document says.")
    ] = None,
    seed: Annotated[
        int | None, typer.Option(min=0, help="Seed of the search; default: what the document says.")
    ] = None,
    storage: Annotated[
        str | None, typer.Option(metavar="URL", help="Database: a file or a URL; default: results/<name>/study.db.")
    ] = None,
    name: Annotated[str | None, typer.Option(help="Name of the study; default: that of the document.")] = None,
    resume: Annotated[bool, typer.Option("--resume", help="Go on with a study; begin it where there is none.")] = False,
    workers: Workers = None,
    dask: Dask = None,
    write: Annotated[Path | None, typer.Option(metavar="FILE", help="Write the best candidate to a document.")] = None,
    quiet: Annotated[bool, typer.Option("--quiet", help="No progress.")] = False,
) -> int:
    """Search the parameters of a document as its section 'study' says.

    Whatever ends it, --resume goes on as if nothing had happened. Ctrl-C completes the evaluations under way first.
    """
    with without_banners(), of_extra("study"):
        from neuromech.cli.optimize import Request, optimize

    return optimize(Request(spec, evaluations, seed, storage, name, resume, workers, dask, write, quiet))


study_app = typer.Typer(help="Look at studies.", no_args_is_help=True, rich_markup_mode=None)
app.add_typer(study_app, name="study")


@study_app.command()
@exits
def show(
    storage: Storage,
    name: StudyName = None,
    as_json: AsJson = False,
    figure: Annotated[Path | None, typer.Option(metavar="FILE", help="Draw the convergence (.png or .svg).")] = None,
) -> int:
    """Show how far a study is: best, median, history, and what failed."""
    with of_extra("study"):
        from neuromech.cli.study import show

    return show(storage, name, as_json, figure)


@study_app.command()
@exits
def best(storage: Storage, name: StudyName = None, as_json: AsJson = False) -> int:
    """Show the parameters and the measures of the best candidate."""
    with of_extra("study"):
        from neuromech.cli.study import best

    return best(storage, name, as_json)


@study_app.command()
@exits
def export(
    storage: Storage,
    file: Annotated[Path, typer.Argument(metavar="FILE", help="To write: .csv, .parquet or .nc.")],
    name: StudyName = None,
) -> int:
    """Write every evaluation of a study to a table."""
    with of_extra("study"):
        from neuromech.cli.study import export

    return export(storage, file, name)


@app.command()
@exits
def bench(
    only: Annotated[
        list[str] | None, typer.Option("--only", metavar="NAME", help="This benchmark only; repeatable.")
    ] = None,
    repetitions: Annotated[int, typer.Option(min=1, help="Pairs of measurements.")] = 7,
    as_json: AsJson = False,
    markdown: Annotated[bool, typer.Option("--markdown", help="Write the table of docs/performance.md.")] = False,
    peers: Annotated[Path, typer.Option(metavar="DIR", help="Scripts of the peers.")] = Path("tests/benchmarks/peers"),
    python: Annotated[Path, typer.Option(metavar="FILE", help="Python with the peers' packages.")] = Path(
        ".venv-bench/bin/python"
    ),
    out: Annotated[Path, typer.Option(metavar="DIR", help="Where raw numbers are kept.")] = Path("results/bench"),
) -> int:
    """Measure our speed against peers and limits.

    Each side is measured in turn; what is shown are medians, ratios first. `make bench` makes what the peers need.
    """
    with without_banners():
        from neuromech.cli.bench import Request, bench

    return bench(Request(tuple(only or ()), repetitions, as_json, markdown, peers, python, out))
