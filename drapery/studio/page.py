"""The page: where each panel stands. A new panel is a file in `panels/` and a line in PANELS."""

from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Literal, cast

from fastapi import Request
from nicegui import Client, ui

from drapery.errors import DraperyError
from drapery.settings import Settings
from drapery.studio.notices import tell
from drapery.studio.selection import desk_of
from drapery.studio.session import Session, open_session
from drapery.studio.share import begun, write_link
from drapery.studio.sketch import Sketch
from drapery.studio.upload_queue import incoming_of
from drapery.studio.widgets import words

if TYPE_CHECKING:
    from drapery.studio.app import StudioConfig

Place = Literal["left", "stage", "under", "side"]


@dataclass(frozen=True)
class Panel:
    """One part of the page.

    name: its module in `panels/`, whose `build(session)` draws it. title: its heading and tab.
    icon: of its tab, by its name among Material's. place: `left` and `under` the stage it is
    always seen on a wide window; at the `side` it shares the room by tabs. On a phone all but
    the stage and the palette are tabs.
    """

    name: str
    title: str
    icon: str
    place: Place


PANELS = (
    Panel("palette", "Dyes", "palette", "left"),
    Panel("layers", "Layers", "layers", "left"),
    Panel("live", "Live", "air", "stage"),
    Panel("face", "Flat", "crop_portrait", "stage"),
    Panel("motion", "Motion", "tune", "under"),
    Panel("patterns", "Patterns", "grid_view", "side"),
    Panel("text", "Text", "code", "side"),
    Panel("loom", "Loom", "handyman", "side"),
    Panel("packs", "Packs", "inventory_2", "side"),
    Panel("export", "Export", "ios_share", "side"),
    Panel("library", "Library", "collections_bookmark", "side"),
)

FIRST_TAB = "patterns"

house = cast("StudioConfig", None)
"""What the studio was started with; `app.make_app` sets it."""

_DETAIL = "(event) => emit(event.detail)"
_ROOM = Path(__file__).parent


@ui.page("/")
def studio(client: Client) -> None:
    """One tab's page, with a session of its own that ends with the tab."""
    settings, sketch, fault = opened(house.settings, client.request)
    session = open_session(settings, sketch)
    client.on_delete(session.close)
    build(session)
    if fault:
        ui.timer(0.5, lambda: tell(fault, "fault"), once=True)


def opened(own: Settings, request: Request | None) -> tuple[Settings, Sketch | None, str]:
    """What the page begins with: the design of a link, or why that is none."""
    word = request.query_params.get("d") if request is not None else None
    if not word:
        return own, None, ""
    try:
        return *begun(own, word), ""
    except DraperyError as error:
        return own, None, str(error)


def build(session: Session) -> None:
    """Draw the whole page for a session."""
    from drapery.studio.panels import bar, shortcuts

    _head(session)
    desk = desk_of(session)
    with ui.element("div").classes("studio").props(f'data-token="{session.token}"') as root:
        with ui.element("header").classes("bar"):
            bar.build(session)
        for place in ("left", "stage", "under"):
            with ui.element("main" if place == "stage" else "div").classes(place):
                _panels(session, place)
        _tabs()
        with ui.element("div").classes("side"):
            _panels(session, "side")
    shortcuts.build()
    _keep_in_address(session)
    root.on("act", lambda event: bar.act(session, desk, str(event.args)), js_handler=_DETAIL)
    root.on(
        "pasted", lambda event: incoming_of(session).read_text(str(event.args)), js_handler=_DETAIL
    )


def _keep_in_address(session: Session) -> None:
    """Hold the design in the page's own address: to load it anew, or to go back, loses no work."""
    client = ui.context.client

    def keep() -> None:
        # Letters of base64url alone: nothing in it can end the text.
        client.run_javascript(f'studio.keep("{write_link(session.sketch, session.settings)}")')

    session.listen("sketch", keep)
    session.listen("settings", keep)


def _head(session: Session) -> None:
    # Inline, since each is small and a page that is whole at once does not jump.
    for sheet in sorted(_ROOM.glob("*.css")):
        ui.add_head_html(f"<style>{sheet.read_text()}</style>")
    ui.add_head_html(f'<script type="module">{(_ROOM / "studio.js").read_text()}</script>')


def _panels(session: Session, place: str) -> None:
    for panel in PANELS:
        if panel.place == place:
            section = ui.element("section").classes(f"panel panel-{panel.name}")
            section.props(f'id="panel-{panel.name}" aria-label="{panel.title}"')
            if panel.name == FIRST_TAB:
                section.props("data-active")
            with section:
                import_module(f"drapery.studio.panels.{panel.name}").build(session)


def _tabs() -> None:
    with ui.element("div").classes("tabs").props('role="tablist" aria-label="Panels"'):
        for panel in PANELS:
            if panel.place == "stage" or panel.name == "palette":
                continue
            first = panel.name == FIRST_TAB
            tab = ui.element("button").classes(f"tab tab-{panel.place}")
            tab.props(
                f'id="tab-{panel.name}" type="button" role="tab" data-panel="{panel.name}"'
                f' aria-controls="panel-{panel.name}" aria-selected="{str(first).lower()}"'
                f' tabindex="{0 if first else -1}"'
            )
            with tab:
                ui.icon(panel.icon).props('aria-hidden="true"')
                words(panel.title).classes("tab-title")
