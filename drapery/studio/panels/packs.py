"""Resource packs: dropped here, put in order, switched, and seen side by side."""

from collections.abc import Callable
from itertools import count

from nicegui import run, ui

from drapery.errors import DraperyError
from drapery.studio.drop import Drop
from drapery.studio.notices import faults, tell
from drapery.studio.session import Session
from drapery.studio.shelf import Entry, Shelf, shelf_of
from drapery.studio.stage import stage_of

NOBODY = "nobody"
"""The choice of nothing to compare with."""


def build(session: Session) -> None:
    """The field for files, the list of packs, and the comparison."""
    shelf = shelf_of(session)

    async def take(number: int) -> None:
        try:
            summary = await run.io_bound(shelf.check, number)
            entry = shelf.adopt(number, summary)
        except DraperyError as error:
            shelf.refuse(number)
            tell(str(error), "fault")
        else:
            tell(f"{entry.name}: {summary}")

    with ui.element("div").classes("stack"):
        Drop(
            session,
            "pack",
            "Drop resource packs here, or choose them (.zip, .jar)",
            take,
            endings=".zip,.jar,application/zip",
            multiple=True,
        )
        _list(session, shelf)
        _comparison(session, shelf)


def _list(session: Session, shelf: Shelf) -> None:
    @ui.refreshable
    def entries() -> None:
        with ui.element("ol").classes("packs").props('aria-label="Packs, the one that wins first"'):
            for entry in reversed(shelf.entries):
                with ui.element("li").classes("pack").props(f"data-pack={entry.number}"):
                    _row(session, shelf, entry)
            with ui.element("li").classes("pack"), ui.element("div").classes("pack-name"):
                ui.label("Drapery's own art")
                ui.label("beneath all others").classes("hint")

    entries()
    session.listen("packs", entries.refresh)


def _row(session: Session, shelf: Shelf, entry: Entry) -> None:
    def act(call: Callable[[], None]) -> None:
        before = session.settings.packs
        with faults():
            call()
        # The order of packs that are off is nobody else's business, so nobody has told of it.
        if session.settings.packs == before:
            session.tell("packs")

    switch = ui.checkbox(
        value=entry.on, on_change=lambda: act(lambda: shelf.switch(entry.number))
    ).props("dense")
    switch.props["aria-label"] = f"Use {entry.name}"
    with ui.element("div").classes("pack-name"):
        ui.label(entry.name).tooltip(entry.name)
        ui.label(entry.summary).classes("hint")
    acts: tuple[tuple[str, str, Callable[[], None]], ...] = (
        ("arrow_upward", "Higher", lambda: shelf.move(entry.number, 1)),
        ("arrow_downward", "Lower", lambda: shelf.move(entry.number, -1)),
        ("close", "Remove", lambda: shelf.remove(entry.number)),
    )
    for icon, words, call in acts:
        button = ui.button(icon=icon, on_click=lambda call=call: act(call))
        button.props("flat dense size=sm").tooltip(words)
        button.props["aria-label"] = f"{words}: {entry.name}"


def _comparison(session: Session, shelf: Shelf) -> None:
    version = count()

    def choices() -> dict[str, str]:
        packs = {str(entry.number): entry.name for entry in reversed(shelf.entries)}
        return {NOBODY: "nothing", "own": "Drapery's own art"} | packs

    def chosen() -> str:
        return str(select.value) if select.value in choices() else NOBODY

    def compare() -> None:
        other = chosen()
        with faults():
            stage_of(session).wish(beside=_paths(shelf, other))
        pictures.refresh()

    def follow() -> None:
        kept = chosen()
        select.set_options(choices(), value=kept)
        compare()

    @ui.refreshable
    def pictures() -> None:
        other = chosen()
        if other != NOBODY:
            with ui.element("div").classes("versus"):
                _side(session, "now", "Your packs in their order", next(version))
                _side(session, other, choices()[other], next(version))

    select = ui.select(choices(), value=NOBODY, label="Compare with", on_change=compare)
    select.props('dense outlined options-dense aria-label="Compare with"').classes("control")
    pictures()
    session.listen("packs", follow)
    session.listen("sketch", pictures.refresh)


def _paths(shelf: Shelf, other: str) -> tuple[str, ...] | None:
    """What is laid over our own art on the right; None where nothing is compared."""
    if other == "own":
        return ()
    return (str(shelf.path_of(int(other))),) if other.isdigit() else None


def _side(session: Session, which: str, caption: str, version: int) -> None:
    """The design and all patterns, drawn from one stack of packs."""
    sketch = session.sketch
    dye = sketch.strokes[-1].dye if sketch.strokes else "black"
    others = (sketch.base, "white", "black")
    field = next(each for each in others if each != dye)
    address = f"/compare/{session.token}/{which}"
    with ui.element("figure").classes("versus-side"):
        with ui.element("figcaption"):
            ui.label(caption)
        for what, query in (("face", ""), ("patterns", f"&base={field}&dye={dye}")):
            picture = ui.element("img").classes(f"versus-{what}")
            picture.props["src"] = f"{address}/{what}.png?v={version}{query}"
            picture.props["alt"] = f"{'Design' if what == 'face' else 'Patterns'}: {caption}"
