"""The panels of the page in German, built without a browser."""

import asyncio
from collections.abc import AsyncIterator, Callable, Coroutine
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fastapi import Request
from nicegui import Client, core, ui
from nicegui.element import Element
from nicegui.page import page
from pack_maker import CREEPER, META, mcmeta, plain, zip_pack

from drapery import Banner, Settings
from drapery.banner import FORMS
from drapery.errors import OptionError, PackError
from drapery.match import Match
from drapery.render import png_bytes
from drapery.settings import LOOP_OPTIONS, LoopSettings
from drapery.studio.design_buttons import DesignButton
from drapery.studio.exports import Export, ExportRequest
from drapery.studio.file_field import FileField
from drapery.studio.form_field import FormField
from drapery.studio.library import Library
from drapery.studio.pack_store import PackStore
from drapery.studio.panels import (
    export,
    file_options,
    motion,
    packs,
    picture,
    written,
)
from drapery.studio.panels.file_options import FileChoice
from drapery.studio.panels.library import LibraryPanel
from drapery.studio.records import Design
from drapery.studio.session import Session, Sessions, StudioConfig
from drapery.studio.sketch import sketch_of
from drapery.studio.snippets import FORMATS, KINDS, option_names, plain as plain_number
from drapery.studio.translation import translated

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


def emit(element: Element, event: str, args: Any) -> None:
    """What the page does when an element emits an event."""
    for listener in element._event_listeners.values():
        if listener.type == event:
            element._handle_event({"listener_id": listener.id, "args": args})


def test_a_number_whose_default_depends_on_others_is_shown(
    in_page: Callable[..., None], monkeypatch: pytest.MonkeyPatch
) -> None:
    async def build(client: Client, session: Session) -> None:
        with client:
            motion.build(session)
        fields = [each for each in client.elements.values() if isinstance(each, FormField)]
        values = {kind: [] for kind in ("range", "number", "checkbox", "select", "text")}
        for each in fields:
            values[each.props["kind"]].append(each.props["shown"]["value"])
        assert None not in values["checkbox"] and values["range"]
        assert all(float(text) >= 0 for text in values["range"])

    monkeypatch.setattr(Settings, "as_given", lambda self, name: None)
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
        emit(box, "change", {})
        await asyncio.sleep(0)
        assert shown == ["packs"]

    pack = zip_pack(tmp_path / "pack.zip", {META: mcmeta()})
    in_page(build, Settings(packs=(pack,)))


@pytest.mark.parametrize(
    ("files", "tone"), [({}, "warning"), ({CREEPER: plain(9, 0, 0, 255)}, "done")]
)
def test_a_pack_without_a_texture_gets_a_warning(
    files: dict[str, bytes],
    tone: str,
    in_page: Callable[..., None],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    async def data() -> AsyncIterator[bytes]:
        yield zip_pack(tmp_path / "pack.zip", {META: mcmeta(), **files}).read_bytes()

    async def build(client: Client, session: Session) -> None:
        with client:
            packs.build(session)
        upload = await session.uploads.receive(data(), "pack", "empty.zip")
        (field,) = [e for e in client.elements.values() if isinstance(e, FileField)]
        emit(field, "sent", {"number": upload.number})
        while not said:
            await asyncio.sleep(0.01)
        line, shown = said[0]
        assert "empty.zip" in line and shown == tone

    said: list[tuple[str, str]] = []
    monkeypatch.setattr(packs, "show_notice", lambda line, tone="done": said.append((line, tone)))
    in_page(build)


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


def field_of(client: Client, label: str) -> Element:
    """The field with this label, in German."""
    (text,) = [e for e in client.elements.values() if getattr(e, "text", "") == label]
    return next(e for e in text.parent_slot.children if "kind" in e.props)


TYPED = [
    ("Breite", "300,0", 300),
    ("Breite", " 300 ", 300),
    ("Breite", "", 512),
    ("Breite", "2.5", "is not a whole number"),
    ("Breite", "-5", "is out of range; use"),
    ("Sekunden", "2,5", 2.5),
    ("Sekunden", "-5", "seconds -5 is out of range; use"),
    ("Sekunden", "1e9", "seconds 1e+09 is out of range; use"),
    ("Sekunden", "ten", "seconds 'ten' is not a number; use"),
]


@pytest.mark.parametrize(("label", "text", "taken"), TYPED)
def test_a_typed_number_is_taken_with_a_comma_and_refused_at_once(
    label: str,
    text: str,
    taken: float | str,
    in_page: Callable[..., None],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    async def build(client: Client, session: Session) -> None:
        choice = FileChoice(kind="gif")
        with client:
            file_options.build_options(session, choice)()
            field = field_of(client, label)
            before = field.props["shown"]["value"]
            field.take(value=text, number=1)
        now = session.settings.size[0] if label == "Breite" else choice.numbers["seconds"]
        if isinstance(taken, str):
            assert taken in said[0]
            assert field.props["shown"]["value"] == before == plain_number(now)
        else:
            assert said == [] and now == taken

    said: list[str] = []
    monkeypatch.setattr("drapery.studio.notices.show_notice", lambda line, _: said.append(line))
    in_page(build)


def test_forms_of_text_are_listed_from_the_common_ones_to_the_others_by_name(
    in_page: Callable[..., None],
) -> None:
    async def build(client: Client, session: Session) -> None:
        with client:
            written.build_writer(session)
        names = [name for name, _ in field_of(client, "Form des Textes").props["choices"]]
        assert names[:3] == ["give", "give-legacy", "give-1.12"]
        common = len(written.COMMON)
        assert names[common:] == sorted(names[common:])
        assert {*names} == {name for name, form in FORMS.items() if form.write}

    in_page(build)


@pytest.mark.parametrize("built", [True, False])
def test_a_page_is_offered_only_where_its_module_is_built(
    built: bool, in_page: Callable[..., None], monkeypatch: pytest.MonkeyPatch
) -> None:
    async def build(client: Client, session: Session) -> None:
        with client:
            file_options.build_options(session, FileChoice())
        kinds = [name for name, _ in field_of(client, "Datei").props["choices"]]
        assert ("html" in kinds) == built and "gif" in kinds

    monkeypatch.setattr(file_options, "is_module_built", lambda: built)
    in_page(build)


def test_the_corners_of_a_flag_that_is_not_found_are_clicked(
    in_page: Callable[..., None], monkeypatch: pytest.MonkeyPatch
) -> None:
    shape = 1320, 200, 4
    corners: tuple[tuple[float, float], ...] = ((60, 40), (140, 40), (140, 200), (60, 200))

    def match(pixels: np.ndarray, given: object, *, packs: object) -> list[Match]:
        assert pixels.shape == shape
        if given is None:
            raise OptionError("no flag was found")
        moved = (expected.pop(), *corners[1:]) if expected else corners
        np.testing.assert_allclose(np.array(given), moved)
        return [Match(BANNER, 0.03)]

    async def data() -> AsyncIterator[bytes]:
        yield png_bytes(np.zeros(shape, np.uint8))

    async def build(client: Client, session: Session) -> None:
        with client:
            picture.build(session)
        field_of(client, "Es ist ein Foto eines Banners: aufrichten").take(True, 1)
        upload = await session.uploads.receive(data(), "picture", "photo.png")
        elements = client.elements.values()
        field = next(e for e in elements if isinstance(e, FileField))
        emit(field, "sent", {"number": upload.number})
        while not any(text.startswith("Keine Fahne gefunden") for text in texts(client)):
            await asyncio.sleep(0.01)
        photo = next(e for e in elements if e.props.get("alt") == "photo.png")
        assert is_seen(photo) and photo.props["src"].startswith("data:image/webp")
        for x, y in corners:
            emit(photo, "click", [x / shape[1], y / shape[0]])
        while not any(isinstance(each, DesignButton) for each in elements):
            await asyncio.sleep(0.01)
        assert "sehr nah: 1" in [each.props.get("data-label") for each in elements]
        marks = [e for e in elements if e.props.get("role") == "slider"]
        assert marks[0].props["aria-label"] == "Ecke oben links"
        emit(marks[0], "keydown", [10, 0])  # Shift and an arrow key
        emit(marks[0], "keydown", [0, -1])
        while marks[0].props["aria-valuetext"] != "40 % von links, 2 % von oben":
            await asyncio.sleep(0.01)
        expected.append((80, 40 - shape[0] / 100))
        emit(marks[0], "keydown", [])
        while expected:
            await asyncio.sleep(0.01)

    expected: list[tuple[float, float]] = []
    monkeypatch.setattr(picture, "match_photo", match)
    in_page(build)


def test_a_deleted_design_comes_back_after_another_is_opened(
    in_page: Callable[..., None], tmp_path: Path
) -> None:
    async def build(client: Client, session: Session) -> None:
        with client:
            panel = LibraryPanel(session)
        await panel.refresh()
        await press(client, "Red löschen", until=lambda: titles() == {"Blue"})
        await press(client, "Blue öffnen", until=lambda: session.sketch.title == "Blue")
        await press(client, "Zurückholen", until=lambda: titles() == {"Red", "Blue"})

    async def press(client: Client, title: str, until: Callable[[], bool]) -> None:
        named = lambda: [e for e in client.elements.values() if e.props.get("title") == title]  # noqa: E731
        while not named():
            await asyncio.sleep(0.01)
        (found,) = named()
        assert is_seen(found)
        emit(found, "click", {})
        while not until():
            await asyncio.sleep(0.01)

    def titles() -> set[str]:
        return {each.title for each in library.search()[0]}

    library = Library(tmp_path / "library.sqlite")
    for title in ("Red", "Blue"):
        picture = plain(1, 2, 3, 255, side=16)
        library.add(Design(sketch_of(BANNER, title), Settings(), (), picture))
    in_page(build)


FIELDS = {
    **dict.fromkeys((*LOOP_OPTIONS, "scale", "turntable", "view", "seed", "time"), 1),
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


@pytest.mark.parametrize("kind", KINDS)
def test_a_file_without_transparency_says_so_by_the_name_of_its_format(kind: str) -> None:
    format = FORMATS.get(kind)
    without = format is not None and format.kind() in ("still", "loop") and format.alpha == "none"
    said = file_options.hint_of(kind)
    assert ("has no transparency" in said) == without
    if without:
        assert said.startswith(f"{format.name} ") and translated(said, "de") != said


def test_a_file_that_moves_has_the_length_of_the_page_and_a_still_is_made_beside_any(
    in_page: Callable[..., None],
) -> None:
    async def build(client: Client, session: Session) -> None:
        choice = FileChoice(kind="gif")
        choice.set(numbers=choice.numbers | {"seconds": 2.0, "fps": 8.0})
        assert file_options.request_of(session, choice).timing == LoopSettings(2.0, 8.0)
        choice.set(numbers=choice.numbers | {"seconds": 3000.0})
        with pytest.raises(OptionError, match=r"seconds 3000 .* use 0\.125 to 450 s at 8 frames/s"):
            file_options.request_of(session, choice)
        choice.set(kind="png")
        assert file_options.request_of(session, choice).kind == "png"

    in_page(build)


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
