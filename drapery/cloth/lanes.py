"""Conversion between states, [B, N, 3], and the lanes that kernels use, [3N, B], in blocks.

The cloths of a block are stepped together while they are in cache. The arithmetic of a lane does
not depend on its block, so neither the block's width nor the number of threads changes a bit.
"""

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np

from drapery.cloth.pins import PinPath, PinTable
from drapery.cloth.simd import lanes_per_register, padded_count
from drapery.cloth.state import State
from drapery.errors import OptionError, shown
from drapery.mesh import Array

BLOCK_BYTES = 1 << 18
"""Bytes of a block's positions and velocities; with the kernels' scratch arrays it fits in L2."""
MAX_TIMES = 2048
"""The most times at which tables of poses are made at once, which bounds their memory."""


def to_lanes(values: Array) -> Array:
    """[B, N, 3] as contiguous [3N, L]; copies of the last cloth fill B up to whole registers.

    An array that `from_lanes` returned is not copied.
    """
    rows, count = 3 * values.shape[1], len(values)
    lanes = padded_count(count, values.dtype)
    held = values.base
    if (
        isinstance(held, np.ndarray)
        and held.shape == (rows, lanes)
        and held.dtype == values.dtype
        and held.flags.c_contiguous
        and from_lanes(held, count).__array_interface__ == values.__array_interface__
    ):
        return held
    return padded(values.transpose(1, 2, 0).reshape(rows, count), lanes)


def from_lanes(lanes: Array, count: int) -> Array:
    """[3N, L] seen as [B, N, 3] for the first B = count lanes."""
    return lanes.reshape(-1, 3, lanes.shape[1]).transpose(2, 0, 1)[:count]


def padded(values: Array, lanes: int) -> Array:
    """The last axis padded to `lanes` by copies of its last part."""
    if not values.size:
        return np.zeros((*values.shape[:-1], 0), values.dtype)
    made = np.empty((*values.shape[:-1], lanes), values.dtype)
    made[..., : values.shape[-1]] = values
    made[..., values.shape[-1] :] = values[..., -1:]
    return made


def block_width(particles: int, values: Array, threads: int) -> int:
    """Cloths in a block, a multiple of a register's width.

    Of the widths that fit in the cache, it is the one with the least work for the busiest thread.
    values: positions, [3N, L].
    """
    register = lanes_per_register(values.dtype)
    maximum = BLOCK_BYTES // (6 * particles * values.itemsize) // register * register
    maximum = min(256, max(register, maximum))

    def busiest(width: int) -> int:
        blocks = -(-int(values.shape[1]) // width)
        return -(-blocks // threads) * width

    return min(range(maximum, maximum // 2, -register), key=busiest)


def run_blocks(work: Callable[[int, int], None], count: int, width: int, threads: int) -> None:
    """Call work(first, last) for blocks that cover `count` lanes, in any order."""
    blocks = -(-count // width)
    threads = min(threads, blocks)
    if threads <= 1:
        work(0, count)
        return
    cuts = [min(count, blocks * part // threads * width) for part in range(threads + 1)]
    jobs = [_pool(threads - 1).submit(work, *cut) for cut in pairwise(cuts[1:])]
    work(cuts[0], cuts[1])
    for job in jobs:
        job.result()


@cache
def _pool(threads: int) -> ThreadPoolExecutor:
    return ThreadPoolExecutor(threads, thread_name_prefix="drapery-cloth")


if hasattr(os, "register_at_fork"):  # a forked child does not have its parent's threads
    os.register_at_fork(after_in_child=_pool.cache_clear)


def thread_count(wanted: int | None) -> int:
    """`wanted`, or as many as this process may use."""
    if wanted is not None:
        return wanted
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def cast(plan: Any, dtype: Any) -> Any:
    """A named tuple of arrays and numbers with its floating-point arrays as `dtype`."""
    with np.errstate(under="ignore"):  # parts too small for the type become 0
        return type(plan)(
            *[
                np.ascontiguousarray(part, dtype)
                if isinstance(part, np.ndarray) and part.dtype.kind == "f"
                else part
                for part in plan
            ]
        )


def pin_targets(path: PinPath | None, state: State, dt: float, steps: int, pinned: int) -> Array:
    """Positions of the P pins after each step, [steps, 3P, B] or [steps, 3P, 1]; [0, ...] for
    pins that do not move. Raises OptionError."""
    dtype = state.positions.dtype
    if path is None:
        return np.zeros((0, 3 * pinned, 1), dtype)
    if isinstance(path, PinTable):
        return _table_targets(path, state.time + np.arange(1, steps + 1) * dt).astype(dtype)
    count = len(state.positions)
    targets = []
    for step in range(steps):
        place = path(state.time + (step + 1) * dt)
        try:
            place = np.asarray(place, dtype)
        except (TypeError, ValueError):
            raise OptionError(f"pin path gave {shown(place)}; give positions [m]") from None
        if place.shape not in ((pinned, 3), (count, pinned, 3)):
            raise OptionError(
                f"pin path gave positions of shape {place.shape}; "
                f"give {(pinned, 3)} or {(count, pinned, 3)}"
            )
        if not np.isfinite(place).all():
            raise OptionError("pin path gave NaN or infinity; give finite positions [m]")
        targets.append(to_lanes(place) if place.ndim == 3 else place.reshape(-1, 1))
    return np.stack(targets)


def _table_targets(table: PinTable, times: Array) -> Array:
    """Positions of the P pins of a table at T times [s], shape [T, 3P, 1]."""
    parts = [table.at(part).reshape(len(part), -1, 1) for part in time_blocks(times)]
    return np.concatenate(parts)


def time_blocks(times: Array) -> list[Array]:
    """Times [s], shape [T], in parts of at most `MAX_TIMES`."""
    return [times[first : first + MAX_TIMES] for first in range(0, len(times), MAX_TIMES)]
