"""Where coverage's tracer is not wanted: in numba's compiler, and where time is measured.

A tracer makes loops of Python several times slower, and a process take a second more.
"""

import os
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from numba.core import event

PROCESSES = "COVERAGE_PROCESS_CONFIG"
"""The variable by which coverage traces the processes that tests start."""


@contextmanager
def untraced() -> Iterator[None]:
    """Do not trace this thread."""
    tracer = sys.gettrace()
    sys.settrace(None)
    try:
        yield
    finally:
        sys.settrace(tracer)


def untraced_environment() -> dict[str, str]:
    """The environment of a process that coverage does not trace."""
    return {name: value for name, value in os.environ.items() if name != PROCESSES}


class UntracedCompiler(event.Listener):  # type: ignore[misc, name-defined]
    """Stop tracing in this thread while the outermost kernel is compiled."""

    def __init__(self) -> None:
        self._thread = threading.local()

    def on_start(self, event: Any) -> None:
        depth = getattr(self._thread, "depth", 0)
        if depth == 0:
            self._thread.tracer = sys.gettrace()
            sys.settrace(None)
        self._thread.depth = depth + 1

    def on_end(self, event: Any) -> None:
        self._thread.depth -= 1
        if self._thread.depth == 0:
            sys.settrace(self._thread.tracer)


def trace_no_compiler() -> None:
    """Do so in this process from now on."""
    event.register("numba:compile", UntracedCompiler())
