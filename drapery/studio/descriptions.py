"""Designs, dyes and patterns for labels, tooltips and screen readers."""

from drapery.banner.dyes import Dye
from drapery.banner.patterns import PATTERNS
from drapery.studio.sketch import Sketch


def dye_title(dye: str) -> str:
    """`light_blue` is "Light blue"."""
    return dye.replace("_", " ").capitalize()


def dye_colour(dye: Dye) -> str:
    """The dye as a colour of CSS."""
    return "#{:02x}{:02x}{:02x}".format(*dye.rgb)


def pattern_title(pattern: str) -> str:
    """The pattern's name in the game; for a pattern of a data pack, the end of its path."""
    known = PATTERNS.get(pattern)
    if known is not None:
        return known.title
    return pattern.partition(":")[2].rpartition("/")[2].replace("_", " ").capitalize() or pattern


def described(sketch: Sketch) -> str:
    """The design in one sentence, lowest layer first."""
    layers = [
        f"{dye_title(stroke.dye).lower()} {pattern_title(stroke.pattern)}"
        for stroke in sketch.strokes
        if not stroke.hidden
    ]
    field = f"{dye_title(sketch.base)} {sketch.kind}"
    return f"{field} with {', '.join(layers)}" if layers else field
