"""Records of a library: the limits of a design, the text that is searched, the export file."""

import json
from base64 import b64decode, b64encode
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Any

from drapery import Banner, DesignError, DraperyError, FoundBanner, Settings
from drapery.banner import PATTERNS
from drapery.packs import Packs, png_size, read_png
from drapery.studio.art import THUMBNAIL_SCALE, face_png
from drapery.studio.share import as_tree, checked_title, of_tree
from drapery.studio.sketch import Sketch, sketch_of

VERSION = 1
"""The version of the export file's form."""
MAX_DESIGNS = 20_000
MAX_TAGS = 12
MAX_TAG = 32
MAX_THUMBNAIL = 64 << 10
"""The largest PNG file of a thumbnail [bytes]."""
MAX_THUMBNAIL_SIDE = 256

_MARK = "drapery_library"


@dataclass(frozen=True)
class Design:
    """A design in a library.

    number: identifies it in its library; 0 before it is saved. thumbnail: a PNG file, or b"".
    changed: a counter of the library's changes; it orders designs by their last change.
    """

    sketch: Sketch
    settings: Settings
    tags: tuple[str, ...] = ()
    thumbnail: bytes = b""
    number: int = 0
    changed: int = 0

    @property
    def title(self) -> str:
        """The sketch's title."""
        return self.sketch.title


def tagged_designs(
    found: Iterable[FoundBanner], name: str, settings: Settings, packs: Packs
) -> Iterator[Design]:
    """Each of the banners once, with its first place as title and the name of its file as tag.

    Raises PackError.
    """
    tag = "".join(each for each in name if each != "," and each.isprintable())[:MAX_TAG]
    places: dict[Banner, str] = {}
    for each in found:
        places.setdefault(each.banner, each.where)
    for banner, place in places.items():
        title = "".join(filter(str.isprintable, place))
        picture = face_png(banner, packs, THUMBNAIL_SCALE)
        yield checked(Design(sketch_of(banner, title), settings, (tag,), picture))


def tree_of(design: Design) -> str:
    """Sketch and options as JSON text; equal designs have equal texts."""
    return json.dumps(as_tree(design.sketch, design.settings), ensure_ascii=False, sort_keys=True)


def identity(design: Design) -> tuple[str, tuple[str, ...]]:
    """A key; two designs with equal keys count as the same design."""
    return tree_of(design), design.tags


def words_of(design: Design) -> str:
    """The text in which `search` looks, in lower case."""
    sketch = design.sketch
    shown = [PATTERNS[s.pattern].title for s in sketch.strokes if s.pattern in PATTERNS]
    named = [f"{stroke.pattern} {stroke.dye}" for stroke in sketch.strokes]
    whole = [sketch.title, *design.tags, sketch.base, sketch.kind, *named, *shown]
    return " ".join(" ".join(whole).lower().replace("_", " ").split())


def checked(design: Design) -> Design:
    """The design as it may be saved. Raises DesignError, or PackError for its thumbnail."""
    title = checked_title(design.title)
    # Convert there and back: a design must be the same after it is saved and read.
    sketch, _ = of_tree(as_tree(replace(design.sketch, title=title), design.settings))
    return replace(
        design, sketch=sketch, tags=checked_tags(design.tags), thumbnail=_picture(design.thumbnail)
    )


def checked_tags(tags: Iterable[object]) -> tuple[str, ...]:
    """The tags in lower case, each once. Raises DesignError."""
    names = []
    for tag in tags:
        if not isinstance(tag, str) or len(tag) > MAX_TAG or not tag.isprintable() or "," in tag:
            raise DesignError(f"a tag is a word or two of at most {MAX_TAG} characters, no comma")
        names.append(" ".join(tag.lower().split()))
    unique = tuple(dict.fromkeys(name for name in names if name))
    if len(unique) > MAX_TAGS:
        raise DesignError(f"a design has at most {MAX_TAGS} tags; leave some out")
    return unique


def _picture(data: bytes) -> bytes:
    """The thumbnail written again from its pixels, so that nothing else in the file is saved."""
    from drapery.render import png_bytes

    if not data:
        return b""
    if len(data) > MAX_THUMBNAIL or max(png_size(data, "the thumbnail")) > MAX_THUMBNAIL_SIDE:
        raise DesignError(
            f"the thumbnail is over {MAX_THUMBNAIL_SIDE} pixels a side or {MAX_THUMBNAIL} bytes"
        )
    return png_bytes(read_png(data, "the thumbnail"))


def write_designs(designs: Iterable[Design]) -> bytes:
    """Designs as one JSON file, which `read_designs` reads."""
    whole = {_MARK: VERSION, "designs": [_exported(design) for design in designs]}
    return json.dumps(whole, ensure_ascii=False, indent=1).encode()


def _exported(design: Design) -> dict[str, Any]:
    """A design in the export file."""
    return as_tree(design.sketch, design.settings) | {
        "tags": list(design.tags),
        "thumbnail": b64encode(design.thumbnail).decode(),
    }


def read_designs(data: bytes) -> list[Design]:
    """All designs of such a file. Raises DesignError, naming the design that is broken."""
    try:
        whole = json.loads(data)
    except (ValueError, RecursionError):
        raise DesignError("the file is not a library; choose one that was exported here") from None
    if not isinstance(whole, dict) or not isinstance(whole.get("designs"), list):
        raise DesignError("the file is not a library; choose one that was exported here")
    if whole.get(_MARK) != VERSION:
        raise DesignError(
            f"the file's {_MARK} must be {VERSION}; update Drapery, or export the library again"
        )
    if len(whole["designs"]) > MAX_DESIGNS:
        raise DesignError(f"the file has over {MAX_DESIGNS} designs; split it")
    return [_imported(tree, f"design {n}") for n, tree in enumerate(whole["designs"], 1)]


def _imported(tree: object, at: str) -> Design:
    try:
        sketch, settings = of_tree(tree)
        assert isinstance(tree, dict)  # otherwise of_tree has raised
        tags, picture = tree.get("tags", []), tree.get("thumbnail", "")
        if not isinstance(tags, list) or not isinstance(picture, str):
            raise DesignError("tags must be a list, thumbnail a text; export the library again")
        return checked(Design(sketch, settings, tuple(tags), b64decode(picture, validate=True)))
    except DraperyError as error:
        raise DesignError(f"{at}: {error}") from None
    except ValueError:
        raise DesignError(f"{at}: its thumbnail is not base64; export the library again") from None
