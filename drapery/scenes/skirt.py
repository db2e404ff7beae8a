"""A skirt moved by walking legs: a thick ring with few bend points, pinned at the waist."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from drapery.banner.dyes import DYE_NAMES, DYES
from drapery.banner.packs import Packs, open_packs
from drapery.banner.sprites import tint
from drapery.cloth import Cloth, Gravity, State, Wind
from drapery.cloth.collisions import Collisions
from drapery.errors import OptionError
from drapery.garments.catalogue import find_garment
from drapery.garments.shapes import CutPiece, cut_pieces
from drapery.mesh import vertex_normals
from drapery.render.scene import Material, Model, Scene, Texels, TextureLayer
from drapery.scenes.catalogue import Clip
from drapery.scenes.gait import LOOP, MAX_WALK, Gait
from drapery.scenes.moving import motion
from drapery.scenes.parameters import (
    SceneParameters,
    parameter,
    seed_parameter,
    thickness_parameter,
)
from drapery.scenes.stroll import BEFORE, camera, ground, walker
from drapery.style.extrusion import Shell, make_shell
from drapery.style.figure import SKINS, TEXEL, figure_material
from drapery.style.scenery import SKY
from drapery.style.tailoring import ClothModel
from drapery.style.uv_mapping import BoxMapping

BODY = ("body", "right_leg", "left_leg")
SIDES = ("outside", "inside", "hem")
SKIN = BoxMapping(
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
    packs, gait = open_packs(()), Gait(parameters.speed)
    cloth = skirt_cloth(parameters)
    shell, material = skirt_shell(parameters), skirt_material(parameters, packs)
    skin, causeway = figure_material(parameters.skin, packs), ground(packs)
    view = camera(clip.size, BEFORE, tail=0.6)
    for state in skirt_states(parameters, cloth, gait, clip):
        skirt = skirt_model(parameters, cloth, shell, state, material)
        models = (*walker(gait, state.time, skin, causeway), skirt)
        yield Scene(models, view, clip.size, background=SKY, samples=4)


def skirt_states(
    parameters: SkirtParameters, cloth: Cloth, gait: Gait, clip: Clip
) -> Iterator[State]:
    """The skirt at each frame, in the figure's own frame."""
    wind = Wind((0.0, 0.0, -gait.speed), gusts=0.3, seed=parameters.seed, period=LOOP)
    return motion(
        cloth,
        clip,
        forces=(Gravity(), wind),
        collisions=Collisions(gait.colliders(BODY), parameters.thickness * TEXEL, order=3),
        pins=gait.pins(cloth),
        settle=LOOP,
    )


@lru_cache(maxsize=8)
def skirt_piece(parameters: SkirtParameters) -> CutPiece:
    """The ring of the garment `skirt` at rest, with other numbers of particles: row by row from the
    waist, `panels` in each row."""
    garment = find_garment("skirt")
    points = parameters.panels, parameters.rows + 1
    ring = garment.piece[0].model_copy(update={"points": points})
    return cut_pieces(garment.model_copy(update={"piece": (ring,)}))[0]


def skirt_cloth(parameters: SkirtParameters) -> Cloth:
    """The ring at rest, pinned at the waist."""
    piece = skirt_piece(parameters)
    inv_mass = piece.cloth.inv_mass.copy()
    inv_mass[piece.edges["top"]] = 0.0
    return replace(piece.cloth, inv_mass=inv_mass)


def skirt_shell(parameters: SkirtParameters) -> Shell:
    """The thick skirt: the ring is cut open where the texture begins and ends."""
    piece = skirt_piece(parameters)
    return make_shell(piece.triangles, piece.uvs, SKIN)


def skirt_model(
    parameters: SkirtParameters, cloth: Cloth, shell: Shell, state: State, material: Material
) -> Model:
    """The skirt of a state, with the normals of the closed ring, so that the cut is invisible."""
    drawn = skirt_piece(parameters).drawn
    sheet = state.positions[0]
    normals = vertex_normals(sheet, cloth.triangles)
    thick = shell.cover(sheet[drawn], normals[drawn], parameters.thickness * TEXEL)
    return ClothModel(thick, (material,))


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
