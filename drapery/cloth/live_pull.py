"""Pulls on a played cloth: accelerations that move a particle and those near it to a target."""

from typing import Any

import numpy as np

from drapery.jit import kernel

EASE = 0.35
"""The share of the distance to its target that a pulled particle moves in a time step."""
MAX_MOTION = 0.2
"""The longest distance that a pull moves a particle in a time step [m]."""
PULL_RADIUS = 0.045
"""A pull moves all particles within this distance along the cloth [m]."""
MAX_STRETCH = 0.99
"""A pull stays nearer to each pin than this share of the cloth between them."""
PROJECTIONS = 48
"""The most projections of the target of a pull on what the cloth can reach."""


@kernel
def pull(live: Any, batch: Any) -> Any:
    """Accelerations that move the pulled particles towards the target, into live.push; returns how
    many of its rows hold any.

    A pulled particle gets the velocity that takes it a share of the way in this step. What the
    cloth cannot follow, the solver takes back.
    """
    if live.grab[0] < 0:
        live.grab[1] = -1
        return 0
    if live.grab[1] != live.grab[0]:
        grab_around(live, batch)
    x, y, z = reachable(live, batch)
    dt = live.dt[0]
    for i in range(live.around.size):
        px = x + live.offsets[i, 0] - batch.x[3 * i, 0]
        py = y + live.offsets[i, 1] - batch.x[3 * i + 1, 0]
        pz = z + live.offsets[i, 2] - batch.x[3 * i + 2, 0]
        length = np.sqrt(px * px + py * py + pz * pz)
        share = live.around[i] * min(EASE, MAX_MOTION / max(length, MAX_MOTION)) / dt
        change = px, py, pz
        for axis in range(3):
            for lane in range(live.push.shape[1]):
                gain = (share * change[axis] - live.around[i] * batch.v[3 * i + axis, 0]) / dt
                live.push[3 * i + axis, lane] = live.push.dtype.type(gain)
    return live.push.shape[0]


@kernel
def grab_around(live: Any, batch: Any) -> None:
    """Begin a pull at the particle that the host wants."""
    held = live.grab[1] = live.grab[0]
    for i in range(live.around.size):
        dx = live.rest[i, 0] - live.rest[held, 0]
        dy = live.rest[i, 1] - live.rest[held, 1]
        dz = live.rest[i, 2] - live.rest[held, 2]
        near = np.sqrt(dx * dx + dy * dy + dz * dz) <= PULL_RADIUS
        live.around[i] = 1 if near else 0
        for axis in range(3):
            place = np.float64(batch.x[3 * i + axis, 0])
            live.offsets[i, axis] = place - np.float64(batch.x[3 * held + axis, 0])
    for p in range(live.pins.size):
        live.around[live.pins[p]] = 0


@kernel
def reachable(live: Any, batch: Any) -> Any:
    """The target, or a point near it that is in reach of all pins.

    A pin can be no further away than the length of the flat cloth between pin and particle.
    The target is repeatedly projected onto the ball about the pin whose limit it exceeds most.
    """
    x, y, z = live.target[0], live.target[1], live.target[2]
    held = live.grab[1]
    for _ in range(PROJECTIONS):
        worst, excess, part = -1, 0.0, 1.0
        for p in range(live.pins.size):
            pin = live.pins[p]
            dx = live.rest[pin, 0] - live.rest[held, 0]
            dy = live.rest[pin, 1] - live.rest[held, 1]
            dz = live.rest[pin, 2] - live.rest[held, 2]
            longest = MAX_STRETCH * np.sqrt(dx * dx + dy * dy + dz * dz)
            ax, ay, az = place_of(batch, pin)
            px, py, pz = x - ax, y - ay, z - az
            distance = np.sqrt(px * px + py * py + pz * pz)
            if distance - longest > excess:
                worst, excess, part = pin, distance - longest, longest / distance
        if worst < 0:
            break
        ax, ay, az = place_of(batch, worst)
        x, y, z = ax + (x - ax) * part, ay + (y - ay) * part, az + (z - az) * part
    return x, y, z


@kernel
def place_of(batch: Any, i: Any) -> Any:
    """Where a particle of the first cloth is [m]."""
    F = np.float64
    return F(batch.x[3 * i, 0]), F(batch.x[3 * i + 1, 0]), F(batch.x[3 * i + 2, 0])
