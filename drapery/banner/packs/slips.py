"""Typing slips in packs: names of files and folders that are nearly those that the game reads."""

import re
from collections.abc import Iterable, Iterator, Mapping
from difflib import get_close_matches

from drapery.banner.dyes import DYE_NAMES
from drapery.banner.packs.checks import MAX_PATH, listed
from drapery.banner.packs.equipment import LAYERS, MATERIALS
from drapery.banner.packs.pack import Pack
from drapery.banner.packs.texture_ids import is_id
from drapery.banner.pattern_items import PATTERN_ITEMS
from drapery.banner.patterns import PATTERN_NAMES

_LIKENESS = 0.8
"""The least likeness of a name that is taken for a slip."""

_BASES = ("banner_base", "shield_base", "shield_base_nopattern")
_ARMOR = (*MATERIALS, "leather_overlay")
_ITEMS = (*(f"{dye}_dye" for dye in DYE_NAMES), *(item.item for item in PATTERN_ITEMS.values()))
_NAMES: Mapping[str, tuple[str, ...]] = {
    "entity": (*_BASES, "elytra"),
    "entity/banner": (*PATTERN_NAMES, "banner_base"),
    "entity/shield": (*PATTERN_NAMES, "shield_base", "shield_base_nopattern"),
    "entity/equipment/humanoid": _ARMOR,
    "entity/equipment/humanoid_leggings": _ARMOR,
    "entity/equipment/humanoid_baby": _ARMOR,
    "entity/equipment/wings": ("elytra",),
    "item": _ITEMS,
}
"""Names without .png that Drapery reads in folders of `assets/minecraft/textures`."""

_Tree = dict[str, "_Tree"]
_TEXTURES: _Tree = {
    "entity": {"banner": {}, "shield": {}, "equipment": {layer: {} for layer in LAYERS}},
    "trims": {"entity": {"humanoid": {}, "humanoid_leggings": {}}, "color_palettes": {}},
    "palettes": {"trim": {}},
    "item": {},
}
_FOLDERS: _Tree = {
    "assets": {"*": {"textures": _TEXTURES, "atlases": {}, "equipment": {}}},
    "data": {"*": {"banner_pattern": {}}},
}
"""The folders that Drapery reads; `*` is any namespace."""


def likely_slips(pack: Pack) -> tuple[str, ...]:
    """Likely slips in the names of a pack's files, folders and overlays, one line each."""
    # Only files whose kind Drapery reads; sounds and languages have names of their own.
    files = [
        name
        for top in ("assets", "data")
        for name in pack.files(top)
        if name.strip().lower().endswith((".png", ".json"))
    ]
    found = (*_missing_overlays(pack), *_odd_folders(files), *_odd_names(files), *_unknown(files))
    return tuple(f"{pack.label}: {line}" for line in found)


def _missing_overlays(pack: Pack) -> Iterator[str]:
    for name in dict.fromkeys(overlay.directory for overlay in pack.meta.overlays):
        if not pack.source.files(name):
            yield f"pack.mcmeta names the overlay {name}, but there is no such folder with files"


def _odd_folders(files: Iterable[str]) -> Iterator[str]:
    """Folders that the game does not read, but one like them."""
    seen: dict[str, str] = {}
    for name in files:
        folder = name.rpartition("/")[0]
        if folder not in seen:
            seen[folder] = _right_folder(folder.split("/"))
    pairs = dict.fromkeys(pair for pair in seen.items() if pair[1] and pair[0] != pair[1])
    for wrong, right in pairs:
        yield f"{wrong}/ is not read; did you mean {right}/?"


def _right_folder(parts: list[str]) -> str:
    """The folder that is probably meant, or nothing where there is no doubt."""
    at, given = _FOLDERS, [*parts]
    right: list[str] = []
    kinds = _FOLDERS.get(parts[0], {}).get("*", {})
    if len(parts) > 1 and parts[1] in kinds and not set(parts[2:3]) & set(kinds):
        given.insert(1, "minecraft")  # the namespace was left out
    for part in given:
        name = part if part in at else "*" if "*" in at else near(part, at)
        if not name:
            break
        right.append(part if name == "*" else name)
        at = at[name]
    right += given[len(right) :]
    return "" if right == parts else "/".join(right)


def _odd_names(files: Iterable[str]) -> Iterator[str]:
    """Files of textures whose names the game does not read."""
    wrong = {}
    for name in files:
        namespace, _, path = name.removeprefix("assets/").partition("/")
        is_texture = name.startswith("assets/") and path.startswith("textures/")
        stem, ending = path[:-4], path[-4:]
        is_read = ending == ".png" and is_id(f"{namespace}:{stem}")
        if is_texture and not is_read and path.strip().lower().endswith(".png"):
            wrong[name] = _legal(name)
    if wrong:
        names = listed((f"{name} (name it {right})" for name, right in wrong.items()), MAX_PATH)
        yield f"not read by the game, whose names have a-z, 0-9, _, - and . alone: {names}"


def _legal(path: str) -> str:
    """The nearest path that the game reads: its last name alone if only that differs."""
    names = []
    for name in path.split("/"):
        tidy = re.sub(r"\s+(?=\.)", "", name.strip().lower())
        names.append(re.sub(r"[^a-z0-9_.-]", "_", re.sub(r"\s+", "_", tidy)))
    is_last = names[:-1] == path.split("/")[:-1]
    return names[-1] if is_last else "/".join(names)


def _unknown(files: Iterable[str]) -> Iterator[str]:
    """Textures of unknown names beside missing ones of nearly the same name."""
    folders: dict[str, set[str]] = {}
    start, ending = "assets/minecraft/textures/", ".png"
    for name in files:
        folder, _, file = name.removeprefix(start).rpartition("/")
        is_read = file.endswith(ending) and is_id(f"minecraft:{file}")
        if name.startswith(start) and folder in _NAMES and is_read:
            folders.setdefault(folder, set()).add(file.removesuffix(ending))
    for folder, names in sorted(folders.items()):
        known = _NAMES[folder]
        missing = [name for name in known if name not in names]
        for name in sorted(names.difference(known)):
            meant = "" if _is_map(name, known) else near(name, missing)
            if meant:
                yield f"{start}{folder}/{name}.png is not read; did you mean {meant}.png?"


def _is_map(name: str, known: Iterable[str]) -> bool:
    """Whether this is the name of a LabPBR map of a known texture."""
    return name[-2:] in ("_n", "_s") and name[:-2] in known


def near(name: str, known: Iterable[str]) -> str:
    """The known name that is probably meant, or nothing."""
    names = [*known]
    plural = name.casefold().removesuffix("s")
    singular = f"{name[:-3]}y" if name.endswith("ies") else plural
    for each in (name.casefold(), plural, singular):
        if each in names:
            return each
    return next(iter(get_close_matches(name.casefold(), names, 1, _LIKENESS)), "")
