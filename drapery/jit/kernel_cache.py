"""Compiled kernels on disk.

The key of a kernel has all that it is compiled from, see `drapery.jit.sources`, the versions of
the compiler, its settings, such as NUMBA_BOUNDSCHECK, and the processor. Each key has a folder of
its own, so that installations with the same sources share their kernels. A damaged file is
compiled again. A kernel of which something has no source is not stored. If no folder can be
written, kernels are compiled in every process, and a warning says so once.
"""

import hashlib
import json
import logging
import os
import re
import shutil
import stat
import sys
import tempfile
import warnings
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from importlib.metadata import version
from pathlib import Path
from typing import Any

from drapery.jit.arguments import ABI
from drapery.jit.objects import KernelObject, processor
from drapery.jit.sources import SIMD, source_key

LOG = logging.getLogger(__name__)
REMEDY = "set NUMBA_CACHE_DIR to a folder that can be written"
MAX_SOURCES = 24
"""The most folders that are kept of one kernel, each for one state of its sources."""
NOT_ABOUT_CODE = re.compile(
    "NUMBA_(CUDA|.*CUDA|DUMP_|CACHE_|COLOR_|.*NUM_THREADS|FULL_TRACEBACKS|.*WARN)"
)
"""Variables of the environment that numba reads and that change no machine code."""
NUMBA_SETTINGS = ".numba_config.yaml"
"""A file of the working directory that numba reads."""


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
            try_folder(folder, private)
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
    if chosen := os.environ.get("NUMBA_CACHE_DIR"):
        yield Path(chosen) / "drapery", False
    else:
        yield Path(__file__).parent / "__pycache__" / "kernels", False
        yield _user_cache_folder() / "drapery-kernels", False
    user = os.getuid() if hasattr(os, "getuid") else "user"
    with suppress(OSError):  # there may be no folder for temporary files
        yield Path(tempfile.gettempdir()) / f"drapery-kernels-{user}", True


def _user_cache_folder() -> Path:
    """The user's folder for files that programs can make again.

    On Linux this is XDG_CACHE_HOME (XDG Base Directory Specification 0.8), if it is absolute.
    """
    home = Path.home()
    if sys.platform == "win32":
        return Path(os.environ.get("LOCALAPPDATA") or home / "AppData" / "Local")
    if sys.platform == "darwin":
        return home / "Library" / "Caches"
    chosen = Path(os.environ.get("XDG_CACHE_HOME", ""))
    return chosen if chosen.is_absolute() else home / ".cache"


def try_folder(folder: Path, private: bool) -> None:
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


def read_kernel(entry_point: Any, types: tuple[str, ...]) -> KernelObject | None:
    """The stored code of an entry point for arguments of these types, if there is one."""
    try:
        path = _path_of(entry_point, types)
        if path is None or not path.is_file():
            return None
        content = path.read_bytes()
        if hashlib.sha256(content[32:]).digest() != content[:32]:
            raise ValueError("its hash is another one")
        return KernelObject.from_bytes(content[32:])
    except (OSError, ValueError) as fault:  # loading damaged code would end the process
        LOG.info("a stored kernel of %s is compiled again: %s", entry_point.__name__, fault)
        return None


def write_kernel(entry_point: Any, types: tuple[str, ...], kernel: KernelObject) -> None:
    """Store the code of an entry point for arguments of these types, if a folder can be written."""
    path = _path_of(entry_point, types)
    if path is None:
        return
    content = kernel.to_bytes()
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.NamedTemporaryFile(dir=path.parent, delete=False) as file:
            file.write(hashlib.sha256(content).digest() + content)
        Path(file.name).replace(path)
    except OSError as fault:
        _warn_once(f"compiled kernels cannot be stored in {path.parent} ({fault.strerror})")


def _path_of(entry_point: Any, types: tuple[str, ...]) -> Path | None:
    """The file for the code of an entry point; None if its code is not stored."""
    if kernel_cache_status().folder is None:
        _warn_once(f"kernels are compiled in every process ({kernel_cache_status().reason})")
    elif key := source_key(entry_point):
        name = f"{entry_point.__module__}.{entry_point.__qualname__}"
        folder = folder_for(re.sub(r"[^\w.]", "_", name), key)
        return folder / f"{hashlib.sha256(json.dumps(types).encode()).hexdigest()[:16]}.kernel"
    return None


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
    """The versions and settings that decide what machine code sources become, and the processor.

    A setting of numba that is not known to change no code counts, whatever it does.
    """
    words = {
        name: value
        for name, value in sorted(os.environ.items())
        if name.startswith("NUMBA_") and not NOT_ABOUT_CODE.match(name)
    }
    with suppress(OSError):  # few have such a file
        words[NUMBA_SETTINGS] = Path(NUMBA_SETTINGS).read_bytes().hex()
    versions = [version(name) for name in ("numba", "llvmlite")]
    return f"{ABI} {versions} {processor()} {os.environ.get(SIMD)} {words}"


def _delete_oldest(folder: Path) -> None:
    """Keep the folders that were written to last. Another process may delete the same ones."""
    with suppress(OSError):  # another process has deleted one of them
        folders = [each for each in folder.iterdir() if each.is_dir()]
        folders.sort(key=lambda each: each.stat().st_mtime)
        for each in folders[:-MAX_SOURCES]:
            shutil.rmtree(each, ignore_errors=True)
