"""Draw the pictures of the gallery again: run the commands of its pages, and make what they link to small.

Without arguments all pages are done, else those that are named.
"""

import re
import shlex
import subprocess
import sys
from pathlib import Path

from PIL import Image

ROOT = Path(__file__).parents[1]
GALLERY = ROOT / "docs" / "gallery"
COMMAND = re.compile(r"^\$ neuromech (.+)$", re.MULTILINE)
PICTURE = re.compile(r"^<!-- from: (?P<source>\S+) -->\n!\[[^\]]*\]\((?P<target>[^)]+)\)$", re.MULTILINE)

WIDEST = 1500
"""Width of a picture in pixels, at most."""

COLORS = 64
"""Number of colours that a picture keeps, which makes it a third as large."""


def run(page: str) -> None:
    """Run the commands of a page from the root of the repository."""
    for arguments in COMMAND.findall(page):
        command = [sys.executable, "-m", "neuromech.cli", *shlex.split(arguments)]
        code = subprocess.run(command, cwd=ROOT, check=False).returncode
        if code not in (0, 4):  # A claim that is not met is no failure of the gallery.
            raise SystemExit(f"{shlex.join(command)} ended with {code}")


def take(page: Path, source: str, target: str) -> None:
    """Put a small copy of a picture to where a page links to it."""
    with Image.open(ROOT / source) as picture:
        small = picture.convert("RGB")
    small.thumbnail((WIDEST, WIDEST), Image.Resampling.LANCZOS)
    file = page.parent / target
    file.parent.mkdir(parents=True, exist_ok=True)
    # Median cut would give rare colours, as those of thin lines, to their neighbours.
    small.quantize(COLORS, Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE).save(file, optimize=True)


def main() -> None:
    """Do the pages that were asked for."""
    for name in sys.argv[1:] or sorted(file.stem for file in GALLERY.glob("*.md")):
        page = GALLERY / f"{name}.md"
        text = page.read_text("utf-8")
        run(text)
        for found in PICTURE.finditer(text):
            take(page, found["source"], found["target"])


main()
