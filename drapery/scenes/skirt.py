"""A skirt moved by walking legs: a thick ring with few bend points, pinned at the waist."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drapery.banner.dyes import DYE_NAMES, DYES
from drapery.banner.packs import Packs, open_packs
from drapery.banner.sprites import tint
from drapery.cloth import Cloth, Fabric, Gravity, State, Wind, from_triangles
from drapery.cloth.collisions import Collisions
from drapery.cloth.exact import sine_of_turns
from drapery.errors import OptionError
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

WAIST, HEM = 13.0, 5.0
"""Heights of its upper and lower edge [texels]."""
WAIST_REACH, HEM_REACH = (4.9, 2.9), (8.6, 7.6)
"""Its half widths to the side and to the front, at the waist and at the hem [texels]."""
SQUARE = 4.0
"""Exponent of its outline: 2 gives an ellipse, higher numbers a squarer outline."""
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


def skirt_cloth(parameters: SkirtParameters) -> Cloth:
    """The ring at rest: particles row by row from the pinned waist, `panels` in each row.

    Raises OptionError.
    """
    panels, rows = parameters.panels, parameters.rows
    if not (4 <= panels <= 64 and 1 <= rows <= 32):
        raise OptionError(f"skirt of {panels} panels, {rows} rows: use 4 to 64 and 1 to 32")
    part = np.arange(rows + 1)[:, None] / rows
    turns = np.arange(panels) / panels
    sine, cosine = sine_of_turns(turns), sine_of_turns(turns + 0.25)
    # |x|^n + |z|^n = 1, along the direction of each panel.
    away = (np.abs(sine) ** SQUARE + np.abs(cosine) ** SQUARE) ** (-1 / SQUARE)
    wide, deep = (w + (h - w) * part for w, h in zip(WAIST_REACH, HEM_REACH, strict=True))
    high = np.broadcast_to(WAIST + (HEM - WAIST) * part, (rows + 1, panels))
    places = np.stack([wide * away * sine, high, deep * away * cosine], axis=-1) * TEXEL
    triangles = _ring(rows, panels)
    return from_triangles(
        places.reshape(-1, 3),
        triangles,
        pins=list(range(panels)),
        fabric=Fabric(stretch=8.0, shear=2.0, flexion=0.6),
    )


def skirt_shell(parameters: SkirtParameters) -> Shell:
    """The thick skirt: the ring is cut open at the back, where the texture begins and ends."""
    across, down = np.meshgrid(
        np.linspace(0, 1, parameters.panels + 1), np.linspace(0, 1, parameters.rows + 1)
    )
    uvs = np.stack([across, down], axis=-1).reshape(-1, 2)
    return make_shell(_triangles(parameters.rows, parameters.panels + 1), uvs, SKIN)


def skirt_model(
    parameters: SkirtParameters, cloth: Cloth, shell: Shell, state: State, material: Material
) -> Model:
    """The skirt of a state, with the normals of the closed ring, so that the cut is invisible."""
    panels = parameters.panels
    index = np.arange((parameters.rows + 1) * panels).reshape(-1, panels)
    opened = np.concatenate([index, index[:, :1]], axis=1).reshape(-1)
    sheet = state.positions[0]
    normals = vertex_normals(sheet, cloth.triangles)
    thick = shell.cover(sheet[opened], normals[opened], parameters.thickness * TEXEL)
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


def _ring(rows: int, panels: int) -> NDArray[np.int32]:
    """The triangles of a closed ring, seen from outside."""
    opened = _triangles(rows, panels + 1)
    row, column = np.divmod(opened, panels + 1)
    closed: NDArray[np.int32] = (row * panels + column % panels).astype(np.int32)
    return closed


def _triangles(rows: int, columns: int) -> NDArray[np.int32]:
    """Two triangles in each of `rows` x (columns - 1) cells; the diagonal alternates."""
    index = np.arange((rows + 1) * columns, dtype=np.int32).reshape(rows + 1, columns)
    a, b, c, d = index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]
    one = np.stack([np.stack([a, b, c], -1), np.stack([a, c, d], -1)], axis=2)
    two = np.stack([np.stack([a, b, d], -1), np.stack([b, c, d], -1)], axis=2)
    even = (np.add.outer(np.arange(rows), np.arange(columns - 1)) % 2 == 0)[..., None, None]
    return np.where(even, one, two).reshape(-1, 3)
