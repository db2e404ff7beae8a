"""The threads that move the live cloths of all tabs.

There are two: Python's share of their work runs one thread at a time, so more of them would wait
for each other (20 viewers got 23 frames/s from four threads and 29 from two).

They are daemons. A process that is told to end would wait for the threads of a
`ThreadPoolExecutor`, which may be compiling kernels for half a minute.
"""

import asyncio
import threading
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from queue import SimpleQueue
from typing import Any, TypeVar

THREADS = 2

T = TypeVar("T")


async def in_thread(call: Callable[[], T]) -> T:
    """Call a function in a thread of the live cloths; returns its result or raises its error."""
    loop = asyncio.get_running_loop()
    done: asyncio.Future[T] = loop.create_future()

    def settle(settled: Callable[[Any], None], value: object) -> None:
        if not done.done():  # its caller may have been cancelled
            settled(value)

    def run() -> None:
        if done.done():  # its caller was cancelled before a thread was free
            return
        try:
            answer: tuple[Callable[[Any], None], object] = done.set_result, call()
        except Exception as error:
            answer = done.set_exception, error
        with suppress(RuntimeError):  # the loop is closed
            loop.call_soon_threadsafe(settle, *answer)

    _jobs().put(run)
    return await done


@cache
def _jobs() -> SimpleQueue[Callable[[], None]]:
    """What the threads, which begin at the first call, take in turn."""
    jobs: SimpleQueue[Callable[[], None]] = SimpleQueue()
    for number in range(THREADS):
        name = f"live_{number}"
        threading.Thread(target=_work, args=(jobs,), name=name, daemon=True).start()
    return jobs


def _work(jobs: SimpleQueue[Callable[[], None]]) -> None:
    while True:
        jobs.get()()
