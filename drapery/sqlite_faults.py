"""Why SQLite refused, by the code of its error and not by its text, which versions change.

See "Result and Error Codes", https://www.sqlite.org/rescode.html.
"""

import sqlite3
from typing import Literal

Cause = Literal["locked", "damaged", "unwritable", "full", "other"]

_CAUSES: dict[int, Cause] = {
    sqlite3.SQLITE_BUSY: "locked",
    sqlite3.SQLITE_LOCKED: "locked",
    sqlite3.SQLITE_CORRUPT: "damaged",
    sqlite3.SQLITE_NOTADB: "damaged",
    sqlite3.SQLITE_CANTOPEN: "unwritable",
    sqlite3.SQLITE_PERM: "unwritable",
    sqlite3.SQLITE_READONLY: "unwritable",
    sqlite3.SQLITE_FULL: "full",
}


def sqlite_cause(error: BaseException | None) -> Cause:
    """The cause of an error of the module `sqlite3`."""
    if isinstance(error, UnicodeDecodeError):
        return "damaged"  # SQLite's message quotes bytes of the file, which are no text
    code = getattr(error, "sqlite_errorcode", None)
    if code is None:
        # It is the module's own: a text of the file is not UTF-8.
        return "damaged" if isinstance(error, sqlite3.OperationalError) else "other"
    return _CAUSES.get(code & 0xFF, "other")  # the lowest byte of an extended code is its kind


def sqlite_name(error: BaseException | None) -> str:
    """The name of an error's code, such as `SQLITE_IOERR_WRITE`, or the name of its class."""
    return str(getattr(error, "sqlite_errorname", type(error).__name__))
