"""The inner loops over one grid whose lanes are its columns; see `sheets`.

As in `kernels`, but every row of a grid is a few registers long, so a row's work is cut into loops
that touch few rows each: with more the compiler cannot tell them apart and leaves them scalar.
"""

from typing import Any

import numpy as np

from drapery.cloth import kernels
from drapery.cloth.compiled import kernel
from drapery.cloth.kernels import STILL, TINY
from drapery.cloth.wind import Gusts

SPRING, LIMIT, SOLVE = 0, 1, 2
"""Forms of `pull`: a force, a longest length, XPBD's constraint."""


@kernel
def load(y: Any, x: Any, cloth: Any, columns: Any) -> None:
    """One cloth of lanes x [3N, B] into rows y [3R, W]."""
    for row in range(y.shape[0]):
        for lane in range(y.shape[1]):
            y[row, lane] = 0
    for particle in range(x.shape[0] // 3):
        row, lane = 3 * (particle // columns), particle % columns
        for axis in range(3):
            y[row + axis, lane] = x[3 * particle + axis, cloth]


@kernel
def store(x: Any, y: Any, cloth: Any, columns: Any) -> None:
    """Rows y [3R, W] into one cloth of lanes x [3N, B]."""
    for particle in range(x.shape[0] // 3):
        row, lane = 3 * (particle // columns), particle % columns
        for axis in range(3):
            x[3 * particle + axis, cloth] = y[row + axis, lane]


@kernel
def pull(to: Any, x: Any, rows: Any, begin: Any, end: Any, form: Any, work: Any) -> None:
    """Entries begin..end: to_i += part_i e (x_j - x_i), to_j -= part_j e (x_j - x_i).

    e is the strain by the form. to may be x. work: [3 or more, W].
    """
    tiny = x.dtype.type(TINY)
    for entry in range(begin, end):
        i, j, lanes = 3 * rows.i[entry], 3 * rows.j[entry], rows.lanes[entry]
        # Unsigned, or every index is first asked whether it counts from the end.
        shift = np.uintp(rows.shift[entry])
        length = rows.length[rows.lengths[entry]]
        part_i, part_j = rows.part[rows.parts_i[entry]], rows.part[rows.parts_j[entry]]
        if form == SOLVE:
            for lane in range(lanes):
                dx = x[j, np.uintp(lane) + shift] - x[i, lane]
                dy = x[j + 1, np.uintp(lane) + shift] - x[i + 1, lane]
                dz = x[j + 2, np.uintp(lane) + shift] - x[i + 2, lane]
                square, rest = dx * dx + dy * dy + dz * dz, length[lane] * length[lane]
                strain = (square - rest) / (square + rest)
                work[0, lane], work[1, lane], work[2, lane] = strain * dx, strain * dy, strain * dz
        elif form == LIMIT:
            for lane in range(lanes):
                dx = x[j, np.uintp(lane) + shift] - x[i, lane]
                dy = x[j + 1, np.uintp(lane) + shift] - x[i + 1, lane]
                dz = x[j + 2, np.uintp(lane) + shift] - x[i + 2, lane]
                d = max(np.sqrt(dx * dx + dy * dy + dz * dz), length[lane])
                strain = (d - length[lane]) / d
                work[0, lane], work[1, lane], work[2, lane] = strain * dx, strain * dy, strain * dz
        else:
            for lane in range(lanes):
                dx = x[j, np.uintp(lane) + shift] - x[i, lane]
                dy = x[j + 1, np.uintp(lane) + shift] - x[i + 1, lane]
                dz = x[j + 2, np.uintp(lane) + shift] - x[i + 2, lane]
                d = np.sqrt(dx * dx + dy * dy + dz * dz)
                strain = (d - length[lane]) / max(d, length[lane] * tiny)
                work[0, lane], work[1, lane], work[2, lane] = strain * dx, strain * dy, strain * dz
        for axis in range(3):
            for lane in range(lanes):
                to[i + axis, lane] += part_i[lane] * work[axis, lane]
            for lane in range(lanes):
                to[j + axis, np.uintp(lane) + shift] -= part_j[lane] * work[axis, lane]


@kernel
def place(y: Any, sheet: Any, targets: Any, turn: Any, cloth: Any) -> None:
    """Pins go where their path leads, or stay; then each fills the lanes of its own row."""
    for p in range(sheet.pins.size):
        row, lane = 3 * (sheet.pins[p] // sheet.columns), sheet.pins[p] % sheet.columns
        for axis in range(3):
            if targets.shape[0] > 0:
                which = cloth if targets.shape[2] > 1 else 0
                y[row + axis, lane] = targets[turn, 3 * p + axis, which]
            own = 3 * (sheet.rows + p) + axis
            if sheet.extra > 0:
                for other in range(y.shape[1]):
                    y[own, other] = y[row + axis, lane]


@kernel
def wind_room(sheet: Any, dtype: Any) -> Any:
    """Arrays for `add_wind`; the last one also serves `pull`."""
    samples = sheet.controls.size
    return (
        np.empty((3, samples), dtype),
        np.empty((3, samples), dtype),
        np.empty((18, samples), dtype),
        np.zeros((12, sheet.width + 2), dtype),
    )


@kernel
def own_gusts(gusts: Any, cloth: Any, samples: Any) -> Any:
    """The winds on one cloth, with the samples as lanes."""
    count = gusts.seeds.size
    phases = np.empty((count, samples), gusts.phases.dtype)
    origins = np.empty((count, 3, samples), gusts.origins.dtype)
    for number in range(count):
        for lane in range(samples):
            phases[number, lane] = gusts.phases[number, cloth]
            for axis in range(3):
                origins[number, axis, lane] = gusts.origins[number, axis, cloth]
    return Gusts(gusts.numbers, gusts.seeds, phases, origins)


@kernel
def add_wind(
    g: Any, y: Any, v: Any, sheet: Any, gusts: Any, number: Any, time: Any, dt: Any, room: Any
) -> None:
    """g += dt/m · F of one wind; see `kernels.add_wind_velocities`. v may be g.

    room: at, wind and work of the samples, and work [12, W + 2].
    """
    at, wind, samples_work, work = room
    for sample in range(sheet.controls.size):
        row, lane = (
            3 * (sheet.controls[sample] // sheet.columns),
            (sheet.controls[sample] % sheet.columns),
        )
        for axis in range(3):
            at[axis, sample] = y[row + axis, lane]
    kernels.blow(wind, at, np.zeros(1, np.int32), gusts, number, 0, time, samples_work)
    pressure = y.dtype.type(dt * gusts.numbers[number, 16])
    for r in range(sheet.rows):
        relative_wind(work, v, wind, sheet, r)
        normals(work, y, sheet, r)
        press(g, work, sheet, r, pressure)


@kernel
def relative_wind(work: Any, v: Any, wind: Any, sheet: Any, r: Any) -> None:
    """Wind less velocity along row r, into work[0:3]."""
    low, first = sheet.low[r], sheet.above[r] * sheet.across.shape[0]
    for axis in range(3):
        for lane in range(sheet.width):
            work[axis, lane] = -v[3 * r + axis, lane]
        for column in range(sheet.across.shape[0]):
            above = wind[axis, first + column]
            below = wind[axis, first + sheet.across.shape[0] + column]
            flow = above + low * (below - above)
            for lane in range(sheet.width):
                work[axis, lane] += flow * sheet.across[column, lane]


@kernel
def normals(work: Any, y: Any, sheet: Any, r: Any) -> None:
    """Vector areas along row r, into work[6:9]: a quarter of (right - left) x (above - below)."""
    up, down = 3 * max(r - 1, 0), 3 * min(r + 1, sheet.rows - 1)
    last = sheet.columns - 1
    for axis in range(3):
        # work[3:6] is the row with its ends doubled.
        work[3 + axis, 0], work[3 + axis, last + 2] = y[3 * r + axis, 0], y[3 * r + axis, last]
        for lane in range(sheet.columns):
            work[3 + axis, lane + 1] = y[3 * r + axis, lane]
    quarter = y.dtype.type(0.25)
    for lane in range(sheet.width):
        px = quarter * (work[3, lane + 2] - work[3, lane])
        py = quarter * (work[4, lane + 2] - work[4, lane])
        pz = quarter * (work[5, lane + 2] - work[5, lane])
        work[9, lane], work[10, lane], work[11, lane] = px, py, pz
    for lane in range(sheet.width):
        qx, qy = y[up, lane] - y[down, lane], y[up + 1, lane] - y[down + 1, lane]
        qz = y[up + 2, lane] - y[down + 2, lane]
        work[6, lane] = work[10, lane] * qz - work[11, lane] * qy
        work[7, lane] = work[11, lane] * qx - work[9, lane] * qz
        work[8, lane] = work[9, lane] * qy - work[10, lane] * qx


@kernel
def press(g: Any, work: Any, sheet: Any, r: Any, pressure: Any) -> None:
    """g += pressure / m (u · n) n / |n| with u in work[0:3] and n in work[6:9]."""
    tiny = g.dtype.type(1e-30)
    for lane in range(sheet.width):
        nx, ny, nz = work[6, lane], work[7, lane], work[8, lane]
        area = np.sqrt(nx * nx + ny * ny + nz * nz) + tiny
        head_on = nx * work[0, lane] + ny * work[1, lane] + nz * work[2, lane]
        work[9, lane] = pressure * sheet.inv_mass[r, lane] * head_on / area
    for axis in range(3):
        for lane in range(sheet.width):
            g[3 * r + axis, lane] += work[9, lane] * work[6 + axis, lane]


@kernel
def add_push(g: Any, sheet: Any, push: Any, dt: Any, cloth: Any) -> None:
    """g += dt push [3N, B], or nothing if it is empty."""
    if push.size == 0:
        return
    for particle in range(sheet.rows * sheet.columns):
        row, lane = particle // sheet.columns, particle % sheet.columns
        for axis in range(3):
            g[3 * row + axis, lane] += dt * push[3 * particle + axis, cloth]


@kernel
def transform(out: Any, rows: Any, matrix: Any, count: Any, lanes: Any) -> None:
    """out[row] = sum_c rows[row, c] matrix[c] over `count` columns."""
    for row in range(out.shape[0]):
        for lane in range(lanes):
            out[row, lane] = 0
        for c in range(0, count - 3, 4):
            a, b, d, e = rows[row, c], rows[row, c + 1], rows[row, c + 2], rows[row, c + 3]
            for lane in range(lanes):
                out[row, lane] += (a * matrix[c, lane] + b * matrix[c + 1, lane]) + (
                    d * matrix[c + 2, lane] + e * matrix[c + 3, lane]
                )
        for c in range(count // 4 * 4, count):
            a = rows[row, c]
            for lane in range(lanes):
                out[row, lane] += a * matrix[c, lane]


@kernel
def solve_columns(w: Any, filter: Any, lanes: Any) -> None:
    """Each wave's column by its band of two, in place: L, D and back by the transpose of L."""
    begin, count = filter.first, filter.inverse.shape[0]
    for row in range(3 * count):
        r, at = row // 3, 3 * begin + row
        if r > 0:
            for lane in range(lanes):
                w[at, lane] -= filter.near[r, lane] * w[at - 3, lane]
        if r > 1:
            for lane in range(lanes):
                w[at, lane] -= filter.far[r, lane] * w[at - 6, lane]
    for row in range(3 * count - 1, -1, -1):
        r, at = row // 3, 3 * begin + row
        for lane in range(lanes):
            w[at, lane] *= filter.inverse[r, lane]
        if r < count - 1:
            for lane in range(lanes):
                w[at, lane] -= filter.near[r + 1, lane] * w[at + 3, lane]
        if r < count - 2:
            for lane in range(lanes):
                w[at, lane] -= filter.far[r + 2, lane] * w[at + 6, lane]


@kernel
def filter_sheet(g: Any, other: Any, filter: Any, sheet: Any, lanes: Any) -> None:
    """g = W g with pins at 0; see `filters.SheetFilter`. other is as large as g."""
    for row in range(3 * sheet.rows):
        for lane in range(lanes):
            g[row, lane] *= sheet.free[row // 3, lane]
    transform(other, g, filter.into, sheet.columns, lanes)
    solve_columns(other, filter, lanes)
    transform(g, other, filter.back, sheet.columns, lanes)
    for p in range(filter.release.shape[0]):
        pin = sheet.pins[p]
        for axis in range(3):
            other[p, axis] = g[3 * (pin // sheet.columns) + axis, pin % sheet.columns]
    for p in range(filter.release.shape[0]):
        for row in range(3 * sheet.rows):
            part = other[p, row % 3]
            for lane in range(lanes):
                g[row, lane] += part * filter.release[p, row // 3, lane]


@kernel
def subtract_mean(g: Any, v: Any, mean: Any, sheet: Any, lanes: Any) -> None:
    """mean [3] = the pins' mean velocity, or 0; g = v - mean."""
    for axis in range(3):
        mean[axis] = 0
        for p in range(sheet.pins.size):
            pin = sheet.pins[p]
            mean[axis] += v[3 * (pin // sheet.columns) + axis, pin % sheet.columns]
        mean[axis] /= v.dtype.type(max(1, sheet.pins.size))
    for row in range(3 * sheet.rows):
        for lane in range(lanes):
            g[row, lane] = v[row, lane] - mean[row % 3]


@kernel
def fall(g: Any, mean: Any, sheet: Any, numbers: Any, lanes: Any) -> None:
    """g = (g + mean + dt gravity) less drag, 0 for pins: see `kernels.add_uniform`."""
    F = g.dtype.type
    slow = F(1 / (1 + numbers[0] * numbers[1]))
    for row in range(3 * sheet.rows):
        gain = mean[row % 3] + F(numbers[0] * numbers[3 + row % 3])
        for lane in range(lanes):
            g[row, lane] = (g[row, lane] + gain) * slow * sheet.free[row // 3, lane]


@kernel
def move(y: Any, g: Any, old: Any, dt: Any, sheet: Any, lanes: Any) -> None:
    """old = y; y += dt g."""
    for row in range(3 * sheet.rows):
        for lane in range(lanes):
            old[row, lane] = y[row, lane]
            y[row, lane] += dt * g[row, lane]


@kernel
def slow_down(v: Any, sheet: Any, numbers: Any, dt: Any, lanes: Any) -> None:
    """Drag over dt of the speed that gravity is about to add to: see `xpbd.add_pushes`."""
    F = v.dtype.type
    slow = F(1 / (1 + dt * numbers[1]))
    for row in range(3 * sheet.rows):
        gain = F(dt * numbers[3 + row % 3])
        for lane in range(lanes):
            kept = (v[row, lane] + gain) * slow - gain
            v[row, lane] = kept * sheet.free[row // 3, lane]


@kernel
def drift(y: Any, old: Any, v: Any, sheet: Any, numbers: Any, substep: Any, lanes: Any) -> None:
    """As `xpbd.drift`."""
    F = y.dtype.type
    h = F(numbers[0])
    for row in range(3 * sheet.rows):
        gain = F(numbers[0] * numbers[0] * numbers[3 + row % 3])
        if substep == 0:
            for lane in range(lanes):
                here = y[row, lane]
                gone = h * v[row, lane] + gain
                y[row, lane] = here + gone * sheet.free[row // 3, lane]
                old[row, lane] = here
        else:
            for lane in range(lanes):
                here = y[row, lane]
                gone = (here - old[row, lane]) + gain
                y[row, lane] = here + gone * sheet.free[row // 3, lane]
                old[row, lane] = here


@kernel
def set_velocities(v: Any, y: Any, old: Any, h: Any, sheet: Any, lanes: Any) -> None:
    """v = (y - old) / h, flushed to 0 below STILL."""
    still, none, rate = y.dtype.type(STILL), y.dtype.type(0), y.dtype.type(1 / h)
    for row in range(3 * sheet.rows):
        for lane in range(lanes):
            speed = (y[row, lane] - old[row, lane]) * rate
            v[row, lane] = none if abs(speed) < still else speed
