"""Resource packs laid over our own art: patterns, bases and other textures as texels.

A pack is a folder, a zip or a client jar. Of several, the later one wins, file by file; overlays
named in `pack.mcmeta` lie over the pack that they belong to.
"""

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

from drapery.banner.pack_meta import MAX_JSON, PackMeta, parse_meta, parse_version, read_json
from drapery.banner.pack_sources import OwnArt, Source, open_source
from drapery.banner.patterns import PATTERN_NAMES
from drapery.banner.png import Texels, read_png
from drapery.banner.sprite_sources import (
    Directory,
    SpriteSource,
    find_texture,
    parse_atlas,
    with_namespace,
)
from drapery.banner.textures import (
    Texture,
    animated,
    check_sheet,
    checker,
    from_mask,
    is_mask,
)
from drapery.errors import PackError

Kind = Literal["banner", "shield"]

MAX_PNG = 32 << 20
"""Largest PNG file that is read [bytes]."""

LAST_OLD_FORMAT = 75
"""Last format (1.21.11) in which the base texture lay beside, not in, `entity/banner`."""

_BASES = ("minecraft:entity/banner/banner_base", "minecraft:entity/banner_base")
_ID = re.compile(r"[a-z0-9_.-]+:[a-z0-9_./-]+", re.A)
_MAX_ID = 128


@dataclass(frozen=True, eq=False)
class Pack:
    """One opened pack. roots: prefixes of its names, topmost overlay first, itself last.

    format: the resource format it is read as, None where it is unknown.
    """

    source: Source
    meta: PackMeta = field(default_factory=PackMeta)
    roots: tuple[str, ...] = ("",)
    format: int | None = None

    @property
    def label(self) -> str:
        """What messages call it."""
        return self.source.label

    def read(self, name: str, limit: int) -> bytes | None:
        """The topmost file of that name, or None. Raises PackError."""
        for root in self.roots:
            data = self.source.read(root + name, limit)
            if data is not None:
                return data
        return None

    def files(self, folder: str) -> tuple[str, ...]:
        """Names of all files under a folder, overlays included, sorted."""
        found = {
            name.removeprefix(root)
            for root in self.roots
            for name in self.source.files(root + folder)
        }
        return tuple(sorted(found))

    def folders(self, folder: str) -> tuple[str, ...]:
        """Names of the folders right under a folder, overlays included, sorted."""
        return tuple(sorted({n for root in self.roots for n in self.source.folders(root + folder)}))


@dataclass(frozen=True, eq=False)
class Packs:
    """A stack of packs, lowest first; the lowest is our own art. Files are read when asked for."""

    packs: tuple[Pack, ...]
    format: int | None = None
    _textures: dict[object, Texture] = field(default_factory=dict, init=False, repr=False)
    _atlases: dict[str, tuple[SpriteSource, ...]] = field(
        default_factory=dict, init=False, repr=False
    )
    _used: set[int] = field(default_factory=set, init=False, repr=False)
    _ours: dict[str, None] = field(default_factory=dict, init=False, repr=False)
    _missing: dict[str, None] = field(default_factory=dict, init=False, repr=False)
    _notes: dict[str, None] = field(default_factory=dict, init=False, repr=False)

    def sheet(self, pattern: str, kind: Kind = "banner", time: float = 0.0) -> Texels:
        """The sheet of a pattern, shape [H, H, 4]; at a time [s] where it is animated.

        pattern: an id such as `creeper`, or `namespace:path` for one of a data pack or, without
            a definition, of a texture. A missing one is the game's checker, with a warning.
        Raises PackError.
        """
        return self._sheet(pattern, kind).at(time)

    def base_sheet(self, time: float = 0.0) -> Texels:
        """Pole, bar and undyed cloth of a banner, shape [H, H, 4]. Raises PackError."""
        return self._kept("banner_base", self._find_base).at(time)

    def shield_base(self, *, patterned: bool, time: float = 0.0) -> Texels:
        """The sheet of a shield with or without a design, shape [H, H, 4]. Raises PackError."""
        name = "shield_base" if patterned else "shield_base_nopattern"
        return self._kept(name, lambda: self._base(name, (f"minecraft:entity/{name}",))).at(time)

    def texture(self, name: str, time: float = 0.0) -> Texels:
        """Any texture by id, such as `minecraft:block/stone`, shape [H, W, 4].

        A missing one is the game's checker, with a warning. Raises PackError.
        """
        texture = _checked(with_namespace(name))
        return self._kept(texture, lambda: self._found(texture) or self._checker(texture)).at(time)

    def period(self, pattern: str, kind: Kind = "banner") -> float:
        """How long the animation of a pattern's sheet takes [s]; 0 where it is still."""
        return self._sheet(pattern, kind).period

    def normal_map(self, pattern: str, kind: Kind = "banner") -> Texels | None:
        """The LabPBR `_n` texture beside a pattern's sheet, raw, or None. Raises PackError.

        Red and green are the normal's x and y, blue is ambient occlusion, alpha is height.
        """
        return self._beside(pattern, kind, "_n")

    def specular_map(self, pattern: str, kind: Kind = "banner") -> Texels | None:
        """The LabPBR `_s` texture beside a pattern's sheet, raw, or None. Raises PackError.

        Red is smoothness, green is F0, blue is porosity, alpha is emission.
        """
        return self._beside(pattern, kind, "_s")

    def base_normal_map(self) -> Texels | None:
        """The LabPBR `_n` texture beside the banner's base, raw, or None. Raises PackError."""
        return self._map_of(self._base_places(), "_n")

    def base_specular_map(self) -> Texels | None:
        """The LabPBR `_s` texture beside the banner's base, raw, or None. Raises PackError."""
        return self._map_of(self._base_places(), "_s")

    def patterns(self) -> tuple[str, ...]:
        """Ids of the 43 patterns, then those that packs add by definition or texture, sorted."""
        added = {pattern for pack in self.packs for pattern in added_patterns(pack)}
        return PATTERN_NAMES + tuple(sorted(added))

    def warnings(self) -> tuple[str, ...]:
        """What a user should know of the textures asked for so far, one line each."""
        lines = list(self._notes)
        if self._missing:
            names = ", ".join(self._missing)
            lines.append(f"missing from the packs, drawn as the game's checker: {names}")
        if self._ours and self._used:
            names = ", ".join(self._ours)
            lines.append(f"not in the packs, taken from our own art: {names}")
        if len(self.packs) > 1 and not self._used and self._textures:
            labels = ", ".join(pack.label for pack in self.packs[1:])
            lines.append(f"nothing in this picture comes from {labels}")
        return tuple(lines)

    def _sheet(self, pattern: str, kind: Kind) -> Texture:
        return self._kept((kind, pattern), lambda: self._find_sheet(pattern, kind))

    def _find_sheet(self, pattern: str, kind: Kind) -> Texture:
        name = self._texture_id(pattern, kind)
        found = self._locate(_file(name)) if name is not None else None
        if name is None or found is None:
            return self._checker(pattern)
        level, data = found
        self._note_use(level, pattern if kind == "banner" else f"shield/{pattern}")
        return self._decoded(level, name, data, self._mask_base(kind))

    def _find_base(self) -> Texture:
        return self._base("banner_base", self._base_places())

    def _base(self, name: str, places: Sequence[str]) -> Texture:
        """The topmost pack's texture in one of these places; the first place wins within a pack."""
        for level in reversed(range(len(self.packs))):
            for place in places:
                data = self.packs[level].read(_file(place), MAX_PNG)
                if data is not None:
                    self._note_use(level, name)
                    return self._decoded(level, place, data, None)
            if any(self._hides(level, _file(place)) for place in places):
                break
        return self._checker(name)

    def _base_places(self) -> Sequence[str]:
        old = self.format is not None and self.format <= LAST_OLD_FORMAT
        return _BASES[::-1] if old else _BASES

    def _texture_id(self, pattern: str, kind: Kind) -> str | None:
        """The texture of a pattern, through its definition and the atlas; None where missing."""
        asset = self._asset_id(_checked(with_namespace(pattern)))
        namespace, path = asset.split(":", 1)
        sprite = f"{namespace}:entity/{kind}/{path}"
        return find_texture(sprite, self._atlas(kind), self._exists)

    def _asset_id(self, pattern: str) -> str:
        """What the pattern's definition in a data pack names as its asset; itself without one."""
        namespace, path = pattern.split(":", 1)
        name = f"data/{namespace}/banner_pattern/{path}.json"
        found = self._locate(name, MAX_JSON)
        if found is None:
            return pattern
        level, data = found
        place = f"{self.packs[level].label}: {name}"
        definition = read_json(data, place)
        asset = definition.get("asset_id") if isinstance(definition, dict) else None
        if not isinstance(asset, str):
            raise PackError(f"{place} must have asset_id, a text such as {pattern!r}")
        return _checked(with_namespace(asset), place)

    def _atlas(self, kind: Kind) -> tuple[SpriteSource, ...]:
        if kind not in self._atlases:
            own = Directory(f"entity/{kind}", f"entity/{kind}/")
            self._atlases[kind] = (own, *self._added_sources(kind))
        return self._atlases[kind]

    def _added_sources(self, kind: Kind) -> Iterator[SpriteSource]:
        name = f"assets/minecraft/atlases/{kind}_patterns.json"
        for pack in self.packs:
            data = pack.read(name, MAX_JSON)
            if data is not None:
                sources, unknown = parse_atlas(data, f"{pack.label}: {name}")
                for word in dict.fromkeys(unknown):
                    self._notes[f"{pack.label}: {name}: sources of type {word!r} are not read"] = (
                        None
                    )
                yield from sources

    def _beside(self, pattern: str, kind: Kind, ending: str) -> Texels | None:
        name = self._texture_id(pattern, kind)
        return None if name is None else self._map_of((name,), ending)

    def _map_of(self, places: Sequence[str], ending: str) -> Texels | None:
        """The map beside the first texture there is; a pack below it made its map for another."""
        for level in reversed(range(len(self.packs))):
            pack = self.packs[level]
            for place in places:
                data = pack.read(_file(place + ending), MAX_PNG)
                if data is not None:
                    return self._decoded(level, place + ending, data, None).at(0.0)
                if pack.read(_file(place), MAX_PNG) is not None:
                    return None
        return None

    def _found(self, texture: str) -> Texture | None:
        found = self._locate(_file(texture))
        if found is None:
            return None
        level, data = found
        self._note_use(level, texture)
        name = f"{self.packs[level].label}: {_file(texture)}"
        return animated(read_png(data, name), self._mcmeta(level, texture), f"{name}.mcmeta")

    def _decoded(
        self, level: int, texture: str, data: bytes, base: Callable[[], Texels] | None
    ) -> Texture:
        """A sheet of one pack; as a mask over `base` where it is one."""
        pack = self.packs[level]
        name = f"{pack.label}: {_file(texture)}"
        sheet = animated(read_png(data, name), self._mcmeta(level, texture), f"{name}.mcmeta")
        check_sheet(sheet, name)
        if base is None or level == 0 or not is_mask(sheet.frames[0], pack.format):
            return sheet
        return Texture(tuple(from_mask(frame, base()) for frame in sheet.frames), sheet.ticks)

    def _mcmeta(self, level: int, texture: str) -> bytes | None:
        return self.packs[level].read(f"{_file(texture)}.mcmeta", MAX_JSON)

    def _mask_base(self, kind: Kind) -> Callable[[], Texels]:
        return self.base_sheet if kind == "banner" else lambda: self.shield_base(patterned=True)

    def _locate(self, name: str, limit: int = MAX_PNG) -> tuple[int, bytes] | None:
        """The topmost pack that has a file, and the file; None where none has or one hides it."""
        for level in reversed(range(len(self.packs))):
            data = self.packs[level].read(name, limit)
            if data is not None:
                return level, data
            if self._hides(level, name):
                return None
        return None

    def _hides(self, level: int, name: str) -> bool:
        filters = self.packs[level].meta.filters
        _, namespace, path = name.split("/", 2)
        return any(hidden.matches(namespace, path) for hidden in filters)

    def _exists(self, texture: str) -> bool:
        return _ID.fullmatch(texture) is not None and self._locate(_file(texture)) is not None

    def _note_use(self, level: int, name: str) -> None:
        if level > 0:
            self._used.add(level)
        elif len(self.packs) > 1:
            self._ours[name] = None

    def _checker(self, name: str) -> Texture:
        self._missing[name] = None
        return Texture((checker(),))

    def _kept(self, key: object, make: Callable[[], Texture]) -> Texture:
        if key not in self._textures:
            self._textures[key] = make()
        return self._textures[key]


def open_packs(paths: Sequence[str | Path] = (), *, format: int | None = None) -> Packs:
    """Packs over our own art, the later over the earlier.

    paths: folders, zips or client jars.
    format: the resource format of the game to be (46 is 1.21.4); it chooses overlays, the place of
        the base texture and whether patterns are masks. None takes each pack as in the newest
        version that it claims to support.
    Raises PackError for a pack that cannot be opened; a broken file in it, only when asked for.
    """
    chosen = [paths] if isinstance(paths, str | Path) else paths
    return Packs((Pack(OwnArt()), *(open_pack(path, format) for path in chosen)), format)


def open_pack(path: str | Path, format: int | None = None) -> Pack:
    """One pack by itself; see `open_packs`. Raises PackError."""
    source = open_source(path)
    meta = _read_meta(source)
    is_assets = bool(source.folders("assets"))
    # Data packs count formats of their own, so a resource format says nothing about them.
    wanted = format if is_assets else None
    overlays = meta.directories(wanted)
    used = meta.newest() if format is None else format
    return Pack(source, meta, (*(f"{name}/" for name in overlays), ""), used)


def added_patterns(pack: Pack) -> Iterator[str]:
    """The patterns beyond the 43 that a pack defines or has a texture for, with namespace."""
    for namespace in pack.folders("data"):
        yield from _added(pack, namespace, f"data/{namespace}/banner_pattern", ".json")
    for namespace in pack.folders("assets"):
        yield from _added(pack, namespace, f"assets/{namespace}/textures/entity/banner", ".png")


def _added(pack: Pack, namespace: str, folder: str, ending: str) -> Iterator[str]:
    names = {name for name in pack.files(folder) if name.endswith(ending)}
    for name in names:
        path = name[len(folder) + 1 : -len(ending)]
        is_map = path[-2:] in ("_n", "_s") and name[: -len(ending) - 2] + ending in names
        is_ours = namespace == "minecraft" and path in (*PATTERN_NAMES, "banner_base")
        if not is_map and not is_ours and _ID.fullmatch(f"{namespace}:{path}"):
            yield f"{namespace}:{path}"


def _read_meta(source: Source) -> PackMeta:
    data = source.read("pack.mcmeta", MAX_JSON)
    if data is not None:
        return parse_meta(data, f"{source.label}: pack.mcmeta")
    # A client jar says its format elsewhere.
    data = source.read("version.json", MAX_JSON)
    return PackMeta() if data is None else parse_version(data, f"{source.label}: version.json")


def _file(texture: str) -> str:
    namespace, path = texture.split(":", 1)
    return f"assets/{namespace}/textures/{path}.png"


def _checked(name: Any, place: str = "pattern or texture") -> str:
    if len(name) > _MAX_ID or not _ID.fullmatch(name) or ".." in re.split("[:/]", name):
        raise PackError(f"{place}: {name[:80]!r} is no id: write namespace:path in a-z, 0-9, _./-")
    return str(name)
