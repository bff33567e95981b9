"""Versions of installed packages, each looked up once: reading the metadata of a package takes milliseconds."""

from functools import cache
from importlib.metadata import version


@cache
def package_version(package: str) -> str:
    """Return the version of an installed package.

    Raises:
        PackageNotFoundError: it is not installed.
    """
    return version(package)
