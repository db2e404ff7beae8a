"""Kernels on several cores: each releases the GIL and draws its own part of the work.

Plain threads, not numba's parallel loops: they compile in half the time, and may be used from
any thread and after a fork. The work is cut into more parts than there are threads, and a thread
takes the next part when it is done with one; so a thread that the system lets wait holds up
nobody, and on a busy machine the caller does all by itself.
"""

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

T = TypeVar("T")

_pool: ThreadPoolExecutor | None = None


def worker_count() -> int:
    """How many threads by default: the cores of this process, fewer if NUMBA_NUM_THREADS says."""
    from numba import config

    return int(getattr(config, "NUMBA_NUM_THREADS", 1))


def run_parts(task: Callable[[int], T], parts: int, workers: int) -> list[T]:
    """Run task(0) … task(parts - 1) on up to `workers` threads; their results, in that order."""
    results: dict[int, T] = {}
    left = iter(range(parts))

    def work() -> None:
        for part in left:
            results[part] = task(part)

    helpers = [_threads().submit(work) for _ in range(min(workers, parts) - 1)]
    try:
        work()
    finally:
        for helper in helpers:
            if not helper.cancel():
                helper.result()
    return [results[part] for part in range(parts)]


def _threads() -> ThreadPoolExecutor:
    global _pool
    if _pool is None:
        _pool = ThreadPoolExecutor(max(1, (os.cpu_count() or 1)), "drapery")
    return _pool


def _reset_after_fork() -> None:
    """A forked child has none of its parent's threads."""
    global _pool
    _pool = None


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_reset_after_fork)
