"""Compiled kernels on disk.

numba's own cache checks only the file of a cached function, so an edit of a function that it calls
from another file gives stale results. Here the key has all that the function is compiled from, see
`drapery.kernel_sources`, and the versions of the compiler and its settings, such as
NUMBA_BOUNDSCHECK. Each key has a folder of its own, so that installations with the same sources
share their kernels. A damaged file is compiled again. A kernel of which something has no source is
not stored. If no folder can be written, kernels are compiled in every process, and a warning says
so once.
"""

import hashlib
import inspect
import logging
import os
import pickle
import re
import shutil
import stat
import tempfile
import warnings
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import llvmlite
import numba
from numba import config
from numba.core import caching
from numba.core.types import BaseTuple
from numba.misc.appdirs import AppDirs

from drapery.kernel_sources import SIMD, fields_of, source_key

LOG = logging.getLogger(__name__)
REMEDY = "set NUMBA_CACHE_DIR to a folder that can be written"
MAX_SOURCES = 24
"""The most folders that are kept of one kernel, each for one state of its sources."""
NOT_ABOUT_CODE = re.compile("CUDA|.*CUDA|DUMP_|CACHE_|COLOR_|.*NUM_THREADS|FULL_TRACEBACKS|.*WARN")
"""Names of settings of numba that change no machine code."""

_caching: Any = caching
_config: Any = config
_AppDirs: Any = AppDirs


@dataclass(frozen=True)
class KernelCacheStatus:
    """Where compiled kernels are stored. folder: None if nowhere. reason: why not, else empty."""

    folder: Path | None
    reason: str = ""


@cache
def kernel_cache_status() -> KernelCacheStatus:
    """The first folder of `cache_folders` that can be written; it is made and tested once."""
    reasons = []
    for folder, private in cache_folders():
        try:
            _try_folder(folder, private)
        except OSError as fault:
            reasons.append(f"{folder}: {fault.strerror or fault}")
        else:
            return KernelCacheStatus(folder)
    return KernelCacheStatus(None, "; ".join(reasons))


def cache_folders() -> Iterator[tuple[Path, bool]]:
    """Folders for compiled kernels, the best first, and whether only this user may write there.

    They are in NUMBA_CACHE_DIR if it is set, else beside the sources and in the user's cache
    folder; the last one is a private folder for temporary files.
    """
    if _config.CACHE_DIR:
        yield Path(_config.CACHE_DIR) / "drapery", False
    else:
        yield Path(__file__).parent / "__pycache__" / "kernels", False
        yield Path(_AppDirs(appname="numba", appauthor=False).user_cache_dir) / "drapery", False
    user = os.getuid() if hasattr(os, "getuid") else "user"
    with suppress(OSError):  # there may be no folder for temporary files
        yield Path(tempfile.gettempdir()) / f"drapery-kernels-{user}", True


def _try_folder(folder: Path, private: bool) -> None:
    """Make the folder if it is missing and write a file there. Raises OSError."""
    if private:
        folder.mkdir(mode=0o700, exist_ok=True)
        _check_private(folder)
    folder.mkdir(parents=True, exist_ok=True)
    tempfile.TemporaryFile(dir=folder).close()


def _check_private(folder: Path) -> None:
    """Raises OSError unless the folder is this user's: loading a cached kernel runs its code."""
    if not hasattr(os, "getuid"):
        return  # on Windows each user has a folder of temporary files
    found = folder.lstat()
    if not stat.S_ISDIR(found.st_mode) or found.st_uid != os.getuid() or found.st_mode & 0o077:
        raise PermissionError(f"{folder} is not private to this user")


def cache_on_disk(dispatcher: Any, entry_point: Any) -> Any:
    """Give a function that numba will compile a cache, if there is a folder for one."""
    if kernel_cache_status().folder is None:
        _warn_once(f"kernels are compiled in every process ({kernel_cache_status().reason})")
    elif key := source_key(entry_point):
        dispatcher._cache = _KernelCache(dispatcher.py_func, key)
    return dispatcher


@cache
def _warn_once(message: str) -> None:
    warnings.warn(f"{message}; {REMEDY}", stacklevel=2)


def folder_for(kernel: str, source: str) -> Path:
    """The folder for a kernel of sources with this key; it is made, and the oldest one deleted.

    The versions and settings that say what numba makes of the sources are part of its name.
    Raises OSError.
    """
    folder = kernel_cache_status().folder
    assert folder is not None
    key = f"{source} {compiler_settings()}"
    own = folder / kernel / hashlib.sha256(key.encode()).hexdigest()[:16]
    if not own.is_dir():
        own.mkdir(parents=True, exist_ok=True)
        _delete_oldest(own.parent)
    return own


@cache
def compiler_settings() -> str:
    """The versions and settings that decide what machine code sources become.

    A setting of numba that is not known to change no code counts, whatever it does.
    """
    found = {name: str(value) for name, value in vars(_config).items() if name.isupper()}
    chosen = {name: found[name] for name in sorted(found) if not NOT_ABOUT_CODE.match(name)}
    return f"{numba.__version__} {llvmlite.__version__} {os.environ.get(SIMD)} {chosen}"


def _delete_oldest(folder: Path) -> None:
    """Keep the folders that were written to last. Another process may delete the same ones."""
    with suppress(OSError):  # another process has deleted one of them
        folders = [each for each in folder.iterdir() if each.is_dir()]
        folders.sort(key=lambda each: each.stat().st_mtime)
        for each in folders[:-MAX_SOURCES]:
            shutil.rmtree(each, ignore_errors=True)


class _Locator(_caching._CacheLocator):  # type: ignore[misc]
    """Where numba stores one function. The folder has the key of its sources."""

    def __init__(self, function: Callable[..., object], key: str) -> None:
        self._function, self._key = function, key
        self._py_file = inspect.getfile(function)  # numba's warnings name it

    def get_cache_path(self) -> str:
        name = f"{self._function.__module__}.{self._function.__qualname__}"
        return str(folder_for(re.sub(r"[^\w.]", "_", name), self._key))

    def get_source_stamp(self) -> str:
        return self._key

    def get_disambiguator(self) -> str:
        return self._function.__module__

    def from_function(self, py_func: Any, py_file: str) -> "_Locator":
        return self


class _CacheFormat(_caching.CompileResultCacheImpl):  # type: ignore[misc]
    def __init__(self, function: Callable[..., object], key: str) -> None:
        self._locator_classes = [_Locator(function, key)]
        super().__init__(function)


class _CheckedFiles(_caching.IndexDataCacheFile):  # type: ignore[misc]
    """numba's files, with a hash before the machine code: loading damaged code ends the process."""

    def _save_data(self, name: str, data: object) -> None:
        content = self._dump(data)
        with self._open_for_write(self._data_path(name)) as file:
            file.write(hashlib.sha256(content).digest() + content)

    def _load_data(self, name: str) -> Any:
        content = Path(self._data_path(name)).read_bytes()
        if hashlib.sha256(content[32:]).digest() != content[:32]:
            raise pickle.UnpicklingError(f"{name} is damaged")
        return pickle.loads(content[32:])


def _fields(types: Any) -> Iterator[str]:
    """The names and defaults of the fields of each named tuple among types of numba."""
    for kind in types:
        if hasattr(kind, "instance_class"):
            yield fields_of(kind.instance_class)
        if isinstance(kind, BaseTuple):
            yield from _fields(kind)


class _KernelCache(_caching.FunctionCache):  # type: ignore[misc]
    """The cache of one function."""

    def __init__(self, function: Callable[..., object], key: str) -> None:
        self._impl_class = lambda function: _CacheFormat(function, key)
        super().__init__(function)
        self._cache_file = _CheckedFiles(self._cache_path, self._impl.filename_base, key)

    def _index_key(self, sig: Any, codegen: Any) -> Any:
        """numba's, with the fields of named tuples, whose types are equal in another order."""
        return (*super()._index_key(sig, codegen), *_fields(sig))

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        try:
            return super().load_overload(sig, target_context)
        except Exception as fault:  # whatever unpickling of damaged bytes raises
            LOG.info("a stored kernel in %s is compiled again: %s", self.cache_path, fault)
            with suppress(OSError):  # then `save_overload` says so
                self.flush()
            return None

    def save_overload(self, sig: Any, data: Any) -> None:
        try:
            super().save_overload(sig, data)
        except OSError as fault:
            _warn_once(f"compiled kernels cannot be stored in {self.cache_path} ({fault.strerror})")
