"""Steps that change the shape of cloth after the simulation, which they do not affect."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from drapery.elementary import arctan2, cos, sin
from drapery.errors import OptionError
from drapery.mesh import Array, Mesh
from drapery.render.vectors import dots
from drapery.style.extrusion import make_shell
from drapery.style.grids import grid_shell
from drapery.style.piece import Piece
from drapery.style.refinement import MAX_SIDE, on_curves
from drapery.style.uv_mapping import UVMapping
from drapery.styles.step import costs

Shape = tuple[Piece, Array]
"""A piece of cloth, and the positions of its vertices [m], shape [N, 3]."""

THINNEST = 0.02
"""Level texels are at least this thick [texels]."""
WITHIN = 0.48
"""The part of a texel that a face of a block shows, to each side of its middle [texels]."""
ON_LINE = 1e-9
"""A vertex so near to the line of a cut is on it, so that no slivers arise."""
CUBE_FRONT = np.array([[-1.0, 1, 1], [1, 1, 1], [-1, -1, 1], [1, -1, 1]])
"""The four front corners of a cube of edge 2."""
BLOCK_FACES = np.array(
    [[0, 1, 2, 3], [5, 4, 7, 6], [4, 0, 6, 2], [1, 5, 3, 7], [4, 5, 0, 1], [2, 3, 6, 7]]
)
"""The corners of the six faces of a block, from its front's four and its back's; see `_blocks`."""


def thickness(
    piece: Piece,
    positions: Array,
    *,
    texels: Annotated[float, Field(ge=0, le=8, description="thickness of the cloth")] = 0.5,
) -> Shape:
    """Make the cloth thicker or thinner; a texel is 1/24 m on a banner."""
    return replace(piece, thickness=texels * piece.texel), positions


@costs(4)
def smooth(
    piece: Piece,
    positions: Array,
    *,
    times: Annotated[int, Field(ge=1, le=8, description="new cells along each cell")] = 4,
) -> Shape:
    """Round the folds: more particles on curves through those that were simulated.

    The curves are Catmull and Rom's ("A class of local interpolating splines", 1974).
    """
    rows, columns = (min((side - 1) * times + 1, max(MAX_SIDE, side)) for side in piece.grid_shape)
    return _resampled(piece, positions, rows, columns, curved=True)


def coarse(
    piece: Piece,
    positions: Array,
    *,
    columns: Annotated[int, Field(ge=2, le=65, description="particles across")] = 3,
    rows: Annotated[int, Field(ge=2, le=65, description="particles down")] = 5,
) -> Shape:
    """Show the cloth with fewer bends: straight pieces between a few of its points."""
    return _resampled(piece, positions, rows, columns, curved=False)


def facets(piece: Piece, positions: Array) -> Shape:
    """Light each triangle by itself, so that all edges are sharp."""
    return replace(piece, facets=True), positions


def boards(
    piece: Piece,
    positions: Array,
    *,
    steps: Annotated[int, Field(ge=1, le=90, description="bend angles in a right angle")] = 4,
) -> Shape:
    """A chain of stiff boards below the top row, at multiples of 90 / steps degrees.

    Each board keeps the distance of its two rows and starts at the end of the one above; the top
    row stays where it is.
    """
    rows = piece.rows(positions)
    middles = rows.mean(axis=-2)
    along = np.diff(middles, axis=-2)
    across = rows[..., :1, -1, :] - rows[..., :1, 0, :]
    side = across / np.linalg.norm(across, axis=-1, keepdims=True)
    front = np.cross(side, [0.0, 1.0, 0.0])
    lengths = np.linalg.norm(along, axis=-1)
    aside, ahead = (np.sum(along * axis, axis=-1) for axis in (side, front))
    lean = _snapped(arctan2(aside, np.hypot(along[..., 1], ahead)), steps)
    bend = _snapped(arctan2(ahead, -along[..., 1]), steps)
    down = np.array([0.0, -1.0, 0.0])
    turned = cos(bend)[..., None] * down + sin(bend)[..., None] * front
    pieces = cos(lean)[..., None] * turned + sin(lean)[..., None] * side
    below = np.cumsum(lengths[..., None] * pieces, axis=-2)
    offsets = np.concatenate([np.zeros_like(below[..., :1, :]), below], axis=-2)
    result = (rows[..., :1, :, :] + offsets[..., None, :]).reshape(positions.shape)
    return piece, result


def voxels(piece: Piece, positions: Array) -> Mesh:
    """Upright cubes, one for each texel, on a lattice of texels; the rows of the sheet run along x.

    A row of texels moves sideways and down as one, so that it has no holes; each texel moves
    forwards and backwards alone. Where a neighbour is over a texel behind, a cube reaches back to
    it. A cube shows its texel of the back on its back, and its texel of the front on its other
    sides.
    """
    texel, corner = piece.texel, positions[0]
    across, down = _texels(piece)
    first = corner + np.array([texel / 2, -texel / 2, 0.0])
    column, row = np.meshgrid(np.arange(across), np.arange(down))
    lattice = first + np.stack([column, -row, 0 * row], axis=-1) * texel
    shift = _middles(piece.rows(positions), (across, down)) - lattice
    shift[..., :2] = shift[..., :2].mean(axis=1, keepdims=True)
    cells = np.round(shift / texel)
    deep = np.minimum(cells[..., 2], _least_beside(cells[..., 2], cells[:, 0, 0]) + 1)
    front = (lattice + cells * texel)[:, :, None] + texel / 2 * CUBE_FRONT
    back = front - np.array([0.0, 0.0, texel]) * (cells[..., 2] - deep + 1)[..., None, None]
    uvs = _texel_uvs((across, down), piece.shell.uv_mapping)
    return _blocks(front.reshape(-1, 4, 3), back.reshape(-1, 4, 3), uvs)


def level_texels(
    piece: Piece,
    positions: Array,
    *,
    step: Annotated[float, Field(ge=0, le=4, description="between levels [texels]; 0: any")] = 0.5,
) -> Mesh:
    """Level texels: each is flat and parallel to the plane in which the sheet lies on average.

    Seen along that plane's normal, the texels stay where the cloth is. Ahead they stand on levels,
    which are `step` texels apart. Each reaches back to the farthest of its four neighbours, so
    that there are walls between levels and no gaps.
    """
    across, down = _texels(piece)
    rows = piece.rows(positions)
    axes = _mean_axes(rows)
    low, high = (np.arange(count + 1) / count for count in (down, across))
    corners = _at(rows, low, high) - rows[0, 0]
    flat = dots(corners[:, :, None], axes[:2])
    height = dots(_middles(rows, (across, down)) - rows[0, 0], axes[2])
    if step:
        height = np.round(height / (step * piece.texel)) * step * piece.texel
    thick = max(piece.thickness, THINNEST * piece.texel)
    framed = np.pad(height, 1, mode="edge")
    lowest = np.minimum.reduce(
        [framed[1:-1, :-2], framed[1:-1, 2:], framed[:-2, 1:-1], framed[2:, 1:-1], height]
    )
    # Each texel's corners: upper left, upper right, lower left, lower right.
    places = np.stack([flat[:-1, :-1], flat[:-1, 1:], flat[1:, :-1], flat[1:, 1:]], axis=2)
    sides = [height + thick / 2, lowest - thick / 2]
    blocks = [
        np.concatenate([places, np.broadcast_to(side[..., None, None], (*places.shape[:3], 1))], -1)
        for side in sides
    ]
    turned = [dots(block[..., None, :], axes.T) + rows[0, 0] for block in blocks]
    front, back = (block.reshape(-1, 4, 3) for block in turned)
    return _blocks(front, back, _texel_uvs((across, down), piece.shell.uv_mapping))


@costs(4)
def swallow_tail(
    piece: Piece,
    positions: Array,
    *,
    depth: Annotated[float, Field(ge=0, le=0.9, description="share of the height cut out")] = 0.3,
) -> Shape:
    """Cut a wedge out of the lower edge, along straight lines of the cloth."""
    return _cut_along(
        piece, positions, lambda aside, down: np.abs(aside) - (down - 1 + depth) / max(depth, 1e-9)
    )


@costs(4)
def rounded_hem(
    piece: Piece,
    positions: Array,
    *,
    depth: Annotated[float, Field(ge=0, le=0.9, description="share of the height it takes")] = 0.3,
) -> Shape:
    """Cut the lower edge so that it is half an ellipse."""

    def inside(aside: Array, down: Array) -> Array:
        below = np.maximum(down - 1 + depth, 0) / max(depth, 1e-9)
        away: Array = 1 - below * below - aside * aside
        return away

    return _cut_along(piece, positions, inside)


@costs(4)
def fringe(
    piece: Piece,
    positions: Array,
    *,
    length: Annotated[int, Field(ge=1, le=20, description="of the threads [texels]")] = 3,
    threads: Annotated[int, Field(ge=1, le=4, description="along two texels")] = 2,
    seed: Annotated[int, Field(ge=0, le=2**31, description="which lengths")] = 0,
) -> Shape:
    """Threads at the lower edge, every other one of them cut out, of uneven lengths."""
    across, down = _texels(piece, threads)
    least, most = -(-length * threads // 2), length * threads
    chance = np.random.default_rng(seed)
    lengths = chance.integers(least, most + 1, across)
    row, column = np.indices((down, across))
    solid, reach = row < down - most, down - most + lengths[column]
    return _cut(piece, positions, solid | ((column % 2 == 0) & (row < reach)))


@costs(4)
def tear(
    piece: Piece,
    positions: Array,
    *,
    depth: Annotated[float, Field(ge=0, le=0.9, description="share of the height torn")] = 0.22,
    holes: Annotated[int, Field(ge=0, le=40, description="number of holes")] = 4,
    seed: Annotated[int, Field(ge=0, le=2**31, description="which tears")] = 0,
) -> Shape:
    """Tear texels out of the lower edge and the sides, and holes into the cloth."""
    across, down = _texels(piece)
    chance = np.random.default_rng(seed)
    kept = np.ones((down, across), np.bool_)
    fringe = chance.random(across)
    ragged = 0.5 * fringe + 0.5 * np.repeat(chance.random(-(-across // 3)), 3)[:across] ** 2
    for column, share in enumerate(ragged):
        kept[down - int(share * depth * down) :, column] = False
    for side in (0, -1):
        bites = chance.random(down) < 0.25 * np.linspace(0, 1, down) * min(1, 4 * depth)
        kept[bites, side] = False
    for _ in range(holes):
        row = int(down * (0.25 + 0.55 * chance.random()))
        column = int(across * (0.1 + 0.8 * chance.random()))
        height, width = 1 + int(4 * chance.random()), 1 + int(2 * chance.random())
        kept[row : row + height, column : column + width] = False
        kept[min(row + height // 2, down - 1), column + width : column + width + 1] = False
    return _cut(piece, positions, _held(kept))


@dataclass(frozen=True)
class CutMapping:
    """A mapping whose new edges, inside the sheet, show the texels beside them. See `UVMapping`."""

    whole: UVMapping

    def front(self, uvs: Array) -> Array:
        return self.whole.front(uvs)

    def back(self, uvs: Array) -> Array:
        return self.whole.back(uvs)

    def rim(self, uvs: Array, edges: NDArray[np.int32]) -> Array:
        start, end = uvs[edges[:, 0]], uvs[edges[:, 1]]
        outer = ((start == end) & ((start == 0) | (start == 1))).any(axis=-1)
        beside = self.whole.front(uvs)[np.tile(edges, 2).reshape(-1)]
        return np.where(np.repeat(outer, 4)[:, None], self.whole.rim(uvs, edges), beside)


def _cut(piece: Piece, positions: Array, kept: NDArray[np.bool_]) -> Shape:
    """The piece without some of its texels. kept: shape [texels down, texels across]."""
    down, across = kept.shape
    fine, places = _resampled(piece, positions, down + 1, across + 1, curved=True)
    return fine.without_cells(kept, CutMapping(piece.shell.uv_mapping)), places


def _cut_along(piece: Piece, positions: Array, inside: Callable[[Array, Array], Array]) -> Shape:
    """The piece without what lies beyond a line.

    inside: how far places are from the line, below 0 beyond it; of their share from the middle to
        a side, -1 to 1, and from the top down, 0 to 1. Between the corners of texels it is linear.
    """
    across, down = _texels(piece)
    # The middle is a column of vertices, where both sides of a wedge meet.
    fine, places = _resampled(piece, positions, down + 1, across + across % 2 + 1, curved=True)
    uvs, sheet = fine.shell.sheet_uvs, fine.shell.sheet
    away = inside(2 * uvs[:, 0] - 1, uvs[:, 1])
    away[np.abs(away) < ON_LINE] = 0.0
    ends = np.sort(sheet[:, [[0, 1], [1, 2], [2, 0]]], axis=-1)
    crossed = away[ends].prod(axis=-1) < 0
    edges, new = np.unique(ends[crossed], axis=0, return_inverse=True)
    number = np.zeros(crossed.shape, np.int64)
    number[crossed] = len(uvs) + new.reshape(-1)
    triangles = []
    for corners, on_edges, cut in zip(sheet.tolist(), number.tolist(), crossed, strict=True):
        outline = []
        for corner, on_edge, crosses in zip(corners, on_edges, cut, strict=True):
            outline += [corner] if away[corner] >= 0 else []
            outline += [on_edge] if crosses else []
        triangles += [[outline[0], *outline[k : k + 2]] for k in range(1, len(outline) - 1)]
    first, last = edges.T
    share = (away[first] / (away[first] - away[last]))[:, None]
    uvs, places = (
        np.concatenate(
            [given, (1 - share) * given[..., first, :] + share * given[..., last, :]], -2
        )
        for given in (uvs, places)
    )
    mapping = CutMapping(piece.shell.uv_mapping)
    shell = make_shell(np.array(triangles, np.int32), uvs, mapping)
    return replace(fine, shell=shell), places


def _held(kept: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """The texels that hang together with the top edge by their sides."""
    from scipy.ndimage import label

    pieces, _ = label(kept)
    held: NDArray[np.bool_] = kept & np.isin(pieces, np.unique(pieces[0][kept[0]]))
    return held


def _resampled(piece: Piece, positions: Array, rows: int, columns: int, *, curved: bool) -> Shape:
    """The piece at evenly spaced points of its grid, on straight lines or on curves."""
    if curved:
        positions = on_curves(positions, piece.grid_shape, (rows, columns))
    else:
        points = _on_lines(_on_lines(piece.rows(positions), rows, -3), columns, -2)
        positions = points.reshape(*points.shape[:-3], rows * columns, 3)
    return replace(piece, shell=grid_shell(rows, columns, piece.shell.uv_mapping)), positions


def _on_lines(points: Array, count: int, axis: int) -> Array:
    """`count` evenly spaced points along one axis of a grid, on straight lines."""
    given = points.shape[axis]
    at = np.arange(count) * (given - 1) / (count - 1)
    low = np.minimum(at.astype(int), given - 2)
    shape = [1] * points.ndim
    shape[axis] = count
    t = (at - low).reshape(shape)
    straight: Array = (1 - t) * points.take(low, axis) + t * points.take(low + 1, axis)
    return straight


def _mean_axes(rows: Array) -> Array:
    """Unit vectors to the right of a grid [R, C, 3], down and ahead, on average, shape [3, 3]."""
    right, down = (rows[:, -1] - rows[:, 0]).mean(axis=0), (rows[-1] - rows[0]).mean(axis=0)
    right /= max(float(np.sqrt((right * right).sum())), 1e-12)
    down = down - (down * right).sum() * right
    down /= max(float(np.sqrt((down * down).sum())), 1e-12)
    return np.stack([right, down, np.cross(down, right)])


def _blocks(front: Array, back: Array, uvs: Array) -> Mesh:
    """Blocks with four corners in front and four behind, each row by row, shape [M, 4, 3].

    uvs: of the corners of each block's front, back, left, right, top and bottom, shape [M, 24, 2].
    """
    corners = np.concatenate([front, back], axis=1)[:, BLOCK_FACES]
    one, two = corners[:, :, 1] - corners[:, :, 0], corners[:, :, 2] - corners[:, :, 0]
    normals = np.cross(two, one)
    normals /= np.maximum(np.sqrt((normals * normals).sum(axis=-1, keepdims=True)), 1e-18)
    squares = 4 * np.arange(6 * len(front), dtype=np.int32)
    triangles = squares[:, None, None] + np.array([[0, 2, 1], [1, 2, 3]], np.int32)
    return Mesh(
        corners.reshape(-1, 3),
        normals.reshape(-1, 3).repeat(4, axis=0),
        triangles.reshape(-1, 3),
        uvs.reshape(-1, 2),
    )


def _least_beside(depths: Array, shifts: Array) -> Array:
    """The least depth of the four neighbours of each texel, shape [R, C].

    shifts: how many texels each row has moved to the right, shape [R].
    """
    rows, columns = depths.shape
    row, column = np.indices(depths.shape)
    least = depths.copy()
    for up, right in ((0, -1), (0, 1), (-1, 0), (1, 0)):
        other = np.clip(row + up, 0, rows - 1)
        place = column + right + (shifts[row] - shifts[other]).astype(int)
        beside = depths[other, np.clip(place, 0, columns - 1)]
        least = np.where((place >= 0) & (place < columns), np.minimum(least, beside), least)
    return least


def _texels(piece: Piece, parts: int = 1) -> tuple[int, int]:
    """How many texels the piece has across and down, or parts of texels. Raises OptionError."""
    across, down = (parts * max(1, round(side / piece.texel)) for side in piece.size)
    if max(across, down) >= MAX_SIDE:
        raise OptionError(
            f"cloth of {across // parts} x {down // parts} texels is too large for a step that"
            f" divides it into {across} x {down} parts; at most {MAX_SIDE - 1} a side are made"
        )
    return across, down


def _snapped(angles: Array, steps: int) -> Array:
    quantum = np.pi / 2 / steps
    snapped: Array = np.round(angles / quantum) * quantum
    return snapped


def _middles(rows: Array, size: tuple[int, int]) -> Array:
    """The middles of the texels of a grid [R, C, 3], shape [size[1], size[0], 3]."""
    down, across = ((np.arange(count) + 0.5) / count for count in (size[1], size[0]))
    return _at(rows, down, across)


def _at(rows: Array, down: Array, across: Array) -> Array:
    """A grid [R, C, 3] at shares 0..1 of its height and width, on straight lines."""
    for axis, share in ((0, down), (1, across)):
        at = share * (rows.shape[axis] - 1)
        low = np.minimum(at.astype(int), rows.shape[axis] - 2)
        part = (at - low).reshape(-1, 1, 1) if axis == 0 else (at - low).reshape(1, -1, 1)
        rows = (1 - part) * rows.take(low, axis) + part * rows.take(low + 1, axis)
    return rows


def _texel_uvs(size: tuple[int, int], uv_mapping: UVMapping) -> Array:
    """The 24 texture coordinates of each cube, shape [M, 24, 2]: one texel a face, but its rim."""
    column, row = np.meshgrid(np.arange(size[0]) + 0.5, np.arange(size[1]) + 0.5)
    middles = np.stack([column, row], axis=-1).reshape(-1, 1, 2)
    corners = (middles + WITHIN * np.array([[-1, -1], [1, -1], [-1, 1], [1, 1]])) / np.array(size)
    front = uv_mapping.front(corners.reshape(-1, 2)).reshape(-1, 4, 2)
    back = uv_mapping.back(corners[:, [1, 0, 3, 2]].reshape(-1, 2)).reshape(-1, 4, 2)
    # The faces of a box: front, back, left, right, top, bottom, four corners each.
    return np.concatenate([front, back, front, front, front, front], axis=1)
