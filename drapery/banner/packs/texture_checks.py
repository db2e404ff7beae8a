"""The textures of one pack beside its sheets: equipment, icons, blocks; are they sound?"""

from collections.abc import Iterator
from contextlib import suppress

from drapery.banner.packs.checks import MAX_PATH, listed
from drapery.banner.packs.equipment import (
    LAYERS,
    MATERIALS,
    equipment_textures,
    has_overrides,
    key_places,
    palette_fault,
    trim_overrides,
    whole_wings,
)
from drapery.banner.packs.meta import MAX_JSON
from drapery.banner.packs.pack import Pack
from drapery.banner.packs.places import wings_places
from drapery.banner.packs.png import png_size
from drapery.banner.packs.sheet_checks import Budget
from drapery.banner.packs.slips import near
from drapery.banner.packs.stack import MAX_PNG, PackFile, Packs
from drapery.banner.packs.texture_ids import is_id, split_id, texture_file
from drapery.errors import PackError

_START = "assets/minecraft/textures/"
_PALETTES = (f"{_START}palettes/trim/", f"{_START}trims/color_palettes/")
_ARMOR = tuple(f"{_START}entity/equipment/{layer}/" for layer in LAYERS[:2])
_OLD_ARMOR = f"{_START}models/armor/"


def check_textures(alone: Packs, budget: Budget, problems: list[str]) -> None:
    """Decode all textures beside the sheets of banners and shields, one at a time.

    alone: the pack over our own art. Adds the errors of broken ones to the problems.
    """
    names = [name for name in alone.packs[1].files("assets") if _is_texture(name)]
    for number, name in enumerate(names):
        if budget.left <= 0:
            budget.leave_out(len(names) - number)
            return
        try:
            file = alone.file(name, MAX_PNG)
            if file is None or file.level == 0:
                continue
            if budget.takes(file, alone.place(file)):
                alone.read(file)
            else:
                budget.leave_out(1)
        except PackError as error:
            problems.append(str(error))


def check_equipment(alone: Packs, whole: Packs, problems: list[str]) -> tuple[str, ...]:
    """Notes on what players wear; what cannot be drawn is added to the problems.

    alone: the pack over our own art. whole: the stack that it is in. Textures that are not PNG
    files at all are left to `check_textures`.
    """
    pack = alone.packs[1]
    problems += [*_wrong_palettes(pack, whole), *_wrong_wings(alone)]
    notes = [*_odd_armor(pack)]
    for name in pack.files("assets"):
        parts = name.split("/")
        if len(parts) > 3 and parts[2] == "equipment" and name.endswith(".json"):
            notes += _wrong_definition(name, pack, whole, problems)
    return tuple(notes)


def _is_texture(name: str) -> bool:
    """Whether this is a texture that is neither a sheet nor the base of a banner or shield."""
    parts = name.split("/", 3)
    if len(parts) < 4 or parts[2] != "textures" or not name.endswith(".png"):
        return False
    is_sheet = parts[3].startswith(("entity/banner/", "entity/shield/"))
    return not is_sheet and is_id(f"{parts[1]}:{parts[3][:-4]}")


def _wrong_palettes(pack: Pack, whole: Packs) -> Iterator[str]:
    """Palettes of trims that have not as many colours as their key has tones."""
    key = None
    with suppress(PackError):
        key = whole.find(key_places())
    if key is None:
        return
    for folder in _PALETTES:
        for name in pack.files(folder.rstrip("/")):
            if name.endswith(".png") and not name.endswith("/trim_palette.png"):
                with suppress(PackError):
                    fault = palette_fault(_size(name, pack)[0], png_size(key.data, key.name)[0])
                    if fault:
                        yield f"{pack.label}: {name}: {fault}"


def _wrong_wings(alone: Packs) -> Iterator[str]:
    with suppress(PackError):
        found = alone.find(wings_places())
        if found is not None and found.level > 0:
            height, width = alone.texels(found).shape[:2]
            if whole_wings(width, height) is None:
                yield (
                    f"{alone.place(found)} is {width} x {height} px, which does not fit wings;"
                    " use 64 x 32 px, or a multiple of it"
                )


def _odd_armor(pack: Pack) -> Iterator[str]:
    """Armour that is not twice as wide as high."""
    odd = []
    for name in pack.files(_START.rstrip("/")):
        is_old = name.startswith(_OLD_ARMOR) and "_layer_" in name
        if name.endswith(".png") and (is_old or name.startswith(_ARMOR)):
            with suppress(PackError):
                width, height = _size(name, pack)
                if width != 2 * height:
                    odd.append(f"{name} ({width} x {height} px)")
    if odd:
        names = listed(odd, MAX_PATH)
        yield f"{pack.label}: armour is twice as wide as high, others are stretched: {names}"


def _wrong_definition(name: str, pack: Pack, whole: Packs, problems: list[str]) -> list[str]:
    """Notes on a definition of equipment. What ends a picture is added to the problems."""
    place, notes = f"{pack.label}: {name}", []
    try:
        data = pack.read(name, MAX_JSON) or b""
        trim_overrides(data, place)
        for layer, texture in equipment_textures(data, place):
            if layer not in LAYERS:
                meant = near(layer, LAYERS)
                hint = f"; did you mean {meant}?" if meant else ""
                notes.append(f"{place}: {layer!r} is no layer of equipment{hint}")
            # The game's own textures are in no pack but its own.
            elif split_id(texture)[0] != "minecraft" and not whole.has_texture(texture):
                notes.append(f"{place}: no pack has {texture_file(texture)}")
    except PackError as error:
        # Pictures read only these definitions.
        worn = [f"assets/minecraft/equipment/{material}.json" for material in MATERIALS]
        is_read = name in worn and has_overrides(pack.format) and "trim_overrides" in str(error)
        (problems if is_read else notes).append(str(error))
    return notes


def _size(name: str, pack: Pack) -> tuple[int, int]:
    """Width and height of a PNG file [px]. Raises PackError."""
    file = PackFile(1, name, pack.read(name, MAX_PNG) or b"")
    return png_size(file.data, name)
