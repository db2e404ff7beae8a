"""The page's catalogues are whole, and the browser's first known language is chosen."""

import ast
import asyncio
import inspect
import re
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from fastapi import Request
from nicegui import Client, core, ui
from nicegui.element import Element
from nicegui.page import page
from nicegui.slot import Slot

from drapery import Banner
from drapery.banner import DYES, FORMS, PATTERNS
from drapery.settings import OPTIONS
from drapery.studio import translation
from drapery.studio.descriptions import named
from drapery.studio.design_catalogue import own_designs
from drapery.studio.page import PANELS, build as build_page
from drapery.studio.panels.file_options import hint_of
from drapery.studio.panels.live import garment_descriptions, scene_summaries
from drapery.studio.session import Sessions
from drapery.studio.sketch import sketch_of
from drapery.studio.snippets import KINDS
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
    assert translated("Untitled") == "Untitled"
    assert catalogue("de")["Untitled"] == "Ohne Titel"
    assert catalogue("en") == {}


def test_every_text_and_choice_of_the_page_is_in_the_catalogues(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Names of methods, grids, designs and forms of text are the same in all languages."""
    asked: set[str] = set()
    shown: set[str] = set()
    drawn: set[str] = set()

    def note(text: str, to: str = "") -> str:
        asked.add(text)
        return f"«{text}»"

    for name, module in [*sys.modules.items()]:
        if name.startswith("drapery.studio.") and hasattr(module, "translated"):
            monkeypatch.setattr(module, "translated", note)

    # Timers, which build the panels in tabs behind among others, wait for a browser.
    later: list[tuple[Slot, Callable[[], object]]] = []
    start = ui.timer

    def timer(interval: float, call: Callable[[], object], once: bool = False, **more: Any) -> Any:
        made = start(interval, call, once=once, **more)
        if once and made.parent_slot:
            later.append((made.parent_slot, call))
        return made

    async def build() -> None:
        monkeypatch.setattr(ui, "timer", timer)
        monkeypatch.setattr(core, "loop", asyncio.get_running_loop())
        with Client(page("/"), request=Request(SCOPE)) as client:
            session = sessions.open()
            build_page(session, sessions)
            for slot, call in later:
                with slot:
                    done = call()
                    if inspect.isawaitable(done):
                        await done
            for summary in (*scene_summaries().values(), *garment_descriptions().values()):
                named("", summary)
            asked.update(hint_of(kind) for kind in KINDS)
            session.take(sketch_of(Banner.parse("white creeper:black")))
            for element in client.elements.values():
                shown.update(texts_of(element))
                if element.default_slot.children:
                    drawn.add(str(element.props.get("id", "")).removeprefix("panel-"))

    sessions = Sessions()
    try:
        asyncio.run(build())
    finally:
        sessions.close_all()
    assert sorted(panel.title for panel in PANELS if panel.name not in drawn) == []
    same = {*OPTIONS["solver"].choices, *FORM_TITLES}
    left = {text for text in asked - same if WORD.search(without_marks(text))}
    assert sorted(text for text in left if not is_german(text)) == []
    titles = {"Drapery Studio", *(design.title for design in own_designs())}
    # The name of a design's button begins with the title that it shows.
    named_designs = re.compile(f"({'|'.join(map(re.escape, titles))}): «")
    left = {named_designs.sub("«", text) for text in shown - titles}
    assert sorted(text for text in left if WORD.search(without_marks(text))) == []


FORM_TITLES = frozenset(f"{name}: {form.title}" for name, form in FORMS.items())


def is_german(text: str) -> bool:
    """Whether the German catalogue has the text, filled in or as it is."""
    return text in catalogue("de") or translated(text, "de") != text


WORD = re.compile("[A-Za-z]{4}")
"""What remains of a text that nobody has translated; an abbreviation or a key is shorter."""


def texts_of(element: Element) -> Iterator[str]:
    """What an element of the page says."""
    yield getattr(element, "text", "") or ""
    for name in ("title", "aria-label", "placeholder", "alt", "label", "aria-valuetext"):
        yield str(element.props.get(name, ""))


def without_marks(text: str) -> str:
    """A text without its marked parts, one in another, and without keys in brackets."""
    while (inner := re.sub("«[^«»]*»", "", text)) != text:
        text = inner
    return re.sub(r"\((Ctrl|Shift|Enter|\+|[A-Z?])+\)| with ", "", text)


@pytest.mark.parametrize(
    ("text", "german"),
    [
        ("my {pack}.zip is empty; send it again", "my {pack}.zip ist leer; sende sie noch einmal"),
        ("a with b", "a with b"),
        (
            "layer 1 'creeper:mauve': unknown dye 'mauve'; did you mean 'lime'?",
            "Lage 1 'creeper:mauve': unbekannte Farbe 'mauve'; meintest du 'lime'?",
        ),
    ],
)
def test_a_message_is_translated_with_what_is_filled_in(text: str, german: str) -> None:
    assert translated(text, "de") == german


def test_every_message_of_the_studio_is_in_the_catalogues() -> None:
    """The errors that its modules raise; not those of the command, nor of links and files that
    somebody has changed."""
    found = set()
    for path in Path(translation.__file__).parent.glob("**/*.py"):
        if path.stem not in UNTRANSLATED:
            for call in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
                if isinstance(call, ast.Call) and ast.unparse(call.func) in ERRORS and call.args:
                    found.add(sample(call.args[0]))
    missing = {text for text in found if WORD.search(text) and not is_german(text)}
    assert sorted(missing) == []


ERRORS = frozenset({"DesignError", "OptionError", "OutputError", "PackError", "show_notice"})
UNTRANSLATED = frozenset({"app", "share", "records", "exports"})


def sample(text: ast.expr) -> str:
    """A message with something in each of its places."""
    if isinstance(text, ast.JoinedStr):
        return "".join(
            each.value if isinstance(each, ast.Constant) else "7" for each in text.values
        )
    return text.value if isinstance(text, ast.Constant) else ""
