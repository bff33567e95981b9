"""The generated module: readable, free of names, one for all documents that differ in numbers only, kept on disk."""

import ast
import os
import subprocess
import sys
import time
from pathlib import Path

import pytest

from neuromech.compiler.lower import lower
from neuromech.pipeline import build_graph, load_document

ROOT = Path(__file__).parents[3]
CAT = ROOT / "specs" / "cat"


def lowered(file, *changes):
    return lower(build_graph(load_document(file, changes)))


def test_it_is_python_with_docstrings_and_without_names_of_elements():
    program = lowered(CAT / "quadruped_body.yaml")
    tree = ast.parse(program.source)
    functions = [node for node in tree.body if isinstance(node, ast.FunctionDef)]
    assert all(ast.get_docstring(node) for node in [tree, *functions])
    words = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)}
    words |= {node.value for node in ast.walk(tree) if isinstance(node, ast.Constant) and isinstance(node.value, str)}
    names = {element.name for element in program.graph.elements()}
    names |= {name.rpartition(".")[2] for name in names} - {"load", "stretch"}
    assert words.isdisjoint(names)


def test_it_names_the_source_of_every_equation():
    program = lowered(CAT / "leg_cpg.yaml")
    for kind in program.shape.kinds:
        assert f"# {kind.name}: {kind.cls.source}" in program.source


def test_documents_that_differ_in_numbers_share_one_file():
    first = lowered(CAT / "leg_cpg.yaml")
    second = lowered(CAT / "leg_cpg.yaml", "parameters.drive.value=1.7", "solver.step=0.25 ms", "protocol.seed=3")
    assert first.module_file == second.module_file
    assert first.module_file.read_text("utf-8") == first.source
    assert lowered(CAT / "leg_cpg.yaml", "solver.method=exponential_euler").module_file != first.module_file


@pytest.mark.parametrize(("changed", "is_new"), [("exponential.py", True), ("numerics.py", True), ("lower.py", False)])
def test_code_is_made_anew_when_a_kernel_changes_that_it_imports_directly_or_not(changed, is_new, monkeypatch):
    file, read = lowered(CAT / "leg_cpg.yaml").module_file, Path.read_bytes
    monkeypatch.setattr(Path, "read_bytes", lambda path: read(path) + (b"#" if path.name == changed else b""))
    assert (lowered(CAT / "leg_cpg.yaml").module_file != file) == is_new


def test_the_number_of_instances_does_not_change_the_code():
    """One leg and four, but for the drive that only the four have."""
    one, four = (lowered(CAT / f"{name}_cpg.yaml").source.splitlines() for name in ("leg", "quadruped"))
    assert [line for line in one if "def " in line] == [
        line for line in four if "def " in line and "fictive_load" not in line
    ]


DELAYED = ("network.synapses.excitatory={a: {a: {weight: 0.5, delay: 3 ms}}}",)


@pytest.mark.parametrize(("changes", "is_there"), [((), False), (DELAYED, True)])
def test_what_a_document_does_not_use_is_not_written(changes, is_there, tmp_path):
    (tmp_path / "small.yaml").write_text(SMALL)
    source = lowered(tmp_path / "small.yaml", *changes).source
    assert ("    delayed_inputs(step, fraction, p, F, I)" in source) == is_there
    assert not any(text in source for text in ("if <", "if not <", "if True", "if False"))


SMALL = """\
neuromech: 1
name: small
network: {neurons: {a: {kind: rate_neuron, time_constant: 10 ms}}}
protocol: {duration: 10 ms}
record: {all: {signals: ["*"], every: 1 ms}}
"""
TIMED = """\
import sys
from neuromech.pipeline import run
import time
start = time.process_time()
run(sys.argv[1])
print(time.process_time() - start)
"""


@pytest.mark.slow
def test_a_second_process_does_not_compile_again(tmp_path):
    file = tmp_path / "small.yaml"
    file.write_text(SMALL, encoding="utf-8")
    command = [sys.executable, "-W", "ignore", "-c", TIMED, str(file)]
    environment = {**os.environ, "NEUROMECH_CACHE_DIR": str(tmp_path / "cache")}
    took = []
    for _ in range(2):
        began = time.perf_counter()
        done = subprocess.run(command, check=True, capture_output=True, text=True, env=environment)
        took.append((float(done.stdout.splitlines()[-1]), time.perf_counter() - began))
    assert list((tmp_path / "cache").rglob("*.nbc"))
    assert took[1][0] < 1.0
    assert took[1][0] < 0.3 * took[0][0]
