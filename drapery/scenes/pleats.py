"""The wool of a skirt: pleats outside, a plain lining inside, and a band at the hem."""

import numpy as np

from drapery.errors import OptionError
from drapery.packs import Packs
from drapery.render import Material, TextureLayer
from drapery.style import BoxMapping
from drapery.style.tailoring import dyed_texels

SIDES = ("outside", "inside", "hem")
SIDES_ON_TEXTURE = BoxMapping(
    front_rect=(0.0, 0.0, 0.5, 1.0),
    back_rect=(0.5, 0.0, 1.0, 1.0),
    left=(0.0, 0.9, 0.1, 1.0),
    right=(0.0, 0.9, 0.1, 1.0),
    top=(0.0, 0.0, 0.5, 0.1),
    bottom=(0.0, 0.9, 0.5, 1.0),
)
"""The outside is on the left half of the texture, the lining on the right."""
WIDTH, PLEAT, HEM = 96, 8, 2
"""Of the outside, of a pleat and of the band at the hem [texels]."""


def pleated(packs: Packs, dyes: tuple[str, str, str], shown: str) -> Material:
    """Wool in the dyes of outside, inside and hem.

    shown: the names of the visible sides, of SIDES, with blanks between them.
    Raises OptionError or PackError.
    """
    named = shown.split()
    for side in named:
        if side not in SIDES:
            raise OptionError(f"side {side!r} is not known; use some of: {' '.join(SIDES)}")
    wool = np.tile(packs.texture("block/white_wool")[:16, :16], (1, 6, 1))[:, :WIDTH]
    outside, inside, hem = (dyed_texels(wool, dye) for dye in dyes)
    # The last column of every pleat is darker, like its edge.
    edge = np.arange(WIDTH) % PLEAT == PLEAT - 1
    outside[:, edge, :3] = outside[:, edge, :3] // 5 * 4
    outside[-HEM:], inside[-HEM:] = hem[-HEM:], outside[-HEM:]
    outside[..., 3] = 255 * ("outside" in named)
    inside[..., 3] = 255 * ("inside" in named)
    outside[-HEM:, :, 3] = 255 * ("hem" in named or "outside" in named)
    texels = np.ascontiguousarray(np.concatenate([outside, inside], axis=1))
    return Material((TextureLayer(texels),), "cutout")
