"""Contact, judged by ipctk: `python -m benchmarks.contact`.

Each case is stepped and judged after every step, or every K steps with `--every K`: whether
triangles of the cloth intersect each other or those of a box (ipctk's exact test), and how deep its
particles are in a collider. Then the cost of a step with and without contact is timed, on one
thread. `--steps` is the number of steps of each case, `--case` chooses cases by a part of their
name. Times are those of the processor. ipctk comes with
`pip install ".[bench]"`; only benchmarks use it.
"""

import argparse
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from math import cos, radians, sin
from time import process_time
from typing import Any

import numpy as np
from rich.console import Console
from rich.table import Table

from benchmarks.quick import add_quick, is_installed
from drapery.cloth import (
    Box,
    Cloth,
    Collider,
    Collisions,
    Force,
    Gravity,
    MovingCloth,
    PinPath,
    Plane,
    SolverXPBD,
    State,
    Wind,
    grid,
    sew,
)
from drapery.cloth.colliders.check import sample_distances
from drapery.cloth.solvers.registry import solver
from drapery.mesh import Array
from drapery.scenes import cape, skirt
from drapery.stage.gait import Gait
from drapery.style.figure import TEXEL

UNIT = 1 / 24
"""A texel of a banner [m]."""
DT = 1 / 60
SPEEDS, ANGLES = (0, 4, 10, 20), tuple(range(0, 360, 45))
GRIDS = ((5, 9), (11, 21), (21, 41))
TURN = 120
"""The wind of a banner changes after so many steps."""
SQUARES, STACK = 50, 10
WINDS = {"behind": Wind((1.4, 0.0, 3.7)), "front": Wind((1.4, 0.0, -3.7))}
"""From behind, the wind blows the cloth off its pole; from the front, onto it."""


@dataclass(frozen=True)
class Case:
    """Cloth that meets something. forces: by the number of the step. colliders: judged.
    hem: whether faces with two pinned particles are not judged against boxes: the waist of a skirt
    is pinned, and the legs below it turn into it."""

    name: str
    moving: MovingCloth
    forces: Callable[[int], list[Force]]
    colliders: tuple[Collider, ...]
    pins: PinPath | None = None
    hem: bool = False


@dataclass(frozen=True)
class Verdict:
    """steps: made. judged: how many of them. itself, boxes: after how many of these triangles of
    the cloth intersect each other, and those of boxes. deepest: particle in a collider [m], below 0
    outside. ms: a step."""

    name: str
    steps: int
    judged: int
    itself: int
    boxes: int
    deepest: float
    ms: float


def frame_of(placement: str) -> tuple[Collider, ...]:
    """Pole, bar, wall and ground of a banner whose top edge is at the origin."""
    bar = Collider(Box(np.array([0, -1, -1.5]) * UNIT, np.array([20, 2, 2]) * UNIT))
    if placement == "standing":
        pole = Collider(Box(np.array([0, -23, -1.5]) * UNIT, np.array([2, 42, 2]) * UNIT))
        return pole, bar, floor(-44 * UNIT)
    wall = Collider(Plane(np.array([0, 0, -3 * UNIT]), np.array([0, 0, 1.0])))
    return bar, wall, floor(-44.5 * UNIT)


def floor(height: float) -> Collider:
    return Collider(Plane(np.array([0, height, 0]), np.array([0, 1.0, 0])))


def winds(number: int) -> list[Force]:
    """Gravity and a wind of each speed from all sides in turn."""
    turn = number // TURN
    speed, angle = SPEEDS[turn // len(ANGLES) % len(SPEEDS)], radians(ANGLES[turn % len(ANGLES)])
    return [Gravity(), Wind((speed * sin(angle), 0.0, speed * cos(angle)), gusts=0.4)]


def banner(
    placement: str, shape: tuple[int, int], contact: str = "world", method: str = "desbrun"
) -> Case:
    cloth, met = grid(*shape, 20 * UNIT, 40 * UNIT), frame_of(placement)
    collisions = Collisions(met, UNIT, apart=UNIT if contact == "all" else None)
    moving = MovingCloth.begin(cloth, solver(method), collisions=collisions)
    name = f"banner, {placement}, {shape[0]} x {shape[1]}, {contact}"
    return Case(name if method == "desbrun" else f"{name}, {method}", moving, winds, met)


def storm() -> Case:
    cloth, met = grid(33, 65, 20 * UNIT, 40 * UNIT), frame_of("standing")
    collisions = Collisions(met, UNIT, apart=UNIT)
    moving = MovingCloth.begin(cloth, solver("xpbd"), collisions=collisions)
    wind = Wind((0.0, 0.0, 15.0), gusts=0.4)
    return Case("banner, 33 x 65, xpbd, 15 m/s", moving, lambda number: [Gravity(), wind], met)


def squares(count: int, shape: tuple[int, int], side: float, gap: float) -> tuple[Cloth, State]:
    """Squares above each other as one cloth, each turned and shifted a little."""
    one = grid(*shape, side, side, pins="none")
    cloth = sew([one] * count)
    random = np.random.default_rng(0)
    places = []
    for number in range(count):
        angle = random.uniform(0, 2 * np.pi) if gap > 0.03 else 0.0
        x, z = one.rest_positions[:, 0], one.rest_positions[:, 1] + side / 2
        shift = random.uniform(-0.1, 0.1, 2) if gap > 0.03 else (0.0, 0.0)
        turned = x * cos(angle) - z * sin(angle) + shift[0], x * sin(angle) + z * cos(angle)
        places.append(np.stack([turned[0], 0 * x + gap * (number + 1), turned[1] + shift[1]], 1))
    positions = np.concatenate(places)[None]
    return cloth, State(positions, np.zeros_like(positions))


def heap() -> Case:
    cloth, start = squares(SQUARES, (7, 7), 0.5, 0.06)
    met = (floor(0.0),)
    collisions = Collisions(met, 0.02, apart=0.02)
    moving = MovingCloth.begin(cloth, solver("xpbd"), DT, start=start, collisions=collisions)
    return Case("50 falling squares", moving, lambda number: [Gravity()], met)


def stack() -> Case:
    cloth, start = squares(STACK, (21, 41), 1.0, 0.025)
    met = (floor(0.0),)
    collisions = Collisions(met, 0.02, apart=0.02, threads=1)
    moving = MovingCloth.begin(cloth, solver("xpbd"), DT, start=start, collisions=collisions)
    return Case("10 stacked, 21 x 41", moving, lambda number: [Gravity()], met)


def runner(garment: str) -> Case:
    """A cape or a skirt on a runner."""
    gait = Gait(5.0)
    if garment == "cape":
        sewn = cape.cape_cloth(cape.CapeParameters())
    else:
        sewn = skirt.skirt_cloth(skirt.SkirtParameters())
    cloth, met = sewn.cloth, gait.colliders(sewn.solid or ())
    collisions = Collisions(met, TEXEL, order=3, apart=TEXEL / 2)
    start = State(sewn.start[None], np.zeros_like(sewn.start)[None])
    moving = MovingCloth.begin(cloth, None, 1 / 120, start=start, collisions=collisions)
    wind = Wind((0.0, 0.0, -5.5), period=4.0)
    forces: list[Force] = [Gravity(), wind]
    pins, hem = sewn.pin_path(gait.poses), garment == "skirt"
    return Case(f"{garment} on a runner", moving, lambda number: forces, met, pins, hem)


def cases() -> Iterator[Callable[[], Case]]:
    for contact in ("world", "all"):
        for placement in ("standing", "wall"):
            for shape in GRIDS:
                yield partial(banner, placement, shape, contact)
    for placement in ("standing", "wall"):
        yield partial(banner, placement, (16, 31), "all", "xpbd")
    yield storm
    yield heap
    yield stack
    yield partial(runner, "cape")
    yield partial(runner, "skirt")


def depth_in(positions: Array, cloth: Cloth, collider: Collider, time: float) -> float:
    """How deep the particles are in a collider [m]; below 0 outside."""
    pose = collider.path(time)
    local = np.einsum("ji,nj->ni", pose.rotation, positions - pose.position)
    free = cloth.inv_mass > 0
    return -float(sample_distances(collider.packed, np.ascontiguousarray(local[free])).min())


def judged(case: Case, steps: int, every: int) -> Verdict:
    """Step a case and judge it after every so many steps."""
    moving, judge = case.moving, Judge(case)
    itself, boxes, deepest, spent = 0, 0, -np.inf, 0.0
    for number in range(0, steps, every):
        forces = case.forces(number)
        start = process_time()
        moving = moving.advance(forces, every, case.pins)
        spent += (process_time() - start) * (number > 0)
        positions, time = moving.state.positions[0].astype(float), moving.state.time
        crosses = judge.crosses_itself(positions)
        itself += crosses
        boxes += not crosses and judge.crosses_boxes(positions, time)
        depths = [depth_in(positions, moving.cloth, c, time) for c in case.colliders]
        deepest = max(deepest, *depths)
    count = len(range(0, steps, every))
    ms = spent / max(1, count - 1) / every * 1e3
    return Verdict(case.name, count * every, count, itself, boxes, deepest, ms)


class Judge:
    """Whether the triangles of a cloth intersect each other, or those of boxes, by ipctk."""

    def __init__(self, case: Case) -> None:
        import ipctk

        self._ipctk: Any = ipctk
        cloth = case.moving.cloth
        faces = np.asarray(cloth.triangles, int)
        self._alone = self._mesh(cloth.rest_positions, faces)
        if case.hem:
            faces = faces[(cloth.inv_mass[faces] == 0).sum(axis=1) < 2]
        self._boxes = []
        for collider in case.colliders:
            if isinstance(collider.shape, Box):
                corners, sides = box_triangles(collider.shape)
                rest = np.concatenate([cloth.rest_positions, corners])
                both = np.concatenate([faces, sides + len(cloth.inv_mass)])
                self._boxes.append((collider.path, corners, self._mesh(rest, both)))

    def _mesh(self, positions: Array, faces: Array) -> Any:
        return self._ipctk.CollisionMesh(positions, self._ipctk.edges(faces), faces)

    def crosses_itself(self, positions: Array) -> bool:
        return bool(self._ipctk.has_intersections(self._alone, positions))

    def crosses_boxes(self, positions: Array, time: float) -> bool:
        """Whether cloth that does not cross itself crosses a box at a time [s]."""
        for path, corners, mesh in self._boxes:
            pose = path(time)
            placed = np.einsum("ij,nj->ni", pose.rotation, corners) + pose.position
            if self._ipctk.has_intersections(mesh, np.concatenate([positions, placed])):
                return True
        return False


def box_triangles(box: Box) -> tuple[Array, Array]:
    """The surface of a box: corners [8, 3] and triangles [12, 3]."""
    signs = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    faces = np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])
    return box.centre + signs * (box.size / 2), faces


def cost(shape: tuple[int, int], name: str, contact: str, wind: Wind) -> float:
    """Milliseconds a step of a banner on its pole, on one thread, 60 steps in a call."""
    cloth = grid(*shape, 20 * UNIT, 40 * UNIT)
    met = Collisions(
        frame_of("standing"), UNIT, apart=UNIT if contact == "all" else None, threads=1
    )
    method = type(solver(name))(threads=1)  # type: ignore[call-arg]
    moving = MovingCloth.begin(cloth, method, collisions=None if contact == "none" else met)
    moving = moving.advance([Gravity(), wind], 60)
    best = np.inf
    for _ in range(5):
        start = process_time()
        moving = moving.advance([Gravity(), wind], 60)
        best = min(best, (process_time() - start) / 60)
    return best * 1e3


def crowd(count: int, contact: str, wind: Wind) -> float:
    """Steps a second of many banners on their poles, with xpbd of 3 substeps, on two threads: from
    the processor's time, as if no other program ran."""
    cloth = grid(5, 9, 20 * UNIT, 40 * UNIT)
    met = Collisions(frame_of("standing"), UNIT)
    moving = MovingCloth.begin(
        cloth, SolverXPBD(3, threads=2), count=count, collisions=None if contact == "none" else met
    )
    forces: list[Force] = [Gravity(), wind]
    moving = moving.advance(forces, 30)
    best = np.inf
    for _ in range(3):
        start = process_time()
        moving.advance(forces, 10)
        best = min(best, process_time() - start)
    return 2 * 10 / best


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--steps", type=int, default=100_000)
    parser.add_argument("--every", type=int, default=1, help="steps between two judgements")
    parser.add_argument("--case", default="", help="only cases whose name contains this")
    parser.add_argument("--no-cost", action="store_true", help="do not time steps")
    add_quick(parser)
    chosen = parser.parse_args()
    quick, steps = chosen.quick, 3 if chosen.quick else chosen.steps
    console = Console(width=110)
    for make in cases() if is_installed("ipctk") else ():
        case = make()
        if chosen.case in case.name:
            v = judged(case, steps, chosen.every)
            console.print(
                f"{v.name}: {v.steps} steps; of {v.judged} judged, crosses itself after {v.itself} "
                f"and a box after {v.boxes}; deepest {v.deepest * 1e3:.2f} mm; {v.ms:.2f} ms a step"
            )
    if chosen.no_cost:
        return
    table = Table("solver", "grid", "wind", "without [ms]", "world", "all")
    for name in ("desbrun", "xpbd"):
        for shape in GRIDS[:1] if quick else GRIDS:
            for side, wind in WINDS.items():
                off, world, both = (cost(shape, name, c, wind) for c in ("none", "world", "all"))
                ratios = f"{world / off:.2f} x", f"{both / off:.2f} x"
                table.add_row(name, f"{shape[0]} x {shape[1]}", side, f"{off:.3f}", *ratios)
    console.print(table)
    for side, wind in WINDS.items():
        count = 8 if quick else 4913
        off, world = (crowd(count, contact, wind) for contact in ("none", "world"))
        console.print(f"{count} banners, {side}: {world:.0f} steps/s, {off:.0f} without contact")


if __name__ == "__main__":
    main()
