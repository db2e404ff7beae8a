"""Styles by name: presets, and those of installed packages.

Another package adds a style by an entry point in the group `drapery.styles`. The name of the entry
point is the name of the style, its value is a `Style`. In the package's pyproject.toml:

    [project.entry-points."drapery.styles"]
    sparkle = "my_package.styles:sparkle"
"""

from collections.abc import Iterable
from functools import cache, reduce
from importlib.resources import as_file, files
from operator import or_
from typing import TYPE_CHECKING

from drapery.errors import OptionError, shown
from drapery.settings import StyleLike
from drapery.styles.style import Style

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

GROUP = "drapery.styles"
ENDING = ".toml"

PRESETS = (
    *("game", "few-bends", "boards", "voxel", "low-poly", "tattered"),
    *("woven", "felt", "embroidered", "hatched", "stained-glass"),
    *("pixel-art", "cel", "ink", "blueprint"),
)
"""Names of the presets, in the order of lists."""

PLAIN = Style("plain")
"""No step: what is drawn without a style."""


def style_names() -> list[str]:
    """All names that `find_style` takes: presets, then those of installed packages."""
    return [*PRESETS, *(name for name in _added() if name not in PRESETS)]


def find_style(name: StyleLike) -> Style:
    """The style of this name, or of a file whose path ends with `.toml`.

    Raises OptionError for another name and for a style that cannot be loaded.
    """
    if isinstance(name, Style):
        return name
    if str(name).endswith(ENDING):
        return Style.load(str(name))
    if str(name) in PRESETS:
        return _preset(str(name))
    added = _added()
    if str(name) not in added:
        known = ", ".join([*PRESETS, *(each for each in added if each not in PRESETS)])
        raise OptionError(
            f"style {shown(str(name))} is not known; use a file that ends with {ENDING},"
            f" or one of: {known}"
        )
    return _loaded(str(name), added[str(name)])


def combined_style(styles: StyleLike | Iterable[StyleLike]) -> Style:
    """All styles as one, in their order; `PLAIN` if there are none.

    Raises OptionError.
    """
    if isinstance(styles, str) or not isinstance(styles, Iterable):
        return find_style(styles)
    found = [find_style(style) for style in styles]
    return reduce(or_, found) if found else PLAIN


@cache
def _preset(name: str) -> Style:
    with as_file(files("drapery.styles") / "presets" / f"{name}{ENDING}") as path:
        return Style.load(path)


def _loaded(name: str, point: "EntryPoint") -> Style:
    try:
        style = point.load()
    except Exception as fault:  # a package may raise anything while it is imported
        raise OptionError(
            f"style {name!r} of {point.value} cannot be loaded ({type(fault).__name__});"
            " repair or remove the package that adds it"
        ) from fault
    if not isinstance(style, Style):
        raise OptionError(f"style {name!r} of {point.value} is not a Style; make it one")
    return style


def _added() -> "dict[str, EntryPoint]":
    from importlib.metadata import entry_points

    points = sorted(entry_points(group=GROUP), key=lambda point: point.name)
    return {point.name: point for point in points}
