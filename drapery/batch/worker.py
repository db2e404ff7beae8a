"""A worker process: it takes jobs from its pipe until that closes."""

import os
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from enum import Enum
from multiprocessing import parent_process
from pathlib import Path
from typing import Any

ADDRESS_SPACE, RESIDENT = 0, 1
"""Columns of /proc/PID/statm."""


class Compiling(Enum):
    """What a worker reports while it does a job: that it begins and ends to compile kernels."""

    BEGINS = "begins"
    ENDS = "ends"


def run(pipe: Any, work: Callable[[Any], Any], memory: int, threads: int) -> None:
    """Do jobs until the other end closes; None is sent where one needs too much memory.

    While kernels are compiled for a job, that is sent too; see `Compiling`.

    When the parent is killed there is nobody to report to, so the worker ends without a message.

    memory: what a job may take beyond what the process has [bytes]. threads: for the kernels.
    """
    # Numba reads this when it is first imported, which is below.
    os.environ["NUMBA_NUM_THREADS"] = str(threads)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_die_with_parent, daemon=True).start()
    import drapery

    # Import what draws now, so that its memory is the worker's, not the first job's.
    _ = drapery.draw

    lock = threading.Lock()

    def send(message: Any) -> None:
        with lock:  # kernels are also compiled in other threads
            pipe.send(message)

    with suppress(EOFError, ConnectionError), _reported_compiling(send):
        limit_memory(memory)
        send(memory_of("self", RESIDENT))
        while True:
            send(_result(work, pipe.recv()))


@contextmanager
def _reported_compiling(send: Callable[[Any], None]) -> Iterator[None]:
    """Report when kernels are compiled. A kernel that another one calls is compiled within it."""
    from numba.core import event

    class Reporter(event.Listener):  # type: ignore[misc]
        depth = 0

        def on_start(self, event: Any) -> None:
            self.depth += 1
            if self.depth == 1:
                send(Compiling.BEGINS)

        def on_end(self, event: Any) -> None:
            self.depth -= 1
            if self.depth == 0:
                send(Compiling.ENDS)

    with event.install_listener("numba:compile", Reporter()):
        yield


def _result(work: Callable[[Any], Any], job: Any) -> Any:
    try:
        return work(job)
    except MemoryError:
        return None


def _die_with_parent() -> None:
    parent = parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


def limit_memory(memory: int) -> None:
    """Refuse allocations beyond the limit, where the system can."""
    if sys.platform != "win32":
        import resource

        # Threads' stacks and mapped libraries are address space that a job does not fill.
        limit = memory_of("self", ADDRESS_SPACE) + memory + (1 << 30)
        _, hard = resource.getrlimit(resource.RLIMIT_AS)
        if hard == resource.RLIM_INFINITY or limit < hard:
            with suppress(OSError, ValueError):  # macOS has the call and refuses some limits
                resource.setrlimit(resource.RLIMIT_AS, (limit, hard))


def memory_of(pid: int | str | None, column: int) -> int:
    """ADDRESS_SPACE or RESIDENT memory of a process [bytes]; 0 where the system does not say."""
    with suppress(OSError, IndexError, ValueError):  # the process may have ended
        if sys.platform != "win32":
            pages = Path(f"/proc/{pid}/statm").read_text(encoding="ascii").split()[column]
            return int(pages) * os.sysconf("SC_PAGE_SIZE")
    return 0
