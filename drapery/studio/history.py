"""The steps that can be undone and repeated."""

from dataclasses import dataclass
from typing import Generic, TypeVar

T = TypeVar("T")

LIMIT = 200
"""The most steps that can be undone."""


@dataclass(frozen=True)
class History(Generic[T]):
    """The states before the present, latest last, and those undone, next first."""

    present: T
    past: tuple[T, ...] = ()
    future: tuple[T, ...] = ()

    def push(self, state: T) -> "History[T]":
        """A new present; what was undone is forgotten. An equal state is no step."""
        if state == self.present:
            return self
        return History(state, (*self.past, self.present)[-LIMIT:])

    def undo(self) -> "History[T]":
        """One step back, or the same where there is none."""
        if not self.past:
            return self
        return History(self.past[-1], self.past[:-1], (self.present, *self.future))

    def redo(self) -> "History[T]":
        """One undone step forth, or the same where there is none."""
        if not self.future:
            return self
        return History(self.future[0], (*self.past, self.present), self.future[1:])
