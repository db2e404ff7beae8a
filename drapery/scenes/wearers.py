"""Who wears a garment: how a player or a horse moves, is drawn, and stops cloth."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from drapery.banner.dyes import DYES
from drapery.banner.packs import Packs
from drapery.cloth.colliders import Collider
from drapery.errors import OptionError
from drapery.garments.model import Garment
from drapery.garments.textures import read_texture
from drapery.mesh import Mesh
from drapery.render.scene import Material, Model, TextureLayer
from drapery.scenes.gait import Gait
from drapery.style.boxes import box_mesh, join, upright
from drapery.style.figure import SKINS, TEXEL, Placed, figure_material, figure_mesh, posed
from drapery.style.horse import HORSE_BOXES, SHEET

STRIDE = 0.8
"""The period of a stride [s], unless a loop needs a whole number of them."""


@dataclass(frozen=True, eq=False)
class Wearer:
    """A figure that moves. gait: its motion. solid: the bones that stop cloth. draw: its models in
    poses."""

    gait: Gait
    solid: tuple[str, ...]
    draw: Callable[[dict[str, Placed]], tuple[Model, ...]]

    def models(self, time: float) -> tuple[Model, ...]:
        """The figure at a time [s], at the origin."""
        return self.draw(self.gait.poses(time))

    @property
    def colliders(self) -> tuple[Collider, ...]:
        """The parts that stop cloth as moving boxes."""
        return self.gait.colliders(self.solid)


def wearer_of(garment: Garment, packs: Packs, period: float | None = None) -> Wearer | None:
    """Who wears a garment; None if nobody does.

    period: of a loop [s], which a whole number of strides then fills.
    Raises OptionError for a skin that cannot be used, and PackError.
    """
    who = garment.wearer
    if who is None:
        return None
    strides = None if period is None else max(1, round(period / STRIDE))
    stride = STRIDE if strides is None or period is None else period / strides
    gait = Gait(who.speed, stride, who.kind)
    solid = tuple(gait.parts) if who.solid is None else who.solid
    if who.kind == "horse":
        return Wearer(gait, solid, _horse(packs))
    skin = _skin(who.skin, garment.folder, packs)
    return Wearer(gait, solid, lambda poses: (Model(figure_mesh(poses), (skin,)),))


def _skin(name: str, folder: Path, packs: Packs) -> Material:
    if name in SKINS:
        return figure_material(name, packs)
    if not name.lower().endswith(".png"):
        known = ", ".join(SKINS)
        raise OptionError(f"skin {name!r} is not known; use a PNG file, or one of: {known}")
    texels = read_texture(folder / name)
    height, width = texels.shape[:2]
    if height != width or height % 64:
        raise OptionError(f"skin {name} is {width} x {height} px; use 64 x 64 px, or a multiple")
    return Material((TextureLayer(texels),), "cutout")


def _horse(packs: Packs) -> Callable[[dict[str, Placed]], tuple[Model, ...]]:
    wool = packs.texture("block/white_wool")[:16, :16]
    across, down = SHEET
    coat = np.ascontiguousarray(np.tile(wool, (down // 16, across // 16, 1)))
    dyes = sorted({box.dye for box in HORSE_BOXES})
    rest: dict[str, list[tuple[str, Mesh]]] = {dye: [] for dye in dyes}
    for each in HORSE_BOXES:
        rest[each.dye].append((each.bone, upright(box_mesh(each.box, SHEET), TEXEL, (0, 0, 0))))
    materials = {dye: Material((TextureLayer(coat, DYES[dye].rgb),)) for dye in dyes}

    def draw(poses: dict[str, Placed]) -> tuple[Model, ...]:
        return tuple(
            Model(join([posed(mesh, poses[bone]) for bone, mesh in rest[dye]]), (materials[dye],))
            for dye in dyes
        )

    return draw
