"""How to make a design at the loom: its steps, and the layers that have no effect."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from drapery.banner.design import LOOM_LAYERS, Banner, Layer
from drapery.banner.packs import Packs
from drapery.banner.pattern_items import PATTERN_ITEMS
from drapery.banner.sprites import FLAG_REGIONS, composite, flag_layers


@dataclass(frozen=True)
class LoomStep:
    """One step at the loom.

    layer: what is added.
    banner: the design after it.
    """

    layer: Layer
    banner: Banner

    @property
    def item(self) -> str | None:
        """The id of the pattern item that the loom needs, such as `creeper_banner_pattern`."""
        needed = PATTERN_ITEMS.get(self.layer.pattern)
        return needed.item if needed else None


def loom_steps(banner: Banner) -> Iterator[LoomStep]:
    """The steps in which a loom makes a banner, from the plain base on, one for each layer."""
    for count, layer in enumerate(banner.layers, 1):
        yield LoomStep(layer, replace(banner, layers=banner.layers[:count]))


def fits_loom(banner: Banner) -> bool:
    """Whether a loom can make the banner: it adds at most LOOM_LAYERS layers."""
    return len(banner.layers) <= LOOM_LAYERS


def simplify(banner: Banner, packs: Packs) -> Banner:
    """The banner without the layers that change no texel of the flag.

    Lower layers are removed first, so of two equal layers the upper one stays.

    banner: the design.
    packs: the resource packs with which no texel changes, see `drapery.packs.open_packs`.

    Raises PackError for a texture that cannot be used.
    """
    whole = _visible(banner, packs)
    result = banner
    for layer_index in range(len(banner.layers)):
        # Layers are removed from the bottom up, so a layer keeps its distance to the top.
        place = layer_index - (len(banner.layers) - len(result.layers))
        without = replace(result, layers=result.layers[:place] + result.layers[place + 1 :])
        if np.array_equal(_visible(without, packs), whole):
            result = without
    return result


def _visible(banner: Banner, packs: Packs) -> np.ndarray:
    sheet = composite(flag_layers(banner, packs))
    return np.concatenate([region.crop(sheet).reshape(-1, 4) for region in FLAG_REGIONS.values()])
