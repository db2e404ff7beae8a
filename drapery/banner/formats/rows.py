"""Many compounds of numbers in a list of NBT, such as the blocks of a structure, kept as bytes."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from drapery.errors import counted

if TYPE_CHECKING:
    from numpy.typing import NDArray


@dataclass(frozen=True, eq=False, repr=False, slots=True)
class Rows:
    """Compounds of one layout that follow each other in a list and hold only numbers.

    fields: by name, where it begins in a row [bytes], its type, and how many numbers it has.
    """

    data: bytes
    start: int
    count: int
    size: int
    fields: dict[str, tuple[int, str, int]]

    def __len__(self) -> int:
        return self.count

    def __repr__(self) -> str:
        return f"{counted(self.count, 'compound')} of numbers"

    def column(self, name: str) -> "NDArray[Any]":
        """The numbers of a field, shape [count, how many]; empty if there is no such field."""
        import numpy as np

        if name not in self.fields:
            return np.empty((0, 0))
        offset, dtype, length = self.fields[name]
        rows = np.frombuffer(self.data, np.uint8, self.count * self.size, self.start)
        part = rows.reshape(self.count, self.size)[:, offset : offset + length * int(dtype[-1])]
        return np.ascontiguousarray(part).view(dtype)
