"""A skirt moved by walking legs: a thick ring with few bend points, pinned at the waist."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from drapery.banner import DYE_NAMES, DYES
from drapery.banner.sprites import tint
from drapery.cloth import State, Wind
from drapery.errors import OptionError
from drapery.garments import SewnCloth
from drapery.packs import Packs, open_packs
from drapery.render import Material, Scene, Texels, TextureLayer
from drapery.scenes.catalogue import Clip
from drapery.scenes.gait import LOOP, MAX_WALK, Gait
from drapery.scenes.parameters import (
    SceneParameters,
    parameter,
    seed_parameter,
    thickness_parameter,
)
from drapery.scenes.stroll import BEFORE, cloths_of, walk_scenes, worn_states
from drapery.style import BoxMapping, make_shell
from drapery.style.figure import SKINS

SIDES = ("outside", "inside", "hem")
SIDES_OF_CLOTH = BoxMapping(
    front_rect=(0.0, 0.0, 0.5, 1.0),
    back_rect=(0.5, 0.0, 1.0, 1.0),
    left=(0.0, 0.9, 0.1, 1.0),
    right=(0.0, 0.9, 0.1, 1.0),
    top=(0.0, 0.0, 0.5, 0.1),
    bottom=(0.0, 0.9, 0.5, 1.0),
)
"""The outside is on the left half of the texture, the lining on the right."""


@dataclass(frozen=True)
class SkirtParameters(SceneParameters):
    """What can be set of the scene `skirt`."""

    panels: int = parameter(12, "Panels around the skirt", (4, 64))
    rows: int = parameter(4, "Rows of bend points from waist to hem", (1, 32))
    dye: str = parameter("red", "Dye of the outside", choices=DYE_NAMES)
    lining: str = parameter("pink", "Dye of the inside", choices=DYE_NAMES)
    trim: str = parameter("white", "Dye of the hem", choices=DYE_NAMES)
    sides: str = parameter("outside inside hem", "Which sides are visible")
    skin: str = parameter("dancer", "Skin of the figure", choices=SKINS)
    speed: float = parameter(2.0, "Speed of the walk", (0, MAX_WALK), "m/s")
    thickness: float = thickness_parameter()
    seed: int = seed_parameter()


def play(parameters: SkirtParameters, clip: Clip) -> Iterator[Scene]:
    """Seen from the front."""
    gait, sewn = Gait(parameters.speed), skirt_cloth(parameters)
    piece = sewn.pieces[0]
    shell = make_shell(piece.shell.sheet, piece.shell.sheet_uvs, SIDES_OF_CLOTH, piece.shell.grid)
    drawn = replace(piece, shell=shell, material=skirt_material(parameters, open_packs(())))
    worn = [(replace(sewn, pieces=(drawn,)), skirt_states(parameters, sewn, gait, clip))]
    return walk_scenes(parameters.skin, gait, clip, worn, view=BEFORE, tail=0.6)


def skirt_cloth(parameters: SkirtParameters) -> SewnCloth:
    """The garment `skirt` with other numbers of particles, `panels` in each row."""
    (sewn,) = cloths_of("skirt", parameters.thickness, (parameters.panels, parameters.rows + 1))
    return sewn


def skirt_states(
    parameters: SkirtParameters, sewn: SewnCloth, gait: Gait, clip: Clip
) -> Iterator[State]:
    """The skirt at each frame, in the figure's own frame."""
    wind = Wind((0.0, 0.0, -gait.speed), gusts=0.3, seed=parameters.seed, period=LOOP)
    return worn_states(sewn, gait, clip, wind, order=3)


def skirt_material(parameters: SkirtParameters, packs: Packs) -> Material:
    """Pleats outside, a plain lining inside, a band of trim at the hem. Raises OptionError."""
    named = parameters.sides.split()
    for side in named:
        if side not in SIDES:
            raise OptionError(f"side {side!r} is not known; use some of: {' '.join(SIDES)}")
    wool = np.tile(packs.texture("block/white_wool")[:16, :16], (1, 6, 1))[:, :96]
    outside, inside = (_dyed(wool, dye) for dye in (parameters.dye, parameters.lining))
    # The last column of every eight texels is darker, like the edge of a pleat.
    outside[:, np.arange(96) % 8 == 7, :3] = outside[:, np.arange(96) % 8 == 7, :3] // 5 * 4
    outside[-2:], inside[-2:] = _dyed(wool, parameters.trim)[-2:], outside[-2:]
    outside[..., 3] = 255 * ("outside" in named)
    inside[..., 3] = 255 * ("inside" in named)
    outside[-2:, :, 3] = 255 * ("hem" in named or "outside" in named)
    return Material(
        (TextureLayer(np.ascontiguousarray(np.concatenate([outside, inside], axis=1))),), "cutout"
    )


def _dyed(wool: Texels, dye: str) -> Texels:
    if dye not in DYES:
        raise OptionError(f"dye {dye!r} is not known; use one of: {', '.join(DYES)}")
    return tint(wool, DYES[dye].rgb)
