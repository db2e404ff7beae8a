"""A sketch and the options of its picture as one word, which an address can carry.

The word is a letter for the version, then zlib's stream of the JSON that `as_tree` makes, in
base64 for addresses (RFC 4648, section 5) without its padding. Nothing in it names a file: packs
and textures stay behind.
"""

import json
import zlib
from base64 import urlsafe_b64decode, urlsafe_b64encode
from dataclasses import replace
from pathlib import Path
from typing import Any

from drapery.banner.formats import own_json
from drapery.errors import DesignError
from drapery.settings import NAMED_OPTIONS, Settings
from drapery.studio.sketch import MAX_TITLE, Sketch, banner_of, sketch_of

VERSION = "a"
MAX_LINK = 4096
"""Letters of a link; a sketch of sixteen layers takes about 400."""
MAX_JSON = 16 << 10
"""What a link may unpack to [bytes]."""

OWN = frozenset({"packs", "texture", "kind", "backend"})
"""Options that name files, want one, or name what is installed: they stay on their machine."""
SHARED = tuple(name for name in NAMED_OPTIONS if name not in OWN)

_LETTERS = frozenset("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_")
_REMEDY = "copy the whole link again"


def write_link(sketch: Sketch, look: Settings) -> str:
    """The sketch and the options that are off their default, as letters that an address may hold.

    look: its packs, texture and backend are left out.
    """
    text = json.dumps(as_tree(sketch, look), separators=(",", ":"), ensure_ascii=False)
    squeezed = zlib.compress(text.encode(), 9)
    return VERSION + urlsafe_b64encode(squeezed).decode().rstrip("=")


def read_link(text: str) -> tuple[Sketch, Settings]:
    """What `write_link` wrote. Raises DesignError for anything else, however it was made."""
    word = text.strip()
    if len(word) > MAX_LINK:
        raise DesignError(f"the link has {len(word)} letters, over {MAX_LINK}; {_REMEDY}")
    if not word or not _LETTERS.issuperset(word):
        raise DesignError(f"the link is empty or holds letters that no link has; {_REMEDY}")
    if word[0] != VERSION:
        raise DesignError(
            f"the link is of version {word[0]!r}, and {VERSION!r} is read; bring Drapery up to date"
        )
    return of_tree(_parsed(_inflated(word[1:])))


def begun(own: Settings, word: str) -> tuple[Settings, Sketch]:
    """What a page begins with whose address has this link: the studio's own settings and these.

    Raises DesignError.
    """
    sketch, look = read_link(word)
    return over(own, look), sketch


def over(own: Settings, look: Settings) -> Settings:
    """The shared options of `look`; all others, and a format that it leaves open, are our own."""
    chosen = {name: getattr(look, name) for name in SHARED}
    if look.format is None:
        chosen["format"] = own.format
    return replace(own, **chosen)


def as_tree(sketch: Sketch, look: Settings) -> dict[str, Any]:
    """The sketch and its options as JSON holds them: our own form of a design, and what is beside.

    `hidden` lists the places of hidden layers, from 0; `options` are those off their default.
    """
    whole = replace(sketch, strokes=tuple(replace(s, hidden=False) for s in sketch.strokes))
    tree: dict[str, Any] = json.loads(own_json.write(banner_of(whole)))
    hidden = [place for place, stroke in enumerate(sketch.strokes) if stroke.hidden]
    beside = {"title": sketch.title, "hidden": hidden, "options": options_of(look)}
    return tree | {name: value for name, value in beside.items() if value}


def options_of(look: Settings) -> dict[str, Any]:
    """The shared options that are off their default, by name, as JSON holds them."""
    plain = Settings()
    chosen = {name: getattr(look, name) for name in SHARED}
    return {
        name: list(value) if isinstance(value, tuple) else value
        for name, value in chosen.items()
        if value != getattr(plain, name)
    }


def of_tree(tree: object) -> tuple[Sketch, Settings]:
    """What `as_tree` made. Raises DesignError naming what is wrong in it."""
    if not isinstance(tree, dict):
        raise DesignError(f"the design is no JSON object; {_REMEDY}")
    sketch = sketch_of(own_json.from_tree(tree))
    hidden = _places(tree.get("hidden", []), len(sketch.strokes))
    strokes = tuple(replace(s, hidden=n in hidden) for n, s in enumerate(sketch.strokes))
    title = checked_title(tree.get("title", ""))
    return replace(sketch, strokes=strokes, title=title), look_of(tree.get("options", {}))


def look_of(words: object) -> Settings:
    """Checked options from what JSON held. Raises DesignError, also for options never shared."""
    from drapery.options import check_options

    if not isinstance(words, dict):
        raise DesignError(f"options: no JSON object; {_REMEDY}")
    for name in words:
        if name not in SHARED:
            raise DesignError(f"options: {str(name)[:40]!r} is no option of a link; {_REMEDY}")
    checked = check_options(words, Path())
    if isinstance(checked, list):
        raise DesignError(f"options: {checked[0]}")
    return checked


def checked_title(title: object) -> str:
    """A title: one line that can be printed. Raises DesignError."""
    if not isinstance(title, str) or len(title) > MAX_TITLE or not title.isprintable():
        raise DesignError(f"the title must be a line of at most {MAX_TITLE} letters; shorten it")
    return title.strip()


def _places(hidden: object, count: int) -> frozenset[int]:
    if not isinstance(hidden, list) or not all(
        type(place) is int and 0 <= place < count for place in hidden
    ):
        raise DesignError(f"hidden: not a list of places of the {count} layers; {_REMEDY}")
    return frozenset(hidden)


def _inflated(letters: str) -> bytes:
    try:
        squeezed = urlsafe_b64decode(letters + "=" * (-len(letters) % 4))
        stream = zlib.decompressobj()
        data = stream.decompress(squeezed, MAX_JSON + 1)
    except (ValueError, zlib.error):
        raise DesignError(f"the link is damaged; {_REMEDY}") from None
    if len(data) > MAX_JSON:
        raise DesignError(f"the link unpacks to over {MAX_JSON} bytes: no design is that long")
    if not stream.eof or stream.unused_data:
        raise DesignError(f"the link is cut short or has letters behind its end; {_REMEDY}")
    return data


def _parsed(data: bytes) -> object:
    try:
        return json.loads(data)
    except (ValueError, RecursionError):
        raise DesignError(f"the link holds no design; {_REMEDY}") from None
