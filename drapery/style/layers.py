"""A banner's layers as looks: textured quads stacked on one another, or one composited texture.

Stacked is the game's way: every layer is drawn over the one below, tinted on the way. Flat
composites them first and draws one texture; pictures of the two agree within 2/255.
"""

from typing import Literal

from drapery.banner.design import Banner
from drapery.banner.packs import Packs
from drapery.banner.sprites import composite, flag_layers
from drapery.render.scene import Coat, Look

LayerMode = Literal["stacked", "flat"]


def flag_look(banner: Banner, packs: Packs, mode: LayerMode = "stacked") -> Look:
    """What the flag wears: the cloth, the base dye, then the layers in order.

    Raises PackError where a texture cannot be used.
    """
    layers = flag_layers(banner, packs)
    if mode == "flat":
        return Look((Coat(composite(layers)),))
    return Look(tuple(Coat(texels, tint) for texels, tint in layers))


def wood_look(packs: Packs) -> Look:
    """What pole and bar wear."""
    return Look((Coat(packs.base_sheet()),))
