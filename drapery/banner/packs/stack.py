"""Resource packs over our own art: patterns, bases and other textures as texels.

A pack is a folder, a zip, a client jar or a pack in memory. A later pack overrides the files of
earlier ones. The overlays of a pack, named in its `pack.mcmeta`, override its other files.
"""

from collections.abc import Callable, Hashable, Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import lru_cache
from pathlib import Path
from typing import Literal

from drapery.arrays import Texels
from drapery.banner.names import shown
from drapery.banner.packs.checks import MAX_PATH, listed
from drapery.banner.packs.folders import OwnArt
from drapery.banner.packs.masks import are_masks, looks_like_mask
from drapery.banner.packs.memory import MemoryPack
from drapery.banner.packs.meta import MAX_JSON, read_json
from drapery.banner.packs.pack import Pack, added_patterns, extra_sprites, open_pack
from drapery.banner.packs.places import Place, base_places, in_order, wings_places
from drapery.banner.packs.png import MAX_PIXELS, is_plain_rgba, png_size, read_png
from drapery.banner.packs.png_chunks import wrong_checksums
from drapery.banner.packs.resampling import squared
from drapery.banner.packs.sources import PackSource
from drapery.banner.packs.sprite_sources import SpriteFolder, SpriteSource, parse_atlas, textures_of
from drapery.banner.packs.texture_cache import TextureCache
from drapery.banner.packs.texture_ids import full_id, is_id, split_id, texture_file
from drapery.banner.packs.textures import (
    MAX_SHEET,
    MISSING,
    FrameLayout,
    Texture,
    check_sheet,
    cut_frames,
    frame_layout,
    still_layout,
)
from drapery.banner.packs.versions import LAST_MASK_FORMAT, LAST_RGBA_MASK_FORMAT, NEWEST_FORMAT
from drapery.banner.patterns import PATTERN_NAMES
from drapery.errors import PackError

Kind = Literal["banner", "shield"]
Base = Literal["banner_base", "shield_base", "shield_base_nopattern"]

MAX_PNG = 32 << 20
"""Largest PNG file that is read [bytes]."""


_GAME_BASE = (64, 64)
"""Width and height of the game's own bases [px]."""


def sheet_name(pattern: str, kind: Kind) -> str:
    """What messages call a pattern's sheet."""
    return pattern if kind == "banner" else f"{pattern} (shield)"


@dataclass(frozen=True)
class PackFile:
    """A file of a pack. level: the pack's place in the stack. name: the file inside it."""

    level: int
    name: str
    data: bytes


@dataclass(frozen=True, eq=False)
class Packs:
    """A stack of packs, lowest first; the lowest is our own art. Files are read when needed.
    `open_packs` makes one.

    packs: the packs of the stack, lowest first.
    format: the resource format that they were opened for, or None.
    """

    packs: tuple[Pack, ...]
    format: int | None = None
    _textures: TextureCache = field(default_factory=TextureCache, init=False, repr=False)
    _atlases: dict[Kind, tuple[SpriteSource, ...]] = field(
        default_factory=dict, init=False, repr=False
    )
    _masked: dict[tuple[int, Kind], bool] = field(default_factory=dict, init=False, repr=False)
    _used: set[int] = field(default_factory=set, init=False, repr=False)
    # Dictionaries as sets that keep their order.
    _ours: dict[str, None] = field(default_factory=dict, init=False, repr=False)
    _missing: dict[str, None] = field(default_factory=dict, init=False, repr=False)
    _black: dict[str, None] = field(default_factory=dict, init=False, repr=False)
    _notes: dict[str, None] = field(default_factory=dict, init=False, repr=False)
    _gathered: dict[tuple[int, str], dict[str, None]] = field(
        default_factory=dict, init=False, repr=False
    )

    def sheet(self, pattern: str, kind: Kind = "banner", time: float = 0.0) -> Texels:
        """The sheet of a pattern, shape [H, H, 4].

        pattern: an id such as `creeper`, or `namespace:path` for a pattern of a data pack, of a
            MemoryPack or of a texture. A missing one is the game's checker, with a warning.
        kind: what the sheet is for, a banner or a shield.
        time: of its animation [s].

        Raises PackError for a file that cannot be used.
        """
        return self._sheet(pattern, kind).at(time)

    def base(self, base: Base, time: float = 0.0) -> Texels:
        """The sheet under a design, or of a shield without one, shape [H, H, 4].

        base: `banner_base`, `shield_base` or `shield_base_nopattern`.
        time: of its animation [s].

        Raises PackError for a file that cannot be used.
        """
        return self._kept(base, base, lambda: self._read_base(base)).at(time)

    def base_sheet(self, time: float = 0.0) -> Texels:
        """Pole, bar and undyed cloth of a banner, shape [H, H, 4].

        Raises PackError.
        """
        return self.base("banner_base", time)

    def texture(self, name: str, time: float = 0.0) -> Texels:
        """Any texture by id, shape [H, W, 4]. A missing one is the game's checker, with a warning.

        name: such as `minecraft:block/stone`.
        time: of its animation [s].

        Raises PackError for a file that cannot be used.
        """
        full = full_id(name)
        return self._kept(full, full, lambda: self._any_texture(full)).at(time)

    def has_texture(self, name: str) -> bool:
        """Whether a pack or our own art has a texture of this id.

        Raises PackError.
        """
        return self._find([texture_file(full_id(name))]) is not None

    def elytra(self) -> Texels | None:
        """The sheet of wings and sometimes of a cape, shape [H, W, 4], or None if no pack has one.

        Raises PackError.
        """
        return self.placed(wings_places())

    def placed(self, places: Sequence[Place]) -> Texels | None:
        """The texture at the first of some places that a pack has, shape [H, W, 4], or None.

        See `find`.

        Raises PackError.
        """
        found = self.find(places)
        return None if found is None else self.texels(found)

    def find(self, places: Sequence[Place]) -> PackFile | None:
        """The file at the first of some places that a pack has, or None.

        The topmost pack that has one counts, and in it the place where the game of its format
        looks.

        Raises PackError.
        """
        at = {place.file: place for place in places}
        found = self._find(
            [*at], lambda pack: [each.file for each in in_order(places, pack.format)]
        )
        if found is None:
            return None
        pack, place = self.packs[found.level], at[found.name]
        if not place.is_for(pack.format):
            right = next(each.file for each in places if each.is_for(pack.format))
            self._notes[
                f"{self.place(found)} is not where the game of format {pack.format} looks;"
                f" it is read all the same: move it to {right}"
            ] = None
        return found

    def file(self, name: str, limit: int) -> PackFile | None:
        """The topmost pack's file of a name, or None.

        name: the path in the pack.
        limit: the largest size that is read [bytes].

        Raises PackError for a file that is larger or cannot be read.
        """
        return self._find([name], limit=limit)

    def texels(self, file: PackFile, time: float = 0.0) -> Texels:
        """The texture of a file, shape [H, W, 4].

        file: one that `find` gives.
        time: of its animation [s].

        Raises PackError for a file that cannot be used.
        """
        key = ("file", file.level, file.name)
        return self._kept(key, file.name, lambda: self.read(file)).at(time)

    def read(self, file: PackFile) -> Texture:
        """The texture of a file that `find` gave, which is not kept.

        Raises PackError.
        """
        return self._read(file, file.name)

    def place(self, file: PackFile) -> str:
        """The pack and the name of a file, for messages."""
        return f"{self.packs[file.level].label}: {file.name}"

    def period(self, pattern: str, kind: Kind = "banner") -> float:
        """The length of the animation of a pattern's sheet [s]; 0 if it is still.

        pattern: its id, see `sheet`.
        kind: what the sheet is for, a banner or a shield.
        """
        return self._sheet(pattern, kind).period

    def normal_map(self, pattern: str, kind: Kind = "banner") -> Texels | None:
        """The LabPBR `_n` texture beside a pattern's sheet, raw, shape [H, W, 4], or None.

        Red and green are the normal's x and y, blue is ambient occlusion, alpha is height.

        pattern: its id, see `sheet`.
        kind: what the sheet is for, a banner or a shield.

        Raises PackError for a file that cannot be used.
        """
        return self._map(self._find_sheet(pattern, kind), "_n")

    def specular_map(self, pattern: str, kind: Kind = "banner") -> Texels | None:
        """The LabPBR `_s` texture beside a pattern's sheet, raw, shape [H, W, 4], or None.

        Red is smoothness, green is F0, blue is porosity, alpha is emission.

        pattern: its id, see `sheet`.
        kind: what the sheet is for, a banner or a shield.

        Raises PackError for a file that cannot be used.
        """
        return self._map(self._find_sheet(pattern, kind), "_s")

    def base_normal_map(self, base: Base = "banner_base") -> Texels | None:
        """The LabPBR `_n` texture beside a base, raw, or None.

        Raises PackError.
        """
        return self._map(self._find_base(base), "_n")

    def base_specular_map(self, base: Base = "banner_base") -> Texels | None:
        """The LabPBR `_s` texture beside a base, raw, or None.

        Raises PackError.
        """
        return self._map(self._find_base(base), "_s")

    def patterns(self) -> tuple[str, ...]:
        """Ids of the 43 patterns, then those that packs add by definition or texture, sorted.

        Those in the game's own namespace are extra: no design can name them; see `extra_sprites`.
        """
        added = {name for pack in self.packs for name in added_patterns(pack)}
        return PATTERN_NAMES + tuple(sorted({*added, *self.extra_sprites()}))

    def extra_sprites(self) -> tuple[str, ...]:
        """Ids, sorted, of sheets in the game's own namespace that are none of the 43 patterns.

        No design can name them; `sheet` reads them.
        """
        return tuple(sorted({name for pack in self.packs for name in extra_sprites(pack)}))

    def level(self, pattern: str, kind: Kind = "banner") -> int | None:
        """The index in `packs` of the pack with a pattern's sheet, or None if it is missing.

        pattern: its id, see `sheet`.
        kind: what the sheet is for, a banner or a shield.
        """
        found = self._find_sheet(pattern, kind)
        return None if found is None else found.level

    def base_level(self, base: Base = "banner_base") -> int | None:
        """The index in `packs` of the pack with a base, or None if it is missing."""
        found = self._find_base(base)
        return None if found is None else found.level

    def files(self, pattern: str, kind: Kind = "banner") -> tuple[PackFile, ...]:
        """The files of a pattern's sheet and of its LabPBR maps, as they lie in the packs.

        pattern: its id, see `sheet`.
        kind: what the sheet is for, a banner or a shield.

        Raises PackError for a pack that cannot be read.
        """
        sheet = self._find_sheet(pattern, kind)
        found = (sheet, self._find_map(sheet, "_n"), self._find_map(sheet, "_s"))
        return tuple(file for file in found if file is not None)

    def notes(self) -> tuple[str, ...]:
        """What was read otherwise than it lies in the packs, or not at all, one line each."""
        given = (line for pack in self.packs[1:] for line in pack.notes())
        return (*dict.fromkeys((*given, *self._notes, *self._gathered_notes())),)

    def warnings(self) -> tuple[str, ...]:
        """Warnings about the textures read so far, one line each; they name the packs."""
        lines = list(self.notes())
        given = self.packs[1:]
        labels = listed(pack.label for pack in given) if given else "our own art"
        if self._missing:
            names = ", ".join(self._missing)
            lines.append(f"missing from {labels}, drawn as the game's checker: {names}")
        if self._ours and self._used and not self._all_in_memory():
            lines.append(f"not in {labels}, taken from our own art: {', '.join(self._ours)}")
        if self._black:
            names = ", ".join(self._black)
            lines.append(
                f"drawn with opaque black, as the game draws it: {names} of {labels}"
                " (masks from before 1.15? use format 4 to read them as masks)"
            )
        if (self._ours or self._missing) and given and not self._used:
            lines.append(f"no texture comes from {labels}: the textures needed are not in it")
        return tuple(lines)

    def _gather(self, file: PackFile, words: str, line: str) -> None:
        """Note a file, with others of its pack in one line. line: has {} for the words of all."""
        self._gathered.setdefault((file.level, line), {})[words] = None

    def _gathered_notes(self) -> Iterator[str]:
        for (level, line), words in sorted(self._gathered.items()):
            yield f"{self.packs[level].label}: {line.format(listed(words, MAX_PATH))}"

    def _all_in_memory(self) -> bool:
        """Whether all packs are made of arrays, which hold only what they replace."""
        return all(isinstance(pack.source, MemoryPack) for pack in self.packs[1:])

    def _sheet(self, pattern: str, kind: Kind) -> Texture:
        name = sheet_name(pattern, kind)
        return self._kept((kind, pattern), name, lambda: self._read_sheet(pattern, kind))

    def _kept(self, key: Hashable, name: str, read: Callable[[], Texture]) -> Texture:
        """The texture of a key in a cache; notes the name of a missing one for the warnings."""
        # Without packs over it, our own art says the same in every stack, and its files do not
        # change while a process runs.
        own = isinstance(self.packs[-1].source, OwnArt)
        texture = (_OWN_TEXTURES if own else self._textures).get(key, read)
        if texture is MISSING:
            self._missing[name] = None
        return texture

    def _read_sheet(self, pattern: str, kind: Kind) -> Texture:
        found = self._find_sheet(pattern, kind)
        name = sheet_name(pattern, kind)
        sheet = self._read(found, name, is_sheet=True)
        if found is None:
            return sheet
        if found.level == 0:  # our own art has no masks, whatever the format of the game
            return sheet
        if not self._has_masks(found.level, kind):
            if looks_like_mask(sheet.frames[0]):
                self._black[name] = None
            return sheet
        base: Base = "banner_base" if kind == "banner" else "shield_base"
        self._note_mask(found, self._find_base(base))
        return replace(sheet, base=self.base(base))

    def _note_mask(self, mask: PackFile, base: PackFile | None) -> None:
        """Note a mask that the game to 1.14 leaves out."""
        size = png_size(mask.data, self.place(mask))
        # Our own base has the place of the game's.
        own = base is None or base.level == 0
        wanted = _GAME_BASE if own or base is None else png_size(base.data, self.place(base))
        if size != wanted:
            self._gather(
                mask,
                f"{mask.name} ({size[0]} x {size[1]} px)",
                f"to 1.14 the game leaves out masks that have not the size of the base,"
                f" {wanted[0]} x {wanted[1]} px: {{}}",
            )
        format = self.packs[mask.level].format
        if format is not None and format <= LAST_RGBA_MASK_FORMAT and not is_plain_rgba(mask.data):
            self._gather(
                mask,
                mask.name,
                "to 1.12 the game leaves out masks that are not RGBA with 8 bits a channel: {}",
            )

    def _has_masks(self, level: int, kind: Kind) -> bool:
        """Whether a pack's sheets are masks: by the format if one is asked for, else by vote."""
        pack = self.packs[level]
        is_old = pack.format is not None and pack.format <= LAST_MASK_FORMAT
        is_given = self.format is not None or pack.format != pack.meta.newest()
        if is_given or not (is_old or pack.format is None):
            return is_old
        if (level, kind) not in self._masked:
            self._masked[level, kind] = are_masks(_voters(pack, kind), default=is_old)
            if is_old and not self._masked[level, kind]:
                self._notes[
                    f"{pack.label} has format {pack.format}, but its {kind} sheets are not masks,"
                    " so they are read as those of newer packs (use format 4 to read them as masks)"
                ] = None
        return self._masked[level, kind]

    def _read_base(self, base: Base) -> Texture:
        return self._read(self._find_base(base), base, is_sheet=True)

    def _any_texture(self, full: str) -> Texture:
        return self._read(self._find([texture_file(full)]), full)

    def _read(self, found: PackFile | None, name: str, *, is_sheet: bool = False) -> Texture:
        """The texture of a file; MISSING if it is None.

        name: of a sheet, for the warnings.
        is_sheet: whether it is stretched to a square; its size is checked before it is decoded.
        """
        if found is None:
            return MISSING
        if is_sheet and found.level > 0:
            self._used.add(found.level)
        elif is_sheet and len(self.packs) > 1:
            self._ours[name] = None
        place, layout = self.place(found), self._layout(found)
        if is_sheet:
            check_sheet(layout, place)
            if layout.width != layout.height:
                self._gather(
                    found,
                    f"{found.name} is {layout.width} x {layout.height} px",
                    "{}: stretched to a square, as in the game",
                )
        return replace(cut_frames(self._decoded(found), layout), is_sheet=is_sheet)

    def _decoded(self, found: PackFile) -> Texels:
        """The texels of a file. Notes its wrong checksums. Raises PackError."""
        place = self.place(found)
        if isinstance(self.packs[found.level].source, OwnArt):
            return _own_texels(found.data, place)
        texels = read_png(found.data, place)
        wrong = wrong_checksums(found.data, place)
        if wrong:
            self._gather(
                found,
                f"{found.name} ({', '.join(wrong)})",
                "wrong checksums, which the game does not check, in {}: save these files again",
            )
        return texels

    def _layout(self, found: PackFile) -> FrameLayout:
        """The frames of a picture, one where its animation is wrong, with a note.

        Raises PackError.
        """
        place = self.place(found)
        size = png_size(found.data, place)
        mcmeta = self.packs[found.level].read(f"{found.name}.mcmeta", MAX_JSON)
        try:
            return frame_layout(*size, mcmeta, f"{place}.mcmeta")
        except PackError as error:
            self._notes[f"{error}; it is drawn as a still"] = None
            return still_layout(*size)

    def _map(self, found: PackFile | None, ending: str) -> Texels | None:
        """The map beside a texture, from its pack or one above. Maps of lower packs belong to
        other textures."""
        beside = self._find_map(found, ending)
        if found is None or beside is None:
            return None
        texels = self._decoded(beside)
        layout = self._layout(found)
        height, width = texels.shape[:2]
        # A map that is stretched like its sheet; else what is tall is a strip of frames.
        is_alike = width * layout.height == height * layout.width
        return squared(texels) if is_alike and max(width, height) <= MAX_SHEET else texels

    def _find_map(self, found: PackFile | None, ending: str) -> PackFile | None:
        if found is None:
            return None
        name = f"{found.name.removesuffix('.png')}{ending}.png"
        return self._find([name], lowest=found.level)

    def _find_sheet(self, pattern: str, kind: Kind) -> PackFile | None:
        """The file of a pattern's sheet, through its definition and the atlas."""
        namespace, path = split_id(self.asset_id(full_id(pattern)))
        sprite = f"{namespace}:entity/{kind}/{path}"
        for texture in textures_of(sprite, self._atlas(kind)):
            found = self._find([texture_file(texture)]) if is_id(texture) else None
            if found is not None:
                return found
        return None

    def _find_base(self, base: Base) -> PackFile | None:
        """The file of a base, at its place before or since 26.1."""
        return self.find(base_places(base))

    def _find(
        self,
        names: Sequence[str],
        order: Callable[[Pack], Sequence[str]] | None = None,
        *,
        lowest: int = 0,
        limit: int = MAX_PNG,
    ) -> PackFile | None:
        """The topmost pack's file of one of these names, the first that it has.

        order: of the names in a pack, if packs differ. None where no pack from `lowest` up has
        one, or a pack above it hides it.
        """
        for level in reversed(range(lowest, len(self.packs))):
            pack = self.packs[level]
            for name in (name for name in (order(pack) if order else names) if name in names):
                data = pack.read(name, limit)
                if data is not None:
                    return PackFile(level, name, data)
            names = [name for name in names if not pack.hides(name)]
        return None

    def asset_id(self, pattern: str) -> str:
        """The asset id in the pattern's definition in a data pack, or the pattern itself.

        pattern: with its namespace.

        Raises PackError.
        """
        namespace, path = split_id(pattern)
        found = self._find([f"data/{namespace}/banner_pattern/{path}.json"], limit=MAX_JSON)
        if found is None:
            return pattern
        place = self.place(found)
        definition = read_json(found.data, place)
        asset = definition.get("asset_id") if isinstance(definition, dict) else None
        if not isinstance(asset, str):
            raise PackError(f"{place} must have asset_id, a string such as {pattern!r}")
        return full_id(asset, place)

    def _atlas(self, kind: Kind) -> tuple[SpriteSource, ...]:
        if kind not in self._atlases:
            game = SpriteFolder(f"entity/{kind}", f"entity/{kind}/")
            self._atlases[kind] = (game, *self._added_sources(kind))
        return self._atlases[kind]

    def _added_sources(self, kind: Kind) -> Iterator[SpriteSource]:
        name = f"assets/minecraft/atlases/{kind}_patterns.json"
        for pack in self.packs:
            data = pack.read(name, MAX_JSON)
            if data is not None:
                place = f"{pack.label}: {name}"
                sources, unknown = parse_atlas(data, place)
                if unknown:
                    self._notes[f"{place}: sources of type {listed(unknown)} are not read"] = None
                yield from sources


def _voters(pack: Pack, kind: Kind) -> Iterator[Texels]:
    """The sheets of a pack that tell whether they are masks, one at a time, within a limit.

    Gradients come first, which tell most in packs of large sheets. Broken files do not vote.
    """
    left = MAX_PIXELS
    for name in sorted(PATTERN_NAMES, key=lambda name: not name.startswith("gradient")):
        file = f"assets/minecraft/textures/entity/{kind}/{name}.png"
        with suppress(PackError):
            data = pack.read(file, MAX_PNG)
            if data is None:
                continue
            width, height = png_size(data, file)
            if width * height <= left:
                left -= width * height
                yield read_png(data, file)


PackLike = str | Path | PackSource | Pack | Packs
"""A path, a MemoryPack or other source of files, an opened pack, or an opened stack."""


_OWN_TEXTURES = TextureCache()
"""Those of stacks without packs."""


@lru_cache(maxsize=128)
def _own_texels(data: bytes, place: str) -> Texels:
    """The texels of a file of our own art, which each stack has: those of a picture are decoded
    once a process."""
    texels = read_png(data, place)
    texels.flags.writeable = False
    return texels


def open_packs(packs: PackLike | Sequence[PackLike] = (), *, format: int | None = None) -> Packs:
    """A stack of packs over our own art; later packs override earlier ones.

    packs: folders, zips or client jars, packs in memory, or packs already opened. An opened stack
        is returned unchanged; in a list, its packs are used without our own art.
    format: the resource format of the game version to draw (46 is 1.21.4); it selects overlays, the
        place of the base texture and whether patterns are masks, also of packs that were opened for
        another one. None reads each pack as the newest version that it claims to support does.

    Raises PackError for a pack that cannot be opened, and for a stack that was opened for another
    format. A broken file in a pack raises PackError when it is read.
    """
    if isinstance(packs, Packs):
        return _of_format(packs, format)
    if isinstance(packs, str | Path | Pack | PackSource):
        packs = [packs]
    if isinstance(packs, Sequence) and len(packs) == 1 and isinstance(packs[0], Packs):
        return _of_format(packs[0], format)  # with all that it has read before
    if not isinstance(packs, Iterable):
        raise PackError(f"packs is {shown(packs)}: give a path, a pack or a list of them")
    chosen = (pack for each in packs for pack in _opened(each, format))
    opened = Packs((Pack(OwnArt()), *chosen), format)
    if format is not None and format > NEWEST_FORMAT:
        opened._notes[
            f"format {format} is after {NEWEST_FORMAT}, the newest known here, and is read as that"
            " one"
        ] = None
    return opened


def _opened(pack: PackLike, format: int | None) -> tuple[Pack, ...]:
    if isinstance(pack, Packs):
        return _of_format(pack, format).packs[1:]
    if isinstance(pack, Pack):
        return (pack if format in (None, pack.format) else open_pack(pack.source, format),)
    return (open_pack(pack, format),)


def _of_format(packs: Packs, format: int | None) -> Packs:
    if format not in (None, packs.format):
        raise PackError(
            f"the packs are opened for format {packs.format}: open them with format={format}"
        )
    return packs
