"""Garments of one wearer at rest: the outer ones begin outside the inner ones.

Garments are cut without regard to each other, so a coat may begin within a skirt. Where a cloth
lies farther in than one below it, its particles begin farther from the upright axis of the wearer,
and it is cut as wide as it must be there.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Triangles
from drapery.cloth import Cloth
from drapery.garments.assembly import SewnCloth
from drapery.mesh import Array

ROUNDS = 16
"""The most rounds in which particles are moved outwards."""
CLEAR = 1.1
"""The distance at which cloths begin, over their thickness."""
SAMPLES = (
    np.array(
        [
            *([3, 0, 0], [0, 3, 0], [0, 0, 3], [2, 1, 0], [1, 2, 0]),
            *([0, 2, 1], [0, 1, 2], [2, 0, 1], [1, 0, 2], [1, 1, 1]),
        ]
    )
    / 3
)
"""Where on each triangle two cloths are compared, as shares of its corners."""
BESIDE = 2.0
"""Cloth also begins behind a plate up to this distance beside it [texels]."""
EDGE = 1e-6
"""A ray meets a triangle up to this part beside it."""
MAX_PAIRS = 1 << 19
"""Rays and triangles that are compared at one time."""


def put_outside(cloths: Sequence[SewnCloth]) -> tuple[SewnCloth, ...]:
    """The cloths of a wearer, each moved outwards where one of a lower `order` is in its way."""
    placed: list[SewnCloth] = []
    for cloth in cloths:
        on_body = [each for each in placed if each.is_on_body and cloth.is_on_body]
        below = [each for each in on_body if each.order < cloth.order]
        placed.append(_outside(cloth, below) if below else cloth)
    return tuple(placed)


def _outside(cloth: SewnCloth, below: Sequence[SewnCloth]) -> SewnCloth:
    inner = np.concatenate([each.start for each in below])
    firsts = np.cumsum([0, *(len(each.start) for each in below)])
    triangles = np.concatenate(
        [each.cloth.triangles + first for each, first in zip(below, firsts, strict=False)]
    )
    gap = CLEAR * (cloth.thickness + max(each.thickness for each in below)) / 2
    start, own = cloth.start.copy(), cloth.cloth.triangles
    fixed, faces = sampled(inner, triangles), np.repeat(own, len(SAMPLES), axis=0)
    for _ in range(ROUNDS):
        push, samples = np.zeros(len(start)), sampled(start, own)
        met, _ = outermost(samples, inner, triangles)
        lacking = np.where(met > 0, np.maximum(met + gap - _radius(samples), 0), 0)
        np.maximum.at(push, faces, lacking[:, None])
        met, face = outermost(fixed, start, own)
        lacking = np.where(met > 0, np.maximum(_radius(fixed) + gap - met, 0), 0)
        np.maximum.at(push, own[face], lacking[:, None])
        if push.max(initial=0.0) < (CLEAR - 1) / 2 * gap:
            break
        start += push[:, None] * _outwards(start)
    return replace(cloth, start=start, cloth=_widened(cloth.cloth, cloth.start, start))


def put_behind(cloths: Sequence[SewnCloth], low: Array, high: Array) -> tuple[SewnCloth, ...]:
    """Cloths that begin on the wearer's side of an upright plate, such as a shield.

    The outermost is next to the plate; each inner one stays as far inside it as `put_outside` asks.
    low, high: corners of the plate [m], each [3]; it is flat along one axis.
    """
    placed, room, above = list(cloths), np.inf, 0.0
    for order in sorted({each.order for each in cloths}, reverse=True):
        same = [number for number, each in enumerate(cloths) if each.order == order]
        limits, thick = [], 0.0
        for number in same:
            cloth = cloths[number]
            limit = room - CLEAR * (above + cloth.thickness) / 2 if cloth.is_on_body else np.inf
            placed[number], kept = _behind(cloth, low, high, limit)
            if placed[number] is not cloth and cloth.is_on_body:
                limits.append(kept)
                thick = max(thick, cloth.thickness)
        if limits:
            room, above = min(limits), thick
    return tuple(placed)


def _behind(cloth: SewnCloth, low: Array, high: Array, limit: float) -> tuple[SewnCloth, float]:
    """A cloth up to a limit along the axis of a plate [m], and clear of it; and that limit."""
    axis = int(np.argmin(high - low))
    side = 1.0 if low[axis] + high[axis] > 0 else -1.0
    face = min(side * float(low[axis]), side * float(high[axis]))
    limit = min(limit, face - CLEAR * cloth.distance / 2)
    around = BESIDE * cloth.pieces[0].texel
    start, faces = cloth.start.copy(), cloth.cloth.triangles
    places = start[faces]
    # A face that reaches behind the plate is moved with all of its corners.
    near = (places.max(axis=1) > low - around) & (places.min(axis=1) < high + around)
    near[:, axis] = (side * places[:, :, axis]).max(axis=1) > limit
    moved = np.zeros(len(start), bool)
    moved[faces[near.all(axis=1)]] = True
    moved &= side * start[:, axis] > limit
    if not moved.any():
        return cloth, limit
    start[moved, axis] = side * limit
    return replace(cloth, start=start), limit


def _widened(cloth: Cloth, old: Array, new: Array) -> Cloth:
    """A cloth whose springs are as much longer as their ends begin farther apart."""
    before, after = (_lengths(places[cloth.spring_pairs]) for places in (old, new))
    length = cloth.spring_length + np.maximum(after - before, 0)
    return replace(cloth, spring_length=length, rest_positions=cloth.rest_positions + new - old)


def _lengths(ends: Array) -> Array:
    """The distance between both ends [S, 2, 3]."""
    lengths: Array = np.sqrt(((ends[:, 0] - ends[:, 1]) ** 2).sum(axis=1))
    return lengths


def outermost(
    points: Array, positions: Array, triangles: Triangles
) -> tuple[Array, NDArray[np.intp]]:
    """Where a level ray from the y axis through each point [N, 3] leaves the last triangle [T, 3].

    Returns the distance from the axis [m], [N], 0 where it meets none, and the triangle, [N].
    By Möller and Trumbore, "Fast, minimum storage ray/triangle intersection", 1997.
    """
    corner, first, second = (positions[triangles[:, end]] for end in range(3))
    one, two = first - corner, second - corner
    distances, faces = np.zeros(len(points)), np.zeros(len(points), np.intp)
    step = max(1, MAX_PAIRS // max(1, len(triangles)))
    for begin in range(0, len(points), step):
        part = slice(begin, begin + step)
        along = _outwards(points[part])[:, None]
        start = points[part, None] * np.array([0.0, 1.0, 0.0]) - corner
        across = np.cross(along, two)
        volume = (across * one).sum(axis=-1)
        inverse = 1 / np.where(np.abs(volume) < 1e-15, np.inf, volume)
        u = (start * across).sum(axis=-1) * inverse
        turned = np.cross(start, one)
        v = (along * turned).sum(axis=-1) * inverse
        distance = (turned * two).sum(axis=-1) * inverse
        inside = (u >= -EDGE) & (v >= -EDGE) & (u + v <= 1 + EDGE) & (inverse != 0)
        distance = np.where(inside & (distance > 0), distance, 0)
        faces[part] = distance.argmax(axis=1)
        distances[part] = distance.max(axis=1)
    return distances, faces


def sampled(positions: Array, triangles: Triangles) -> Array:
    """Places on all triangles [m], shape [T * S, 3]."""
    places: Array = (SAMPLES[:, :, None] * positions[triangles][:, None]).sum(axis=2).reshape(-1, 3)
    return places


def _radius(points: Array) -> Array:
    """Distance from the y axis [m], shape [N]."""
    radius: Array = np.sqrt(points[:, 0] ** 2 + points[:, 2] ** 2)
    return radius


def _outwards(points: Array) -> Array:
    """The level direction away from the y axis, shape [N, 3]; to the front for points on it."""
    radius = _radius(points)
    far = np.where(radius > 1e-9, radius, np.inf)[:, None]
    level: Array = points * np.array([1.0, 0.0, 1.0]) / far
    level[radius <= 1e-9] = 0.0, 0.0, 1.0
    return level
