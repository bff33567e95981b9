"""What a benchmark ran on."""

import os
import platform
from collections.abc import Iterable
from importlib.metadata import version
from pathlib import Path

_PACKAGES = ("neuromech", "numpy", "numba", "llvmlite", "pybullet")
_CPU_FILE = Path("/proc/cpuinfo")


def machine() -> dict[str, object]:
    """Return processor, usable cores, load at this moment, operating system and versions as plain values."""
    return {
        "processor": _processor(_lines(_CPU_FILE)),
        "cores": len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count(),
        "load": list(os.getloadavg()) if hasattr(os, "getloadavg") else None,
        "platform": platform.platform(),
        "python": platform.python_version(),
        "versions": {package: version(package) for package in _PACKAGES},
    }


def _lines(file: Path) -> list[str]:
    return file.read_text("utf-8").splitlines() if file.exists() else []


def _processor(lines: Iterable[str]) -> str:
    found = dict(line.split(":", 1) for line in lines if ":" in line)
    fields = {name.strip(): value.strip() for name, value in found.items()}
    name = fields.get("model name") or platform.processor() or platform.machine()
    wide = "AVX-512" if "avx512f" in fields.get("flags", "") else "AVX2" if "avx2" in fields.get("flags", "") else ""
    return f"{name}, {wide}" if wide else name
