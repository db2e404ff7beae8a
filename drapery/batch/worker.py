"""A worker process: it takes jobs from its pipe until that ends."""

import os
import signal
import threading
from collections.abc import Callable
from contextlib import suppress
from multiprocessing import parent_process
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any


def live(pipe: Connection, work: Callable[[Any], Any], memory: int, threads: int) -> None:
    """Do jobs until the other end hangs up; None says that one wanted too much memory.

    Nobody is left to be on_result when the other end is killed, so the worker ends without a word.

    memory: what a job may take beyond what the process has [bytes]. threads: for the kernels.
    """
    # Numba reads this when it is first imported, which is below.
    os.environ["NUMBA_NUM_THREADS"] = str(threads)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_die_with_parent, daemon=True).start()
    import drapery.pictures  # noqa: F401 - so that its memory is the worker's, not the first job's

    _limit(memory)
    with suppress(EOFError, ConnectionError):
        pipe.send(_pages(1))
        while True:
            pipe.send(_outcome(work, pipe.recv()))


def _outcome(work: Callable[[Any], Any], job: Any) -> Any:
    try:
        return work(job)
    except MemoryError:
        return None


def _die_with_parent() -> None:
    parent = parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


def _limit(memory: int) -> None:
    """Refuse allocations beyond the limit, where the system can."""
    try:
        import resource
    except ImportError:
        return
    # Threads' stacks and mapped libraries are address space that a job does not fill.
    room = _pages(0) + memory + (1 << 30)
    _, hard = resource.getrlimit(resource.RLIMIT_AS)
    if hard == resource.RLIM_INFINITY or room < hard:
        resource.setrlimit(resource.RLIMIT_AS, (room, hard))


def _pages(column: int) -> int:
    """Address space (0) or resident memory (1) of this process [bytes]; 0 where unknown."""
    try:
        pages = Path("/proc/self/statm").read_text().split()[column]
        return int(pages) * os.sysconf("SC_PAGE_SIZE")
    except (OSError, IndexError, ValueError):
        return 0
