"""The studies in one database: a SQLite file, or a PostgreSQL server."""

import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import Any

from optuna.exceptions import DuplicatedStudyError
from optuna.logging import WARNING, set_verbosity
from optuna.storages import RDBStorage
from optuna.study import StudyDirection
from sqlalchemy.engine import URL, make_url
from sqlalchemy.exc import ArgumentError, SQLAlchemyError

from neuromech.errors import MissingExtraError, StudyError
from neuromech.study.header import Header
from neuromech.study.storage import StoredStudy, reason, working

HEADER = "neuromech"
CONNECTION_SECONDS = 10
LOCK_SECONDS = 60


class Database:
    """The studies in one database."""

    def __init__(self, place: str, create: bool = True) -> None:
        """Connect.

        Args:
            place: a SQLite file, or a URL like `sqlite:///study.db` or `postgresql://user@host/database`.
            create: whether the file and the tables are made where there are none.

        Raises:
            StudyError: this is no URL, no server answers there, or the database is none of Optuna's.
            MissingExtraError: the driver of such a database is not installed.
        """
        self._url = _url(place)
        set_verbosity(WARNING)
        if self._is_file and not (create or Path(self._url.database or "").is_file()):
            raise StudyError(f"{self.shown}: there is no such file. Hint: give the storage of 'neuromech optimize'")
        with _connecting(self.shown):
            self._storage = RDBStorage(self._url.render_as_string(hide_password=False), self._engine_arguments())

    @property
    def shown(self) -> str:
        """The file, or the URL without its password."""
        return (self._url.database or "") if self._is_file else self._url.render_as_string()

    def names(self) -> list[str]:
        """Return the names of our studies, oldest first.

        Raises:
            StudyError: the database fails.
        """
        with working(self.shown):
            studies = sorted(self._storage.get_all_studies(), key=lambda study: study._study_id)
            return [study.study_name for study in studies if HEADER in study.user_attrs]

    def create(self, name: str, header: Header) -> StoredStudy:
        """Begin a study.

        Raises:
            StudyError: there is one of that name, or the database fails.
        """
        if name in self.names():
            hint = "--resume continues it; another --name or --storage begins a new one"
            raise StudyError(f"{self.shown} holds a study '{name}' already. Hint: {hint}")
        with working(self.shown):
            try:
                number = self._storage.create_new_study([StudyDirection.MAXIMIZE], name)
            except DuplicatedStudyError:
                # Begun by a process that was killed before it could say what study this is.
                number = self._storage.get_study_id_from_name(name)
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
    except ArgumentError as error:
        raise StudyError(f"'{place}' is no database URL. Hint: postgresql://USER@HOST/DATABASE, or a file") from error
    return url.set(drivername="postgresql+psycopg") if url.drivername in ("postgres", "postgresql") else url


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
        raise MissingExtraError("the driver of this database", "postgresql") from error
    except SQLAlchemyError as error:
        hint = "start the server, or leave out '--storage' to use a file"
        raise StudyError(f"no database can be used at {shown}: {reason(error)}. Hint: {hint}") from error
    except RuntimeError as error:
        raise StudyError(f"{shown} was made by another version of Optuna: {error}") from error
