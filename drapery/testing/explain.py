"""Describes in one line what changed between a golden and a picture."""

import base64
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from drapery import Banner
from drapery.arrays import Pixels
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
from drapery.errors import DraperyError, counted
from drapery.packs import Packs
from drapery.render import png_bytes

MAX_SHIFT = 4
"""How far a layer's picture may have moved to be recognised [texels]."""
_MOST_NAMED = 3
"""The most changed layers that are named."""

LayerNote = dict[str, str]
"""A layer as a golden stores it: its name and its front face as a PNG."""


def layer_notes(banner: Banner, packs: Packs) -> list[LayerNote]:
    """The front face of every layer of a design, untinted, as a golden stores it.

    banner: the design.
    packs: resource packs, see `drapery.packs.open_packs`.
    """
    names = ["the cloth", f"base, {banner.base}"]
    names += [f"{layer.pattern}, {layer.dye}" for layer in banner.layers]
    sheets = [texels for texels, _ in flag_layers(banner, packs)]
    return [
        {"name": name, "face": packed_face(FLAG_REGIONS["front"].crop(sheet))}
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

    Layers that others hide are named last, as hidden.

    expected: what `as_picture` takes.
    actual: what `as_picture` takes.
    before: the layers of the expected design, see `layer_notes`.
    after: the layers of the actual design.
    tolerance: what does not count.
    """
    old, new = as_picture(expected), as_picture(actual)
    sizes = old.described(), new.described()
    if sizes[0] != sizes[1]:
        return f"the size changed from {sizes[0]} to {sizes[1]}"
    changes = _named_changes(before, after) if before and after else []
    words = difference_words(measure_pictures(old, new, tolerance), tolerance)
    return "; ".join([*changes, words])


def _named_changes(before: list[LayerNote], after: list[LayerNote]) -> list[str]:
    """The first changes of layers in words, those that can be seen first, and how many more."""
    stacks = [_Stack(before), _Stack(after)]
    names = [[note["name"] for note in notes] for notes in (before, after)]
    seen, hidden = [], []
    for places in align(*names):
        change = _layer_change(stacks, places)
        if change and all(
            place is None or stack.hides(place) for stack, place in zip(stacks, places, strict=True)
        ):
            hidden.append(f"{change}, hidden on the front by layers above")
        elif change:
            seen.append(change)
    more = len(seen) + len(hidden) - _MOST_NAMED
    rest = [counted(more, "more layer") + " changed"] if more > 0 else []
    return [*seen, *hidden][:_MOST_NAMED] + rest


@dataclass(frozen=True)
class _Stack:
    """The layers of a design, from the cloth up."""

    notes: list[LayerNote]

    @cached_property
    def faces(self) -> list[Pixels | None]:
        """The face of each layer; None where another program has changed the note."""
        return [unpacked_face(note["face"]) for note in self.notes]

    def hides(self, place: int) -> bool:
        """Whether the layers above one of them hide all of its front face."""
        face, *above = self.faces[place:]
        if face is None:
            return False
        open_texels = face[..., 3] > 0
        for other in above:
            if other is not None and other.shape == face.shape:
                open_texels &= other[..., 3] < 255
        return not open_texels.any()


def _layer_change(stacks: list[_Stack], places: tuple[int | None, int | None]) -> str:
    """How a layer of both designs differs, in words; empty if it does not."""
    (old, new), (i, j) = stacks, places
    if i is None or j is None:
        stack, place, verb = (old, i, "gone") if j is None else (new, j, "new")
        assert place is not None
        return f"{_place(place)} ({stack.notes[place]['name']}) is {verb}"
    names = old.notes[i]["name"], new.notes[j]["name"]
    if names[0] != names[1]:
        return f"{_place(i)} ({names[0]}) became ({names[1]})"
    if old.notes[i]["face"] == new.notes[j]["face"]:
        return ""
    return f"{_place(j)} ({names[1]}) {_face_change(old.faces[i], new.faces[j])}"


def _place(number: int) -> str:
    # Cloth and base do not count as layers.
    return f"layer {number - 1}" if number > 1 else "below the layers:"


def _face_change(old: Pixels | None, new: Pixels | None) -> str:
    if old is None or new is None:
        return "cannot be compared: its picture in the golden is damaged"
    if old.shape != new.shape:
        return f"changed from {old.shape[1]}x{old.shape[0]} to {new.shape[1]}x{new.shape[0]} texels"
    for distance in range(1, MAX_SHIFT + 1):
        if any(_moved(old, new, down, right) for down, right in _ring(distance)):
            return f"moved by {counted(distance, 'texel')}"
    changed = measure(old, new).changed
    return f"has {counted(changed, 'changed texel')}"


def _ring(distance: int) -> Iterator[tuple[int, int]]:
    span = range(-distance, distance + 1)
    return ((d, r) for d in span for r in span if max(abs(d), abs(r)) == distance)


def _moved(old: Pixels, new: Pixels, down: int, right: int) -> bool:
    """Whether `new` is `old` shifted, compared by shape where both overlap."""
    shape = old[..., 3] > 0
    height, width = shape.shape
    moved = np.roll(shape, (down, right), axis=(0, 1))
    inside = np.zeros_like(shape)
    inside[max(0, down) : height + min(0, down), max(0, right) : width + min(0, right)] = True
    overlap_same = bool(np.array_equal(moved[inside], (new[..., 3] > 0)[inside]))
    return overlap_same and not np.array_equal(shape, new[..., 3] > 0)


def packed_face(face: Pixels) -> str:
    """A PNG file of the pixels, as a text in base 64."""
    return base64.b64encode(png_bytes(face)).decode("ascii")


def unpacked_face(face: str) -> Pixels | None:
    """The pixels of a packed face; None if it is damaged."""
    try:
        picture = decode_picture(base64.b64decode(face), "the golden's layer", ("PNG",))
    except (ValueError, DraperyError):
        return None  # the failure line says that the layer's picture is damaged
    return eight_bits(picture.frames[0])
