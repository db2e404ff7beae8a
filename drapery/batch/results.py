"""The results of a batch: an SQLite file that is consistent even if the process is killed."""

import sqlite3
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

from drapery.batch.jobs import Job, JobResult
from drapery.errors import OutputError
from drapery.sqlite_faults import sqlite_cause, sqlite_name

FILE = "drapery-batch.sqlite"

_SCHEMA = """
CREATE TABLE IF NOT EXISTS outputs (
    out TEXT PRIMARY KEY, key TEXT NOT NULL, place TEXT NOT NULL,
    state TEXT NOT NULL, why TEXT, tries INTEGER NOT NULL, seconds REAL NOT NULL,
    size INTEGER NOT NULL
) WITHOUT ROWID;
CREATE INDEX IF NOT EXISTS by_key ON outputs (key, state);
"""


@dataclass(frozen=True)
class OutputRecord:
    """The record of one output file.

    out: the file, relative to the output folder.
    key: see `picture_key`.
    place: of its row in the manifest.
    state: `done` or `failed`.
    error: why it failed, one line.
    tries: number of tries.
    seconds: duration of the last try [s].
    size: of the file [bytes].
    """

    out: str
    key: str
    place: str
    state: str
    error: str | None
    tries: int
    seconds: float
    size: int


class ResultsDB:
    """The results of a folder, opened by one run at a time.

    It is one table and four statements, for which the standard library is enough. `drapery batch`
    must work with an installation without extras.
    """

    def __init__(self, path: Path) -> None:
        """Open or make the file. Raises OutputError if that fails or another run has it open."""
        self.path = path
        with self._explained():
            self._db = sqlite3.connect(path, isolation_level=None, timeout=1.0)
            try:
                self._prepare()
            except BaseException:
                self._db.close()
                raise

    def _prepare(self) -> None:
        # The lock ends with its process, even if that is killed.
        self._db.execute("PRAGMA locking_mode = EXCLUSIVE")
        self._db.execute("PRAGMA journal_mode = WAL")
        # Written pages survive if the process is killed; a power cut may lose the last ones.
        self._db.execute("PRAGMA synchronous = NORMAL")
        self._db.executescript(_SCHEMA)

    def __enter__(self) -> "ResultsDB":
        return self

    def __exit__(self, *_: object) -> None:
        with suppress(sqlite3.Error):
            self._db.close()

    def records(self) -> dict[str, OutputRecord]:
        """All records, by output. Raises OutputError if the file is damaged."""
        with self._explained():
            rows = self._db.execute("SELECT * FROM outputs")
            return {row[0]: OutputRecord(*row) for row in rows}

    def done_with(self, key: str) -> list[OutputRecord]:
        """The outputs that hold the picture of this key. Raises OutputError."""
        query = "SELECT * FROM outputs WHERE key = ? AND state = 'done'"
        with self._explained():
            return [OutputRecord(*row) for row in self._db.execute(query, (key,))]

    def record(self, result: JobResult, tries: int) -> None:
        """Record the result of a job. Raises OutputError, as on a full disk."""
        state = "done" if result.error is None else "failed"
        self._write(
            (out, result.job.key, place, state, result.error, tries, result.seconds, result.size)
            for out, place in zip(result.job.outs, result.job.places, strict=True)
        )

    def record_copy(self, job: Job, source: OutputRecord) -> None:
        """Record that a job's outputs were copied from another of the same key."""
        self._write(
            (out, job.key, place, "done", None, 0, 0.0, source.size)
            for out, place in zip(job.outs, job.places, strict=True)
        )

    def _write(self, rows: Iterable[tuple[object, ...]]) -> None:
        with self._explained():
            try:
                self._db.execute("BEGIN")
                self._db.executemany(
                    "INSERT OR REPLACE INTO outputs VALUES (?,?,?,?,?,?,?,?)", rows
                )
                self._db.execute("COMMIT")
            except sqlite3.Error:
                if self._db.in_transaction:
                    with suppress(sqlite3.Error):
                        self._db.execute("ROLLBACK")
                raise

    @contextmanager
    def _explained(self) -> Iterator[None]:
        """Convert SQLite's errors to an OutputError with the remedy."""
        try:
            yield
        except (sqlite3.Error, UnicodeDecodeError) as error:
            raise OutputError(f"results {self.path}: {_remedy(error)}") from None


_REMEDIES = {
    "locked": "another run is using it; wait for it, or choose another folder",
    "damaged": "the file is damaged; delete it, or name another with --results",
    "unwritable": "it cannot be opened or written; name another with --results",
    "full": "the disk is full; make room, or name another with --results",
}


def _remedy(error: Exception) -> str:
    refused = f"SQLite refuses it ({sqlite_name(error)}); name another with --results"
    return _REMEDIES.get(sqlite_cause(error), refused)
