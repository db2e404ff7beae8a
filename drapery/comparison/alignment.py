"""Which layers of two designs belong together."""

from collections.abc import Hashable, Sequence

Aligned = tuple[int | None, int | None]
"""The places of an item in both lists; None where one has no such item."""


def align(a: Sequence[Hashable], b: Sequence[Hashable]) -> list[Aligned]:
    """Pair the items of a longest common subsequence, in order; others become pairs in turn.

    Items between the same pairs that are in no common subsequence replace one another, the first
    the first; those left over have no partner.

    a: the first sequence.
    b: the sequence that is aligned with it.
    """
    lengths = [[0] * (len(b) + 1) for _ in range(len(a) + 1)]
    for i in reversed(range(len(a))):
        for j in reversed(range(len(b))):
            longer = max(lengths[i + 1][j], lengths[i][j + 1])
            lengths[i][j] = lengths[i + 1][j + 1] + 1 if a[i] == b[j] else longer
    found: list[Aligned] = []
    i = j = 0
    only_a: list[int] = []
    only_b: list[int] = []
    while i < len(a) or j < len(b):
        if i < len(a) and j < len(b) and a[i] == b[j]:
            found += _replaced(only_a, only_b)
            found.append((i, j))
            only_a, only_b, i, j = [], [], i + 1, j + 1
        elif j == len(b) or (i < len(a) and lengths[i + 1][j] >= lengths[i][j + 1]):
            only_a.append(i)
            i += 1
        else:
            only_b.append(j)
            j += 1
    return found + _replaced(only_a, only_b)


def _replaced(only_a: list[int], only_b: list[int]) -> list[Aligned]:
    count = max(len(only_a), len(only_b))
    first: list[int | None] = [*only_a, *[None] * (count - len(only_a))]
    second: list[int | None] = [*only_b, *[None] * (count - len(only_b))]
    return list(zip(first, second, strict=True))
