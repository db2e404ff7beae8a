"""Bending: a quadratic energy of small stencils, in physical units.

A stencil is three or four particles with weights w, and its energy is ½ k (|Σ w x| - rest)². Where
the cloth is flat at rest, this is a quadratic form whose Hessian is constant, so every solver can
carry it. The stiffness k [N/m] comes from the bending rigidity B [N m] of the fabric and the size
of the stencil, so the shape of a cloth does not depend on its grid.

On a grid the curvature along rows and columns is a second difference of three particles, and the
twist is a difference across a cell: ½ B ∫ |x_uu|² + |x_vv|² + 2 |x_uv|² (a plate whose Poisson's
ratio is 0). On triangles a stencil is a hinge of two faces: Bergou, Wardetzky, Harmon, Zorin,
Grinspun, "A quadratic bending model for inextensible surfaces" (SGP 2006), scaled so that a sheet
of equilateral triangles bent to a cylinder of curvature κ has the energy ½ B κ² per area. The
damping follows Kelvin and Voigt: the moment is B (κ + τ dκ/dt).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Floats, Integers, Triangles
from drapery.cloth.checks import check_number
from drapery.errors import OptionError
from drapery.mesh import Array

MAX_RIGIDITY = 1e6
"""The greatest bending rigidity [N m]."""
MAX_DAMPING = 1e3
"""The greatest damping time [s]."""
CURVATURE = (1.0, -2.0, 1.0, 0.0)
TWIST = (1.0, -1.0, -1.0, 1.0)
FLAT = 1e-6
"""A rest value of |Σ w x| below this fraction of Σ |w| · size counts as 0."""


@dataclass(frozen=True, eq=False)
class Bending:
    """The stencils of a cloth that resist bending; energy ½ k (|Σ w x| - rest)².

    particles: of each stencil, shape [K, 4], int32; a stencil of three repeats one.
    weights: w, shape [K, 4]; their sum is 0, and 0 for a repeated particle.
    stiffness: k [N/m], shape [K].
    rest: |Σ w x| at rest [m], shape [K]; 0 where the cloth is flat.
    damping: the time of Kelvin-Voigt damping [s], 0 to 1000.
    Raises OptionError for arrays of wrong shape and values out of range.
    """

    particles: Integers
    weights: Floats
    stiffness: Floats
    rest: Floats
    damping: float = 0.0

    def __post_init__(self) -> None:
        count = len(self.stiffness)
        shapes = {"particles": (count, 4), "weights": (count, 4), "stiffness": (count,)}
        for name, shape in {**shapes, "rest": (count,)}.items():
            values = getattr(self, name)
            if values.shape != shape or not np.isfinite(values).all():
                raise OptionError(f"bending {name} must be finite numbers of shape {shape}")
        if (self.stiffness < 0).any():
            raise OptionError("bending stiffness must be 0 or more [N/m]")
        check_number("bending damping", self.damping, 0, MAX_DAMPING, "s")


class Stencils(NamedTuple):
    """Stencils as kernels read them.

    particles, weights: [K, 4]. parts: the part of a correction that each particle takes, [K, 4].
    rest: [m], [K].
    """

    particles: NDArray[np.int32]
    weights: Array
    parts: Array
    rest: Array


NO_BENDING = Bending(np.zeros((0, 4), np.int32), np.zeros((0, 4)), np.zeros(0), np.zeros(0))


def grid_bending(
    rows: int, columns: int, size: tuple[float, float], rigidity: float, damping: float
) -> Bending:
    """The bending of a flat grid of width and height `size` [m]; rigidity: B [N m].

    The area is shared evenly by the particles, as their mass is.
    """
    if rigidity == 0:
        return NO_BENDING
    index = np.arange(rows * columns, dtype=np.int32).reshape(rows, columns)
    width, height = size
    across, down = width / (columns - 1), height / (rows - 1)
    shares = width / columns, height / rows
    groups = [
        (CURVATURE, rigidity * shares[1] / across**3, _in_line(index)),
        (CURVATURE, rigidity * shares[0] / down**3, _in_line(index.T)),
        (TWIST, 2 * rigidity / (across * down), _cells(index)),
    ]
    return _of_groups(groups, damping)


def grid_rigidity(bending: Bending, shape: tuple[int, int], size: tuple[float, float]) -> float:
    """The bending rigidity [N m] from which `grid_bending` makes these stencils."""
    rows, columns = shape
    twist = bending.stiffness[bending.weights[:, 3] != 0]
    cell = size[0] / (columns - 1) * size[1] / (rows - 1)
    return float(twist.mean()) * cell / 2 if twist.size else 0.0


def strip_bending(
    count: int, length: float, width: float, rigidity: float, damping: float
) -> Bending:
    """The bending of a line of particles that stands for a ribbon of a width [m]."""
    if rigidity == 0:
        return NO_BENDING
    index = np.arange(count, dtype=np.int32)[None]
    stiffness = rigidity * width / (length / (count - 1)) ** 3
    return _of_groups([(CURVATURE, stiffness, _in_line(index))], damping)


def triangle_bending(rest: Array, triangles: Triangles, rigidity: float, damping: float) -> Bending:
    """The bending of any triangles in their rest shape [N, 3]; each inner edge is a hinge."""
    if rigidity == 0:
        return NO_BENDING
    hinges = hinges_of(triangles)
    a, b, c, d = (rest[hinges[:, corner]] for corner in range(4))
    at_a = _cotangent(b - a, c - a), _cotangent(b - a, d - a)
    at_b = _cotangent(a - b, c - b), _cotangent(a - b, d - b)
    weights = np.stack([sum(at_b), sum(at_a), -at_a[0] - at_b[0], -at_a[1] - at_b[1]], axis=1)
    area = (_doubled_area(b - a, c - a) + _doubled_area(b - a, d - a)) / 2
    vectors = (weights[:, :, None] * rest[hinges]).sum(axis=1)
    lengths = np.sqrt((vectors * vectors).sum(axis=1))
    flat = lengths <= FLAT * np.abs(weights).sum(axis=1) * np.sqrt(area)
    return Bending(hinges, weights, rigidity / area, np.where(flat, 0.0, lengths), damping)


def hinges_of(triangles: NDArray[np.integer]) -> NDArray[np.int32]:
    """Inner edges and the particles opposite them: a, b, and one of each face, [K, 4]."""
    corners = np.concatenate([np.roll(triangles, -turn, axis=1) for turn in range(3)])
    ends = np.sort(corners[:, :2], axis=1)
    order = np.lexsort((ends[:, 1], ends[:, 0]))
    ends, opposite = ends[order], corners[order, 2]
    inner = (ends[1:] == ends[:-1]).all(axis=1) & (opposite[1:] != opposite[:-1])
    found = np.stack([*ends[:-1][inner].T, opposite[:-1][inner], opposite[1:][inner]], axis=1)
    return found.astype(np.int32)


def bending_parts(bending: Bending, inv_mass: Array) -> Array:
    """k w / m of each particle of each stencil [1/s²], [K, 4]: its acceleration for Σ w x = 1 m."""
    parts: Array = bending.stiffness[:, None] * bending.weights * inv_mass[bending.particles]
    return parts


def force_stencils(bending: Bending, inv_mass: Array) -> Stencils:
    """Stencils for solvers that add accelerations."""
    parts = bending_parts(bending, inv_mass)
    return Stencils(bending.particles, bending.weights, parts, bending.rest)


class BendingStep(NamedTuple):
    """How solvers that move particles apply bending: v += time · acceleration by bending.

    time: [s], [1]. damping: of bending [s], [1].
    """

    time: Array
    damping: Array


def bending_step(bending: Bending, inv_mass: Array, time: float) -> BendingStep:
    """Bending applied once in every time [s].

    Both numbers are limited to what is stable: stencils that would swing faster are softer.
    """
    fastest = max(fastest_bending(bending, inv_mass), 1e-30)
    time = min(time, 1 / (fastest * time))
    damping = min(bending.damping, 0.5 / (time * fastest))
    return BendingStep(np.array([time]), np.array([damping]))


def fastest_bending(bending: Bending, inv_mass: Array) -> float:
    """A bound of the square of the fastest bending oscillation [1/s²], by Gershgorin's circles."""
    rates = np.zeros(len(inv_mass))
    total = np.abs(bending.weights).sum(axis=1, keepdims=True)
    np.add.at(rates, bending.particles, total * np.abs(bending_parts(bending, inv_mass)))
    return float(rates.max(initial=0.0))


def _in_line(index: NDArray[np.int32]) -> NDArray[np.int32]:
    """Three neighbours along each row, [K, 4]."""
    a, b, c = index[:, :-2].ravel(), index[:, 1:-1].ravel(), index[:, 2:].ravel()
    return np.stack([a, b, c, c], axis=1)


def _cells(index: NDArray[np.int32]) -> NDArray[np.int32]:
    corners = index[:-1, :-1], index[:-1, 1:], index[1:, :-1], index[1:, 1:]
    return np.stack([corner.ravel() for corner in corners], axis=1)


def _of_groups(
    groups: Sequence[tuple[tuple[float, ...], float, NDArray[np.int32]]], damping: float
) -> Bending:
    counts = [len(particles) for _, _, particles in groups]
    return Bending(
        np.concatenate([particles for _, _, particles in groups]),
        np.repeat([weights for weights, _, _ in groups], counts, axis=0),
        np.repeat([stiffness for _, stiffness, _ in groups], counts),
        np.zeros(sum(counts)),
        damping,
    )


def _doubled_area(u: Array, v: Array) -> Array:
    area: Array = np.linalg.norm(np.cross(u, v), axis=1)
    return area


def _cotangent(u: Array, v: Array) -> Array:
    cotangent: Array = (u * v).sum(axis=1) / np.maximum(_doubled_area(u, v), 1e-30)
    return cotangent
