"""Colours of samples: tints, light, layers, and the average of a pixel. A colour is 0xAABBGGRR."""

from typing import Any

import numpy as np

from drapery.jit import kernel
from drapery.render.soft.bins import TILE

OPAQUE_BITS = 0xFF000000
CHANNELS = 0x00FF00FF
HALVES = 0x00010001
"""Two channels of a colour, eight bits apart, and one unit of each."""

LIGHT_BITS = 24
FULL_LIGHT = 1 << LIGHT_BITS
"""Light is multiplied in integers, which is faster than converting colours to floats and back."""


@kernel
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


@kernel
def tinted(texel: Any, red: Any, green: Any, blue: Any) -> Any:
    """round(texel * tint / 255) for each channel; the alpha is kept."""
    r = ((texel & 255) * red + 127) // 255
    g = (((texel >> 8) & 255) * green + 127) // 255
    b = (((texel >> 16) & 255) * blue + 127) // 255
    return (texel & OPAQUE_BITS) | b << 16 | g << 8 | r


@kernel
def lit(colour: Any, light: Any, tint: Any) -> Any:
    """round(colour * light * tint) for each channel; light and tint in units of 1 / FULL_LIGHT."""
    half = FULL_LIGHT >> 1
    r = ((colour & 255) * (light * tint[0] >> LIGHT_BITS) + half) >> LIGHT_BITS
    g = (((colour >> 8) & 255) * (light * tint[1] >> LIGHT_BITS) + half) >> LIGHT_BITS
    b = (((colour >> 16) & 255) * (light * tint[2] >> LIGHT_BITS) + half) >> LIGHT_BITS
    return (colour & OPAQUE_BITS) | b << 16 | g << 8 | r


@kernel
def resolve(
    colours: Any, x0: Any, y0: Any, width: Any, height: Any, across: Any, grid: Any, picture: Any
) -> Any:
    """Put a tile into the picture: grid x grid samples are averaged to a pixel, weighted by their
    opacity.

    Where all samples are opaque, which most are, the weights are equal: two channels at once are
    added in one number and divided by a power of two, which rounds as `_mean` does.
    """
    shift = np.uint32(4 if grid == 4 else 2)
    half = np.uint32(HALVES << (shift - np.uint32(1)))
    for row in range(height):
        start = (y0 + row) * across + x0
        if grid == 1:
            for column in range(width):
                picture[np.uint64(start + column)] = colours[np.uint64(row * TILE + column)]
            continue
        for column in range(width):
            corner = np.uint64(row * grid * TILE + column * grid)
            opaque = np.uint32(OPAQUE_BITS)
            low = high = half
            for line in range(grid):
                for place in range(grid):
                    colour = colours[corner + np.uint64(line * TILE + place)]
                    opaque &= colour
                    low += colour & np.uint32(CHANNELS)
                    high += (colour >> np.uint32(8)) & np.uint32(CHANNELS)
            at = np.uint64(start + column)
            if opaque == np.uint32(OPAQUE_BITS):
                low = (low >> shift) & np.uint32(CHANNELS)
                picture[at] = low | ((high >> shift) & np.uint32(CHANNELS)) << np.uint32(8)
            else:
                picture[at] = _mean(colours, np.int64(corner), grid)


@kernel
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
