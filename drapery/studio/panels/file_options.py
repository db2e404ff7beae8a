"""The options of an export: the kind of file, and the options that this kind has."""

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

from nicegui import ui
from nicegui.element import Element

from drapery.option import Option
from drapery.settings import LOOP_OPTIONS, OPTIONS
from drapery.studio.chosen_scene import scene_choice
from drapery.studio.descriptions import view_title
from drapery.studio.panels.fields import Fields
from drapery.studio.session import Session
from drapery.studio.sketch import banner_of
from drapery.studio.snippets import LOOPS, SCALE, ExportRequest
from drapery.studio.translation import translated
from drapery.studio.viewport import ViewportRequest
from drapery.studio.widgets import text_element

KINDS = {
    "png": "PNG, a still",
    "face": "PNG, the flat face",
    "gif": "GIF, waving",
    "apng": "APNG, waving",
    "webp": "WebP, waving",
    "mp4": "MP4, waving",
    "glb": "GLB, a 3-D model that waves",
    "html": "Web page, live cloth",
    "json": "JSON, the design",
}
HINTS = {
    "gif": "A GIF has no half transparency and at most 50 frames/s.",
    "mp4": "A video has no transparency: without a background it is white.",
    "glb": "The model has its own size and light; it loops in Blender and on the web.",
    "html": "One file that waves in any browser, without this studio; it can be turned and pulled.",
    "face": "As banner sites show it; the wind has no effect.",
}
PICTURES = frozenset({"png", *LOOPS})
MOVING = frozenset({*LOOPS, "glb"})
GROUNDS = {"transparent": "transparent", "colour": "one colour"}
SKY = "#a8c8e8"


@dataclass
class FileChoice:
    """The choices that are not options of a picture."""

    kind: str = "png"
    seconds: float = LOOP_OPTIONS["seconds"].default
    fps: float = LOOP_OPTIONS["fps"].default
    scale: int = SCALE.default
    colour: str = SKY
    changed: list[Callable[[], None]] = field(default_factory=list)

    def set(self, **values: Any) -> None:
        """Change choices and call the listeners."""
        for name, value in values.items():
            setattr(self, name, value)
        for call in self.changed:
            call()


def request_of(session: Session, choice: FileChoice) -> ExportRequest:
    """The export request for the current state of the page. Raises DesignError."""
    # A cape or elytra has a texture instead of a design.
    banner = None if session.settings.texture is not None else banner_of(session.sketch)
    settings = session.settings
    if not session.viewport.request.on:
        settings = replace(settings, wind=0.0)
    made = choice.kind, choice.seconds, choice.fps, choice.scale
    shown = session.viewport.request
    scene = None if shown.scene is None else scene_choice(shown.scene, banner, settings)
    return ExportRequest(banner, settings, *made, shown.garment, scene, shown.skin)


BY_VIEW = {"": "by the view"}
BLOCKS = ("none", "grass", "stone", "stone_bricks", "oak_planks", "sand")
"""Blocks of our own art that the page offers as ground."""

Groups = list[tuple[Element, Callable[[], bool]]]


def build_options(session: Session, choice: FileChoice) -> Callable[[], None]:
    """The kind of file and the options of this kind; returns a callable that updates them."""
    fields, groups = Fields(), Groups()
    with ui.element("div").classes("options"):
        fields.choice("File", KINDS, lambda: choice.kind, lambda kind: choice.set(kind=kind))
        with _only(groups, lambda: choice.kind in PICTURES | {"html"}):
            _sides(session, fields)
        with _only(groups, lambda: choice.kind in MOVING):
            _times(choice, fields)
        with _only(groups, lambda: choice.kind in LOOPS and _can_turn(session)):
            _tick(session, fields, "Turntable", "turntable")
        with _only(groups, lambda: choice.kind == "face"):
            _choice_number(fields, "Pixels a texel", choice, SCALE)
        with _only(groups, lambda: choice.kind in PICTURES | {"glb", "html"}):
            views = {str(name): view_title(str(name)) for name in OPTIONS["view"].choices}
            _pick(session, fields, "View", "view", views)
            _number(session, fields, "Gusts (seed)", "seed")
        with _only(groups, lambda: choice.kind == "png"):
            _number(session, fields, "Seconds in the wind", "time")
        with _only(groups, lambda: choice.kind in PICTURES):
            samples = {str(name): str(name) for name in OPTIONS["samples"].choices}
            _pick(session, fields, "Samples a pixel", "samples", BY_VIEW | samples)
            _number(session, fields, "Enlarge pixels by", "pixel")
        _ground(session, choice, fields, groups)

    hint = text_element("", "p").classes("hint")
    differs = text_element("", "p").classes("warning")

    def fit() -> None:
        fields.refresh()
        hint.set_text(translated(HINTS.get(choice.kind, "")))
        line = difference(session.viewport.request, choice.kind)
        differs.set_text(translated(line))
        differs.set_visibility(bool(line))
        for group, counts in groups:
            group.set_visibility(counts())

    return fit


@contextmanager
def _only(groups: Groups, counts: Callable[[], bool]) -> Iterator[None]:
    """Within the block, add options that are visible only while `counts` returns true."""
    with ui.element("div").classes("option-group") as group:
        yield
    groups.append((group, counts))


def _sides(session: Session, fields: Fields) -> None:
    def resize(place: int, side: float) -> None:
        width, height = session.settings.size
        session.adjust(size=(int(side), height) if place == 0 else (width, int(side)))

    for place, label in enumerate(("Width", "Height")):
        get = partial(lambda place: session.settings.size[place], place)
        fields.number(label, OPTIONS["size"], get, partial(resize, place))


def _times(choice: FileChoice, fields: Fields) -> None:
    _choice_number(fields, "Seconds", choice, LOOP_OPTIONS["seconds"])
    _choice_number(fields, "Frames/s", choice, LOOP_OPTIONS["fps"])


def _choice_number(fields: Fields, label: str, choice: FileChoice, option: Option) -> None:
    """A field for a number that affects only the file."""
    get = partial(getattr, choice, option.name)
    fields.number(label, option, get, lambda number: choice.set(**{option.name: number}))


def _number(session: Session, fields: Fields, label: str, name: str) -> None:
    """A field for a numeric option of the picture."""
    get = partial(_value, session, name)
    fields.number(label, OPTIONS[name], get, lambda number: session.adjust(**{name: number}))


def _pick(
    session: Session, fields: Fields, label: str, name: str, titles: Mapping[str, str]
) -> None:
    """A field for an option of the picture that has a list of choices."""
    fields.choice(
        label,
        titles,
        lambda: "" if _value(session, name) is None else str(_value(session, name)),
        lambda text: session.adjust(**{name: OPTIONS[name].parse(text) if text else None}),
    )


def _tick(session: Session, fields: Fields, label: str, name: str) -> None:
    """A check box for an option of the picture that is on or off."""
    get = partial(_value, session, name)
    fields.tick(label, get, lambda on: session.adjust(**{name: bool(on)}))


def _can_turn(session: Session) -> bool:
    """Whether a turntable turns what is shown: a scene has cameras of its own, an item a slot."""
    return session.viewport.request.scene is None and session.settings.placement != "item"


def _value(session: Session, name: str) -> Any:
    return getattr(session.settings, name)


def _ground(session: Session, choice: FileChoice, fields: Fields, groups: Groups) -> None:
    """Background, ground, light and shadow."""

    def plain() -> bool:
        return session.settings.background == "transparent"

    def choose(name: str) -> None:
        session.adjust(background=choice.colour if name == "colour" else "transparent")

    def paint(colour: str) -> None:
        session.adjust(background=colour)
        choice.colour = colour

    def colour() -> str:
        return choice.colour if plain() else "#" + session.settings.background.removeprefix("#")

    with _only(groups, lambda: choice.kind in PICTURES):
        fields.choice("Background", GROUNDS, lambda: "transparent" if plain() else "colour", choose)
        with _only(groups, lambda: not plain()):
            fields.colour("Background colour", colour, paint)
        _pick(
            session,
            fields,
            "Ground",
            "ground",
            BY_VIEW | {name: name.replace("_", " ") for name in BLOCKS},
        )
        lights = {str(name): str(name) for name in OPTIONS["light"].choices}
        _pick(session, fields, "Light", "light", BY_VIEW | lights)
        _tick(session, fields, "Shadow", "shadow")


def difference(request: ViewportRequest, kind: str) -> str:
    """What the live banner shows but the file will not contain."""
    if kind == "glb" and request.scene is not None:
        return "A 3-D model shows your banner, not the scene."
    is_other = any(request.shown)
    return "A web page shows your banner." if kind == "html" and is_other else ""
