"""The compiler of kernels without coverage's tracer, which slows it down by two fifths."""

import sys
import threading
from typing import Any

from numba.core import event


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
