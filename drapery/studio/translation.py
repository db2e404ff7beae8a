"""The texts of the page in the user's language.

`translations/` holds a catalogue for each language, in the form of GNU gettext; the English text is
the key. The names of dyes and patterns are those of the game in that language. The browser says
which languages its user reads; a text that a catalogue lacks stays English.
"""

import re
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


_FIXED = 8
"""The fewest letters beside its places of a text that is found filled in; fewer fit too much."""


def translated(text: str, to: str = "") -> str:
    """A text in a language, by default the user's whose page is being built or changed.

    Places may be filled in: "a.zip is empty; send it again" is translated like the catalogue's
    "{name} is empty; send it again".
    """
    return _translated(text, to or language())


@lru_cache(maxsize=4096)
def _translated(text: str, language: str) -> str:
    texts = catalogue(language)
    if text in texts:
        return texts[text]
    for form, wanted in _forms(language):
        if found := form.fullmatch(text):
            words = found.groupdict().items()
            return wanted.format(**{name: _translated(each, language) for name, each in words})
    return text


@cache
def _forms(language: str) -> list[tuple[re.Pattern[str], str]]:
    """The texts with places to fill in, as patterns; those with the most other letters first."""
    forms = []
    for english, text in catalogue(language).items():
        fixed, names = re.split(r"{\w+}", english), re.findall(r"{(\w+)}", english)
        if names and len("".join(fixed)) >= _FIXED:
            places = [*(f"(?P<{name}>.+)" for name in names), ""]
            parts = zip(map(re.escape, fixed), places, strict=True)
            forms.append((len("".join(fixed)), "".join(a + b for a, b in parts), text))
    return [(re.compile(form), text) for _, form, text in sorted(forms, reverse=True)]


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
