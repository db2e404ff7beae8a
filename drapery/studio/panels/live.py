"""The live banner or garment in the viewport, and below it the actions on it."""

from functools import cache

from nicegui import run, ui

from drapery.garments import find_garment, garment_names, skin_names
from drapery.scenes import find_scene, scene_names
from drapery.settings import OPTIONS
from drapery.studio.chosen_scene import what_follows
from drapery.studio.descriptions import named, view_title
from drapery.studio.file_field import FileField
from drapery.studio.live_threads import in_thread
from drapery.studio.panels.controls import Controls
from drapery.studio.session import Session
from drapery.studio.sketch import banner_of
from drapery.studio.snippets import ExportRequest, drawn_garment
from drapery.studio.translation import translated
from drapery.studio.viewer import ViewerElement
from drapery.studio.widgets import translated_text

OWN = "your banner"
"""The choice that shows the design instead of a scene."""
NONE = "none"
"""The choice that shows the banner instead of a garment."""
SEEN = ("view", "rotation", "wind", "direction", "gusts")
"""The options that begin anew with each garment."""
ZONE = ".panel-live"
"""Where the files of garments and skins are dropped."""
LATER = 1.5
"""The delay between building the page and listing the scenes [s]."""


def build(session: Session) -> None:
    """The viewer, the named views, pause, reset and the scenes."""
    viewport = session.viewport
    controls = Controls(session)
    with ui.element("div").classes("live"):
        ViewerElement(session).classes("live-view")
        with ui.element("div").classes("live-bar"):
            with ui.element("div").classes("live-views").props('role="group"') as views:
                views.props["aria-label"] = translated("View")
                for name in OPTIONS["view"].choices:
                    _view(session, controls, str(name))
            pause = controls.button(
                "Pause", lambda: viewport.update(paused=not viewport.request.paused), icon="pause"
            )
            controls.pressed(pause, lambda: viewport.request.paused)
            controls.button("Back to rest", viewport.reset, icon="restart_alt")
            scenes = controls.select(
                "Scene",
                {None: OWN},
                lambda: viewport.request.scene,
                lambda name: viewport.update(scene=name, garment=None, skin=None),
            )
            garments = controls.select(
                "Garment",
                {None: NONE},
                lambda: viewport.request.garment,
                lambda name: wear(session, name, viewport.request.skin),
            )
            skins = controls.select(
                "Skin",
                _skins(session),
                lambda: viewport.request.skin,
                lambda name: wear(session, viewport.request.garment, name),
            )
            controls.line(
                lambda: translated(what_follows(shown)) if (shown := viewport.request.scene) else ""
            )
        with ui.element("details").classes("advanced live-files"):
            translated_text("A garment or a skin of your own", "summary")
            label = "Drop a garment of your own here, or choose it (.toml)"
            FileField(session, "garment", label, lambda n: take(n), endings=".toml", zone=ZONE)
            label = "Drop a skin here to see its player, or choose it (.png)"
            FileField(session, "skin", label, lambda n: take_skin(n), endings=".png", zone=ZONE)
    controls.follow()

    async def take(number: int) -> None:
        path = await run.io_bound(session.garment_store.adopt, number)
        if path is not None and not session.closed:
            garments.set_options(_choices(session), value=path)
            wear(session, path, viewport.request.skin)

    async def take_skin(number: int) -> None:
        path = await run.io_bound(session.garment_store.adopt_skin, number)
        if path is not None and not session.closed:
            skins.set_options(_skins(session), value=path)
            wear(session, viewport.request.garment, path)

    async def list_scenes() -> None:
        # Listing the scenes imports them, so do it after the first picture.
        found, _ = await in_thread(lambda: (scene_summaries(), garment_descriptions()))
        if not session.closed:
            names = {name: named(name, summary) for name, summary in found.items()}
            scenes.set_options({None: translated(OWN), **names}, value=viewport.request.scene)
            garments.set_options(_choices(session), value=viewport.request.garment)

    ui.timer(LATER, list_scenes, once=True)


def _view(session: Session, controls: Controls, name: str) -> None:
    def choose() -> None:
        session.adjust(view=name)
        session.viewport.look_anew()

    button = controls.button(view_title(name), choose)
    button.props.update({"aria-label": f"{translated('View')}: {translated(view_title(name))}"})
    controls.pressed(button, lambda: session.settings.view == name)
    # A scene has a camera of its own.
    controls.enabled(button, lambda: session.viewport.request.scene is None)


def wear(session: Session, garment: str | None, skin: str | None = None) -> None:
    """Show a garment, or the player of a skin, in the wind and view of its file.

    None for both shows the banner again.
    """
    banner = banner_of(session.sketch)
    found = drawn_garment(ExportRequest(banner, session.settings, garment=garment, skin=skin))
    if found is not None:
        own = found.settings()
        seen = {option: getattr(own, option) for option in SEEN}
        session.adjust(placement="standing", facing=None, **{**seen, **found.picture})
    session.viewport.update(scene=None, garment=garment, skin=skin)


def _skins(session: Session) -> dict[str | None, str]:
    """The skins of players, by name or path."""
    store = session.garment_store
    choices: dict[str | None, str] = {None: translated(NONE)}
    if store.skin is not None:
        choices[str(store.skin)] = store.names[str(store.skin)]
    return choices | {name: translated(name.capitalize()) for name in skin_names()}


def _choices(session: Session) -> dict[str | None, str]:
    """What the viewer can show in place of the banner, by its name or path."""
    own = session.garment_store
    choices: dict[str | None, str] = {None: translated(NONE)}
    if own.path:
        choices[str(own.path)] = own.title
    return choices | {name: named(name, each) for name, each in garment_descriptions().items()}


@cache
def garment_descriptions() -> dict[str, str]:
    """All garments with their descriptions."""
    return {name: find_garment(name).description for name in garment_names()}


@cache
def scene_summaries() -> dict[str, str]:
    """All ready-made scenes with their summaries."""
    return {name: find_scene(name).summary for name in scene_names()}
