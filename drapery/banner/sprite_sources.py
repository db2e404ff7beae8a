"""Atlas files of packs: where the texture behind a sprite's id lies.

`assets/minecraft/atlases/<atlas>.json` of every pack adds to one list of sources, in order; a later
source wins over an earlier one, and a filter takes away what came before it.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from drapery.banner.pack_filters import Filter, parse_filter
from drapery.banner.pack_meta import read_json
from drapery.errors import PackError

_MAX_SOURCES = 4096


@dataclass(frozen=True)
class Directory:
    """Every texture under a folder, in all namespaces; the sprite's path is prefix + the rest."""

    source: str
    prefix: str


@dataclass(frozen=True)
class Single:
    """One texture under one sprite id; both with namespace."""

    resource: str
    sprite: str


SpriteSource = Directory | Single | Filter


def parse_atlas(data: bytes, name: str) -> tuple[tuple[SpriteSource, ...], tuple[str, ...]]:
    """The sources of an atlas file, and the kinds of source in it that are not read.

    Raises PackError, calling the file by name.
    """
    root = read_json(data, name)
    entries = root.get("sources") if isinstance(root, dict) else None
    if not isinstance(entries, list) or not all(isinstance(entry, dict) for entry in entries):
        raise PackError(f"{name} must have a list of objects named sources")
    if len(entries) > _MAX_SOURCES:
        raise PackError(f"{name} has {len(entries)} sources; at most {_MAX_SOURCES} are read")
    read = [_source(entry, f"{name}: source {n}") for n, entry in enumerate(entries)]
    known = tuple(source for source in read if not isinstance(source, str))
    return known, tuple(source for source in read if isinstance(source, str))


def find_texture(
    sprite: str, sources: Sequence[SpriteSource], exists: Callable[[str], bool]
) -> str | None:
    """The id of the texture behind a sprite's id (both `namespace:path`), or None."""
    namespace, path = sprite.split(":", 1)
    for source in reversed(sources):
        if isinstance(source, Filter):
            if source.matches(namespace, path):
                return None
            continue
        texture = _texture(source, sprite, namespace, path)
        if texture is not None and exists(texture):
            return texture
    return None


def with_namespace(text: str) -> str:
    """An id with its namespace, which is `minecraft` where none is written."""
    return text if ":" in text else f"minecraft:{text}"


def _texture(source: Directory | Single, sprite: str, namespace: str, path: str) -> str | None:
    if isinstance(source, Single):
        return source.resource if source.sprite == sprite else None
    if not path.startswith(source.prefix):
        return None
    return f"{namespace}:{source.source}/{path.removeprefix(source.prefix)}"


def _source(entry: dict[str, Any], name: str) -> SpriteSource | str:
    kind = _text(entry, "type", name).removeprefix("minecraft:")
    if kind == "directory":
        return Directory(_text(entry, "source", name).strip("/"), _text(entry, "prefix", name))
    if kind == "single":
        resource = with_namespace(_text(entry, "resource", name))
        sprite = _text(entry, "sprite", name) if "sprite" in entry else resource
        return Single(resource, with_namespace(sprite))
    if kind == "filter":
        return parse_filter(entry.get("pattern"), name)
    return kind


def _text(entry: dict[str, Any], key: str, name: str) -> str:
    value = entry.get(key)
    if not isinstance(value, str):
        raise PackError(f"{name} must have {key}, a text")
    return value
