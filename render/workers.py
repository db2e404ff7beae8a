"""Kernels on several cores: each releases the GIL and takes its own share of the work.

Plain threads, not numba's parallel loops: they compile in half the time, and may be used from
any thread and after a fork.
"""

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

T = TypeVar("T")

_pool: ThreadPoolExecutor | None = None


def worker_count() -> int:
    """How many workers by default: the cores of this process, fewer if NUMBA_NUM_THREADS says."""
    from numba import config

    return int(getattr(config, "NUMBA_NUM_THREADS", 1))


def share_out(task: Callable[[int], T], workers: int) -> list[T]:
    """Run task(0) … task(workers - 1) at once; the results, in that order."""
    if workers == 1:
        return [task(0)]
    others = [_threads().submit(task, worker) for worker in range(1, workers)]
    return [task(0), *(other.result() for other in others)]


def _threads() -> ThreadPoolExecutor:
    global _pool
    if _pool is None:
        _pool = ThreadPoolExecutor(max(1, (os.cpu_count() or 1)), "drapery")
    return _pool


def _forget() -> None:
    """A forked child has none of its parent's threads."""
    global _pool
    _pool = None


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_forget)
