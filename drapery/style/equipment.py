"""What players hold and wear beside cloth: the pole of a banner on the head, a shield, armour.

Poses and sizes are those of the game: its display transforms of items, and how far the boxes of
each piece of armour stand off.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np

from drapery.arrays import Texels
from drapery.banner.design import Banner
from drapery.banner.packs import Packs
from drapery.banner.packs.equipment import MATERIALS, armor_places, needed, trim_texels
from drapery.banner.packs.resampling import nearest_texels
from drapery.banner.sprites import tint
from drapery.errors import OptionError, shown
from drapery.mesh import Array, Mesh
from drapery.render.scene import Material, TextureLayer
from drapery.settings import Settings
from drapery.style.block import solids, wood
from drapery.style.boxes import ModelBox, box_mesh, upright
from drapery.style.figure import PARTS, TEXEL, FigurePart
from drapery.style.kinds.shield import HANDLE, PLATE
from drapery.style.layers import handle_material_at, plate_material_at, wood_material

BANNER_TEXEL = 0.625
"""A texel of a banner on a head [texels of the player]: 1.5 * 0.625 * 2/3."""
POLE_FOOT = (0.0, 30.5, -4.375)
"""Where the pole of a banner on a head begins [texels, y up]: behind the head."""
FLAG_TOP = (0.0, 58.0, -3.4375)
"""The middle of the upper edge of its flag [texels, y up]."""
POLES = ("pole", "bar")
"""What stops that flag beside the head, by name."""
ARMOR_SOLID = "armor"
"""What makes cloth keep outside the armour, not only outside the body."""
SOLIDS = (*POLES, ARMOR_SOLID)
"""What can stop cloth beside the bones of a wearer."""
SHIELD_ARM = "left_arm"

ARMOR_SHEET = (64, 32)
LEATHER = (160, 101, 64)
"""The colour of leather without a dye."""
PIECES: Mapping[str, tuple[tuple[str, float], ...]] = {
    "helmet": (("head", 1.0), ("hat", 1.5)),
    "chestplate": (("body", 1.0), ("right_arm", 1.0), ("left_arm", 1.0)),
    "leggings": (("body", 0.5), ("right_leg", 0.4), ("left_leg", 0.4)),
    "boots": (("right_leg", 0.9), ("left_leg", 0.9)),
}
"""The boxes of each piece of armour, and how far they stand off [texels]."""
_OFFSETS = {"head": (0, 0), "hat": (32, 0), "body": (16, 16), "arm": (40, 16), "leg": (0, 16)}
"""Where the boxes lie on a texture of armour; those of the left are mirrored."""


@dataclass(frozen=True, eq=False)
class Equipment:
    """A stiff thing on a bone. mesh: on a player at rest [m]. is_solid: whether the box around it
    stops cloth."""

    bone: str
    mesh: Mesh
    material: Material
    is_solid: bool = False


def banner_pole(packs: Packs) -> Equipment:
    """Pole and bar of a banner on the head; its flag is cloth. Raises PackError."""
    mesh = wood("standing")
    return Equipment(
        "head", replace(mesh, positions=_on_head(mesh.positions)), wood_material(packs)
    )


def pole_solids() -> dict[str, tuple[Array, Array]]:
    """Low and high corner of what stops the flag of a banner on the head, by name [m]."""
    # The last solid is the ground.
    found = zip(POLES, solids("standing"), strict=False)
    return {name: (_on_head(np.array(s.low)), _on_head(np.array(s.high))) for name, s in found}


def _on_head(points: Array) -> Array:
    """Points of a banner in its block as those of one on the head of a player at rest [m]."""
    scale = BANNER_TEXEL * TEXEL * 24  # a block is 24 texels of a banner
    placed: Array = (points - np.array([0.5, 0.0, 0.5])) * scale + np.array(POLE_FOOT) * TEXEL
    return placed


def shield_in_hand(
    design: Banner, packs: Packs, parts: Mapping[str, FigurePart]
) -> tuple[Equipment, ...]:
    """A shield in the left hand: its plate and handle. Raises PackError.

    parts: of the player, whose left arm holds it.
    """
    settings = Settings(kind="shield")
    # From the joint of the arm to the hand, then the item's display transform [texels].
    x, y, z = parts[SHIELD_ARM].joint
    slim = parts[SHIELD_ARM].box.size[0] == 3
    chain = [
        _moved(x - (1.5 if slim else 1.0), y, z),
        _turned(0, -90),
        _turned(1, 180),
        _moved(-1, 2, -10),
        _moved(-10, 6, 12),
        _turned(1, -90),
        _moved(-8, -8, -8),
        np.diag([1.0, -1.0, -1.0, 1.0]),
    ]
    matrix = chain[0]
    for each in chain[1:]:
        matrix = np.einsum("ij,jk->ik", matrix, each)
    made = []
    for box, material_at in ((PLATE, plate_material_at), (HANDLE, handle_material_at)):
        mesh = box_mesh(box)
        flipped = np.array([1.0, -1.0, -1.0])  # box_mesh gives normals of the world
        turned = Mesh(
            np.einsum("ij,vj->vi", matrix[:3, :3], mesh.positions) + matrix[:3, 3],
            np.einsum("ij,vj->vi", matrix[:3, :3], mesh.normals * flipped) * flipped,
            mesh.triangles,
            mesh.uvs,
        )
        material = material_at(design, packs, settings)(0.0)
        placed = upright(turned, TEXEL, (0, 0, 0))
        made.append(Equipment(SHIELD_ARM, placed, material, is_solid=box is PLATE))
    return tuple(made)


def parse_armor(text: str) -> dict[str, str]:
    """The material of each piece: of all from `diamond`, of some from `helmet:iron,boots:gold`.

    Raises OptionError.
    """
    words = [word.strip() for word in text.split(",")]
    if len(words) == 1 and ":" not in text:
        found = dict.fromkeys(PIECES, words[0])
        if words[0] == "turtle_scute":
            found = {"helmet": words[0]}
    else:
        found = {piece: material for piece, _, material in (word.partition(":") for word in words)}
    for piece, material in found.items():
        if piece not in PIECES:
            raise OptionError(
                f"armor {shown(piece)} is not a piece; use some of: {', '.join(PIECES)},"
                " such as helmet:iron,boots:gold"
            )
        if material not in MATERIALS:
            known = ", ".join(MATERIALS)
            raise OptionError(f"armor {shown(material)} is not known; use one of: {known}")
    return found


def parse_trim(text: str) -> tuple[str, str]:
    """Pattern and material of a trim, such as `coast:gold`. Raises OptionError."""
    pattern, colon, material = text.partition(":")
    good = all(part and part.replace("_", "").isalnum() for part in (pattern, material))
    if not colon or not good:
        raise OptionError(f"trim {shown(text)} is not a pattern and a material; write coast:gold")
    return pattern, material


def armor_on(
    armor: str, trim: str | None, packs: Packs, parts: Mapping[str, FigurePart]
) -> tuple[Equipment, ...]:
    """Armour on a player, with the textures of the packs.

    armor: see `parse_armor`. trim: see `parse_trim`. Raises OptionError, which names the missing
    file, and PackError.
    """
    made = []
    for piece, material in parse_armor(armor).items():
        texels = _armor_texels(piece, material, packs)
        if trim is not None:
            dyed = trim_texels(_layer(piece), material, *parse_trim(trim), packs)
            texels = _over(texels, dyed)
        drawn = Material((TextureLayer(texels),), "cutout")
        made += [Equipment(bone, mesh, drawn) for bone, mesh in _armor_meshes(piece, parts)]
    return tuple(made)


def armor_growth(armor: str) -> dict[str, float]:
    """How far armour stands off each bone [texels]. Raises OptionError."""
    grown: dict[str, float] = {}
    for piece in parse_armor(armor):
        for box, distance in PIECES[piece]:
            bone = "head" if box == "hat" else box
            if box != "hat":
                grown[bone] = max(grown.get(bone, 0.0), distance)
    return grown


def _armor_meshes(piece: str, parts: Mapping[str, FigurePart]) -> Iterator[tuple[str, Mesh]]:
    for name, grown in PIECES[piece]:
        bone = "head" if name == "hat" else name
        side, _, limb = bone.rpartition("_")
        # Armour is the same for slim arms, which it covers.
        part = PARTS[bone]
        lower = parts[bone].joint[1] - part.joint[1]
        x, y, z = part.box.corner
        offset = _OFFSETS[name if name in _OFFSETS else limb]
        box = ModelBox((x, y + lower, z), part.box.size, offset, grown)
        if side == "left":
            # The mirror of the right one, moved to its place.
            mesh = _mirrored(
                box_mesh(replace(box, corner=(-x - box.size[0], y + lower, z)), ARMOR_SHEET)
            )
        else:
            mesh = box_mesh(box, ARMOR_SHEET)
        yield bone, upright(mesh, TEXEL, (0, 0, 0))


def _mirrored(mesh: Mesh) -> Mesh:
    across = np.array([-1.0, 1.0, 1.0])
    triangles = np.ascontiguousarray(mesh.triangles[:, ::-1])
    return Mesh(mesh.positions * across, mesh.normals * across, triangles, mesh.uvs)


def _armor_texels(piece: str, material: str, packs: Packs) -> Texels:
    """The texture of a piece, shape [32 n, 64 n, 4]; leather is dyed and has a second layer."""
    what = f"armor {material}"
    texels = packs.texels(needed(armor_places(_layer(piece), material), packs, what))
    if material != "leather":
        return texels
    over = needed(armor_places(_layer(piece), material, "_overlay"), packs, what)
    return _over(tint(texels, LEATHER), packs.texels(over))


def _layer(piece: str) -> str:
    """The layer of equipment that a piece is drawn from."""
    return "humanoid_leggings" if piece == "leggings" else "humanoid"


def _over(lower: Texels, upper: Texels) -> Texels:
    """One texture over another, at the finer size of both."""
    height, width = np.maximum(lower.shape[:2], upper.shape[:2])
    below, above = (
        each[
            nearest_texels(each.shape[0], int(height))[:, None],
            nearest_texels(each.shape[1], int(width)),
        ]
        for each in (lower, upper)
    )
    alpha = above[..., 3:].astype(np.uint16)
    mixed = (above[..., :3] * alpha + below[..., :3] * (255 - alpha) + 127) // 255
    both = np.maximum(below[..., 3:], above[..., 3:])
    return np.concatenate([mixed, both], axis=-1).astype(np.uint8)


def _moved(x: float, y: float, z: float) -> Array:
    matrix = np.eye(4)
    matrix[:3, 3] = x, y, z
    return matrix


def _turned(axis: int, degrees: int) -> Array:
    """A rotation by a multiple of a right angle about an axis, exact, shape [4, 4]."""
    cos, sin = ((1, 0), (0, 1), (-1, 0), (0, -1))[degrees // 90 % 4]
    a, b = (axis + 1) % 3, (axis + 2) % 3
    matrix = np.eye(4)
    matrix[a, a], matrix[a, b], matrix[b, a], matrix[b, b] = cos, -sin, sin, cos
    return matrix
