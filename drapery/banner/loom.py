"""A design as work at the loom: its steps, and which of them nobody would see."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from drapery.banner.design import LOOM_LAYERS, Banner, Layer
from drapery.banner.packs import Packs
from drapery.banner.sprites import FLAG_REGIONS, composite, flag_layers

CHARGE_ITEMS = {
    "creeper": "creeper head",
    "skull": "wither skeleton skull",
    "flower": "oxeye daisy",
    "mojang": "enchanted golden apple",
    "globe": "globe pattern (from a cartographer)",
    "piglin": "snout pattern (from a bastion)",
    "flow": "flow pattern (from a trial chamber)",
    "guster": "guster pattern (from a trial chamber)",
    "bricks": "field masoned pattern",
    "curly_border": "bordure indented pattern",
}
"""What the loom wants beside the dye, for the patterns that want more."""


@dataclass(frozen=True)
class Step:
    """One step: the layer laid on and the banner as it is after it."""

    layer: Layer
    banner: Banner

    @property
    def item(self) -> str | None:
        """The pattern item that the loom wants, if any."""
        return CHARGE_ITEMS.get(self.layer.pattern)


def steps(banner: Banner) -> Iterator[Step]:
    """The loom's steps in order, from the plain base on."""
    for count, layer in enumerate(banner.layers, 1):
        yield Step(layer, replace(banner, layers=banner.layers[:count]))


def fits_loom(banner: Banner) -> bool:
    """Whether a survival player can make it: the loom stops at six layers."""
    return len(banner.layers) <= LOOM_LAYERS


def simplified(banner: Banner, packs: Packs) -> Banner:
    """The same picture with the layers left out that change no texel of the flag.

    Lower layers go first, so of two equal layers the upper one stays. Raises PackError.
    """
    whole = _visible(banner, packs)
    kept = banner
    for layer_index in range(len(banner.layers)):
        # Layers are dropped from the bottom up: those above keep their distance to the top.
        place = layer_index - (len(banner.layers) - len(kept.layers))
        without = replace(kept, layers=kept.layers[:place] + kept.layers[place + 1 :])
        if np.array_equal(_visible(without, packs), whole):
            kept = without
    return kept


def _visible(banner: Banner, packs: Packs) -> np.ndarray:
    sheet = composite(flag_layers(banner, packs))
    return np.concatenate([region.crop(sheet).reshape(-1, 4) for region in FLAG_REGIONS.values()])
