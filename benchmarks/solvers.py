"""How the solvers differ: `python -m benchmarks.solvers [--json FILE] [--sheet PICTURE]`.

One table of speed, stretch and damping at default settings, and a sheet of pictures of every
solver hanging, blowing, swinging, sagging and falling on a ball. Times are the least of a few
runs; beside other work only their ratios mean something.
"""

import argparse
import json
import time
from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from itertools import islice
from pathlib import Path

import numpy as np
import trimesh
from rich.console import Console
from rich.table import Table

from benchmarks.quick import add_quick
from drapery.arrays import Pixels
from drapery.cloth import (
    Cloth,
    Drag,
    Gravity,
    State,
    Wind,
    grid,
    max_stretch,
    rest_state,
    simulate,
)
from drapery.cloth.colliders import Collider, Plane, Sphere
from drapery.cloth.collisions import Collisions
from drapery.cloth.solvers.registry import SOLVERS, solver
from drapery.mesh import Array, Mesh, vertex_normals
from drapery.render.contact import contact_table
from drapery.render.frame import Frame
from drapery.render.scene import Material, Model, Scene, TextureLayer
from drapery.render.soft import draw_scene
from drapery.render.views import View, frame_points
from drapery.style.extrusion import make_shell

DT = 1 / 60
SIZE = (1.25, 2.5)
BALL = Sphere(np.array([0, -0.25, 0]), 0.4)
FLOOR = -0.85


@dataclass(frozen=True)
class Row:
    """The results of one solver.

    Times are for a step of 1/60 s [ms]; stretch is a fraction of the rest length; energy_left: the
    fraction of a swinging curtain's energy that is left after 5 s without air.
    """

    solver: str
    small_ms: float
    batch_ms: float
    fine_ms: float
    stretch_hanging: float
    stretch_in_gale: float
    energy_left: float


def measure(name: str) -> Row:
    """Measure all values of one solver."""
    return Row(
        name,
        step_ms(name, grid(5, 9, *SIZE), 1, 200),
        step_ms(name, grid(5, 9, *SIZE), 512, 10),
        step_ms(name, grid(21, 41, *SIZE), 1, 20),
        stretch(name, 0.0),
        stretch(name, 12.0),
        energy_left(name),
    )


def step_ms(name: str, cloth: Cloth, count: int, steps: int) -> float:
    """The time of a step of `count` cloths in wind, on one thread [ms]."""
    method, state = solver(name, threads=1), rest_state(cloth, count)
    solver_state, forces = method.init(cloth, DT), [Gravity(), Wind((0.0, 0.0, 4.0))]
    times = []
    for _ in range(5):
        start = time.perf_counter()
        state, solver_state = method.step(cloth, state, solver_state, forces, DT, steps=steps)
        times.append(time.perf_counter() - start)
    return 1000 * min(times[1:]) / steps


def stretch(name: str, speed: float) -> float:
    """The largest stretch of a 21 x 41 banner after 2 s in wind of this speed [m/s]."""
    cloth = grid(21, 41, *SIZE)
    forces = [Gravity(), Drag(0.1), Wind((0.3 * speed, 0.0, 0.95 * speed))]
    states = simulate(cloth, solver(name), forces, DT, every=6)
    return max(max_stretch(state.positions, cloth) for state in islice(states, 20, 80))


def energy_left(name: str) -> float:
    """The fraction of energy left after 5 s without air; the curtain starts at 30 degrees."""
    cloth = grid(11, 21, *SIZE)
    start = leaning(cloth, 30)
    states = islice(simulate(cloth, solver(name), [Gravity()], DT, start=start, every=300), 2)
    first, last = (energy(cloth, state) for state in states)
    lowest = energy(cloth, rest_state(cloth))
    return (last - lowest) / (first - lowest)


def energy(cloth: Cloth, state: State) -> float:
    """Kinetic and potential energy over mass [J/kg]."""
    free = cloth.inv_mass > 0
    x, v = state.positions[0, free].astype(float), state.velocities[0, free].astype(float)
    return float((0.5 * (v * v).sum(axis=1) + 9.81 * x[:, 1]).mean())


def leaning(cloth: Cloth, degrees: float) -> State:
    """A hanging cloth swung forwards about its top edge."""
    state = rest_state(cloth)
    sine, cosine = np.sin(np.radians(degrees)), np.cos(np.radians(degrees))
    x, y, z = np.moveaxis(state.positions, -1, 0)
    places = np.stack([x, cosine * y + sine * z, cosine * z - sine * y], axis=-1)
    return replace(state, positions=places.astype(np.float32))


def level(cloth: Cloth, height: float) -> State:
    """A horizontal cloth at a height [m]."""
    state = rest_state(cloth)
    places = state.positions[..., [0, 2, 1]] * np.array([1, 1, -1], np.float32)
    places = places - places.mean(axis=1, keepdims=True)
    places[..., 1] += height
    return replace(state, positions=places)


def at(seconds: float, cloth: Cloth, name: str, *forces: object, **options: object) -> Array:
    """The positions after a time, shape [N, 3]."""
    states = simulate(
        cloth,
        solver(name),
        forces,
        DT,
        every=round(seconds / DT),
        **options,  # type: ignore[arg-type]
    )
    return next(islice(states, 1, None)).positions[0]


def pictures(name: str, size: int) -> list[Pixels]:
    """A solver's row of the sheet."""
    banner, square = grid(11, 21, *SIZE), grid(20, 20, 1.4, 1.4, pins="none")
    hammock = grid(14, 14, 1.4, 1.4, pins="four-corners")
    slack = level(hammock, 0.0)
    slack = replace(slack, positions=slack.positions * np.float32(0.9))
    floor = Collider(Plane(np.array([0, FLOOR, 0]), np.array([0.0, 1, 0])), friction=0.5)
    on_ball = Collisions([Collider(BALL, friction=0.5), floor], 0.03, order=2)
    start = leaning(banner, 40)
    swing = [at(t, banner, name, Gravity(), start=start) for t in (0.6, 1.2)]
    dropped = level(square, 0.4)
    return [
        draw(banner, at(3, banner, name, Gravity(), Drag(0.5)), size, FRONT),
        draw(banner, at(4, banner, name, Gravity(), Wind((2.0, 0.0, 6.0))), size, FRONT),
        draw(banner, swing[0], size, FRONT),
        draw(banner, swing[1], size, BACK),
        draw(hammock, at(4, hammock, name, Gravity(), Drag(1.0), start=slack), size, ABOVE),
        draw(
            square,
            at(2.5, square, name, Gravity(), Drag(1.0), start=dropped, collisions=on_ball),
            size,
            ABOVE,
            ball_model(),
        ),
    ]


ACROSS = ("hanging", "wind", "swinging", "later", "hammock", "ball")
HANGING, LAID = View(50, 8, 30), View(35, 25, 30)
FRONT = HANGING, np.array([[-0.65, -2.5, -0.1], [0.65, 0.05, 1.9]])
BACK = HANGING, np.array([[-0.65, -2.3, -2.2], [0.65, 0.05, 0.1]])
ABOVE = LAID, np.array([[-0.6, -0.65, -0.6], [0.6, 0.2, 0.6]])


def draw(
    cloth: Cloth, places: Array, size: int, shot: tuple[View, Array], *others: Model
) -> Pixels:
    """Draw a thick cloth, with a checkerboard of its grid cells, and other models."""
    shell = make_shell(cloth.triangles, cloth.uvs)
    mesh = shell.cover(places, vertex_normals(places, cloth.triangles), 0.025)
    worn = Model(mesh, (Material((TextureLayer(checks(*(cloth.grid_shape or (2, 2)))),)),))
    view, room = shot
    camera = frame_points(view, np.stack(np.meshgrid(*room.T), axis=-1), 1.0, 0.02)
    background = (226, 232, 238, 255)
    scene = Scene((worn, *others), camera, (size, size), background=background, samples=16)
    return draw_scene(scene).pixels


def checks(rows: int, columns: int) -> Pixels:
    """A checkerboard texture with one texel for each grid cell."""
    light = np.add.outer(np.arange(rows - 1), np.arange(columns - 1)) % 2 == 0
    colours = np.array([[176, 46, 38, 255], [229, 148, 60, 255]], np.uint8)
    return np.ascontiguousarray(colours[light.astype(int)])


def ball_model() -> Model:
    """A model of the ball with the same shape as the collider."""
    ball = trimesh.creation.icosphere(subdivisions=3, radius=BALL.radius)
    places = (ball.vertices + BALL.centre).astype(np.float32)
    triangles = np.asarray(ball.faces, np.int32)
    normals, uvs = vertex_normals(places, triangles), np.zeros((len(places), 2))
    grey = np.full((1, 1, 4), (110, 120, 132, 255), np.uint8)
    return Model(Mesh(places, normals, triangles, uvs), (Material((TextureLayer(grey),)),))


def sheet(size: int) -> Frame:
    """All solvers' pictures."""
    rows = [pictures(name, size) for name in SOLVERS]
    return contact_table(ACROSS, tuple(SOLVERS), [picture for row in rows for picture in row])


def show(rows: Sequence[Row]) -> None:
    columns = (
        ("solver", "{}"),
        ("5 x 9 [ms]", "{:.3f}"),
        ("512 of 5 x 9 [ms]", "{:.2f}"),
        ("21 x 41 [ms]", "{:.2f}"),
        ("stretch, hanging", "{:.2%}"),
        ("in 12 m/s", "{:.2%}"),
        ("energy after 5 s", "{:.0%}"),
    )
    lines = Table(title="Solvers at default settings, a step of 1/60 s on one thread")
    for heading, _ in columns:
        lines.add_column(heading, justify="left" if heading == "solver" else "right")
    for row in rows:
        values = asdict(row).values()
        lines.add_row(*(form.format(v) for (_, form), v in zip(columns, values, strict=True)))
    Console(width=110).print(lines)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--json", type=Path, help="write the rows to this file")
    parser.add_argument("--sheet", type=Path, help="draw the sheet to this file")
    parser.add_argument("--size", type=int, default=180, help="of a picture in pixels")
    add_quick(parser)
    options = parser.parse_args()
    if options.sheet:
        sheet(options.size).save(options.sheet)
    names = ["xpbd"] if options.quick else [*SOLVERS]
    rows = [measure(name) for name in names]
    show(rows)
    if options.json:
        options.json.write_text(json.dumps([asdict(row) for row in rows], indent=1))


if __name__ == "__main__":
    main()
