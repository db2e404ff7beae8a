"""From a picture to the banner that looks most like it.

    from drapery.match import match

    best, *others = match(face)  # uint8 [40, 20, 3]
    print(best.banner, best.error)

`Matcher` prepares a stack of packs once for many faces. Names are loaded when they are first used.
"""

from typing import TYPE_CHECKING

from drapery.lazy import lazy_names

if TYPE_CHECKING:
    from drapery.match.search import Match, Matcher, MatchProgress, match

__all__ = ["Match", "MatchProgress", "Matcher", "match"]

__getattr__, __dir__ = lazy_names(
    __name__, {"match.search": ("Match", "MatchProgress", "Matcher", "match")}
)
