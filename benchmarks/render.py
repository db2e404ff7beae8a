"""How fast scenes become pictures: `python -m benchmarks.render [--quick] [--json FILE]`.

Every workload is drawn by our own rasteriser and, where OpenGL starts, by pyrender; the two take
turns frame by frame, so that whatever else the machine does meets both. Times are medians. Run it
on a quiet machine: beside other work, only the ratios mean something.
"""

import argparse
import json
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from functools import partial
from itertools import cycle, islice
from pathlib import Path

import numpy as np
from rich.console import Console
from rich.table import Table

from benchmarks.quick import add_quick
from drapery.banner.design import Banner, Layer
from drapery.banner.packs import open_packs
from drapery.banner.patterns import PATTERN_NAMES
from drapery.cloth import Cloth, Gravity, Wind, grid, rest_state, simulate
from drapery.errors import BackendError
from drapery.mesh import Array, Mesh, vertex_normals
from drapery.render.encode import save_animation
from drapery.render.frame import Frame
from drapery.render.scene import Material, Model, Scene, TextureLayer
from drapery.render.soft import draw_scene
from drapery.render.views import frame_view
from drapery.render.workers import worker_count
from drapery.style.block import FLAG_MAPPING, FLAG_SIZE, SCALE
from drapery.style.crowds import cover_crowd
from drapery.style.extrusion import Shell, make_shell
from drapery.style.layers import flag_material

Draw = Callable[..., Frame]

DYES = ("red", "orange", "yellow", "lime", "cyan", "blue", "purple", "magenta")
SIX = Banner("white", tuple(Layer(p, d) for p, d in zip(PATTERN_NAMES[1:7], DYES, strict=False)))


@dataclass(frozen=True)
class Row:
    """One measurement, as `--json` writes it.

    workload: the name of its function: one banner at 512 x 512, or 4913 at 1280 x 720.
    """

    workload: str
    backend: str
    layers: str
    threads: int
    ms_per_frame: float
    frames_per_s: float


def row(workload: str, backend: str, layers: str, threads: int, seconds: float) -> Row:
    return Row(workload, backend, layers, threads, round(seconds * 1e3, 3), round(1 / seconds, 2))


def opengl() -> Draw | None:
    """pyrender's renderer, or None if OpenGL does not start."""
    try:
        from drapery.render import gl

        gl.describe()
    except BackendError as error:
        print(f"pyrender is not measured: {error}")
        return None
    return gl.draw_scene


def measure(draws: dict[str, Draw], scenes: Sequence[Scene], seconds: float) -> dict[str, float]:
    """Median time of a frame for each renderer [s]; each is measured for about `seconds`."""
    times: dict[str, list[float]] = {name: [] for name in draws}
    for draw in draws.values():
        for scene in scenes[:2]:
            draw(scene)
    for scene in cycle(scenes):
        for name, draw in draws.items():
            start = time.perf_counter()
            draw(scene)
            times[name].append(time.perf_counter() - start)
        if sum(map(sum, times.values())) > seconds * len(draws):
            break
    return {name: float(np.median(taken)) for name, taken in times.items()}


def compare(
    workload: str, layers: str, scenes: Sequence[Scene], gl: Draw | None, seconds: float
) -> list[Row]:
    """Compare our rasteriser on one thread and on all threads with pyrender."""
    draws: dict[str, Draw] = {"soft 1": partial(draw_scene, threads=1)}
    if worker_count() > 1:
        draws[f"soft {worker_count()}"] = draw_scene
    if gl:
        # OpenGL composites layers beforehand like our rasteriser, unless `stacked` is set.
        draws[f"pyrender {worker_count()}"] = partial(gl, stacked=layers == "stacked")
    taken = measure(draws, scenes, seconds)
    return [
        row(workload, name.split()[0], layers, int(name.split()[1]), time)
        for name, time in taken.items()
    ]


def swaying(cloth: Cloth, phases: Array, time: float) -> Array:
    """Sheets [B, N, 3] in an artificial wave: new vertices without the cost of a simulation."""
    rest = cloth.rest_positions
    bend = np.sin(4 * rest[:, 1] + 3 * rest[:, 0] + phases[:, None] + time) * -rest[:, 1]
    out = np.stack([0 * bend, 0 * bend, 0.12 * bend], axis=-1)
    return (rest + out).astype(np.float32)


def flag(columns: int, rows: int) -> tuple[Cloth, Shell]:
    cloth = grid(columns, rows, *FLAG_SIZE)
    return cloth, make_shell(cloth.triangles, cloth.uvs, FLAG_MAPPING)


def thick(cloth: Cloth, shell: Shell, sheets: Array) -> Mesh:
    return shell.cover(sheets, vertex_normals(sheets, cloth.triangles), SCALE)


def one_banner(layers: str) -> list[Scene]:
    """Base and six layers on a thick 10 x 20 cloth, 512 x 512, new vertices in each frame."""
    cloth, shell = flag(10, 20)
    material = flag_material(SIX, open_packs(()), "stacked" if layers == "stacked" else "flat")
    meshes = [thick(cloth, shell, swaying(cloth, np.zeros(1), k / 3)[0]) for k in range(16)]
    camera = frame_view("front", np.stack([mesh.positions for mesh in meshes]), 1.0)
    return [Scene((Model(mesh, (material,)),), camera) for mesh in meshes]


def banner_to_png(seconds: float) -> list[Row]:
    """Time the way from a cloth state to a PNG file: thickness, drawing, encoding, writing."""
    cloth, shell = flag(10, 20)
    material = flag_material(SIX, open_packs(()))
    camera = one_banner("stacked")[0].camera
    states = [swaying(cloth, np.zeros(1), k / 3)[0] for k in range(16)]

    def frames(count: int) -> Iterator[Frame]:
        for sheet in islice(cycle(states), count):
            yield draw_scene(Scene((Model(thick(cloth, shell, sheet), (material,)),), camera))

    with tempfile.TemporaryDirectory() as folder:
        save_animation(frames(8), 20, Path(folder) / "warm")
        count = max(32, round(100 * seconds))
        start = time.perf_counter()
        save_animation(frames(count), 20, Path(folder) / "frames")
        taken = (time.perf_counter() - start) / count
    return [row("banner to PNG file", "soft", "stacked", worker_count(), taken)]


def crowd_looks() -> tuple[Material, ...]:
    """64 designs, each with a base and four layers."""
    random, packs = np.random.default_rng(0), open_packs(())
    designs = [
        Banner(
            str(random.choice(DYES)),
            tuple(
                Layer(str(random.choice(PATTERN_NAMES[1:])), str(d)) for d in random.choice(DYES, 4)
            ),
        )
        for _ in range(64)
    ]
    return tuple(flag_material(design, packs) for design in designs)


def crowd_places(side: int) -> Array:
    steps = np.arange(side) - (side - 1) / 2
    places = np.stack(np.meshgrid(steps, steps, steps, indexing="ij"), axis=-1).reshape(-1, 3)
    return (places * (1.2, 2.0, 1.2)).astype(np.float32)


def crowd(shape: str, side: int = 17) -> list[Scene]:
    """side³ banners at 1280 x 720: thick ones of 5 x 9 particles, or bare sheets of 11 x 11."""
    places, materials = crowd_places(side), crowd_looks()
    index = np.random.default_rng(1).integers(0, len(materials), len(places)).astype(np.int32)
    cloth, shell = flag(*((5, 9) if shape == "thick" else (11, 11)))
    scenes: list[Scene] = []
    for k in range(2):
        sheets = swaying(cloth, 0.7 * np.arange(len(places)), k / 3) + places[:, None]
        if shape == "thick":
            mesh = cover_crowd(shell, sheets, SCALE)
        else:
            normals = vertex_normals(sheets, cloth.triangles)
            mesh = Mesh(sheets, normals, cloth.triangles, FLAG_MAPPING.front(cloth.uvs))
        camera = scenes[0].camera if scenes else frame_view("hero", mesh.positions, 1280 / 720)
        scenes.append(Scene((Model(mesh, materials, index),), camera, (1280, 720)))
    return scenes


def crowd_simulated(seconds: float, side: int = 17) -> list[Row]:
    """Simulation, thickness and drawing of side³ thick 5 x 9 cloths, to raw frames."""
    places = crowd_places(side)
    scene = crowd("thick", side)[0]
    cloth, shell = flag(5, 9)
    wind = Wind((2.0, 0.0, 5.0))
    start = rest_state(cloth, len(places), np.float32)
    states = simulate(cloth, forces=(Gravity(), wind), dt=1 / 60, every=3, start=start)
    model, times = scene.models[0], []
    while sum(times) < seconds or len(times) < 5:
        begun = time.perf_counter()
        mesh = cover_crowd(shell, next(states).positions + places[:, None], SCALE)
        draw_scene(replace(scene, models=(replace(model, mesh=mesh),)))
        times.append(time.perf_counter() - begun)
    return [row("crowd, simulated", "soft", "flat", worker_count(), float(np.median(times[2:])))]


def growth(seconds: float, most: int) -> Iterator[tuple[str, float, float]]:
    """For each size: the name of the varied quantity, its value, and the time of a frame [s]."""
    scene = one_banner("flat")[0]
    for side in (256, 512, 1024, 2048):
        yield "pixels", side * side, _time(replace(scene, size=(side, side)), seconds)
    for side in (each for each in (3, 5, 7, 9, 11, 14, 17) if each <= most):
        many = crowd("thick", side)[0]
        count = len(many.models[0].mesh.triangles) * side**3
        yield "triangles", count, _time(many, seconds)
    noise = np.random.default_rng(0)
    # Layers of unequal sizes cannot be composited beforehand, so every sample blends all layers.
    layers = [TextureLayer(noise.integers(0, 256, (61 + k, 64, 4), np.uint8)) for k in range(17)]
    for count in (1, 2, 4, 8, 16):
        model = replace(scene.models[0], materials=(Material(tuple(layers[: count + 1])),))
        yield "layers a sample", count, _time(replace(scene, models=(model,)), seconds)


def _time(scene: Scene, seconds: float) -> float:
    return measure({"": draw_scene}, [scene], seconds)[""]


def show(rows: Sequence[Row], console: Console) -> None:
    table = Table(title="Time of a frame")
    for name in ("workload", "layers", "backend", "threads"):
        table.add_column(name)
    for name in ("ms a frame", "frames/s", "pyrender takes"):
        table.add_column(name, justify="right")
    for r in rows:
        rival = [o for o in rows if o.backend == "pyrender" and o.workload == r.workload]
        times = [o.ms_per_frame / r.ms_per_frame for o in rival if o.layers == r.layers]
        ratio = f"{times[0]:.1f} x" if times and r.backend == "soft" else ""
        speed = f"{r.ms_per_frame:.2f}", f"{r.frames_per_s:.1f}"
        table.add_row(r.workload, r.layers, r.backend, str(r.threads), *speed, ratio)
    console.print(table)


def show_growth(points: Sequence[tuple[str, float, float]], console: Console) -> None:
    """Show times and the cost of each additional unit, which is constant if growth is linear."""
    table = Table(title="Cost against size")
    for name in ("grows", "size", "ms a frame", "ns for each more"):
        table.add_column(name, justify="right")
    before: tuple[str, float, float] | None = None
    for what, size, taken in points:
        each = ""
        if before and before[0] == what:
            each = f"{(taken - before[2]) / (size - before[1]) * 1e9:.4g}"
        table.add_row(what, f"{size:.0f}", f"{taken * 1e3:.2f}", each)
        before = what, size, taken
    console.print(table)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    add_quick(parser)
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the rows there")
    options = parser.parse_args()
    seconds, side = (0.05, 3) if options.quick else (8.0, 17)
    gl, console = opengl(), Console()
    rows = []
    for layers in ("flat", "stacked"):
        rows += compare("banner", layers, one_banner(layers), gl, seconds)
    rows += banner_to_png(seconds)
    for shape in ("thick", "thin"):
        name = f"crowd, {shape}"
        rows += compare(name, "flat", crowd(shape, side), gl, seconds)
    rows += crowd_simulated(seconds, side)
    show(rows, console)
    show_growth(list(growth(seconds / 8, side)), console)
    if options.json:
        options.json.write_text(json.dumps([asdict(r) for r in rows], indent=2) + "\n")


if __name__ == "__main__":
    main()
