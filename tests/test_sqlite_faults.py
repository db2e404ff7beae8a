"""SQLite's errors are told apart by their codes, whatever their texts are."""

import gc
import sqlite3
from contextlib import closing
from pathlib import Path

import pytest

from drapery.batch.results import ResultsDB
from drapery.errors import OutputError
from drapery.sqlite_faults import Cause, sqlite_cause, sqlite_name


def fault(path: Path, command: str, **options: object) -> sqlite3.Error:
    with (
        closing(sqlite3.connect(path, isolation_level=None, timeout=0, **options)) as db,  # type: ignore[call-overload]
        pytest.raises(sqlite3.Error) as raised,
    ):
        db.execute(command).fetchall()
    return raised.value


def test_causes_are_told_apart_by_their_codes(tmp_path: Path) -> None:
    path, broken = tmp_path / "a.sqlite", tmp_path / "broken.sqlite"
    broken.write_bytes(b"no database" * 200)
    with closing(sqlite3.connect(path, isolation_level=None)) as db:
        db.execute("CREATE TABLE a (b TEXT)")
        db.execute("INSERT INTO a VALUES (CAST(X'FF' AS TEXT))")
        db.execute("BEGIN EXCLUSIVE")
        locked = fault(path, "SELECT * FROM a")
        db.execute("ROLLBACK")
    found: dict[Cause, sqlite3.Error] = {
        "locked": locked,
        "damaged": fault(broken, "SELECT * FROM sqlite_master"),
        "unwritable": fault(f"file:{path}?mode=ro", "DELETE FROM a", uri=True),  # type: ignore[arg-type]
        "other": fault(path, "SELECT * FROM nothing"),
    }
    assert {cause: sqlite_cause(error) for cause, error in found.items()} == {
        cause: cause for cause in found
    }
    assert sqlite_cause(fault(path, "SELECT b FROM a")) == "damaged", "a text that is not UTF-8"
    assert sqlite_name(found["other"]) == "SQLITE_ERROR"
    assert (sqlite_cause(None), sqlite_name(ValueError())) == ("other", "ValueError")


@pytest.mark.filterwarnings("error")
def test_results_that_are_refused_leave_no_connection(tmp_path: Path) -> None:
    (tmp_path / "broken").write_bytes(b"no database" * 200)
    with pytest.raises(OutputError, match="the file is damaged"):
        ResultsDB(tmp_path / "broken")
    with ResultsDB(tmp_path / "results"), pytest.raises(OutputError, match="another run"):
        ResultsDB(tmp_path / "results")
    gc.collect()  # would warn of a connection that is still open
