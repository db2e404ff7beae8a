"""Which charge of a design each texel belongs to, and the gradients that lie over it.

A charge is a layer whose shape ends at edges. A gradient fades instead: it has no shape of its own,
and the charges below it keep theirs. Both are known from the layers of a material; the colour that
their mixture has does not tell them apart.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Mask, Texels
from drapery.banner.dyes import DYES
from drapery.render.flatten import lay_over
from drapery.render.scene import Material

SHEET = 64
"""Width of a sheet [texels]."""
HALF = 128
"""The least alpha of a texel that a layer covers."""
STEP = 64
"""The least change of alpha, over a texel of the sheet, that is an edge of a shape."""

Numbers = NDArray[np.intp]
Shares = NDArray[np.float32]
Item = TypeVar("Item", bound=np.generic)


@dataclass(frozen=True, eq=False)
class Charges:
    """What each texel of a sheet shows.

    dyes: the number of the dye of its charge, shape [H, W]; the field is a charge too.
    labels: the same where neighbours are of one dye under the same gradients, shape [H, W].
    shares: how much one sees of each dye in use, by its number, 0 to 1, shape [H, W], float32.
    """

    dyes: Numbers
    labels: Numbers
    shares: Mapping[int, Shares]

    def repeated(self, times: int) -> "Charges":
        """The same on a sheet this many times as wide and high."""
        shares = {number: _repeated(each, times) for number, each in self.shares.items()}
        return Charges(_repeated(self.dyes, times), _repeated(self.labels, times), shares)


def charges_of(material: Material) -> Charges:
    """The charges and gradients of a material, as wide as its widest layer.

    Where its layers are not of one dye each, every texel is of the dye that is nearest to it.
    """
    if not is_dyed(material):
        return _nearest_charges(merged_texels(material))
    numbers = {dye.rgb: dye.number for dye in DYES.values()}
    tinted = [layer for layer in material.layers if layer.tint in numbers]
    side = max(layer.texels.shape[1] for layer in material.layers)
    alphas = [_repeated(layer.texels[..., 3], side // layer.texels.shape[1]) for layer in tinted]
    shape = max(each.shape[0] for each in alphas), side
    dyes, above = np.zeros(shape, np.intp), np.zeros(shape, np.intp)
    shares: dict[int, Shares] = {0: np.ones(shape, np.float32)}
    field = alphas[0] >= HALF
    for layer, alpha in zip(tinted, alphas, strict=True):
        number, gradient = numbers[layer.tint], fades(alpha, field)
        share = (alpha / 255 if gradient else alpha >= HALF).astype(np.float32)
        for each in shares.values():
            each *= 1 - share
        shares[number] = shares.get(number, np.float32(0)) + share
        if gradient:
            above += 1
        else:
            dyes[alpha >= HALF], above[alpha >= HALF] = number, 0
    return Charges(dyes, dyes + len(DYES) * above, shares)


def is_dyed(material: Material) -> bool:
    """Whether the layers of a material are of one dye each, but for one below them."""
    dyes = {dye.rgb for dye in DYES.values()}
    tinted = sum(layer.tint in dyes for layer in material.layers)
    return tinted > 0 and tinted >= len(material.layers) - 1


def fades(alpha: NDArray[np.uint8], field: Mask) -> bool:
    """Whether a layer is a gradient: less than half of its outline on the field is an edge.

    alpha: shape [H, W]. field: where the lowest dye is, of the same shape.
    """
    covered = alpha >= max(1, min(HALF, (int(alpha[field].max(initial=0)) + 1) // 2))
    reach = max(1, alpha.shape[1] // SHEET)
    outline = edges = 0
    for axis in (0, 1):
        level, inside, within = (
            np.moveaxis(each, axis, 0) for each in (alpha.astype(np.int16), covered, field)
        )
        ends = (inside[reach:] != inside[:-reach]) & within[reach:] & within[:-reach]
        outline += int(np.count_nonzero(ends))
        edges += int(np.count_nonzero(ends & (abs(level[reach:] - level[:-reach]) >= STEP)))
    return 2 * edges < outline


def merged_texels(material: Material) -> Texels:
    """The layers of a material as one, as wide as the widest of them."""
    side = max(layer.texels.shape[1] for layer in material.layers)
    merged: Texels | None = None
    for layer in material.layers:
        own = layer.texels.copy()
        own[..., :3] = (own[..., :3] * np.array(layer.tint, np.uint16) + 127) // 255
        own = own.repeat(side // own.shape[1], axis=0).repeat(side // own.shape[1], axis=1)
        if merged is None:
            merged = own
            if material.alpha == "opaque":
                merged[..., 3] = 255
        else:
            merged = lay_over(own, merged)
    assert merged is not None
    return merged


def _nearest_charges(texels: Texels) -> Charges:
    colours = np.array([dye.rgb for dye in DYES.values()], np.int32)
    apart = texels[..., None, :3].astype(np.int32) - colours
    dyes: Numbers = np.argmin((apart * apart).sum(axis=-1), axis=-1)
    return Charges(
        dyes, dyes, {int(each): (dyes == each).astype(np.float32) for each in np.unique(dyes)}
    )


def _repeated(values: NDArray[Item], times: int) -> NDArray[Item]:
    """Each texel as a square of texels. values: shape [..., H, W]."""
    return values.repeat(times, axis=-2).repeat(times, axis=-1)
