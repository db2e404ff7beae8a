"""The inner loops over one grid laid out as a plane of lanes; see `sheets`.

As in `kernels`, with arrays [3, lanes]. A loop touches few arrays: with more the compiler cannot
tell them apart and leaves it scalar. Indices that are sums are unsigned, or each would first be
asked whether it counts from the end.
"""

from typing import Any

import numpy as np

from drapery.cloth import kernels
from drapery.cloth.compiled import kernel
from drapery.cloth.kernels import STILL, TINY
from drapery.cloth.wind import Gusts

LIMIT, SOLVE = 0, 1
"""Forms of `pull`: a longest length, XPBD's constraint."""


@kernel
def lane_of(particle: Any, sheet: Any) -> Any:
    """Where a particle is."""
    return particle // sheet.columns * sheet.width + particle % sheet.columns


@kernel
def load(y: Any, x: Any, cloth: Any, sheet: Any) -> None:
    """One cloth of lanes x [3N, B] into y [3, lanes]."""
    for particle in range(x.shape[0] // 3):
        for axis in range(3):
            y[axis, lane_of(particle, sheet)] = x[3 * particle + axis, cloth]


@kernel
def store(x: Any, y: Any, cloth: Any, sheet: Any) -> None:
    """y [3, lanes] into one cloth of lanes x [3N, B]."""
    for particle in range(x.shape[0] // 3):
        for axis in range(3):
            x[3 * particle + axis, cloth] = y[axis, lane_of(particle, sheet)]


@kernel
def add_spring_velocities(g: Any, x: Any, pulls: Any, work: Any) -> None:
    """g += dt/m · F, where the parts are dt k / m. work: [2, size]."""
    tiny = x.dtype.type(TINY)
    for entry in range(pulls.a.size):
        a, b = np.uintp(pulls.a[entry]), np.uintp(pulls.b[entry])
        start, count = np.uintp(pulls.start[entry]), pulls.lanes[entry]
        for n in range(count):
            dx = x[0, b + np.uintp(n)] - x[0, a + np.uintp(n)]
            dy = x[1, b + np.uintp(n)] - x[1, a + np.uintp(n)]
            dz = x[2, b + np.uintp(n)] - x[2, a + np.uintp(n)]
            length = pulls.length[start + np.uintp(n)]
            d = np.sqrt(dx * dx + dy * dy + dz * dz)
            work[0, n] = (d - length) / max(d, length * tiny)
        for axis in range(3):
            for n in range(count):
                work[1, n] = work[0, n] * (x[axis, b + np.uintp(n)] - x[axis, a + np.uintp(n)])
            for n in range(count):
                g[axis, a + np.uintp(n)] += pulls.part_i[start + np.uintp(n)] * work[1, n]
            for n in range(count):
                g[axis, b + np.uintp(n)] -= pulls.part_j[start + np.uintp(n)] * work[1, n]


@kernel
def pull(x: Any, pulls: Any, begin: Any, end: Any, form: Any, work: Any) -> None:
    """Entries begin..end: x_a += part_i e (x_b - x_a), x_b -= part_j e (x_b - x_a).

    e is the strain by the form. work: [2, size].
    """
    for entry in range(begin, end):
        a, b = np.uintp(pulls.a[entry]), np.uintp(pulls.b[entry])
        start, count = np.uintp(pulls.start[entry]), pulls.lanes[entry]
        if form == SOLVE:
            for n in range(count):
                dx = x[0, b + np.uintp(n)] - x[0, a + np.uintp(n)]
                dy = x[1, b + np.uintp(n)] - x[1, a + np.uintp(n)]
                dz = x[2, b + np.uintp(n)] - x[2, a + np.uintp(n)]
                length = pulls.length[start + np.uintp(n)]
                square, rest = dx * dx + dy * dy + dz * dz, length * length
                work[0, n] = (square - rest) / (square + rest)
        else:
            for n in range(count):
                dx = x[0, b + np.uintp(n)] - x[0, a + np.uintp(n)]
                dy = x[1, b + np.uintp(n)] - x[1, a + np.uintp(n)]
                dz = x[2, b + np.uintp(n)] - x[2, a + np.uintp(n)]
                length = pulls.length[start + np.uintp(n)]
                d = max(np.sqrt(dx * dx + dy * dy + dz * dz), length)
                work[0, n] = (d - length) / d
        apart = a >= b + np.uintp(count) or b >= a + np.uintp(count)
        for axis in range(3):
            if apart:
                for n in range(count):
                    d = work[0, n] * (x[axis, b + np.uintp(n)] - x[axis, a + np.uintp(n)])
                    x[axis, a + np.uintp(n)] += pulls.part_i[start + np.uintp(n)] * d
                    x[axis, b + np.uintp(n)] -= pulls.part_j[start + np.uintp(n)] * d
            else:
                for n in range(count):
                    work[1, n] = work[0, n] * (x[axis, b + np.uintp(n)] - x[axis, a + np.uintp(n)])
                for n in range(count):
                    x[axis, a + np.uintp(n)] += pulls.part_i[start + np.uintp(n)] * work[1, n]
                for n in range(count):
                    x[axis, b + np.uintp(n)] -= pulls.part_j[start + np.uintp(n)] * work[1, n]


@kernel
def place(y: Any, sheet: Any, targets: Any, turn: Any, cloth: Any) -> None:
    """Pins go where their path leads, or stay; then the planes of anchors are filled."""
    for p in range(sheet.pins.size):
        if targets.shape[0] > 0:
            which = cloth if targets.shape[2] > 1 else 0
            for axis in range(3):
                y[axis, lane_of(sheet.pins[p], sheet)] = targets[turn, 3 * p + axis, which]
    for k in range(sheet.anchors.size):
        first = np.uintp((k + 1) * sheet.plane)
        for axis in range(3):
            if sheet.anchors[k] >= 0:
                held = y[axis, lane_of(sheet.anchors[k], sheet)]
                for lane in range(sheet.size):
                    y[axis, first + np.uintp(lane)] = held
            else:
                for row in range(sheet.rows):
                    line = first + np.uintp(row * sheet.width)
                    for lane in range(sheet.width):
                        y[axis, line + np.uintp(lane)] = y[axis, lane]


@kernel
def wind_room(sheet: Any, dtype: Any) -> Any:
    """Arrays for `add_wind`."""
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

    room: at, wind and work of the samples, and work [12, width + 2].
    """
    at, wind, samples_work, work = room
    for sample in range(sheet.controls.size):
        for axis in range(3):
            at[axis, sample] = y[axis, lane_of(sheet.controls[sample], sheet)]
    kernels.blow(wind, at, np.zeros(1, np.int32), gusts, number, 0, time, samples_work)
    pressure = y.dtype.type(dt * gusts.numbers[number, 16])
    for row in range(sheet.rows):
        relative_wind(work, v, wind, sheet, row)
        normals(work, y, sheet, row)
        press(g, work, sheet, row, pressure)


@kernel
def relative_wind(work: Any, v: Any, wind: Any, sheet: Any, row: Any) -> None:
    """Wind less velocity along a row, into work[0:3]."""
    low, first = sheet.low[row], sheet.above[row] * sheet.across.shape[0]
    line = np.uintp(row * sheet.width)
    for axis in range(3):
        for lane in range(sheet.width):
            work[axis, lane] = -v[axis, line + np.uintp(lane)]
        for column in range(sheet.across.shape[0]):
            above = wind[axis, first + column]
            below = wind[axis, first + sheet.across.shape[0] + column]
            flow = above + low * (below - above)
            for lane in range(sheet.width):
                work[axis, lane] += flow * sheet.across[column, lane]


@kernel
def normals(work: Any, y: Any, sheet: Any, row: Any) -> None:
    """Vector areas along a row, into work[6:9]: a quarter of (right - left) x (above - below)."""
    line, last = np.uintp(row * sheet.width), sheet.columns - 1
    up = np.uintp(max(row - 1, 0) * sheet.width)
    down = np.uintp(min(row + 1, sheet.rows - 1) * sheet.width)
    for axis in range(3):
        # work[3:6] is the row with its ends doubled.
        for lane in range(sheet.width):
            work[3 + axis, lane + 1] = y[axis, line + np.uintp(lane)]
        work[3 + axis, 0], work[3 + axis, last + 2] = work[3 + axis, 1], work[3 + axis, last + 1]
    quarter = y.dtype.type(0.25)
    for axis in range(3):
        for lane in range(sheet.width):
            work[9 + axis, lane] = quarter * (work[3 + axis, lane + 2] - work[3 + axis, lane])
    for axis in range(3):
        for lane in range(sheet.width):
            work[3 + axis, lane] = y[axis, up + np.uintp(lane)] - y[axis, down + np.uintp(lane)]
    for lane in range(sheet.width):
        work[6, lane] = work[10, lane] * work[5, lane] - work[11, lane] * work[4, lane]
        work[7, lane] = work[11, lane] * work[3, lane] - work[9, lane] * work[5, lane]
        work[8, lane] = work[9, lane] * work[4, lane] - work[10, lane] * work[3, lane]


@kernel
def press(g: Any, work: Any, sheet: Any, row: Any, pressure: Any) -> None:
    """g += pressure / m (u · n) n / |n| with u in work[0:3] and n in work[6:9]."""
    tiny, line = g.dtype.type(1e-30), np.uintp(row * sheet.width)
    for lane in range(sheet.width):
        nx, ny, nz = work[6, lane], work[7, lane], work[8, lane]
        area = np.sqrt(nx * nx + ny * ny + nz * nz) + tiny
        head_on = nx * work[0, lane] + ny * work[1, lane] + nz * work[2, lane]
        work[9, lane] = pressure * sheet.inv_mass[line + np.uintp(lane)] * head_on / area
    for axis in range(3):
        for lane in range(sheet.width):
            g[axis, line + np.uintp(lane)] += work[9, lane] * work[6 + axis, lane]


@kernel
def add_push(g: Any, sheet: Any, push: Any, dt: Any, cloth: Any) -> None:
    """g += dt push [3N, B], or nothing if it is empty."""
    for particle in range(push.shape[0] // 3):
        for axis in range(3):
            g[axis, lane_of(particle, sheet)] += dt * push[3 * particle + axis, cloth]


@kernel
def transform(out: Any, values: Any, matrix: Any, sheet: Any) -> None:
    """Each row: out = sum_c values[c] matrix[c]; lanes beside the grid are 0."""
    width = sheet.width
    for row in range(3 * sheet.rows):
        axis, line = row // sheet.rows, np.uintp(row % sheet.rows * width)
        for lane in range(width):
            out[axis, line + np.uintp(lane)] = 0
        for c in range(0, width, 8):
            at = line + np.uintp(c)
            a0, a1 = values[axis, at], values[axis, at + np.uintp(1)]
            a2, a3 = values[axis, at + np.uintp(2)], values[axis, at + np.uintp(3)]
            a4, a5 = values[axis, at + np.uintp(4)], values[axis, at + np.uintp(5)]
            a6, a7 = values[axis, at + np.uintp(6)], values[axis, at + np.uintp(7)]
            for lane in range(width):
                out[axis, line + np.uintp(lane)] += (
                    (a0 * matrix[c, lane] + a1 * matrix[c + 1, lane])
                    + (a2 * matrix[c + 2, lane] + a3 * matrix[c + 3, lane])
                ) + (
                    (a4 * matrix[c + 4, lane] + a5 * matrix[c + 5, lane])
                    + (a6 * matrix[c + 6, lane] + a7 * matrix[c + 7, lane])
                )


@kernel
def solve_columns(w: Any, filter: Any, sheet: Any) -> None:
    """Each wave's column by its band of two, in place: L, D and back by the transpose of L."""
    width, count = sheet.width, filter.inverse.shape[0]
    one, two = np.uintp(width), np.uintp(2 * width)
    for axis in range(3):
        for r in range(count):
            line = np.uintp((filter.first + r) * width)
            if r > 0:
                for lane in range(width):
                    at = line + np.uintp(lane)
                    w[axis, at] -= filter.near[r, lane] * w[axis, at - one]
            if r > 1:
                for lane in range(width):
                    at = line + np.uintp(lane)
                    w[axis, at] -= filter.far[r, lane] * w[axis, at - two]
        for r in range(count - 1, -1, -1):
            line = np.uintp((filter.first + r) * width)
            for lane in range(width):
                w[axis, line + np.uintp(lane)] *= filter.inverse[r, lane]
            if r < count - 1:
                for lane in range(width):
                    at = line + np.uintp(lane)
                    w[axis, at] -= filter.near[r + 1, lane] * w[axis, at + one]
            if r < count - 2:
                for lane in range(width):
                    at = line + np.uintp(lane)
                    w[axis, at] -= filter.far[r + 2, lane] * w[axis, at + two]


@kernel
def filter_sheet(g: Any, other: Any, filter: Any, sheet: Any) -> None:
    """g = W g with pins at 0; see `filters.SheetFilter`. other is as large as g."""
    for axis in range(3):
        for lane in range(sheet.size):
            g[axis, lane] *= sheet.free[lane]
    transform(other, g, filter.into, sheet)
    solve_columns(other, filter, sheet)
    transform(g, other, filter.back, sheet)
    for p in range(filter.release.shape[0]):
        for axis in range(3):
            other[axis, p] = g[axis, lane_of(sheet.pins[p], sheet)]
    for p in range(filter.release.shape[0]):
        for axis in range(3):
            part = other[axis, p]
            for lane in range(sheet.size):
                g[axis, lane] += part * filter.release[p, lane]


@kernel
def subtract_mean(g: Any, v: Any, mean: Any, sheet: Any) -> None:
    """mean [3] = the pins' mean velocity, or 0; g = v - mean."""
    for axis in range(3):
        mean[axis] = 0
        for p in range(sheet.pins.size):
            mean[axis] += v[axis, lane_of(sheet.pins[p], sheet)]
        mean[axis] /= v.dtype.type(max(1, sheet.pins.size))
        part = mean[axis]
        for lane in range(sheet.size):
            g[axis, lane] = v[axis, lane] - part


@kernel
def fall(g: Any, mean: Any, sheet: Any, numbers: Any) -> None:
    """g = (g + mean + dt gravity) less drag, 0 for pins: see `kernels.add_uniform`."""
    F = g.dtype.type
    slow = F(1 / (1 + numbers[0] * numbers[1]))
    for axis in range(3):
        gain = mean[axis] + F(numbers[0] * numbers[3 + axis])
        for lane in range(sheet.size):
            g[axis, lane] = (g[axis, lane] + gain) * slow * sheet.free[lane]


@kernel
def move(y: Any, g: Any, old: Any, dt: Any, sheet: Any) -> None:
    """old = y; y += dt g."""
    for axis in range(3):
        for lane in range(sheet.size):
            old[axis, lane] = y[axis, lane]
            y[axis, lane] += dt * g[axis, lane]


@kernel
def slow_down(v: Any, sheet: Any, numbers: Any, dt: Any) -> None:
    """Drag over dt of the speed that gravity is about to add to: see `xpbd.add_pushes`."""
    F = v.dtype.type
    slow = F(1 / (1 + dt * numbers[1]))
    for axis in range(3):
        gain = F(dt * numbers[3 + axis])
        for lane in range(sheet.size):
            v[axis, lane] = ((v[axis, lane] + gain) * slow - gain) * sheet.free[lane]


@kernel
def drift(y: Any, old: Any, v: Any, sheet: Any, numbers: Any, substep: Any) -> None:
    """As `xpbd.drift`."""
    F = y.dtype.type
    h = F(numbers[0])
    for axis in range(3):
        gain = F(numbers[0] * numbers[0] * numbers[3 + axis])
        if substep == 0:
            for lane in range(sheet.size):
                here = y[axis, lane]
                y[axis, lane] = here + (h * v[axis, lane] + gain) * sheet.free[lane]
                old[axis, lane] = here
        else:
            for lane in range(sheet.size):
                here = y[axis, lane]
                y[axis, lane] = here + ((here - old[axis, lane]) + gain) * sheet.free[lane]
                old[axis, lane] = here


@kernel
def set_velocities(v: Any, y: Any, old: Any, h: Any, sheet: Any) -> None:
    """v = (y - old) / h, flushed to 0 below STILL."""
    still, none, rate = y.dtype.type(STILL), y.dtype.type(0), y.dtype.type(1 / h)
    for axis in range(3):
        for lane in range(sheet.size):
            speed = (y[axis, lane] - old[axis, lane]) * rate
            v[axis, lane] = none if abs(speed) < still else speed
