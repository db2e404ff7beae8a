"""Collect the warnings of a single task or thread.

`warnings.catch_warnings` replaces the state of the whole process: in a server with threads it
collects the warnings of other threads too, and then overwrites what another thread has just set.
This module installs one hook for the life of the process; a context variable holds the list to
which the warnings of the current task or thread are added.
"""

import threading
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import TextIO

_lines: ContextVar[list[str] | None] = ContextVar("collected warnings", default=None)
_install_lock = threading.Lock()
_show_elsewhere = warnings.showwarning


@contextmanager
def collected_warnings() -> Iterator[list[str]]:
    """The texts of all UserWarnings of this task or thread within the block."""
    _install()
    lines: list[str] = []
    token = _lines.set(lines)
    try:
        yield lines
    finally:
        _lines.reset(token)


def _install() -> None:
    global _show_elsewhere
    with _install_lock:
        if warnings.showwarning is not _show:
            _show_elsewhere = warnings.showwarning
            warnings.showwarning = _show
            # The default filter would hide the same warning about a second file.
            warnings.simplefilter("always", UserWarning)


def _show(
    message: Warning | str,
    category: type[Warning],
    filename: str,
    lineno: int,
    file: TextIO | None = None,
    line: str | None = None,
) -> None:
    lines = _lines.get()
    if lines is None or not issubclass(category, UserWarning):
        _show_elsewhere(message, category, filename, lineno, file, line)
    else:
        lines.append(str(message))
