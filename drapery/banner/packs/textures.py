"""Textures of packs: still or animated by an `.mcmeta` beside them, and masks of old packs."""

from dataclasses import dataclass
from math import lcm
from typing import Any

import numpy as np

from drapery.banner.packs.meta import read_json
from drapery.banner.packs.png import Texels
from drapery.errors import PackError

TICKS_PER_SECOND = 20

MAX_SHEET = 2048
"""Largest side of a banner's or shield's sheet [px]."""

LAST_MASK_FORMAT = 4
"""Up to this pack format (1.14) a pattern was a mask: its red channel said where the dye shows."""

_MAX_FRAMES = 8192
_CHECKER_SIDE = 16


@dataclass(frozen=True, eq=False)
class Texture:
    """Frames of one size and the ticks (1/20 s) that each stays; a still texture has one frame."""

    frames: tuple[Texels, ...]
    ticks: tuple[int, ...] = (1,)

    def at(self, time: float) -> Texels:
        """The frame that is seen at a time [s]. Frames are not blended into each other."""
        if len(self.frames) == 1:
            return self.frames[0]
        ends = np.cumsum(self.ticks)
        tick = int(np.floor(time * TICKS_PER_SECOND + 1e-6)) % int(ends[-1])
        return self.frames[int(np.searchsorted(ends, tick, side="right"))]

    @property
    def period(self) -> float:
        """How long the animation takes [s]; 0 for a still texture."""
        return sum(self.ticks) / TICKS_PER_SECOND if len(self.frames) > 1 else 0.0


def animated(texels: Texels, mcmeta: bytes | None, name: str) -> Texture:
    """A texture cut into the frames that its `.mcmeta` (None: it has none) tells of.

    Raises PackError, calling the `.mcmeta` by name.
    """
    root = read_json(mcmeta, name) if mcmeta is not None else {}
    animation = root.get("animation") if isinstance(root, dict) else None
    if animation is None:
        return Texture((texels,))
    if not isinstance(animation, dict):
        raise PackError(f"{name}: animation must be an object in braces")
    width, height = _frame_size(animation, texels, name)
    across, down = texels.shape[1] // width, texels.shape[0] // height
    order = _order(animation, across * down, name)
    cells = {
        n: texels[n // across * height :, n % across * width :][:height, :width] for n, _ in order
    }
    return Texture(tuple(cells[n] for n, _ in order), tuple(ticks for _, ticks in order))


def check_sheet(texture: Texture, name: str) -> None:
    """Raise PackError unless the texture is a square sheet of at most MAX_SHEET px."""
    height, width = texture.frames[0].shape[:2]
    if height != width:
        raise PackError(
            f"{name} is {width} x {height} px; a sheet is square:"
            " make it so, or add an .mcmeta with its animation"
        )
    if height > MAX_SHEET:
        raise PackError(
            f"{name} is {width} x {height} px; a sheet has at most {MAX_SHEET} a side: shrink it"
        )


def is_mask(texels: Texels, pack_format: int | None) -> bool:
    """Whether a sheet is a mask of the kind used before 1.15.

    In a pack of that time every sheet is, but for those with half-transparent texels, which
    meant nothing then. Where no format is known, only a black and white one without any
    transparent texels.
    """
    alpha = texels[..., 3]
    if pack_format is None:
        return bool((alpha == 255).all()) and looks_like_mask(texels)
    return pack_format <= LAST_MASK_FORMAT and bool(((alpha == 0) | (alpha == 255)).all())


def looks_like_mask(texels: Texels) -> bool:
    """Whether a sheet of newer days seems a mask left over: opaque black beside opaque grey."""
    shown = texels[texels[..., 3] > 0]
    is_grey = bool((shown[:, :3] == shown[:, :1]).all() and (shown[:, 3] == 255).all())
    return is_grey and len({0, 255} & set(shown[:, 0].tolist())) == 2


def from_mask(mask: Texels, base: Texels) -> Texels:
    """The sheet that looks today as a mask did over a base: the base's colours, alpha from red."""
    side = lcm(len(mask), len(base))
    mask, base = (np.kron(t, np.ones((side // len(t),) * 2 + (1,), np.uint8)) for t in (mask, base))
    alpha = np.where(mask[..., 3:] > 0, mask[..., :1], 0).astype(np.uint8)
    return np.concatenate([base[..., :3], alpha], axis=2)


def checker() -> Texels:
    """The game's sign for a missing texture, 16 x 16: black and magenta quarters."""
    texels = np.zeros((_CHECKER_SIDE, _CHECKER_SIDE, 4), np.uint8)
    low = np.arange(_CHECKER_SIDE) < _CHECKER_SIDE // 2
    texels[low[:, None] ^ low] = (0xF8, 0, 0xF8, 0)
    texels[..., 3] = 255
    return texels


def _frame_size(animation: dict[str, Any], texels: Texels, name: str) -> tuple[int, int]:
    height, width = texels.shape[:2]
    least = min(width, height)
    given = "width" in animation or "height" in animation
    size = (
        _whole(animation, "width", width if given else least, name),
        _whole(animation, "height", height if given else least, name),
    )
    if width % size[0] or height % size[1]:
        raise PackError(
            f"{name}: frames of {size[0]} x {size[1]} do not fit into {width} x {height} px evenly:"
            " mend the size"
        )
    return size


def _order(animation: dict[str, Any], count: int, name: str) -> list[tuple[int, int]]:
    """Index and ticks of each frame in the order shown."""
    usual = _whole(animation, "frametime", 1, name)
    frames = animation.get("frames") or list(range(count))
    if not isinstance(frames, list) or len(frames) > _MAX_FRAMES:
        raise PackError(f"{name}: frames must be a list of up to {_MAX_FRAMES}")
    order = []
    for entry in frames:
        entry = entry if isinstance(entry, dict) else {"index": entry}
        index = entry.get("index")
        if not isinstance(index, int) or isinstance(index, bool) or not 0 <= index < count:
            raise PackError(f"{name}: frame {index!r} is none of 0 to {count - 1}")
        order.append((index, _whole(entry, "time", usual, name)))
    return order


def _whole(entry: dict[str, Any], key: str, default: int, name: str) -> int:
    value = entry.get(key, default)
    if not isinstance(value, int) or isinstance(value, bool) or not 0 < value < 1 << 20:
        raise PackError(f"{name}: {key} must be a whole number from 1, not {value!r}")
    return value
