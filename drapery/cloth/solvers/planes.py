"""What the explicit solvers share for one fine grid, which is a plane of lanes.

The plan, the loop over substeps and the kick are those of `driver` with the particles as lanes, see
`drapery.cloth.sheets`.
"""

from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import numpy as np

from drapery.cloth import sheet_kernels, simd
from drapery.cloth.attachments import Attachments
from drapery.cloth.cloth import Cloth
from drapery.cloth.contact import lanes_contact
from drapery.cloth.faces import wind_faces
from drapery.cloth.sheets import (
    ConstraintBatch,
    ConstraintBatches,
    Pairs,
    SheetBending,
    SheetLayout,
    constraint_batches,
    sheet_bending,
    sheet_of,
    spring_batches,
)
from drapery.cloth.simd import lane_count, load, store
from drapery.cloth.wind import Gusts
from drapery.jit import borrowing_kernel, kernel
from drapery.mesh import Array


class PlanePlan(NamedTuple):
    """What an explicit solver needs of a fine grid.

    sheet: its layout, without planes of anchors. springs: with their parts of a kick. attachments:
    the pairs that have a longest length.
    """

    sheet: SheetLayout
    springs: ConstraintBatches
    bending: SheetBending
    attachments: ConstraintBatches


class PlaneBlock(NamedTuple):
    """One cloth that is stepped, as a plane of lanes, and what a method needs of its batch.

    y, u: positions [m] and velocities [m/s], [3, lanes]. g, old: scratch like these. work: see
    `sheet_kernels.move_both`. scratch: see `sheet_kernels.wind_scratch`. mean: 0 in each direction,
    [3]. gusts: on this cloth. cloth: its number. others: see `Batch`.
    """

    y: Array
    u: Array
    g: Array
    old: Array
    work: Array
    scratch: tuple[Array, ...]
    mean: Array
    gusts: Gusts
    cloth: int
    numbers: Array
    targets: Array
    push: Array


def plane_plan(
    cloth: Cloth,
    time: float,
    attachments: Attachments,
    batches: Callable[[SheetLayout, Pairs], Iterator[ConstraintBatch]],
) -> PlanePlan:
    """The plan of a fine grid. time: of a kick [s]. batches: makes those of the attachments."""
    sheet = sheet_of(cloth, *wind_faces(cloth))._replace(anchors=np.zeros(0, np.int64))
    return PlanePlan(
        sheet,
        spring_batches(sheet, cloth, time),
        sheet_bending(sheet, cloth.bending),
        constraint_batches(list(batches(sheet, Pairs(*attachments)))),
    )


def loop_around_plane(substep: Callable[..., None]) -> Callable[..., None]:
    """The kernel that makes steps of cloths first..last, one after another, as
    `driver.loop_around` does for blocks. substep: see there; its block is a `PlaneBlock`."""

    @kernel
    def advance(
        first: Any, last: Any, plan: Any, batch: Any, steps: Any, substeps: Any, options: Any
    ) -> None:
        sheet, h = plan.sheet, batch.x.dtype.type(batch.numbers[0])
        for cloth in range(first, last):
            block = load_plane(batch, sheet, cloth)
            y, u = block.y, block.u
            before = lanes_contact.begin_plane(y, u, batch, sheet)
            number, again = 0, False
            while number < steps * substeps:
                if number % substeps == 0:
                    time = batch.numbers[2] + number * batch.numbers[0]
                    sheet_kernels.blow(y, sheet, block.gusts, time, block.scratch)
                substep(block, plan, h, number, options)
                number, again = lanes_contact.meet_plane_substep(
                    y, u, before, batch, cloth, number, substeps, h, sheet, again
                )
            sheet_kernels.store_plane(batch.new_x, y, cloth, sheet)
            sheet_kernels.store_plane(batch.new_v, u, cloth, sheet)

    return advance


@kernel
def load_plane(batch: Any, sheet: Any, cloth: Any) -> Any:
    """One cloth of a batch."""
    y, u = simd.empty_lanes(3, sheet.plane, batch.x), simd.empty_lanes(3, sheet.plane, batch.x)
    g, old = simd.empty_lanes(3, sheet.plane, batch.x), simd.empty_lanes(3, sheet.plane, batch.x)
    work = simd.empty_lanes(3, 2 * sheet.plane, batch.x)
    scratch = sheet_kernels.wind_scratch(sheet, batch.gusts, batch.x.dtype)
    gusts = sheet_kernels.own_gusts(batch.gusts, cloth, sheet.controls.size)
    sheet_kernels.load_plane(y, batch.x, cloth, sheet)
    sheet_kernels.load_plane(u, batch.v, cloth, sheet)
    given = np.zeros(3, batch.x.dtype), gusts, cloth, batch.numbers, batch.targets, batch.push
    return PlaneBlock(y, u, g, old, work, scratch, *given)


@borrowing_kernel
def kick(block: Any, plan: Any, h: Any) -> None:
    """g = u + h · acceleration by springs and loads, 0 for pins."""
    y, u, g, sheet = block.y, block.u, block.g, plan.sheet
    for axis in range(3):
        for lane in range(0, sheet.size, lane_count(g)):
            store(g, axis, lane, load(u, axis, lane))
    sheet_kernels.add_spring_velocities(g, y, plan.springs, block.work)
    none, damping = g.dtype.type(0), plan.bending.damping[0]
    sheet_kernels.bend(g, y, u, plan.bending, sheet, h, none, damping, block.work)
    sheet_kernels.add_winds(g, y, u, sheet, block.gusts, h, block.scratch)
    sheet_kernels.add_push(g, sheet, block.push, h, block.cloth)
    sheet_kernels.fall(g, block.mean, sheet, block.numbers, h)
