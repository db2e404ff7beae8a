"""Writes the creatures that cloth falls on as 3-D files: `python -m assets.drawing.creatures`."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from assets.drawing.beetle import beetle
from assets.drawing.fox import CUBE, fox
from drapery.banner.packs import open_packs
from drapery.render.export import save_scenes
from drapery.render.scene import Model, Scene
from drapery.render.views import frame_view
from drapery.style.block_world import blocks

FILES = Path(__file__).parents[2] / "drapery" / "garments" / "files"


def creatures() -> dict[str, tuple[Model, ...]]:
    """The models of each creature, by the name of its file; each stands over the origin [m]."""
    return {"beetle": beetle(), "fox": _small(blocks(fox(), open_packs(())))}


def _small(cubes: tuple[Model, ...]) -> tuple[Model, ...]:
    """Blocks made as small as the cubes of the fox."""
    aside = np.array([CUBE / 2, 0.0, 0.0])
    return tuple(
        replace(model, mesh=replace(model.mesh, positions=model.mesh.positions * CUBE - aside))
        for model in cubes
    )


def main() -> None:
    """Write all files."""
    for name, models in creatures().items():
        points = np.concatenate([model.mesh.positions for model in models])
        scene = Scene(models, frame_view("hero", points, 1.0), (64, 64))
        save_scenes(scene, FILES / f"{name}.glb")


if __name__ == "__main__":
    main()
