"""A cache of the last few prepared values: an animation prepares its constant parts once."""

from collections import deque
from collections.abc import Callable
from typing import Generic, TypeVar

T = TypeVar("T")


class IdentityCache(Generic[T]):
    """The last few values, by the identity of the arrays from which they were made.

    The caches of functools and cachetools need hashable keys, and arrays are not hashable. The
    entries hold references to their arrays, so no new array can have the same identity.
    """

    def __init__(self, maxsize: int = 4) -> None:
        self._entries: deque[tuple[tuple[object, ...], object, T]] = deque(maxlen=maxsize)

    def get(self, arrays: tuple[object, ...], plain: object, make: Callable[[], T]) -> T:
        """The value for the same arrays and an equal plain value; `make()` if it is not cached."""
        for known, rest, value in tuple(self._entries):
            same = len(known) == len(arrays) and all(map(_is, known, arrays))
            if same and rest == plain:
                return value
        value = make()
        self._entries.appendleft((arrays, plain, value))
        return value


def _is(first: object, second: object) -> bool:
    return first is second
