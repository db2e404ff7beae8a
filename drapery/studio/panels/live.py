"""The live banner on the stage, and beneath it what is done while one looks at it."""

from functools import cache

from nicegui import ui

from drapery.render.views import VIEWS
from drapery.scenes import catalogue
from drapery.studio.panels.controls import Controls
from drapery.studio.session import Session
from drapery.studio.viewer import Viewer
from drapery.studio.viewport import in_thread, stage_of

OWN = "your banner"
"""The choice among the scenes that is none of them."""
LATER = 1.5
"""When the scenes are listed, after the page has been built [s]."""
VIEW_WORDS = {"front": "Front", "back": "Back", "iso": "Corner", "gui": "Item", "hero": "Hero"}


def build(session: Session) -> None:
    """The viewer, the named views, pause, reset and the scenes."""
    stage = stage_of(session)
    controls = Controls(session)
    with ui.element("div").classes("live"):
        Viewer(session).classes("live-view")
        with ui.element("div").classes("live-bar"):
            with (
                ui.element("div")
                .classes("live-views")
                .props('role="group" aria-label="Views of the banner"')
            ):
                for name in VIEWS:
                    _view(session, controls, name)
            pause = controls.button(
                "Pause", lambda: stage.wish(paused=not stage.wishes.paused), icon="pause"
            )
            controls.pressed(pause, lambda: stage.wishes.paused)
            controls.button("Back to rest", stage.reset, icon="restart_alt")
            scenes = controls.select(
                "Scene",
                {None: OWN},
                lambda: stage.wishes.scene,
                lambda name: stage.wish(scene=name),
            )
    controls.follow()

    async def list_scenes() -> None:
        # To know all scenes is to import them, which the first picture need not wait for.
        names = await in_thread(_scenes)
        if not session.closed:
            scenes.set_options({None: OWN, **names}, value=stage.wishes.scene)

    ui.timer(LATER, list_scenes, once=True)


def _view(session: Session, controls: Controls, name: str) -> None:
    def choose() -> None:
        session.adjust(view=name)
        stage_of(session).look_anew()

    button = controls.button(VIEW_WORDS.get(name, name), choose)
    button.props(f'aria-label="View: {VIEW_WORDS.get(name, name)}"')
    controls.pressed(button, lambda: session.settings.view == name)


@cache
def _scenes() -> dict[str, str]:
    """All ready-made scenes and what is seen in them."""
    return {name: f"{name}: {catalogue.find(name).summary}" for name in catalogue.names()}
