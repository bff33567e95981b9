"""The gallery shows what its commands make: every picture is there, small, and made by a command of its page."""

import re
import shlex
from pathlib import Path

import pytest
from PIL import Image

GALLERY = Path(__file__).parents[1] / "docs" / "gallery"
PAGES = sorted(GALLERY.glob("*.md"))
LARGEST = 200_000
"""Size of a picture in bytes, at most."""


def pictures(page):
    """Return (what makes it, link) of each picture of a page; '' for a picture that nothing makes."""
    return re.findall(r"(?:<!-- from: (\S+) -->\n)?!\[[^\]]*\]\(([^)]+)\)", page.read_text("utf-8"))


def outputs(page):
    """Return what the commands of a page write to."""
    commands = re.findall(r"^\$ neuromech (.+)$", page.read_text("utf-8"), re.MULTILINE)
    words = [shlex.split(command) for command in commands]
    return [command[command.index("--out") + 1] for command in words if "--out" in command]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_pictures_are_there_and_small(page):
    assert pictures(page)
    for _, link in pictures(page):
        file = page.parent / link
        assert file.stat().st_size <= LARGEST, link
        with Image.open(file) as picture:
            assert picture.width >= 600


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_every_picture_is_made_by_a_command_of_its_page(page):
    written = outputs(page)
    for source, link in pictures(page):
        assert any(source == output or source.startswith(f"{output}/") for output in written), link


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_no_picture_is_left_over(page):
    linked = {page.parent / link for _, link in pictures(page)}
    assert set((page.parent / page.stem).glob("*")) == linked
