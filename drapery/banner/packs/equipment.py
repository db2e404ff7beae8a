"""Textures of what players and animals wear: where packs have them, and trims in their colours.

A trim's texture has the tones of a key palette; a material's palette has a colour for each tone.
Since 26.3 the texture's `.mcmeta` names its key, and the equipment of a pack may replace the
texture or the palette of a trim: `trim_overrides` in `assets/…/equipment/<material>.json`.
"""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

from drapery.arrays import Texels
from drapery.banner.packs.meta import MAX_JSON, read_json
from drapery.banner.packs.places import Place, moved
from drapery.banner.packs.stack import PackFile, Packs
from drapery.banner.packs.texture_ids import full_id, split_id
from drapery.banner.packs.versions import last_before
from drapery.errors import OptionError, PackError, counted

LAYERS = (
    *("humanoid", "humanoid_leggings", "humanoid_baby", "wings"),
    *("wolf_body", "horse_body", "llama_body", "happy_ghast_body", "nautilus_body"),
    *("pig_saddle", "strider_saddle", "camel_saddle", "camel_husk_saddle", "nautilus_saddle"),
    *("horse_saddle", "donkey_saddle", "mule_saddle", "zombie_horse_saddle"),
    "skeleton_horse_saddle",
)
"""The layers of equipment: the folders of its textures, and the keys of its definitions."""

MATERIALS = (
    *("leather", "chainmail", "copper", "iron", "gold", "diamond", "netherite", "turtle_scute"),
)
"""The game's materials of armour."""

DARKER = frozenset({"iron", "gold", "diamond", "netherite", "copper"})
"""Trims of these are darker on armour of the same material."""

WINGS_SHEET = (64, 32)
"""Width and height of the sheet of wings and a cape [texels]."""

CUT_WINGS = ((46, 22), (22, 17))
"""Sizes of such a sheet that was cut after the wings, and after the cape [texels]."""

WINGS_SIZE = CUT_WINGS[0]
"""Width and height of the part of it that wings need [texels]."""

_LAST_WITHOUT_OVERRIDES = last_before("26.3")
_MAX_OVERRIDES = 1024


@dataclass(frozen=True)
class TrimOverride:
    """What equipment changes about a trim. pattern, material: of the trims that it is for, ids, or
    None for all. texture, palette: ids that replace those of the trim, or None."""

    pattern: str | None
    material: str | None
    texture: str | None
    palette: str | None


def whole_wings(
    width: int, height: int, least: tuple[int, int] = WINGS_SIZE
) -> tuple[int, int] | None:
    """Width and height [px] of the whole sheet of which this is all or a part.

    None where the size is not one of theirs. least: width and height of the part that is needed
    [texels]. A whole sheet may have any size that is twice as wide as high, as in the game.
    """
    if width == 2 * height:
        return width, height
    for across, down in CUT_WINGS:
        times = width // across
        fits = (width, height) == (across * times, down * times)
        if fits and across >= least[0] and down >= least[1]:
            return WINGS_SHEET[0] * times, WINGS_SHEET[1] * times
    return None


def armor_places(layer: str, material: str, more: str = "") -> tuple[Place, ...]:
    """Those of armour on a layer, humanoid or humanoid_leggings. more: `_overlay`, or nothing."""
    old = {"turtle_scute": "turtle"}.get(material, material)
    number = 2 if layer == "humanoid_leggings" else 1
    return moved(
        f"minecraft:entity/equipment/{layer}/{material}{more}",
        f"minecraft:models/armor/{old}_layer_{number}{more}",
        "1.21.2",
    )


def needed(places: Sequence[Place], packs: Packs, what: str) -> PackFile:
    """The file at one of these places. what: names it in errors.

    Raises OptionError that names the files where no pack has one, and PackError.
    """
    found = packs.find(places)
    if found is not None:
        return found
    files = " or ".join(f"textures/{split_id(place.texture)[1]}.png" for place in places)
    raise OptionError(f"{what}: no pack has {files}; give one that has it, by --pack")


def trim_texels(layer: str, worn: str, pattern: str, material: str, packs: Packs) -> Texels:
    """A trim in the colours of its material, shape [H, W, 4].

    layer: humanoid or humanoid_leggings. worn: the material of the armour below.
    Raises OptionError that names a missing file, and PackError.
    """
    override = _override(worn, pattern, material, packs)
    file = needed(_trim_places(layer, pattern, override), packs, f"trim {pattern}")
    texels = packs.texels(file)
    key_file = needed(_key_places(file, packs), packs, f"trim {pattern}")
    palette = needed(_palette_places(worn, material, override), packs, f"trim {material}")
    key, colours = packs.texels(key_file)[0], packs.texels(palette)[0]
    fault = palette_fault(len(colours), len(key))
    if fault:
        raise PackError(f"{packs.place(palette)}: {fault}")
    dyed = texels.copy()
    for tone, colour in zip(key, colours, strict=True):
        dyed[(texels[..., :3] == tone[:3]).all(axis=-1), :3] = colour[:3]
    return dyed


def palette_fault(colours: int, tones: int) -> str:
    """What is wrong with these numbers of a palette's colours and a key's tones, or nothing."""
    if colours == tones:
        return ""
    return (
        f"its palette has {counted(colours, 'colour')}, the key has {tones};"
        " give a pack with palettes of one length"
    )


def key_places() -> tuple[Place, ...]:
    """Those of the key palette of trims."""
    return moved(
        "minecraft:palettes/trim_base", "minecraft:trims/color_palettes/trim_palette", "26.3"
    )


def trim_overrides(data: bytes, place: str) -> tuple[TrimOverride, ...]:
    """The overrides of trims in a definition of equipment.

    place: names the file in errors. Raises PackError.
    """
    root = read_json(data, place)
    entries = root.get("trim_overrides", []) if isinstance(root, dict) else None
    if not isinstance(entries, list) or len(entries) > _MAX_OVERRIDES:
        raise PackError(f"{place}: trim_overrides must be a list of up to {_MAX_OVERRIDES}")
    return tuple(
        _read_override(entry, f"{place}: trim_overrides {n}") for n, entry in enumerate(entries)
    )


def equipment_textures(data: bytes, place: str) -> Iterator[tuple[str, str]]:
    """The layers of a definition of equipment, and the ids of their textures.

    place: names the file in errors. Raises PackError.
    """
    root = read_json(data, place)
    layers = root.get("layers") if isinstance(root, dict) else None
    if not isinstance(layers, dict):
        raise PackError(f"{place} must have layers, an object in braces")
    for layer, entries in layers.items():
        for entry in entries if isinstance(entries, list) else [None]:
            texture = entry.get("texture") if isinstance(entry, dict) else None
            if not isinstance(texture, str):
                raise PackError(f"{place}: each layer must be a list of objects with texture")
            namespace, path = split_id(full_id(texture, place))
            yield layer[:80], f"{namespace}:entity/equipment/{layer[:80]}/{path}"


def _read_override(entry: Any, place: str) -> TrimOverride:
    when = entry.get("when", {}) if isinstance(entry, dict) else None
    if not isinstance(when, dict):
        raise PackError(f"{place} must be an object with when, texture and palette")
    return TrimOverride(
        *(_id(when, key, place) for key in ("pattern", "material")),
        *(_id(entry, key, place) for key in ("texture", "palette")),
    )


def _id(entry: Mapping[str, Any], key: str, place: str) -> str | None:
    value = entry.get(key)
    if value is None:
        return None
    if not isinstance(value, str):
        raise PackError(f"{place}: {key} must be an id such as minecraft:coast")
    return full_id(value, f"{place}: {key}")


def _override(worn: str, pattern: str, material: str, packs: Packs) -> TrimOverride:
    """What the equipment changes about a trim, by its first entry that is for it."""
    found = packs.file(f"assets/minecraft/equipment/{worn}.json", MAX_JSON)
    if found is not None and has_overrides(packs.packs[found.level].format):
        for each in trim_overrides(found.data, packs.place(found)):
            pairs = ((each.pattern, pattern), (each.material, material))
            if all(wanted in (None, full_id(given)) for wanted, given in pairs):
                return each
    return TrimOverride(None, None, None, None)


def has_overrides(format: int | None) -> bool:
    """Whether the game of a format reads overrides of trims; None is an unknown format."""
    return format is None or format > _LAST_WITHOUT_OVERRIDES


def _trim_places(layer: str, pattern: str, override: TrimOverride) -> tuple[Place, ...]:
    if override.texture is not None:
        namespace, path = split_id(override.texture)
        return (Place(f"{namespace}:trims/entity/{layer}/{path}"),)
    old = f"{pattern}_leggings" if layer == "humanoid_leggings" else pattern
    return moved(
        f"minecraft:trims/entity/{layer}/{pattern}", f"minecraft:trims/models/armor/{old}", "1.21.2"
    )


def _key_places(trim: PackFile, packs: Packs) -> tuple[Place, ...]:
    """Those of the key palette that the texture of a trim names, or else of the usual one."""
    name = f"{trim.name}.mcmeta"
    data = packs.packs[trim.level].read(name, MAX_JSON)
    base = None if data is None else _base_palette(data, name)
    if base is None or base == "minecraft:trim_base":
        return key_places()
    namespace, path = split_id(base)
    return (Place(f"{namespace}:palettes/{path}"),)


def _base_palette(data: bytes, name: str) -> str | None:
    """The id of the key palette in a `.mcmeta`, or None; one that cannot be read has been noted."""
    with suppress(PackError):
        root = read_json(data, name)
        section = root.get("palette") if isinstance(root, dict) else None
        base = section.get("base_palette") if isinstance(section, dict) else None
        return full_id(base, name) if isinstance(base, str) else None
    return None


def _palette_places(worn: str, material: str, override: TrimOverride) -> tuple[Place, ...]:
    if override.palette is not None:
        namespace, path = split_id(override.palette)
        return (Place(f"{namespace}:palettes/{path}"),)
    name = f"{material}_darker" if worn == material and material in DARKER else material
    return moved(
        f"minecraft:palettes/trim/{name}", f"minecraft:trims/color_palettes/{name}", "26.3"
    )
