"""The steps that can be undone and redone."""

from dataclasses import dataclass
from typing import Generic, TypeVar

T = TypeVar("T")

LIMIT = 200
"""The most steps that can be undone."""


@dataclass(frozen=True)
class History(Generic[T]):
    """The current state, the earlier states (latest last) and the undone states (next first)."""

    present: T
    past: tuple[T, ...] = ()
    future: tuple[T, ...] = ()

    def push(self, state: T) -> "History[T]":
        """Make `state` the current one; drops undone states. An equal state adds no step."""
        if state == self.present:
            return self
        return History(state, (*self.past, self.present)[-LIMIT:])

    def undo(self) -> "History[T]":
        """The history after one undo; unchanged if there is no step to undo."""
        return self.go_to(len(self.past) - 1)

    def redo(self) -> "History[T]":
        """The history after one redo; unchanged if there is no step to redo."""
        return self.go_to(len(self.past) + 1)

    @property
    def states(self) -> tuple[T, ...]:
        """All states, the earliest first."""
        return (*self.past, self.present, *self.future)

    def go_to(self, place: int) -> "History[T]":
        """The history with the state at a place of `states` as the current one, if it has it."""
        states = self.states
        if place == len(self.past) or not 0 <= place < len(states):
            return self
        return History(states[place], states[:place], states[place + 1 :])
