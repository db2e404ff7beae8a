"""Kernels on several cores: each releases the GIL and does one part of the work.

These are plain threads, not numba's parallel loops: they compile in half the time, and work in any
thread and after a fork. The work is divided into more parts than there are threads, and a thread
takes the next part when it has finished one. So a thread that the system delays does not block the
others; on a busy machine the caller may do all parts.
"""

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

T = TypeVar("T")

_pool: ThreadPoolExecutor | None = None


def worker_count() -> int:
    """The default number of threads: NUMBA_NUM_THREADS, or the cores of this process."""
    wanted = os.environ.get("NUMBA_NUM_THREADS", "")
    if wanted.isdecimal():
        return max(1, int(wanted))
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def run_parts(task: Callable[[int], T], parts: int, workers: int) -> list[T]:
    """Run task(0) … task(parts - 1) on up to `workers` threads; returns the results in order."""
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
    """Discard the threads in a forked child, which does not have its parent's threads."""
    global _pool
    _pool = None


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_reset_after_fork)
