"""Replaces files as a whole: a failure leaves the older file, with an error in one line."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from drapery.errors import OutputError


def partial_path(path: Path) -> Path:
    """A hidden name in the same folder, thus on the same disk, so that a rename is atomic."""
    return path.with_name(f".{path.name}.{os.getpid()}.part")


def check_writable(path: Path) -> None:
    """Raise OutputError for a target that cannot be written, before anything is drawn."""
    parent = path.parent
    if path.is_dir():
        raise OutputError(f"cannot write {path}: it is a folder; add a file name")
    if not parent.exists():
        raise OutputError(f"cannot write {path}: the folder {parent} does not exist; make it first")
    if not parent.is_dir():
        raise OutputError(f"cannot write {path}: {parent} is not a folder")
    if not os.access(parent, os.W_OK | os.X_OK):
        raise OutputError(f"cannot write {path}: the folder {parent} may not be written to")


def make_folder(folder: Path) -> None:
    """Make a folder and its parents unless they exist. Raises OutputError."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        reason = "a file is in its place" if isinstance(error, FileExistsError) else error.strerror
        raise OutputError(f"cannot make the folder {folder}: {reason}; choose another") from error


@contextmanager
def explained(path: Path) -> Iterator[None]:
    """Convert an OSError about `path` into an OutputError.

    An OSError about another file comes from the drawing of a frame and is raised unchanged.
    """
    try:
        yield
    except OSError as error:
        if error.filename is not None and partial_path(path).name not in str(error.filename):
            raise
        reason = error.strerror or str(error)
        raise OutputError(
            f"cannot write {path}: {reason}; repair that or choose another file"
        ) from error


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """A path beside the target to write to, which takes the target's place if the block succeeds.

    Raises OutputError if the target cannot be written. After any error no partial file remains and
    an older target is unchanged.
    """
    check_writable(path)
    partial = partial_path(path)
    try:
        with explained(path):
            yield partial
            partial.replace(path)
    finally:
        partial.unlink(missing_ok=True)
