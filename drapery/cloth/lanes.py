"""Between states, [B, N, 3], and what the kernels run over: lanes [3N, B], in blocks.

A block's cloths are stepped together while they are in cache. Each lane does the same arithmetic
whatever its block, so neither the block's width nor the number of threads changes a bit.
"""

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np

from drapery.cloth.checks import shown
from drapery.cloth.pins import PinPath
from drapery.cloth.simd import lanes_of, whole
from drapery.cloth.state import State
from drapery.errors import OptionError
from drapery.mesh import Array

BLOCK_BYTES = 1 << 18
"""Positions and velocities of a block; with the kernels' own arrays a block stays in L2."""


def to_lanes(values: Array) -> Array:
    """[B, N, 3] as contiguous [3N, L], with B filled up to whole registers by copies of the last.

    No copy of what `from_lanes` returned.
    """
    rows, count = 3 * values.shape[1], len(values)
    lanes = whole(count, values.dtype)
    held = values.base
    if (
        isinstance(held, np.ndarray)
        and held.shape == (rows, lanes)
        and held.dtype == values.dtype
        and held.flags.c_contiguous
        and from_lanes(held, count).__array_interface__ == values.__array_interface__
    ):
        return held
    return filled(values.transpose(1, 2, 0).reshape(rows, count), lanes)


def from_lanes(lanes: Array, count: int) -> Array:
    """[3N, L] seen as [B, N, 3] for the first B = count lanes."""
    return lanes.reshape(-1, 3, lanes.shape[1]).transpose(2, 0, 1)[:count]


def filled(values: Array, lanes: int) -> Array:
    """The last axis filled up by copies of its last part."""
    more = [(0, 0)] * (values.ndim - 1) + [(0, lanes - values.shape[-1])]
    if not values.size:
        return np.zeros((*values.shape[:-1], 0), values.dtype)
    return np.ascontiguousarray(np.pad(values, more, mode="edge"))


def block_width(particles: int, values: Array, threads: int) -> int:
    """Cloths to a block, whole registers: of the widths that stay in cache, the one that leaves
    the busiest thread the least. values: their positions, [3N, L]."""
    register = lanes_of(values.dtype)
    most = BLOCK_BYTES // (6 * particles * values.itemsize) // register * register
    most = min(256, max(register, most))

    def busiest(width: int) -> int:
        blocks = -(-int(values.shape[1]) // width)
        return -(-blocks // threads) * width

    return min(range(most, most // 2, -register), key=busiest)


def run_blocks(work: Callable[[int, int], None], count: int, width: int, threads: int) -> None:
    """Call work(first, last) over blocks of `count` lanes; the order does not matter."""
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


if hasattr(os, "register_at_fork"):  # a forked child has none of its parent's threads
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
    with np.errstate(under="ignore"):  # so small a part is none
        return type(plan)(
            *[
                np.ascontiguousarray(part, dtype)
                if isinstance(part, np.ndarray) and part.dtype.kind == "f"
                else part
                for part in plan
            ]
        )


def pin_targets(path: PinPath | None, state: State, dt: float, steps: int, pinned: int) -> Array:
    """Where the P pins are after each step, [steps, 3P, B] or [steps, 3P, 1]; [0, ...]
    if they stay. Raises OptionError."""
    dtype = state.positions.dtype
    if path is None:
        return np.zeros((0, 3 * pinned, 1), dtype)
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
