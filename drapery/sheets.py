"""Sheets of many faces: the loom's steps, all patterns, packs beside each other."""

from drapery.banner.design import Banner
from drapery.banner.loom import steps
from drapery.banner.packs import Packs
from drapery.banner.sprites import face
from drapery.render.contact import enlarge, strip
from drapery.render.frame import Frame, Pixels

FACE_HEIGHT = 160


def steps_sheet(banner: Banner, packs: Packs) -> Frame:
    """The banner after each step at the loom, with the dye and the pattern to use."""
    cells = [("base", banner.base, _face(Banner(banner.base), packs))]
    for step in steps(banner):
        cells.append((step.layer.pattern, step.layer.dye, _face(step.banner, packs)))
    labels = [f"{number}. {pattern}, {dye}" for number, (pattern, dye, _) in enumerate(cells)]
    return strip(
        [(label, cell[2]) for label, cell in zip(labels, cells, strict=True)],
        columns=min(len(cells), 6),
    )


def _face(banner: Banner, packs: Packs) -> Pixels:
    texels = face(banner, packs)
    return enlarge(texels, max(1, FACE_HEIGHT // texels.shape[0]))
