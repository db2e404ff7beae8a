"""A sketch and the options of its picture as characters that an address can hold.

The characters hold the JSON of `as_tree`; `drapery.banner.formats.studio_link` says how. A link
never names a file: it leaves out packs, textures, and styles that are not names.
"""

import json
import warnings
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from drapery import Banner, DesignError, Settings
from drapery.banner import (
    hidden_layers,
    pack_link,
    parse_banner,
    unpack_link,
    write_banner,
)
from drapery.errors import OptionError, shown
from drapery.option_checks import parse_options
from drapery.settings import NAMED_OPTIONS, applicable
from drapery.studio.sketch import MAX_TITLE, Sketch, banner_of, sketch_of
from drapery.styles import style_names

MAX_STYLES = 16
"""The most styles in a link."""
SHARED = applicable(output="link")
"""The options of a link: none names or needs a file, or depends on installed software."""
MOVED = tuple(name for name in SHARED if name not in ("format", "time"))
"""The options of a link that the page's editor can undo."""

_REMEDY = "copy the whole link again"


def write_link(sketch: Sketch, settings: Settings) -> str:
    """The sketch and the options that differ from their default, as part of an address.

    settings: the link leaves out its packs, texture, backend, and styles that are not names.
    """
    return pack_link(as_tree(sketch, settings))


def read_link(text: str) -> tuple[Sketch, Settings]:
    """Read the output of `write_link`. Raises DesignError for any other text."""
    return of_tree(unpack_link(text))


def opened_link(base: Settings, link: str) -> tuple[Settings, Sketch]:
    """The initial state of a page with this link: the studio's settings, changed by the link's.

    Raises DesignError.
    """
    sketch, settings = read_link(link)
    return with_shared(base, settings), sketch


def with_shared(base: Settings, settings: Settings) -> Settings:
    """`base` with the shared options of `settings`.

    A format of None leaves the format of `base`, and no style leaves those of `base` that a link
    cannot name.
    """
    own = {name: value for name, value in base.given_values.items() if name not in SHARED}
    chosen = {name: value for name, value in settings.given_values.items() if name in SHARED}
    if settings.format is None:
        chosen["format"] = base.format
    if not settings.style:
        chosen["style"] = tuple(style for style in _styles(base) if not _is_name(style))
    return Settings(**own | chosen)


def as_tree(sketch: Sketch, settings: Settings) -> dict[str, Any]:
    """The sketch and its options as JSON: Drapery's form of a design with three more members.

    `title`; `hidden`: the places of hidden layers, from 0; `options`: the options that differ from
    their default.
    """
    whole = replace(sketch, strokes=tuple(replace(s, hidden=False) for s in sketch.strokes))
    tree: dict[str, Any] = json.loads(write_banner(banner_of(whole)))
    hidden = [place for place, stroke in enumerate(sketch.strokes) if stroke.hidden]
    more = {"title": sketch.title, "hidden": hidden, "options": options_of(settings)}
    return tree | {name: value for name, value in more.items() if value}


def options_of(settings: Settings) -> dict[str, Any]:
    """The shared options that differ from their default, by name, as JSON."""
    chosen = {name: settings.as_given(name) for name in SHARED}
    chosen["style"] = tuple(filter(_is_name, _styles(settings)))
    own = {name: value for name, value in chosen.items() if value != NAMED_OPTIONS[name].default}
    return as_json(own)


def as_json(options: Mapping[str, Any]) -> dict[str, Any]:
    """The same options as `settings_of` reads them."""
    return {
        name: list(value) if isinstance(value, tuple) else value for name, value in options.items()
    }


def motion_of(settings: Settings) -> dict[str, Any]:
    """What the page's editor keeps beside each design, so that it can be undone: as `options_of`.

    Without what follows from packs, or from a pause.
    """
    return {name: value for name, value in options_of(settings).items() if name in MOVED}


def of_tree(tree: object) -> tuple[Sketch, Settings]:
    """Read the output of `as_tree`. Raises a DesignError that names the error."""
    if not isinstance(tree, dict):
        raise DesignError(f"the design is not a JSON object; {_REMEDY}")
    sketch = sketch_of(_banner_in(tree))
    hidden = hidden_layers(tree, len(sketch.strokes))
    strokes = tuple(replace(s, hidden=n in hidden) for n, s in enumerate(sketch.strokes))
    title = checked_title(tree.get("title", ""))
    return replace(sketch, strokes=strokes, title=title), settings_of(tree.get("options", {}))


def settings_of(words: object) -> Settings:
    """The options of a JSON object. Raises DesignError, also for options that are not shared."""
    if not isinstance(words, dict):
        raise DesignError(f"options: not a JSON object; {_REMEDY}")
    for name in words:
        if name not in SHARED:
            raise DesignError(f"options: {str(name)[:40]!r} is not an option of a link; {_REMEDY}")
    if "style" in words:
        words = words | {"style": _known_styles(words["style"])}
    # A page keeps options that do nothing for what it shows now.
    values = parse_options(words, Path())
    if isinstance(values, list):
        raise DesignError(f"options: {values[0]}")
    try:
        return Settings(**values)
    except OptionError as error:
        raise DesignError(f"options: {error}") from None


def _known_styles(names: object) -> list[str]:
    """The styles of a link that are installed here; a warning names the others.

    Raises DesignError for anything but names.
    """
    if not isinstance(names, list) or not all(map(_is_name, names)) or len(names) > MAX_STYLES:
        raise DesignError(f"options: style is not a list of at most {MAX_STYLES} names; {_REMEDY}")
    known = style_names()
    for name in names:
        if name not in known:
            warnings.warn(
                f"style {shown(name)} of the link is not installed here; it was left out",
                stacklevel=2,
            )
    return [name for name in names if name in known]


def _styles(settings: Settings) -> tuple[Any, ...]:
    style = settings.style
    return style if isinstance(style, tuple) else (style,)


def _is_name(style: object) -> bool:
    """Whether a style is a name, not a file or an object."""
    return isinstance(style, str) and not NAMED_OPTIONS["style"].is_path(style)


def checked_title(title: object) -> str:
    """The title without surrounding blanks. Raises DesignError if it is not one printable line."""
    if not isinstance(title, str) or len(title) > MAX_TITLE or not title.isprintable():
        raise DesignError(f"the title must be a line of at most {MAX_TITLE} characters; shorten it")
    return title.strip()


def _banner_in(tree: dict[str, Any]) -> Banner:
    design = {name: tree[name] for name in ("base", "layers", "kind") if name in tree}
    try:
        return parse_banner(json.dumps(design), form="json")
    except RecursionError:
        raise DesignError(f"the link does not hold a design; {_REMEDY}") from None
