"""The inner loops that the solvers share.

Arrays are [3N, L]: row 3i + axis holds one coordinate of particle i for L cloths of one topology
("lanes"), so an inner loop does the same for each cloth and is vectorised. Arithmetic is strict
IEEE in a fixed order (no fastmath): the same bits for any L, on any processor.
`error_model="numpy"` is needed: a division that may raise cannot be vectorised. Loops over three
axes have a bound that the compiler does not know, or it would unroll them and take thrice as long.
"""

from typing import Any

import numpy as np

from drapery import elementary
from drapery.cloth.simd import fill, flush_denormals, lane_count, load, maximum, sqrt, store
from drapery.cloth.wind import COLUMN, CROSSWIND
from drapery.jit import borrowing_kernel, kernel, numba_name

TINY = 1e-6
"""The shortest length of a spring over its rest length; it avoids a division by 0."""
MIN_SPEED = 1e-9
"""Slower velocities [m/s] become 0: subnormal numbers would slow the processor down."""
GUST_RMS = 0.1836
"""Rms of gradient noise whose gradients are uniform in [-1, 1]³, measured over 10⁷ points."""
ALONG, ACROSS, UP = CROSSWIND

_CHOICES = "drapery.cloth.kernel_choices"
filter_velocities = numba_name(_CHOICES, "filter_velocities")
restore_angular_momentum = numba_name(_CHOICES, "restore_angular_momentum")
sine_of_turns = kernel(elementary.sine_of_turns)


@borrowing_kernel
def load_lanes(y: Any, x: Any, start: Any) -> None:
    """Copy the lanes of x [3N, B] from `start` on into the block y [3N, L]."""
    for row in range(y.shape[0]):
        for lane in range(y.shape[1]):
            y[row, lane] = x[row, np.uintp(start) + np.uintp(lane)]


@borrowing_kernel
def store_lanes(x: Any, y: Any, start: Any) -> None:
    """Copy the block y [3N, L] to the lanes of x [3N, B] from `start` on."""
    for row in range(y.shape[0]):
        for lane in range(y.shape[1]):
            x[row, np.uintp(start) + np.uintp(lane)] = y[row, lane]


@borrowing_kernel
def add_spring_velocities(g: Any, x: Any, springs: Any, inv_mass: Any, dt: Any) -> None:
    """g += dt/m · F of all springs; one that is longer than at rest pulls its ends together."""
    tiny = x.dtype.type(TINY)
    for s in range(springs.rest.size):
        i, j = 3 * np.intp(springs.pairs[s, 0]), 3 * np.intp(springs.pairs[s, 1])
        length = springs.rest[s]
        shortest, pull = fill(length * tiny), dt * springs.stiffness[s]
        pull_i, pull_j = pull * inv_mass[i // 3], pull * inv_mass[j // 3]
        for lane in range(0, x.shape[1], lane_count(x)):
            dx, dy, dz = direction(x, i, j, lane)
            d = sqrt(dx * dx + dy * dy + dz * dz)
            strain = (d - length) / maximum(d, shortest)
            add(g, i, lane, pull_i * strain, dx, dy, dz)
            add(g, j, lane, -pull_j * strain, dx, dy, dz)


@borrowing_kernel
def bend(out: Any, x: Any, z: Any, stencils: Any, scale: Any, own: Any, other: Any) -> None:
    """out_i -= scale · part_i · ((1 + own - rest / |d|) d + other · d'), d = Σ w x, d' = Σ w z.

    stencils: see `bending.Stencils`. out may be the same array as x.
    """
    F = x.dtype.type
    tiny, whole = fill(F(1e-30)), fill(F(1) + own)
    for s in range(stencils.rest.size):
        a, b = 3 * np.intp(stencils.particles[s, 0]), 3 * np.intp(stencils.particles[s, 1])
        c, d = 3 * np.intp(stencils.particles[s, 2]), 3 * np.intp(stencils.particles[s, 3])
        rows, w, part = (a, b, c, d), stencils.weights[s], stencils.parts[s]
        rest = stencils.rest[s]
        for lane in range(0, x.shape[1], lane_count(x)):
            dx, dy, dz = weighted(x, rows, w, lane)
            factor = whole
            if rest > 0:
                factor = whole - rest / (sqrt(dx * dx + dy * dy + dz * dz) + tiny)
            dx, dy, dz = factor * dx, factor * dy, factor * dz
            if other != 0:
                ex, ey, ez = weighted(z, rows, w, lane)
                dx, dy, dz = dx + other * ex, dy + other * ey, dz + other * ez
            add(out, a, lane, -scale * part[0], dx, dy, dz)
            add(out, b, lane, -scale * part[1], dx, dy, dz)
            add(out, c, lane, -scale * part[2], dx, dy, dz)
            if part[3] != 0:
                add(out, d, lane, -scale * part[3], dx, dy, dz)


@borrowing_kernel
def weighted(x: Any, rows: Any, w: Any, lane: Any) -> tuple[float, float, float]:
    """The sum of four particles by weights; rows: the first rows of their coordinates."""
    a, b, c, d = rows
    dx = w[0] * load(x, a, lane) + w[1] * load(x, b, lane) + w[2] * load(x, c, lane)
    dy = w[0] * load(x, a + 1, lane) + w[1] * load(x, b + 1, lane) + w[2] * load(x, c + 1, lane)
    dz = w[0] * load(x, a + 2, lane) + w[1] * load(x, b + 2, lane) + w[2] * load(x, c + 2, lane)
    if w[3] != 0:
        dx = dx + w[3] * load(x, d, lane)
        dy = dy + w[3] * load(x, d + 1, lane)
        dz = dz + w[3] * load(x, d + 2, lane)
    return dx, dy, dz


@borrowing_kernel
def direction(x: Any, i: Any, j: Any, lane: Any) -> tuple[float, float, float]:
    """The vector from particle i to particle j; i and j are the first rows of their coordinates."""
    return (
        load(x, j, lane) - load(x, i, lane),
        load(x, j + 1, lane) - load(x, i + 1, lane),
        load(x, j + 2, lane) - load(x, i + 2, lane),
    )


@borrowing_kernel
def add(x: Any, row: Any, lane: Any, part: Any, dx: Any, dy: Any, dz: Any) -> None:
    """x[row : row + 3, lane ...] += part · (dx, dy, dz)."""
    store(x, row, lane, load(x, row, lane) + part * dx)
    store(x, row + 1, lane, load(x, row + 1, lane) + part * dy)
    store(x, row + 2, lane, load(x, row + 2, lane) + part * dz)


@borrowing_kernel
def shorten(x: Any, attachments: Any) -> None:
    """Provot's correction: pairs over their longest length are shortened to it, in order."""
    for s in range(attachments.longest.size):
        i, j = 3 * np.intp(attachments.pairs[s, 0]), 3 * np.intp(attachments.pairs[s, 1])
        longest = fill(attachments.longest[s])
        part_i, part_j = attachments.share_i[s], -attachments.share_j[s]
        for lane in range(0, x.shape[1], lane_count(x)):
            dx, dy, dz = direction(x, i, j, lane)
            d = maximum(sqrt(dx * dx + dy * dy + dz * dz), longest)
            excess = (d - longest) / d
            if part_i != 0:
                add(x, i, lane, part_i * excess, dx, dy, dz)
            if part_j != 0:
                add(x, j, lane, part_j * excess, dx, dy, dz)


@borrowing_kernel
def gradient_noise(out: Any, at: Any, first: Any, cells: Any, seed: Any) -> None:
    """Three noise values of unit rms at points `at` [3, L], into out [3, L].

    `first` [L] is added to the cell number along axis 0, which repeats after `cells`. The three
    values use a cell's random vector with its components in three orders, so they are uncorrelated.
    """
    F = at.dtype.type
    one, count, scale = F(1), F(cells), F(1 / (127.5 * GUST_RMS))
    for lane in range(at.shape[1]):
        i, j, k = below(at[0, lane]), below(at[1, lane]), below(at[2, lane])
        x, y, z = at[0, lane] - i, at[1, lane] - j, at[2, lane] - k
        i += first[lane]
        turns = i / count
        i -= count * below(turns)
        next_i = i + one if i + one < count else i + one - count
        h = seed ^ spread(i, np.uint32(0x9E3779B1)), seed ^ spread(next_i, np.uint32(0x9E3779B1))
        m = spread(j, np.uint32(0x27D4EB2F)), spread(j + one, np.uint32(0x27D4EB2F))
        n = spread(k, np.uint32(0x165667B1)), spread(k + one, np.uint32(0x165667B1))
        u, v, w = fade(x), fade(y), fade(z)
        none = x * F(0), x * F(0), x * F(0)
        near = (one - v) * (one - w), v * (one - w), (one - v) * w, v * w
        p = corner(none, h[0] ^ m[0] ^ n[0], (one - u) * near[0], x, y, z)
        p = corner(p, h[1] ^ m[0] ^ n[0], u * near[0], x - one, y, z)
        p = corner(p, h[0] ^ m[1] ^ n[0], (one - u) * near[1], x, y - one, z)
        p = corner(p, h[1] ^ m[1] ^ n[0], u * near[1], x - one, y - one, z)
        p = corner(p, h[0] ^ m[0] ^ n[1], (one - u) * near[2], x, y, z - one)
        p = corner(p, h[1] ^ m[0] ^ n[1], u * near[2], x - one, y, z - one)
        p = corner(p, h[0] ^ m[1] ^ n[1], (one - u) * near[3], x, y - one, z - one)
        p = corner(p, h[1] ^ m[1] ^ n[1], u * near[3], x - one, y - one, z - one)
        out[0, lane], out[1, lane], out[2, lane] = scale * p[0], scale * p[1], scale * p[2]


@kernel
def below(x: Any) -> Any:
    """The floor of x. A loop with np.floor is not vectorised."""
    whole = type(x)(np.int32(x))
    return whole - type(x)(1) if whole > x else whole


@kernel
def fade(x: Any) -> Any:
    """Perlin's fade, 6 x⁵ - 15 x⁴ + 10 x³."""
    F = type(x)
    return x * x * x * (x * (x * F(6) - F(15)) + F(10))


@kernel
def spread(cell: Any, factor: Any) -> Any:
    """The hash bits of a cell's number along one axis."""
    return np.uint32(np.uint32(np.int32(cell)) * factor)


@kernel
def xor_shifted(h: Any, places: Any) -> Any:
    """Bits combined with themselves shifted to the right."""
    return np.uint32(h ^ np.uint32(h >> places))


@borrowing_kernel
def corner(sums: Any, h: Any, weight: Any, x: Any, y: Any, z: Any) -> tuple[float, float, float]:
    """The three sums plus the part of a corner: its gradient, from bits h, times its offset."""
    F = type(x)
    # The 32-bit finaliser of MurmurHash3 (Appleby 2011).
    h = xor_shifted(np.uint32(h), np.uint32(16))
    h = xor_shifted(np.uint32(h * np.uint32(0x85EBCA6B)), np.uint32(13))
    h = xor_shifted(np.uint32(h * np.uint32(0xC2B2AE35)), np.uint32(16))
    p = F(np.int32(h & np.uint32(255))) - F(127.5)
    q = F(np.int32((h >> np.uint32(8)) & np.uint32(255))) - F(127.5)
    r = F(np.int32((h >> np.uint32(16)) & np.uint32(255))) - F(127.5)
    return (
        sums[0] + weight * (p * x + q * y + r * z),
        sums[1] + weight * (q * x + r * y + p * z),
        sums[2] + weight * (r * x + p * y + q * z),
    )


@borrowing_kernel
def blow(
    wind: Any, x: Any, controls: Any, gusts: Any, number: Any, start: Any, time: Any, work: Any
) -> None:
    """Velocity of one wind at the control particles, lanes from `start` on, into wind [3C, L].

    The rows after it become the sine and the cosine of each wave's phase. work: [18, L] of the same
    type.
    """
    F = x.dtype.type
    numbers, seed = gusts.numbers[number], gusts.seeds[number]
    phases, origins = gusts.phases[number], gusts.origins[number]
    speed, sine, sine_rate = numbers[COLUMN.speed], numbers[COLUMN.sine], numbers[COLUMN.sine_rate]
    gust_rate, gust_start = numbers[COLUMN.gust_rate], numbers[COLUMN.gust_start]
    gust_cells = numbers[COLUMN.gust_cells]
    at, swell, drift, first, noise = work[6:9], work[9], work[10], work[11], work[12:15]
    for lane in range(x.shape[1]):
        now = time + phases[np.uintp(start) + np.uintp(lane)]
        swell[lane] = speed * (1 + sine * sine_of_turns(now * sine_rate))
        cells = now * gust_rate + gust_start
        cells -= gust_cells * np.floor(cells / gust_cells)
        first[lane] = -np.floor(cells)
        drift[lane] = cells - np.floor(cells)
        for wave in range(gusts.rates.shape[1]):
            phase = now * gusts.rates[number, wave] + gusts.turns[number, wave]
            wind[3 * controls.size + 2 * wave, lane] = sine_of_turns(phase)
            wind[3 * controls.size + 2 * wave + 1, lane] = sine_of_turns(phase + 0.25)
    # Noise is 0 where all three coordinates are whole numbers: avoid that at the origin.
    middle, scale, gusty = F(0.5), F(numbers[COLUMN.gust_scale]), numbers[COLUMN.gusts]
    along, across, up = F(gusty * ALONG), F(gusty * ACROSS), F(gusty * UP)
    for control in range(controls.size):
        row = 3 * controls[control]
        for axis in range(at.shape[0]):
            e = COLUMN.axes + 3 * axis
            ex, ey, ez = F(numbers[e]), F(numbers[e + 1]), F(numbers[e + 2])
            for lane in range(x.shape[1]):
                px = x[row, lane] + origins[0, np.uintp(start) + np.uintp(lane)]
                py = x[row + 1, lane] + origins[1, np.uintp(start) + np.uintp(lane)]
                pz = x[row + 2, lane] + origins[2, np.uintp(start) + np.uintp(lane)]
                at[axis, lane] = scale * (ex * px + ey * py + ez * pz) + middle
        for lane in range(x.shape[1]):
            at[0, lane] -= drift[lane]
        gradient_noise(noise, at, first, gust_cells, seed)
        for axis in range(at.shape[0]):
            e = COLUMN.axes + axis
            e0, e1, e2 = F(numbers[e]), F(numbers[e + 3]), F(numbers[e + 6])
            for lane in range(x.shape[1]):
                wind[3 * control + axis, lane] = (
                    e0 * (swell[lane] + along * noise[0, lane])
                    + e1 * across * noise[1, lane]
                    + e2 * up * noise[2, lane]
                )


@borrowing_kernel
def add_wind_velocities(
    g: Any, x: Any, v: Any, body: Any, wind: Any, gusts: Any, number: Any, dt: Any
) -> None:
    """g += dt/m · F of one wind, whose velocity at the control particles is `wind` [3C, L].

    Waves blow along the normal of each face; their phases are in the rows of `wind` after the
    controls. v may be the same array as g.
    """
    faces, inv_mass, pressure = body.faces, body.inv_mass, gusts.numbers[number, COLUMN.pressure]
    sines, cosines, first = gusts.sines[number], gusts.cosines[number], 3 * body.controls.size
    tiny = x.dtype.type(1e-30)
    for i in range(inv_mass.size):
        if inv_mass[i] == 0:
            continue
        p, q = 3 * np.intp(faces.controls[i, 0]), 3 * np.intp(faces.controls[i, 1])
        r, s = 3 * np.intp(faces.controls[i, 2]), 3 * np.intp(faces.controls[i, 3])
        wp, wq = faces.weights[i, 0], faces.weights[i, 1]
        wr, ws = faces.weights[i, 2], faces.weights[i, 3]
        push = x.dtype.type(dt * inv_mass[i] * pressure)
        for lane in range(0, x.shape[1], lane_count(x)):
            nx, ny, nz = vector_area(x, faces, i, lane)
            head_on = fill(x.dtype.type(0))
            for axis in range(3):
                flow = wp * load(wind, p + axis, lane)
                if wq != 0:
                    flow = flow + wq * load(wind, q + axis, lane)
                if wr != 0:
                    flow = flow + wr * load(wind, r + axis, lane)
                if ws != 0:
                    flow = flow + ws * load(wind, s + axis, lane)
                along = nx if axis == 0 else ny if axis == 1 else nz
                head_on = head_on + along * (flow - load(v, 3 * i + axis, lane))
            area = sqrt(nx * nx + ny * ny + nz * nz) + tiny
            for wave in range(sines.shape[0]):
                row = first + 2 * wave
                blown = sines[wave, i] * load(wind, row, lane)
                blown = blown + cosines[wave, i] * load(wind, row + 1, lane)
                head_on = head_on + area * blown
            add(g, 3 * i, lane, push * head_on / area, nx, ny, nz)


@borrowing_kernel
def vector_area(x: Any, faces: Any, i: Any, lane: Any) -> tuple[float, float, float]:
    """The vector area of the faces around particle i; see `faces.Faces`."""
    nx = ny = nz = fill(x.dtype.type(0))
    for side in range(faces.begin[i], faces.begin[i + 1]):
        a, b = 3 * np.intp(faces.sides[side, 0]), 3 * np.intp(faces.sides[side, 1])
        c, d = 3 * np.intp(faces.sides[side, 2]), 3 * np.intp(faces.sides[side, 3])
        share = faces.shares[side]
        px, qx = load(x, b, lane) - load(x, a, lane), load(x, d, lane) - load(x, c, lane)
        py = load(x, b + 1, lane) - load(x, a + 1, lane)
        qy = load(x, d + 1, lane) - load(x, c + 1, lane)
        pz = load(x, b + 2, lane) - load(x, a + 2, lane)
        qz = load(x, d + 2, lane) - load(x, c + 2, lane)
        nx = nx + share * (py * qz - pz * qy)
        ny = ny + share * (pz * qx - px * qz)
        nz = nz + share * (px * qy - py * qx)
    return nx, ny, nz


@borrowing_kernel
def frame_velocity(mean: Any, v: Any, pins: Any) -> None:
    """Mean velocity of the pins, into mean [3, L]; 0 if there are none."""
    for axis in range(mean.shape[0]):
        for lane in range(v.shape[1]):
            mean[axis, lane] = 0
        for p in range(pins.size):
            part = v.dtype.type(1 / pins.size)
            for lane in range(v.shape[1]):
                mean[axis, lane] += part * v[3 * pins[p] + axis, lane]


@borrowing_kernel
def subtract_frame(g: Any, v: Any, mean: Any) -> None:
    """g = v - mean."""
    for row in range(v.shape[0]):
        for lane in range(0, v.shape[1], lane_count(v)):
            store(g, row, lane, load(v, row, lane) - load(mean, row % 3, lane))


@borrowing_kernel
def filter_by_products(both: Any, filter: Any, pins: Any) -> None:
    """both[1] = W both[0], pins at 0; both [2, 3N, L]; both[0] is overwritten. See `Filter`."""
    for row in range(3 * pins.size):
        for lane in range(both.shape[2]):
            both[0, 3 * pins[row // 3] + row % 3, lane] = 0
            both[1, 3 * pins[row // 3] + row % 3, lane] = 0
    for p in range(filter.products.shape[0]):
        begin, size, base, stride, source = filter.products[p]
        rows, out, ahead = both[source], both[1 - source], 3 * stride
        for row in range(3 * size):
            to = 3 * (base + row // 3 * stride) + row % 3
            part = filter.matrices[begin + row // 3 * size : begin + (row // 3 + 1) * size]
            for lane in range(0, both.shape[2], lane_count(both)):
                total = other = fill(both.dtype.type(0))
                at = 3 * base + row % 3
                for i in range(0, size - 1, 2):
                    total = total + part[i] * load(rows, at, lane)
                    other = other + part[i + 1] * load(rows, at + ahead, lane)
                    at += 2 * ahead
                if size % 2 == 1:
                    total = total + part[size - 1] * load(rows, at, lane)
                store(out, to, lane, total + other)
    for p in range(filter.release.shape[1]):
        for axis in range(3):
            for lane in range(both.shape[2]):
                both[0, 3 * p + axis, lane] = both[1, 3 * pins[p] + axis, lane]
    for row in range(both.shape[1]):
        for p in range(filter.release.shape[1]):
            part = filter.release[row // 3, p]
            for lane in range(both.shape[2]):
                both[1, row, lane] += part * both[0, 3 * p + row % 3, lane]


@borrowing_kernel
def filter_by_band(both: Any, filter: Any, pins: Any) -> None:
    """Forward and backward substitution; see `filters.BandFilter`."""
    free, back = filter.lower.shape
    for row in range(3 * pins.size):
        for lane in range(both.shape[2]):
            both[1, 3 * pins[row // 3] + row % 3, lane] = 0
    for row in range(3 * free):
        i, axis = row // 3, row % 3
        to, at = both[1, 3 * filter.order[i] + axis], both[0, 3 * filter.order[i] + axis]
        for lane in range(to.size):
            to[lane] = filter.mass[i] * at[lane]
        for k in range(max(0, back - i), back):
            part = filter.lower[i, k]
            if part != 0:
                other = both[1, 3 * filter.order[i - back + k] + axis]
                for lane in range(to.size):
                    to[lane] -= part * other[lane]
    for row in range(3 * free - 1, -1, -1):
        i, axis = row // 3, row % 3
        to = both[1, 3 * filter.order[i] + axis]
        for lane in range(to.size):
            to[lane] *= filter.inverse[i]
        for below in range(i + 1, min(free, i + back + 1)):
            part = filter.lower[below, back - below + i]
            if part != 0:
                # The rows below are solved already: L' subtracts their part from this row.
                other = both[1, 3 * filter.order[below] + axis]
                for lane in range(to.size):
                    to[lane] -= part * other[lane]


@borrowing_kernel
def no_correction(g: Any, x: Any, v: Any, spin: Any, work: Any) -> None:
    """For cloths with pins."""


@borrowing_kernel
def subtract_spin(g: Any, x: Any, v: Any, spin: Any, work: Any) -> None:
    """work: [12 or more, L]."""
    F = x.dtype.type
    for row in range(12):
        for lane in range(x.shape[1]):
            work[row, lane] = F(0)
    middle, gain = work[0:3], work[3:6]
    for row in range(x.shape[0]):
        part = F(spin.mass[row // 3] / spin.total)
        for lane in range(x.shape[1]):
            middle[row % 3, lane] += part * x[row, lane]
    for i in range(spin.mass.size):
        m = spin.mass[i]
        for lane in range(x.shape[1]):
            rx = x[3 * i, lane] - middle[0, lane]
            ry = x[3 * i + 1, lane] - middle[1, lane]
            rz = x[3 * i + 2, lane] - middle[2, lane]
            dx = g[3 * i, lane] - v[3 * i, lane]
            dy = g[3 * i + 1, lane] - v[3 * i + 1, lane]
            dz = g[3 * i + 2, lane] - v[3 * i + 2, lane]
            gain[0, lane] += m * (ry * dz - rz * dy)
            gain[1, lane] += m * (rz * dx - rx * dz)
            gain[2, lane] += m * (rx * dy - ry * dx)
            work[6, lane] += m * (ry * ry + rz * rz)
            work[7, lane] += m * (rz * rz + rx * rx)
            work[8, lane] += m * (rx * rx + ry * ry)
            work[9, lane] -= m * rx * ry
            work[10, lane] -= m * ry * rz
            work[11, lane] -= m * rz * rx
    if spin.exact:
        for lane in range(x.shape[1]):
            turn_rate(gain, work, lane)
    for i in range(spin.mass.size):
        # Exact: v -= ω x r. The paper: v -= dt/m L x r, where dt/m stands for 1/I.
        part = F(1 if spin.exact else spin.dt / spin.mass[i])
        for lane in range(x.shape[1]):
            rx = part * (x[3 * i, lane] - middle[0, lane])
            ry = part * (x[3 * i + 1, lane] - middle[1, lane])
            rz = part * (x[3 * i + 2, lane] - middle[2, lane])
            g[3 * i, lane] -= gain[1, lane] * rz - gain[2, lane] * ry
            g[3 * i + 1, lane] -= gain[2, lane] * rx - gain[0, lane] * rz
            g[3 * i + 2, lane] -= gain[0, lane] * ry - gain[1, lane] * rx


@borrowing_kernel
def turn_rate(gain: Any, work: Any, lane: Any) -> None:
    """gain = I⁻¹ gain by Cramer's rule; 0 where the particles lie on a line and I is singular."""
    a, b, c = work[6, lane], work[7, lane], work[8, lane]
    d, e, f = work[9, lane], work[10, lane], work[11, lane]
    p, q, r = b * c - e * e, e * f - c * d, d * e - b * f
    s, t, u = a * c - f * f, d * f - a * e, a * b - d * d
    size = a * p + d * q + f * r
    x, y, z = gain[0, lane], gain[1, lane], gain[2, lane]
    singular = size <= gain.dtype.type(1e-5) * a * b * c
    rate = gain.dtype.type(0) if singular else gain.dtype.type(1) / size
    gain[0, lane] = (p * x + q * y + r * z) * rate
    gain[1, lane] = (q * x + s * y + t * z) * rate
    gain[2, lane] = (r * x + t * y + u * z) * rate


@borrowing_kernel
def add_uniform(g: Any, mean: Any, inv_mass: Any, numbers: Any, push: Any, start: Any) -> None:
    """g += mean + dt (gravity + push), then implicit drag: a fall's speed tends to g / drag.

    mean: [3, L]. numbers: dt, drag, time, gravity (3). push: accelerations [3N, B] of all cloths,
    or empty.
    """
    F = g.dtype.type
    dt, slow = F(numbers[0]), F(1 / (1 + numbers[0] * numbers[1]))
    for row in range(g.shape[0]):
        if inv_mass[row // 3] == 0:
            continue
        fall = F(numbers[0] * numbers[3 + row % 3])
        for lane in range(0, g.shape[1], lane_count(g)):
            speed = load(g, row, lane)
            if push.size > 0:
                speed = speed + dt * load(push, row, start + lane)
            store(g, row, lane, (speed + load(mean, row % 3, lane) + fall) * slow)


@borrowing_kernel
def move(x: Any, u: Any, old: Any, dt: Any) -> None:
    """old = x; x += dt u."""
    for row in range(x.shape[0]):
        for lane in range(0, x.shape[1], lane_count(x)):
            here = load(x, row, lane)
            store(old, row, lane, here)
            store(x, row, lane, here + dt * load(u, row, lane))


@borrowing_kernel
def place_pins(x: Any, old: Any, pins: Any, targets: Any, step: Any, start: Any) -> None:
    """Move pins to targets [steps, 3P, B] or [steps, 3P, 1]; [0, ...] leaves them in place."""
    for row in range(3 * pins.size):
        at = 3 * pins[row // 3] + row % 3
        for lane in range(x.shape[1]):
            if targets.shape[0] == 0:
                x[at, lane] = old[at, lane]
            elif targets.shape[2] > 1:
                x[at, lane] = targets[step, row, np.uintp(start) + np.uintp(lane)]
            else:
                x[at, lane] = targets[step, row, 0]


@borrowing_kernel
def set_velocities(v: Any, x: Any, old: Any, dt: Any) -> None:
    """v = (x - old) / dt; components below MIN_SPEED become 0."""
    still, rate = x.dtype.type(MIN_SPEED), x.dtype.type(1 / dt)
    for row in range(x.shape[0]):
        for lane in range(0, x.shape[1], lane_count(x)):
            speed = (load(x, row, lane) - load(old, row, lane)) * rate
            store(v, row, lane, flush_denormals(speed, still))
