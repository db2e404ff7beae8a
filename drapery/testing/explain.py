"""Describes in one line what changed between a golden and a picture."""

import base64
from collections.abc import Iterator

import numpy as np

from drapery import Banner
from drapery.banner import FLAG_REGIONS, flag_layers
from drapery.comparison import measure
from drapery.packs import Packs
from drapery.picture_file import opened_picture
from drapery.render import Pixels, png_bytes
from drapery.testing.golden import Picture, same_size, size_of, stacked

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
    expected: Picture,
    actual: Picture,
    before: list[LayerNote] | None = None,
    after: list[LayerNote] | None = None,
) -> str:
    """One line: how much changed and, if layer notes are given, which layer and how."""
    if not same_size(expected, actual):
        return f"the size changed from {size_of(expected)} to {size_of(actual)}"
    frames = [
        measure(old, new) for old, new in zip(stacked(expected), stacked(actual), strict=True)
    ]
    changed = sum(each.changed for each in frames)
    figures = f"{changed} pixels differ, max {max(each.max_error for each in frames)}"
    if len(frames) > 1:
        figures += f", in {sum(not each.same for each in frames)} of {len(frames)} frames"
    changes = list(_layer_changes(before, after)) if before and after else []
    return "; ".join([*changes[:3], figures])


def _layer_changes(before: list[LayerNote], after: list[LayerNote]) -> Iterator[str]:
    if len(before) != len(after):
        # Cloth and base do not count as layers.
        yield f"{len(before) - 2} layers became {len(after) - 2}"
    for number, (old, new) in enumerate(zip(before, after, strict=False)):
        place = f"layer {number - 1}" if number > 1 else "below the layers:"
        if old["name"] != new["name"]:
            yield f"{place} ({old['name']}) became ({new['name']})"
        elif old["face"] != new["face"]:
            change = _face_change(_unpack(old["face"]), _unpack(new["face"]))
            yield f"{place} ({old['name']}) {change}"


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
    with opened_picture(base64.b64decode(face), "the face", ("PNG",)) as image:
        return np.asarray(image.convert("RGBA"))
