"""The options of an export: the kind of file, and the options that this kind has."""

from collections.abc import Callable, Mapping
from contextlib import AbstractContextManager
from dataclasses import dataclass, field
from functools import cache, partial
from typing import Any

from nicegui import ui

from drapery.errors import DraperyError
from drapery.settings import LOOP_OPTIONS, OPTIONS, LoopSettings, Settings
from drapery.studio.chosen_scene import scene_choice
from drapery.studio.descriptions import choice_titles, view_title
from drapery.studio.panels.fields import Fields
from drapery.studio.session import Session
from drapery.studio.sketch import banner_of
from drapery.studio.snippets import (
    FILE_OPTIONS,
    FORMATS,
    KINDS,
    LOOPS,
    MODELS,
    MOVING,
    STILLS,
    ExportRequest,
    option_names,
)
from drapery.studio.translation import translated
from drapery.studio.viewport import ViewportRequest
from drapery.studio.widgets import text_element
from drapery.web.wasm.module import is_module_built

GROUNDS = {"transparent": "transparent", "colour": "one colour"}
SKY = "#a8c8e8"
LOOP_LABELS = {"seconds": "Seconds", "fps": "Frames/s"}
"""What fields of an animation's options say where it is not the option's name."""


@dataclass
class FileChoice:
    """The choices that are not options of a picture. numbers: those that affect only the file."""

    kind: str = "png"
    numbers: dict[str, Any] = field(
        default_factory=lambda: {n: FILE_OPTIONS[n].default for n in (*LOOP_OPTIONS, "scale")}
    )
    colour: str = SKY
    changed: list[Callable[[], None]] = field(default_factory=list)

    def set(self, **values: Any) -> None:
        """Change choices and call the listeners."""
        for name, value in values.items():
            setattr(self, name, value)
        for call in self.changed:
            call()


def request_of(session: Session, choice: FileChoice) -> ExportRequest:
    """The export request for the current state of the page. Raises DesignError or OptionError."""
    # A cape or elytra has a texture instead of a design.
    banner = None if session.settings.texture is not None else banner_of(session.sketch)
    settings = session.settings
    if not session.viewport.request.on:
        settings = settings.changed(wind=0.0)
    times = {name: choice.numbers[name] for name in LOOP_OPTIONS if choice.kind in MOVING}
    made = choice.kind, LoopSettings(**times), choice.numbers["scale"]
    shown = session.viewport.request
    scene = None if shown.scene is None else scene_choice(shown.scene, banner, settings)
    return ExportRequest(banner, settings, *made, shown.garment, scene, shown.skin)


BY_VIEW = {"": "by the view"}
BLOCKS = ("none", "grass", "stone", "stone_bricks", "oak_planks", "sand")
"""Blocks of our own art that the page offers as ground."""


def build_options(session: Session, choice: FileChoice) -> Callable[[], None]:
    """The kind of file and the options of this kind; returns a callable that updates them."""
    fields = Fields(session)

    @cache
    def names() -> tuple[str, ...]:
        """The options of the file; those of any subject while a text of the page is not valid."""
        try:
            return option_names(request_of(session, choice))
        except DraperyError:  # the export says so
            return option_names(ExportRequest(None, Settings(), choice.kind))

    def only(name: str) -> AbstractContextManager[None]:
        return fields.only(lambda: name in names())

    def option(name: str, label: str, choices: Mapping[str, str] | None = None) -> None:
        with only(name):
            fields.option(name, label, choices)

    def number(name: str, label: str) -> None:
        """A number that affects only the file."""

        def put(number: float) -> None:
            choice.set(numbers=choice.numbers | {name: number})

        with only(name):
            fields.number(label, FILE_OPTIONS[name], lambda: choice.numbers[name], put)

    with ui.element("div").classes("options"):
        made = [kind for kind in KINDS if kind != "html" or is_module_built()]
        titles = {kind: title_of(kind) for kind in made}
        fields.choice("File", titles, lambda: choice.kind, lambda kind: choice.set(kind=kind))
        with only("size"):
            _sides(session, fields)
        with ui.element("div").classes("option-group"):
            for name in LOOP_OPTIONS:
                number(name, LOOP_LABELS.get(name, name.replace("_", " ").capitalize()))
            # A scene has cameras of its own.
            with fields.only(lambda: "turntable" in names() and not session.viewport.request.scene):
                fields.option("turntable", "Turntable")
            number("scale", "Pixels a texel")
            views = {str(name): view_title(str(name)) for name in OPTIONS["view"].choices}
            option("view", "View", views)
            option("seed", "Gusts (seed)")
            option("time", "Seconds in the wind")
            option("samples", "Samples a pixel", _by_view("samples"))
            option("pixel", "Enlarge pixels by")
            with only("background"):
                _background(session, choice, fields)
            grounds = {name: name.replace("_", " ") for name in BLOCKS}
            option("ground", "Ground", BY_VIEW | grounds)
            option("light", "Light", _by_view("light"))
            option("shadow", "Shadow")

    hint = text_element("", "p").classes("hint")
    differs = text_element("", "p").classes("warning")

    def fit() -> None:
        names.cache_clear()
        fields.refresh()
        hint.set_text(translated(hint_of(choice.kind)))
        differs.set_text(translated(difference(session.viewport.request, choice.kind)))
        differs.set_visibility(bool(differs.text))

    return fit


def title_of(kind: str) -> str:
    """A kind of file as the page lists it."""
    if kind == "face":
        return "PNG, the flat face"
    if kind == "json":
        return "JSON, the design"
    if kind == "html":
        return "Web page, live cloth"
    name = FORMATS[kind].name
    if kind in LOOPS:
        return f"{name}, waving"
    if kind in STILLS:
        return f"{name}, a still"
    return f"{name}, a 3-D model that waves" if kind in MOVING else f"{name}, a 3-D model"


def hint_of(kind: str) -> str:
    """What its user should know of a kind of file; empty for nothing."""
    if kind == "face":
        return "As banner sites show it; the wind has no effect."
    if kind == "html":
        return (
            "One file that waves in any browser, without this studio; it can be turned and pulled."
        )
    if kind in MODELS and kind in MOVING:
        return "The model has its own size and light; it loops in Blender and on the web."
    format = FORMATS.get(kind)
    if format is not None and format.alpha == "bit":
        return f"A {format.name} has no half transparency and at most {format.max_fps} frames/s."
    if format is not None and format.alpha == "none":
        return f"{format.name} has no transparency: without a background it is white."
    return ""


def _by_view(name: str) -> dict[str, str]:
    return choice_titles(OPTIONS[name]) | BY_VIEW


def _sides(session: Session, fields: Fields) -> None:
    def resize(place: int, side: int) -> None:
        width, height = session.settings.size
        session.adjust(size=(side, height) if place == 0 else (width, side))

    for place, label in enumerate(("Width", "Height")):
        get = partial(lambda place: session.settings.size[place], place)
        fields.number(label, OPTIONS["size"], get, partial(resize, place))


def _background(session: Session, choice: FileChoice, fields: Fields) -> None:
    def ground() -> str:
        return "transparent" if session.settings.background == "transparent" else "colour"

    def paint(colour: str) -> None:
        session.adjust(background=colour)
        choice.colour = colour

    def choose(name: str) -> None:
        session.adjust(background=choice.colour if name == "colour" else name)

    def colour() -> str:
        shown = session.settings.background
        return choice.colour if shown == "transparent" else "#" + shown.removeprefix("#")

    fields.choice("Background", GROUNDS, ground, choose)
    with fields.only(lambda: ground() == "colour"):
        fields.colour("Background colour", colour, paint)


def difference(request: ViewportRequest, kind: str) -> str:
    """What the live banner shows but the file will not contain."""
    if kind in MODELS and request.scene is not None:
        return "A 3-D model shows your banner, not the scene."
    is_other = any(request.shown)
    return "A web page shows your banner." if kind == "html" and is_other else ""
