"""Peers as processes that stay alive: they answer one line to each line, so that runs interleave without restarts."""

import json
import subprocess
import tempfile
from collections.abc import Sequence
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from neuromech.errors import NeuromechError


class PeerError(NeuromechError):
    """A peer is not there, failed, or does not compute what we compute."""

    exit_code = 3


class Peer:
    """A running peer. Use it in a `with` block."""

    def __init__(self, command: Sequence[str | Path]) -> None:
        """Start the process and read its greeting.

        Raises:
            PeerError: it cannot be started, or ends before it greets.
        """
        self._errors = tempfile.TemporaryFile("w+")  # noqa: SIM115
        try:
            self._process = subprocess.Popen(
                [str(part) for part in command],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=self._errors,
                text=True,
            )
        except OSError as error:
            self._errors.close()
            raise PeerError(f"{command[0]} cannot be started: {error.strerror}") from error
        try:
            self._greeting: dict[str, Any] = json.loads(self._read())
        except BaseException:
            self.close()
            raise

    @property
    def description(self) -> str:
        """Name, version and scheme."""
        return "{name} {version}, {scheme}".format(**self._greeting)

    def run(self, steps: int) -> float:
        """Let it simulate from its initial state; return the seconds that it took.

        Raises:
            PeerError: it ended.
        """
        return float(self._ask(f"run {steps}"))

    def trace(self) -> list[float]:
        """Return the reference neuron's potential of its last run (V).

        Raises:
            PeerError: it ended.
        """
        values: list[float] = json.loads(self._ask("trace"))
        return values

    def close(self) -> None:
        """End the process."""
        if self._process.stdin:
            self._process.stdin.close()
        if self._process.stdout:
            self._process.stdout.close()
        try:
            self._process.wait(timeout=10.0)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        self._errors.close()

    def __enter__(self) -> Self:
        """Return the peer."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """End the process."""
        self.close()

    def _ask(self, line: str) -> str:
        if self._process.stdin is None:
            raise PeerError("the peer is closed")
        try:
            self._process.stdin.write(f"{line}\n")
            self._process.stdin.flush()
        except BrokenPipeError as error:
            raise PeerError(self._last_words()) from error
        return self._read()

    def _read(self) -> str:
        line = self._process.stdout.readline() if self._process.stdout else ""
        if not line:
            raise PeerError(self._last_words())
        return line

    def _last_words(self) -> str:
        self._process.wait(timeout=10.0)
        self._errors.seek(0)
        lines = [line.strip() for line in self._errors.read().splitlines() if line.strip()]
        return lines[-1] if lines else f"the peer ended with code {self._process.returncode}"
