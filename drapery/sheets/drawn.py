"""Sheets of drawn pictures: rotations of one design, many packs or styles, and garments."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from drapery.banner import write_banner
from drapery.banner.design import Banner
from drapery.banner.packs import open_packs
from drapery.errors import OptionError
from drapery.garments import dressed_player, find_garment, garment_names, make_wearer
from drapery.pictures import draw, draw_face, draw_scenes
from drapery.render import Frame, frame_view
from drapery.settings import OPTIONS, ROTATIONS, Settings, StyleLike
from drapery.sheets.sheet import PictureSheet, SheetCell
from drapery.stage.dressing import Dressed
from drapery.stage.recording import Schedule
from drapery.stage.subjects import moments as staged_moments, still
from drapery.style.figure import SKINS
from drapery.styles import find_style, style_names

BETWEEN = 0.7
"""Time between two moments of a sheet of styles [s]."""

PAPER = "#c8d0d8"

GARMENT_TIMES = (1.0, 1.7, 2.4, 3.1)
"""The moments of a sheet of garments [s]."""

MOTIONS = ("stand", "walk", "run", "sneak", "jump", "glide", "swim", "sit", "wave", "point")
SPEEDS = {"walk": 1.5, "run": 4.0, "sneak": 0.5, "glide": 8.0, "swim": 1.5}
"""Of the motions on a sheet of players [m/s]."""
SIDES = {"front": 0, "hero": 6, "back": 0}
"""The views on a sheet of players, and the rotation of each."""
PLAYER_TIME = 2.05
"""The moment of a sheet of players [s]."""

COMPASS = {0: "south", 4: "west", 8: "north", 12: "east"}


def rotations_sheet(design: Banner | None, settings: Settings) -> PictureSheet:
    """All sixteen rotations, by one camera.

    design: a banner; None for a cape or elytra.
    settings: the options of the pictures.

    Raises OptionError, PackError or BackendError, as `drapery.draw` does.
    """
    cells = tuple(
        SheetCell(f"{number} {COMPASS.get(number, '')}".rstrip(), frame.pixels)
        for number, frame in enumerate(_rotations(design, settings))
    )
    return PictureSheet("Sixteen rotations", cells, 8)


def _rotations(design: Banner | None, settings: Settings) -> list[Frame]:
    packs = open_packs(settings.packs, format=settings.format)
    turned = [settings.changed(rotation=rotation) for rotation in range(ROTATIONS)]
    scenes = [still(design, packs, each) for each in turned]
    meshes = [model.mesh for scene in scenes for model in scene.models]
    points = np.concatenate([mesh.positions.reshape(-1, 3) for mesh in meshes])
    camera = frame_view(settings.view, points, settings.size[0] / settings.size[1])
    return list(draw_scenes([replace(scene, camera=camera) for scene in scenes], packs, settings))


def packs_sheet(
    banner: Banner, paths: Sequence[str | Path], settings: Settings, *, scale: int | None = None
) -> PictureSheet:
    """One design with our own art, and with each pack alone.

    banner: the design.
    paths: those of the packs.
    settings: the options of the pictures.
    scale: draws plain faces instead; it is the width of a texel of a 64 x 64 pack [pixels].

    Raises OptionError, PackError or BackendError, as `drapery.draw` does.
    """
    stacks: list[tuple[str, tuple[str | Path, ...]]] = [("our own art", ())]
    stacks += [(Path(path).name or str(path), (path,)) for path in paths]
    cells = []
    for name, packs in stacks:
        if scale is None:
            frame = draw(banner, settings.changed(packs=packs))
        else:
            frame = draw_face(banner, packs=packs, format=settings.format, scale=scale)
        cells.append(SheetCell(name, frame.pixels))
    return PictureSheet("One design over many packs", tuple(cells), min(len(cells), 6))


def styles_sheet(
    designs: Banner | Sequence[Banner] | None,
    settings: Settings,
    *,
    moments: int = 1,
    sizes: Sequence[tuple[int, int]] = (),
    background: str = PAPER,
) -> PictureSheet:
    """Designs in each style of the settings, or in all that are known if these have none.

    designs: with several, each has a column, and each style and size a row; None for a cape or
        elytra.
    settings: the options of the pictures.
    moments: pictures of each style, BETWEEN seconds apart; with several, each style has a row.
    sizes: width and height of pictures [pixels]; small ones are enlarged by whole numbers.
    background: of pictures whose settings have a transparent one, so that pale lines are seen.

    Raises OptionError, also for several moments of several designs or sizes, PackError or
    BackendError.
    """
    if settings.background == "transparent":
        settings = settings.changed(background=background)
    names = OPTIONS["style"].check(settings.style) or tuple(style_names())
    several = [designs] if designs is None or isinstance(designs, Banner) else [*designs]
    sizes = sizes or (settings.size,)
    if moments > 1 and len(several) * len(sizes) > 1:
        raise OptionError("several moments are drawn of one design in one size; leave out moments")
    if len(several) * len(sizes) > 1:
        return _styles_table(several, settings, names, sizes)
    settings = settings.changed(size=sizes[0])
    times = [settings.time + BETWEEN * moment for moment in range(moments)]
    later = [settings.changed(time=time) for time in times] if moments > 1 else [settings]
    cells = tuple(
        SheetCell(find_style(name).name, draw(several[0], each, style=name).pixels)
        for name in names
        for each in later
    )
    if moments == 1:
        return PictureSheet("Styles", cells, min(len(cells), 8))
    across = tuple(f"{time:g} s" for time in times)
    return PictureSheet("Styles", cells, moments, across, tuple(c.label for c in cells[::moments]))


def _styles_table(
    designs: Sequence[Banner | None],
    settings: Settings,
    names: Sequence[StyleLike],
    sizes: Sequence[tuple[int, int]],
) -> PictureSheet:
    """A column for each design, and a row for each style and size."""
    width, height = (max(side) for side in zip(*sizes, strict=True))
    cells, down = [], []
    for name in names:
        for size in sizes:
            times = min(width // size[0], height // size[1])
            label = f"{find_style(name).name} {size[0]} x {size[1]}"
            chosen = settings.changed(size=size)
            down.append(label)
            for design in designs:
                pixels = draw(design, chosen, style=name).pixels
                cells.append(SheetCell(label, pixels.repeat(times, axis=0).repeat(times, axis=1)))
    across = tuple(
        "" if design is None else write_banner(design, "shorthand") for design in designs
    )
    return PictureSheet("Styles", tuple(cells), len(designs), across, tuple(down))


def garments_sheet(
    settings: Settings, names: Sequence[str | Path] = (), *, background: str = PAPER
) -> PictureSheet:
    """Each garment at GARMENT_TIMES, in its own view and wind.

    settings: size, packs and backend; each garment has the rest.
    names: garments of the package or files; all of the package unless given.
    background: as in `styles_sheet`.

    Raises OptionError, PackError or BackendError, as `drapery.draw` does.
    """
    garments = [find_garment(name) for name in names or garment_names()]
    same = {name: getattr(settings, name) for name in ("size", "packs", "format", "backend")}
    packs = open_packs(settings.packs, format=settings.format)
    cells = []
    for garment in garments:
        own = {} if "background" in garment.picture else {"background": background}
        chosen = garment.settings(**own, **same)
        scenes = staged_moments(garment, packs, chosen, GARMENT_TIMES)
        drawn = draw_scenes(scenes, packs, chosen)
        cells += [SheetCell(garment.name, frame.pixels) for frame in drawn]
    across = tuple(f"{time:g} s" for time in GARMENT_TIMES)
    down = tuple(garment.name for garment in garments)
    return PictureSheet("Garments", tuple(cells), len(GARMENT_TIMES), across, down)


def players_sheet(
    settings: Settings,
    skins: Sequence[str] = (),
    motions: Sequence[str] = MOTIONS,
    *,
    wear: Sequence[str | Path] = ("cape",),
    background: str = PAPER,
) -> PictureSheet:
    """Players in motions, from several sides: a row for each skin and view.

    settings: size, packs and backend.
    skins: names or PNG files; our own unless given.
    motions: a column for each.
    wear: garments by name or file.
    background: as in `styles_sheet`.

    Raises OptionError, PackError or BackendError, as `drapery.draw` does.
    """
    same = {name: getattr(settings, name) for name in ("size", "packs", "format", "backend")}
    packs = open_packs(settings.packs, format=settings.format)
    skins = skins or SKINS
    rows: dict[tuple[str, str], list[SheetCell]] = {(s, v): [] for s in skins for v in SIDES}
    for skin in skins:
        for motion in motions:
            wearer = make_wearer(skin=skin, motion=motion, speed=SPEEDS.get(motion, 0.0))
            player = dressed_player(wearer, wear=wear)
            dressed = Dressed(player, packs, player.settings(background=background, **same))
            at = Schedule.at([PLAYER_TIME], dressed.step)
            places = dressed.record(at)
            for view, rotation in SIDES.items():
                seen = player.settings(
                    view=view, rotation=rotation, ground="none", background=background, **same
                )
                scenes = replace(dressed, settings=seen).scenes(places, at)
                frame = next(draw_scenes(scenes, packs, seen))
                rows[skin, view].append(SheetCell(f"{skin} {motion}", frame.pixels))
    cells = tuple(cell for row in rows.values() for cell in row)
    down = tuple(f"{Path(skin).stem} {view}" for skin, view in rows)
    return PictureSheet("Players", cells, len(motions), tuple(motions), down)
