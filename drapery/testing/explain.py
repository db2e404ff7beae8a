"""Describes in one line what changed between a golden and a picture."""

import base64
from collections.abc import Iterator
from typing import Any

import numpy as np

from drapery import Banner
from drapery.banner import FLAG_REGIONS, flag_layers
from drapery.comparison import (
    EXACT,
    Tolerance,
    align,
    as_picture,
    decode_picture,
    difference_words,
    eight_bits,
    measure,
    measure_pictures,
)
from drapery.packs import Packs
from drapery.render import Pixels, png_bytes

MAX_SHIFT = 4
"""How far a layer's picture may have moved to be recognised [texels]."""

LayerNote = dict[str, str]
"""A layer as a golden stores it: its name and its front face as a PNG."""


def layer_notes(banner: Banner, packs: Packs) -> list[LayerNote]:
    """The front face of every layer of a design, untinted, as a golden stores it."""
    names = ["the cloth", f"base, {banner.base}"]
    names += [f"{layer.pattern}, {layer.dye}" for layer in banner.layers]
    sheets = [texels for texels, _ in flag_layers(banner, packs)]
    return [
        {"name": name, "face": _pack(FLAG_REGIONS["front"].crop(sheet))}
        for name, sheet in zip(names, sheets, strict=True)
    ]


def explain_change(
    expected: Any,
    actual: Any,
    before: list[LayerNote] | None = None,
    after: list[LayerNote] | None = None,
    tolerance: Tolerance = EXACT,
) -> str:
    """One line: how much changed and, if layer notes are given, which layer and how.

    expected, actual: what `as_picture` takes.
    """
    old, new = as_picture(expected), as_picture(actual)
    sizes = old.described(), new.described()
    if sizes[0] != sizes[1]:
        return f"the size changed from {sizes[0]} to {sizes[1]}"
    changes = list(_layer_changes(before, after)) if before and after else []
    words = difference_words(measure_pictures(old, new, tolerance), tolerance)
    return "; ".join([*changes[:3], words])


def _layer_changes(before: list[LayerNote], after: list[LayerNote]) -> Iterator[str]:
    names = [[note["name"] for note in notes] for notes in (before, after)]
    for i, j in align(*names):
        if i is None:
            assert j is not None
            yield f"{_place(j)} ({names[1][j]}) is new"
        elif j is None:
            yield f"{_place(i)} ({names[0][i]}) is gone"
        elif names[0][i] != names[1][j]:
            yield f"{_place(i)} ({names[0][i]}) became ({names[1][j]})"
        elif before[i]["face"] != after[j]["face"]:
            change = _face_change(_unpack(before[i]["face"]), _unpack(after[j]["face"]))
            yield f"{_place(j)} ({names[1][j]}) {change}"


def _place(number: int) -> str:
    # Cloth and base do not count as layers.
    return f"layer {number - 1}" if number > 1 else "below the layers:"


def _face_change(old: Pixels, new: Pixels) -> str:
    if old.shape != new.shape:
        return f"changed from {old.shape[1]}x{old.shape[0]} to {new.shape[1]}x{new.shape[0]} texels"
    for distance in range(1, MAX_SHIFT + 1):
        if any(_moved(old, new, down, right) for down, right in _ring(distance)):
            return f"moved by {distance} texel{'s' if distance > 1 else ''}"
    changed = measure(old, new).changed
    return f"has {changed} changed texel{'s' if changed > 1 else ''}"


def _ring(distance: int) -> Iterator[tuple[int, int]]:
    span = range(-distance, distance + 1)
    return ((d, r) for d in span for r in span if max(abs(d), abs(r)) == distance)


def _moved(old: Pixels, new: Pixels, down: int, right: int) -> bool:
    """Whether `new` is `old` shifted, judged by shape where both overlap."""
    shape = old[..., 3] > 0
    height, width = shape.shape
    moved = np.roll(shape, (down, right), axis=(0, 1))
    inside = np.zeros_like(shape)
    inside[max(0, down) : height + min(0, down), max(0, right) : width + min(0, right)] = True
    overlap_same = bool(np.array_equal(moved[inside], (new[..., 3] > 0)[inside]))
    return overlap_same and not np.array_equal(shape, new[..., 3] > 0)


def _pack(face: Pixels) -> str:
    return base64.b64encode(png_bytes(face)).decode("ascii")


def _unpack(face: str) -> Pixels:
    (pixels,) = decode_picture(base64.b64decode(face), "the golden's layer", ("PNG",)).frames
    return eight_bits(pixels)
