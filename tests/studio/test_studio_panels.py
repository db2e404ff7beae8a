"""The panels of the page in German, built without a browser."""

import asyncio
from collections.abc import Callable, Coroutine
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from fastapi import Request
from nicegui import Client, core, ui
from nicegui.element import Element
from nicegui.page import page
from pack_maker import META, mcmeta, plain, zip_pack

from drapery import Banner, Settings
from drapery.errors import PackError
from drapery.studio.design_buttons import DesignButton
from drapery.studio.exports import Export, ExportRequest
from drapery.studio.library import Library
from drapery.studio.pack_store import PackStore
from drapery.studio.panels import export, file_options, letters, motion, packs, start, steps
from drapery.studio.panels.file_options import FileChoice
from drapery.studio.panels.library import LibraryPanel
from drapery.studio.records import Design
from drapery.studio.session import Session, Sessions, StudioConfig
from drapery.studio.sketch import sketch_of
from drapery.studio.snippets import KINDS, option_names

SCOPE = {
    **{"type": "http", "method": "GET", "path": "/", "scheme": "http", "query_string": b""},
    **{"server": ("127.0.0.1", 80)},
    "headers": [(b"host", b"127.0.0.1"), (b"accept-language", b"de")],
}
BANNER = Banner.parse("white creeper:lime")
Build = Callable[[Client, Session], Coroutine[Any, Any, None]]


@pytest.fixture
def in_page(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Callable[..., None]:
    """Calls a function with the client of a page and a session of it."""

    def call(build: Build, settings: Settings | None = None) -> None:
        async def run() -> None:
            monkeypatch.setattr(core, "loop", asyncio.get_running_loop())
            await build(Client(page("/"), request=Request(SCOPE)), sessions.open(settings))

        sessions = Sessions(StudioConfig(library=tmp_path / "library.sqlite"))
        try:
            asyncio.run(run())
        finally:
            sessions.close_all()

    return call


def texts(client: Client, prop: str = "") -> list[str]:
    """The texts, or a property, of the elements of a page."""
    return [
        str(each.props.get(prop, "") if prop else getattr(each, "text", ""))
        for each in client.elements.values()
    ]


def test_the_name_of_a_design_button_begins_with_its_text(in_page: Callable[..., None]) -> None:
    async def build(client: Client, session: Session) -> None:
        with client:
            seen = DesignButton(session, "found", BANNER, text="Row 3")
            alone = DesignButton(session, "found", BANNER)
        assert seen.props["aria-label"] == seen.props["title"]
        assert seen.props["aria-label"] == f"Row 3: {alone.props['aria-label']}"

    in_page(build)


def test_a_search_that_no_click_began_counts_in_german(
    in_page: Callable[..., None], tmp_path: Path
) -> None:
    async def build(client: Client, session: Session) -> None:
        with client:
            panel = LibraryPanel(session)
        await asyncio.create_task(panel.refresh())
        assert "Entwürfe: 1" in texts(client)
        assert "Red löschen" in texts(client, "title")
        assert "Red umbenennen oder markieren" in texts(client, "title")

    picture = plain(1, 2, 3, 255, side=16)
    Library(tmp_path / "library.sqlite").add(
        Design(sketch_of(BANNER, "Red"), Settings(), (), picture)
    )
    in_page(build)


def test_a_choice_of_the_format_says_in_german_what_is_read(
    in_page: Callable[..., None], tmp_path: Path
) -> None:
    async def build(client: Client, session: Session) -> None:
        with client:
            packs.build(session)
        (choice,) = [e for e in client.elements.values() if e.props.get("kind") == "select"][:1]
        said = []
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(ui.label, "set_text", lambda self, text: said.append(text))
            choice.take(value="34", number=1)
            while "" not in said:
                await asyncio.sleep(0.01)
        assert said == ["Alle Muster werden gelesen …", ""]

    pack = zip_pack(tmp_path / "pack.zip", {META: mcmeta()})
    in_page(build, Settings(packs=(pack,)))


def test_a_pack_that_cannot_be_switched_on_is_shown_as_it_is(
    in_page: Callable[..., None], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(*_: object) -> None:
        raise PackError("it is gone")

    async def build(client: Client, session: Session) -> None:
        with client:
            packs.build(session)
        shown: list[str] = []
        session.listen(lambda: shown.append("packs"), "packs")
        monkeypatch.setattr(PackStore, "switch", refuse)
        (box,) = [e for e in client.elements.values() if e.props.get("type") == "checkbox"][:1]
        for listener in box._event_listeners.values():
            if listener.type == "change":
                box._handle_event({"listener_id": listener.id, "args": {}})
        await asyncio.sleep(0)
        assert shown == ["packs"]

    pack = zip_pack(tmp_path / "pack.zip", {META: mcmeta()})
    in_page(build, Settings(packs=(pack,)))


def test_an_item_has_no_turntable(in_page: Callable[..., None]) -> None:
    async def build(client: Client, session: Session) -> None:
        with client:
            fit = file_options.build_options(session, file_options.FileChoice(kind="gif"))
            motion.build(session)
        (tick,) = [e for e in client.elements.values() if getattr(e, "text", "") == "Drehteller"]
        (place,) = [
            e
            for e in client.elements.values()
            if "item" in dict(e.props.get("choices", ())) and e.props["kind"] == "select"
        ]
        group = tick.parent_slot.parent.parent_slot.parent
        fit()
        assert group.visible
        session.adjust(turntable=True)
        place.take(value="item", number=1)
        assert (session.settings.placement, session.settings.turntable) == ("item", False)
        fit()
        assert not group.visible

    in_page(build)


FIELDS = {
    **dict.fromkeys(("seconds", "fps", "scale", "turntable", "view", "seed", "time"), 1),
    **dict.fromkeys(("samples", "pixel", "background", "ground", "light", "shadow"), 1),
    "size": 2,
}
"""How many fields of a file an option has."""


def is_seen(element: Element) -> bool:
    """Whether an element and all that holds it are visible."""
    slot = element.parent_slot
    return element.visible and (slot is None or is_seen(slot.parent))


@pytest.mark.parametrize("kind", KINDS)
def test_a_file_has_the_fields_of_the_options_that_apply_to_it(
    kind: str, in_page: Callable[..., None]
) -> None:
    async def build(client: Client, session: Session) -> None:
        choice = FileChoice(kind=kind)
        with client:
            file_options.build_options(session, choice)()
        names = option_names(file_options.request_of(session, choice))
        fields = [e for e in client.elements.values() if "option" in e.classes and is_seen(e)]
        assert len(fields) == 1 + sum(FIELDS.get(name, 0) for name in names)

    in_page(build)


@pytest.mark.parametrize("panel", [start, letters, steps])
def test_elements_stay_where_they_are_while_packs_change(
    panel: ModuleType, in_page: Callable[..., None]
) -> None:
    async def check(client: Client, session: Session) -> None:
        for base in ("red", "blue", "lime"):
            session.selection.lay_out(sketch_of(Banner(base)))
        with client:
            panel.build(session)
        before = {**client.elements}
        addresses = [address for address in texts(client, "src") if address]
        session.adjust(format=10)
        assert {**client.elements} == before
        changed = [address for address in texts(client, "src") if address]
        assert len(changed) == len(addresses) > 2
        assert all(new != old for new, old in zip(changed, addresses, strict=True))

    in_page(check)


def test_progress_waits_for_a_page_that_is_busy(
    in_page: Callable[..., None], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    async def check(client: Client, session: Session) -> None:
        with client:
            form = export.ExportForm(session, FileChoice())
        request = ExportRequest(BANNER, session.settings)
        work = session.exports.current = Export(request, tmp_path / "x.png", "x.png", 1, 4)
        answered, asked = asyncio.Event(), []

        async def answer(code: str, timeout: float) -> None:
            asked.append(code)
            await answered.wait()

        monkeypatch.setattr(client, "run_javascript", answer)
        tick = asyncio.create_task(form.tick())
        while not asked:
            await asyncio.sleep(0)
        assert not tick.done() and form.bar.props["value"] == 0.25
        answered.set()
        await tick
        sent: list[Element] = []
        monkeypatch.setattr(Element, "update", lambda element: sent.append(element))
        form.show_progress(work)
        assert sent == [], "what is unchanged is not sent again"
        work.done = 2
        form.show_progress(work)
        assert form.bar in sent

    in_page(check)
