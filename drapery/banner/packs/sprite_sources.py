"""Atlas files of packs: the textures of sprite ids.

`assets/minecraft/atlases/<atlas>.json` of every pack adds to one list of sources. A later source
overrides an earlier one, and a filter removes sprites of the sources before it.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from drapery.banner.packs.filters import IdFilter, parse_filter
from drapery.banner.packs.meta import read_json
from drapery.banner.packs.texture_ids import full_id, split_id
from drapery.errors import PackError

_MAX_SOURCES = 4096


@dataclass(frozen=True)
class SpriteFolder:
    """Every texture under a folder, in all namespaces. A sprite's path is prefix + the rest."""

    source: str
    prefix: str


@dataclass(frozen=True)
class SpriteTexture:
    """One texture under one sprite id; both with namespace."""

    resource: str
    sprite: str


SpriteSource = SpriteFolder | SpriteTexture | IdFilter


def parse_atlas(data: bytes, name: str) -> tuple[tuple[SpriteSource, ...], tuple[str, ...]]:
    """The sources of an atlas file, and its types of source that are not read.

    Raises PackError naming the file.
    """
    root = read_json(data, name)
    entries = root.get("sources") if isinstance(root, dict) else None
    if not isinstance(entries, list) or not all(isinstance(entry, dict) for entry in entries):
        raise PackError(f"{name} must have sources, a list of objects")
    if len(entries) > _MAX_SOURCES:
        raise PackError(f"{name} has {len(entries)} sources; at most {_MAX_SOURCES} are read")
    read = [_source(entry, f"{name}: source {n}") for n, entry in enumerate(entries)]
    known = tuple(source for source in read if not isinstance(source, str))
    return known, tuple(source for source in read if isinstance(source, str))


def textures_of(sprite: str, sources: Sequence[SpriteSource]) -> Iterator[str]:
    """The ids of textures that a sprite's id may mean, in the order to try them.

    Ids are `namespace:path`. The caller takes the first texture that exists.
    """
    namespace, path = split_id(sprite)
    for source in reversed(sources):
        if isinstance(source, IdFilter):
            if source.matches(namespace, path):
                return
        elif isinstance(source, SpriteTexture):
            if source.sprite == sprite:
                yield source.resource
        elif path.startswith(source.prefix):
            yield f"{namespace}:{source.source}/{path.removeprefix(source.prefix)}"


def _source(entry: dict[str, Any], name: str) -> SpriteSource | str:
    kind = _text(entry, "type", name).removeprefix("minecraft:")
    if kind == "directory":
        return SpriteFolder(_text(entry, "source", name).strip("/"), _text(entry, "prefix", name))
    if kind == "single":
        resource = full_id(_text(entry, "resource", name), name)
        sprite = _text(entry, "sprite", name) if "sprite" in entry else resource
        return SpriteTexture(resource, full_id(sprite, name))
    if kind == "filter":
        return parse_filter(entry.get("pattern"), name)
    return kind


def _text(entry: dict[str, Any], key: str, name: str) -> str:
    value = entry.get(key)
    if not isinstance(value, str):
        raise PackError(f"{name} must have {key}, a string")
    return value
