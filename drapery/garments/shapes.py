"""The shapes of pieces: particles at rest, springs, edges with names, and what is drawn of them."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Triangles
from drapery.cloth import Cloth, disc, from_triangles, grid, rotation_about
from drapery.cloth.gathering import fold_count, gathered_state
from drapery.elementary import power, sine_of_turns
from drapery.errors import OptionError
from drapery.garments.model import (
    MAX_PARTICLES,
    AnyPiece,
    DiscPiece,
    Garment,
    GarmentPiece,
    GridPiece,
    PolygonPiece,
    RingPiece,
    StripPiece,
)
from drapery.mesh import Array

Particles = NDArray[np.intp]

FLAT = 0.5
"""Particles inside a polygon stay this part of its spacing from its sides."""


@dataclass(frozen=True, eq=False)
class CutPiece:
    """A piece of cloth before it is sewn.

    cloth: at rest in its place, without pins. start: where its particles begin [m], shape [N, 3];
    slack cloth begins with its springs shorter than at rest.
    edges: their particles in order, by name.
    spots: of each particle, as pins name it, shape [N, 2]. scale: of the axes of `spots` [texels].
    drawn: the particle of each drawn vertex, shape [V]; a closed ring has those at its cut twice.
    triangles: of the drawn vertices. uvs: of them, 0..1 from the upper left, shape [V, 2].
    size: width and height as drawn [texels].
    """

    piece: GarmentPiece
    cloth: Cloth
    start: Array
    edges: dict[str, Particles]
    spots: Array
    drawn: Particles
    triangles: Triangles
    uvs: Array
    size: tuple[float, float]
    scale: tuple[float, float] = (1.0, 1.0)

    def nearest(self, spot: tuple[float, float]) -> int:
        """The particle nearest to a place that a pin names."""
        away = self.spots - np.array(spot)
        if isinstance(self.piece, RingPiece):
            away[:, 0] = (away[:, 0] + 180) % 360 - 180
        away = away * np.array(self.scale)
        return int(np.argmin((away * away).sum(axis=1)))


def cut_pieces(garment: Garment) -> list[CutPiece]:
    """All pieces of a garment, each followed by its mirrored one. Raises OptionError."""
    cut = []
    for piece in garment.piece:
        cut.append(_cut(piece, garment))
        if piece.mirror is not None:
            other = _cut(_mirrored(piece, piece.mirror), garment)
            texture = piece.texture or garment.texture
            across = -1 if texture.source != "design" else 1  # letters stay readable
            uvs = (other.uvs - 0.5) * [across, 1] + 0.5
            cut.append(replace(other, uvs=uvs))
    return cut


def _cut(piece: AnyPiece, garment: Garment) -> CutPiece:
    try:
        made = cast(Callable[[Any, Garment], CutPiece], CUTTERS[type(piece)])(piece, garment)
    except OptionError as error:
        raise OptionError(f"garment {garment.name}: piece {piece.name}: {error}") from None
    rotation: Array = np.eye(3)
    for axis, degrees in zip(((1, 0, 0), (0, 1, 0), (0, 0, 1)), piece.turn, strict=True):
        if degrees:
            rotation = _product(rotation_about(axis, degrees), rotation)
    place = np.array(piece.place) * garment.texel
    rest, start = (
        np.einsum("ij,nj->ni", rotation, points) + place
        for points in (made.cloth.rest_positions, made.start)
    )
    return replace(made, cloth=replace(made.cloth, rest_positions=rest), start=start)


def _product(a: Array, b: Array) -> Array:
    # einsum adds in a fixed order; BLAS may not.
    product: Array = np.einsum("ij,jk->ik", a, b)
    return product


def _mirrored(piece: AnyPiece, name: str) -> AnyPiece:
    """The piece mirrored at x = 0, its columns from the same side of its own frame as before."""
    x, y, z = piece.place
    about_x, about_y, about_z = piece.turn
    same: dict[str, Any] = {
        "name": name,
        "mirror": None,
        "place": (-x, y, z),
        "turn": (about_x, -about_y, -about_z),
    }
    if isinstance(piece, PolygonPiece):
        same["corners"] = tuple((-x, y) for x, y in reversed(piece.corners))
    if isinstance(piece, StripPiece):
        same["ends"] = tuple((-x, y, z) for x, y, z in piece.ends)
    return piece.model_copy(update=same)


def _grid(piece: GridPiece, garment: Garment) -> CutPiece:
    columns, rows = piece.points
    width, height = piece.size
    texel = garment.texel
    full = width * (1 + piece.fullness) if fold_count(columns) else width
    flat = grid(columns, rows, full * texel, height * texel, pins="none", fabric=garment.fabric)
    across, down = flat.uvs.T
    hem = width if piece.hem is None else piece.hem
    wide = width + (hem - width) * down
    spots = np.stack([(across - 0.5) * wide, -height * down], axis=1)
    cloth = flat
    if piece.hem is not None:
        rest = np.column_stack([spots, np.zeros(len(spots))]) * texel
        triangles = lattice_triangles(rows - 1, columns)
        cloth = from_triangles(rest, triangles, uvs=flat.uvs, fabric=garment.fabric)
    index = np.arange(rows * columns).reshape(rows, columns)
    edges = {"top": index[0], "bottom": index[-1], "left": index[:, 0], "right": index[:, -1]}
    for row, side in (("top", 0), ("bottom", -1)):
        for column, end in (("left", 0), ("right", -1)):
            edges[f"{row}-{column}"] = index[[side], [end]]
    edges["corners"] = index[[0, 0, -1, -1], [0, -1, 0, -1]]
    size = max(width, hem), height
    made = _whole(piece, cloth, edges, spots, size)
    start = cloth.rest_positions
    if full > width:
        start = gathered_state(cloth, width * texel).positions[0]
    return replace(made, start=start * piece.slack)


def _whole(
    piece: GarmentPiece,
    cloth: Cloth,
    edges: dict[str, Particles],
    spots: Array,
    size: tuple[float, float],
) -> CutPiece:
    """A piece of which every particle is drawn once."""
    drawn = np.arange(len(spots))
    rest = cloth.rest_positions
    return CutPiece(piece, cloth, rest, edges, spots, drawn, cloth.triangles, cloth.uvs, size)


def _strip(piece: StripPiece, garment: Garment) -> CutPiece:
    """Two particles across. It begins as a straight line that is shorter than its springs."""
    texel, count = garment.texel, piece.points
    size = piece.width, piece.length
    flat = grid(2, count, size[0] * texel, size[1] * texel, pins="none", fabric=garment.fabric)
    start, end = (np.array(place) * texel for place in piece.ends)
    along = end - start
    distance = float(np.sqrt((along * along).sum()))
    along = along / distance
    # Its width lies level; the width of an upright strip, along x.
    aside = np.array([along[2], 0.0, -along[0]])
    length = float(np.sqrt((aside * aside).sum()))
    aside = aside / length if length > 1e-9 else np.array([1.0, 0.0, 0.0])
    across, down = flat.rest_positions[:, 0], -flat.rest_positions[:, 1]
    rest, begun = (
        start + aside * across[:, None] + along * way[:, None]
        for way in (down, flat.uvs[:, 1] * distance)
    )
    index = np.arange(2 * count).reshape(count, 2)
    spots = np.stack([across / texel, -flat.uvs[:, 1] * piece.length], axis=1)
    edges = {"start": index[0], "end": index[-1]}
    made = _whole(piece, replace(flat, rest_positions=rest), edges, spots, size)
    return replace(made, start=begun)


def _ring(piece: RingPiece, garment: Garment) -> CutPiece:
    columns, rows = piece.points[0], piece.points[1] - 1
    closed = piece.open == 0
    count = columns if closed else columns + 1
    share = np.arange(count) / columns
    turns = share if closed else (piece.open + (720 - 2 * piece.open) * share) / 720
    sine, cosine = sine_of_turns(turns), sine_of_turns(turns + 0.25)
    n = piece.square
    # |x|^n + |z|^n = 1, along the direction of each particle.
    away = power(power(np.abs(sine), n) + power(np.abs(cosine), n), -1 / n)
    high, wide, deep = _profile(piece, rows)
    height = np.broadcast_to(high, (rows + 1, count))
    places = np.stack([wide * away * sine, height, deep * away * cosine], axis=-1)
    rest = places.reshape(-1, 3) * garment.texel
    opened = lattice_triangles(rows, columns + 1)
    index = np.arange((rows + 1) * count).reshape(rows + 1, count)
    drawn = (np.concatenate([index, index[:, :1]], axis=1) if closed else index).reshape(-1)
    cloth = from_triangles(rest, drawn[opened], fabric=garment.fabric)
    edges = {"top": index[0], "bottom": index[-1]}
    if not closed:
        edges |= {"left": index[:, 0], "right": index[:, -1]}
    degrees = (turns * 360 + 180) % 360 - 180
    spots = np.stack([np.broadcast_to(degrees, height.shape), height], axis=-1).reshape(-1, 2)
    across, down = np.meshgrid(np.linspace(0, 1, columns + 1), np.linspace(0, 1, rows + 1))
    uvs = np.stack([across, down], axis=-1).reshape(-1, 2)
    size = _ring_size(places, closed)
    radius = float((wide + deep).mean() / 2)
    scale = radius * np.pi / 180, 1.0
    start = cloth.rest_positions
    return CutPiece(piece, cloth, start, edges, spots, drawn, opened, uvs, size, scale)


def _profile(piece: RingPiece, rows: int) -> tuple[Array, Array, Array]:
    """Height, half width and half depth of each row [texels], each [rows + 1, 1].

    The rows divide the length of the profile evenly.
    """
    given = np.array(piece.profile, float)
    step = np.diff(given, axis=0)
    lengths = np.sqrt((step * step).sum(axis=1))
    if not (lengths > 0).all():
        raise OptionError("profile has the same ring twice in a row; leave one out")
    ends = np.concatenate([[0.0], np.cumsum(lengths)]) / lengths.sum()
    part = np.arange(rows + 1) / rows
    span = np.clip(np.searchsorted(ends, part, side="right") - 1, 0, len(lengths) - 1)
    within = (part - ends[span]) / (ends[span + 1] - ends[span])
    if len(lengths) == 1:
        within = part
    values = given[span] + step[span] * within[:, None]
    return values[:, :1], values[:, 1:2], values[:, 2:]


def _ring_size(places: Array, closed: bool) -> tuple[float, float]:
    """The longest way around and the mean way down [texels]."""
    rows = np.concatenate([places, places[:, :1]], axis=1) if closed else places
    around = np.sqrt((np.diff(rows, axis=1) ** 2).sum(axis=-1)).sum(axis=1).max()
    down = np.sqrt((np.diff(places, axis=0) ** 2).sum(axis=-1)).sum(axis=0).mean()
    return float(around), float(down)


def _disc(piece: DiscPiece, garment: Garment) -> CutPiece:
    cloth = disc(piece.rings, piece.radius * garment.texel, fabric=garment.fabric)
    first = 1 + 3 * piece.rings * (piece.rings - 1)
    edges = {"middle": np.array([0]), "rim": np.arange(first, len(cloth.inv_mass))}
    spots = cloth.rest_positions[:, [0, 2]] / garment.texel
    size = 2 * piece.radius, 2 * piece.radius
    return _whole(piece, cloth, edges, spots, size)


def _polygon(piece: PolygonPiece, garment: Garment) -> CutPiece:
    corners = np.array(piece.corners)
    if _crosses_itself(corners):
        raise OptionError("its sides cross; move its corners")
    extent = np.ptp(corners, axis=0)
    least = max(float(np.sqrt(extent.prod())), float(extent.max()) / 8) / MAX_PARTICLES
    if piece.spacing < least:
        raise OptionError(
            f"its spacing {piece.spacing:g} is too fine for its size;"
            f" use at least {np.ceil(1000 * least) / 1000:g}"
        )
    outline, sides = _outline(corners, piece.spacing)
    points = np.concatenate([outline, _inner_points(corners, piece.spacing)])
    triangles = _triangulated(points, corners)
    low = corners.min(axis=0)
    uvs = np.stack([points[:, 0] - low[0], low[1] + extent[1] - points[:, 1]], axis=1) / extent
    rest = np.column_stack([points, np.zeros(len(points))]) * garment.texel
    cloth = from_triangles(rest, triangles, uvs=uvs, fabric=garment.fabric)
    edges = {f"side-{number + 1}": side for number, side in enumerate(sides)}
    edges["rim"] = np.arange(len(outline))
    x, y = points.T
    slack = 1e-6 * piece.spacing
    for name, near, order in (
        ("top", y >= y.max() - slack, x),
        ("bottom", y <= y.min() + slack, x),
        ("left", x <= x.min() + slack, -y),
        ("right", x >= x.max() - slack, -y),
    ):
        found = np.flatnonzero(near)
        edges[name] = found[np.argsort(order[found], kind="stable")]
    return _whole(piece, cloth, edges, points, (float(extent[0]), float(extent[1])))


def _crosses_itself(corners: Array) -> bool:
    """Whether two sides of a polygon cross, not counting the corners that they share."""
    ends = np.roll(corners, -1, axis=0)

    def side_of(points: Array) -> Array:
        """On which side of each side [K] each point is, [K, K]: -1, 0 or 1."""
        along, away = (ends - corners)[:, None], points - corners[:, None]
        cross = along[..., 0] * away[..., 1] - along[..., 1] * away[..., 0]
        return np.where(np.abs(cross) < 1e-9, 0.0, np.sign(cross))

    apart = side_of(corners) * side_of(ends) < 0
    return bool((apart & apart.T).any())


def _outline(corners: Array, spacing: float) -> tuple[Array, list[Particles]]:
    """Points along the sides, and the points of each side with both of its corners."""
    points: list[Array] = []
    starts = []
    for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        length = float(np.sqrt(((b - a) ** 2).sum()))
        if length == 0:
            raise OptionError("corners has the same place twice in a row; leave one out")
        parts = max(1, round(length / spacing))
        starts.append(len(points))
        points += [a + (b - a) * (part / parts) for part in range(parts)]
    ends = [*starts[1:], len(points)]
    sides = [np.arange(a, b + 1) % len(points) for a, b in zip(starts, ends, strict=True)]
    return np.array(points), sides


def _inner_points(corners: Array, spacing: float) -> Array:
    """Points of a lattice of equal triangles, away from the sides."""
    low, high = corners.min(axis=0), corners.max(axis=0)
    step = spacing * np.sqrt(0.75)
    rows = np.arange(1, int(np.ceil((high[1] - low[1]) / step)))
    columns = np.arange(0, int(np.ceil((high[0] - low[0]) / spacing)) + 1)
    shift = 0.5 * (rows % 2)[:, None]
    x = low[0] + spacing * (columns[None] + shift)
    y = np.broadcast_to((high[1] - step * rows)[:, None], x.shape)
    points = np.stack([x, y], axis=-1).reshape(-1, 2)
    far = _distance_to_sides(points, corners) > FLAT * spacing
    inner: Array = points[far & _inside(points, corners)]
    return inner


def _distance_to_sides(points: Array, corners: Array) -> Array:
    least = np.full(len(points), np.inf)
    for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        along = b - a
        part = np.clip(((points - a) * along).sum(axis=1) / (along * along).sum(), 0, 1)
        away = points - (a + part[:, None] * along)
        least = np.minimum(least, np.sqrt((away * away).sum(axis=1)))
    return least


def _inside(points: Array, corners: Array) -> NDArray[np.bool_]:
    """Whether points are inside a polygon: whether a ray to the right crosses an odd number of
    its sides."""
    inside = np.zeros(len(points), bool)
    x, y = points.T
    for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        spans = (a[1] > y) != (b[1] > y)
        rise = b[1] - a[1] or 1.0
        inside ^= spans & (x < a[0] + (y - a[1]) * (b[0] - a[0]) / rise)
    return inside


def _triangulated(points: Array, corners: Array) -> Triangles:
    """Delaunay triangles of points inside a polygon, counter-clockwise. Raises OptionError."""
    from scipy.spatial import Delaunay

    found = Delaunay(points).simplices
    a, b, c = (points[found[:, corner]] for corner in range(3))
    doubled = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]
    turned = np.where((doubled > 0)[:, None], found, found[:, ::-1])
    thin = np.abs(doubled) <= 1e-9 * np.ptp(points) ** 2
    kept = turned[_inside((a + b + c) / 3, corners) & ~thin]
    next_corners = np.roll(corners, -1, axis=0)
    area = corners[:, 0] * next_corners[:, 1] - corners[:, 1] * next_corners[:, 0]
    covered = np.abs(doubled[_inside((a + b + c) / 3, corners) & ~thin]).sum()
    if not np.isclose(covered, area.sum(), rtol=1e-6):
        raise OptionError("its spacing is too wide for its narrow parts; use a smaller one")
    first = np.argmin(kept, axis=1)
    ordered = np.stack([kept[np.arange(len(kept)), (first + k) % 3] for k in range(3)], axis=1)
    triangles: Triangles = ordered[np.lexsort(ordered.T[::-1])].astype(np.int32)
    return triangles


def lattice_triangles(rows: int, columns: int) -> Triangles:
    """Two triangles in each of `rows` x (columns - 1) cells; the diagonal alternates."""
    index = np.arange((rows + 1) * columns, dtype=np.int32).reshape(rows + 1, columns)
    a, b, c, d = index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]
    one = np.stack([np.stack([a, b, c], -1), np.stack([a, c, d], -1)], axis=2)
    two = np.stack([np.stack([a, b, d], -1), np.stack([b, c, d], -1)], axis=2)
    even = (np.add.outer(np.arange(rows), np.arange(columns - 1)) % 2 == 0)[..., None, None]
    return np.where(even, one, two).reshape(-1, 3)


CUTTERS: dict[type[GarmentPiece], Callable[..., CutPiece]] = {
    GridPiece: _grid,
    StripPiece: _strip,
    RingPiece: _ring,
    DiscPiece: _disc,
    PolygonPiece: _polygon,
}
"""The function that cuts each shape."""
