"""The page's catalogues are whole, and the browser's first known language is chosen."""

import re

import pytest

from drapery.banner import DYES, PATTERNS
from drapery.studio.translation import GAME_LANGUAGES, catalogue, chosen, translated


@pytest.mark.parametrize(
    ("accepted", "language"),
    [
        *(("de-AT,de;q=0.9,en;q=0.5", "de"), ("en-US,en", "en"), ("pt-BR", "pt"), ("", "en")),
        *(("nl,fr;q=0.4", "fr"), ("fr;q=0.2,uk;q=0.8", "uk"), ("de;q=0,es", "es")),
        *(("de;q=much", "en"), (",;,", "en"), ("x" * 9000, "en")),
    ],
)
def test_the_first_known_language_of_the_browser_is_chosen(accepted: str, language: str) -> None:
    assert chosen(accepted) == language


@pytest.mark.parametrize("language", GAME_LANGUAGES)
def test_a_catalogue_has_the_same_texts_as_the_others_and_keeps_what_is_filled_in(
    language: str,
) -> None:
    texts = catalogue(language)
    assert set(texts) == set(catalogue("de"))
    assert {pattern.title for pattern in PATTERNS.values()} <= set(texts)
    assert {name.replace("_", " ").capitalize() for name in DYES} <= set(texts)
    for english, text in texts.items():
        assert set(re.findall("{.*?}", english)) == set(re.findall("{.*?}", text)), english


def test_a_text_without_a_page_or_a_translation_is_english() -> None:
    assert translated("Undo") == "Undo"
    assert catalogue("de")["Undo"] == "Rückgängig"
    assert catalogue("en") == {}
