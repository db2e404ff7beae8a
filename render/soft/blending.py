"""Colours of samples: tints, light, layers, and the average of a pixel. A colour is 0xAABBGGRR."""

from typing import Any

import numpy as np

from drapery.jit import borrowing_kernel
from drapery.render.soft.bins import STRIDE, TILE

OPAQUE_BITS = 0xFF000000
CHANNELS = 0x00FF00FF
HALVES = 0x00010001
"""Two channels of a colour, eight bits apart, and one unit of each."""

LIGHT_BITS = 24
FULL_LIGHT = 1 << LIGHT_BITS
"""Light is multiplied in integers, which is faster than converting colours to floats and back."""

UNLIT = -1
"""In place of light where it does not reach: the colour stays as it is."""


@borrowing_kernel
def lay_over(top: Any, below: Any) -> Any:
    """Straight-alpha colours, one over the other, in 8 bits as the game blends."""
    a, d = top >> 24, below >> 24
    if a == 255 or a == 0:
        return top if a else below
    if d == 255:
        rest = 255 - a
        red = (a * (top & 255) + rest * (below & 255) + 127) // 255
        green = (a * ((top >> 8) & 255) + rest * ((below >> 8) & 255) + 127) // 255
        blue = (a * ((top >> 16) & 255) + rest * ((below >> 16) & 255) + 127) // 255
        return OPAQUE_BITS | blue << 16 | green << 8 | red
    share, rest = 255 * a, d * (255 - a)
    total = share + rest
    half = total >> 1
    red = (share * (top & 255) + rest * (below & 255) + half) // total
    green = (share * ((top >> 8) & 255) + rest * ((below >> 8) & 255) + half) // total
    blue = (share * ((top >> 16) & 255) + rest * ((below >> 16) & 255) + half) // total
    return ((total + 127) // 255) << 24 | blue << 16 | green << 8 | red


@borrowing_kernel
def tinted(texel: Any, red: Any, green: Any, blue: Any) -> Any:
    """round(texel * tint / 255) for each channel; the alpha is kept."""
    r = ((texel & 255) * red + 127) // 255
    g = (((texel >> 8) & 255) * green + 127) // 255
    b = (((texel >> 16) & 255) * blue + 127) // 255
    return (texel & OPAQUE_BITS) | b << 16 | g << 8 | r


@borrowing_kernel
def factors_of(light: Any, tint: Any) -> Any:
    """Light of a tint, for red, green and blue: uint32 in units of 1 / FULL_LIGHT.

    light: int32, tint: three of uint32, both in these units.
    """
    full = np.uint64(np.uint32(light))
    return (
        np.uint32(full * np.uint64(tint[0]) >> np.uint64(LIGHT_BITS)),
        np.uint32(full * np.uint64(tint[1]) >> np.uint64(LIGHT_BITS)),
        np.uint32(full * np.uint64(tint[2]) >> np.uint64(LIGHT_BITS)),
    )


@borrowing_kernel
def lit(colour: Any, light: Any, factors: Any) -> Any:
    """round(colour * factor) for each channel, or the colour itself where `light` is UNLIT.

    colour: uint32. factors: see `factors_of`. Products fit in 32 bits: twice as many of them are
    in a register as of 64 bits.
    """
    half, byte = np.uint32(FULL_LIGHT >> 1), np.uint32(255)
    r = np.uint32((colour & byte) * factors[0] + half) >> np.uint32(LIGHT_BITS)
    g = np.uint32(((colour >> np.uint32(8)) & byte) * factors[1] + half) >> np.uint32(LIGHT_BITS)
    b = np.uint32(((colour >> np.uint32(16)) & byte) * factors[2] + half) >> np.uint32(LIGHT_BITS)
    shaded = (colour & np.uint32(OPAQUE_BITS)) | b << np.uint32(16) | g << np.uint32(8) | r
    return np.uint32(shaded) if light >= 0 else colour


@borrowing_kernel
def resolve(
    colours: Any,
    x0: Any,
    y0: Any,
    width: Any,
    height: Any,
    across: Any,
    grid: Any,
    picture: Any,
    sums: Any,
) -> Any:
    """Put a tile into the picture: grid x grid samples are averaged to a pixel, weighted by their
    opacity.

    sums: scratch, see `_add_samples`.
    """
    for row in range(height):
        start = (y0 + row) * across + x0
        if grid == 1:
            for column in range(width):
                picture[np.uint64(start + column)] = colours[np.uint64(row * TILE + column)]
            continue
        corner = row * grid * TILE
        _add_samples(colours, corner, grid, sums)
        for column in range(width):
            place, at = np.uint64(column * grid), np.uint64(start + column)
            opacity = sums[place + np.uint64(STRIDE)]
            if opacity == 255 * grid * grid:
                picture[at] = sums[place]
            elif opacity == 0:
                picture[at] = 0
            else:
                picture[at] = _mean(colours, corner + column * grid, grid)


@borrowing_kernel
def _add_samples(colours: Any, corner: Any, grid: Any, sums: Any) -> Any:
    """Average the grid x grid samples from each sample of a row on, as if they were opaque.

    corner: the row's first sample. sums: the averages, and from STRIDE on the sums of the alphas,
    [2 * STRIDE], uint32.
    Two channels at once are added in one number and divided by a power of two, which rounds as
    `_mean` does.
    """
    for k in range(2 * STRIDE):
        sums[k] = 0
    for line in range(grid):
        for k in range(TILE):
            colour = colours[np.uint64(corner + line * TILE + k)]
            sums[k] += colour & np.uint32(CHANNELS)
            sums[STRIDE + k] += (colour >> np.uint32(8)) & np.uint32(CHANNELS)
    for k in range(2 * STRIDE - 1):
        sums[k] += sums[k + 1]
    if grid == 4:
        for k in range(2 * STRIDE - 2):
            sums[k] += sums[k + 2]
    shift = np.uint32(4 if grid == 4 else 2)
    half = np.uint32(HALVES << (shift - np.uint32(1)))
    for k in range(TILE):
        low, high = sums[k], sums[STRIDE + k]
        sums[STRIDE + k] = high >> np.uint32(16)
        low = ((low + half) >> shift) & np.uint32(CHANNELS)
        high = ((high + half) >> shift) & np.uint32(CHANNELS)
        sums[k] = low | high << np.uint32(8)


@borrowing_kernel
def _mean(colours: Any, corner: Any, grid: Any) -> Any:
    """The average of grid x grid samples from a corner, weighted by their opacity."""
    alpha = red = green = blue = np.int64(0)
    for line in range(grid):
        for place in range(grid):
            colour = np.int64(colours[corner + line * TILE + place])
            weight = colour >> 24
            alpha += weight
            red += weight * (colour & 255)
            green += weight * ((colour >> 8) & 255)
            blue += weight * ((colour >> 16) & 255)
    if alpha == 0:
        return np.int64(0)
    half, count = alpha >> 1, grid * grid
    red, green, blue = (red + half) // alpha, (green + half) // alpha, (blue + half) // alpha
    return (alpha + (count >> 1)) // count << 24 | blue << 16 | green << 8 | red
