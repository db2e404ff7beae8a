"""The page's catalogues are whole, and the browser's first known language is chosen."""

import asyncio
import re
import sys

import pytest
from fastapi import Request
from nicegui import Client, core
from nicegui.page import page

from drapery.banner import DYES, PATTERNS
from drapery.settings import OPTIONS
from drapery.studio.descriptions import named
from drapery.studio.page import build as build_page
from drapery.studio.panels.live import garment_descriptions, scene_summaries
from drapery.studio.session import Sessions
from drapery.studio.translation import GAME_LANGUAGES, catalogue, chosen, translated

SCOPE = {
    **{"type": "http", "method": "GET", "path": "/", "scheme": "http", "query_string": b""},
    **{"server": ("127.0.0.1", 80), "headers": [(b"host", b"127.0.0.1")]},
}


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


def test_every_text_and_choice_of_the_page_is_in_the_catalogues(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Names of methods, grids and forms of text are the same in all languages."""
    asked: set[str] = set()

    def note(text: str) -> str:
        asked.add(text)
        return text

    for name, module in [*sys.modules.items()]:
        if name.startswith("drapery.studio.") and hasattr(module, "translated"):
            monkeypatch.setattr(module, "translated", note)

    async def build() -> None:
        monkeypatch.setattr(core, "loop", asyncio.get_running_loop())
        with Client(page("/"), request=Request(SCOPE)):
            session = sessions.open()
            build_page(session, sessions)
            for summary in (*scene_summaries().values(), *garment_descriptions().values()):
                named("", summary)
            session.selection.press_pattern("creeper")

    sessions = Sessions()
    try:
        asyncio.run(build())
    finally:
        sessions.close_all()
    same = {*OPTIONS["solver"].choices, *OPTIONS["samples"].choices}
    own = {text for text in asked if re.search(r": | × |format \d", text) or text in map(str, same)}
    assert sorted(asked - own - set(catalogue("de")) - {""}) == []
