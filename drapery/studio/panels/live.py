"""The live banner or garment in the viewport, and below it the actions on it."""

from functools import cache, partial

from nicegui import run, ui

from drapery.garments import find_garment, garment_names, skin_names
from drapery.option import Subject
from drapery.scenes import find_scene, scene_names
from drapery.settings import OPTIONS, applicable
from drapery.studio.chosen_scene import what_follows
from drapery.studio.components import ViewerElement
from drapery.studio.descriptions import named, view_title
from drapery.studio.file_field import FileField
from drapery.studio.form_field import FormField
from drapery.studio.garment_store import ENDINGS
from drapery.studio.panels.fields import Fields
from drapery.studio.session import Session
from drapery.studio.sketch import banner_of
from drapery.studio.snippets import ExportRequest, drawn_garment
from drapery.studio.translation import translated
from drapery.studio.widgets import (
    SegmentedControl,
    button,
    set_props,
    text_element,
    translated_text,
)

OWN = "your banner"
"""The choice that shows the design instead of a scene."""
NONE = "none"
"""The choice that shows the banner instead of a garment."""
SEEN = tuple(
    name
    for name in applicable(Subject("garment"), "page")
    if not {"wind", "camera"}.isdisjoint(OPTIONS[name].affects)
)
"""The options that begin anew with each garment."""
WORN = {"garment": "Garment", "skin": "Skin"}
OWN_FILES = {
    "garment": "Drop a garment of your own here, or choose it (.toml)",
    "skin": "Drop a skin here to see its player, or choose it (.png)",
}
ZONE = ".panel-live"
"""Where the files of garments and skins are dropped."""
LATER = 1.5
"""The delay between building the page and listing the scenes [s]."""


def build(session: Session) -> None:
    """The viewer, the named views, pause, reset and the scenes."""
    viewport, fields = session.viewport, Fields(session)

    def choose_view(name: str) -> None:
        session.adjust(view=name)
        viewport.look_anew()

    def pause() -> None:
        viewport.update(paused=not viewport.request.paused)

    with ui.element("div").classes("live"):
        ViewerElement(session).classes("live-view")
        with ui.element("div").classes("live-bar"):
            titles = {str(name): view_title(str(name)) for name in OPTIONS["view"].choices}
            views = SegmentedControl("View", titles, choose_view)
            paused = button("Pause", pause, icon="pause")
            button("Back to rest", viewport.reset, icon="rest")
            scenes = fields.choice(
                "Scene",
                {"": OWN},
                lambda: viewport.request.scene or "",
                lambda name: show_scene(session, name or None),
            )
            lists = {
                kind: fields.choice(
                    label,
                    {"": NONE} if kind == "garment" else _titles(session, kind),
                    partial(lambda kind: viewport.request.shown.get(kind, ""), kind),
                    partial(_put_on, session, kind),
                )
                for kind, label in WORN.items()
            }
            follows = text_element("", "p").classes("hint").props("role=status")
        with ui.element("details").classes("advanced live-files"):
            translated_text("A garment or a skin of your own", "summary")
            for kind, label in OWN_FILES.items():
                taken = partial(_take, session, kind, lists[kind])
                FileField(session, kind, label, taken, endings=ENDINGS[kind], zone=ZONE)

    def show() -> None:
        scene = viewport.request.scene
        # A scene has a camera of its own.
        views.show(str(session.settings.view), enabled=scene is None)
        set_props(paused, {"aria-pressed": str(viewport.request.paused).lower()})
        follows.set_text(translated(what_follows(scene)) if scene else "")
        follows.set_visibility(scene is not None)

    fields.on_refresh(show)
    session.follow(fields.refresh, "settings", "scene")

    def list_files() -> None:
        for kind, listed in lists.items():
            listed.set_choices(_titles(session, kind))

    session.listen(list_files, "files")

    async def list_scenes() -> None:
        # Listing the scenes imports them, so do it after the first picture.
        found = await run.io_bound(scene_summaries)
        await run.io_bound(garment_descriptions)
        if found is not None and not session.closed:
            names = {name: named(name, summary) for name, summary in found.items()}
            scenes.set_choices({"": translated(OWN)} | names)
            list_files()

    ui.timer(LATER, list_scenes, once=True)


def wear(session: Session, garment: str | None, skin: str | None = None) -> None:
    """Show a garment, or the player of a skin, in the wind and view of its file.

    None for both shows the banner again, with the options that it had before.
    """
    banner, settings = banner_of(session.sketch), session.settings
    found = drawn_garment(ExportRequest(banner, settings, garment=garment, skin=skin))
    if found is None:
        _give_back(session)
    else:
        own = found.settings()
        seen = {option: getattr(own, option) for option in SEEN}
        changed = {"placement": "standing", "facing": None, **seen, **found.picture}
        before = {name: settings.as_given(name) for name in changed}
        session.adjust(**changed)
        session.viewport.banner_options = before | session.viewport.banner_options
    session.viewport.update(scene=None, garment=garment, skin=skin)


def show_scene(session: Session, name: str | None) -> None:
    """Show a scene; None shows the banner again."""
    _give_back(session)
    session.viewport.update(scene=name, garment=None, skin=None)


def _give_back(session: Session) -> None:
    """Set the options again that the banner had before a garment was shown."""
    options, session.viewport.banner_options = session.viewport.banner_options, {}
    if options and session.sketch.kind == "shield":  # it is not on a wall
        options |= {"placement": "standing", "facing": None}
    session.adjust(**options)


def _put_on(session: Session, kind: str, name: str | None) -> None:
    """Show a garment or a skin with what else is worn; no name takes it off."""
    request = session.viewport.request
    wear(session, **{"garment": request.garment, "skin": request.skin, kind: name or None})


async def _take(session: Session, kind: str, listed: FormField, number: int) -> None:
    """Put on a garment or a skin that was sent."""
    path = await run.io_bound(session.garment_store.adopt, number, kind)
    if path is not None and not session.closed:
        listed.set_choices(_titles(session, kind))
        _put_on(session, kind, path)


def _titles(session: Session, kind: str) -> dict[str, str]:
    """The garments, or the skins of players, that can be shown, by name or path."""
    known = {name: translated(name.capitalize()) for name in skin_names()}
    if kind == "garment":
        known = {name: named(name, each) for name, each in garment_descriptions().items()}
    return {"": translated(NONE), **session.garment_store.titles(kind), **known}


@cache
def garment_descriptions() -> dict[str, str]:
    """All garments with their descriptions."""
    return {name: find_garment(name).description for name in garment_names()}


@cache
def scene_summaries() -> dict[str, str]:
    """All ready-made scenes with their summaries."""
    return {name: find_scene(name).summary for name in scene_names()}
