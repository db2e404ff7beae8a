"""Desbrun's second correction (1999, section 3.3): the filter must not turn a free cloth.

Internal forces have no net torque, but filtered forces do. The paper uses dt/m instead of the
inverse of the moment of inertia; that removes part of the torque, and too much of it for hundreds
of particles. The exact correction solves the 3 x 3 inertia for the rotation that removes all of it.
A cloth with pins is not corrected: the torque of its pins is real.
"""

from typing import Literal, NamedTuple

from drapery.cloth.cloth import Cloth
from drapery.mesh import Array

Correction = Literal["exact", "paper", "none"]


class Spin(NamedTuple):
    """mass: [kg], [N]. total: the sum of the masses [kg]. dt: the step [s]."""

    mass: Array
    total: float
    dt: float
    exact: bool


class NoSpin(NamedTuple):
    """No correction."""

    unused: int = 0


def spin_correction(cloth: Cloth, dt: float, correction: Correction) -> Spin | NoSpin:
    """The correction for a cloth without pins; none for one with."""
    if correction == "none" or (cloth.inv_mass == 0).any():
        return NoSpin()
    mass = 1.0 / cloth.inv_mass
    return Spin(mass, float(mass.sum()), dt, correction == "exact")
