"""What leaves the page: picture, animation and model files, the share link, code to copy."""

from collections.abc import Callable

from nicegui import ui

from drapery.errors import DraperyError
from drapery.studio.exports import Export, exports_of, stem_of
from drapery.studio.notices import faults, tell
from drapery.studio.pack_store import shelf_of
from drapery.studio.panels.fields import copy_field
from drapery.studio.panels.file_options import Choice, build_options, order_of
from drapery.studio.session import Session
from drapery.studio.share import write_link
from drapery.studio.snippets import as_command, as_python
from drapery.studio.viewport import stage_of
from drapery.studio.widgets import button, words

TICK = 0.15
"""How often progress is shown [s]."""
TIDY = 0.5
"""How often the page's address follows the design [s]."""


def build(session: Session) -> None:
    """Options, the button with its progress, then what can be copied."""
    choice = Choice()
    words("Make a file", "h2").classes("heading")
    fit = build_options(session, choice)
    _Maker(session, choice)
    words("Take it elsewhere", "h2").classes("heading")
    copy = _copies(session, choice)

    def show() -> None:
        fit()
        copy()

    show()
    choice.changed.append(show)
    session.listen("sketch", copy)
    session.listen("settings", show)
    session.listen("packs", copy)
    _keep_up(session, show)


class _Progress:
    """How far an export is, and a way to stop it."""

    def __init__(self, stop: Callable[[], None]) -> None:
        with ui.element("div").classes("going") as self._row:
            self._bar = ui.element("progress").props("max=1 aria-label=Progress")
            self._words = words("").classes("hint").props("role=status")
            button("Stop the export", stop, text="Cancel")
        self.hide()

    def hide(self) -> None:
        self._row.set_visibility(False)

    def show(self, work: Export) -> None:
        self._row.set_visibility(True)
        self._bar.props["value"] = work.done / work.total
        self._bar.update()
        still = "drawing" if work.total == 1 else "moving the cloth"
        self._words.set_text(f"{work.done} of {work.total} frames" if work.done else still)


class _Maker:
    """The button, the progress of what it has begun, and a link to the finished file."""

    def __init__(self, session: Session, choice: Choice) -> None:
        self._session, self._choice = session, choice
        self._own = exports_of(session)
        with ui.element("div").classes("line"):
            press = button("Export the file", self._start, icon="download", text="Export")
            press.classes("primary")
            self._link = words("", "a").classes("export-link").props("download")
        self._link.set_visibility(False)
        self._progress = _Progress(self._stop)
        self._timer = ui.timer(TICK, self._follow, active=False)

    def _start(self) -> None:
        with faults():
            order = order_of(self._session, self._choice)
            self._own.start(order, stem_of(self._session.sketch.title))
            self._link.set_visibility(False)
            self._timer.activate()
            self._follow()

    def _stop(self) -> None:
        if self._own.current is not None:
            self._own.current.stop()

    def _follow(self) -> None:
        work = self._own.current
        if work is not None and work.state == "running":
            self._progress.show(work)
            return
        self._progress.hide()
        self._timer.deactivate()
        if work is not None:
            self._finish(work)

    def _finish(self, work: Export) -> None:
        if work.state == "failed":
            tell(shelf_of(self._session).in_plain_words(work.fault), "fault")
        elif work.state == "stopped":
            tell("Stopped; nothing was kept")
        else:
            address = f"/export/{self._session.token}/{self._own.number}"
            self._link.props["href"] = address
            self._link.set_text(f"{work.name}, {shown_size(work.path.stat().st_size)}")
            self._link.set_visibility(True)
            ui.download.from_url(address)


def shown_size(count: int) -> str:
    """`12.3 kB`, as file managers say it."""
    if count < 1000:
        return f"{count} bytes"
    return f"{count / 1000:.1f} kB" if count < 1_000_000 else f"{count / 1_000_000:.1f} MB"


def _copies(session: Session, choice: Choice) -> Callable[[], None]:
    """The link, the command and the lines of Python; the callable writes them anew."""
    request = ui.context.client.request
    base = str(request.base_url) if request is not None else "/"
    link = copy_field("share-link", "Link to this design (packs stay here)", 2)
    command = copy_field("as-command", "Command that makes this file", 3)
    python = copy_field("as-python", "Python that makes this file", 5)

    def show() -> None:
        called, stem = shelf_of(session).called, stem_of(session.sketch.title)
        try:
            order = order_of(session, choice)
        except DraperyError as error:
            tell(str(error), "fault")
            return
        link(f"{base}?d={write_link(session.sketch, session.settings)}")
        command(as_command(order, called, stem))
        python(as_python(order, called, stem))

    return show


def _keep_up(session: Session, show: Callable[[], None]) -> None:
    """Let the page's address follow the design, so that loading it again brings all back.

    What is wished of the live banner is looked at as often, since nobody tells of it.
    """
    written = write_link(session.sketch, session.settings)
    wishes = stage_of(session).wishes

    def tidy() -> None:
        nonlocal written, wishes
        if stage_of(session).wishes != wishes:
            wishes = stage_of(session).wishes
            show()
        word = write_link(session.sketch, session.settings)
        if word != written:
            written = word
            ui.run_javascript(f"history.replaceState(history.state, '', '?d={word}')")

    ui.timer(TIDY, tidy)
