"""`pack.mcmeta`: which versions of the game a pack is for, and its overlays and filters.

`drapery.banner.packs.versions` lists the formats.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from drapery.banner.names import shown
from drapery.banner.packs.filters import IdFilter, parse_filter
from drapery.banner.packs.versions import LAST_WITHOUT_MINOR, NEWEST_DATA_FORMAT, NEWEST_FORMAT
from drapery.errors import PackError
from drapery.json_text import JSONTextError, parse_json

Format = tuple[float, float]
"""Major and minor format number."""

MAX_JSON = 1 << 20
"""Largest JSON file that is read [bytes]."""

_MAX_OVERLAYS = 256
_ANY_MINOR = float("inf")


@dataclass(frozen=True)
class FormatRange:
    """Formats from lowest to highest, both included."""

    lowest: Format
    highest: Format

    def __contains__(self, wanted: float) -> bool:
        # A major number alone means all its minors.
        return self.lowest[0] <= wanted <= self.highest[0]


@dataclass(frozen=True)
class Overlay:
    """A folder whose files override the pack's in a range of formats."""

    directory: str
    formats: FormatRange


@dataclass(frozen=True)
class PackMeta:
    """The contents of `pack.mcmeta`; a pack without one has the defaults.

    format: the declared format, or None. formats: all that it claims to support, or None.
    overlays: lowest first. filters: files of the packs below that are hidden.
    notes: what the game refuses although it can be read.
    """

    format: int | None = None
    formats: FormatRange | None = None
    overlays: tuple[Overlay, ...] = ()
    filters: tuple[IdFilter, ...] = ()
    description: str = ""
    notes: tuple[str, ...] = ()

    def newest(self) -> int | None:
        """The newest known format that the pack claims to support, or the newest known at all."""
        own = self._own_newest(NEWEST_FORMAT)
        return None if own is None else min(own, NEWEST_FORMAT)

    def _own_newest(self, known: int) -> int | None:
        """The newest format up to a known one that the pack claims to support, or its lowest."""
        if self.formats is None:
            return self.format
        highest = max(self.formats.highest[0], self.format or 0)
        return int(min(highest, max(self.formats.lowest[0], known)))

    def supported(self) -> tuple[int, int] | None:
        """The lowest and the highest format that the pack claims to support."""
        if self.formats is not None:
            return int(self.formats.lowest[0]), int(self.formats.highest[0])
        return None if self.format is None else (self.format, self.format)

    def directories(self, wanted: int | None, *, of_data: bool = False) -> tuple[str, ...]:
        """The folders of the overlays for a format, topmost first; None is the pack's newest.

        of_data: whether its formats are those of data packs.
        """
        known = NEWEST_DATA_FORMAT if of_data else NEWEST_FORMAT
        target = self._own_newest(known) if wanted is None else wanted
        if target is None:
            return ()
        chosen = [o.directory for o in self.overlays if target in o.formats]
        return tuple(reversed(chosen))


def read_json(data: bytes, name: str) -> Any:
    """Parse a JSON file of a pack. Raises PackError with its name, line and column."""
    try:
        return parse_json(data.decode("utf-8-sig"), strict=False)
    except UnicodeDecodeError as error:
        raise PackError(f"{name}: byte {error.start} is not UTF-8: save it as UTF-8") from None
    except JSONTextError as error:
        raise PackError(f"{name}{error}") from None


def parse_meta(data: bytes, name: str) -> PackMeta:
    """Read `pack.mcmeta`. name: the name of the file in errors. Raises PackError."""
    root = read_json(data, name)
    pack = _object(root, "pack", name)
    declared = pack.get("pack_format")
    formats = _formats(pack, "supported_formats", f"{name}: pack")
    if isinstance(declared, list | float) and not isinstance(declared, bool):
        declared = int(_edge(declared, 0, f"{name}: pack_format")[0])
    if declared is not None and not _is_count(declared):
        raise PackError(f"{name}: pack_format must be a number, not {shown(declared)}")
    if declared is None and formats is not None:
        declared = int(formats.lowest[0])
    return PackMeta(
        declared,
        formats,
        _overlays(root, name),
        _filters(root, name),
        _one_line(_plain_text(pack.get("description", ""))),
        tuple(_refused(pack, formats, name)),
    )


def _refused(pack: dict[str, Any], formats: FormatRange | None, name: str) -> Iterator[str]:
    """What the game refuses in a pack of these fields although it can be read."""
    ends = [key for key in ("min_format", "max_format") if key in pack]
    if len(ends) == 1:
        yield f"{name}: {ends[0]} stands alone, which the game refuses: give min_format, max_format"
    is_new = bool(ends) and formats is not None and formats.lowest[0] > LAST_WITHOUT_MINOR
    if is_new and "supported_formats" in pack:
        yield (
            f"{name}: supported_formats stands in a pack only for formats after"
            f" {LAST_WITHOUT_MINOR}, which the game refuses: leave it out"
        )


def parse_version(data: bytes, name: str) -> PackMeta:
    """Read the `version.json` of a client jar. Raises PackError."""
    root = read_json(data, name)
    version = root.get("pack_version") if isinstance(root, dict) else None
    if isinstance(version, dict):
        version = version.get("resource_major", version.get("resource"))
    title = root.get("name") if isinstance(root, dict) else None
    text = _one_line(f"Minecraft {title}") if isinstance(title, str) else ""
    return PackMeta(version if _is_count(version) else None, description=text)


def _plain_text(component: Any, depth: int = 16) -> str:
    """The text of a text component: a string, a list, or an object with text and extra."""
    if isinstance(component, list) and depth:
        return "".join(_plain_text(part, depth - 1) for part in component)
    if isinstance(component, dict) and depth:
        own = component.get("text", component.get("fallback", component.get("translate", "")))
        return _plain_text(own, 0) + _plain_text(component.get("extra", []), depth - 1)
    return component if isinstance(component, str) else ""


def _one_line(text: str) -> str:
    """One line for a terminal, without control codes and the game's formatting codes."""
    plain = re.sub("§.", "", text)
    return "".join(c for c in " ".join(plain.split()) if c.isprintable())[:200]


def _overlays(root: dict[str, Any], name: str) -> tuple[Overlay, ...]:
    entries = _list(root, "overlays", "entries", name)
    if len(entries) > _MAX_OVERLAYS:
        raise PackError(f"{name} has {len(entries)} overlays; up to {_MAX_OVERLAYS} are read")
    return tuple(_overlay(entry, f"{name}: overlay {n}") for n, entry in enumerate(entries))


def _overlay(entry: Any, name: str) -> Overlay:
    if not isinstance(entry, dict):
        raise PackError(f"{name} must be an object with directory and formats")
    directory = entry.get("directory")
    if not isinstance(directory, str) or not re.fullmatch(r"[\w-][\w.-]{0,127}", directory, re.A):
        raise PackError(f"{name}: directory {shown(directory)} must be a name of a-z, 0-9, _ and -")
    formats = _formats(entry, "formats", name)
    if formats is None:
        raise PackError(f"{name} must have formats: give min_format and max_format")
    return Overlay(directory, formats)


def _filters(root: dict[str, Any], name: str) -> tuple[IdFilter, ...]:
    entries = _list(root, "filter", "block", name)
    if len(entries) > _MAX_OVERLAYS:
        raise PackError(f"{name} has {len(entries)} filters; up to {_MAX_OVERLAYS} are read")
    return tuple(parse_filter(entry, name) for entry in entries)


def _formats(entry: dict[str, Any], old_key: str, name: str) -> FormatRange | None:
    """The range by min_format and max_format (since 1.21.9), else by the older key."""
    if "min_format" in entry or "max_format" in entry:
        lowest = _edge(entry.get("min_format", 0), 0, f"{name} min_format")
        highest = _edge(entry.get("max_format", lowest[0]), _ANY_MINOR, f"{name} max_format")
        return FormatRange(lowest, highest)
    value = entry.get(old_key)
    if value is None:
        return None
    if isinstance(value, dict):
        value = [value.get("min_inclusive"), value.get("max_inclusive")]
    ends = value if isinstance(value, list) else [value, value]
    if len(ends) != 2 or not all(_is_count(end) for end in ends):
        raise PackError(f"{name} {old_key}: {shown(value)} must be a number or [lowest, highest]")
    return FormatRange((ends[0], 0), (ends[1], _ANY_MINOR))


def _edge(value: Any, minor: float, name: str) -> Format:
    """A format as `75`, `[75]` or `[75, 1]`."""
    parts = value if isinstance(value, list) else [int(value) if _is_number(value) else value]
    if not 1 <= len(parts) <= 2 or not all(_is_count(part) for part in parts):
        raise PackError(f"{name}: {shown(value)} must be a number or [major, minor]")
    return parts[0], parts[1] if len(parts) == 2 else minor


def _is_number(value: Any) -> bool:
    return isinstance(value, float) and 0 <= value < 1 << 31


def _is_count(value: Any) -> bool:
    return isinstance(value, int) and not isinstance(value, bool) and 0 <= value < 1 << 31


def _object(root: Any, key: str, name: str) -> dict[str, Any]:
    entry = root.get(key, {}) if isinstance(root, dict) else None
    if not isinstance(entry, dict):
        raise PackError(f"{name}: {key!r} must be an object in braces")
    return entry


def _list(root: dict[str, Any], key: str, inner: str, name: str) -> list[Any]:
    entries = _object(root, key, name).get(inner, [])
    if not isinstance(entries, list):
        raise PackError(f"{name}: {key}.{inner} must be a list")
    return entries
