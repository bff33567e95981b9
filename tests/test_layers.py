"""The architecture, as a test: each layer imports only those below it, and nothing of ours is imported late."""

import ast
from pathlib import Path

import pytest

PACKAGE = Path(__file__).parents[1] / "neuromech"
LAYERS = (
    ("errors", "units"),
    ("components",),
    ("spec",),
    ("graph",),
    ("compiler",),
    ("bodies",),
    ("simulate",),
    ("analyse",),
    ("study",),
    ("report",),
    ("verification",),
    ("pipeline",),
    ("bench",),
    ("cli",),
    ("testing",),
)
RANK = {name: rank for rank, names in enumerate(LAYERS) for name in names}


def layer_of(module: str) -> str:
    return module.split(".")[1]


def own_modules(node: ast.stmt) -> list[str]:
    """Return the modules of this package that an import statement names; a relative one counts as the root."""
    if isinstance(node, ast.Import):
        return [alias.name for alias in node.names if alias.name.split(".")[0] == "neuromech"]
    if isinstance(node, ast.ImportFrom):
        if node.level:
            return ["neuromech"]
        if node.module and node.module.split(".")[0] == "neuromech":
            return [node.module]
    return []


def late_imports(tree: ast.Module) -> set[ast.stmt]:
    functions = (node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef))
    return {node for function in functions for node in ast.walk(function) if isinstance(node, ast.stmt)}


def violations(module: str, source: str) -> list[str]:
    """Return what an own import of a module's source does against the rules, as `line: what`."""
    tree = ast.parse(source)
    inside_functions = late_imports(tree)
    layer = layer_of(module)
    found = []
    for node in ast.walk(tree):
        for target in own_modules(node) if isinstance(node, ast.stmt) else []:
            place = f"{module}:{node.lineno}"
            if len(target.split(".")) == 1 or is_package(target):
                found.append(f"{place} imports from the package root {target}")
            elif layer_of(target) not in RANK:
                found.append(f"{place} imports {target}, which belongs to no layer")
            elif RANK[layer_of(target)] > RANK[layer] or (layer_of(target) != layer and target_beside(target, layer)):
                found.append(f"{place} imports {target}, which is not below {layer}")
            if node in inside_functions and layer != "cli":
                found.append(f"{place} imports {target} inside a function")
    return found


def is_package(target: str) -> bool:
    return PACKAGE.joinpath(*target.split(".")[1:]).is_dir()


def target_beside(target: str, layer: str) -> bool:
    return RANK[layer_of(target)] == RANK[layer]


def modules() -> list[Path]:
    return sorted(path for path in PACKAGE.rglob("*.py") if path.name != "__init__.py")


def module_name(path: Path) -> str:
    return ".".join(("neuromech", *path.relative_to(PACKAGE).with_suffix("").parts))


def test_every_module_imports_only_what_lies_below_it():
    found = [text for path in modules() for text in violations(module_name(path), path.read_text("utf-8"))]
    assert not found, "\n".join(found)


def test_every_folder_and_file_of_the_package_belongs_to_a_layer():
    names = {path.relative_to(PACKAGE).parts[0].removesuffix(".py") for path in modules()}
    assert names <= RANK.keys()


def test_package_roots_hold_a_docstring_only():
    for path in PACKAGE.rglob("__init__.py"):
        body = ast.parse(path.read_text("utf-8")).body
        assert [type(node) for node in body] == [ast.Expr], f"{path} holds more than a docstring"


@pytest.mark.parametrize(
    ("module", "source", "said"),
    [
        ("neuromech.graph.build", "from neuromech.compiler.lower import lower", "not below graph"),
        ("neuromech.graph.build", "import neuromech.simulate.run", "not below graph"),
        ("neuromech.units", "from neuromech.errors import Mark", "not below units"),
        ("neuromech.spec.load", "def f():\n    from neuromech.errors import Mark", "inside a function"),
        ("neuromech.spec.load", "class C:\n  async def f(self):\n    import neuromech.errors", "inside a function"),
        ("neuromech.spec.load", "import neuromech", "package root"),
        ("neuromech.spec.load", "from neuromech import errors", "package root"),
        ("neuromech.spec.load", "from neuromech.components import base", "package root"),
        ("neuromech.spec.load", "from . import fields", "package root"),
        (
            "neuromech.spec.load",
            "if TYPE_CHECKING:\n    from neuromech.graph.model import Element",
            "not below spec",
        ),
        ("neuromech.cli.run", "from neuromech.testing.law import law", "not below cli"),
        ("neuromech.cli.run", "from neuromech.drawer.things import thing", "no layer"),
    ],
)
def test_the_rules_catch(module: str, source: str, said: str):
    found = violations(module, source)
    assert len(found) == 1, found
    assert said in found[0]


@pytest.mark.parametrize(
    ("module", "source"),
    [
        ("neuromech.graph.build", "from neuromech.graph.model import ModelGraph\nfrom neuromech.errors import Mark"),
        ("neuromech.cli.main", "def f():\n    from neuromech.cli.run import run"),
        ("neuromech.spec.load", "import numpy\nfrom pathlib import Path\ndef f():\n    import scipy"),
    ],
)
def test_the_rules_allow(module: str, source: str):
    assert violations(module, source) == []
