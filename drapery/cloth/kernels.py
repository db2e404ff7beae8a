"""The inner loops that the solvers share.

Arrays are [3N, L]: row 3i + axis holds one coordinate of particle i for L cloths of one topology
("lanes"), so every inner loop does the same to each cloth and is vectorised. Arithmetic is strict
IEEE in a fixed order (no fastmath): the same bits for any L, on any processor.
`error_model="numpy"` is needed: a division that may raise cannot be vectorised. Loops over three
axes have a bound that the compiler does not know, or it would unroll them and take thrice as long.
"""

from typing import Any

import numpy as np
from numba.extending import overload

from drapery.cloth import exact
from drapery.cloth.compiled import kernel
from drapery.cloth.filters import BandFilter
from drapery.cloth.spin import NoSpin
from drapery.cloth.wind import CROSSWIND

TINY = 1e-6
"""Springs count as at least this share of their rest length, so that coincident ends divide."""
STILL = 1e-9
"""Slower velocities [m/s] are flushed to 0: decaying motion would become subnormal, and slow."""
GUST_RMS = 0.1836
"""Rms of gradient noise whose gradients are uniform in [-1, 1]³, measured over 10⁷ points."""
ALONG, ACROSS, UP = CROSSWIND

sine_of_turns = kernel(exact.sine_of_turns)


@kernel
def take_lanes(y: Any, x: Any, start: Any) -> None:
    """Copy the lanes from `start` of x [3N, B] into the block y [3N, L]."""
    for row in range(y.shape[0]):
        for lane in range(y.shape[1]):
            y[row, lane] = x[row, np.uintp(start) + np.uintp(lane)]


@kernel
def give_lanes(x: Any, y: Any, start: Any) -> None:
    """Copy the block y [3N, L] to the lanes from `start` of x [3N, B]."""
    for row in range(y.shape[0]):
        for lane in range(y.shape[1]):
            x[row, np.uintp(start) + np.uintp(lane)] = y[row, lane]


@kernel
def add_spring_velocities(g: Any, x: Any, springs: Any, inv_mass: Any, dt: Any) -> None:
    """g += dt/m · F: a spring longer than its rest length pulls both ends together."""
    tiny = x.dtype.type(TINY)
    for s in range(springs.rest.size):
        i, j = springs.pairs[s, 0], springs.pairs[s, 1]
        length = springs.rest[s]
        least = length * tiny
        pull = dt * springs.stiffness[s]
        pull_i, pull_j = pull * inv_mass[i], pull * inv_mass[j]
        for lane in range(x.shape[1]):
            dx = x[3 * j, lane] - x[3 * i, lane]
            dy = x[3 * j + 1, lane] - x[3 * i + 1, lane]
            dz = x[3 * j + 2, lane] - x[3 * i + 2, lane]
            d = np.sqrt(dx * dx + dy * dy + dz * dz)
            strain = (d - length) / max(d, least)
            g[3 * i, lane] += pull_i * strain * dx
            g[3 * i + 1, lane] += pull_i * strain * dy
            g[3 * i + 2, lane] += pull_i * strain * dz
            g[3 * j, lane] -= pull_j * strain * dx
            g[3 * j + 1, lane] -= pull_j * strain * dy
            g[3 * j + 2, lane] -= pull_j * strain * dz


@kernel
def shorten(x: Any, links: Any) -> None:
    """Provot's correction: links over their longest length are pulled back to it, in order."""
    for s in range(links.longest.size):
        i, j = links.pairs[s, 0], links.pairs[s, 1]
        most = links.longest[s]
        part_i, part_j = links.share_i[s], links.share_j[s]
        for lane in range(x.shape[1]):
            dx = x[3 * j, lane] - x[3 * i, lane]
            dy = x[3 * j + 1, lane] - x[3 * i + 1, lane]
            dz = x[3 * j + 2, lane] - x[3 * i + 2, lane]
            d = max(np.sqrt(dx * dx + dy * dy + dz * dz), most)
            excess = (d - most) / d
            x[3 * i, lane] += part_i * excess * dx
            x[3 * i + 1, lane] += part_i * excess * dy
            x[3 * i + 2, lane] += part_i * excess * dz
            x[3 * j, lane] -= part_j * excess * dx
            x[3 * j + 1, lane] -= part_j * excess * dy
            x[3 * j + 2, lane] -= part_j * excess * dz


@kernel
def gradient_noise(out: Any, at: Any, first: Any, cells: Any, seed: Any, work: Any) -> None:
    """Three noises of unit rms at points `at` [3, L], into out [3, L].

    `first` [L] is added to the cell number along axis 0, which repeats after `cells`. The three
    share a cell's one random vector in three orders, so they are not correlated.
    """
    F = at.dtype.type
    one, count, scale = F(1), F(cells), F(1 / (127.5 * GUST_RMS))
    six, ten, fifteen, middle = F(6), F(10), F(15), F(127.5)
    for axis in range(at.shape[0]):
        for lane in range(at.shape[1]):
            # np.floor would keep the loop from being vectorised.
            cell = F(np.int32(at[axis, lane]))
            cell = cell - one if cell > at[axis, lane] else cell
            work[3 + axis, lane] = at[axis, lane] - cell
            work[axis, lane] = cell
            out[axis, lane] = 0
    for lane in range(at.shape[1]):
        cell = work[0, lane] + first[lane]
        turns = cell / count
        whole = F(np.int32(turns))
        work[0, lane] = cell - count * (whole - one if whole > turns else whole)
    for corner in range(8):
        di, dj, dk = F(corner & 1), F((corner >> 1) & 1), F(corner >> 2)
        for lane in range(at.shape[1]):
            i = work[0, lane] + di
            i = i if i < count else i - count
            h = np.uint32(np.uint32(np.int32(i)) * np.uint32(0x9E3779B1))
            h ^= np.uint32(np.uint32(np.int32(work[1, lane] + dj)) * np.uint32(0x27D4EB2F))
            h ^= np.uint32(np.uint32(np.int32(work[2, lane] + dk)) * np.uint32(0x165667B1))
            # The 32-bit finaliser of MurmurHash3 (Appleby 2011).
            h = np.uint32(h ^ seed)
            h = np.uint32(np.uint32(h ^ (h >> np.uint32(16))) * np.uint32(0x85EBCA6B))
            h = np.uint32(np.uint32(h ^ (h >> np.uint32(13))) * np.uint32(0xC2B2AE35))
            h = np.uint32(h ^ (h >> np.uint32(16)))
            x, y, z = work[3, lane] - di, work[4, lane] - dj, work[5, lane] - dk
            # Perlin's fade, 6 a⁵ - 15 a⁴ + 10 a³, on each axis.
            a, b, c = one - abs(x), one - abs(y), one - abs(z)
            weight = a * a * a * (a * (a * six - fifteen) + ten) * scale
            weight *= b * b * b * (b * (b * six - fifteen) + ten)
            weight *= c * c * c * (c * (c * six - fifteen) + ten)
            p = F(np.int32(h & np.uint32(255))) - middle
            q = F(np.int32((h >> np.uint32(8)) & np.uint32(255))) - middle
            r = F(np.int32((h >> np.uint32(16)) & np.uint32(255))) - middle
            out[0, lane] += weight * (p * x + q * y + r * z)
            out[1, lane] += weight * (q * x + r * y + p * z)
            out[2, lane] += weight * (r * x + p * y + q * z)


@kernel
def blow(
    wind: Any, x: Any, controls: Any, gusts: Any, number: Any, start: Any, time: Any, work: Any
) -> None:
    """Velocity of one wind on the lanes from `start` at the control particles, into wind [3C, L].

    work: [18, L] of the same type.
    """
    F = x.dtype.type
    numbers, seed = gusts.numbers[number], gusts.seeds[number]
    phases, origins = gusts.phases[number], gusts.origins[number]
    at, swell, drift, first, noise = work[6:9], work[9], work[10], work[11], work[12:15]
    for lane in range(x.shape[1]):
        now = time + phases[np.uintp(start) + np.uintp(lane)]
        swell[lane] = numbers[9] * (1 + numbers[10] * sine_of_turns(now * numbers[11]))
        cells = now * numbers[14]
        cells -= numbers[15] * np.floor(cells / numbers[15])
        first[lane] = -np.floor(cells)
        drift[lane] = cells - np.floor(cells)
    # Noise is 0 where all three coordinates are whole: keep the origin off such a place.
    middle, scale = F(0.5), F(numbers[13])
    along, across, up = F(numbers[12] * ALONG), F(numbers[12] * ACROSS), F(numbers[12] * UP)
    for control in range(controls.size):
        row = 3 * controls[control]
        for axis in range(at.shape[0]):
            ex, ey, ez = F(numbers[3 * axis]), F(numbers[3 * axis + 1]), F(numbers[3 * axis + 2])
            for lane in range(x.shape[1]):
                px = x[row, lane] + origins[0, np.uintp(start) + np.uintp(lane)]
                py = x[row + 1, lane] + origins[1, np.uintp(start) + np.uintp(lane)]
                pz = x[row + 2, lane] + origins[2, np.uintp(start) + np.uintp(lane)]
                at[axis, lane] = scale * (ex * px + ey * py + ez * pz) + middle
        for lane in range(x.shape[1]):
            at[0, lane] -= drift[lane]
        gradient_noise(noise, at, first, numbers[15], seed, work)
        for axis in range(at.shape[0]):
            e0, e1, e2 = F(numbers[axis]), F(numbers[3 + axis]), F(numbers[6 + axis])
            for lane in range(x.shape[1]):
                wind[3 * control + axis, lane] = (
                    e0 * (swell[lane] + along * noise[0, lane])
                    + e1 * across * noise[1, lane]
                    + e2 * up * noise[2, lane]
                )


@kernel
def add_wind_velocities(
    g: Any, x: Any, v: Any, faces: Any, wind: Any, pressure: Any, inv_mass: Any, dt: Any, work: Any
) -> None:
    """g += dt/m · F of one wind, whose velocity at the control particles is `wind` [3C, L].

    v may be g. work: [9 or more, L].
    """
    tiny = x.dtype.type(1e-30)
    part, normal, force = work[0], work[3:6], work[6:9]
    for i in range(inv_mass.size):
        if inv_mass[i] == 0:
            continue
        for side in range(faces.begin[i], faces.begin[i + 1]):
            a, b = 3 * faces.sides[side, 0], 3 * faces.sides[side, 1]
            c, d = 3 * faces.sides[side, 2], 3 * faces.sides[side, 3]
            share, keep = faces.shares[side], x.dtype.type(side > faces.begin[i])
            for lane in range(x.shape[1]):
                px, qx = x[b, lane] - x[a, lane], x[d, lane] - x[c, lane]
                py, qy = x[b + 1, lane] - x[a + 1, lane], x[d + 1, lane] - x[c + 1, lane]
                pz, qz = x[b + 2, lane] - x[a + 2, lane], x[d + 2, lane] - x[c + 2, lane]
                normal[0, lane] = keep * normal[0, lane] + share * (py * qz - pz * qy)
                normal[1, lane] = keep * normal[1, lane] + share * (pz * qx - px * qz)
                normal[2, lane] = keep * normal[2, lane] + share * (px * qy - py * qx)
        p, q = 3 * faces.controls[i, 0], 3 * faces.controls[i, 1]
        r, s = 3 * faces.controls[i, 2], 3 * faces.controls[i, 3]
        wp, wq, wr, ws = faces.weights[i]
        for axis in range(normal.shape[0]):
            for lane in range(x.shape[1]):
                force[axis, lane] = (
                    (wp * wind[p + axis, lane] + wq * wind[q + axis, lane])
                    + (wr * wind[r + axis, lane] + ws * wind[s + axis, lane])
                    - v[3 * i + axis, lane]
                )
        push = x.dtype.type(dt * inv_mass[i] * pressure)
        # Two loops: with more rows at once the compiler gives up telling them apart.
        for lane in range(x.shape[1]):
            nx, ny, nz = normal[0, lane], normal[1, lane], normal[2, lane]
            area = np.sqrt(nx * nx + ny * ny + nz * nz) + tiny
            head_on = nx * force[0, lane] + ny * force[1, lane] + nz * force[2, lane]
            part[lane] = push * head_on / area
        for axis in range(normal.shape[0]):
            for lane in range(x.shape[1]):
                g[3 * i + axis, lane] += part[lane] * normal[axis, lane]


@kernel
def frame_velocity(mean: Any, v: Any, pins: Any) -> None:
    """Mean velocity of the pins, into mean [3, L]; 0 if there are none."""
    for axis in range(mean.shape[0]):
        for lane in range(v.shape[1]):
            mean[axis, lane] = 0
        for p in range(pins.size):
            part = v.dtype.type(1 / pins.size)
            for lane in range(v.shape[1]):
                mean[axis, lane] += part * v[3 * pins[p] + axis, lane]


@kernel
def subtract_frame(g: Any, v: Any, mean: Any) -> None:
    """g = v - mean."""
    for row in range(v.shape[0]):
        for lane in range(v.shape[1]):
            g[row, lane] = v[row, lane] - mean[row % 3, lane]


def filter_velocities(both: Any, filter: Any, pins: Any) -> None:
    """both[1] = W both[0], pins at 0; both [2, 3N, L], of which both[0] is spoilt.

    By the filter's form: `filters.Filter` or `filters.BandFilter`.
    """


@overload(filter_velocities, inline="always")
def _filter_velocities(both: Any, filter: Any, pins: Any) -> Any:
    by_band = filter.instance_class is BandFilter
    chosen = filter_by_band if by_band else filter_by_products

    def implementation(both: Any, filter: Any, pins: Any) -> None:
        chosen(both, filter, pins)

    return implementation


@kernel
def filter_by_products(both: Any, filter: Any, pins: Any) -> None:
    """both[1] = W both[0], pins at 0; both [2, 3N, L], of which both[0] is spoilt. See `Filter`."""
    for row in range(3 * pins.size):
        for lane in range(both.shape[2]):
            both[0, 3 * pins[row // 3] + row % 3, lane] = 0
            both[1, 3 * pins[row // 3] + row % 3, lane] = 0
    for p in range(filter.products.shape[0]):
        begin, size, base, stride, source = filter.products[p]
        rows, out = both[source], both[1 - source]
        for row in range(3 * size):
            o, axis = row // 3, row % 3
            to = out[3 * (base + o * stride) + axis]
            part = filter.matrices[begin + o * size : begin + (o + 1) * size]
            for lane in range(to.size):
                to[lane] = 0
            for i in range(0, size - 3, 4):
                a, b, c, d = part[i], part[i + 1], part[i + 2], part[i + 3]
                at, step = 3 * (base + i * stride) + axis, 3 * stride
                w, x, y, z = rows[at], rows[at + step], rows[at + 2 * step], rows[at + 3 * step]
                for lane in range(to.size):
                    to[lane] += a * w[lane] + b * x[lane] + c * y[lane] + d * z[lane]
            for i in range(size // 4 * 4, size):
                a, w = part[i], rows[3 * (base + i * stride) + axis]
                for lane in range(to.size):
                    to[lane] += a * w[lane]
    for p in range(filter.release.shape[1]):
        for axis in range(3):
            for lane in range(both.shape[2]):
                both[0, 3 * p + axis, lane] = both[1, 3 * pins[p] + axis, lane]
    for row in range(both.shape[1]):
        for p in range(filter.release.shape[1]):
            part = filter.release[row // 3, p]
            for lane in range(both.shape[2]):
                both[1, row, lane] += part * both[0, 3 * p + row % 3, lane]


@kernel
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
                # Rows below are solved already: L' takes their share from this one.
                other = both[1, 3 * filter.order[below] + axis]
                for lane in range(to.size):
                    to[lane] -= part * other[lane]


def keep_spin(g: Any, x: Any, v: Any, spin: Any, work: Any) -> None:
    """Take from g the angular momentum that the filter has added to v; see `spin.Spin`."""


@overload(keep_spin, inline="always")
def _keep_spin(g: Any, x: Any, v: Any, spin: Any, work: Any) -> Any:
    chosen = leave_spin if spin.instance_class is NoSpin else subtract_spin

    def implementation(g: Any, x: Any, v: Any, spin: Any, work: Any) -> None:
        chosen(g, x, v, spin, work)

    return implementation


@kernel
def leave_spin(g: Any, x: Any, v: Any, spin: Any, work: Any) -> None:
    """For cloths with pins."""


@kernel
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


@kernel
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


@kernel
def add_uniform(g: Any, mean: Any, inv_mass: Any, numbers: Any, push: Any, start: Any) -> None:
    """g += mean + dt (gravity + push), then drag, implicitly: a fall's speed ends at g / drag.

    mean: [3, L]. numbers: dt, drag, time, gravity (3). push: accelerations [3N, B] of all cloths,
    or empty.
    """
    F = g.dtype.type
    dt, slow = F(numbers[0]), F(1 / (1 + numbers[0] * numbers[1]))
    for row in range(g.shape[0]):
        if inv_mass[row // 3] == 0:
            continue
        fall = F(numbers[0] * numbers[3 + row % 3])
        if push.size > 0:
            for lane in range(g.shape[1]):
                g[row, lane] += dt * push[row, np.uintp(start) + np.uintp(lane)]
        for lane in range(g.shape[1]):
            g[row, lane] = (g[row, lane] + mean[row % 3, lane] + fall) * slow


@kernel
def move(x: Any, u: Any, old: Any, dt: Any) -> None:
    """old = x; x += dt u."""
    for row in range(x.shape[0]):
        for lane in range(x.shape[1]):
            old[row, lane] = x[row, lane]
            x[row, lane] += dt * u[row, lane]


@kernel
def place_pins(x: Any, old: Any, pins: Any, targets: Any, step: Any, start: Any) -> None:
    """Pins go where their path leads, [steps, 3P, B] or [steps, 3P, 1], or stay ([0, ...])."""
    for row in range(3 * pins.size):
        at = 3 * pins[row // 3] + row % 3
        for lane in range(x.shape[1]):
            if targets.shape[0] == 0:
                x[at, lane] = old[at, lane]
            elif targets.shape[2] > 1:
                x[at, lane] = targets[step, row, np.uintp(start) + np.uintp(lane)]
            else:
                x[at, lane] = targets[step, row, 0]


@kernel
def set_velocities(v: Any, x: Any, old: Any, dt: Any) -> None:
    """v = (x - old) / dt, flushed to 0 below STILL."""
    still, none, rate = x.dtype.type(STILL), x.dtype.type(0), x.dtype.type(1 / dt)
    for row in range(x.shape[0]):
        for lane in range(x.shape[1]):
            speed = (x[row, lane] - old[row, lane]) * rate
            v[row, lane] = none if abs(speed) < still else speed
