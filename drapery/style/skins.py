"""Skins of players: their textures in every layout of the game, and the boxes that they cover.

A skin is 64 x 64 texels, or a multiple, with a second layer over each part. Until 1.8 it was
64 x 32, with one arm and one leg, which the other side mirrors. Slim arms are three texels wide.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache
from typing import Any, Literal

import numpy as np

from drapery.arrays import Texels
from drapery.errors import OptionError
from drapery.mesh import Mesh
from drapery.render.scene import Rig
from drapery.style.boxes import ModelBox, box_mesh, join, upright
from drapery.style.figure import PARTS, TEXEL, FigurePart, Placed, posed
from drapery.style.rig import make_rig
from drapery.style.skin_layer import layer_meshes

Arms = Literal["classic", "slim"]
Overlay = Literal["flat", "voxels", "none", "whole"]
"""How the second layer is drawn: as one surface, its texels as small boxes, or not at all; or as
whole boxes, also where this skin shows nothing, for a skin that is replaced later."""

SIDE = 64
"""Width and height of a skin [texels]."""
OVERLAYS = {
    "head": (32, 0, 0.5),
    "body": (16, 32, 0.25),
    "right_arm": (40, 32, 0.25),
    "left_arm": (48, 48, 0.25),
    "right_leg": (0, 32, 0.25),
    "left_leg": (0, 48, 0.25),
}
"""Of the second layer over each part: the corner of its texture, and how far it stands off."""
MIRRORED = (
    # Of the faces of the old right leg and arm: corner, step to the left one's face, and size.
    *((4, 16, 16, 4), (8, 16, 16, 4), (0, 20, 24, 12)),
    *((4, 20, 16, 12), (8, 20, 8, 12), (12, 20, 16, 12)),
    *((44, 16, -8, 4), (48, 16, -8, 4), (40, 20, 0, 12)),
    *((44, 20, -8, 12), (48, 20, -16, 12), (52, 20, -8, 12)),
)
BASE = ((0, 0, 32, 16), (0, 16, 64, 32), (16, 48, 48, 64))
"""What the first layer covers: left, top, right, bottom. It has no holes."""
HAT = (32, 0, 64, 32)
EMPTY_OF_SLIM = (54, 20, 56, 32)
"""Texels that skins with slim arms leave transparent."""


def skin_tables() -> dict[str, Any]:
    """What a program needs to draw skins of all layouts, as JSON has it.

    side: width and height of a skin [texels]. base, hat, emptyOfSlim: parts of it: left, top,
    right, bottom [texels], of the first layer, of the second one over the head, and those that
    slim arms leave transparent. moved: pairs of parts of old skins, of the right arm and leg and of
    the left ones, whose columns count from the right.
    """
    moved = [
        ((x, y, x + 4, y + height), (x + step + 4, y + 32, x + step, y + 32 + height))
        for x, y, step, height in MIRRORED
    ]
    return {"side": SIDE, "base": BASE, "hat": HAT, "emptyOfSlim": EMPTY_OF_SLIM, "moved": moved}


@dataclass(frozen=True, eq=False)
class Skin:
    """A skin as it is drawn.

    texels: uint8, shape [64 n, 64 n, 4].
    arms: classic or slim.
    overlay: how its second layer is drawn.
    """

    texels: Texels
    arms: Arms
    overlay: Overlay = "flat"
    _rigs: dict[tuple[str, ...] | None, Rig] = field(default_factory=dict, init=False, repr=False)

    @property
    def parts(self) -> Mapping[str, FigurePart]:
        """The boxes of its first layer by bone."""
        return SLIM_PARTS if self.arms == "slim" else PARTS

    @property
    def growth(self) -> Mapping[str, float]:
        """How far its second layer stands off each bone on which it is drawn [texels]."""
        drawn = [name for name, _ in self._rest]
        return {name: grown for name, (_, _, grown) in OVERLAYS.items() if drawn.count(name) > 1}

    def mesh(self, poses: Mapping[str, Placed], bones: tuple[str, ...] | None = None) -> Mesh:
        """Both layers, each part in its pose. bones: those that are drawn; all unless given."""
        return join([posed(mesh, poses.get(name)) for name, mesh in self._drawn(bones)])

    def rig(self, bones: tuple[str, ...] | None = None) -> Rig:
        """Both layers on their bones: one object for the same bones, which renderers recognise.

        bones: those that are drawn; all unless given.
        """
        if bones not in self._rigs:
            self._rigs[bones] = make_rig(self._drawn(bones), self.parts)
        return self._rigs[bones]

    def _drawn(self, bones: tuple[str, ...] | None) -> list[tuple[str, Mesh]]:
        return [(n, m) for n, m in self._rest if bones is None or n in bones]

    @cached_property
    def _rest(self) -> tuple[tuple[str, Mesh], ...]:
        """The boxes at rest by bone, and the second layer where it has texels."""
        found = []
        for name, part in self.parts.items():
            found.append((name, _at_rest(part.box)))
            if self.overlay == "none":
                continue
            left, top, grown = OVERLAYS[name]
            over = replace(part.box, offset=(left, top), grown=grown)
            visible = (self.texels[..., 3] > 127) | (self.overlay == "whole")
            layer = layer_meshes(over, visible, self.overlay == "voxels")
            found += [(name, upright(mesh, TEXEL, (0, 0, 0))) for mesh in layer]
        return tuple(found)


@lru_cache(maxsize=64)
def _at_rest(box: ModelBox) -> Mesh:
    return upright(box_mesh(box), TEXEL, (0, 0, 0))


def read_skin(
    texels: Texels, arms: Arms | None = None, name: str = "skin", overlay: Overlay = "flat"
) -> Skin:
    """A skin of any layout.

    arms: found from the texels unless given.
    name: what messages call it.
    overlay: see `Skin`.
    Raises OptionError for another size.
    """
    height, width = texels.shape[:2]
    unit = width // SIDE
    if unit < 1 or width != SIDE * unit or height not in (width, width // 2):
        raise OptionError(f"{name} is {width} x {height} px; use 64 x 64 or 64 x 32, or a multiple")
    left, top, right, bottom = (unit * value for value in EMPTY_OF_SLIM)
    is_old = height < width
    empty = not texels[top:bottom, left:right, 3].any()
    whole = _from_old(texels, unit) if is_old else texels.copy()
    for left, top, right, bottom in BASE:
        whole[top * unit : bottom * unit, left * unit : right * unit, 3] = 255
    return Skin(whole, arms or ("slim" if empty and not is_old else "classic"), overlay)


def _from_old(texels: Texels, unit: int) -> Texels:
    """A skin of 64 x 32 as one of 64 x 64, as the game does it."""
    whole = np.zeros((SIDE * unit, SIDE * unit, 4), np.uint8)
    whole[: SIDE // 2 * unit] = texels
    for x, y, step, height in MIRRORED:
        face = texels[y * unit : (y + height) * unit, x * unit : (x + 4) * unit]
        left, top = (x + step) * unit, (y + 32) * unit
        whole[top : top + height * unit, left : left + 4 * unit] = face[:, ::-1]
    left, top, right, bottom = (unit * value for value in HAT)
    hat = whole[top:bottom, left:right]
    if (hat[..., 3] > 127).all():  # an old skin without alpha has no hat
        hat[..., 3] = 0
    return whole


def _slim(part: FigurePart, left: float) -> FigurePart:
    """An arm three texels wide, half a texel lower. left: its lowest x."""
    x, y, z = part.joint
    box = replace(part.box, corner=(left, -23.5, -2.0), size=(3.0, 12.0, 4.0))
    return FigurePart(box, (x, y + 0.5, z))


SLIM_PARTS: Mapping[str, FigurePart] = {
    **PARTS,
    "right_arm": _slim(PARTS["right_arm"], -7.0),
    "left_arm": _slim(PARTS["left_arm"], 4.0),
}
"""The parts of a player with slim arms."""
