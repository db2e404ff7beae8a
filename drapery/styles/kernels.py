"""Kernels of the picture steps. Invisible pixels, those with alpha 0, keep their bytes.

Pictures are words: a pixel's red, green, blue and alpha from the lowest byte to the highest,
uint32 [H, W], C-contiguous. All kernels but `average` change them in place. Sides of tiles, which
repeat over the picture, are powers of two.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Words
from drapery.jit import entry_point, kernel

Levels = NDArray[np.uint8]
Whole = NDArray[np.int32]
Singles = NDArray[np.float32]
Doubles = NDArray[np.float64]

PALE = 0.4
"""The largest share of dark places that strokes of paper cover."""
GROWTH, WIDEST = 5.0, 1.6
"""How fast strokes of ink grow as it becomes darker, and up to how wide [widths]."""
SLOTS = 8192
"""Colours that a kernel remembers; a power of two."""


@kernel
def _bytes(word: Any) -> Any:
    """Red, green and blue."""
    return np.int64(word & 255), np.int64((word >> 8) & 255), np.int64((word >> 16) & 255)


@kernel
def _with_bytes(word: Any, red: Any, green: Any, blue: Any) -> Any:
    """The word with another colour and its own alpha."""
    return (word & 0xFF000000) | (blue << 16) | (green << 8) | red


@kernel
def _brightness(word: Any) -> Any:
    """0..255."""
    red, green, blue = _bytes(word)
    return 0.299 * red + 0.587 * green + 0.114 * blue


@kernel
def _average_of(words: Words, y: int, x: int, grid: int) -> Any:
    """One square as a pixel, each of its pixels weighted by its opacity."""
    red, green, blue, total = 0, 0, 0, 0
    for row in range(y * grid, (y + 1) * grid):
        for column in range(x * grid, (x + 1) * grid):
            alpha: Any = np.int64(words[row, column] >> 24)
            r, g, b = _bytes(words[row, column])
            red, green, blue = red + alpha * r, green + alpha * g, blue + alpha * b
            total += alpha
    if total == 0:
        return 0
    half, count = total // 2, grid * grid
    colour = (red + half) // total | (green + half) // total << 8 | (blue + half) // total << 16
    return colour | (total + count // 2) // count << 24


@entry_point
def average(words: Words, grid: int, result: Words) -> None:
    """Squares of grid x grid pixels become one each. result: [H // grid, W // grid], filled."""
    for y in range(result.shape[0]):
        for x in range(result.shape[1]):
            first, same = words[y * grid, x * grid], True
            for row in range(y * grid, (y + 1) * grid):
                for column in range(x * grid, (x + 1) * grid):
                    same &= words[row, column] == first
            if same:
                result[y, x] = first if first >= 0x1000000 else 0
            else:
                result[y, x] = _average_of(words, y, x, grid)


@entry_point
def cel(
    words: Words, normal: Singles, model: Whole, light: Singles, bands: int, table: Levels
) -> None:
    """Shade models by their normals, float32 [H, W, 3]. model: int32 [H, W].

    light: unit vector towards it, the cosine at the darkest step, and the range to the brightest,
        float32 [5]. table: what each level becomes in each of `bands` steps, uint8 [bands, 256].
    """
    a, b, c, dark, span = light
    steps, most = np.float32(bands), np.float32(bands - 1)
    for y in range(words.shape[0]):
        row, models, normals = words[y], model[y], normal[y]
        for x in range(len(row)):
            if models[x] < 0 or row[x] < 0x1000000:
                continue
            facing = normals[x, 0] * a + normals[x, 1] * b + normals[x, 2] * c
            band = np.floor((facing - dark) / span * steps)
            levels = table[np.int64(min(max(band, np.float32(0)), most))]
            red, green, blue = _bytes(row[x])
            row[x] = _with_bytes(row[x], levels[red], levels[green], np.int64(levels[blue]))


@entry_point
def level_out(words: Words, table: Levels, tile: Whole) -> None:
    """Replace each level of a channel: uint8 [T, 256, 256], by the largest channel and the level.

    tile: the first index of `table` for each pixel, int32.
    """
    for y in range(words.shape[0]):
        row, tiles = words[y], tile[y & (tile.shape[0] - 1)]
        for x in range(len(row)):
            if row[x] < 0x1000000:
                continue
            red, green, blue = _bytes(row[x])
            levels = table[tiles[x & (len(tiles) - 1)], max(red, green, blue)]
            row[x] = _with_bytes(row[x], levels[red], levels[green], np.int64(levels[blue]))


@kernel
def _nearest_of(word: Any, offset: float, table: Doubles) -> int:
    """The number of the nearest colour of a table; see `nearest`."""
    (red, green, blue), best, found = _bytes(word), np.inf, 0
    for number in range(len(table)):
        r, g, b = (
            red + offset - table[number, 0],
            green + offset - table[number, 1],
            blue + offset - table[number, 2],
        )
        apart = r * r * 2.0 + g * g * 4.0 + b * b * 3.0
        if apart < best:
            best, found = apart, number
    return found


@entry_point
def nearest(words: Words, table: Doubles, offsets: Doubles, tile: Whole) -> None:
    """The nearest of some colours, float64 [N, 3], after each pixel is raised by an offset.

    The squares of the distances in red, green and blue count 2, 4 and 3 times.
    offsets: float64 [T], at most 255. tile: the index of the offset of each pixel, int32.
    """
    keys, values = np.full(SLOTS, -1, np.int64), np.zeros(SLOTS, np.int64)
    for y in range(words.shape[0]):
        row, tiles = words[y], tile[y & (tile.shape[0] - 1)]
        for x in range(len(row)):
            if row[x] < 0x1000000:
                continue
            index = np.int64(tiles[x & (len(tiles) - 1)])
            key = np.int64(row[x] & 0xFFFFFF) | index << 24
            slot = (key * 2654435761 >> 20) & (SLOTS - 1)
            if keys[slot] != key:
                number = _nearest_of(row[x], offsets[index], table)
                red, green, blue = table[number, 0], table[number, 1], table[number, 2]
                keys[slot] = key
                values[slot] = _with_bytes(0, np.int64(red), np.int64(green), np.int64(blue))
            row[x] = (row[x] & 0xFF000000) | values[slot]


@entry_point
def tone(words: Words, dark: Doubles, light: Doubles, gamma: float) -> None:
    """Each brightness becomes a colour between two, float64 [3] each."""
    keys, values = np.zeros(SLOTS, np.uint32), np.zeros(SLOTS, np.uint32)
    for y in range(words.shape[0]):
        row = words[y]
        for x in range(len(row)):
            word = row[x]
            if word < 0x1000000:
                continue
            slot = ((word & 0xFFFFFF) * 2654435761 >> 20) & (SLOTS - 1)
            if keys[slot] != word:
                share = (_brightness(word) / 255) ** gamma
                red = np.rint(dark[0] + share * (light[0] - dark[0]))
                green = np.rint(dark[1] + share * (light[1] - dark[1]))
                blue = np.rint(dark[2] + share * (light[2] - dark[2]))
                keys[slot] = word
                values[slot] = _with_bytes(word, np.int64(red), np.int64(green), np.int64(blue))
            row[x] = values[slot]


@kernel
def _covered(across: Any, width: Any, spacing: float, foot: float) -> Any:
    """How much of a place strokes cover that begin at each `spacing`, 0 to 1.

    across: of the middle of the place from the begin of a stroke, 0 to `spacing`. width: of the
    strokes. foot: width of the place. All [pixels].
    """
    first, last = across - foot / 2, across + foot / 2
    own = min(last, width) - max(first, 0.0)
    return min((max(own, 0.0) + max(min(last - spacing, width), 0.0)) / foot, 1.0)


@entry_point
def hatch(
    words: Words, model: Whole, strokes: Doubles, grid: int, pen: Doubles, ink: int, paper: int
) -> None:
    """Strokes on models, the more the darker, and strokes of paper on ink where it is darker still.

    Their width follows the tone from nothing on, and pixels that they cover in part are mixed: a
    stroke that came at its full width would flicker where light moves over cloth.

    strokes: cosine and sine of each direction across the strokes, and the darkness from which on
        there are any, float64 [S, 3]. grid: see `Canvas`.
    pen: spacing and width of the strokes [pixels], strength, the darkness over which all is ink,
        that from which on the strokes are of paper, and that at which those end, float64 [6].
    ink, paper: words.
    """
    spacing, width, strength, solid, turned, ended = pen
    red, green, blue = _bytes(np.uint32(paper))
    r, g, b = _bytes(np.uint32(ink))
    for y in range(words.shape[0]):
        row, models = words[y], model[y]
        for x in range(len(row)):
            if models[x] < 0 or row[x] < 0x1000000:
                continue
            black = 1 - _brightness(row[x]) / 255
            dark, share = strength * black, 1.0 if black > solid else 0.0
            for number in range(len(strokes)):
                least = strokes[number, 2]
                if share == 1.0 or dark <= least:
                    break
                place = x / grid * strokes[number, 0] + y / grid * strokes[number, 1]
                if dark > turned:
                    # Strokes of paper lie where those of ink leave paper.
                    pale = PALE * spacing * max(ended - dark, 0.0) / (ended - turned)
                    across = place + pale - np.floor((place + pale) / spacing) * spacing
                    share = 1 - _covered(across, pale, spacing, 1 / grid)
                    break
                across = place - np.floor(place / spacing) * spacing
                wide = width * min((dark - least) * GROWTH, WIDEST)
                share += (1 - share) * _covered(across, wide, spacing, 1 / grid)
            own = np.int64(256 * share + 0.5)
            mixed = (own * r + (256 - own) * red + 128) >> 8
            mixed |= (own * g + (256 - own) * green + 128) >> 8 << 8
            mixed |= (own * b + (256 - own) * blue + 128) >> 8 << 16
            row[x] = (row[x] & 0xFF000000) | mixed


@kernel
def _flag_depths(
    flags: Levels,
    depth: Singles,
    other_depth: Singles,
    model: Whole,
    other_model: Whole,
    limit: float,
) -> None:
    """Flag 1: there may be an edge between two rows of neighbours."""
    for x in range(len(flags)):
        far = abs(other_depth[x] - depth[x])
        flags[x] = (model[x] != other_model[x]) | (far > limit)


@kernel
def _flag_creases(
    flags: Levels, normal: Singles, other: Singles, model: Whole, cosine: float
) -> None:
    """Flag 2: there is a crease. normal, other: three numbers for each pixel."""
    for x in range(len(flags)):
        facing = normal[3 * x] * other[3 * x]
        facing += normal[3 * x + 1] * other[3 * x + 1]
        facing += normal[3 * x + 2] * other[3 * x + 2]
        flags[x] |= 2 if (facing < cosine) & (model[x] >= 0) else 0


@kernel
def _flag_colours(flags: Levels, row: Words, other: Words, mask: np.uint32) -> None:
    """Flag 4: two neighbours may have other colours: they differ in a bit of a mask."""
    for x in range(len(flags)):
        flags[x] |= 4 if (row[x] ^ other[x]) & mask else 0


@kernel
def _apart(one: Any, other: Any) -> Any:
    """The largest difference between two colours in red, green or blue."""
    red, green, blue = _bytes(one)
    r, g, b = _bytes(other)
    return max(abs(red - r), abs(green - g), abs(blue - b))


@kernel
def _rises(depth: Singles, y: int, x: int, down: int, right: int) -> Any:
    """How much farther the next pixel is, less what the surface rises before or after it [m]."""
    height, width = depth.shape
    far, least = abs(depth[y + down, x + right] - depth[y, x]), np.float32(np.inf)
    if y >= down and x >= right:
        least = abs(depth[y, x] - depth[y - down, x - right])
    if y + 2 * down < height and x + 2 * right < width:
        after = depth[y + 2 * down, x + 2 * right] - depth[y + down, x + right]
        least = min(least, abs(after))
    return far - least if np.isfinite(least) else far


@kernel
def _mark(
    marks: Levels,
    flag: int,
    y: int,
    x: int,
    down: int,
    right: int,
    words: Words,
    depth: Singles,
    model: Whole,
    limit: float,
    contrast: int,
) -> None:
    """Mark the nearer of two neighbours at an edge, or the first of those at a crease."""
    v, u = y + down, x + right
    one, other = model[y, x], model[v, u]
    edge = one != other
    if not edge and flag & 1:
        edge = _rises(depth, y, x, down, right) > limit
    if edge and depth[v, u] < depth[y, x]:
        marks[v, u] |= other >= 0
    elif edge:
        marks[y, x] |= one >= 0
    elif flag & 2 and one >= 0 and other >= 0:
        marks[y, x] = 1
    one, other = words[y, x], words[v, u]
    if flag & 4 and one >= 0x1000000 and other >= 0x1000000 and _apart(one, other) >= contrast:
        marks[y, x] = 1


@entry_point
def mark_edges(
    marks: Levels,
    words: Words,
    depth: Singles,
    normal: Singles,
    model: Whole,
    limits: Singles,
    contrast: int,
    flags: Levels,
    eights: NDArray[np.uint64],
) -> None:
    """Mark the pixels at edges of models. marks: uint8 [H, W or more], zeros.

    depth, normal, model: see `Buffers`, normal as [H, 3 W].
    limits: step in depth [m] and cosine of a crease, float32 [2].
    contrast: between neighbouring colours, 0 for none. flags: zeros, as long as a row of marks.
    eights: the same memory, eight flags a number.
    """
    height, width = words.shape
    # Levels that are 2^k or more apart differ in a bit from k on.
    bit = 1
    while 2 * bit <= contrast:
        bit *= 2
    mask = np.uint32((256 - bit) * 0x10101)
    limit, cosine = limits[0], limits[1]
    for y in range(height):
        first, last = 0, width
        below = min(y + 1, height - 1)
        while first < last and model[y, first] < 0 and model[below, first] < 0:
            first += 1
        while last > first and model[y, last - 1] < 0 and model[below, last - 1] < 0:
            last -= 1
        for right in range(2 if last > first else 0):
            down, v = 1 - right, y + 1 - right
            if v == height:
                continue
            # To the right, the pixel before the first one and the last one also have neighbours.
            one, end = max(first - right, 0), min(last, width - right)
            other, stop = one + right, end + right
            here = flags[one:end]
            _flag_depths(
                here,
                depth[y, one:end],
                depth[v, other:stop],
                model[y, one:end],
                model[v, other:stop],
                limit,
            )
            if cosine > -1:
                this, that = normal[y, 3 * one : 3 * end], normal[v, 3 * other : 3 * stop]
                _flag_creases(here, this, that, model[y, one:end], cosine)
            if contrast:
                _flag_colours(here, words[y, one:end], words[v, other:stop], mask)
            for eight in range(one // 8, (end + 7) // 8):
                if eights[eight] == 0:
                    continue
                for x in range(8 * eight, 8 * eight + 8):
                    if flags[x]:
                        flag = flags[x]
                        _mark(marks, flag, y, x, down, right, words, depth, model, limit, contrast)
                        flags[x] = 0


@entry_point
def draw_marks(
    words: Words, source: Words, eights: NDArray[np.uint64], reach: NDArray[np.int64], table: Levels
) -> None:
    """Draw a disc around each marked pixel, on visible and invisible pixels.

    source: `words` before. eights: the marks, eight bytes a number.
    reach: how far a disc goes to each side in each row from its top to its foot, int64 [2 R + 1].
    table: what each level of a channel becomes, uint8 [3, 256].
    """
    height, width = words.shape
    radius = len(reach) // 2
    for y in range(height):
        last = -width - 2 * radius  # the mark before in this row, whose disc is drawn
        for eight in range(eights.shape[1]):
            if eights[y, eight] == 0:
                continue
            for place in range(8):
                x = 8 * eight + place
                if (eights[y, eight] >> np.uint64(8 * place)) & np.uint64(255) == 0:
                    continue
                for row in range(max(0, y - radius), min(height, y + radius + 1)):
                    side = reach[row - y + radius]
                    for column in range(
                        max(0, x - side, last + side + 1), min(width, x + side + 1)
                    ):
                        red, green, blue = _bytes(source[row, column])
                        drawn = table[0, red] | np.int64(table[1, green]) << 8
                        words[row, column] = 0xFF000000 | drawn | np.int64(table[2, blue]) << 16
                last = x


@kernel
def _box_along(values: Whole, row: Whole, radius: int) -> None:
    """Replace each number of each row by the sum of those up to `radius` before and after it."""
    height, width = values.shape
    row[:] = 0
    for y in range(height):
        total = 0
        for x in range(width):
            row[radius + 1 + x] = values[y, x]
        for x in range(min(radius, width)):
            total += row[radius + 1 + x]
        for x in range(width):
            total += row[x + 2 * radius + 1] - row[x]
            values[y, x] = total


@kernel
def _box_down(values: Whole, result: Whole, sums: Whole, radius: int, total: int) -> None:
    """The same along columns, into another array. total: how much one is in the result."""
    height, width = values.shape
    scale = np.float32(1 / total)
    sums[:] = 0
    for y in range(-radius, height):
        for x in range(width if y + radius < height else 0):
            sums[x] += values[y + radius, x]
        for x in range(width if y - radius > 0 else 0):
            sums[x] -= values[y - radius - 1, x]
        for x in range(width if y >= 0 else 0):
            result[y, x] = np.int32(np.float32(sums[x]) * scale)


@entry_point
def blur(values: Whole, other: Whole, room: Whole, radius: int) -> None:
    """Blur whole numbers by two boxes, with room for the rows in between, int32 [W + 2 R + 1].

    values: int32 [H, W], overwritten with the result. other: of the same shape.
    """
    side = 2 * radius + 1
    _box_along(values, room, radius)
    _box_down(values, other, room, radius, side * side)
    _box_along(other, room, radius)
    _box_down(other, values, room, radius, side * side)


@entry_point
def lay_under(words: Words, below: Whole, colour: int, scale: float) -> None:
    """Lay a colour, a word's lower bytes, under a picture. below * scale: its opacity, int32."""
    height, width = words.shape
    r, g, b = _bytes(np.uint32(colour))
    for y in range(height):
        for x in range(width):
            word = words[y, x]
            if below[y, x] == 0 or word >= 0xFF000000:
                continue
            own = (word >> 24) / 255
            under = min(1.0, below[y, x] * scale) * (1 - own)
            if under == 0.0:
                continue
            red, green, blue = _bytes(word)
            total = own + under
            red = np.int64((red * own + r * under) / total + 0.5)
            green = np.int64((green * own + g * under) / total + 0.5)
            blue = np.int64((blue * own + b * under) / total + 0.5)
            words[y, x] = np.int64(255 * total + 0.5) << 24 | blue << 16 | green << 8 | red
