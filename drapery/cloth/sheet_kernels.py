"""The inner loops over one grid laid out as a plane of lanes; see `sheets`.

As in `kernels`, with arrays [3, lanes]. Loops go on to the end of a whole register: what they are
given there changes nothing.
"""

from typing import Any

import numpy as np

from drapery.cloth import kernels
from drapery.cloth.kernels import STILL, TINY
from drapery.cloth.simd import fill, flushed, larger, root, span
from drapery.cloth.simd import load as get
from drapery.cloth.simd import store as put
from drapery.cloth.wind import Gusts
from drapery.jit import kernel

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
def ways(x: Any, a: Any, b: Any) -> Any:
    """From the lanes at a to those at b."""
    return (
        get(x, 0, b) - get(x, 0, a),
        get(x, 1, b) - get(x, 1, a),
        get(x, 2, b) - get(x, 2, a),
    )


@kernel
def add_spring_velocities(g: Any, x: Any, pulls: Any, work: Any) -> None:
    """g += dt/m · F, where the parts are dt k / m. work: see `move_both`."""
    tiny, lead = x.dtype.type(TINY), work.shape[1] // 2
    for entry in range(pulls.a.size):
        a, b, start = pulls.a[entry], pulls.b[entry], pulls.start[entry]
        for n in range(0, pulls.lanes[entry], span(x)):
            dx, dy, dz = ways(x, a + n, b + n)
            length = get(pulls.values, 0, start + n)
            d = root(dx * dx + dy * dy + dz * dz)
            strain = (d - length) / larger(d, length * tiny)
            put(work, 0, lead + n, strain * dx)
            put(work, 1, lead + n, strain * dy)
            put(work, 2, lead + n, strain * dz)
        move_both(g, pulls, entry, work)


@kernel
def move_both(x: Any, pulls: Any, entry: Any, work: Any) -> None:
    """x_a += part_i w, x_b -= part_j w, in one go over the lanes from a on.

    work: [3, 2 · L] of which w is the second half, with zeros in front of it.
    """
    a, start, lead = pulls.a[entry], pulls.start[entry], work.shape[1] // 2
    shift = pulls.b[entry] - a
    for axis in range(3):
        for n in range(0, pulls.lanes[entry], span(x)):
            gain = get(pulls.values, 1, start + n) * get(work, axis, lead + n)
            loss = get(pulls.values, 2, start + n - shift) * get(work, axis, lead + n - shift)
            put(x, axis, a + n, get(x, axis, a + n) + (gain - loss))
        for n in range(pulls.lanes[entry], pulls.lanes[entry] + shift, span(x)):
            loss = get(pulls.values, 2, start + n - shift) * get(work, axis, lead + n - shift)
            put(x, axis, a + n, get(x, axis, a + n) - loss)


@kernel
def pull(x: Any, pulls: Any, begin: Any, end: Any, form: Any, work: Any) -> None:
    """Entries begin..end: x_a += part_i e (x_b - x_a), x_b -= part_j e (x_b - x_a).

    e is the strain of XPBD's constraint, or of lengths over the longest only. work: see
    `move_both`.
    """
    lead, none = work.shape[1] // 2, fill(x.dtype.type(0))
    for entry in range(begin, end):
        a, b, start = pulls.a[entry], pulls.b[entry], pulls.start[entry]
        crossing, held = pulls.crossing[entry], pulls.held[entry]
        for n in range(0, pulls.lanes[entry], span(x)):
            dx, dy, dz = ways(x, a + n, b + n)
            length = get(pulls.values, 0, start + n)
            rest = length * length
            square = larger(dx * dx + dy * dy + dz * dz, rest if form == LIMIT else none)
            e = (square - rest) / (square + rest)
            if crossing:
                put(work, 0, lead + n, e * dx)
                put(work, 1, lead + n, e * dy)
                put(work, 2, lead + n, e * dz)
            else:
                if not held:
                    kernels.add(x, 0, a + n, get(pulls.values, 1, start + n) * e, dx, dy, dz)
                kernels.add(x, 0, b + n, -get(pulls.values, 2, start + n) * e, dx, dy, dz)
        if crossing:
            move_both(x, pulls, entry, work)


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
        np.zeros((6, sheet.width + 64), dtype),
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

    room: at, wind and work of the samples, and work [6, width and two registers].
    """
    at, wind, samples_work, work = room
    for sample in range(sheet.controls.size):
        for axis in range(3):
            at[axis, sample] = y[axis, lane_of(sheet.controls[sample], sheet)]
    kernels.blow(wind, at, np.zeros(1, np.int32), gusts, number, 0, time, samples_work)
    pressure = y.dtype.type(dt * gusts.numbers[number, 16])
    for row in range(sheet.rows):
        relative_wind(work, v, wind, sheet, row)
        press(g, y, work, sheet, row, pressure)


@kernel
def relative_wind(work: Any, v: Any, wind: Any, sheet: Any, row: Any) -> None:
    """Wind less velocity along a row, into work[0:3]."""
    low, first = sheet.low[row], sheet.above[row] * sheet.across.shape[0]
    line, samples = row * sheet.width, sheet.across.shape[0]
    for axis in range(3):
        for lane in range(0, sheet.width, span(v)):
            flow = -get(v, axis, line + lane)
            for column in range(samples):
                above = wind[axis, first + column]
                below = wind[axis, first + samples + column]
                flow = flow + (above + low * (below - above)) * get(sheet.across, column, lane)
            put(work, axis, lane, flow)


@kernel
def press(g: Any, y: Any, work: Any, sheet: Any, row: Any, pressure: Any) -> None:
    """g += pressure / m (u · n) n / |n| along a row with u in work[0:3].

    n: vector areas, a quarter of (right - left) x (above - below).
    """
    line, last, edge = row * sheet.width, sheet.columns - 1, span(y)
    up, down = max(row - 1, 0) * sheet.width, min(row + 1, sheet.rows - 1) * sheet.width
    for axis in range(3):
        # work[3:6] is the row with its ends doubled.
        for lane in range(0, sheet.width, span(y)):
            put(work, 3 + axis, edge + lane, get(y, axis, line + lane))
        work[3 + axis, edge - 1] = y[axis, line]
        work[3 + axis, edge + last + 1] = y[axis, line + last]
    tiny, quarter = g.dtype.type(1e-30), g.dtype.type(0.25)
    for lane in range(0, sheet.width, span(y)):
        px = quarter * (get(work, 3, edge + lane + 1) - get(work, 3, edge + lane - 1))
        py = quarter * (get(work, 4, edge + lane + 1) - get(work, 4, edge + lane - 1))
        pz = quarter * (get(work, 5, edge + lane + 1) - get(work, 5, edge + lane - 1))
        qx, qy, qz = ways(y, down + lane, up + lane)
        nx, ny, nz = py * qz - pz * qy, pz * qx - px * qz, px * qy - py * qx
        head_on = nx * get(work, 0, lane) + ny * get(work, 1, lane) + nz * get(work, 2, lane)
        area = root(nx * nx + ny * ny + nz * nz) + tiny
        push = pressure * get(sheet.inv_mass, row, lane) * head_on / area
        kernels.add(g, 0, line + lane, push, nx, ny, nz)


@kernel
def add_push(g: Any, sheet: Any, push: Any, dt: Any, cloth: Any) -> None:
    """g += dt push [3N, B], or nothing if it is empty."""
    for particle in range(push.shape[0] // 3):
        for axis in range(3):
            g[axis, lane_of(particle, sheet)] += dt * push[3 * particle + axis, cloth]


@kernel
def transform(out: Any, values: Any, matrix: Any, sheet: Any) -> None:
    """Each row: out = sum_c values[c] matrix[c]; lanes beside the grid are 0."""
    width, none = sheet.width, fill(out.dtype.type(0))
    for row in range(sheet.rows):
        line = row * width
        for lane in range(0, width, span(out)):
            # Three axes and two halves of the sum: enough for the processor to do at once.
            x = y = z = none
            u = v = w = none
            for c in range(0, width, 2):
                near, far = get(matrix, c, lane), get(matrix, c + 1, lane)
                x, u = x + values[0, line + c] * near, u + values[0, line + c + 1] * far
                y, v = y + values[1, line + c] * near, v + values[1, line + c + 1] * far
                z, w = z + values[2, line + c] * near, w + values[2, line + c + 1] * far
            put(out, 0, line + lane, x + u)
            put(out, 1, line + lane, y + v)
            put(out, 2, line + lane, z + w)


@kernel
def solve_columns(w: Any, filter: Any, sheet: Any) -> None:
    """Each wave's column by its band of two, in place: L, D and back by the transpose of L."""
    width, count = sheet.width, filter.inverse.shape[0]
    for r in range(1, count):
        for lane in range(0, width, span(w)):
            at = (filter.first + r) * width + lane
            near, far = get(filter.near, r, lane), get(filter.far, r, lane)
            for axis in range(3):
                value = get(w, axis, at) - near * get(w, axis, at - width)
                if r > 1:
                    value = value - far * get(w, axis, at - 2 * width)
                put(w, axis, at, value)
    for r in range(count - 1, -1, -1):
        for lane in range(0, width, span(w)):
            at = (filter.first + r) * width + lane
            for axis in range(3):
                value = get(w, axis, at) * get(filter.inverse, r, lane)
                if r < count - 1:
                    value = value - get(filter.near, r + 1, lane) * get(w, axis, at + width)
                if r < count - 2:
                    value = value - get(filter.far, r + 2, lane) * get(w, axis, at + 2 * width)
                put(w, axis, at, value)


@kernel
def filter_sheet(g: Any, other: Any, filter: Any, sheet: Any) -> None:
    """g = W g with pins at 0; see `filters.SheetFilter`. other is as large as g."""
    for axis in range(3):
        for lane in range(0, sheet.size, span(g)):
            put(g, axis, lane, get(g, axis, lane) * get(sheet.free, 0, lane))
    transform(other, g, filter.into, sheet)
    solve_columns(other, filter, sheet)
    transform(g, other, filter.back, sheet)
    for p in range(filter.release.shape[0]):
        for axis in range(3):
            other[axis, p] = g[axis, lane_of(sheet.pins[p], sheet)]
    for p in range(filter.release.shape[0]):
        for axis in range(3):
            part = other[axis, p]
            for lane in range(0, sheet.size, span(g)):
                put(g, axis, lane, get(g, axis, lane) + part * get(filter.release, p, lane))


@kernel
def subtract_mean(g: Any, v: Any, mean: Any, sheet: Any) -> None:
    """mean [3] = the pins' mean velocity, or 0; g = v - mean."""
    for axis in range(3):
        mean[axis] = 0
        for p in range(sheet.pins.size):
            mean[axis] += v[axis, lane_of(sheet.pins[p], sheet)]
        mean[axis] /= v.dtype.type(max(1, sheet.pins.size))
        part = mean[axis]
        for lane in range(0, sheet.size, span(g)):
            put(g, axis, lane, get(v, axis, lane) - part)


@kernel
def fall(g: Any, mean: Any, sheet: Any, numbers: Any) -> None:
    """g = (g + mean + dt gravity) less drag, 0 for pins: see `kernels.add_uniform`."""
    F = g.dtype.type
    slow = F(1 / (1 + numbers[0] * numbers[1]))
    for axis in range(3):
        gain = mean[axis] + F(numbers[0] * numbers[3 + axis])
        for lane in range(0, sheet.size, span(g)):
            put(g, axis, lane, (get(g, axis, lane) + gain) * slow * get(sheet.free, 0, lane))


@kernel
def move(y: Any, g: Any, old: Any, dt: Any, sheet: Any) -> None:
    """old = y; y += dt g."""
    for axis in range(3):
        for lane in range(0, sheet.size, span(g)):
            here = get(y, axis, lane)
            put(old, axis, lane, here)
            put(y, axis, lane, here + dt * get(g, axis, lane))


@kernel
def slow_down(v: Any, sheet: Any, numbers: Any, dt: Any) -> None:
    """Drag over dt of the speed that gravity is about to add to: see `xpbd.add_pushes`."""
    F = v.dtype.type
    slow = F(1 / (1 + dt * numbers[1]))
    for axis in range(3):
        gain = F(dt * numbers[3 + axis])
        for lane in range(0, sheet.size, span(v)):
            speed = (get(v, axis, lane) + gain) * slow - gain
            put(v, axis, lane, speed * get(sheet.free, 0, lane))


@kernel
def drift(y: Any, old: Any, v: Any, sheet: Any, numbers: Any, substep: Any) -> None:
    """y goes on as fast as in the last substep, or at first with v, and falls; old is y before."""
    F = y.dtype.type
    h = F(numbers[0])
    for axis in range(3):
        gain = F(numbers[0] * numbers[0] * numbers[3 + axis])
        for lane in range(0, sheet.size, span(y)):
            here = get(y, axis, lane)
            way = h * get(v, axis, lane) if substep == 0 else here - get(old, axis, lane)
            put(y, axis, lane, here + (way + gain) * get(sheet.free, 0, lane))
            put(old, axis, lane, here)


@kernel
def set_velocities(v: Any, y: Any, old: Any, h: Any, sheet: Any) -> None:
    """v = (y - old) / h, flushed to 0 below STILL."""
    still, rate = y.dtype.type(STILL), y.dtype.type(1 / h)
    for axis in range(3):
        for lane in range(0, sheet.size, span(y)):
            speed = (get(y, axis, lane) - get(old, axis, lane)) * rate
            put(v, axis, lane, flushed(speed, still))


@kernel
def add_velocities(v: Any, y: Any, old: Any, dt: Any, sheet: Any) -> None:
    """v += (y - old) / dt."""
    rate = y.dtype.type(1 / dt)
    for axis in range(3):
        for lane in range(0, sheet.size, span(y)):
            gain = (get(y, axis, lane) - get(old, axis, lane)) * rate
            put(v, axis, lane, get(v, axis, lane) + gain)
