"""The source files that a kernel is compiled from, and a hash of them."""

import hashlib
import inspect
import os
import sys
from collections.abc import Callable
from functools import cache
from itertools import chain
from pathlib import Path

SIMD = "DRAPERY_SIMD"
"""The variable of the environment that makes kernels use no registers of lanes if it is 0."""
SHARED = ("elementary.py", "jit.py", "jit_calls.py")
"""The files beside this one with code that kernels of any package are compiled from."""


def source_files(function: Callable[..., object]) -> list[Path]:
    """The sources that a kernel may be compiled from: those of its top-level package, and `SHARED`.

    `tests/test_kernel_sources.py` follows all that kernels refer to, and finds it in these files.
    Of a function outside of Drapery only its own file is known.
    """
    package = package_of(function)
    if not package.startswith("drapery."):
        return [Path(inspect.getfile(function))]
    return _sources_of(package)


def package_of(function: Callable[..., object]) -> str:
    """The top-level package of a function, such as `drapery.cloth`."""
    return ".".join(function.__module__.split(".")[:2])


@cache
def _sources_of(package: str) -> list[Path]:
    folders = getattr(sys.modules[package], "__path__", [])
    walks = chain.from_iterable(map(os.walk, folders))  # faster than `Path.rglob`
    found = sorted(
        Path(folder, name) for folder, _, names in walks for name in names if name.endswith(".py")
    )
    return [*found, *shared_files()] if found else []


def shared_files() -> list[Path]:
    """The files of `SHARED`."""
    return [Path(__file__).with_name(name) for name in SHARED]


def source_hash(function: Callable[..., object]) -> str:
    """A hash of the contents of `source_files`."""
    return _hash_of(tuple(source_files(function)))


@cache
def _hash_of(files: tuple[Path, ...]) -> str:
    total = hashlib.sha256()
    for path in files:
        total.update(hashlib.sha256(path.read_bytes()).digest())
    return total.hexdigest()
