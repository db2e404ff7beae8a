"""Names of patterns and dyes in every version and edition of the game, and their ids."""

from collections.abc import Iterable
from functools import cache, lru_cache

from drapery.banner.dyes import DYE_NAMES, DYES
from drapery.banner.patterns import BY_CODE, PATTERNS
from drapery.errors import DesignError

_BUKKIT = {
    "stripe_small": "small_stripes",
    "diagonal_right": "diagonal_up_right",
    "diagonal_left_mirror": "diagonal_up_left",
    "diagonal_right_mirror": "diagonal_right",
    "circle_middle": "circle",
    "rhombus_middle": "rhombus",
    "half_vertical_mirror": "half_vertical_right",
    "half_horizontal_mirror": "half_horizontal_bottom",
}
"""The server API's names that are not the ids. DIAGONAL_RIGHT is also an id, but means `rd`."""

BEDROCK_CODES = {"flow": "flw", "guster": "gus"}
"""The codes of the two patterns that have none in Java."""

_ALSO = {
    "fully": "base",
    "fully_field": "base",
    "masoned": "bricks",
    "brick": "bricks",
    "saltire": "cross",
    "chevron_inverted": "triangle_top",
    "lozenge": "rhombus",
    "creeper_face": "creeper",
    "skull_and_crossbones": "skull",
    "thing": "mojang",
}

_DYE_ALSO = {
    "silver": "light_gray",
    "grey": "gray",
    "light_grey": "light_gray",
    "dark_gray": "gray",
    "dark_grey": "gray",
    "dark_green": "green",
    "light_green": "lime",
}

_CLOSE = 0.6
"""The least likeness of a name that an error suggests."""

_PATH_LETTERS = frozenset("abcdefghijklmnopqrstuvwxyz0123456789_-./")
_LONGEST = 256


def shown(value: object, longest: int = 40) -> str:
    """The value as an error quotes it, on one short line, whatever it is."""
    if isinstance(value, dict):
        return f"a compound of {len(value)}"
    if isinstance(value, (list, tuple)):
        return f"a list of {len(value)}"
    if isinstance(value, int) and value.bit_length() > 256:
        return f"a number of {value.bit_length()} bits"
    text = str(value) if isinstance(value, str) else " ".join(str(value).split())
    if len(text) > longest:
        text = text[: longest - 1] + "…"
    return repr(text) if isinstance(value, str) else text


def plain(name: str) -> str:
    """The name as ids are spelt: `Per Bend-Sinister` gives `per_bend_sinister`."""
    words = name.lower().removeprefix("minecraft:").replace("-", " ").replace("_", " ").split()
    return "_".join(words)


@cache
def _pattern_table() -> dict[str, str]:
    titles = {plain(p.title): p.name for p in PATTERNS.values()}
    codes = {code: p.name for code, p in BY_CODE.items()}
    bedrock = {code: name for name, code in BEDROCK_CODES.items()}
    ids = {name: name for name in PATTERNS}
    # Later ones win: `base` and `cross` are ids, not the heraldic titles Base and Cross.
    return titles | _ALSO | _BUKKIT | bedrock | codes | ids


def pattern_aliases() -> dict[str, str]:
    """The id of a pattern for each of its names, as `plain` spells them."""
    return dict(_pattern_table())


def dye_aliases() -> dict[str, str]:
    """The name of a dye for each of its names, as `plain` spells them."""
    return {name: name for name in DYES} | _DYE_ALSO


def is_custom(name: str) -> bool:
    """Whether the name is `namespace:path` of a data pack: not the game's own, and a safe path."""
    namespace, colon, path = name.partition(":")
    return (
        bool(colon and namespace and namespace != "minecraft" and len(name) <= _LONGEST)
        and "/" not in namespace
        and _PATH_LETTERS.issuperset(namespace)
        and _PATH_LETTERS.issuperset(path)
        and not {"", ".", ".."}.intersection([namespace, *path.split("/")])
    )


def pattern_id(name: object, at: str = "", *, bukkit: bool = False) -> str:
    """The id of a pattern by any of its names: `creeper`, or `namespace:path` of a data pack.

    Takes ids with and without `minecraft:`, codes of versions before 1.20.5, Bedrock's codes,
    Bukkit's names and English titles in any case.

    name: any of these names.
    at: the place of the name, with which an error begins.
    bukkit: whether the name is known to be Bukkit's.

    Raises DesignError for another name.
    """
    if not isinstance(name, str):
        raise DesignError(
            f"{_place(at)}{shown(name)} is not a pattern: give its id, such as 'creeper'"
        )
    if is_custom(name):
        return name
    key = plain(name)
    if key == "diagonal_right" and (bukkit or name.strip() == "DIAGONAL_RIGHT"):
        return _BUKKIT[key]
    found = _pattern_table().get(key)
    if found is None:
        raise DesignError(f"{_place(at)}unknown pattern {shown(name)}{_pattern_hint(name, key)}")
    return found


def dye_name(value: object, at: str = "", *, inverted: bool = False) -> str:
    """The dye of a name or of a number from 0 to 15.

    value: a name in any case, or a number.
    at: the place of the value, with which an error begins.
    inverted: white is number 15, not 0, as in Java up to 1.12, and Bedrock.

    Raises DesignError for another value.
    """
    if isinstance(value, int) and not isinstance(value, bool):
        if not 0 <= value < len(DYE_NAMES):
            raise DesignError(f"{_place(at)}{shown(value)} is not a dye: the numbers are 0 to 15")
        return DYE_NAMES[15 - value if inverted else value]
    if not isinstance(value, str):
        raise DesignError(f"{_place(at)}{shown(value)} is not a dye: give its name, such as 'lime'")
    key = plain(value)
    name = _DYE_ALSO.get(key, key)
    if name not in DYES:
        hint = _did_you_mean(key, [*DYES, *_DYE_ALSO])
        raise DesignError(
            f"{_place(at)}unknown dye {shown(value)}{hint or '; the sixteen are '}"
            + ("" if hint else ", ".join(DYES))
        )
    return name


def bukkit_pattern(name: str, at: str = "") -> str:
    """The pattern's name in Bukkit up to 1.20: `diagonal_up_right` gives DIAGONAL_RIGHT.

    Raises DesignError that begins with the place `at` for patterns of data packs.
    """
    if is_custom(name):
        raise DesignError(
            f"{_place(at)}Bukkit has no name for {shown(name)}, a data pack's pattern"
        )
    names = {name: bukkit for bukkit, name in _BUKKIT.items()}
    return names.get(name, name).upper()


def is_dye(value: str) -> bool:
    """Whether the text names a dye."""
    key = plain(value)
    return key in DYES or key in _DYE_ALSO


def is_pattern(value: str) -> bool:
    """Whether the text is a name of one of the game's patterns."""
    return plain(value) in _pattern_table()


def _place(at: str) -> str:
    return f"{at}: " if at else ""


def _pattern_hint(name: str, key: str) -> str:
    if ":" in name and not name.startswith("minecraft:"):
        return ": write a data pack's pattern as 'namespace:path' in lower case"
    return _did_you_mean(key, _pattern_table()) or ": give an id, such as 'creeper' or 'stripe_top'"


def _did_you_mean(key: str, names: Iterable[str]) -> str:
    # Matching takes time with the square of the length.
    return _suggestion(key[:40], tuple(names))


@lru_cache(maxsize=1000)
def _suggestion(key: str, names: tuple[str, ...]) -> str:
    import difflib

    candidates = [name for name in names if len(name) > 1 and _shares_letters(key, name)]
    close = difflib.get_close_matches(key, candidates, 1, _CLOSE)
    return f"; did you mean '{close[0]}'?" if close else ""


def _shares_letters(key: str, name: str) -> bool:
    """Whether two words have enough letters in common that difflib may call them close.

    The ratio of difflib is twice the letters that match, divided by the letters of both.
    """
    least = _CLOSE * (len(key) + len(name)) / 2
    if min(len(key), len(name)) < least:
        return False
    return len(key) - len(key.translate(_without(name))) >= least


@cache
def _without(name: str) -> dict[int, None]:
    """The table of `str.translate` that deletes the letters of a name."""
    return dict.fromkeys(map(ord, name))
