"""Where outputs go: a folder, or any target that fsspec knows. Each file is written whole."""

import contextlib
import os
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, Protocol

from drapery.errors import OutputError

BUCKETS = frozenset({"s3", "s3a", "gs", "gcs", "az", "abfs"})
"""Targets whose first folder is a bucket, which somebody must have made."""
WHOLE_AT_ONCE = BUCKETS | {"memory"}
"""Targets where a file appears only when it is complete."""

_PART = re.compile(r"\.(.+)\.\d+\.part")


class Store(Protocol):
    """A place for outputs, by relative names with slashes. Workers get a copy of it."""

    @property
    def label(self) -> str:
        """The name that messages give it."""

    def write(self, name: str, data: bytes) -> None:
        """Store a file whole or not at all. Raises OutputError."""

    def read(self, name: str) -> bytes:
        """A file's bytes. Raises OutputError."""

    def sizes(self, names: Sequence[str]) -> list[int | None]:
        """The sizes of files [bytes], None where there is none. Raises OutputError where that
        cannot be found out: a file that is not seen would be drawn again."""


@dataclass(frozen=True)
class LocalStore:
    """A folder, on this machine or shared by several."""

    folder: Path

    @property
    def label(self) -> str:
        return str(self.folder)

    def path(self, name: str) -> Path:
        """Where the file lies."""
        return self.folder / name

    def prepare(self, name: str) -> Path:
        """The path of a file that is to be written, its folder made. Raises OutputError."""
        path = self.path(name)
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise OutputError(f"cannot write {path}: {error.strerror}; repair that") from None
        return path

    def write(self, name: str, data: bytes) -> None:
        """See `Store`."""
        from drapery.output_files import replacing

        with replacing(self.prepare(name)) as beside:
            beside.write_bytes(data)

    def read(self, name: str) -> bytes:
        """See `Store`."""
        try:
            return self.path(name).read_bytes()
        except OSError as error:
            raise OutputError(f"cannot read {self.path(name)}: {error.strerror}") from None

    def sizes(self, names: Sequence[str]) -> list[int | None]:
        """See `Store`."""
        return [_size(self.path(name)) for name in names]

    def remove_partial_files(self, names: Iterable[str]) -> None:
        """Remove what killed workers have left of these files, half-written."""
        ours = {self.path(name) for name in names}
        for folder in {path.parent for path in ours}:
            # The folder may be missing, and another process may remove the same files.
            with contextlib.suppress(FileNotFoundError), os.scandir(folder) as entries:
                for entry in entries:
                    part = _PART.fullmatch(entry.name)
                    if part is not None and folder / part[1] in ours:
                        Path(entry.path).unlink(missing_ok=True)


@dataclass(frozen=True)
class RemoteStore:
    """A folder behind an address such as `s3://bucket/folder`, by fsspec."""

    url: str

    @property
    def label(self) -> str:
        return self.url

    def write(self, name: str, data: bytes) -> None:
        """See `Store`."""
        fs, path = self._at(name)
        try:
            if self.url.partition("://")[0] in WHOLE_AT_ONCE:
                # Without `makedirs`: there are no folders, and it would make a missing bucket.
                fs.pipe_file(path, data)
            else:
                fs.makedirs(path.rpartition("/")[0], exist_ok=True)
                beside = f"{path}.{os.getpid()}.part"
                fs.pipe_file(beside, data)
                fs.mv(beside, path)
        except Exception as error:
            # Each of fsspec's targets raises what its own library does.
            raise OutputError(f"cannot write {self.url}/{name}: {_why(error)}") from None

    def read(self, name: str) -> bytes:
        """See `Store`."""
        fs, path = self._at(name)
        try:
            data: bytes = fs.cat_file(path)
        except Exception as error:
            raise OutputError(f"cannot read {self.url}/{name}: {_why(error)}") from None
        return data

    def sizes(self, names: Sequence[str]) -> list[int | None]:
        """See `Store`; one listing, not a question for each file."""
        fs, root = _file_system(self.url)
        try:
            found = fs.find(root, detail=True)
        except FileNotFoundError:  # nothing is written yet
            found = {}
        except Exception as error:
            raise OutputError(f"cannot list {self.url}: {_why(error)}") from None
        sizes = {path.lstrip("/"): int(info["size"]) for path, info in found.items()}
        return [sizes.get(self._at(name)[1].lstrip("/")) for name in names]

    def _at(self, name: str) -> tuple[Any, str]:
        fs, root = _file_system(self.url)
        return fs, f"{root.rstrip('/')}/{name}"


def _why(error: Exception) -> str:
    """The system's message for an error, or the name that the target's library gives to it."""
    name = getattr(error, "strerror", None) or type(error).__name__
    return f"{name}; check the address and your rights"


def _size(path: Path) -> int | None:
    try:
        return path.stat().st_size
    except (FileNotFoundError, NotADirectoryError):
        return None
    except OSError as error:
        raise OutputError(f"cannot find out whether {path} exists: {error.strerror}") from None


def _check_bucket(url: str) -> None:
    """Raise OutputError for a bucket that is missing: a job would be drawn before that is seen."""
    fs, root = _file_system(url)
    bucket = root.lstrip("/").partition("/")[0]
    try:
        fs.info(bucket)  # `exists` takes a server that does not answer for a missing bucket
    except FileNotFoundError:
        raise OutputError(
            f"{url}: there is no bucket {bucket}; make it, or correct the address"
        ) from None
    except PermissionError:  # whoever may write need not be one who may list
        pass
    except Exception as error:
        raise OutputError(f"{url} cannot be opened: {_why(error)}") from None


@cache
def _file_system(url: str) -> tuple[Any, str]:
    try:
        from fsspec.core import url_to_fs

        fs, root = url_to_fs(url)
    except ImportError as error:
        # The cause of fsspec's own error names the library that an address needs.
        missing = error.name or getattr(error.__cause__, "name", None) or "fsspec"
        raise OutputError(f"{url}: {missing} is missing; install it") from None
    except Exception as error:
        raise OutputError(f"{url} cannot be opened: {_why(error)}") from None
    return fs, str(root)


def open_store(target: str) -> Store:
    """The store at a folder or an address with `://`. Raises OutputError."""
    if "://" in target:
        url = target.rstrip("/")
        _file_system(url)
        if url.partition("://")[0] in BUCKETS:
            _check_bucket(url)
        return RemoteStore(url)
    folder = Path(target).absolute()
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"cannot make {folder}: {error.strerror}; name another folder") from None
    if not os.access(folder, os.W_OK | os.X_OK):
        raise OutputError(f"the folder {folder} may not be written to; name another")
    return LocalStore(folder)
