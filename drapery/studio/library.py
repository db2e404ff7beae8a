"""Saved designs: a file of SQLite, through SQLAlchemy.

Every change is one transaction that takes the file's lock at its start, so that several studios
may share a file. The file's application id identifies it as a library, and its user version gives
the version (SQLite, "Pragma statements").
"""

import json
import os
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from functools import cache
from pathlib import Path
from typing import Any

from sqlalchemy import URL, ForeignKey, String, create_engine, event, func, select, text
from sqlalchemy.exc import DBAPIError, SQLAlchemyError
from sqlalchemy.orm import DeclarativeBase, Mapped, Session, mapped_column, relationship
from sqlalchemy.pool import NullPool

from drapery import DesignError, OutputError
from drapery.sqlite_faults import sqlite_cause, sqlite_name
from drapery.studio.records import (
    MAX_DESIGNS,
    Design,
    checked,
    identity,
    read_designs,
    tree_of,
    words_of,
    write_designs,
)
from drapery.studio.share import of_tree

APPLICATION_ID = 0x44726170
""""Drap" in ASCII."""
VERSION = 1
FILE = "library.sqlite"

LOCK_TIMEOUT = 10.0
"""How long to wait while another studio changes the file [s]."""


class _Base(DeclarativeBase):
    pass


class _Row(_Base):
    __tablename__ = "designs"
    number: Mapped[int] = mapped_column(primary_key=True)
    title: Mapped[str] = mapped_column(String)
    tree: Mapped[str] = mapped_column(String)
    words: Mapped[str] = mapped_column(String)
    thumbnail: Mapped[bytes]
    changed: Mapped[int] = mapped_column(index=True)
    tags: Mapped[list["_Tag"]] = relationship(
        cascade="all, delete-orphan", order_by="_Tag.place", lazy="selectin"
    )


class _Tag(_Base):
    __tablename__ = "tags"
    design: Mapped[int] = mapped_column(ForeignKey("designs.number"), primary_key=True)
    place: Mapped[int] = mapped_column(primary_key=True)
    name: Mapped[str] = mapped_column(String, index=True)


class Library:
    """The designs in one file. Several threads and processes may have it open."""

    def __init__(self, path: Path, *, lock_timeout: float = LOCK_TIMEOUT) -> None:
        """Open the file, or make it and its folder.

        lock_timeout: how long to wait for another writer [s]. Raises OutputError for a file that
        is not a library, has a newer version, is damaged, locked or cannot be written.
        """
        self.path = path
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            reason = f"{error.strerror}; name another file with --library"
            raise OutputError(f"library {path}: {reason}") from None
        self._engine = create_engine(
            URL.create("sqlite", database=str(path)),
            # Do not start transactions implicitly.
            connect_args={"timeout": lock_timeout, "isolation_level": None},
            poolclass=NullPool,  # a connection belongs to one thread, and threads end
        )
        event.listen(self._engine, "connect", _set_pragmas)
        event.listen(self._engine, "begin", lambda conn: conn.exec_driver_sql("BEGIN IMMEDIATE"))
        with self._change() as session:
            _prepare(session, path)

    def add(self, design: Design) -> int:
        """Save a design; returns its number. Raises DesignError or OutputError."""
        valid = checked(design)
        with self._change() as session:
            _check_room(session, 1)
            return _insert(session, valid)

    def change(self, design: Design) -> None:
        """Replace the saved design that has the same number. Raises DesignError, OutputError."""
        valid = checked(design)
        with self._change() as session:
            _fill(_found(session, design.number), valid, _next(session))

    def get(self, number: int) -> Design:
        """The design with this number. Raises DesignError, OutputError."""
        with self._change() as session:
            return _design(_found(session, number))

    def remove(self, number: int) -> Design:
        """Remove and return a design; `add` restores it. Raises DesignError, OutputError."""
        with self._change() as session:
            row = _found(session, number)
            design = _design(row)
            session.delete(row)
            return design

    def search(
        self, words: str = "", tag: str | None = None, *, first: int = 0, limit: int = 60
    ) -> tuple[list[Design], int]:
        """The designs with all words, and their total number.

        It searches title, tags, dyes and patterns. first, limit: the returned part of the list; the
        design that was changed last comes first. Raises OutputError.
        """
        wanted = select(_Row)
        for word in words.lower().split()[:16]:
            wanted = wanted.where(_Row.words.contains(word[:80], autoescape=True))
        if tag is not None:
            wanted = wanted.where(_Row.tags.any(_Tag.name == tag))
        page = wanted.order_by(_Row.changed.desc()).offset(first).limit(limit)
        with self._change() as session:
            count = session.scalar(select(func.count()).select_from(wanted.subquery()))
            return [*_readable(session.scalars(page))], count or 0

    def tags(self) -> dict[str, int]:
        """All tags with the number of designs that have each. Raises OutputError."""
        counted = select(_Tag.name, func.count()).group_by(_Tag.name).order_by(_Tag.name)
        with self._change() as session:
            return {row[0]: row[1] for row in session.execute(counted)}

    def dump(self) -> bytes:
        """The whole library as JSON, ordered by each design's last change. Raises OutputError."""
        with self._change() as session:
            rows = session.scalars(select(_Row).order_by(_Row.changed))
            return write_designs(_design(row) for row in rows)

    def load(self, data: bytes) -> tuple[int, int]:
        """Add all designs of an export file; returns the numbers of new and of existing designs.

        Raises DesignError, which names the place, if a design is not valid; then adds none.
        """
        return self.add_new(read_designs(data))

    def add_new(self, designs: Iterable[Design]) -> tuple[int, int]:
        """Add those designs that are not here yet; returns their number and the number of others.

        designs: each as `checked` returns it. Raises DesignError or OutputError; then adds none.
        """
        designs = [*designs]
        with self._change() as session:
            known = {(row.tree, _names(row)) for row in session.scalars(select(_Row))}
            fresh = [design for design in designs if identity(design) not in known]
            # A design that occurs twice in one file counts once.
            unique = list({identity(design): design for design in fresh}.values())
            _check_room(session, len(unique))
            for design in unique:
                _insert(session, design)
        return len(unique), len(designs) - len(unique)

    @contextmanager
    def _change(self) -> Iterator[Session]:
        """A session for one transaction."""
        try:
            with Session(self._engine) as session, session.begin():
                yield session
        except DBAPIError as error:
            raise OutputError(f"library {self.path}: {_reason(error.orig)}") from None
        except UnicodeDecodeError as error:  # in place of an error of SQLite
            raise OutputError(f"library {self.path}: {_reason(error)}") from None
        except SQLAlchemyError as error:
            reason = f"it cannot be used ({type(error).__name__}); move it away"
            raise OutputError(f"library {self.path}: {reason}") from None


@cache
def opened(path: Path) -> Library:
    """The library of a file, opened once but by threads that ask at once. Raises OutputError."""
    return Library(path)


def default_place(environment: dict[str, str] | None = None) -> Path:
    """The path of the user's library, in the system's folder for application data.

    On Linux this is XDG_DATA_HOME (XDG Base Directory Specification 0.8), if it is absolute.
    """
    words = os.environ if environment is None else environment
    home = Path(words.get("HOME") or Path.home())
    if sys.platform == "win32":
        folder = Path(words.get("LOCALAPPDATA") or home / "AppData" / "Local")
    elif sys.platform == "darwin":
        folder = home / "Library" / "Application Support"
    else:
        chosen = Path(words.get("XDG_DATA_HOME", ""))
        folder = chosen if chosen.is_absolute() else home / ".local" / "share"
    return folder / "drapery" / FILE


def _set_pragmas(connection: Any, _record: object) -> None:
    connection.execute("PRAGMA foreign_keys = ON")
    # Views and triggers of an untrusted file must not call functions.
    connection.execute("PRAGMA trusted_schema = OFF")


def _prepare(session: Session, path: Path) -> None:
    """Make the tables in a new file. Raises OutputError for a file that is not a library."""
    found = session.scalar(text("PRAGMA application_id"))
    version = session.scalar(text("PRAGMA user_version")) or 0
    tables = session.scalar(text("SELECT count(*) FROM sqlite_master"))
    if found == APPLICATION_ID and version > VERSION:
        raise OutputError(
            f"library {path} has version {version}, and this Drapery reads {VERSION};"
            " update Drapery, or name another file with --library"
        )
    if found == APPLICATION_ID:
        return
    if tables or found:
        raise OutputError(
            f"library {path} is another program's file; name another file with --library"
        )
    _Base.metadata.create_all(session.connection())
    session.execute(text(f"PRAGMA application_id = {APPLICATION_ID}"))
    session.execute(text(f"PRAGMA user_version = {VERSION}"))


_REASONS = {
    "locked": "another program uses it; close that program",
    "unwritable": "it cannot be written; change its permissions",
    "damaged": "it is damaged or not a library; move it away",
    "full": "the disk is full; make room",
}


def _reason(error: BaseException | None) -> str:
    refused = f"SQLite refuses it ({sqlite_name(error)}); repair that"
    first = _REASONS.get(sqlite_cause(error), refused)
    return f"{first}, or name another file with --library"


def _insert(session: Session, design: Design) -> int:
    row = _Row()
    _fill(row, design, _next(session))
    session.add(row)
    session.flush()
    return row.number


def _fill(row: _Row, design: Design, changed: int) -> None:
    row.title, row.thumbnail, row.changed = design.title, design.thumbnail, changed
    row.tree, row.words = tree_of(design), words_of(design)
    row.tags = [_Tag(place=place, name=name) for place, name in enumerate(design.tags)]


def _next(session: Session) -> int:
    return (session.scalar(select(func.max(_Row.changed))) or 0) + 1


def _check_room(session: Session, count: int) -> None:
    if (session.scalar(select(func.count(_Row.number))) or 0) + count > MAX_DESIGNS:
        raise DesignError(f"a library holds at most {MAX_DESIGNS} designs; delete some first")


def _found(session: Session, number: int) -> _Row:
    row = session.get(_Row, number) if 0 < number < 1 << 63 else None
    if row is None:
        raise DesignError("the design is no longer in the library; search again")
    return row


def _readable(rows: Iterable[_Row]) -> Iterator[Design]:
    """The designs of the rows; skips rows that another program has damaged."""
    for row in rows:
        with suppress(DesignError):
            yield _design(row)


def _design(row: _Row) -> Design:
    try:
        sketch, settings = of_tree(json.loads(row.tree))
    except (ValueError, RecursionError, DesignError):
        raise DesignError(f"design {row.number} of the library is damaged; delete it") from None
    return Design(sketch, settings, _names(row), row.thumbnail, row.number, row.changed)


def _names(row: _Row) -> tuple[str, ...]:
    return tuple(tag.name for tag in row.tags)
