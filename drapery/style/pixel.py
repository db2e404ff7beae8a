"""Cloth as pixel art: the outline of a small cloth becomes a polygon of whole pixels.

The method of Slow Rush Studios' capes: the particles at the cloth's edge form a polygon, and each
pixel of its bounding box whose centre lies inside is filled.
"""

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from drapery.arrays import Mask, Texels
from drapery.mesh import Array


def outline(rows: int, columns: int) -> NDArray[np.int32]:
    """Indices of the particles at the edge of a grid, in order around it from the top left."""
    index = np.arange(rows * columns, dtype=np.int32).reshape(rows, columns)
    sides = [index[0, :-1], index[:-1, -1], index[-1, :0:-1], index[:0:-1, 0]]
    around: NDArray[np.int32] = np.concatenate(sides)
    return around


def bounding_box(polygon: Array, width: int, height: int) -> tuple[int, int, int, int]:
    """Left, top, right, bottom of the pixels that a polygon [P, 2] may cover, clipped."""
    low = np.floor(polygon.min(axis=0)).astype(int)
    high = np.ceil(polygon.max(axis=0)).astype(int)
    left, top = np.clip(low, 0, (width, height))
    right, bottom = np.clip(high, 0, (width, height))
    return int(left), int(top), int(right), int(bottom)


def fill_polygon(polygon: Array, width: int, height: int) -> Mask:
    """Pixels whose centres lie inside a polygon by the even-odd rule, shape [height, width].

    polygon: corners in pixels, shape [P, 2]; x to the right, y down, pixel (0, 0) covers 0..1.
    A centre on an edge belongs to the side to the right of the edge, or below it, so polygons with
    a common edge fill each pixel along it exactly once.
    """
    mask = np.zeros((height, width), np.bool_)
    left, top, right, bottom = bounding_box(polygon, width, height)
    if right <= left or bottom <= top:
        return mask
    x = np.arange(left, right) + 0.5
    y = np.arange(top, bottom)[:, None] + 0.5
    inside = np.zeros((bottom - top, right - left), np.bool_)
    for start, end in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        # From the upper end down, so that an edge is rounded alike for both of its polygons.
        (x0, y0), (x1, y1) = (start, end) if start[1] <= end[1] else (end, start)
        # Half-open in y: an edge counts for the rows at its upper end but not at its lower.
        crosses = (y0 <= y) != (y1 <= y)
        inside ^= crosses & ((x - x0) * (y1 - y0) >= (y - y0) * (x1 - x0))
    mask[top:bottom, left:right] = inside
    return mask


def lay_sprite(canvas: Texels, sprite: Texels, corner: Array) -> None:
    """Put a sprite on a canvas where it is not transparent; the part outside is cut off.

    corner: place of its upper left pixel, x and y of whole pixels, shape [2].
    """
    left, top = (int(value) for value in corner)
    rows, columns = np.nonzero(sprite[..., 3])
    y, x = rows + top, columns + left
    seen = (y >= 0) & (y < canvas.shape[0]) & (x >= 0) & (x < canvas.shape[1])
    canvas[y[seen], x[seen]] = sprite[rows[seen], columns[seen]]


def enlarged(canvas: Texels, scale: int, size: tuple[int, int]) -> Texels:
    """A canvas of which each pixel is a square of `scale` pixels, cut to a width and height."""
    large = canvas.repeat(scale, axis=0).repeat(scale, axis=1)
    return np.ascontiguousarray(large[: size[1], : size[0]])


def fill_cloth(
    canvas: Texels, cloth: tuple[int, int], places: Array, colour: Array, hem: bool
) -> None:
    """Fill the outline of a grid, and its last row of cells in a darker tone if it has a hem.

    cloth: rows and columns of particles.
    places: of the particles on the canvas [pixels], shape [N, 2].
    colour: sRGB 0..255, shape [3].
    """
    (rows, columns), (height, width) = cloth, canvas.shape[:2]
    canvas[fill_polygon(places[outline(rows, columns)], width, height), :3] = colour
    if hem and rows > 2:
        low = places[(rows - 2) * columns :]
        canvas[fill_polygon(low[outline(2, columns)], width, height), :3] = colour * 2 // 3


def with_works(
    pixels: Texels,
    shape: tuple[int, int],
    places: Array,
    pairs: NDArray[np.int32],
    pinned: NDArray[np.int32],
    scale: int,
) -> Texels:
    """A picture with a cloth's dots, constraints, pins and bounding box drawn over it.

    shape: rows and columns of its dots.
    places: of the dots before the picture was enlarged [pixels], shape [N, 2].
    pairs: dots that a constraint joins, shape [C, 2].
    pinned: numbers of the pins.
    scale: by which the picture is enlarged.
    """
    image = Image.fromarray(pixels)
    pen = ImageDraw.Draw(image)
    at = [(float(x), float(y)) for x, y in places * scale]
    box = bounding_box(places[outline(*shape)], pixels.shape[1], pixels.shape[0])
    pen.rectangle([value * scale for value in box], outline=(240, 150, 40))
    for i, j in pairs.tolist():
        pen.line((*at[i], *at[j]), fill=(60, 110, 230))
    for number, (x, y) in enumerate(at):
        is_pin = number in pinned
        radius = max(2, scale - 1) if is_pin else max(1, scale // 2)
        colour = (220, 40, 40) if is_pin else (60, 200, 80)
        pen.ellipse((x - radius, y - radius, x + radius, y + radius), fill=colour)
    return np.asarray(image)
