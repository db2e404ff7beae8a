"""A cache of the last few preparations, so that an animation prepares its constant parts once."""

from collections import deque
from collections.abc import Callable
from typing import Generic, TypeVar

T = TypeVar("T")


class IdentityCache(Generic[T]):
    """The last few values made, found by the identity of the arrays they were made from.

    The caches of functools and cachetools need keys that hash, and arrays do not. The entries
    hold their arrays, so that no new array can have the identity of one of them.
    """

    def __init__(self, maxsize: int = 4) -> None:
        self._entries: deque[tuple[tuple[object, ...], object, T]] = deque(maxlen=maxsize)

    def get(self, arrays: tuple[object, ...], plain: object, make: Callable[[], T]) -> T:
        """The value made from the same arrays and equal plain values; `make()` where none is."""
        for known, rest, value in tuple(self._entries):
            same = len(known) == len(arrays) and all(map(_is, known, arrays))
            if same and rest == plain:
                return value
        value = make()
        self._entries.appendleft((arrays, plain, value))
        return value


def _is(first: object, second: object) -> bool:
    return first is second
