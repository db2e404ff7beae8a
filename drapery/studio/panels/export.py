"""Output: picture, animation and model files, the share link, code to copy."""

from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace

from nicegui import context, ui

from drapery import DraperyError
from drapery.errors import counted
from drapery.studio.exports import Export, stem_of
from drapery.studio.notices import show_notice
from drapery.studio.panels.fields import copy_field
from drapery.studio.panels.file_options import FileChoice, build_options, request_of
from drapery.studio.session import Session
from drapery.studio.share import write_link
from drapery.studio.snippets import as_command, as_python, file_name
from drapery.studio.translation import translated
from drapery.studio.widgets import button, set_props, text_element, translated_text

TICK = 0.15
"""How often progress is shown [s]."""
ANSWER = 10.0
"""How long the page may take to show the progress, before more of it is sent [s]."""


def build(session: Session) -> None:
    """Options, the button with its progress, then what can be copied."""
    choice = FileChoice()
    translated_text("Make a file", "h2").classes("heading")
    fit = build_options(session, choice)
    ExportForm(session, choice)
    translated_text("Link and code", "h2").classes("heading")
    copy = _copies(session, choice)

    def show() -> None:
        fit()
        copy()

    choice.changed.append(show)
    session.listen(copy, "sketch", "packs")
    session.follow(show, "settings", "scene")


class ExportForm:
    """The button, the progress of its export, and a link to the finished file."""

    def __init__(self, session: Session, choice: FileChoice) -> None:
        self._session, self._choice = session, choice
        self._own = session.exports
        with ui.element("div").classes("line"):
            press = button("Export the file", self._start, icon="download", text="Export")
            press.classes("main")
            self._link = text_element("", "a").classes("export-link").props("download")
        self._link.set_visibility(False)
        self._warnings = ui.element("div").props("role=status")
        with ui.element("div").classes("going") as self._going:
            self.bar = ui.element("progress").props("max=1")
            self.bar.props["aria-label"] = translated("Progress")
            self._words = text_element("").classes("hint").props("role=status")
            button("Stop the export", self._stop, text="Cancel")
        self._going.set_visibility(False)
        self._client = context.client
        self._timer = ui.timer(TICK, self.tick, active=False)
        session.listen(self._hide_stale, "sketch", "settings", "packs", "scene")
        choice.changed.append(self._hide_stale)

    def _start(self) -> None:
        request = request_of(self._session, self._choice)
        self._own.start(request, stem_of(self._session.sketch.title))
        self._hide()
        self._timer.activate()
        self._follow()

    def _hide(self) -> None:
        self._link.set_visibility(False)
        self._warnings.clear()

    def _hide_stale(self) -> None:
        """Hide the link to a file that shows an earlier state."""
        work = self._own.current
        if work is None or not self._is_current(work):
            self._hide()

    def _is_current(self, work: Export) -> bool:
        """Whether the same file would be made now. A pause alone makes no file stale."""
        try:
            request = request_of(self._session, self._choice)
        except DraperyError:  # the button that makes the file says why
            return False
        if request.settings.time == self._session.viewport.paused_at:
            settings = request.settings.changed(time=work.request.settings.time)
            request = replace(request, settings=settings)
        name = file_name(request, stem_of(self._session.sketch.title))
        return (request, name) == (work.request, work.name)

    def _stop(self) -> None:
        if self._own.current is not None:
            self._own.current.stop()

    async def tick(self) -> None:
        """Follow, and wait until the page has shown it.

        Each change makes a page draw itself anew. On a loaded machine that takes longer than a
        tick, and all that the page does would wait behind changes that it has not shown yet.
        """
        self._follow()
        with suppress(TimeoutError):  # a page that is away, or too busy for that
            await self._client.run_javascript("return true", timeout=ANSWER)

    def _follow(self) -> None:
        work = self._own.current
        runs = work is not None and work.state == "running"
        self._going.set_visibility(runs)
        if work is not None and runs:
            self.show_progress(work)
            return
        self._timer.deactivate()
        if work is not None:
            self._finish(work)

    def show_progress(self, work: Export) -> None:
        """Show how much of an export is done."""
        set_props(self.bar, {"value": work.share})
        still = translated("drawing" if work.total == 1 else "moving the cloth")
        frames = translated("{done} of {total} frames").format(done=work.done, total=work.total)
        self._words.set_text(frames if work.done else still)

    def _finish(self, work: Export) -> None:
        if work.state == "failed":
            show_notice(self._session.pack_store.with_names(work.fault), "fault")
        elif work.state == "stopped":
            show_notice(translated("Stopped; no file was made"))
        else:
            address = f"export/{self._session.token}/{self._own.number}"
            self._link.props["href"] = address
            self._link.set_text(f"{work.name}, {shown_size(work.path.stat().st_size)}")
            self._link.set_visibility(True)
            with self._warnings:
                for line in work.warnings:
                    named = self._session.pack_store.with_names(line)
                    text_element(named, "p").classes("warning")
            ui.download.from_url(address)


def shown_size(count: int) -> str:
    """A size as file managers show it, for example `12.3 kB`."""
    if count < 1000:
        return counted(count, "byte")
    return f"{count / 1000:.1f} kB" if count < 1_000_000 else f"{count / 1_000_000:.1f} MB"


def _copies(session: Session, choice: FileChoice) -> Callable[[], None]:
    """The link, the command and the lines of Python; returns a callable that updates them."""
    request = ui.context.client.request
    base = str(request.base_url) if request is not None else "/"
    link = copy_field("share-link", "Link to this design (packs stay here)", 2)
    command = copy_field("as-command", "Command that makes this file", 3)
    python = copy_field("as-python", "Python that makes this file", 5)

    def show() -> None:
        names = session.pack_store.names | session.garment_store.names
        stem = stem_of(session.sketch.title)
        try:
            request = request_of(session, choice)
        except DraperyError as error:
            show_notice(str(error), "fault")
            return
        link(f"{base}?d={write_link(session.sketch, session.settings)}")
        command(as_command(request, names, stem))
        python(as_python(request, names, stem))

    return show
