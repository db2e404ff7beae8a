"""A check of colliders for the authors of signed distances."""

import numpy as np

from drapery.cloth.colliders.collider import Collider
from drapery.cloth.colliders.fields import Field
from drapery.cloth.colliders.packing import distance, outward
from drapery.cloth.colliders.vectors import add_scaled, row
from drapery.errors import OptionError
from drapery.jit import entry_point
from drapery.mesh import Array

MARGIN = 0.25
"""How far samples extend beyond the bounds, as a fraction of their size."""
ENDLESS = 2.0
"""Coordinate [m] at which samples end where the bounds are infinite."""
ON_SURFACE = 1e-7
SLACK = 1e-6
"""Tolerance of lengths, absolute [m] and relative."""


def check_collider(collider: Collider, count: int = 2000) -> None:
    """Check that nothing can pass through a collider's shape. These are faults:

    - the signed distance is not finite at some point;
    - no surface is found;
    - a part of the surface lies outside the bounds;
    - at some point outside, the signed distance is more than the distance to the surface, as for
      a function that grows faster than its argument (Lipschitz constant over 1);
    - the path gives a position or rotation that is not finite, or a matrix that is not a rotation.

    collider: the collider to check.
    count: sample points, pseudo-random and the same in every run.

    Raises OptionError with the first fault found.
    """
    name = f"collider {type(collider.shape).__name__}"
    points = _samples(collider.packed, count)
    distances = sample_distances(collider.packed, points)
    bad = ~np.isfinite(distances)
    if bad.any():
        raise OptionError(
            f"{name}: signed_distance at {_point(points[bad][0])} is {distances[bad][0]}; "
            "return a finite number everywhere"
        )
    surface = np.empty_like(points)
    to_surface(collider.packed, points, surface)
    surface = surface[np.abs(sample_distances(collider.packed, surface)) < ON_SURFACE]
    if not len(surface):
        raise OptionError(f"{name}: no surface is found near its bounds; correct the bounds")
    _check_bounds(name, collider.packed, surface)
    _check_lipschitz(name, points, distances, surface)
    _check_path(name, collider)


def _samples(field: Field, count: int) -> Array:
    low, high = np.clip(field.bounds, -ENDLESS, ENDLESS)
    margin = MARGIN * (high - low).max()
    random = np.random.default_rng(0)
    points: Array = random.uniform(low - margin, high + margin, size=(count, 3))
    return points


def _check_bounds(name: str, field: Field, surface: Array) -> None:
    low, high = field.bounds
    outside = ((surface < low - SLACK) | (surface > high + SLACK)).any(axis=1)
    if outside.any():
        raise OptionError(
            f"{name}: its surface passes {_point(surface[outside][0])}, outside its bounds; "
            "make the bounds larger"
        )


def _check_lipschitz(name: str, points: Array, distances: Array, surface: Array) -> None:
    from scipy.spatial import cKDTree

    away = np.asarray(cKDTree(surface).query(points)[0])
    far = distances > away * (1 + SLACK) + SLACK
    if far.any():
        raise OptionError(
            f"{name}: signed_distance at {_point(points[far][0])} is {distances[far][0]:g} m, but "
            f"the surface is {away[far][0]:g} m away; divide it by its steepest slope"
        )


def _check_path(name: str, collider: Collider) -> None:
    for time in (0.0, 0.37, 1.0):
        pose = collider.path(time)
        position, rotation = np.asarray(pose.position), np.asarray(pose.rotation)
        fits = position.shape == (3,) and rotation.shape == (3, 3)
        if not (fits and np.isfinite(position).all() and np.isfinite(rotation).all()):
            raise OptionError(
                f"{name}: its path at {time} s is not a pose; give finite [3] and [3, 3]"
            )
        if not np.allclose(rotation @ rotation.T, np.eye(3), atol=1e-6):
            raise OptionError(
                f"{name}: its path at {time} s has a matrix that is not a rotation; give an "
                "orthonormal right-handed one"
            )


def sample_distances(field: Field, points: Array) -> Array:
    """Signed distances [m] of points [M, 3] in the shape's frame, [M]."""
    distances = np.empty(len(points))
    _sample_distances(field, points, distances)
    return distances


@entry_point
def _sample_distances(field: Field, points: Array, distances: Array) -> None:
    for i in range(len(points)):
        distances[i] = distance(field, row(points, i), np.inf)[0]


@entry_point
def to_surface(field: Field, points: Array, moved: Array) -> None:
    """Points [M, 3] moved to the surface along its directions; some may not reach it."""
    for i in range(len(points)):
        p = row(points, i)
        for _ in range(64):
            d, direction = distance(field, p, np.inf)
            p = add_scaled(p, -d, outward(field, p, direction))
        for axis in range(3):
            moved[i, axis] = p[axis]


def _point(p: Array) -> str:
    return f"({p[0]:g}, {p[1]:g}, {p[2]:g}) m"
