"""The differences between two frames; an animation stores only those."""

from collections.abc import Iterable, Iterator
from typing import Any, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

Picture = TypeVar("Picture", bound=NDArray[Any])


class FramePatch(NamedTuple):
    """A rectangle of a frame: its left and top pixel, and its values [h, w, ...]."""

    left: int
    top: int
    pixels: NDArray[Any]


def bounding_box(mask: NDArray[np.bool_]) -> tuple[int, int, int, int]:
    """Left, top, right and bottom (exclusive) of the set pixels; one pixel if none is set."""
    rows, columns = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
    if not rows.size:
        return 0, 0, 1, 1
    return int(columns[0]), int(rows[0]), int(columns[-1]) + 1, int(rows[-1]) + 1


def cut(pixels: NDArray[Any], box: tuple[int, int, int, int]) -> FramePatch:
    left, top, right, bottom = box
    return FramePatch(left, top, np.ascontiguousarray(pixels[top:bottom, left:right]))


def changed_patch(before: NDArray[Any] | None, after: NDArray[Any], grid: int = 1) -> FramePatch:
    """The part of `after` that differs from `before`, its corner on a multiple of `grid` pixels.

    before, after: shape [H, W] or [H, W, channels]; without `before` it is the whole frame.
    """
    if before is None:
        return FramePatch(0, 0, after)
    differs = before != after
    left, top, right, bottom = bounding_box(differs.any(axis=2) if differs.ndim > 2 else differs)
    return cut(after, (left - left % grid, top - top % grid, right, bottom))


def with_previous(pictures: Iterable[Picture]) -> Iterator[tuple[Picture | None, Picture]]:
    """Each picture's pixels together with those of the picture before it; None before the first."""
    before = None
    for pixels in pictures:
        yield before, pixels
        before = pixels
