"""Other cloth simulations on the same workloads, one file each; all define `start(load)`."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

Positions = NDArray[np.floating]


@dataclass(frozen=True)
class Load:
    """Cloths that hang from their top row under gravity.

    cloths: how many; columns, rows: particles of each; width, height: [m]; dt: one step [s].
    effort: iterations or substeps, depending on the system; 0 is its default.
    mass: of a particle [kg]. stiffness: of structural, shear and flexion springs [N/m], if a
    system has such springs.
    """

    cloths: int
    columns: int
    rows: int
    effort: int
    width: float = 0.8333
    height: float = 1.6667
    dt: float = 1 / 60
    mass: float = 4.8e-4
    stiffness: tuple[float, float, float] = (5.0, 1.0, 0.2)

    @property
    def particles(self) -> int:
        return self.cloths * self.columns * self.rows

    def rest(self) -> Positions:
        """Rest positions of one cloth, shape [rows, columns, 3]; the top row at y = 0."""
        u, v = np.meshgrid(np.linspace(0, 1, self.columns), np.linspace(0, 1, self.rows))
        return np.stack([u * self.width, -v * self.height, 0 * u], axis=-1)


class Runner(Protocol):
    """A started simulation."""

    def step(self, count: int) -> None:
        """Advance by `count` steps."""

    def positions(self) -> Positions:
        """Positions [m], shape [cloths, rows, columns, 3]."""


def stretch(load: Load, positions: Positions) -> float:
    """The largest relative elongation of an edge of the grid."""
    rest = (load.width / (load.columns - 1), load.height / (load.rows - 1))
    lengths = (np.linalg.norm(np.diff(positions, axis=axis), axis=-1) for axis in (2, 1))
    return max(float((d / r).max()) for d, r in zip(lengths, rest, strict=True)) - 1
