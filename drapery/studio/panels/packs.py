"""Resource packs: dropped here, put in order, switched, and seen side by side."""

from collections.abc import Callable
from itertools import count

from nicegui import Client, run, ui

from drapery.errors import DraperyError
from drapery.studio.drop import Drop
from drapery.studio.notices import faults, tell
from drapery.studio.pack_store import Entry, PackStore, shelf_of
from drapery.studio.panels.fields import Fields
from drapery.studio.session import Session
from drapery.studio.viewport import stage_of
from drapery.studio.widgets import button, words

NOBODY = "nobody"
OWN_ART = "Drapery's own art"


def build(session: Session) -> None:
    """The field for files, the list of packs, and the comparison."""
    shelf = shelf_of(session)

    async def take(number: int) -> None:
        reading.set_text("Reading all its patterns …")
        try:
            summary = await run.io_bound(shelf.check, number) or ""
            entry = shelf.adopt(number, summary)
        except DraperyError as error:
            shelf.refuse(number)
            tell(str(error), "fault")
        else:
            tell(f"{entry.name}: {summary}")
        finally:
            reading.set_text("")

    words("Resource packs", "h2").classes("heading")
    label = "Drop packs here, or choose them (.zip, .jar)"
    endings = ".zip,.jar,application/zip"
    Drop(session, "pack", label, take, endings=endings, multiple=True, tab="packs")
    reading = words("", "p").classes("hint").props("role=status")
    _list(session, shelf)
    words("Side by side", "h2").classes("heading")
    _comparison(session, shelf)


def _list(session: Session, shelf: PackStore) -> None:
    @ui.refreshable
    def entries() -> None:
        with ui.element("ol").classes("packs").props('aria-label="Packs, the one that wins first"'):
            for entry in reversed(shelf.entries):
                with ui.element("li").classes("pack").props(f"data-pack={entry.number}"):
                    _row(session, shelf, entry)
            with ui.element("li").classes("pack"):
                _name(OWN_ART, OWN_ART, "beneath all others")

    entries()
    session.listen("packs", entries.refresh)


def _name(title: str, name: str, summary: str) -> None:
    with ui.element("div").classes("pack-name"):
        words(title).props.update({"title": name})
        words(summary).classes("hint")


def _row(session: Session, shelf: PackStore, entry: Entry) -> None:
    client = ui.context.client

    def act(call: Callable[[], None]) -> None:
        before = session.settings.packs
        with client, faults():
            call()
        # The order of packs that are off is nobody else's business, so nobody has told of it.
        if session.settings.packs == before:
            session.tell("packs")

    switch = ui.element("input").props("type=checkbox")
    switch.props.update({"checked": entry.on, "aria-label": f"Use {entry.title}"})
    switch.on("change", lambda: act(lambda: shelf.switch(entry.number)))
    _name(entry.title, entry.name, entry.summary)
    acts: tuple[tuple[str, str, Callable[[], None]], ...] = (
        ("arrow_upward", "Higher", lambda: shelf.move(entry.number, 1)),
        ("arrow_downward", "Lower", lambda: shelf.move(entry.number, -1)),
        ("close", "Remove", lambda: shelf.remove(entry.number)),
    )
    for icon, label, call in acts:

        def press(label: str = label, call: Callable[[], None] = call) -> None:
            act(call)
            _focus(client, f'[data-pack="{entry.number}"] [aria-label^="{label}"]')

        button(f"{label}: {entry.title}", press, icon=icon).classes("small")


def _focus(client: Client, selector: str) -> None:
    """Back to what was pressed, which has been drawn anew."""
    client.run_javascript(f"setTimeout(() => document.querySelector(`{selector}`)?.focus(), 60)")


def _comparison(session: Session, shelf: PackStore) -> None:
    version, other = count(), NOBODY

    def choices() -> dict[str, str]:
        packs = {str(entry.number): entry.title for entry in reversed(shelf.entries)}
        return {NOBODY: "nothing", "own": OWN_ART} | packs

    def choose(name: str) -> None:
        nonlocal other
        other = name if name in choices() else NOBODY
        with faults():
            stage_of(session).wish(beside=_paths(shelf, other))
        pictures.refresh()

    @ui.refreshable
    def chooser() -> None:
        Fields().choice("Compare with", choices(), lambda: other, choose)

    @ui.refreshable
    def pictures() -> None:
        if other != NOBODY:
            with ui.element("div").classes("versus"):
                _side(session, "now", "Your packs in their order", next(version))
                _side(session, other, choices()[other], next(version))

    def follow() -> None:
        chooser.refresh()
        # What is compared with may be gone, or be another file now.
        if other != NOBODY:
            choose(other)

    chooser()
    pictures()
    session.listen("packs", follow)
    session.listen("sketch", pictures.refresh)


def _paths(shelf: PackStore, other: str) -> tuple[str, ...] | None:
    """What is laid over our own art on the right; None where nothing is compared."""
    if other == "own":
        return ()
    return (str(shelf.path_of(int(other))),) if other.isdigit() else None


def _side(session: Session, which: str, caption: str, version: int) -> None:
    """The design and all patterns, drawn from one stack of packs."""
    sketch = session.sketch
    dye = sketch.strokes[-1].dye if sketch.strokes else "black"
    field = next(each for each in (sketch.base, "white", "black") if each != dye)
    address = f"/compare/{session.token}/{which}"
    with ui.element("figure").classes("versus-side"):
        words(caption, "figcaption")
        for what, query in (("face", ""), ("patterns", f"&base={field}&dye={dye}")):
            picture = ui.element("img").classes(f"versus-{what}")
            title = "Design" if what == "face" else "Patterns"
            picture.props.update(
                {"src": f"{address}/{what}.png?v={version}{query}", "alt": f"{title}: {caption}"}
            )
