"""Read a design from any form of text or file, and write it in any form."""

from collections.abc import Callable, Hashable
from functools import partial

from nicegui import context, ui
from nicegui.element import Element

from drapery import Banner
from drapery.studio.design_buttons import DesignButton
from drapery.studio.file_field import FileField
from drapery.studio.notices import ADDED, called_in_thread, show_notice
from drapery.studio.panels.written import build_writer
from drapery.studio.session import Session
from drapery.studio.sketch import sketch_of
from drapery.studio.translation import translated
from drapery.studio.upload_queue import MAX_FOUND, UploadQueue
from drapery.studio.widgets import (
    KeptElements,
    button,
    hint,
    on,
    text_element,
    translated_text,
)

MAX_PLACE = 60
"""The most characters shown of the place where a banner was found."""

_PLACEHOLDER = (
    "Paste a /give command, an item, JSON, the address of a banner editor,"
    " or write: white creeper:lime, or a blazon: Azure, a bend Or"
)


def build(session: Session) -> None:
    """A field that reads designs, and a field to copy the design from."""
    _reader(session)
    build_writer(session)


def _reader(session: Session) -> None:
    upload_queue = session.upload_queue
    translated_text("Read a design", "h2").classes("heading")
    text = ui.element("textarea").classes("field command").props('id="design-text" rows=4')
    text.props.update({"placeholder": translated(_PLACEHOLDER)})
    text.props["aria-label"] = translated("A design in any form")
    fault = text_element("", "p").classes("fault").props('role="alert"')
    with ui.element("div").classes("line"):
        press = button("Read this text", text="Read", key="Ctrl+Enter")
        press.classes("main").props('id="read-text"')
    FileField(session, "design", "Choose a file", upload_queue.read_file, zone="body")
    hint("Or drop a file anywhere: schematics, structures, regions, saves, functions.")
    choices: KeptElements[Element] = KeptElements(ui.element("div").classes("found-list"))
    read = partial(upload_queue.read_text, beside=True)
    on(text, "read", read, js_handler="(e) => emit(String(e.detail))")
    client = context.client

    def arrive() -> None:
        with client:
            _arrive(session, upload_queue)
            fault.set_text(translated(upload_queue.line))
            fault.set_visibility(bool(upload_queue.line))
            choices.show(_choices(session, upload_queue))

    fault.set_visibility(False)
    session.listen(arrive, "read")


def _arrive(session: Session, upload_queue: UploadQueue) -> None:
    for note in upload_queue.notes:
        show_notice(note, "warning")
    if upload_queue.line:
        # The line is shown next to the field already.
        if not upload_queue.beside:
            show_notice(upload_queue.line, "fault")
    elif len({found.banner for found in upload_queue.found}) == 1:
        _open(session, upload_queue.found[0].banner, upload_queue.title)
    else:
        ui.run_javascript("studio.tab('text')")
        show_notice(
            f"{len(upload_queue.found)} banners in {upload_queue.name or 'the text'}: choose one"
        )


def _open(session: Session, banner: Banner, title: str = "") -> None:
    sketch = sketch_of(banner, title or session.sketch.title)
    session.lay_out(sketch)
    show_notice(f"The design has been read. Layers: {len(sketch.strokes)}")


def _choices(session: Session, upload_queue: UploadQueue) -> dict[Hashable, Callable[[], Element]]:
    """What makes the buttons of several banners that were found, by what each shows."""
    if len({found.banner for found in upload_queue.found}) < 2:
        return {}

    def choice(place: str, banner: Banner) -> Element:
        press = partial(_open, session, banner)
        return DesignButton(session, "found", banner, press, text=place, side=30)

    save = partial(button, "Save all banners in the library", partial(save_all, session))
    wanted: dict[Hashable, Callable[[], Element]] = {"save": partial(save, text="Save all")}
    for number, found in enumerate(upload_queue.found[:MAX_FOUND], 1):
        place = _shortened(found.where) or f"{translated('Banner')} {number}"
        wanted[number, place, found.banner] = partial(choice, place, found.banner)
    if (count := len(upload_queue.found)) > MAX_FOUND:
        wanted["more", count] = partial(hint, f"The first {MAX_FOUND} of {count}.")
    return wanted


async def save_all(session: Session) -> None:
    """Save each banner that was read in the library, under its place and a tag of its file."""
    client, settings = context.client, session.settings
    found, name = session.upload_queue.found, session.upload_queue.name

    def save() -> tuple[int, int]:
        from drapery.studio.records import tagged_designs

        designs = tagged_designs(found, name, settings, session.packs())
        return session.library().add_new(designs)

    counts = await called_in_thread(client, save)
    if counts is not None and not session.closed:
        with client:
            show_notice(ADDED.format(*counts))
        session.notify("library")


def _shortened(place: str) -> str:
    return place if len(place) <= MAX_PLACE else f"{place[: MAX_PLACE - 1]}…"
