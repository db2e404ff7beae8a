"""The texts of the page in the user's language.

`translations/` holds a catalogue for each language, in the form of GNU gettext; the English text is
the key. The names of dyes and patterns are those of the game in that language. The browser says
which languages its user reads; a text that a catalogue lacks stays English.
"""

from collections.abc import Mapping
from functools import cache, lru_cache
from importlib.resources import files

from babel import negotiate_locale
from babel.messages.pofile import read_po
from nicegui import context

from drapery.banner import PATTERNS, game_titles

GAME_LANGUAGES = {
    "de": "de_de",
    "es": "es_es",
    "fr": "fr_fr",
    "ja": "ja_jp",
    "pl": "pl_pl",
    "pt": "pt_br",
    "ru": "ru_ru",
    "uk": "uk_ua",
    "zh": "zh_cn",
}
"""The languages of the page, and what the game calls them."""


def translated(text: str) -> str:
    """A text of the page in the language of the user whose page is being built or changed."""
    return catalogue(language()).get(text, text)


def language() -> str:
    """The language of the current page, such as `de`; English outside any page."""
    try:
        request = context.client.request
    except RuntimeError:  # no page is being built or changed
        return "en"
    return chosen("" if request is None else request.headers.get("accept-language", ""))


@lru_cache(maxsize=256)
def chosen(accepted: str) -> str:
    """The language for a header `Accept-Language` (RFC 9110, section 12.5.4)."""
    weighed: list[tuple[float, int, str]] = []
    for part in accepted.lower().replace(" ", "").split(",")[:32]:
        name, _, weight = part.partition(";q=")
        try:
            weighed.append((-float(weight or 1), len(weighed), name.strip()))
        except ValueError:
            continue
    names = [name for weight, _, name in sorted(weighed) if weight < 0]
    return negotiate_locale(names, ["en", *GAME_LANGUAGES], sep="-") or "en"


@cache
def catalogue(language: str) -> Mapping[str, str]:
    """The texts of a language by their English text; empty for English."""
    if language not in GAME_LANGUAGES:
        return {}
    with files(__package__).joinpath("translations", f"{language}.po").open("rb") as file:
        texts = {
            str(each.id): str(each.string) for each in read_po(file) if each.id and each.string
        }
    dyes, patterns = game_titles(GAME_LANGUAGES[language])
    names = {name.replace("_", " ").capitalize(): title for name, title in dyes.items()}
    names |= {PATTERNS[name].title: title for name, title in patterns.items()}
    return names | texts
