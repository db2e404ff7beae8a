"""How fabrics drape and flags flap: `python -m benchmarks.fabrics [--rings N] [--sheet FILE]`.

Drape: Cusick's test (J. Textile Inst. 56 and 59, 1965 and 1968; ISO 9073-9). A disc of 30 cm lies
on a support of 18 cm. The drape coefficient is the shadow of its rim over the area of the flat rim.
The coefficient grows with the bending length, and the edge falls in folds, the nodes; their
number varies when the same fabric is laid again (Jeong, J. Textile Inst. 89, 1998; Kenkare,
May-Plumlee, "Mechanics of fabric drape", 2004). See `PUBLISHED` for the figures.

Flapping: a flag without gravity in a steady wind along it. Published flags begin to flap above an
onset speed. Heavy flags in air flap in a low mode near the resonance of a pivoted wing, so the
frequency grows with the speed, and lighter flags flap faster (Argentina, Mahadevan, PNAS 102,
2005). The amplitude stays below the flag's length. A flag is flown in the default pressure of a
`Wind`, which is proportional to the speed, and in that of a slender wing, which is proportional to
its square as in a wind tunnel.
"""

import argparse
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial import Delaunay

from benchmarks.quick import add_quick
from drapery.banner import read_design
from drapery.cloth import (
    FABRICS,
    Cloth,
    Gravity,
    MovingCloth,
    SolverXPBD,
    Wind,
    from_triangles,
    grid,
    rest_state,
)
from drapery.mesh import Array
from drapery.packs import open_packs
from drapery.render import Frame
from drapery.render.contact import contact_table
from drapery.render.soft import draw_scene
from drapery.scenes import still
from drapery.settings import Settings

RADIUS, SUPPORT = 0.15, 0.09
"""Of the disc and of what it lies on [m]."""
AIR = 3.0
"""Drag that brings the disc to rest [1/s]."""
NUDGE = 1e-3
"""Rms of the heights at the start [m]; a disc that is exactly level has no place to fold."""


PUBLISHED: dict[str, tuple[int, int]] = {"silk": (20, 40), "cotton": (48, 72), "leather": (47, 70)}
"""Drape coefficients [%]: woven silk (Matsudaira, Yang, Textile Research J. 73, 2003), plain weaves
of cotton ("Analysis of a fabric drape profile", Fibres and Textiles 1/2018; Gan, Ly, Steven, J.
Textile Inst. 82, 1991, measure 68), sheep leather for garments (Memon et al., Materials 14, 2021).
Read in collections of reference data, not in the papers."""
NODES = 5, 8
"""Of 37 fabrics (Fibres and Textiles 1/2018)."""
STROUHAL = 0.2, 0.4
"""Frequency · width of the stroke / speed of heavy flags, as of swimming and flying animals
(Shelley, Vandenberghe, Zhang, PRL 94, 2005; Taylor, Nudds, Thomas, Nature 425, 2003)."""
AIR_DENSITY = 1.2
"""[kg/m³]"""
PAPER = replace(FABRICS["cotton"], density=0.080, bending=1.315e-4)
"""Paper of 0.080 kg/m² and 1.315e-4 N m, of which the measured flags were made."""
PAPER_AIR = 1.089
"""Where they were measured, 800 m above the sea [kg/m³]."""
ONSETS: dict[float, tuple[float, float]] = {
    0.06: (9.1, 17.5),
    0.08: (7.0, 8.9),
    0.10: (6.0, 8.3),
    0.13: (6.5, 7.0),
    0.16: (4.4, 7.0),
}
"""Length of a flag [m], and the least and the highest speed [m/s] at which it began to flap in 3 to
6 runs (J. D'Adamo, tables datos_flutter_uonset.csv and caracteriza_papel.ipynb of the public
repository juandadamo/2024_flags, wind tunnel of the Instituto Balseiro, 2024). The flags stood at
the edge of the tunnel's jet, in still air on one side, so the speed is the mean of both sides, as
in the tables' own evaluation."""
BEGUN = 0.02
"""A flag flaps if its free end moves this part of its length to each side."""

SHOWN = ("silk", "wool", "leather")
LOOK: dict[str, Any] = {"view": "hero", "size": (250, 310), "samples": 4, "time": 4.0}
PLACES: dict[str, dict[str, Any]] = {
    "4 m/s": {"wind": 4.0},
    "7 m/s": {"wind": 7.0},
    "7 m/s, onto the pole": {"wind": 7.0, "direction": 180.0},
    "7 m/s, on a wall": {"wind": 7.0, "placement": "wall"},
}


@dataclass(frozen=True)
class Drape:
    """A disc at rest. coefficient: 0 hangs straight down, 1 is flat. nodes: folds of its edge."""

    coefficient: float
    nodes: int


def round_cloth(fabric: str, rings: int) -> Cloth:
    """A disc held on its support. Its rings are not multiples of six, so folds are free."""
    points = [np.zeros((1, 2))]
    for ring in range(1, rings + 1):
        count = round(2 * np.pi * ring)
        angles = 2 * np.pi * (np.arange(count) + 0.618 * ring) / count
        points.append(RADIUS * ring / rings * np.stack([np.cos(angles), np.sin(angles)], axis=1))
    flat = np.concatenate(points)
    rest = np.stack([flat[:, 0], np.zeros(len(flat)), -flat[:, 1]], axis=1)
    held = np.flatnonzero((flat * flat).sum(axis=1) <= (1.001 * SUPPORT) ** 2)
    faces = Delaunay(flat).simplices.astype(np.int32)
    return from_triangles(rest, faces, pins=held, fabric=FABRICS[fabric], uvs=flat)


def drape(fabric: str, rings: int = 10, seed: int = 1, seconds: float = 4.0) -> Drape:
    """A disc of a fabric after it has come to rest on its support."""
    cloth = replace(round_cloth(fabric, rings), drag=AIR)
    start = rest_state(cloth)
    free = cloth.inv_mass > 0
    start.positions[0, free, 1] += NUDGE * np.random.default_rng(seed).standard_normal(free.sum())
    moving = MovingCloth.begin(cloth, SolverXPBD(), start=start)
    places = moving.advance([Gravity()], round(60 * seconds)).state.positions[0]
    edge = places[-round(2 * np.pi * rings) :, [0, 2]].astype(np.float64)
    flat = cloth.rest_positions[-len(edge) :, [0, 2]]
    rim = [abs(_area(ring)) - np.pi * SUPPORT**2 for ring in (edge, flat)]
    return Drape(rim[0] / rim[1], _nodes(edge))


def _area(ring: Array) -> float:
    """The signed area within a closed line [m²], shape [N, 2]."""
    after = np.roll(ring, -1, axis=0)
    return float((ring[:, 0] * after[:, 1] - ring[:, 1] * after[:, 0]).sum() / 2)


def _nodes(edge: Array) -> int:
    """Maxima of the distance from the axis, of waves of at least an eighteenth of the edge."""
    waves = np.fft.rfft(np.sqrt((edge * edge).sum(axis=1)))
    waves[19:] = 0
    away = np.fft.irfft(waves, len(edge))
    top = (away > np.roll(away, 1)) & (away >= np.roll(away, -1)) & (away > away.mean())
    return int(top.sum())


@dataclass(frozen=True)
class Flapping:
    """Of a flag's free end. amplitude: over the flag's length. frequency: [Hz]."""

    amplitude: float
    frequency: float


def slender_pressure(speed: float) -> float:
    """The pressure of a `Wind` that gives a flag the force of a slender wing [N s/m³].

    Jones (NACA report 835, 1946): the normal force is ½ ρ U² · (π/2) A · slope per area, where A is
    the aspect ratio, here ½. speed: U [m/s].
    """
    return AIR_DENSITY / 2 * np.pi / 2 / 2 * speed


def flap(fabric: str, speed: float, pressure: float, *, seconds: float = 12.0) -> Flapping:
    """A flag held by one edge in a steady wind along it, in the second half of the time.

    It is 1 m long and half as high. speed: [m/s]. pressure: of the `Wind` [N s/m³].
    """
    length = 1.0
    columns, rows = 21, 11
    cloth = grid(
        columns,
        rows,
        length,
        length / 2,
        pins=lambda rest: rest[:, 0] <= rest[:, 0].min() + 1e-9,
        fabric=FABRICS[fabric],
    )
    start = rest_state(cloth, dtype=np.float64)
    along = (cloth.rest_positions[:, 0] - cloth.rest_positions[0, 0]) / length
    start.positions[0, :, 2] += 0.02 * length * along * along
    wind = Wind((speed, 0, 0), gusts=0, sine=0, pressure=pressure)
    moving, tip = MovingCloth.begin(cloth, SolverXPBD(), start=start), []
    for _ in range(round(60 * seconds)):
        moving = moving.advance([wind])
        tip.append(moving.state.positions[0, rows // 2 * columns + columns - 1, 2])
    late = np.array(tip[len(tip) // 2 :])
    power = np.abs(np.fft.rfft((late - late.mean()) * np.hanning(len(late)), 8 * len(late)))
    frequency = (1 + int(power[1:].argmax())) * 60 / (8 * len(late))
    return Flapping(float(np.ptp(late)) / 2 / length, frequency)


def paper_swing(length: float, speed: float, *, columns: int = 17, dt: float = 1 / 600) -> float:
    """How far the free end of a square flag of paper swings over its length, after a second of
    wind along it in the pressure of a slender wing.

    length: [m]. speed: [m/s]. Its height was not published; with half of it
    flags of all lengths begin to flap at 4 to 14 m/s.
    """
    step = length / (columns - 1)
    cloth = grid(
        columns,
        columns,
        length,
        length,
        pins=lambda rest: rest[:, 0] <= rest[:, 0].min() + 1.5 * step,  # clamped
        fabric=PAPER,
    )
    start, along = rest_state(cloth, dtype=np.float64), cloth.rest_positions[:, 0]
    start.positions[0, :, 2] += 0.02 / length * np.maximum(along - along.min() - step, 0) ** 2
    wind = Wind((speed, 0, 0), gusts=0, sine=0, pressure=PAPER_AIR / 2 * np.pi / 2 * speed)
    moving = MovingCloth.begin(cloth, SolverXPBD(), dt, start=start)
    moving, tip = moving.advance([wind], round(1.1 / dt)), []
    for _ in range(round(0.4 / dt)):
        moving = moving.advance([wind])
        tip.append(moving.state.positions[0, columns // 2 * columns + columns - 1, 2])
    return float(np.ptp(tip)) / 2 / length


def onset(length: float) -> float:
    """The speed at which a flag of paper begins to flap [m/s], within 3 %. length: [m]."""
    low, high = 1.0, 24.0
    while high > 1.06 * low:
        middle = np.sqrt(low * high)
        flaps = paper_swing(length, middle) > BEGUN
        low, high = (low, middle) if flaps else (middle, high)
    return float(np.sqrt(low * high))


def sheet() -> Frame:
    """Banners of three fabrics in the hero view, in several winds and places."""
    design, packs = read_design("white creeper:lime border:black"), open_packs()
    pictures = [
        draw_scene(still(design, packs, Settings(fabric=name, **LOOK, **place))).pixels
        for name in SHOWN
        for place in PLACES.values()
    ]
    return contact_table(tuple(PLACES), SHOWN, pictures)


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rings", type=int, default=15)
    parser.add_argument("--sheet", type=Path, help="only draw banners of fabrics to this file")
    add_quick(parser)
    options = parser.parse_args()
    if options.sheet:
        sheet().save(options.sheet)
        return
    quick = options.quick
    rings, speeds = (3, (4.0,)) if quick else (options.rings, (0.25, 0.5, 1.0, 2.0, 4.0, 8.0))
    print(f"Cusick's test, {rings} rings, three times: drape coefficient [%], nodes")
    for name, fabric in FABRICS.items():
        bent = 100 * np.cbrt(fabric.bending / (fabric.density * 9.81))
        found = [drape(name, rings, seed) for seed in ((1,) if quick else (1, 2, 3))]
        shares = ", ".join(f"{100 * each.coefficient:.0f} %" for each in found)
        nodes = ", ".join(str(each.nodes) for each in found)
        print(f"  {name:8} bending length {bent:.1f} cm: {shares}; nodes {nodes}{_published(name)}")
    print(f"nodes of published fabrics: {NODES[0]} to {NODES[1]}")
    print("flag of 1 x 0.5 m: amplitude over length, frequency [Hz], frequency · length / speed,")
    print(f"Strouhal number (published: {STROUHAL[0]} to {STROUHAL[1]})")
    for name in ("wool",) if quick else ("wool", "cotton", "silk"):
        for speed in speeds:
            for kind, pressure in (
                ("default", Wind.pressure),
                ("slender wing", slender_pressure(speed)),
            ):
                print(f"  {name:8} {speed:4} m/s, {kind}: {_flapping(name, speed, pressure)}")
    if quick:
        print(f"a flag of paper swings by {paper_swing(0.1, 8.0, columns=5):.3f} of its length")
        return
    print("flags of paper begin to flap at [m/s]")
    for length, (low, high) in ONSETS.items():
        print(f"  {100 * length:3.0f} cm: {onset(length):.1f} (measured: {low} to {high})")


def _published(name: str) -> str:
    if name not in PUBLISHED:
        return ""
    low, high = PUBLISHED[name]
    return f" (published: {low} to {high} %)"


def _flapping(name: str, speed: float, pressure: float) -> str:
    found = flap(name, speed, pressure)
    amplitude, rate = found.amplitude, found.frequency
    strouhal = 2 * amplitude * rate / speed
    return f"{amplitude:.3f}, {rate:.2f}, {rate / speed:.2f}, {strouhal:.2f}"


if __name__ == "__main__":
    main()
