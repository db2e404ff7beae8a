"""One resource or data pack: its files, overridden by its overlays."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from drapery.banner.names import is_custom
from drapery.banner.packs.meta import MAX_JSON, PackMeta, parse_meta, parse_version
from drapery.banner.packs.sources import PackSource, open_source
from drapery.banner.packs.texture_ids import is_id
from drapery.banner.packs.versions import NEWEST_FORMAT
from drapery.banner.patterns import PATTERN_NAMES


@dataclass(frozen=True, eq=False)
class Pack:
    """One opened pack.

    source: the files of the pack.
    meta: what its `pack.mcmeta` says.
    roots: the folders of its files: topmost overlay first, the pack itself last.
    format: the resource format that it is read as, None if it is unknown.
    """

    source: PackSource
    meta: PackMeta = field(default_factory=PackMeta)
    roots: tuple[str, ...] = ("",)
    format: int | None = None

    @property
    def label(self) -> str:
        """The name of the pack in messages."""
        return self.source.label

    def read(self, name: str, limit: int) -> bytes | None:
        """The topmost file of a name, or None.

        name: the path in the pack.
        limit: the largest size that is read [bytes].

        Raises PackError for a file that is larger or cannot be read.
        """
        for root in self.roots:
            data = self.source.read(root + name, limit)
            if data is not None:
                return data
        return None

    def notes(self) -> tuple[str, ...]:
        """What is to be said about its `pack.mcmeta`, one line each."""
        formats = self.meta.supported()
        is_newer = formats is not None and formats[0] > NEWEST_FORMAT
        if not is_newer or not self.source.folders("assets"):
            return self.meta.notes
        line = (
            f"{self.label} is only for formats after {NEWEST_FORMAT}, the newest known here,"
            " and is read as that one"
        )
        return (*self.meta.notes, line)

    def hides(self, name: str) -> bool:
        """Whether its filters hide this file in the packs below."""
        _, namespace, path = name.split("/", 2)
        return any(hidden.matches(namespace, path) for hidden in self.meta.filters)

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


def open_pack(path: str | Path | PackSource, format: int | None = None) -> Pack:
    """One pack, without our own art below it.

    path: a folder, zip or jar, or a source of files such as MemoryPack.
    format: the resource format of the game; None is the newest that the pack supports.
    Raises PackError naming the path and the remedy.
    """
    source = open_source(path)
    meta = _read_meta(source)
    # Data packs use other format numbers, so a resource format does not apply to them.
    has_assets = bool(source.folders("assets"))
    names = meta.directories(format if has_assets else None, of_data=not has_assets)
    roots = (*(f"{name}/" for name in names), "")
    return Pack(source, meta, roots, meta.newest() if format is None else format)


def added_patterns(pack: Pack) -> tuple[str, ...]:
    """Full ids, sorted, of the patterns beyond the 43 that a pack defines or has a texture for."""
    return tuple(name for name in _found_patterns(pack) if is_custom(name))


def extra_sprites(pack: Pack) -> tuple[str, ...]:
    """Full ids, sorted, of further patterns in the game's own namespace; no design can name them.

    The game has no such pattern, so their textures are left over or wrongly named.
    """
    return tuple(name for name in _found_patterns(pack) if not is_custom(name))


def _found_patterns(pack: Pack) -> list[str]:
    found = {
        name
        for namespace in pack.folders("data")
        for name in _ids(pack, namespace, f"data/{namespace}/banner_pattern", ".json")
    }
    for namespace in pack.folders("assets"):
        folder = f"assets/{namespace}/textures/entity/banner"
        found |= _without_maps(set(_ids(pack, namespace, folder, ".png")))
    ours = {f"minecraft:{name}" for name in (*PATTERN_NAMES, "banner_base")}
    return sorted(found - ours)


def _ids(pack: Pack, namespace: str, folder: str, ending: str) -> Iterator[str]:
    for name in pack.files(folder):
        full = f"{namespace}:{name[len(folder) + 1 : -len(ending)]}"
        if name.endswith(ending) and is_id(full):
            yield full


def _without_maps(names: set[str]) -> set[str]:
    """The names without those of LabPBR maps of other textures."""
    return {name for name in names if name[-2:] not in ("_n", "_s") or name[:-2] not in names}


def _read_meta(source: PackSource) -> PackMeta:
    data = source.read("pack.mcmeta", MAX_JSON)
    if data is not None:
        return parse_meta(data, f"{source.label}: pack.mcmeta")
    # A client jar has its format in another file.
    data = source.read("version.json", MAX_JSON)
    return PackMeta() if data is None else parse_version(data, f"{source.label}: version.json")
