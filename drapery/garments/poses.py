"""The poses of a figure's bones, as tables over time."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from drapery.cloth.colliders import TablePath
from drapery.mesh import Array
from drapery.style.figure import Placed

TICKS = 5040
"""Poses that repeat are computed at this number of moments of a time step, which most numbers of
substeps divide."""
KEPT = 4
"""Tables that are kept: boxes, pins and models ask for the same times one after another."""


@dataclass(frozen=True, eq=False)
class BonePoses:
    """Where the bones of a figure are.

    bones: their names.
    table: place [m] and rotation matrix of each bone at T times [s]: from shape [T] to [T, K, 12].
    """

    bones: tuple[str, ...]
    table: Callable[[Array], Array]

    def at(self, times: Array) -> Array:
        """The table at T times [s], shape [T, K, 12]."""
        return self._kept(np.asarray(times, float).tobytes())

    def path(self, bone: str) -> TablePath:
        """The path of a bone."""
        return TablePath(self.at, self.bones.index(bone))

    def repeating(self, step: float, first: int, period: int) -> "BonePoses":
        """The poses that repeat after `period` time steps [s] from step number `first` on."""

        def table(times: Array) -> Array:
            ticks, start = np.rint(times / step * TICKS), first * TICKS
            repeated = start + (ticks - start) % (period * TICKS)
            return self.at(np.where(ticks < start, ticks, repeated) * step / TICKS)

        return BonePoses(self.bones, table)

    def __call__(self, time: float) -> dict[str, Placed]:
        """The pose of each bone at one time [s], by name."""
        rows = self.at(np.array([time]))[0]
        poses = zip(rows[:, :3], rows[:, 3:].reshape(-1, 3, 3), strict=True)
        return dict(zip(self.bones, poses, strict=True))

    @cached_property
    def _kept(self) -> Callable[[bytes], Array]:
        @lru_cache(maxsize=KEPT)
        def found(times: bytes) -> Array:
            table = self.table(np.frombuffer(times))
            table.flags.writeable = False
            return table

        return found
