"""The inner loops over one grid laid out as a plane of lanes; see `sheets`.

As in `kernels`, with arrays [3, lanes]. Loops run to the end of a whole register; the values in
the padding have no effect.
"""

from typing import Any

import numpy as np

from drapery.cloth import kernels
from drapery.cloth.kernels import MIN_SPEED, TINY
from drapery.cloth.simd import fill, flush_denormals, lane_count, load, maximum, sqrt, store
from drapery.cloth.wind import COLUMN, Gusts
from drapery.jit import borrowing_kernel, kernel

LIMIT, SOLVE, SHORTEN = 0, 1, 2
"""The forms of `solve_batches`: a longest length, XPBD's constraint, and Provot's correction, which
leaves just the longest length."""


@borrowing_kernel
def lane_of(particle: Any, sheet: Any) -> int:
    """The lane of a particle."""
    lane: int = particle // sheet.columns * sheet.width + particle % sheet.columns
    return lane


@borrowing_kernel
def load_plane(y: Any, x: Any, cloth: Any, sheet: Any) -> None:
    """Copy one cloth of x [3N, B] into the plane y [3, lanes]."""
    for particle in range(x.shape[0] // 3):
        for axis in range(3):
            y[axis, lane_of(particle, sheet)] = x[3 * particle + axis, cloth]


@borrowing_kernel
def store_plane(x: Any, y: Any, cloth: Any, sheet: Any) -> None:
    """Copy the plane y [3, lanes] into one cloth of x [3N, B]."""
    for particle in range(x.shape[0] // 3):
        for axis in range(3):
            x[3 * particle + axis, cloth] = y[axis, lane_of(particle, sheet)]


@borrowing_kernel
def directions(x: Any, a: Any, b: Any) -> tuple[float, float, float]:
    """The vectors from the lanes at a to those at b."""
    return (
        load(x, 0, b) - load(x, 0, a),
        load(x, 1, b) - load(x, 1, a),
        load(x, 2, b) - load(x, 2, a),
    )


@borrowing_kernel
def add_spring_velocities(g: Any, x: Any, batches: Any, work: Any) -> None:
    """g += dt/m · F, where the parts are dt k / m. work: see `move_both`."""
    tiny, lead = x.dtype.type(TINY), work.shape[1] // 2
    for entry in range(batches.a.size):
        a, b, start = batches.a[entry], batches.b[entry], batches.start[entry]
        for n in range(0, batches.lanes[entry], lane_count(x)):
            dx, dy, dz = directions(x, a + n, b + n)
            length = load(batches.values, 0, start + n)
            d = sqrt(dx * dx + dy * dy + dz * dz)
            strain = (d - length) / maximum(d, length * tiny)
            store(work, 0, lead + n, strain * dx)
            store(work, 1, lead + n, strain * dy)
            store(work, 2, lead + n, strain * dz)
        move_both(g, batches, entry, work)


@borrowing_kernel
def move_both(x: Any, batches: Any, entry: Any, work: Any) -> None:
    """x_a += part_i w, x_b -= part_j w, in one loop over the lanes from a.

    work: [3, 2 · L]; its second half is w, its first half is 0.
    """
    a, start, lead = batches.a[entry], batches.start[entry], work.shape[1] // 2
    shift = batches.b[entry] - a
    for axis in range(3):
        for n in range(0, batches.lanes[entry], lane_count(x)):
            gain = load(batches.values, 1, start + n) * load(work, axis, lead + n)
            loss = load(batches.values, 2, start + n - shift) * load(work, axis, lead + n - shift)
            store(x, axis, a + n, load(x, axis, a + n) + (gain - loss))
        for n in range(batches.lanes[entry], batches.lanes[entry] + shift, lane_count(x)):
            loss = load(batches.values, 2, start + n - shift) * load(work, axis, lead + n - shift)
            store(x, axis, a + n, load(x, axis, a + n) - loss)


@borrowing_kernel
def solve_batches(
    x: Any, out: Any, batches: Any, begin: Any, end: Any, form: Any, work: Any
) -> None:
    """Entries begin..end: out_a += part_i e (x_b - x_a), out_b -= part_j e (x_b - x_a).

    e is the strain of XPBD's constraint, or a strain over the longest length; see LIMIT. If out
    is the same array as x, each entry sees what those before it moved. work: see `move_both`.
    """
    lead, none = work.shape[1] // 2, fill(x.dtype.type(0))
    for entry in range(begin, end):
        a, b, start = batches.a[entry], batches.b[entry], batches.start[entry]
        crossing, held = batches.crossing[entry], batches.held[entry]
        for n in range(0, batches.lanes[entry], lane_count(x)):
            dx, dy, dz = directions(x, a + n, b + n)
            length = load(batches.values, 0, start + n)
            square = dx * dx + dy * dy + dz * dz
            if form == SHORTEN:
                d = maximum(sqrt(square), length)
                e = (d - length) / d
            else:
                rest = length * length
                square = maximum(square, rest if form == LIMIT else none)
                e = (square - rest) / (square + rest)
            if crossing:
                store(work, 0, lead + n, e * dx)
                store(work, 1, lead + n, e * dy)
                store(work, 2, lead + n, e * dz)
            else:
                if not held:
                    kernels.add(out, 0, a + n, load(batches.values, 1, start + n) * e, dx, dy, dz)
                kernels.add(out, 0, b + n, -load(batches.values, 2, start + n) * e, dx, dy, dz)
        if crossing:
            move_both(out, batches, entry, work)


@borrowing_kernel
def bend(
    out: Any,
    x: Any,
    z: Any,
    bending: Any,
    sheet: Any,
    scale: Any,
    own: Any,
    other: Any,
    work: Any,
) -> None:
    """out -= scale / m · Σ w k ((1 + own) d + other · d'), d = Σ w x, d' = Σ w z.

    All stencils of a group see the same positions; see `sheets.SheetBending` and, for work,
    `move_both`. out may be the same array as x.
    """
    lead, whole = work.shape[1] // 2, x.dtype.type(1) + own
    for group in range(bending.shifts.shape[0]):
        w, shifts = bending.weights[group], bending.shifts[group]
        for axis in range(3):
            for n in range(0, sheet.size, lane_count(x)):
                d = whole * weighted(x, axis, n, shifts, w, 1)
                if other != 0:
                    d = d + other * weighted(z, axis, n, shifts, w, 1)
                store(work, axis, lead + n, load(bending.stiffness, group, n) * d)
            for n in range(0, sheet.size, lane_count(x)):
                total = scale * weighted(work, axis, lead + n, shifts, w, -1)
                change = load(bending.inv_mass, 0, n) * total
                store(out, axis, n, load(out, axis, n) - change)


@borrowing_kernel
def weighted(x: Any, axis: Any, n: Any, shifts: Any, w: Any, sign: Any) -> float:
    """The sum by weights of the lanes at the shifts from n, to the left if the sign is -1."""
    total: float = w[0] * load(x, axis, n + sign * shifts[0])
    total = total + w[1] * load(x, axis, n + sign * shifts[1])
    total = total + w[2] * load(x, axis, n + sign * shifts[2])
    if w[3] != 0:
        total = total + w[3] * load(x, axis, n + sign * shifts[3])
    return total


@borrowing_kernel
def place(y: Any, sheet: Any, targets: Any, turn: Any, cloth: Any) -> None:
    """Move pins along their path, or leave them in place; then fill the planes of anchors."""
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
def wind_scratch(sheet: Any, gusts: Any, dtype: Any) -> Any:
    """Arrays for `blow` and `add_winds`: places of the samples, each wind at them, the sum of its
    waves at each lane [m/s], and work for both."""
    samples, count = sheet.controls.size, gusts.seeds.size
    return (
        np.empty((3, samples), dtype),
        np.empty((count, 3 + 2 * gusts.rates.shape[1], samples), dtype),
        np.empty((count, sheet.plane), dtype),
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
    return Gusts(
        gusts.numbers,
        gusts.seeds,
        phases,
        origins,
        gusts.rates,
        gusts.turns,
        gusts.sines,
        gusts.cosines,
    )


@kernel
def blow(y: Any, sheet: Any, gusts: Any, time: Any, scratch: Any) -> None:
    """Set the winds at the samples, and their waves, at a time [s]. scratch: see `wind_scratch`."""
    at, winds, waves, work, _ = scratch
    for sample in range(sheet.controls.size):
        for axis in range(3):
            at[axis, sample] = y[axis, lane_of(sheet.controls[sample], sheet)]
    for number in range(gusts.seeds.size):
        kernels.blow(winds[number], at, np.zeros(1, np.int32), gusts, number, 0, time, work)
        blow_waves(waves, number, winds[number], gusts.sines[number], gusts.cosines[number], sheet)


@borrowing_kernel
def add_winds(g: Any, y: Any, v: Any, sheet: Any, gusts: Any, dt: Any, scratch: Any) -> None:
    """g += dt/m · F of the winds that `blow` set; see `kernels.add_wind_velocities`. v may be the
    same array as g."""
    _, winds, waves, _, work = scratch
    for number in range(gusts.seeds.size):
        pressure = y.dtype.type(dt * gusts.numbers[number, COLUMN.pressure])
        for row in range(sheet.rows):
            relative_wind(work, v, winds[number], sheet, row)
            press(g, y, work, waves, number, sheet, row, pressure)


@borrowing_kernel
def relative_wind(work: Any, v: Any, wind: Any, sheet: Any, row: Any) -> None:
    """Wind less velocity along a row, into work[0:3]."""
    low, first = sheet.low[row], sheet.above[row] * sheet.across.shape[0]
    line, samples = row * sheet.width, sheet.across.shape[0]
    for axis in range(3):
        for lane in range(0, sheet.width, lane_count(v)):
            flow = -load(v, axis, line + lane)
            for column in range(samples):
                above = wind[axis, first + column]
                below = wind[axis, first + samples + column]
                flow = flow + (above + low * (below - above)) * load(sheet.across, column, lane)
            store(work, axis, lane, flow)


@borrowing_kernel
def blow_waves(waves: Any, number: Any, wind: Any, sines: Any, cosines: Any, sheet: Any) -> None:
    """The sum of the waves of a wind at each lane [m/s], into waves[number]; their phases follow
    wind[0:3]."""
    for row in range(sheet.rows):
        for lane in range(0, sheet.width, lane_count(waves)):
            total, at = fill(waves.dtype.type(0)), row * sheet.columns + lane
            for wave in range(sines.shape[0]):
                total = total + wind[3 + 2 * wave, 0] * load(sines, wave, at)
                total = total + wind[4 + 2 * wave, 0] * load(cosines, wave, at)
            store(waves, number, row * sheet.width + lane, total)


@borrowing_kernel
def press(
    g: Any, y: Any, work: Any, waves: Any, number: Any, sheet: Any, row: Any, pressure: Any
) -> None:
    """g += pressure / m (u · n / |n| + w) n along a row with u in work[0:3] and w in waves[number].

    n: vector areas, a quarter of (right - left) x (above - below).
    """
    line, last, edge = row * sheet.width, sheet.columns - 1, lane_count(y)
    up, down = max(row - 1, 0) * sheet.width, min(row + 1, sheet.rows - 1) * sheet.width
    for axis in range(3):
        # work[3:6] is the row with its ends doubled.
        for lane in range(0, sheet.width, lane_count(y)):
            store(work, 3 + axis, edge + lane, load(y, axis, line + lane))
        work[3 + axis, edge - 1] = y[axis, line]
        work[3 + axis, edge + last + 1] = y[axis, line + last]
    tiny, quarter = g.dtype.type(1e-30), g.dtype.type(0.25)
    for lane in range(0, sheet.width, lane_count(y)):
        px = quarter * (load(work, 3, edge + lane + 1) - load(work, 3, edge + lane - 1))
        py = quarter * (load(work, 4, edge + lane + 1) - load(work, 4, edge + lane - 1))
        pz = quarter * (load(work, 5, edge + lane + 1) - load(work, 5, edge + lane - 1))
        qx, qy, qz = directions(y, down + lane, up + lane)
        nx, ny, nz = py * qz - pz * qy, pz * qx - px * qz, px * qy - py * qx
        head_on = nx * load(work, 0, lane) + ny * load(work, 1, lane) + nz * load(work, 2, lane)
        area = sqrt(nx * nx + ny * ny + nz * nz) + tiny
        head_on = head_on + area * load(waves, number, line + lane)
        push = pressure * load(sheet.inv_mass, row, lane) * head_on / area
        kernels.add(g, 0, line + lane, push, nx, ny, nz)


@borrowing_kernel
def add_push(g: Any, sheet: Any, push: Any, dt: Any, cloth: Any) -> None:
    """g += dt push [3N, B], or nothing if it is empty."""
    for particle in range(push.shape[0] // 3):
        for axis in range(3):
            g[axis, lane_of(particle, sheet)] += dt * push[3 * particle + axis, cloth]


@borrowing_kernel
def transform(out: Any, values: Any, matrix: Any, sheet: Any) -> None:
    """For each row: out = sum_c values[c] matrix[c]; lanes beside the grid are 0."""
    width, none = sheet.width, fill(out.dtype.type(0))
    for row in range(sheet.rows):
        line = row * width
        for lane in range(0, width, lane_count(out)):
            # Three axes and two halves of the sum: enough independent work for the processor.
            x = y = z = none
            u = v = w = none
            for c in range(0, width, 2):
                near, far = load(matrix, c, lane), load(matrix, c + 1, lane)
                x, u = x + values[0, line + c] * near, u + values[0, line + c + 1] * far
                y, v = y + values[1, line + c] * near, v + values[1, line + c + 1] * far
                z, w = z + values[2, line + c] * near, w + values[2, line + c + 1] * far
            store(out, 0, line + lane, x + u)
            store(out, 1, line + lane, y + v)
            store(out, 2, line + lane, z + w)


@borrowing_kernel
def solve_columns(w: Any, filter: Any, sheet: Any) -> None:
    """Solve the band matrix of each wave's column in place: L, D, then the transpose of L."""
    width, count = sheet.width, filter.inverse.shape[0]
    for r in range(1, count):
        for lane in range(0, width, lane_count(w)):
            at = (filter.first + r) * width + lane
            near, far = load(filter.near, r, lane), load(filter.far, r, lane)
            for axis in range(3):
                value = load(w, axis, at) - near * load(w, axis, at - width)
                if r > 1:
                    value = value - far * load(w, axis, at - 2 * width)
                store(w, axis, at, value)
    for r in range(count - 1, -1, -1):
        for lane in range(0, width, lane_count(w)):
            at = (filter.first + r) * width + lane
            for axis in range(3):
                value = load(w, axis, at) * load(filter.inverse, r, lane)
                if r < count - 1:
                    value = value - load(filter.near, r + 1, lane) * load(w, axis, at + width)
                if r < count - 2:
                    value = value - load(filter.far, r + 2, lane) * load(w, axis, at + 2 * width)
                store(w, axis, at, value)


@borrowing_kernel
def filter_sheet(g: Any, other: Any, filter: Any, sheet: Any) -> None:
    """g = W g with pins at 0; see `filters.SheetFilter`. other is as large as g."""
    for axis in range(3):
        for lane in range(0, sheet.size, lane_count(g)):
            store(g, axis, lane, load(g, axis, lane) * load(sheet.free, 0, lane))
    transform(other, g, filter.into, sheet)
    solve_columns(other, filter, sheet)
    transform(g, other, filter.back, sheet)
    for p in range(filter.release.shape[0]):
        for axis in range(3):
            other[axis, p] = g[axis, lane_of(sheet.pins[p], sheet)]
    for p in range(filter.release.shape[0]):
        for axis in range(3):
            part = other[axis, p]
            for lane in range(0, sheet.size, lane_count(g)):
                store(g, axis, lane, load(g, axis, lane) + part * load(filter.release, p, lane))


@borrowing_kernel
def subtract_mean(g: Any, v: Any, mean: Any, sheet: Any) -> None:
    """mean [3] = the pins' mean velocity, or 0; g = v - mean."""
    for axis in range(3):
        mean[axis] = 0
        for p in range(sheet.pins.size):
            mean[axis] += v[axis, lane_of(sheet.pins[p], sheet)]
        mean[axis] /= v.dtype.type(max(1, sheet.pins.size))
        part = mean[axis]
        for lane in range(0, sheet.size, lane_count(g)):
            store(g, axis, lane, load(v, axis, lane) - part)


@borrowing_kernel
def fall(g: Any, mean: Any, sheet: Any, numbers: Any, dt: Any) -> None:
    """g = (g + mean + dt gravity) less drag, 0 for pins: see `kernels.add_uniform`."""
    F = g.dtype.type
    slow = F(1 / (1 + dt * numbers[1]))
    for axis in range(3):
        gain = mean[axis] + F(dt * numbers[3 + axis])
        for lane in range(0, sheet.size, lane_count(g)):
            store(g, axis, lane, (load(g, axis, lane) + gain) * slow * load(sheet.free, 0, lane))


@borrowing_kernel
def move(y: Any, g: Any, old: Any, dt: Any, sheet: Any) -> None:
    """old = y; y += dt g."""
    for axis in range(3):
        for lane in range(0, sheet.size, lane_count(g)):
            here = load(y, axis, lane)
            store(old, axis, lane, here)
            store(y, axis, lane, here + dt * load(g, axis, lane))


@borrowing_kernel
def take_free(v: Any, g: Any, sheet: Any) -> None:
    """v = g, in which pins have 0; they keep their velocities."""
    one = fill(v.dtype.type(1))
    for axis in range(3):
        for lane in range(0, sheet.size, lane_count(g)):
            held = one - load(sheet.free, 0, lane)
            store(v, axis, lane, load(g, axis, lane) + held * load(v, axis, lane))


@borrowing_kernel
def slow_down(v: Any, sheet: Any, numbers: Any, dt: Any) -> None:
    """Apply drag over dt before gravity is added; see `xpbd.add_pushes`."""
    F = v.dtype.type
    slow = F(1 / (1 + dt * numbers[1]))
    for axis in range(3):
        gain = F(dt * numbers[3 + axis])
        for lane in range(0, sheet.size, lane_count(v)):
            speed = (load(v, axis, lane) + gain) * slow - gain
            store(v, axis, lane, speed * load(sheet.free, 0, lane))


@borrowing_kernel
def drift(y: Any, old: Any, v: Any, sheet: Any, numbers: Any, moves_by_v: Any) -> None:
    """Move y by v, or else as in the last substep, and by gravity; old is y before."""
    F = y.dtype.type
    h = F(numbers[0])
    for axis in range(3):
        gain = F(numbers[0] * numbers[0] * numbers[3 + axis])
        for lane in range(0, sheet.size, lane_count(y)):
            here = load(y, axis, lane)
            motion = h * load(v, axis, lane) if moves_by_v else here - load(old, axis, lane)
            store(y, axis, lane, here + (motion + gain) * load(sheet.free, 0, lane))
            store(old, axis, lane, here)


@borrowing_kernel
def set_velocities(v: Any, y: Any, old: Any, h: Any, sheet: Any) -> None:
    """v = (y - old) / h; components below MIN_SPEED become 0."""
    still, rate = y.dtype.type(MIN_SPEED), y.dtype.type(1 / h)
    for axis in range(3):
        for lane in range(0, sheet.size, lane_count(y)):
            speed = (load(y, axis, lane) - load(old, axis, lane)) * rate
            store(v, axis, lane, flush_denormals(speed, still))


@borrowing_kernel
def add_velocities(v: Any, y: Any, old: Any, dt: Any, sheet: Any) -> None:
    """v += (y - old) / dt."""
    rate = y.dtype.type(1 / dt)
    for axis in range(3):
        for lane in range(0, sheet.size, lane_count(y)):
            gain = (load(y, axis, lane) - load(old, axis, lane)) * rate
            store(v, axis, lane, load(v, axis, lane) + gain)
