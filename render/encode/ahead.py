"""Encoding parallel to rendering: a few worker threads, results in order, a bounded queue."""

from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from typing import TypeVar

Item = TypeVar("Item")
Result = TypeVar("Result")

WORKERS = 2


def encode_ahead(
    items: Iterable[Item], encode: Callable[[Item], Result], workers: int = WORKERS
) -> Iterator[Result]:
    """The results of `encode` on each item, in order, computed while the next items are drawn.

    The items are drawn in the caller's thread, where an OpenGL context lives; at most
    2 * workers + 1 of them wait. Pillow and zlib leave the interpreter lock while they work.
    """
    waiting: deque[Future[Result]] = deque()
    with ThreadPoolExecutor(workers, thread_name_prefix="encode") as pool:
        try:
            for item in items:
                waiting.append(pool.submit(encode, item))
                if len(waiting) > 2 * workers:
                    yield waiting.popleft().result()
            while waiting:
                yield waiting.popleft().result()
        finally:
            for future in waiting:
                future.cancel()
