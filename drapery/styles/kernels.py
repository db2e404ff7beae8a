"""Kernels of the picture steps. Invisible pixels, those with alpha 0, keep their bytes.

Pictures are words: a pixel's red, green, blue and alpha from the lowest byte to the highest,
uint32 [H, W], C-contiguous. All kernels but `average` change them in place. Sides of tiles, which
repeat over the picture, are powers of two.
"""

import numpy as np

from drapery.jit import entry_point, kernel

SLOTS = 8192
"""Colours that a kernel remembers; a power of two."""


@kernel
def _bytes(word):
    """Red, green and blue."""
    return np.int64(word & 255), np.int64((word >> 8) & 255), np.int64((word >> 16) & 255)


@kernel
def _with_bytes(word, red, green, blue):
    """The word with another colour and its own alpha."""
    return (word & 0xFF000000) | (blue << 16) | (green << 8) | red


@kernel
def _brightness(word):
    """0..255."""
    red, green, blue = _bytes(word)
    return 0.299 * red + 0.587 * green + 0.114 * blue


@kernel
def _average_of(words, y, x, grid):
    """One square as a pixel, each of its pixels weighted by its opacity."""
    red, green, blue, total = 0, 0, 0, 0
    for row in range(y * grid, (y + 1) * grid):
        for column in range(x * grid, (x + 1) * grid):
            alpha = np.int64(words[row, column] >> 24)
            r, g, b = _bytes(words[row, column])
            red, green, blue = red + alpha * r, green + alpha * g, blue + alpha * b
            total += alpha
    if total == 0:
        return 0
    half, count = total // 2, grid * grid
    colour = (red + half) // total | (green + half) // total << 8 | (blue + half) // total << 16
    return colour | (total + count // 2) // count << 24


@entry_point
def average(words, grid, result):
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
def cel(words, normal, model, light, bands, table):
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
def level_out(words, table, tile):
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
def _nearest_of(word, offset, table):
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
def nearest(words, table, offsets, tile):
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
def tone(words, dark, light, gamma):
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
                mixed = dark + share * (light - dark)
                red, green, blue = np.rint(mixed[0]), np.rint(mixed[1]), np.rint(mixed[2])
                keys[slot] = word
                values[slot] = _with_bytes(word, np.int64(red), np.int64(green), np.int64(blue))
            row[x] = values[slot]


@entry_point
def hatch(words, model, strokes, grid, pen, ink, paper):
    """Strokes on models, the more the darker.

    strokes: cosine and sine of each direction across the strokes, and the darkness from which on
        there are any, float64 [S, 3]. grid: see `Canvas`.
    pen: spacing and width of the strokes [pixels], strength, and the darkness over which all is
        ink, float64 [4]. ink, paper: words.
    """
    spacing, width, strength, solid = pen
    for y in range(words.shape[0]):
        row, models = words[y], model[y]
        for x in range(len(row)):
            if models[x] < 0 or row[x] < 0x1000000:
                continue
            black = 1 - _brightness(row[x]) / 255
            dark, drawn = strength * black, black > solid
            for number in range(len(strokes)):
                least = strokes[number, 2]
                if drawn or dark <= least:
                    break
                place = x / grid * strokes[number, 0] + y / grid * strokes[number, 1]
                across = place - np.floor(place / spacing) * spacing
                drawn = across < width * min(max((dark - least) * 3 + 0.5, 0.0), 1.6)
            row[x] = (row[x] & 0xFF000000) | np.int64(ink if drawn else paper)


@kernel
def _flag(flags, depths, models, normals, limit, cosine):
    """Flag 1: there may be an edge between two rows of neighbours; flag 2: there is a crease."""
    (depth, other_depth), (model, other_model), (normal, other_normal) = depths, models, normals
    for x in range(len(flags)):
        far = abs(other_depth[x] - depth[x])
        flags[x] = (model[x] != other_model[x]) | (far > limit)
    if cosine <= -1:
        return
    for x in range(len(flags)):
        facing = normal[3 * x] * other_normal[3 * x]
        facing += normal[3 * x + 1] * other_normal[3 * x + 1]
        facing += normal[3 * x + 2] * other_normal[3 * x + 2]
        flags[x] |= 2 if (facing < cosine) & (model[x] >= 0) else 0


@kernel
def _flag_colours(flags, row, other, apart, contrast):
    """Flag 4: two neighbours have other colours. row, other: bytes. apart: room for as many."""
    for byte in range(len(row)):
        one, two = row[byte], other[byte]
        apart[byte] = one - two if one > two else two - one
    for byte in range(len(row)):
        apart[byte] = apart[byte] >= contrast
    differs = apart.view(np.uint32)
    for x in range(len(flags)):
        flags[x] |= 4 if differs[x] & 0xFFFFFF else 0


@kernel
def _rises(depth, y, x, down, right):
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
def _contrast(one, other):
    """The largest difference in a channel of two visible pixels; 0 if one is invisible."""
    if one < 0x1000000 or other < 0x1000000:
        return 0
    (r, g, b), (u, v, w) = _bytes(one), _bytes(other)
    return max(abs(r - u), abs(g - v), abs(b - w))


@kernel
def _mark(marks, flag, place, step, words, depth, model, limit, contrast):
    """Mark the nearer of two neighbours at an edge, or the first of those at a crease."""
    (y, x), (down, right) = place, step
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
        marks[y, x] = True
    if flag & 4 and _contrast(words[y, x], words[v, u]) >= contrast:
        marks[y, x] = True


@kernel
def _span(model, y):
    """The first pixel of a row that shows a model, and the one after the last."""
    row, first, last = model[y], 0, model.shape[1]
    while first < last and row[first] < 0:
        first += 1
    while last > first and row[last - 1] < 0:
        last -= 1
    return (first, last) if first < last else (model.shape[1], 0)


@kernel
def _edges(words, depth, normal, model, limit, cosine, contrast):
    """The pixels at edges, bool [H, W rounded up to eights]. normal: [H, 3 W]."""
    height, width = words.shape
    padded = -(-width // 8) * 8
    marks, flags = np.zeros((height, padded), np.bool_), np.zeros(padded, np.uint8)
    eights, levels = flags.view(np.uint64), words.view(np.uint8)
    apart = np.empty(4 * width, np.uint8)
    spans = [_span(model, y) for y in range(height)]
    for y in range(height):
        for down, right in ((0, 1), (1, 0)):
            v = y + down
            if v == height:
                continue
            first, last = min(spans[y][0], spans[v][0]), max(spans[y][1], spans[v][1])
            if last <= first:
                continue
            first, last = max(first - right, 0), min(last, width - right)
            flags[:] = 0
            one, other, normals = slice(first, last), slice(first + right, last + right), 3 * right
            here = flags[first:last]
            d, m = (depth[y, one], depth[v, other]), (model[y, one], model[v, other])
            n = normal[y, 3 * first : 3 * last], normal[v, 3 * first + normals : 3 * last + normals]
            _flag(here, d, m, n, limit, cosine)
            if contrast:
                room = apart[: 4 * len(here)]
                row = levels[y, 4 * first : 4 * last]
                next_row = levels[v, 4 * (first + right) : 4 * (last + right)]
                _flag_colours(here, row, next_row, room, np.uint8(contrast))
            for eight in range(len(eights)):
                if eights[eight] == 0:
                    continue
                for x in range(8 * eight, 8 * eight + 8):
                    if flags[x]:
                        step = down, right
                        _mark(marks, flags[x], (y, x), step, words, depth, model, limit, contrast)
    return marks


@kernel
def _draw_mark(words, source, y, x, reach, table):
    """Draw a disc around a mark."""
    height, width = words.shape
    radius = len(reach) // 2
    for row in range(max(0, y - radius), min(height, y + radius + 1)):
        side = reach[row - y + radius]
        for column in range(max(0, x - side), min(width, x + side + 1)):
            red, green, blue = _bytes(source[row, column])
            drawn = _with_bytes(0, table[0, red], table[1, green], np.int64(table[2, blue]))
            words[row, column] = 0xFF000000 | drawn


@entry_point
def draw_lines(words, depth, normal, model, limits, contrast, reach, table):
    """Draw lines along edges of models.

    depth, normal, model: see `Buffers`; normal has the shape [H, 3 W] here. limits: step in depth
        [m] and cosine of a crease, float32 [2]. contrast: between neighbouring colours, 0 for none.
    reach: how far to each side a line goes in each row above and below a marked pixel, int64
        [2 R + 1]. table: what each level of a channel becomes, uint8 [3, 256].
    """
    source = words.copy()
    marks = _edges(source, depth, normal, model, limits[0], limits[1], contrast)
    eights = marks.view(np.uint64)
    for y in range(len(words)):
        for eight in range(eights.shape[1]):
            if eights[y, eight] == 0:
                continue
            for x in range(8 * eight, 8 * eight + 8):
                if marks[y, x]:
                    _draw_mark(words, source, y, x, reach, table)
