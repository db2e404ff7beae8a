"""Sheets of drawn pictures: all rotations of one design, one design with many packs."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from drapery.banner.design import Banner
from drapery.banner.packs import open_packs
from drapery.pictures import draw, draw_face, draw_scenes
from drapery.render import Frame, frame_view
from drapery.scenes.stager import still
from drapery.settings import ROTATIONS, Settings
from drapery.sheets.sheet import PictureSheet, SheetCell

COMPASS = {0: "south", 4: "west", 8: "north", 12: "east"}


def rotations_sheet(design: Banner | None, settings: Settings) -> PictureSheet:
    """All sixteen rotations, by one camera. Raises OptionError, PackError or BackendError."""
    cells = tuple(
        SheetCell(f"{number} {COMPASS.get(number, '')}".rstrip(), frame.pixels)
        for number, frame in enumerate(_rotations(design, settings))
    )
    return PictureSheet("Sixteen rotations", cells, 8)


def _rotations(design: Banner | None, settings: Settings) -> list[Frame]:
    packs = open_packs(settings.packs, format=settings.format)
    turned = [replace(settings, rotation=rotation) for rotation in range(ROTATIONS)]
    scenes = [still(design, packs, each) for each in turned]
    meshes = [model.mesh for scene in scenes for model in scene.models]
    points = np.concatenate([mesh.positions.reshape(-1, 3) for mesh in meshes])
    camera = frame_view(settings.view, points, settings.size[0] / settings.size[1])
    return list(draw_scenes([replace(scene, camera=camera) for scene in scenes], packs, settings))


def packs_sheet(
    banner: Banner, paths: Sequence[str | Path], settings: Settings, *, scale: int | None = None
) -> PictureSheet:
    """One design with our own art, and with each pack alone, drawn by the settings.

    scale: draws plain faces instead; it is the width of a texel of a 64 x 64 pack [pixels].
    Raises OptionError, PackError or BackendError.
    """
    stacks: list[tuple[str, tuple[str | Path, ...]]] = [("our own art", ())]
    stacks += [(Path(path).name or str(path), (path,)) for path in paths]
    cells = []
    for name, packs in stacks:
        if scale is None:
            frame = draw(banner, replace(settings, packs=packs))
        else:
            frame = draw_face(banner, packs=packs, format=settings.format, scale=scale)
        cells.append(SheetCell(name, frame.pixels))
    return PictureSheet("One design over many packs", tuple(cells), min(len(cells), 6))
