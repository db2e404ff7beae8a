"""Textures of packs: still or animated by their `.mcmeta`, stretched and masked as in the game."""

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from drapery.arrays import Texels
from drapery.banner.names import shown
from drapery.banner.packs.masks import from_mask
from drapery.banner.packs.meta import read_json
from drapery.banner.packs.resampling import common_side, squared
from drapery.errors import PackError

TICKS_PER_SECOND = 20

MAX_SHEET = 2048
"""Largest side of a banner's or shield's sheet [px]."""

_MAX_FRAMES = 8192
_CHECKER_SIDE = 16


@dataclass(frozen=True, eq=False)
class Texture:
    """Frames of one size and the ticks (1/20 s) that each is shown; a still one has one frame.

    is_sheet: whether a frame that is not square is stretched to a square, as in the game's atlas.
    base: the sheet that each frame masks, or None where the frames are the texels themselves.
    """

    frames: tuple[Texels, ...]
    ticks: tuple[int, ...] = (1,)
    is_sheet: bool = False
    base: Texels | None = None
    # The frame that was stretched or masked last, by its index: all of them could fill the memory.
    _made: dict[int, Texels] = field(default_factory=dict, init=False, repr=False)

    def at(self, time: float) -> Texels:
        """The frame shown at a time [s], shape [H, W, 4]. Frames are not blended."""
        index = self._index(time)
        if self._is_plain:
            return self.frames[index]
        made = self._made.get(index)
        if made is None:
            sheet = squared(self.frames[index])
            made = sheet if self.base is None else from_mask(sheet, self.base)
            self._made.clear()
            self._made[index] = made
        return made

    @property
    def _is_plain(self) -> bool:
        """Whether the frames are shown as they are in the file."""
        height, width = self.frames[0].shape[:2]
        return self.base is None and (height == width or not self.is_sheet)

    @property
    def side(self) -> int:
        """The height of a frame as `at` gives it [px]."""
        height, width = self.frames[0].shape[:2]
        own = common_side((height, width)) if self.is_sheet else height
        return own if self.base is None else common_side((own, len(self.base)))

    def texel_count(self) -> int:
        """How many texels are in memory for this texture."""
        frames = sum({id(frame): frame.size // 4 for frame in self.frames}.values())
        return frames if self._is_plain else frames + self.side**2

    def _index(self, time: float) -> int:
        if len(self.frames) == 1:
            return 0
        ends = np.cumsum(self.ticks)
        tick = int(np.floor(time * TICKS_PER_SECOND + 1e-6)) % int(ends[-1])
        return int(np.searchsorted(ends, tick, side="right"))

    @property
    def period(self) -> float:
        """The length of the animation [s]; 0 for a still texture."""
        return sum(self.ticks) / TICKS_PER_SECOND if len(self.frames) > 1 else 0.0


@dataclass(frozen=True)
class FrameLayout:
    """How a picture is cut into frames.

    width, height: of one frame [px]. order: index and ticks of each frame in the order shown;
    frames are numbered row by row.
    """

    width: int
    height: int
    order: tuple[tuple[int, int], ...] = ((0, 1),)


def frame_layout(width: int, height: int, mcmeta: bytes | None, name: str) -> FrameLayout:
    """The frames of a picture of this size [px], by its `.mcmeta` (None: it has none).

    name: the name of the `.mcmeta` in errors. Raises PackError.
    """
    root = read_json(mcmeta, name) if mcmeta is not None else {}
    animation = root.get("animation") if isinstance(root, dict) else None
    if animation is None:
        return FrameLayout(width, height)
    if not isinstance(animation, dict):
        raise PackError(f"{name}: animation must be an object in braces")
    size = _frame_size(animation, width, height, name)
    count = (width // size[0]) * (height // size[1])
    return FrameLayout(*size, _order(animation, count, name))


def still_layout(width: int, height: int) -> FrameLayout:
    """One frame of a picture of this size [px] whose animation cannot be used.

    It is the first square of a strip, else the whole picture.
    """
    side = min(width, height)
    is_strip = max(width, height) % side == 0
    return FrameLayout(side, side) if is_strip else FrameLayout(width, height)


def cut_frames(texels: Texels, layout: FrameLayout) -> Texture:
    """The texture of a picture that is cut into frames."""
    width, height = layout.width, layout.height
    if texels.shape[:2] == (height, width):
        return Texture((texels,))
    across = texels.shape[1] // width
    # Copies, so that a frame in use does not hold the others in memory.
    cells = {
        n: texels[n // across * height :, n % across * width :][:height, :width].copy()
        for n in {n for n, _ in layout.order}
    }
    ticks = tuple(ticks for _, ticks in layout.order)
    return Texture(tuple(cells[n] for n, _ in layout.order), ticks)


def check_sheet(layout: FrameLayout, name: str) -> None:
    """Raise PackError unless the frames have at most MAX_SHEET px a side."""
    width, height = layout.width, layout.height
    if max(width, height) > MAX_SHEET:
        raise PackError(
            f"{name} is {width} x {height} px; a sheet has at most {MAX_SHEET} a side: shrink it"
        )


def checker() -> Texels:
    """The game's picture for a missing texture, 16 x 16: black and magenta quarters."""
    texels = np.zeros((_CHECKER_SIDE, _CHECKER_SIDE, 4), np.uint8)
    low = np.arange(_CHECKER_SIDE) < _CHECKER_SIDE // 2
    texels[low[:, None] ^ low] = (0xF8, 0, 0xF8, 0)
    texels[..., 3] = 255
    return texels


MISSING = Texture((checker(),))
"""What is drawn for a missing texture."""


def _frame_size(animation: dict[str, Any], width: int, height: int, name: str) -> tuple[int, int]:
    least = min(width, height)
    given = "width" in animation or "height" in animation
    size = (
        _whole(animation, "width", width if given else least, name),
        _whole(animation, "height", height if given else least, name),
    )
    if width % size[0] or height % size[1]:
        raise PackError(
            f"{name}: frames of {size[0]} x {size[1]} do not divide {width} x {height} px evenly:"
            " change the size"
        )
    return size


def _order(animation: dict[str, Any], count: int, name: str) -> tuple[tuple[int, int], ...]:
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
            raise PackError(
                f"{name}: frame {shown(index)} does not exist: they are 0 to {count - 1}"
            )
        order.append((index, _whole(entry, "time", usual, name)))
    return tuple(order)


def _whole(entry: dict[str, Any], key: str, default: int, name: str) -> int:
    value = entry.get(key, default)
    if not isinstance(value, int) or isinstance(value, bool) or not 0 < value < 1 << 20:
        raise PackError(f"{name}: {key} must be a whole number from 1, not {shown(value)}")
    return value
