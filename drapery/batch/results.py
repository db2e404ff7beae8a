"""What has been done: a file of SQLite that a kill at any moment leaves sound."""

import sqlite3
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from drapery.batch.jobs import Job, JobResult
from drapery.errors import OutputError

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
    """What the results says of an output. state: done or failed, with why."""

    out: str
    key: str
    place: str
    state: str
    why: str | None
    tries: int
    seconds: float
    size: int


class ResultsDB:
    """One run's worker on the file; another run is refused while it is held."""

    def __init__(self, path: Path) -> None:
        """Open or make the file. Raises OutputError where that fails, or another run holds it."""
        self.path = path
        try:
            self._db = sqlite3.connect(path, isolation_level=None, timeout=1.0)
            # The lock ends with its process, however that ends.
            self._db.execute("PRAGMA locking_mode = EXCLUSIVE")
            self._db.execute("PRAGMA journal_mode = WAL")
            # A written page outlives a killed process; only a power cut may take the last ones.
            self._db.execute("PRAGMA synchronous = NORMAL")
            self._db.executescript(_SCHEMA)
        except sqlite3.Error as error:
            raise OutputError(f"results {path}: {_reason(error)}") from None

    def __enter__(self) -> "ResultsDB":
        return self

    def __exit__(self, *_: object) -> None:
        self._db.close()

    def known(self) -> dict[str, OutputRecord]:
        """All entries, by output."""
        rows = self._db.execute("SELECT * FROM outputs")
        return {row[0]: OutputRecord(*row) for row in rows}

    def done_with(self, key: str) -> Iterator[OutputRecord]:
        """The outputs that hold the picture of this key."""
        query = "SELECT * FROM outputs WHERE key = ? AND state = 'done'"
        return (OutputRecord(*row) for row in self._db.execute(query, (key,)).fetchall())

    def record(self, result: JobResult, tries: int) -> None:
        """Write down what came of a job. Raises OutputError, as on a full disk."""
        state = "done" if result.error is None else "failed"
        self._write(
            (o, result.job.key, p, state, result.error, tries, result.seconds, result.size)
            for o, p in zip(result.job.outs, result.job.places, strict=True)
        )

    def copied(self, job: Job, entry: OutputRecord) -> None:
        """Write down that outputs were copied from another of the same key."""
        self._write(
            (out, job.key, place, "done", None, 0, 0.0, entry.size)
            for out, place in zip(job.outs, job.places, strict=True)
        )

    def _write(self, rows: Iterable[tuple[object, ...]]) -> None:
        try:
            self._db.execute("BEGIN")
            self._db.executemany("INSERT OR REPLACE INTO outputs VALUES (?,?,?,?,?,?,?,?)", rows)
            self._db.execute("COMMIT")
        except sqlite3.Error as error:
            if self._db.in_transaction:
                self._db.execute("ROLLBACK")
            raise OutputError(f"results {self.path}: {_reason(error)}") from None


def _reason(error: sqlite3.Error) -> str:
    text = str(error)
    if "locked" in text:
        return "another run is using it; wait for it, or choose another folder"
    return f"{text}; mend that, or name another with --results"
