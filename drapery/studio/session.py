"""The session of one browser tab (its document and all that serves it), and all open sessions."""

import secrets
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from drapery import DesignError, DraperyError, Settings
from drapery.garments import garment_names, skin_names
from drapery.scenes import scene_names
from drapery.studio.document import Document, Event
from drapery.studio.exports import Exports, ExportSlots
from drapery.studio.garment_store import GarmentStore
from drapery.studio.kept_work import KeptWork, Work
from drapery.studio.pack_store import PackStore
from drapery.studio.share import (
    MOVED,
    SHARED,
    as_json,
    motion_of,
    read_link,
    settings_of,
    with_shared,
)
from drapery.studio.sketch import MAX_ORIGIN, Sketch
from drapery.studio.upload_queue import UploadQueue
from drapery.studio.uploads import Uploads
from drapery.studio.viewport import Viewport

if TYPE_CHECKING:
    from drapery.studio.library import Library

MAX_SESSIONS = 64
"""The most open tabs; more than a person needs."""
MAX_RECENT = 12
"""The most designs that a browser remembers."""


@dataclass(frozen=True)
class StudioConfig:
    """The options with which the studio was started.

    settings: the initial settings of every tab. library: the file of saved designs; None means the
    user's library.
    """

    settings: Settings = field(default_factory=Settings)
    library: Path | None = None


class Session(Document):
    """The document of one tab with everything that works on it.

    library: the file of saved designs; None means the user's. slots: shared with the other tabs of
    the studio; if not given, the session makes them.
    entries: the number of each design's entry in the library, by the origin of its sketch.
    tags: the tags that the user gave a design, by the same. recent: the latest designs of the
    user's browser with their options, newest first. language: of its page.
    """

    def __init__(
        self,
        settings: Settings | None = None,
        sketch: Sketch | None = None,
        *,
        library: Path | None = None,
        slots: ExportSlots | None = None,
    ) -> None:
        super().__init__(settings, sketch)
        self._library = library
        self.entries: dict[int, int] = {}
        self.tags: dict[int, str] = {}
        self.language = "en"
        self.recent: tuple[tuple[Sketch, Settings], ...] = ()
        # Before all others who hear of a design: a shield is not on a wall.
        self.listen(self._take_off_wall, "sketch")
        self.uploads = Uploads(self)
        self.upload_queue = UploadQueue(self, self.uploads)
        self.pack_store = PackStore(self, self.uploads)
        self.garment_store = GarmentStore(self, self.uploads)
        self.exports = Exports(self, slots or ExportSlots())
        self.viewport = Viewport(self, self.pack_store)

    def library(self) -> "Library":
        """The saved designs, opened at first use: a database is slow to import. Raises OutputError.

        Tabs and threads share its file.
        """
        from drapery.studio.library import default_place, opened

        return opened(self._library or default_place())

    @property
    def work(self) -> Work:
        """What another page needs to go on from here."""
        packs = self.pack_store.entries
        own = {**self.garment_store.names}, {**self.entries}, {**self.tags}
        return Work(packs, *own)

    def set_recent(self, links: object) -> None:
        """Take the links of the latest designs from the browser; notifies "recent"."""
        found = []
        for link in links[:MAX_RECENT] if isinstance(links, list) else ():
            with suppress(DesignError):  # it may be of another version
                found.append(read_link(str(link)))
        self.recent = tuple(found)
        self.notify("recent")

    def open(self, sketch: Sketch, settings: Settings) -> None:
        """Begin with another design and its options; this can be undone. Raises OptionError."""
        chosen = with_shared(self.settings, settings)
        self.adjust(**{name: chosen.as_given(name) for name in SHARED})
        self.lay_out(sketch)

    @property
    def motion(self) -> dict[str, Any]:
        """What the page's editor keeps beside each design, so that it can be undone, as JSON.

        `motion_of` the settings; `shown`: what is seen in place of the banner, by its kind, and
        `banner`: the options that the banner has again afterwards.
        """
        request, banner = self.viewport.request, self.viewport.banner_options
        shown = {**request.shown, "banner": as_json(banner)} if request.shown else {}
        return motion_of(self.settings) | ({"shown": shown} if shown else {})

    def move(self, words: object) -> None:
        """Take a step of the page's history, as `motion` has it.

        Raises DesignError for anything else, and for a file that is not here any more; then nothing
        changes.
        """
        if not isinstance(words, dict) or not isinstance(words.get("shown", {}), dict):
            raise DesignError("the page has sent no design; reload it")
        shown = {**words.get("shown", {})}
        options = {name: value for name, value in words.items() if name != "shown"}
        chosen = with_shared(self.settings, settings_of(options))
        banner = shown.pop("banner", {})
        before = settings_of(banner)
        known: dict[str, Callable[[], Iterable[str]]]
        known = {"scene": scene_names, "garment": garment_names, "skin": skin_names}
        for kind, name in shown.items():
            if kind in known and name in known[kind]():
                continue
            shown[kind] = self.garment_store.find(name)
            if kind not in known or shown[kind] is None:
                raise DesignError("the file is not here any more; send it again")
        self.adjust(**{name: chosen.as_given(name) for name in MOVED})
        self.viewport.banner_options = {name: before.as_given(name) for name in banner}
        self.viewport.update(**{kind: shown.get(kind) for kind in known})

    def lay_out(self, sketch: Sketch) -> None:
        """Begin with another design; this can be undone."""
        self.edit(replace(sketch, origin=secrets.randbelow(MAX_ORIGIN)))

    def _take_off_wall(self) -> None:
        if self.sketch.kind == "shield" and self.settings.placement == "wall":
            self.adjust(placement="standing", facing=None)

    def resume(self, work: Work) -> None:
        """Go on from a tab's work. Raises DraperyError for packs that cannot be opened any more."""
        self.entries |= work.entries
        self.tags |= work.tags
        if work.garments:
            self.garment_store.restore(work.garments)
            self.notify("files")
        try:
            self.pack_store.restore(work.packs)
        finally:
            self.notify("sketch")


class Sessions:
    """The open tabs of one studio, by their tokens. len() counts them."""

    def __init__(self, config: StudioConfig | None = None) -> None:
        self.config = config or StudioConfig()
        self._slots = ExportSlots()
        self._open: dict[str, Session] = {}
        self._kept = KeptWork()

    def __len__(self) -> int:
        return len(self._open)

    def __iter__(self) -> Iterator[Session]:
        return iter([*self._open.values()])

    def open(self, settings: Settings | None = None, sketch: Sketch | None = None) -> Session:
        """Open a session, which `find` returns until it closes.

        If too many are open, the oldest one ends.
        settings: replaces the settings of the configuration.
        """
        while len(self._open) >= MAX_SESSIONS:
            next(iter(self._open.values())).close()
        session = Session(
            settings or self.config.settings, sketch, library=self.config.library, slots=self._slots
        )
        self._open[session.token] = session
        session.on_close(lambda: self._open.pop(session.token, None))
        return session

    def find(self, token: str) -> Session | None:
        """The open session with this token, or None."""
        return self._open.get(token)

    def make_first_scene(self) -> None:
        """Make the scene that each new tab shows, so that the first one does not wait for it."""
        session = Session(self.config.settings)
        with suppress(DraperyError):  # the page says why
            for address in session.viewport.shown["scenes"]:
                session.viewport.scene(Path(address).stem)
        session.close()

    def notify(self, event: Event) -> None:
        """Call the listeners of an event in all sessions."""
        for session in self:
            session.notify(event)

    def keep(self, session: Session) -> None:
        """End the session of a page that is gone; keep its work if it has any."""
        has_packs = any(entry.upload for entry in session.pack_store.entries)
        has_work = has_packs or session.garment_store.names or session.entries or session.tags
        keeps = not session.closed and has_work
        work, folder = session.work, session.take_folder() if keeps else None
        session.close()  # first, since it removes what exports have written
        if keeps:
            self._kept.add(session.token, work, folder)

    def prune(self) -> None:
        """Drop work that was kept for long enough."""
        self._kept.prune()

    def work(self, token: str) -> Work | None:
        """The work of another page: one that is gone, or one that is still open."""
        session = self._open.get(token)
        if session is not None:
            return session.work
        return self._kept.find(token)

    def close_all(self) -> None:
        """End all sessions, for example when the server stops."""
        self._kept.clear()
        for session in self:
            session.close()
