"""Builders of cloths: grids and strips."""

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Vectors
from drapery.cloth.bending import grid_bending, strip_bending
from drapery.cloth.checks import check_count, check_number
from drapery.cloth.cloth import FLEXION, SHEAR, STRUCTURAL, Cloth
from drapery.cloth.fabric import Fabric
from drapery.cloth.pins import Pins, pinned_particles
from drapery.errors import OptionError, shown
from drapery.mesh import Array, grid_surface

MAX_PARTICLES = 1_000_000
MIN_SIZE, MAX_SIZE = 1e-6, 1e6
"""Bounds of a cloth's width, height, length and radius [m]."""
DEFAULT = Fabric()


def grid(
    columns: int,
    rows: int,
    width: float,
    height: float,
    *,
    pins: Pins = "top",
    fabric: Fabric = DEFAULT,
) -> Cloth:
    """A rectangular cloth. Its top edge is at y = 0 and it faces +z.

    Particles are numbered row by row from the top left.

    columns: particles across, 2 or more.
    rows: particles down, 2 or more.
    width: [m], up to 1e6.
    height: [m], up to 1e6.
    pins: see `pinned_particles`.
    fabric: the material; its mass is shared evenly by the particles.

    Raises OptionError for numbers out of range.
    """
    check_fabric(fabric)
    for name, count in (("columns", columns), ("rows", rows)):
        check_count(f"grid {name}", count, 2, MAX_PARTICLES)
    check_particles("grid", columns * rows)
    for name, size in (("width", width), ("height", height)):
        check_size(f"grid {name}", size)
    triangles, uvs = grid_surface(rows, columns)
    rest = np.zeros((rows * columns, 3))
    rest[:, 0] = (uvs[:, 0] - 0.5) * width
    rest[:, 1] = -uvs[:, 1] * height
    particle_mass = fabric.density * width * height / len(rest)
    inv_mass = np.full(len(rest), 1.0 / particle_mass)
    inv_mass[pinned_particles(pins, rest, (rows, columns))] = 0.0
    pairs, kinds = _grid_springs(rows, columns)
    return Cloth(
        rest_positions=rest,
        inv_mass=inv_mass,
        spring_pairs=pairs,
        spring_length=np.linalg.norm(rest[pairs[:, 1]] - rest[pairs[:, 0]], axis=1),
        spring_stiffness=np.array(fabric.stiffness)[kinds],
        spring_kind=kinds,
        triangles=triangles,
        uvs=uvs,
        grid_shape=(rows, columns),
        drag=fabric.drag,
        bending=grid_bending(rows, columns, (width, height), fabric.bending, fabric.damping),
    )


def strip(
    count: int,
    length: float,
    *,
    width: float = 1.0,
    pins: Pins = (0,),
    fabric: Fabric = DEFAULT,
) -> Cloth:
    """A line of particles along +x from the origin: a ribbon, a rope, a chain.

    It has no faces, so wind does not move it.

    count: particles, 2 or more.
    length: [m], up to 1e6.
    width: of the ribbon [m]; it changes only the mass.
    pins: see `pinned_particles`.
    fabric: the material.

    Raises OptionError for numbers out of range.
    """
    check_fabric(fabric)
    check_count("strip count", count, 2, MAX_PARTICLES)
    for name, size in (("length", length), ("width", width)):
        check_size(f"strip {name}", size)
    along = np.linspace(0, 1, count)
    rest = np.zeros((count, 3))
    rest[:, 0] = along * length
    inv_mass = np.full(count, count / (fabric.density * width * length))
    inv_mass[pinned_particles(pins, rest, None)] = 0.0
    index = np.arange(count, dtype=np.int32)
    near = np.stack([index[:-1], index[1:]], axis=1)
    far = np.stack([index[:-2], index[2:]], axis=1)
    pairs = np.concatenate([near, far])
    kinds = np.repeat(np.array([STRUCTURAL, FLEXION], np.uint8), [len(near), len(far)])
    return Cloth(
        rest_positions=rest,
        inv_mass=inv_mass,
        spring_pairs=pairs,
        spring_length=np.linalg.norm(rest[pairs[:, 1]] - rest[pairs[:, 0]], axis=1),
        spring_stiffness=np.array(fabric.stiffness)[kinds],
        spring_kind=kinds,
        triangles=np.zeros((0, 3), np.int32),
        uvs=np.stack([along, np.full(count, 0.5)], axis=1),
        drag=fabric.drag,
        bending=strip_bending(count, length, width, fabric.bending, fabric.damping),
    )


def check_particles(name: str, count: int) -> None:
    """Raises OptionError for more than `MAX_PARTICLES` particles."""
    if count > MAX_PARTICLES:
        raise OptionError(f"{name} has {count} particles; use at most {MAX_PARTICLES}")


def check_size(name: str, value: float) -> None:
    """Raises OptionError unless value is a length from 1e-6 m to 1e6 m."""
    check_number(name, value, MIN_SIZE, MAX_SIZE, "m")


def check_fabric(fabric: Fabric) -> None:
    """Raises OptionError unless fabric is a Fabric."""
    if not isinstance(fabric, Fabric):
        raise OptionError(f"fabric {shown(fabric)} is not a Fabric; use Fabric(density=0.3)")


def _grid_springs(rows: int, columns: int) -> tuple[NDArray[np.int32], NDArray[np.uint8]]:
    """Pairs and kinds of a grid's springs: Provot 1995, section 2."""
    index = np.arange(rows * columns, dtype=np.int32).reshape(rows, columns)
    groups = [
        (STRUCTURAL, index[:, :-1], index[:, 1:]),
        (STRUCTURAL, index[:-1], index[1:]),
        (SHEAR, index[:-1, :-1], index[1:, 1:]),
        (SHEAR, index[:-1, 1:], index[1:, :-1]),
        (FLEXION, index[:, :-2], index[:, 2:]),
        (FLEXION, index[:-2], index[2:]),
    ]
    pairs = np.concatenate([np.stack([a.ravel(), b.ravel()], axis=1) for _, a, b in groups])
    kinds = np.concatenate([np.full(a.size, kind, np.uint8) for kind, a, _ in groups])
    return pairs, kinds


def spring_lengths(positions: Array, cloth: Cloth) -> Array:
    """Current lengths of the springs [m], shape [..., S], at positions [..., N, 3]."""
    a, b = cloth.spring_pairs.T
    lengths: Array = np.linalg.norm(positions[..., b, :] - positions[..., a, :], axis=-1)
    return lengths


def max_stretch(positions: Vectors, cloth: Cloth) -> float:
    """The largest relative elongation of a structural spring; 0.05 is five per cent.

    positions: [m], shape [..., N, 3].
    cloth: whose springs these are.
    """
    structural = cloth.spring_kind == STRUCTURAL
    ratios = spring_lengths(positions, cloth)[..., structural] / cloth.spring_length[structural]
    return float(ratios.max() - 1.0)
