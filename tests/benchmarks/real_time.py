"""How much faster than real time each shipped document runs, compilation left out."""

import sys
from pathlib import Path

from neuromech.pipeline import run

SPECS = Path(__file__).parents[2] / "specs"
SECONDS = 2.0


def main() -> None:
    """Run every document twice, first to have it compiled, and write the real-time factor of the second run."""
    for file in sorted(SPECS.rglob("*.yaml")):
        run(file, duration=0.01)
        provenance = run(file, duration=SECONDS).provenance
        factor = provenance.simulated_seconds / provenance.wall_seconds
        sys.stdout.write(f"{file.relative_to(SPECS)}  {factor:.3g} × real time\n")


if __name__ == "__main__":
    main()
