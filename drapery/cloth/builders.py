"""Builders of cloths: sizes in metres, masses by surface density, stiffness by kind of spring."""

import numpy as np
from numpy.typing import NDArray

from drapery.cloth.cloth import FLEXION, SHEAR, STRUCTURAL, Cloth
from drapery.cloth.pins import Pins, pinned_particles
from drapery.errors import OptionError
from drapery.mesh import Array

DENSITY = 0.3
"""Surface density of a light woollen cloth [kg/m²]."""
STIFFNESS = (5.0, 1.0, 0.2)
"""Structural, shear and flexion stiffness [N/m].

In the ratio 50 : 10 : 2 for particles of 1 kg, of a Minecraft mod that inspired this project; on
its 5 x 9 flag of this density they are about ten times stiffer for their mass.
"""
MAX_PARTICLES = 1_000_000


def grid(
    columns: int,
    rows: int,
    width: float,
    height: float,
    *,
    pins: Pins = "top",
    density: float = DENSITY,
    stiffness: tuple[float, float, float] = STIFFNESS,
) -> Cloth:
    """A rectangle of cloth, hanging from y = 0 and facing +z.

    columns, rows: particles across and down; particles are numbered row by row from the top left.
    width, height: [m]. pins: see `pinned_particles`. density: [kg/m²], shared evenly by the
    particles. stiffness: of structural, shear and flexion springs [N/m].
    Raises OptionError.
    """
    for name, count in (("columns", columns), ("rows", rows)):
        if count < 2:
            raise OptionError(f"grid {name} {count} is too few; use at least 2")
    check_particles("grid", columns * rows)
    for name, size in (("width", width), ("height", height), ("density", density)):
        check_positive(f"grid {name}", size)
    across, down = np.meshgrid(np.linspace(0, 1, columns), np.linspace(0, 1, rows))
    uvs = np.stack([across, down], axis=-1).reshape(-1, 2)
    rest = np.zeros((rows * columns, 3))
    rest[:, 0] = (uvs[:, 0] - 0.5) * width
    rest[:, 1] = -uvs[:, 1] * height
    particle_mass = density * width * height / len(rest)
    inv_mass = np.full(len(rest), 1.0 / particle_mass)
    inv_mass[pinned_particles(pins, rest, (rows, columns))] = 0.0
    pairs, kinds = _grid_springs(rows, columns)
    return Cloth(
        rest_positions=rest,
        inv_mass=inv_mass,
        spring_pairs=pairs,
        spring_length=np.linalg.norm(rest[pairs[:, 1]] - rest[pairs[:, 0]], axis=1),
        spring_stiffness=kind_stiffness(stiffness)[kinds],
        spring_kind=kinds,
        triangles=_grid_triangles(rows, columns),
        uvs=uvs,
        grid_shape=(rows, columns),
    )


def strip(
    count: int,
    length: float,
    *,
    pins: Pins = (0,),
    density: float = DENSITY,
    stiffness: tuple[float, float, float] = STIFFNESS,
) -> Cloth:
    """A line of particles along +x from the origin: a ribbon, a rope, a chain. It has no faces, so
    no wind.

    count: particles; length: [m]; density: [kg/m]; otherwise as `grid`. Raises OptionError.
    """
    if count < 2:
        raise OptionError(f"strip count {count} is too few; use at least 2 particles")
    check_particles("strip", count)
    for name, size in (("length", length), ("density", density)):
        check_positive(f"strip {name}", size)
    along = np.linspace(0, 1, count)
    rest = np.zeros((count, 3))
    rest[:, 0] = along * length
    inv_mass = np.full(count, count / (density * length))
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
        spring_stiffness=kind_stiffness(stiffness)[kinds],
        spring_kind=kinds,
        triangles=np.zeros((0, 3), np.int32),
        uvs=np.stack([along, np.full(count, 0.5)], axis=1),
    )


def check_particles(name: str, count: int) -> None:
    """Raises OptionError for more particles than anyone can want."""
    if count > MAX_PARTICLES:
        raise OptionError(f"{name} has {count} particles; use at most {MAX_PARTICLES}")


def check_positive(name: str, value: float) -> None:
    """Raises OptionError unless value is a finite number over 0."""
    if not (np.isfinite(value) and value > 0):
        raise OptionError(f"{name} {value!r} is out of range; use a number over 0")


def kind_stiffness(stiffness: tuple[float, float, float]) -> Array:
    """Structural, shear and flexion stiffness [N/m] as an array. Raises OptionError."""
    values = np.asarray(stiffness, float)
    if values.shape != (3,):
        raise OptionError(f"stiffness {stiffness!r} must be three numbers [N/m], one for each kind")
    return values


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


def _grid_triangles(rows: int, columns: int) -> NDArray[np.int32]:
    """Two triangles a cell, counter-clockwise seen from +z."""
    index = np.arange(rows * columns, dtype=np.int32).reshape(rows, columns)
    a, b, c, d = index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]
    lower = np.stack([a, b, c], axis=-1).reshape(-1, 3)
    upper = np.stack([a, c, d], axis=-1).reshape(-1, 3)
    return np.stack([lower, upper], axis=1).reshape(-1, 3)


def spring_lengths(positions: Array, cloth: Cloth) -> Array:
    """Present lengths of the springs [m], shape [..., S], of positions [..., N, 3]."""
    a, b = cloth.spring_pairs.T
    lengths: Array = np.linalg.norm(positions[..., b, :] - positions[..., a, :], axis=-1)
    return lengths


def max_stretch(positions: Array, cloth: Cloth) -> float:
    """The largest relative elongation of a structural spring; 0.05 is five per cent."""
    structural = cloth.spring_kind == STRUCTURAL
    ratios = spring_lengths(positions, cloth)[..., structural] / cloth.spring_length[structural]
    return float(ratios.max() - 1.0)
