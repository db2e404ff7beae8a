"""Files are replaced whole: a failure leaves the older file, and one line says why."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from drapery.errors import OutputError


def partial_path(path: Path) -> Path:
    """A hidden name in the same folder, thus on the same disk, so that a rename is atomic."""
    return path.with_name(f".{path.name}.{os.getpid()}.part")


def check_writable(path: Path) -> None:
    """Refuse a file target that cannot work, before anything costly is drawn."""
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
    """Make a folder and those above it, where they are not there. Raises OutputError."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        reason = "a file is in its place" if isinstance(error, FileExistsError) else error.strerror
        raise OutputError(f"cannot make the folder {folder}: {reason}; choose another") from error


@contextmanager
def explained(path: Path) -> Iterator[None]:
    """Turn the system's refusal to write `path` into an OutputError.

    An OSError that names a file elsewhere comes from the drawing of a frame, so it passes through.
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

    Raises OutputError where the target cannot be written. Whatever is raised, no partial file
    remains and an older target stays as it was.
    """
    check_writable(path)
    partial = partial_path(path)
    try:
        with explained(path):
            yield partial
            partial.replace(path)
    finally:
        partial.unlink(missing_ok=True)
