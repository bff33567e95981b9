"""Where a benchmark finds what it needs, and a folder for what it makes."""

from dataclasses import dataclass
from pathlib import Path

from neuromech.bench.peers import PeerError

ENVIRONMENT_HINT = "`make bench` makes the environment of the peers"


@dataclass(frozen=True, slots=True)
class Workspace:
    """Paths and sizes of a benchmark run.

    Args:
        specs: folder of the shipped documents.
        peers: folder of the peers' scripts.
        python: interpreter of the peers' environment.
        folder: for temporary files.
        steps: network steps of one measurement of the small network.
        body_seconds: simulated time of one measurement of a body (s).
    """

    specs: Path
    peers: Path
    python: Path
    folder: Path
    steps: int = 20_000
    body_seconds: float = 5.0

    def script(self, name: str) -> list[str | Path]:
        """Return the command that starts a peer's script in the peers' environment.

        Raises:
            PeerError: script or environment are not there.
        """
        script = self.source(name)
        if not self.python.exists():
            raise PeerError(f"{self.python} is not there: {ENVIRONMENT_HINT}")
        return [self.python, script]

    def source(self, name: str) -> Path:
        """Return a file of the peers.

        Raises:
            PeerError: it is not there.
        """
        file = self.peers / name
        if not file.exists():
            raise PeerError(f"{file} is not there: run in the repository, or say --peers")
        return file
