"""The page: the place of each panel. A new panel needs a file in `panels/` and a line in PANELS."""

import asyncio
from collections.abc import Callable, Coroutine
from dataclasses import dataclass
from html import escape
from importlib import import_module
from pathlib import Path
from typing import Any, Literal, get_args

from fastapi import Request
from nicegui import Client, ui
from nicegui.element import Element

from drapery import DraperyError, Settings
from drapery.banner import parse_banner
from drapery.studio.art import face_files
from drapery.studio.components import add_first_view, editor_part, viewer_address
from drapery.studio.line_icons import line_icon
from drapery.studio.notices import show_notice
from drapery.studio.panels import bar, shortcuts
from drapery.studio.played import known_kernels
from drapery.studio.session import MAX_RECENT, Session, Sessions
from drapery.studio.share import opened_link, write_link
from drapery.studio.sketch import Sketch, sketch_of
from drapery.studio.translation import language, translated
from drapery.studio.warning_log import collected_warnings
from drapery.studio.widgets import on, set_props, translated_text
from drapery.web.bundle import WEB, bundled_module

Place = Literal["left", "viewport", "under", "side"]
Group = Literal["Design", "Bring in", "Get out", "Library"]


@dataclass(frozen=True)
class PagePanel:
    """One part of the page.

    name: of its module in `panels/`, of its tab's icon, and part of the ids of its elements. part:
    of the editor, instead of a module. title: the text of its heading and tab. place: panels
    `left` of and `under` the viewport are always visible in a wide window; panels at the `side`
    share one place, with tabs. On a phone every panel except the viewport and the palette is a
    tab. group: of the tab; a panel without one has no tab.
    """

    name: str
    title: str
    place: Place
    group: Group | None = None
    part: str = ""


PANELS = (
    PagePanel("palette", "Dyes", "left", part="dyes"),
    PagePanel("layers", "Layers", "left", "Design", "layers"),
    PagePanel("live", "Live", "viewport"),
    PagePanel("face", "Flat", "viewport"),
    PagePanel("steps", "History", "under", "Design", "steps"),
    PagePanel("motion", "Motion", "under", "Design"),
    PagePanel("patterns", "Patterns", "side", "Design"),
    PagePanel("styles", "Styles", "side", "Design"),
    PagePanel("letters", "Letters", "side", "Design"),
    PagePanel("text", "Text", "side", "Bring in"),
    PagePanel("picture", "Picture", "side", "Bring in"),
    PagePanel("packs", "Packs", "side", "Bring in"),
    PagePanel("export", "Export", "side", "Get out"),
    PagePanel("embed", "Embed", "side", "Get out"),
    PagePanel("loom", "Loom", "side", "Get out", "loom"),
    PagePanel("library", "Library", "side", "Library"),
    PagePanel("start", "Start", "side", "Library"),
    PagePanel("compare", "Compare", "side", "Library", "compare"),
)

FIRST_TAB = "patterns"

_DETAIL = "(event) => emit(event.detail)"
_PARTS = ":is(.studio, .studio-dialog)"
"""What has the fields and buttons of the editor."""
_FOLDER = Path(__file__).parent


def add_page(sessions: Sessions) -> None:
    """Serve the page at `/`; each tab gets a session, which ends with the tab."""

    @ui.page("/")
    def studio(client: Client) -> None:
        settings, sketch, fault = opened(sessions.config.settings, client.request)
        session = sessions.open(settings, sketch)
        client.on_delete(lambda: sessions.keep(session))
        client.on_connect(send_current_states)
        build(session, sessions)
        if fault:
            ui.timer(0.5, lambda: show_notice(fault, "fault"), once=True)


def send_current_states(client: Client) -> Coroutine[Any, Any, None]:
    """Send again the elements of which a page has missed something, after all that it has missed.

    After a reconnection NiceGUI sends new states first and then the missed ones, which would stay.
    """
    outbox = client.outbox
    updates = [data for _, kind, data in outbox.messages if kind == "update"]
    missed = {identity for data in updates for identity in data}

    async def send() -> None:
        while outbox.messages and not client.is_deleted:
            await asyncio.sleep(0.02)
        for identity in missed & client.elements.keys():
            client.elements[identity].update()

    return send()


def opened(base: Settings, request: Request | None) -> tuple[Settings, Sketch | None, str]:
    """The page's initial state, and the error or warning about its address.

    `d` holds a link as `write_link` writes it; `design` holds a design in any form of text.
    """
    query = request.query_params if request is not None else {}
    link, text = query.get("d"), query.get("design")
    if not link and not text:
        return base, None, ""
    with collected_warnings() as notes:
        try:
            if text and not link:
                return base, sketch_of(parse_banner(text)), " ".join(notes)
            settings, sketch = opened_link(base, link or "")
        except DraperyError as error:
            return base, None, str(error)
    return settings, sketch, " ".join(notes)


def build(session: Session, sessions: Sessions) -> None:
    """Draw the whole page for a session. sessions: of the pages that it may go on from."""
    _head(session)
    add_first_view(session)
    with ui.element("div").classes("studio").props(f'data-token="{session.token}"') as root:
        session.language = root.props["data-language"] = language()
        root.props["data-copied"] = translated("Copied")
        root.props["data-lost"] = translated("The connection is lost. Trying again …")
        root.props["data-recent"] = MAX_RECENT
        root.props["data-drop"] = translated("Drop it to read its banners")
        with ui.element("header").classes("bar"):
            bar.build(session)
        for place in ("left", "viewport", "under"):
            with ui.element("div").classes(place):
                _panels(session, place)
        _tabs()
        with ui.element("div").classes("side"):
            hidden = _panels(session, "side")
    shortcuts.build()
    _write_into_address(session)
    handlers: dict[str, Callable[[Any], object]] = {
        "resume": lambda token: _resume(session, sessions, token),
        "recent": session.set_recent,
        "pasted": lambda text: session.upload_queue.read_text(str(text)),
    }
    for name, handle in handlers.items():
        on(root, name, handle, js_handler=_DETAIL)

    async def build_hidden() -> None:
        for panel, section in hidden.items():
            if not session.closed:
                with section:
                    _fill(session, panel)
                await asyncio.sleep(0)  # other pages get their answers meanwhile
        set_props(root, {"data-whole": True})

    # Half of the page's elements are in tabs that nobody sees yet: they come after the page.
    ui.timer(0, build_hidden, once=True)


def _resume(session: Session, sessions: Sessions, token: object) -> None:
    """Go on from the work of the page that was loaded before at this place of the history."""
    work = sessions.work(str(token))
    if work is not None:
        session.resume(work)


def _write_into_address(session: Session) -> None:
    """Write the design into the page's address, so that it survives a reload or a step back."""
    client = ui.context.client

    def write() -> None:
        # It has only base64url characters; none of them can end the quoted text.
        link = write_link(session.sketch, session.settings)
        sketch = session.sketch
        plain = Sketch(kind=sketch.kind, origin=sketch.origin)
        name = "" if sketch == plain else str(sketch.origin or session.token)
        client.run_javascript(f'studio.writeAddress("{link}", "{name}")')

    session.listen(write, "sketch", "settings")


def _head(session: Session) -> None:
    # Inline: each is small, and a page that arrives complete does not shift while it loads.
    editor = (WEB / "designer" / "editor.css").read_text()
    ui.add_head_html(f"<style>@layer components {{ {_PARTS} {{ {editor} }} }}</style>")
    for sheet in sorted(_FOLDER.glob("*.css")):
        ui.add_head_html(f"<style>{sheet.read_text()}</style>")
    ui.add_head_html(f'<script type="module">{bundled_module(_FOLDER / "studio.js", ())}</script>')
    # What plays the cloth comes beside the page's framework, not after it.
    ui.add_head_html(f'<link rel="modulepreload" href="{viewer_address()}">')
    scenes = session.viewport.shown["scenes"]
    kernels = {known_kernels(Path(address).stem) for address in scenes} - {None}
    for address in (*scenes, *kernels, face_files(session)["banner"]):
        ui.add_head_html(f'<link rel="preload" as="fetch" crossorigin href="{escape(address)}">')


def _panels(session: Session, place: str) -> dict[PagePanel, ui.element]:
    """Build the panels of a place; returns modules' that are in tabs behind, still empty."""
    hidden = {}
    for panel in PANELS:
        if panel.place == place:
            section = ui.element("section").classes(f"panel panel-{panel.name}")
            section.props(f'id="panel-{panel.name}"')
            section.props["aria-label"] = translated(panel.title)
            if panel.place == "side" and panel.name != FIRST_TAB and not panel.part:
                hidden[panel] = section
                continue
            if panel.name == FIRST_TAB:
                section.props("data-active")
            with section:
                _fill(session, panel)
    return hidden


def _fill(session: Session, panel: PagePanel) -> None:
    if panel.part:
        editor_part(panel.part)
    else:
        import_module(f"{__package__}.panels.{panel.name}").build(session)


def _tabs() -> None:
    """The groups, and the tabs of each; `studio.js` shows those of one group."""
    titles = get_args(Group)
    with ui.element("div").classes("tabs"):
        with _tab_list("groups", "Panels"):
            for number, title in enumerate(titles):
                _tab(f"group-{number}", f"tabs-{number}", title, not number).classes("group")
        for number, title in enumerate(titles):
            with _tab_list("tabs-of", title) as tabs:
                tabs.props.update({"id": f"tabs-{number}", "hidden": number > 0})
                for panel in (panel for panel in PANELS if panel.group == title):
                    _tab_of(panel)


def _tab_list(name: str, label: str) -> Element:
    tabs = ui.element("div").classes(name).props("role=tablist")
    tabs.props["aria-label"] = translated(label)
    return tabs


def _tab_of(panel: PagePanel) -> None:
    is_first = panel.name == FIRST_TAB
    tab = _tab(f"tab-{panel.name}", f"panel-{panel.name}", panel.title, is_first, panel.name)
    tab.classes(f"tab tab-{panel.place}").props["data-panel"] = panel.name


def _tab(identity: str, controls: str, title: str, chosen: bool, icon: str = "") -> Element:
    tab = ui.element("button").props("type=button role=tab")
    tab.props.update({"id": identity, "aria-controls": controls, "tabindex": chosen - 1})
    tab.props["aria-selected"] = str(chosen).lower()
    with tab:
        if icon:
            line_icon(icon)
        translated_text(title).classes("tab-title")
    return tab
