"""From a picture to a design: drop a picture, watch the candidates improve, and open one."""

from collections.abc import Iterator
from functools import partial
from pathlib import Path

from nicegui import context, ui
from starlette.concurrency import run_in_threadpool

from drapery import Banner, DraperyError
from drapery.banner import LOOM_LAYERS
from drapery.file_formats import endings_read
from drapery.match import (
    PICTURE_FORMATS,
    Match,
    Matcher,
    MatchProgress,
    fit_picture,
    match_photo,
    read_picture,
)
from drapery.packs import Packs
from drapery.studio.descriptions import described
from drapery.studio.design_buttons import DesignButton, DesignList
from drapery.studio.file_field import FileField
from drapery.studio.panels.fields import Fields
from drapery.studio.session import Session
from drapery.studio.sketch import sketch_of
from drapery.studio.translation import translated
from drapery.studio.widgets import text_element, translated_text

COUNT = 6
"""The most candidates."""
EFFORT = 12
"""How many designs are changed at random and improved: a few seconds."""


def build(session: Session) -> None:
    """A field for a picture, and the candidates."""
    client, fields = context.client, Fields(session)
    is_photo = False
    newest = 0

    def set_photo(on: bool) -> None:
        nonlocal is_photo
        is_photo = on

    async def take(number: int) -> None:
        nonlocal newest
        newest = number
        upload = session.uploads.get(number, "picture")
        status.set_text(translated(f"Looking for designs like {upload.name} …"))
        try:
            states = _states(upload.path, upload.name, session.packs(), is_photo)
            shown: tuple[Match, ...] = ()
            while (state := await run_in_threadpool(next, states, None)) is not None:
                if session.closed or newest != number:
                    return
                if state.matches != shown:
                    shown = state.matches
                    with client:
                        _show(session, candidates, shown)
            line = f"The designs most like {upload.name}: click one to open it."
            with client:
                status.set_text(translated(line))
        except DraperyError:
            status.set_text("")
            raise
        finally:
            session.uploads.remove(number)

    translated_text("Picture", "h2").classes("heading")
    FileField(
        session,
        "picture",
        "Drop a picture here, or choose one",
        take,
        endings=",".join(endings_read(PICTURE_FORMATS)),
        tab="picture",
    )
    with ui.element("div").classes("options"):
        fields.tick("It is a photo of a banner: set it upright", lambda: is_photo, set_photo)
    status = text_element("", "p").classes("hint").props('role="status"')
    row = ui.element("div").classes("letters candidates").props('role="group"')
    row.props["aria-label"] = translated("Candidates")
    candidates = DesignList(row)


def _states(path: Path, name: str, packs: Packs, is_photo: bool) -> Iterator[MatchProgress]:
    """The states of the search for a picture's designs. Raises OptionError or PackError."""
    try:
        pixels = read_picture(path)
    except DraperyError as error:  # it names the file as it is stored here
        raise type(error)(str(error).replace(path.name, name)) from None
    if is_photo:
        yield MatchProgress(1.0, tuple(match_photo(pixels, packs=packs)))
        return
    seen = fit_picture(pixels, name=name)
    yield from Matcher(packs).iter_matches(
        seen.face, weights=seen.weights, layers=LOOM_LAYERS, alternatives=COUNT, effort=EFFORT
    )


def _show(session: Session, candidates: DesignList, matches: tuple[Match, ...]) -> None:
    def candidate(number: int, banner: Banner) -> DesignButton:
        words = f"{number}: {described(sketch_of(banner))}"
        return DesignButton(session, "found", banner, label=words, side=50)

    numbered = [(number, match.banner) for number, match in enumerate(matches, 1)]
    candidates.show({each: partial(candidate, *each) for each in numbered})
