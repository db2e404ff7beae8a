"""Kernels that numba chooses by the types of their arguments, when it compiles a caller."""

from typing import Any

from numba.extending import overload

from drapery.cloth import kernels
from drapery.cloth.filters import BandFilter
from drapery.cloth.spin import NoSpin


def filter_velocities(both: Any, filter: Any, pins: Any) -> None:
    """both[1] = W both[0], pins at 0; both [2, 3N, L], of which both[0] is overwritten.

    filter: a `filters.Filter` or a `filters.BandFilter`.
    """


def restore_angular_momentum(g: Any, x: Any, v: Any, spin: Any, work: Any) -> None:
    """Subtract from g the angular momentum that the filter added to v; see `spin.Spin`."""


@overload(filter_velocities, inline="always")
def _filter_velocities(both: Any, filter: Any, pins: Any) -> Any:
    by_band = filter.instance_class is BandFilter
    chosen = kernels.filter_by_band if by_band else kernels.filter_by_products

    def implementation(both: Any, filter: Any, pins: Any) -> None:
        chosen(both, filter, pins)

    return implementation


@overload(restore_angular_momentum, inline="always")
def _restore_angular_momentum(g: Any, x: Any, v: Any, spin: Any, work: Any) -> Any:
    by_nothing = spin.instance_class is NoSpin
    chosen = kernels.no_correction if by_nothing else kernels.subtract_spin

    def implementation(g: Any, x: Any, v: Any, spin: Any, work: Any) -> None:
        chosen(g, x, v, spin, work)

    return implementation
