"""A row of banners as one picture, such as the letters of a word."""

from collections.abc import Sequence

import numpy as np

from drapery.arrays import Pixels
from drapery.banner.design import Banner
from drapery.banner.packs import Packs
from drapery.pictures import draw, face_pixels
from drapery.render import Frame
from drapery.settings import OPTIONS, Settings

GAP = 2
"""Transparent texels between the faces of a row."""


def faces_row(banners: Sequence[Banner], packs: Packs, *, scale: int = 8) -> Frame:
    """The plain faces side by side, each 20 x 40 texels.

    banners: from left to right.
    packs: resource packs, see `drapery.packs.open_packs`.
    scale: pixels of a texel.

    Raises PackError for a texture that cannot be used.
    """
    gap = np.zeros((40 * scale, GAP * scale, 4), np.uint8)
    parts: list[Pixels] = []
    for banner in banners:
        parts += [gap, face_pixels(banner, packs, scale)]
    return Frame(np.concatenate(parts[1:], axis=1))


def cloth_row(banners: Sequence[Banner], settings: Settings) -> Frame:
    """The banners as cloth side by side.

    Each has a seed of its own, so that equal letters do not hang in equal folds.

    banners: from left to right.
    settings: the options of each picture.

    Raises OptionError, PackError or BackendError, as `drapery.draw` does.
    """
    frames = []
    for number, banner in enumerate(banners):
        blown = OPTIONS["seed"].applies(settings.subject(banner.kind))
        own = settings.changed(seed=settings.seed + number) if blown else settings
        frames.append(draw(banner, own))
    return Frame(np.concatenate([frame.pixels for frame in frames], axis=1))
