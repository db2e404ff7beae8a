"""The library: designs that are kept, found, opened and put away again."""

from base64 import b64encode
from collections.abc import Awaitable, Callable
from dataclasses import replace
from typing import TYPE_CHECKING, Any, TypeVar

from nicegui import run, ui

from drapery.banner.design import Banner
from drapery.banner.packs import Packs
from drapery.errors import DraperyError
from drapery.studio import page
from drapery.studio.desk import desk_of
from drapery.studio.drop import Drop
from drapery.studio.notices import tell
from drapery.studio.session import Session
from drapery.studio.share import SHARED, over
from drapery.studio.shared_library import library_at
from drapery.studio.sketch import MAX_TITLE, banner_of
from drapery.studio.uploads import uploads_of

if TYPE_CHECKING:
    from drapery.studio.library import Design, Library

T = TypeVar("T")

PAGE = 24
"""Designs that are shown at first, and more by every More."""


def build(session: Session) -> None:
    """The form that keeps the design, the search, what it finds, and the whole library's door."""
    with ui.element("div").classes("stack library"):
        Shelves(session)


class Shelves:
    """The panel of one tab.

    open: the number of the design that is being worked on, 0 for one that is not kept yet.
    """

    def __init__(self, session: Session) -> None:
        self._session = session
        self._open = 0
        self._most = PAGE
        self._gone: Design | None = None
        self._form()
        self._search()
        self._undo_bar = ui.element("div").classes("undo-bar").props("role=status")
        self._undo_bar.set_visibility(False)
        self._found = ui.element("ul").classes("designs").props('aria-label="Designs"')
        self._count = ui.label("").classes("hint").props("role=status")
        self._more = ui.button("More", on_click=self._show_more).props("flat dense no-caps")
        self._doors()
        session.listen("sketch", self._follow)
        # The database is not needed for the first picture.
        ui.timer(LATER, self._refresh, once=True)

    def _form(self) -> None:
        with ui.element("div").classes("save-form"):
            self._title = _field("Title", maxlength=MAX_TITLE)
            self._tags = _field("Tags, with commas between")
            with ui.element("div").classes("save-buttons"):
                self._save = _button("save", "Save", self._save_open)
                self._save_new = _button("add", "Save as new", self._save_as_new)
        self._save_new.set_visibility(False)
        self._title.set_value(self._session.sketch.title)
        self._title.on("keydown.enter", self._save_open)

    def _search(self) -> None:
        with ui.element("div").classes("search"):
            self._words = _field("Search title, tag, dye or pattern").props(
                "debounce=250 clearable"
            )
            self._words.props("type=search")
            self._tag = ui.select({"": "all tags"}, value="", label="Tag")
            self._tag.props('dense outlined options-dense aria-label="Tag"')
        self._words.on_value_change(self._search_anew)
        self._tag.on_value_change(self._search_anew)

    def _doors(self) -> None:
        with ui.element("div").classes("doors"):
            ui.link("Export the library", f"/library/{self._session.token}").props("download")
            Drop(
                self._session,
                "library",
                "Import a library (.json)",
                self._import,
                endings=".json,application/json",
            )

    def _follow(self) -> None:
        if self._title.value != self._session.sketch.title:
            self._title.set_value(self._session.sketch.title)

    async def _do(self, act: "Callable[[Library], T]") -> T | None:
        """What the library answers, in a thread; None where it refused, which the user is told."""

        def ask() -> T:
            return act(library_at(page.house.library))

        try:
            return await run.io_bound(ask)
        except DraperyError as error:
            tell(str(error), "fault")
            return None

    async def _refresh(self) -> None:
        words, tag = str(self._words.value or ""), self._tag.value or None
        found = await self._do(lambda library: library.search(words, tag, most=self._most))
        tags = await self._do(lambda library: library.tags())
        if found is None or tags is None or self._session.closed:
            return
        designs, count = found
        self._tag.set_options({"": "all tags"} | {t: f"{t} ({n})" for t, n in tags.items()})
        self._found.clear()
        with self._found:
            for design in designs:
                with ui.element("li").classes("design").props(f"data-design={design.number}"):
                    self._card(design)
        self._count.set_text(_counted(count, bool(words or tag)))
        self._more.set_visibility(count > len(designs))

    def _card(self, design: "Design") -> None:
        name = design.title or "Untitled"
        opened = ui.element("button").classes("design-open").props("type=button")
        opened.props["aria-label"] = f"Open {name}"
        opened.on("click", lambda: self._open_design(design.number))
        with opened:
            picture = ui.element("img").props('alt="" aria-hidden=true')
            picture.props["src"] = f"data:image/png;base64,{b64encode(design.thumbnail).decode()}"
        with ui.element("div").classes("design-words"):
            ui.label(name).classes("design-title").tooltip(name)
            ui.label(", ".join(design.tags)).classes("hint")
        with ui.element("div").classes("design-acts"):
            _act("edit", f"Rename or tag {name}", lambda: self._edit(design))
            _act("delete", f"Delete {name}", lambda: self._remove(design.number))

    async def _save_open(self) -> None:
        await self._keep(self._open)

    async def _save_as_new(self) -> None:
        await self._keep(0)

    async def _keep(self, number: int) -> None:
        session = self._session
        sketch = replace(session.sketch, title=str(self._title.value or "").strip())
        tags = _split(self._tags.value)
        look, drawn = session.settings, (banner_of(sketch), session.packs())

        def keep(library: "Library") -> int:
            from drapery.studio.library import Design

            design = Design(sketch, look, tags, thumbnail(*drawn), number)
            if number:
                library.change(design)
                return number
            return library.add(design)

        kept = await self._do(keep)
        if kept is None:
            return
        session.edit(sketch)
        self._set_open(kept)
        tell(f"Saved {sketch.title or 'without a title'}")
        await self._refresh()

    def _set_open(self, number: int) -> None:
        self._open = number
        self._save.set_text("Save changes" if number else "Save")
        self._save_new.set_visibility(bool(number))

    async def _open_design(self, number: int) -> None:
        design = await self._do(lambda library: library.get(number))
        if design is None:
            return
        session = self._session
        chosen = over(session.settings, design.look)
        session.adjust(**{name: getattr(chosen, name) for name in SHARED})
        desk_of(session).lay_out(design.sketch)
        self._title.set_value(design.title)
        self._tags.set_value(", ".join(design.tags))
        self._set_open(number)
        tell(f"Opened {design.title or 'a design without a title'}")

    def _edit(self, design: "Design") -> None:
        """A dialog for title and tags."""

        async def keep() -> None:
            sketch = replace(design.sketch, title=str(title.value or "").strip())
            changed = replace(design, sketch=sketch, tags=_split(tags.value))
            done = await self._do(lambda library: (library.change(changed), True)[1])
            if done:
                dialog.close()
                await self._refresh()

        with self._found, ui.dialog() as dialog, ui.card().classes("stack dialog"):
            title = _field("Title", maxlength=MAX_TITLE)
            tags = _field("Tags, with commas between")
            title.set_value(design.title)
            tags.set_value(", ".join(design.tags))
            with ui.element("div").classes("save-buttons"):
                _button("check", "Keep", keep)
                _button("close", "Cancel", dialog.close)
        dialog.on("hide", dialog.delete)
        dialog.open()

    async def _remove(self, number: int) -> None:
        gone = await self._do(lambda library: library.remove(number))
        if gone is None:
            return
        if number == self._open:
            self._set_open(0)
        self._undo_bar.clear()
        with self._undo_bar:
            ui.label(f"Deleted {gone.title or 'a design without a title'}")
            _button("undo", "Put it back", lambda: self._put_back(gone))
        self._undo_bar.set_visibility(True)
        await self._refresh()

    async def _put_back(self, gone: "Design") -> None:
        if await self._do(lambda library: library.add(gone)):
            self._undo_bar.set_visibility(False)
            await self._refresh()

    async def _import(self, number: int) -> None:
        upload = uploads_of(self._session).get(number)
        counts = await self._do(lambda library: library.load(upload.path.read_bytes()))
        uploads_of(self._session).remove(number)
        if counts is not None:
            fresh, known = counts
            tell(f"{fresh} designs added" + (f", {known} were here already" if known else ""))
            await self._refresh()

    async def _search_anew(self) -> None:
        self._most = PAGE
        await self._refresh()

    async def _show_more(self) -> None:
        self._most += PAGE
        await self._refresh()


LATER = 1.5
"""When the library is first read, after the page has been built [s]."""


def thumbnail(banner: Banner, packs: Packs) -> bytes:
    """The face at two pixels a texel, as a PNG file. Raises PackError."""
    from drapery.banner.packs.png import read_png
    from drapery.render.encode.png import png_bytes
    from drapery.studio.art import FACE_SCALE, face_png

    step = FACE_SCALE // 2
    face = read_png(face_png(banner, packs), "the face")
    return png_bytes(face[step // 2 :: step, step // 2 :: step].copy())


def _split(text: object) -> tuple[str, ...]:
    return tuple(part.strip() for part in str(text or "").split(",") if part.strip())


def _counted(count: int, searched: bool) -> str:
    if not count:
        return "Nothing found" if searched else "Nothing is kept here yet"
    return "1 design" if count == 1 else f"{count} designs"


def _field(label: str, **props: Any) -> ui.input:
    field = ui.input(label).props("dense outlined")
    field.props["aria-label"] = label
    field.props.update(props)
    return field


def _button(
    icon: str, words: str, call: Callable[[], Awaitable[None]] | Callable[[], None]
) -> ui.button:
    return ui.button(words, icon=icon, on_click=call).props("flat dense no-caps")


def _act(icon: str, words: str, call: Callable[[], Awaitable[None]] | Callable[[], None]) -> None:
    button = ui.button(icon=icon, on_click=call).props("flat dense size=sm")
    button.props["aria-label"] = words
    button.tooltip(words)
