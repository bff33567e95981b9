"""Print the lowest version of each dependency that `pyproject.toml` allows, as constraints for pip."""

import re
import tomllib
from pathlib import Path

PROJECT = Path(__file__).parents[1] / "pyproject.toml"


def lowest(requirement: str) -> str | None:
    """Return `name==version` for `name>=version,…` or `name==version`, None where there is no lower bound."""
    found = re.match(r"([\w.-]+)\s*[>=]=\s*([\w.]+)", requirement)
    return f"{found[1]}=={found[2]}" if found else None


def main() -> None:
    """Print the constraints, one a line."""
    content = tomllib.loads(PROJECT.read_text("utf-8"))
    extras = content["project"].get("optional-dependencies", {}).values()
    requirements = [*content["project"]["dependencies"], *(one for extra in extras for one in extra)]
    print("\n".join(filter(None, map(lowest, requirements))))  # noqa: T201


main()
