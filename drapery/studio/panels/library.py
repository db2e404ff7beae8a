"""The library: save, find, open and delete designs."""

from base64 import b64encode
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, TypeVar

from nicegui import background_tasks, ui
from nicegui.element import Element

from drapery.studio.art import THUMBNAIL_SCALE, face_png
from drapery.studio.file_field import FileField
from drapery.studio.notices import ADDED, called_in_thread, errors_shown, show_notice
from drapery.studio.panels.fields import Fields
from drapery.studio.session import Session
from drapery.studio.sketch import MAX_TITLE, banner_of
from drapery.studio.translation import translated
from drapery.studio.widgets import KeptElements, button, text_element, translated_text

if TYPE_CHECKING:
    from drapery.studio.library import Library
    from drapery.studio.records import Design

T = TypeVar("T")

PAGE = 24
"""The number of designs shown at first, and the number that each click on More adds."""
LATER = 1.2
"""The delay between building the page and first reading the library [s]."""
PAUSE = 0.25
"""The shortest time between two searches while the user types [s]."""


def build(session: Session) -> None:
    """The form that saves the design, the search with its results, export and import."""
    LibraryPanel(session)


class LibraryPanel:
    """The panel of one tab."""

    def __init__(self, session: Session) -> None:
        self._session = session
        self._client = ui.context.client
        self._words = self._tag = ""
        self._limit = PAGE
        # Searches started so far.
        self._asked = 0
        self._fields = Fields(session)
        self._form()
        self._search()
        self._undo = ui.element("div").classes("line undo").props("role=status")
        self._undo.set_visibility(False)
        self._found = ui.element("ul").classes("designs")
        self._found.props["aria-label"] = translated("Designs")
        self._cards: KeptElements[Element] = KeptElements(self._found)
        self._count = text_element("", "p").classes("hint").props("role=status")
        self._more = button("More designs", self._show_more, text="More")
        self._more.set_visibility(False)
        self._whole_library()
        session.follow(self._follow, "sketch")
        session.listen(lambda: background_tasks.create(self.refresh()), "library")
        # Load the database after the first picture, which does not need it.
        ui.timer(LATER, self.refresh, once=True)

    def _form(self) -> None:
        session = self._session

        def tag(tags: str) -> None:
            session.tags[session.sketch.origin] = tags

        translated_text("Save this design", "h2").classes("heading")
        with ui.element("div").classes("options"):
            title = "Title", lambda: session.sketch.title, session.name
            self._fields.line(*title, maxlength=MAX_TITLE)
            tags = lambda: session.tags.get(session.sketch.origin, "")  # noqa: E731
            self._fields.line("Tags, with commas between", tags, tag)
        with ui.element("div").classes("line"):
            self._save = button("Save", self._save_new, icon="save", text="Save")
            self._over = button("Save changes", self._save_over, icon="save", text="Save changes")
            self._new = button("Save as a new design", self._save_new, text="Save as new")
        for each in (self._save, self._over):
            each.classes("main")

    @property
    def _open(self) -> int:
        """The number of the current design in the library; 0 if it is not saved yet."""
        return self._session.entries.get(self._session.sketch.origin, 0)

    def _search(self) -> None:
        translated_text("Find", "h2").classes("heading")
        with ui.element("div").classes("library-search"):
            field = ui.element("input").classes("field").props("type=search maxlength=200")
            label = translated("Title, tag, dye or pattern")
            field.props.update({"placeholder": label, "aria-label": label})
            field.on(
                "input",
                lambda event: self._search_for(words=str(event.args)),
                js_handler="(e) => emit(e.target.value)",
                throttle=PAUSE,
                leading_events=False,
            )
            self._tags = self._fields.choice(
                "Tag",
                {"": "all tags"},
                lambda: self._tag,
                lambda tag: self._search_for(tag=str(tag)),
            )

    def _search_for(self, *, words: str | None = None, tag: str | None = None) -> None:
        # At once: a field shows the old value again if this is not the new one yet.
        self._words = self._words if words is None else words
        self._tag = self._tag if tag is None else tag
        self._limit = PAGE
        background_tasks.create(self.refresh())

    def _whole_library(self) -> None:
        translated_text("The whole library", "h2").classes("heading")
        with ui.element("div").classes("line"):
            export = translated_text("Export it as a file", "a").classes("export-link")
            export.props("download").props["href"] = f"library/{self._session.token}"
        label = "Drop an exported library here, or choose it (.json)"
        endings = ".json,application/json"
        FileField(self._session, "library", label, self._import, endings=endings)

    def _follow(self) -> None:
        self._fields.refresh()
        self._save.set_visibility(not self._open)
        for each in (self._over, self._new):
            each.set_visibility(bool(self._open))

    async def _do(self, act: "Callable[[Library], T]") -> T | None:
        """Call the library in a thread; after an error, notify the user and return None."""
        return await called_in_thread(self._client, lambda: act(self._session.library()))

    async def refresh(self) -> None:
        self._asked += 1
        number = self._asked
        wanted, tag, limit = self._words, self._tag or None, self._limit

        def ask(library: "Library") -> "tuple[list[Design], int, dict[str, int]]":
            return *library.search(wanted, tag, limit=limit), library.tags()

        answer = await self._do(ask)
        # Drop this answer if a newer search has started since: that one shows its own result, and
        # this one may have read the library before the latest change.
        if answer is None or number != self._asked or self._session.closed:
            return
        designs, count, tags = answer
        if tag is not None and tag not in tags:
            # No design has this tag any more.
            self._search_for(tag="")
            return
        with self._client:  # says the language
            names = {name: f"{name} ({count})" for name, count in tags.items()}
            self._tags.set_choices({"": translated("all tags")} | names)
            self._show(designs)
            self._count.set_text(_counted(count, bool(wanted or tag)))
        self._more.set_visibility(count > len(designs))

    def _show(self, designs: "list[Design]") -> None:
        self._cards.show(
            {(each.number, each.changed): partial(self._card, each) for each in designs}
        )

    def _card(self, design: "Design") -> Element:
        name = design.title or translated("Untitled")
        words = translated("Open {name}").format(name=name)
        rename = translated("Rename or tag {name}").format(name=name)
        delete = translated("Delete {name}").format(name=name)
        with ui.element("li").classes("design").props(f"data-design={design.number}") as card:
            opened = ui.element("button").classes("design-open").props("type=button")
            opened.props.update({"aria-label": words, "title": words})
            with opened.on("click", lambda: self._open_design(design.number)):
                picture = ui.element("img").props('alt=""')
                data = b64encode(design.thumbnail).decode()
                picture.props["src"] = f"data:image/png;base64,{data}"
            text_element(name).classes("design-title").props.update({"title": name})
            text_element(", ".join(design.tags)).classes("hint design-tags")
            with ui.element("div").classes("design-acts"):
                button(rename, lambda: self._edit(design), icon="edit").classes("quiet")
                button(delete, lambda: self._remove(design.number), icon="delete").classes("quiet")
        return card

    async def _save_over(self) -> None:
        await self._store(self._open)

    async def _save_new(self) -> None:
        await self._store(0)

    async def _store(self, number: int) -> None:
        session, sketch = self._session, self._session.sketch
        settings, tags = session.settings, _split(session.tags.get(sketch.origin, ""))

        def store(library: "Library") -> "tuple[int, Design | None]":
            from drapery.studio.records import Design

            picture = face_png(banner_of(sketch), session.packs(), THUMBNAIL_SCALE)
            design = Design(sketch, settings, tags, picture, number)
            if not number:
                return library.add(design), None
            before = library.get(number)
            library.change(design)
            return number, before

        stored = await self._do(store)
        if stored is None:
            return
        session.entries[sketch.origin], before = stored
        self._follow()
        with self._client:
            show_notice(_said("Saved {title}", sketch.title))
            if before is not None:
                line = _said("Changed {title}", before.title)
                self._offer(line, "Keep the old one too", before)
        await self.refresh()

    async def _open_design(self, number: int) -> None:
        design = await self._do(lambda library: library.get(number))
        if design is None:
            return
        session = self._session
        with self._client, errors_shown():
            session.open(design.sketch, design.settings)
            session.entries[session.sketch.origin] = number
            session.tags[session.sketch.origin] = ", ".join(design.tags)
            self._follow()
            show_notice(_said("Opened {title}", design.title))

    def _edit(self, design: "Design") -> None:
        """A dialog for title and tags."""
        wanted = {"title": design.title, "tags": ", ".join(design.tags)}

        def change(library: "Library") -> bool:
            sketch = replace(design.sketch, title=wanted["title"].strip())
            library.change(replace(design, sketch=sketch, tags=_split(wanted["tags"])))
            return True

        async def save() -> None:
            if await self._do(change):
                dialog.close()
                await self.refresh()

        def line(label: str, name: str, maximum: int) -> None:
            get, change = partial(wanted.get, name), partial(wanted.__setitem__, name)
            fields.line(label, get, change, maxlength=maximum)

        with ui.dialog() as dialog, ui.element("div").classes("studio-dialog"):
            translated_text("Rename or tag", "h2").classes("heading")
            fields = Fields(self._session)
            line("Title", "title", MAX_TITLE)
            line("Tags, with commas between", "tags", 500)
            with ui.element("div").classes("line"):
                button("Save title and tags", save, text="Save").classes("main")
                button("Change nothing", dialog.close, text="Cancel")
        dialog.on("hide", dialog.delete)
        dialog.open()

    async def _remove(self, number: int) -> None:
        gone = await self._do(lambda library: library.remove(number))
        if gone is None:
            return
        entries = self._session.entries
        self._session.entries = {at: entry for at, entry in entries.items() if entry != number}
        self._follow()
        with self._client:
            self._offer(_said("Deleted {title}", gone.title), "Put it back", gone)
        await self.refresh()
        # The pressed button no longer exists, so move the keyboard's focus to the undo button.
        self._client.run_javascript("document.querySelector('.undo button')?.focus()")

    def _offer(self, line: str, offer: str, design: "Design") -> None:
        """Show what was done, with a button that restores the earlier design."""
        self._undo.clear()
        with self._undo:
            text_element(line)
            button(offer, lambda: self._put_back(design), text=offer)
        self._undo.set_visibility(True)

    async def _put_back(self, gone: "Design") -> None:
        if await self._do(lambda library: library.add(gone)):
            self._undo.set_visibility(False)
            await self.refresh()

    async def _import(self, number: int) -> None:
        upload = self._session.uploads.get(number, "library")
        counts = await self._do(lambda library: library.load(upload.path.read_bytes()))
        self._session.uploads.remove(number)
        if counts is not None:
            with self._client:
                show_notice(ADDED.format(*counts))
            await self.refresh()

    async def _show_more(self) -> None:
        self._limit += PAGE
        await self.refresh()


def _split(text: str) -> tuple[str, ...]:
    return tuple(part.strip() for part in text.split(",") if part.strip())


def _said(text: str, title: str) -> str:
    """A text about the design of a title."""
    return translated(text).format(title=title or translated("a design without a title"))


def _counted(count: int, searched: bool) -> str:
    if not count:
        return translated("Nothing found" if searched else "No design is saved yet")
    return translated("Designs: {count}").format(count=count)
