"""The studies in one database: a SQLite file, or a PostgreSQL server."""

import sqlite3
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from types import MappingProxyType, TracebackType
from typing import Any, Self

from optuna.exceptions import DuplicatedStudyError, StorageInternalError
from optuna.logging import WARNING, set_verbosity
from optuna.storages import RDBStorage
from optuna.study import StudyDirection
from sqlalchemy import Engine, create_engine, inspect, text
from sqlalchemy.engine import URL, make_url
from sqlalchemy.exc import ArgumentError, SQLAlchemyError
from sqlalchemy.pool import NullPool

from neuromech.errors import MissingExtraError, StudyError
from neuromech.study.header import Header
from neuromech.study.storage import StoredStudy, reason, working

HEADER = "neuromech"
CONNECTION_SECONDS = 10
LOCK_SECONDS = 60
MAKING_SECONDS = 10

_DRIVERS: Mapping[str, str] = MappingProxyType(
    {
        "sqlite": "sqlite",
        "postgres": "postgresql+psycopg",
        "postgresql": "postgresql+psycopg",
        "postgresql+psycopg": "postgresql+psycopg",
    }
)
_PLACES = "Hint: give a file, or postgresql://USER@HOST/DATABASE"


class Database:
    """The studies in one database; its connections are closed at the end of a `with` block."""

    def __init__(self, place: str, create: bool = True) -> None:
        """Connect.

        Args:
            place: a SQLite file, or a URL like `sqlite:///study.db` or `postgresql://user@host/database`.
            create: whether the file and its tables are made where there are none.

        Raises:
            StudyError: this is no URL, no server answers there, or the database is none of Optuna's.
            MissingExtraError: the driver of such a database is not installed.
        """
        self._url = _url(place)
        set_verbosity(WARNING)
        if self._is_file and not (create or Path(self._url.database or "").is_file()):
            raise StudyError(f"{self.shown}: there is no such file. Hint: give the storage of 'neuromech optimize'")
        with _connecting(self.shown):
            # Who only looks, and may look often, keeps no connections.
            made = self._made() if create else self._looked_at()
        if made is None:
            raise StudyError(f"{self.shown} holds no studies. Hint: give the storage of 'neuromech optimize'")
        self._storage = made

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self._storage.engine.dispose()

    @property
    def shown(self) -> str:
        """The file, or the URL without its password."""
        url = self._url.set(drivername=self._url.get_backend_name())
        return (url.database or "") if self._is_file else url.render_as_string()

    def names(self) -> list[str]:
        """Return the names of our studies, oldest first.

        Raises:
            StudyError: the database fails.
        """
        with working(self.shown):
            studies = sorted(self._storage.get_all_studies(), key=lambda study: study._study_id)
            return [study.study_name for study in studies if HEADER in study.user_attrs]

    def create(self, name: str, header: Header) -> StoredStudy:
        """Begin a study; one of the same name that has no evaluation yet is begun anew.

        Raises:
            StudyError: there is one of that name with evaluations, or the database fails.
        """
        with working(self.shown):
            try:
                number = self._storage.create_new_study([StudyDirection.MAXIMIZE], name)
            except DuplicatedStudyError:
                number = self._storage.get_study_id_from_name(name)
            if self._storage.get_n_trials(number):
                hint = "--resume continues it; another --name or --storage begins a new one"
                raise StudyError(f"{self.shown} holds a study '{name}' already. Hint: {hint}")
            self._storage.set_study_user_attr(number, HEADER, header.to_dict())
            return StoredStudy(self._storage, self.shown, number, header)

    def open(self, name: str) -> StoredStudy:
        """Return a study that exists.

        Raises:
            StudyError: there is none of that name, or the database fails.
        """
        if name not in self.names():
            held = ", ".join(f"'{one}'" for one in self.names()) or "none"
            raise StudyError(f"{self.shown} holds no study '{name}' (it holds {held})")
        with working(self.shown):
            number = self._storage.get_study_id_from_name(name)
            header = Header.from_dict(self._storage.get_study_user_attrs(number)[HEADER])
            return StoredStudy(self._storage, self.shown, number, header)

    def _made(self) -> RDBStorage:
        """Connect, and make the tables where there are none."""
        if not self._has_tables():
            self._make_tables()
        return self._connected(create=False)

    def _make_tables(self) -> None:
        try:
            self._connected(create=True, poolclass=NullPool)
        except SQLAlchemyError:
            # Another process may make them at the same moment.
            until = time.monotonic() + MAKING_SECONDS
            while not self._has_tables():
                if time.monotonic() > until:
                    raise
                time.sleep(0.1)

    def _looked_at(self) -> RDBStorage | None:
        """Connect to what is there; Optuna itself would add tables that are missing, and get in the way of others."""
        return self._connected(create=False, poolclass=NullPool) if self._has_tables() else None

    def _connected(self, create: bool, **pool: Any) -> RDBStorage:
        url = self._url.render_as_string(hide_password=False)
        return RDBStorage(url, self._engine_arguments() | pool, skip_table_creation=not create)

    def _has_tables(self) -> bool:
        return _is_complete(create_engine(self._url, poolclass=NullPool, **self._engine_arguments()))

    def _engine_arguments(self) -> dict[str, Any]:
        if self._is_file:
            return {"creator": partial(_file, self._url.database or "")}
        return {"connect_args": {"connect_timeout": CONNECTION_SECONDS}}

    @property
    def _is_file(self) -> bool:
        return self._url.get_backend_name() == "sqlite"


def _url(place: str) -> URL:
    """Return a URL; a text without `://` is a SQLite file."""
    if "://" not in place:
        return URL.create("sqlite", database=place)
    try:
        url = make_url(place)
    except (ArgumentError, ValueError) as error:
        raise StudyError(f"'{place}' is no database URL. {_PLACES}") from error
    if url.drivername not in _DRIVERS:
        raise StudyError(f"'{url.drivername}' is no database that studies are stored in. {_PLACES}")
    return url.set(drivername=_DRIVERS[url.drivername])


def _is_complete(engine: Engine) -> bool:
    """Return whether all of Optuna's tables are there; it names their version last."""
    if not inspect(engine).has_table("alembic_version"):
        return False
    with engine.connect() as connection:
        return connection.execute(text("SELECT version_num FROM alembic_version")).first() is not None


def _file(path: str) -> sqlite3.Connection:
    """Open a SQLite file so that readers are let in while we write, and the disk is rarely waited for.

    What a killed process stored is safe; a power failure may take back the last evaluations, and harms nothing else.
    """
    connection = sqlite3.connect(path, timeout=LOCK_SECONDS, check_same_thread=False)
    connection.execute("PRAGMA journal_mode=WAL")
    connection.execute("PRAGMA synchronous=NORMAL")
    return connection


@contextmanager
def _connecting(shown: str) -> Iterator[None]:
    try:
        yield
    except ImportError as error:
        raise MissingExtraError("psycopg", "postgresql") from error
    except (SQLAlchemyError, StorageInternalError, sqlite3.Error) as error:
        server = "start the server, or leave out '--storage' to use a file"
        hint = server if "://" in shown else "give another file"
        raise StudyError(f"no database can be used at {shown}: {reason(error)}. Hint: {hint}") from error
    except RuntimeError as error:
        raise StudyError(f"{shown} was made by another version of Optuna: {error}") from error
