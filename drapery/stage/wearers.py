"""Who wears a garment: how a player or a horse moves, is drawn, and stops cloth."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cache, cached_property
from pathlib import Path

import numpy as np

from drapery.arrays import Texels
from drapery.banner.dyes import DYES
from drapery.banner.packs import Packs
from drapery.banner.packs.texture_ids import texture_file
from drapery.cloth.colliders import Box, Collider, TablePath
from drapery.errors import OptionError
from drapery.garments.model import Garment, GarmentWearer
from drapery.garments.poses import BonePoses
from drapery.garments.profiles import Profile, profile_of
from drapery.garments.textures import read_texture
from drapery.mesh import Mesh
from drapery.render.identity_cache import IdentityCache
from drapery.render.scene import Material, Model, Rig, TextureLayer
from drapery.stage.player_motion import player_poses, walk
from drapery.style.boxes import box_mesh, upright
from drapery.style.equipment import (
    ARMOR_SOLID,
    Equipment,
    armor_growth,
    armor_on,
    banner_pole,
    pole_solids,
    shield_in_hand,
)
from drapery.style.figure import SKINS, TEXEL, FigurePart, Placed
from drapery.style.horse import HORSE_BOXES, HORSE_PARTS, SHEET
from drapery.style.rig import make_rig, rigged_model
from drapery.style.skins import Arms, Overlay, Skin, read_skin

Poses = Mapping[str, Placed]
Draw = Callable[[Poses, tuple[str, ...] | None], tuple[Model, ...]]


@dataclass(frozen=True, eq=False)
class Wearer:
    """A figure that moves. parts: its boxes by bone. poses: of all bones.
    draw: its models in poses, of some bones or all. equipment: what it holds, and its armour.
    growth: how far the second layer of its skin stands off its bones [texels]. armor: the same of
    its armour, which stops only cloth that names it."""

    parts: Mapping[str, FigurePart]
    poses: BonePoses
    draw: Draw
    equipment: tuple[Equipment, ...] = ()
    growth: Mapping[str, float] = field(default_factory=dict)
    armor: Mapping[str, float] = field(default_factory=dict)

    def models(self, time: float, bones: tuple[str, ...] | None = None) -> tuple[Model, ...]:
        """The figure at a time [s], at the origin. bones: those that are drawn; None for all."""
        poses = self.poses(time)
        held = (
            rigged_model(self._held[number], poses, each.material, f"held/{each.bone}")
            for number, each in enumerate(self.equipment)
            if bones is None or each.bone in bones
        )
        return (*self.draw(poses, bones), *held)

    @cached_property
    def _held(self) -> list[Rig]:
        return [make_rig([(each.bone, each.mesh)], self.parts) for each in self.equipment]

    def colliders(self, bones: tuple[str, ...] | None = None) -> tuple[Collider, ...]:
        """The parts of some bones, or of all, as moving boxes.

        bones: may also name SOLIDS: the pole and bar of a banner on the head, and the armour.
        """
        armor = self.armor if bones is not None and ARMOR_SOLID in bones else {}
        growth = {
            name: max(self.growth.get(name, 0.0), armor.get(name, 0.0)) for name in self.parts
        }
        poles = (
            Collider(Box((low + high) / 2, high - low), self.poses.path("head"))
            for name, (low, high) in pole_solids().items()
            if bones is not None and name in bones
        )
        body = (
            Collider(
                Box(part.centre, part.extent + 2 * growth[name] * TEXEL),
                self.poses.path(name),
            )
            for name, part in self.parts.items()
            if bones is None or name in bones
        )
        return *body, *poles

    def held_boxes(self) -> list[tuple[Box, TablePath]]:
        """What it holds that stops cloth: boxes at rest, and their paths."""
        found = []
        for each in self.equipment:
            if each.is_solid:
                low, high = each.mesh.positions.min(axis=0), each.mesh.positions.max(axis=0)
                found.append((Box((low + high) / 2, high - low), self.poses.path(each.bone)))
        return found


def wearer_of(garment: Garment, packs: Packs, period: float | None = None) -> Wearer | None:
    """Who wears a garment; None if nobody does.

    period: of a loop [s], which a whole number of strides then fills.
    Raises OptionError for a skin or motion that cannot be used, and PackError.
    """
    who = garment.wearer
    if who is None:
        return None
    if who.kind == "horse":
        return Wearer(HORSE_PARTS, walk(who, period).poses, _horse(packs))
    skin = _skin(who, garment.folder, packs)
    material = Material((TextureLayer(skin.texels),), "cutout")
    poses = player_poses(who, garment.folder, skin.parts, period)

    def draw(poses: Poses, bones: tuple[str, ...] | None) -> tuple[Model, ...]:
        return (rigged_model(skin.rig(bones), poses, material, "player"),)

    armor = {} if who.armor is None else armor_growth(who.armor)
    return Wearer(skin.parts, poses, draw, _equipment(who, packs, skin.parts), skin.growth, armor)


def _equipment(
    who: GarmentWearer, packs: Packs, parts: Mapping[str, FigurePart]
) -> tuple[Equipment, ...]:
    found: list[Equipment] = []
    if who.armor is not None:
        found += armor_on(who.armor, who.trim, packs, parts)
    if who.head is not None:
        found.append(banner_pole(packs))
    if who.shield is not None:
        found += shield_in_hand(who.shield, packs, parts)
    return tuple(found)


def _skin(who: GarmentWearer, folder: Path, packs: Packs) -> Skin:
    arms = None if who.arms == "auto" else who.arms
    if who.skin in SKINS:
        return _kept_skin(packs.texture(f"entity/player/{who.skin}"), arms, "skin", who.overlay)
    profile = profile_of(who.skin, folder)
    if profile is not None:
        return _skin_of(profile, who, packs)
    if not who.skin.lower().endswith(".png"):
        known = ", ".join(SKINS)
        raise OptionError(
            f"skin {who.skin!r} is not known; use a PNG file, a profile, or one of: {known}"
        )
    return read_skin(read_texture(folder / who.skin), arms, f"skin {who.skin}", who.overlay)


def _skin_of(profile: Profile, who: GarmentWearer, packs: Packs) -> Skin:
    """The skin of a profile, a texture of the packs. Raises OptionError and PackError."""
    if not packs.has_texture(profile.texture):
        raise OptionError(
            f"skin {profile.texture}: no pack has {texture_file(profile.texture)};"
            " give one that has it, by --pack"
        )
    arms = profile.arms if who.arms == "auto" else who.arms
    texels = packs.texture(profile.texture)
    return _kept_skin(texels, arms, f"skin {profile.texture}", who.overlay)


def _kept_skin(texels: Texels, arms: Arms | None, name: str, overlay: Overlay) -> Skin:
    """The skin of a texture of packs, which does not change; see `read_skin`."""
    return _skins.get((texels,), (arms, overlay), lambda: read_skin(texels, arms, name, overlay))


_skins: IdentityCache[Skin] = IdentityCache()


def _horse(packs: Packs) -> Draw:
    wool = packs.texture("block/white_wool")[:16, :16]
    across, down = SHEET
    coat = np.ascontiguousarray(np.tile(wool, (down // 16, across // 16, 1)))
    dyes = sorted({box.dye for box in HORSE_BOXES})
    rest: dict[str, list[tuple[str, Mesh]]] = {dye: [] for dye in dyes}
    for each in HORSE_BOXES:
        rest[each.dye].append((each.bone, upright(box_mesh(each.box, SHEET), TEXEL, (0, 0, 0))))
    materials = {dye: Material((TextureLayer(coat, DYES[dye].rgb),)) for dye in dyes}

    @cache
    def rigs(bones: tuple[str, ...] | None) -> dict[str, Rig]:
        shown = {
            dye: [(bone, mesh) for bone, mesh in rest[dye] if bones is None or bone in bones]
            for dye in dyes
        }
        return {dye: make_rig(parts, HORSE_PARTS) for dye, parts in shown.items() if parts}

    def draw(poses: Poses, bones: tuple[str, ...] | None) -> tuple[Model, ...]:
        return tuple(
            rigged_model(rig, poses, materials[dye], "horse") for dye, rig in rigs(bones).items()
        )

    return draw
