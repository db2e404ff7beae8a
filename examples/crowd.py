"""A world of banners: near ones are simulated finely, far ones coarsely, the farthest stand still.

A banner's colour shows its level of detail.
"""

import sys
from itertools import product
from pathlib import Path

import numpy as np

from drapery.cloth import Detail, Gravity, Wind, World, grid
from drapery.packs import open_packs
from drapery.render import Material, Model, Scene, TextureLayer, View, backend, frame_points
from drapery.style import cover_crowd, make_shell

COLOURS = (196, 62, 52), (232, 170, 60), (70, 110, 170)
SIZE = (480, 320)


def main(folder: Path, side: int = 24, seconds: float = 2.0) -> None:
    cloth = grid(5, 9, 0.8, 1.6)
    places = np.array([(1.4 * x, 0.0, -1.8 * z) for x, z in product(range(side), repeat=2)])
    world = World(
        forces=lambda at: (Gravity(), Wind((1.0, 0.0, 5.0), origins=at)),
        detail=Detail(full=12.0, half=24.0),
    )
    world.add(cloth, places)
    for _ in range(round(seconds / world.dt)):
        world.step(np.array([0.7 * side, 0.0, 4.0]))

    wool = open_packs(()).texture("minecraft:block/white_wool")
    materials = tuple(Material((TextureLayer(wool, colour),)) for colour in COLOURS)
    shell, models, points = make_shell(cloth.triangles, cloth.uvs), [], []
    for view in world.shown():
        points.append(view.positions + view.places[:, None])
        mesh = cover_crowd(shell, points[-1], 0.04)
        models.append(Model(mesh, materials, view.levels.astype(np.int32)))
    camera = frame_points(View(15, 22, 30), np.concatenate(points), SIZE[0] / SIZE[1])
    scene = Scene(tuple(models), camera, SIZE, background=(222, 230, 236, 255), samples=4)
    backend()(scene).save(folder / "crowd.png")


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "."))
