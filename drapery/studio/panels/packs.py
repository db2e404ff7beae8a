"""Resource packs: add them, order them, switch them on or off, compare them."""

from collections.abc import Callable, Hashable
from functools import partial

from nicegui import Client, background_tasks, run, ui
from nicegui.element import Element

from drapery import DraperyError
from drapery.packs import LAST_MASK_FORMAT, PACK_FORMATS
from drapery.studio.components import OWN_ART, editor_part
from drapery.studio.file_field import FileField
from drapery.studio.notices import errors_shown, show_notice
from drapery.studio.pack_store import PackContents, PackEntry, PackStore
from drapery.studio.panels.fields import Fields
from drapery.studio.session import Session
from drapery.studio.translation import translated
from drapery.studio.widgets import (
    KeptElements,
    button,
    on,
    text_element,
    translated_text,
)

NO_PACK = "none"
READING = "Reading all its patterns …"
LATER = 1.5
"""The delay between building the page and reading what its packs have [s]."""
GAMES = {str(each.number): each.game for each in reversed(PACK_FORMATS)}
"""Pack formats that the page offers, with the versions of the game that have them."""


def build(session: Session) -> None:
    """The field for files, the list of packs, and the comparison."""
    pack_store = session.pack_store

    async def take(number: int) -> None:
        reading.set_text(translated(READING))
        try:
            contents = await run.io_bound(pack_store.check, number) or PackContents()
            entry = pack_store.adopt(number, contents)
        except DraperyError as error:
            pack_store.refuse(number)
            show_notice(str(error), "fault")
        else:
            if contents.warnings:
                show_notice(contents.warnings[0], "warning")
            else:
                show_notice(f"{entry.name}: {contents.summary}")
        finally:
            reading.set_text("")

    translated_text("Resource packs", "h2").classes("heading")
    label = "Drop packs here, or choose them (.zip, .jar)"
    endings = ".zip,.jar,application/zip"
    FileField(session, "pack", label, take, endings=endings, multiple=True, tab="packs")
    reading = text_element("", "p").classes("hint").props("role=status")
    _list(session)
    _format(session, reading)
    translated_text("Side by side", "h2").classes("heading")
    _comparison(session)


def _list(session: Session) -> None:
    pack_store = session.pack_store

    def row(entry: PackEntry) -> Element:
        with ui.element("li").classes("pack").props(f"data-pack={entry.number}") as found:
            _row(session, entry)
        return found

    def own_art() -> Element:
        with ui.element("li").classes("pack") as found:
            _name(translated(OWN_ART), "", "below all others")
        return found

    def show() -> None:
        entries: dict[Hashable, Callable[[], Element]] = {
            entry: partial(row, entry) for entry in reversed(pack_store.entries)
        }
        with client:  # says the language
            kept.show(entries | {OWN_ART: own_art})

    client = ui.context.client
    listed = ui.element("ol").classes("packs")
    listed.props["aria-label"] = translated("Packs, the one that wins first")
    kept: KeptElements[Element] = KeptElements(listed)
    session.follow(show, "packs")


def _name(title: str, name: str, summary: str, warnings: tuple[str, ...] = ()) -> None:
    with ui.element("div").classes("pack-name"):
        text_element(title).props.update({"title": name})
        translated_text(summary).classes("hint")
        for line in warnings:  # of all that it names only the first is seen until it is opened
            with ui.element("details").classes("warning"):
                translated_text(line, "summary")


def _format(session: Session, reading: ui.label) -> None:
    """The choice of the game's version as which packs are read."""
    client, pack_store = ui.context.client, session.pack_store
    wanted: list[int | None] = []
    read_count = 0  # how many of them are read, or replaced by a later one

    async def read(format: int | None) -> None:
        nonlocal read_count
        wanted.append(format)
        place = len(wanted)
        with client:  # says the language
            reading.set_text(translated(READING))
        contents = await run.io_bound(pack_store.contents_as, format)
        if contents is None or session.closed or place < len(wanted):
            return
        read_count = place
        with client, errors_shown():
            pack_store.read_as(format, contents)
        reading.set_text("")
        fields.refresh()

    def choose(text: str) -> None:
        background_tasks.create(read(int(text) if text else None))

    def current() -> str:
        format = wanted[-1] if len(wanted) > read_count else session.settings.format
        return "" if format is None else str(format)

    fields = Fields(session)
    formats = {"": "what each pack says"} | {number: _format_title(number) for number in GAMES}
    formats.setdefault(current(), translated("pack format {number}").format(number=current()))
    with ui.element("div").classes("options"):
        fields.choice("Read packs as", formats, current, choose)
    session.listen(fields.refresh, "settings")
    if pack_store.entries:  # those with which the studio was started
        ui.timer(LATER, lambda: None if wanted else read(session.settings.format), once=True)


def _format_title(number: str) -> str:
    words = (
        "{game}, with masks (format {number})"
        if int(number) <= LAST_MASK_FORMAT
        else "{game} (format {number})"
    )
    return translated(words).format(game=GAMES[number], number=number)


def _row(session: Session, entry: PackEntry) -> None:
    client, pack_store = ui.context.client, session.pack_store

    def act(call: Callable[[], None]) -> None:
        before = session.settings.packs
        with client, errors_shown():
            call()
        # A change among packs that are off changes no option, so it has not notified "packs".
        if session.settings.packs == before:
            session.notify("packs")

    switch = ui.element("input").props("type=checkbox")
    switch.props.update(
        {"checked": entry.on, "aria-label": translated("Use {name}").format(name=entry.title)}
    )
    on(switch, "change", lambda _: act(lambda: pack_store.switch(entry.number)))
    _name(entry.title, entry.name, entry.contents.summary, entry.contents.warnings)
    acts: tuple[tuple[str, str, Callable[[], None]], ...] = (
        ("up", "Higher: {name}", lambda: pack_store.move(entry.number, 1)),
        ("down", "Lower: {name}", lambda: pack_store.move(entry.number, -1)),
        ("close", "Remove: {name}", lambda: pack_store.remove(entry.number)),
    )
    for place, (icon, text, call) in enumerate(acts, 1):

        def press(place: int = place, call: Callable[[], None] = call) -> None:
            act(call)
            _focus(client, f'[data-pack="{entry.number}"] button:nth-of-type({place})')

        label = translated(text).format(name=entry.title)
        button(label, press, icon=icon).classes("quiet")


def _focus(client: Client, selector: str) -> None:
    """Give the focus back to the pressed button, which has been replaced."""
    client.run_javascript(f"setTimeout(() => document.querySelector(`{selector}`)?.focus(), 60)")


def _comparison(session: Session) -> None:
    other, pack_store = NO_PACK, session.pack_store

    def choices() -> dict[str, str]:
        packs = {str(entry.number): entry.title for entry in reversed(pack_store.entries)}
        return {NO_PACK: translated("nothing"), "own": translated(OWN_ART)} | packs

    def choose(name: str) -> None:
        nonlocal other
        other = name if name in choices() else NO_PACK
        with errors_shown():
            session.viewport.update(beside=_paths(pack_store, other))

    def follow() -> None:
        chooser.set_choices(choices())
        # The pack on the other side may have been removed or replaced by another file.
        if other != NO_PACK:
            choose(other)

    chooser = Fields(session).choice("Compare with", choices(), lambda: other, choose)
    editor_part("beside")
    session.listen(follow, "packs")


def _paths(pack_store: PackStore, other: str) -> tuple[str, ...] | None:
    """The packs of the right side, above Drapery's art; None if there is no comparison."""
    if other == "own":
        return ()
    return (str(pack_store.path_of(int(other))),) if other.isdigit() else None
