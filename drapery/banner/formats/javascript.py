"""Objects in JavaScript: `const banner = { base: 'red', layers: [{ pattern: 'creeper', … }] }`.

Keys may lack quotes, quotes may be single, a comma may follow the last entry, and values may be
expressions. An expression is no value here: where a design needs it, its reader refuses it. The
parser takes JSON with comments too.
"""

import re
from dataclasses import replace

from drapery.banner.design import Banner
from drapery.banner.formats.found import FoundBanner
from drapery.banner.formats.item import item_object
from drapery.banner.formats.javascript_values import ValueParser, warn_of, without_comments
from drapery.banner.formats.leftovers import looks_like_design
from drapery.banner.formats.scripts import places
from drapery.banner.formats.tree import DataTree
from drapery.banner.formats.trees import banners_in
from drapery.errors import DesignError

NAME = "javascript"
TITLE = "objects in a program in JavaScript"
EXAMPLE = """const banner = {
  id: 'minecraft:white_banner',
  components: {
    'minecraft:banner_patterns': [{ pattern: 'creeper', color: 'lime' }],
  },
};"""
SOURCE = "https://tc39.es/ecma262/#prod-ObjectLiteral"

_START = re.compile(r"(?:(?<![=!<>])=|[(,]|\breturn|\bdefault)\s*(?=[{\[])")
"""What stands before a value, as far as it may be an object or a list."""
_BEGINNING = re.compile(
    r"(?:\s|//[^\n]*|/\*.*?\*/|['\"]use strict['\"];)*+"
    r"(?:(?:const|let|var|import|export|module\.exports)\b"
    r"|[\w$.]{1,80}\(\s*[{\[])",
    re.DOTALL,
)


def recognises(text: str) -> bool:
    """Whether the text begins as a program with an object that may be a design."""
    if "banner" not in text and "shield" not in text and "layers" not in text:
        return False
    return _BEGINNING.match(text) is not None and _START.search(text) is not None


def read(text: str) -> list[FoundBanner]:
    """All banners of the objects. Raises DesignError with the place, and if there is none."""
    text = without_comments(text)
    place_of = places(text)
    found: list[FoundBanner] = []
    skipped: list[str] = []
    errors: list[DesignError] = []
    end = 0
    for match in _START.finditer(text):
        if match.start() < end:
            continue
        at = place_of(match.end())
        parser = ValueParser(text, match.end(), place_of)
        try:
            read = _banners(parser)
        except DesignError as error:
            message = str(error)
            error = DesignError(message if message.startswith("line ") else f"{at}: {message}")
            if _may_be_design(text[match.end() : parser.at]):
                raise error from None
            errors.append(error)
        else:
            found += [replace(one, where=f"{at} {one.where}".rstrip()) for one in read]
        end = parser.at
        skipped += parser.skipped
    warn_of(skipped)
    if not found:
        sample = " ".join(EXAMPLE.split())
        raise (
            errors[0] if errors else DesignError(f"no banner in the objects: write one as {sample}")
        )
    return found


def _banners(parser: ValueParser) -> list[FoundBanner]:
    """The banners of the value that begins here, which may be none if it has to do with none."""
    start = parser.at
    found = banners_in(parser.value(0))
    if not found and looks_like_design(parser.text[start : parser.at]):
        raise DesignError("these layers belong to no banner; write them into the banner's object")
    return found


def _may_be_design(text: str) -> bool:
    """Whether the source of a value has to do with banners."""
    return any(word in text for word in ("banner", "shield", "layers")) or looks_like_design(text)


def write(banner: Banner) -> str:
    """An item (1.20.5+) as the value of a constant."""
    return f"const banner = {_written(item_object(banner))};"


def _written(tree: DataTree) -> str:
    if isinstance(tree, dict):
        return "{ " + ", ".join(f"{_key(key)}: {_written(tree[key])}" for key in tree) + " }"
    if isinstance(tree, list):
        return "[" + ", ".join(map(_written, tree)) + "]"
    return f"'{tree}'" if isinstance(tree, str) else str(tree)


def _key(key: str) -> str:
    return key if key.isidentifier() else f"'{key}'"
