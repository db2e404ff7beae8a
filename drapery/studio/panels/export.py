"""What leaves the page: picture, animation and model files, the share link, code to copy."""

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

from nicegui import ui

from drapery.errors import DraperyError
from drapery.render.views import VIEWS
from drapery.settings import MAX_SIDE
from drapery.studio.exports import MAX_SCALE, Export, exports_of, stem_of
from drapery.studio.notices import faults, tell
from drapery.studio.panels.controls import Controls
from drapery.studio.panels.copying import copy_field
from drapery.studio.session import Session
from drapery.studio.share import write_link
from drapery.studio.shelf import shelf_of
from drapery.studio.sketch import banner_of
from drapery.studio.snippets import LOOPS, Order, as_command, as_python

KINDS = {
    "png": "PNG, a still",
    "face": "PNG, the flat face",
    "gif": "GIF, waving",
    "apng": "APNG, waving",
    "webp": "WebP, waving",
    "mp4": "MP4, waving",
    "glb": "GLB, a 3-D model that waves",
    "json": "JSON, the design",
}
SAMPLES = {1: "1: hard pixels", 4: "4: smooth", 16: "16: smoothest"}
PIXELS = {1: "off", 2: "2", 4: "4", 8: "8", 16: "16"}
PICTURES = frozenset({"png", *LOOPS})
MOVING = frozenset({*LOOPS, "glb"})
TICK = 0.15
"""How often progress is shown [s]."""
TIDY = 0.5
"""How often the page's address follows the design [s]."""


@dataclass
class Choice:
    """What the panel holds that is no option of a picture."""

    kind: str = "png"
    seconds: float = 4.0
    fps: float = 20.0
    scale: int = 8


def build(session: Session) -> None:
    """Options, the button with its progress, then what can be copied."""
    choice = Choice()
    controls = Controls(session)
    with ui.element("div").classes("stack export"):
        copies: list[Callable[[], None]] = []

        def show() -> None:
            for copy in copies:
                copy()

        _options(session, choice, controls, show)
        _button(session, choice)
        copies.append(_copies(session, choice))
    controls.follow()
    show()
    session.listen("sketch", show)
    session.listen("settings", show)
    session.listen("packs", show)
    _keep_address(session)


def order_of(session: Session, choice: Choice) -> Order:
    """What is ordered by the page as it stands. Raises DesignError."""
    # A cape or elytra wears a texture, no design.
    banner = None if session.settings.texture is not None else banner_of(session.sketch)
    return Order(banner, session.settings, choice.kind, choice.seconds, choice.fps, choice.scale)


def _options(
    session: Session, choice: Choice, controls: Controls, show: Callable[[], None]
) -> None:
    """The kind of file, then the options that count for it."""
    shown: list[tuple[ui.element, frozenset[str]]] = []

    def choose(event: Any) -> None:
        choice.kind = event.value
        fit()
        show()

    def fit() -> None:
        for element, kinds in shown:
            element.set_visibility(choice.kind in kinds)

    kind = ui.select(KINDS, value=choice.kind, label="File", on_change=choose)
    kind.props('dense outlined options-dense aria-label="Kind of file"').classes("export-kind")
    with ui.element("div").classes("export-options"):
        numbers = Numbers(session, show)
        with _for(shown, PICTURES):
            numbers.own("Width", (1, MAX_SIDE), lambda: session.settings.size[0], _width(session))
            numbers.own("Height", (1, MAX_SIDE), lambda: session.settings.size[1], _height(session))
        with _for(shown, MOVING):
            numbers.of(choice, "seconds", "Seconds", (0.05, 3600))
            numbers.of(choice, "fps", "Frames/s", (1, 120))
        with _for(shown, frozenset({"face"})):
            numbers.of(choice, "scale", "Pixels a texel", (1, MAX_SCALE), whole=True)
        with _for(shown, PICTURES | {"glb"}):
            _picks(session, controls, "View", "view", {name: name for name in VIEWS})
        with _for(shown, frozenset({"png"})):
            numbers.own(
                "Hung for [s]",
                (0, 3600),
                lambda: session.settings.time,
                lambda time: session.adjust(time=float(time)),
            )
        with _for(shown, PICTURES):
            _picks(session, controls, "Samples", "samples", SAMPLES)
            _picks(session, controls, "Pixel art", "pixel", PIXELS)
            _background(session, controls)
            controls.switch(
                "Shadow",
                lambda: session.settings.shadow,
                lambda on: session.adjust(shadow=bool(on)),
            )
    fit()


@contextmanager
def _for(shown: list[tuple[ui.element, frozenset[str]]], kinds: frozenset[str]) -> Iterator[None]:
    """A group of options that is seen for these kinds only."""
    with ui.element("div").classes("export-group") as group:
        yield
    shown.append((group, kinds))


def _picks(
    session: Session, controls: Controls, label: str, option: str, choices: Mapping[Any, str]
) -> None:
    controls.select(
        label,
        choices,
        lambda: getattr(session.settings, option),
        lambda value: session.adjust(**{option: value}),
    )


def _width(session: Session) -> Callable[[float], None]:
    return lambda pixels: session.adjust(size=(int(pixels), session.settings.size[1]))


def _height(session: Session) -> Callable[[float], None]:
    return lambda pixels: session.adjust(size=(session.settings.size[0], int(pixels)))


def _background(session: Session, controls: Controls) -> None:
    """Transparent, or one colour."""
    kept = ["#a8c8e8"]

    def clear() -> bool:
        return session.settings.background == "transparent"

    def colour() -> str:
        if not clear():
            kept[0] = "#" + session.settings.background.removeprefix("#").lower()
        return kept[0]

    def paint(event: Any) -> None:
        if event.value and event.value != colour():
            with faults():
                session.adjust(background=str(event.value))

    def show() -> None:
        field.set_value(colour())
        field.set_visibility(not clear())

    controls.switch(
        "Transparent",
        clear,
        lambda on: session.adjust(background="transparent" if on else kept[0]),
    )
    field = ui.input("Background", value=colour(), on_change=paint).classes("control")
    field.props('type=color dense outlined debounce=200 aria-label="Colour of the background"')
    show()
    session.listen("settings", show)


class Numbers:
    """Fields for numbers."""

    def __init__(self, session: Session, show: Callable[[], None]) -> None:
        self._session, self._show = session, show

    def own(
        self,
        label: str,
        bounds: tuple[float, float],
        get: Callable[[], float],
        change: Callable[[float], object],
    ) -> None:
        """A number that is an option of the picture."""
        field = self._field(label, bounds, get, change)
        self._session.listen("settings", lambda: field.set_value(get()))

    def of(
        self,
        choice: Choice,
        name: str,
        label: str,
        bounds: tuple[float, float],
        *,
        whole: bool = False,
    ) -> None:
        """A number of the file alone."""

        def change(value: float) -> None:
            setattr(choice, name, int(value) if whole else float(value))
            self._show()

        self._field(label, bounds, lambda: getattr(choice, name), change)

    def _field(
        self,
        label: str,
        bounds: tuple[float, float],
        get: Callable[[], float],
        change: Callable[[float], object],
    ) -> ui.number:
        def changed(event: Any) -> None:
            # An empty field is one that is being typed in.
            if event.value is not None and event.value != get():
                with faults():
                    change(event.value)

        least, most = bounds
        field = ui.number(label, value=get(), min=least, max=most, on_change=changed)
        field.classes("control").props("dense outlined debounce=300")
        field.props["aria-label"] = label
        return field


def _button(session: Session, choice: Choice) -> None:
    """Export, with its progress, and a way to stop it."""
    own = exports_of(session)

    def start() -> None:
        with faults():
            own.start(order_of(session, choice), stem_of(session.sketch.title))
            timer.activate()
            follow()

    def stop() -> None:
        if own.current is not None:
            own.current.stop()

    def follow() -> None:
        work = own.current
        running = work is not None and work.state == "running"
        going.set_visibility(running)
        button.set_enabled(not running)
        if work is None:
            return
        bar.set_value(work.done / work.total)
        words.set_text(f"{work.done} of {work.total}" if work.done else "moving the cloth")
        if not running:
            timer.deactivate()
            finish(work)

    def finish(work: Export) -> None:
        if work.state == "failed":
            tell(shelf_of(session).in_plain_words(work.fault), "fault")
        elif work.state == "stopped":
            tell("Stopped; nothing was written")
        else:
            address = f"/export/{session.token}/{own.number}"
            size = work.path.stat().st_size
            link.set_text(f"{work.name}, {shown_size(size)}")
            link.props["href"] = address
            link.set_visibility(True)
            ui.download.from_url(address)

    with ui.element("div").classes("export-go"):
        button = ui.button("Export", icon="download", on_click=start).props("no-caps unelevated")
        link = ui.link("", "#").classes("export-link").props("download")
        link.set_visibility(False)
    with ui.element("div").classes("export-going").props('role="status"') as going:
        bar = ui.linear_progress(0.0, show_value=False).props('aria-label="Progress"')
        words = ui.label("").classes("hint")
        ui.button("Cancel", icon="close", on_click=stop).props("flat dense no-caps")
    going.set_visibility(False)
    timer = ui.timer(TICK, follow, active=False)


def shown_size(count: int) -> str:
    """`12.3 kB`, as file managers say it."""
    if count < 1000:
        return f"{count} bytes"
    return f"{count / 1000:.1f} kB" if count < 1_000_000 else f"{count / 1_000_000:.1f} MB"


def _copies(session: Session, choice: Choice) -> Callable[[], None]:
    """The link, the command and the lines of Python; the callable writes them anew."""
    request = ui.context.client.request
    base = str(request.base_url)
    link = copy_field("Share link: the whole design, without packs")
    command = copy_field("Command that makes this file", rows=2)
    python = copy_field("Python that makes this file", rows=4)

    def show() -> None:
        called = shelf_of(session).called
        stem = stem_of(session.sketch.title)
        try:
            order = order_of(session, choice)
            link(f"{base}?d={write_link(session.sketch, session.settings)}")
            command(as_command(order, called, stem))
            python(as_python(order, called, stem))
        except DraperyError as error:
            tell(str(error), "fault")

    return show


def _keep_address(session: Session) -> None:
    """Let the page's address follow the design, so that loading it again brings all back."""
    written = [write_link(session.sketch, session.settings)]

    def tidy() -> None:
        word = write_link(session.sketch, session.settings)
        if word != written[0]:
            written[0] = word
            ui.run_javascript(f"history.replaceState(history.state, '', '?d={word}')")

    ui.timer(TIDY, tidy)
