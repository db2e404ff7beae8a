"""A design and its parts in plain words, for labels, tooltips and screen readers."""

from drapery.banner.patterns import PATTERNS
from drapery.studio.sketch import Sketch


def dye_words(dye: str) -> str:
    """`light_blue` is "Light blue"."""
    return dye.replace("_", " ").capitalize()


def pattern_words(pattern: str) -> str:
    """The pattern's name in the game; of a data pack's pattern the end of its path."""
    known = PATTERNS.get(pattern)
    if known is not None:
        return known.title
    return pattern.partition(":")[2].rpartition("/")[2].replace("_", " ").capitalize() or pattern


def in_words(sketch: Sketch) -> str:
    """The design in one sentence, lowest layer first."""
    layers = [
        f"{dye_words(stroke.dye).lower()} {pattern_words(stroke.pattern)}"
        for stroke in sketch.strokes
        if not stroke.hidden
    ]
    field = f"{dye_words(sketch.base)} {sketch.kind}"
    return f"{field} with {', '.join(layers)}" if layers else field
