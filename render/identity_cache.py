"""A memory of the last few preparations, so that an animation prepares its constant parts once."""

from collections import deque
from collections.abc import Callable
from typing import Generic, TypeVar

T = TypeVar("T")


class Recent(Generic[T]):
    """The last few values made, each known by the identity of the arrays it was made from.

    It holds those arrays, so no other array can take their identity; with a fixed number of
    places the memory does not grow.
    """

    def __init__(self, places: int = 4) -> None:
        self._known: deque[tuple[tuple[object, ...], object, T]] = deque(maxlen=places)

    def get(self, arrays: tuple[object, ...], plain: object, make: Callable[[], T]) -> T:
        """What was made from the same arrays and equal plain values; made now if it is new."""
        for known, rest, value in tuple(self._known):
            same = len(known) == len(arrays) and all(
                a is b for a, b in zip(known, arrays, strict=True)
            )
            if same and rest == plain:
                return value
        value = make()
        self._known.appendleft((arrays, plain, value))
        return value
