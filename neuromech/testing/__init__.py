"""Conformance suites for authors of components and engines. The library itself imports nothing from here."""
