"""From a picture to a design: drop a picture, watch the candidates improve, and open one.

Of a photo in which no flag is found, the user clicks the corners.
"""

from collections.abc import Iterator, Sequence
from functools import partial
from pathlib import Path

from nicegui import context, ui
from starlette.concurrency import run_in_threadpool

from drapery import DraperyError, OptionError
from drapery.arrays import Texels
from drapery.banner import LOOM_LAYERS
from drapery.file_formats import endings_read
from drapery.match import (
    PICTURE_FORMATS,
    Match,
    Matcher,
    MatchProgress,
    fit_picture,
    match_photo,
    read_pixels,
)
from drapery.packs import Packs
from drapery.studio.design_buttons import DesignButton
from drapery.studio.file_field import FileField
from drapery.studio.notices import errors_shown
from drapery.studio.panels.fields import Fields
from drapery.studio.photo_corners import Corner, PhotoCorners
from drapery.studio.session import Session
from drapery.studio.translation import translated
from drapery.studio.widgets import KeptElements, text_element, translated_text

COUNT = 6
"""The most candidates."""
EFFORT = 12
"""How many designs are changed at random and improved: a few seconds."""
CLOSENESS = {0.01: "the same", 0.05: "very close", 0.12: "close"}
"""Words for the error of a match that is at most so large."""
NO_FLAG = (
    "No flag was found: click its corners on the picture, first upper left, then upper right, lower"
    " right and lower left."
)


def build(session: Session) -> None:
    """A field for a picture, the picture, and the candidates."""
    client, fields = context.client, Fields(session)
    is_photo = False
    searches = 0  # those begun so far; an earlier one ends when the next begins
    shown: tuple[Texels, str] | None = None

    def set_photo(on: bool) -> None:
        nonlocal is_photo
        is_photo = on

    def say(line: str) -> None:
        with client:  # says the language
            status.set_text(translated(line))

    async def take(number: int) -> None:
        nonlocal shown
        upload = session.uploads.get(number, "picture")
        try:
            pixels = await run_in_threadpool(_read, upload.path, upload.name)
        finally:
            session.uploads.remove(number)
        shown = pixels, upload.name
        with client:
            photo.show(*shown)
        await search()

    async def search(corners: Sequence[Corner] | None = None) -> None:
        nonlocal searches
        searches += 1
        mine = searches
        assert shown is not None
        pixels, name = shown
        say(f"Looking for designs like {name} …")
        states = _states(pixels, name, session.packs(), is_photo or corners is not None, corners)
        matches: tuple[Match, ...] = ()
        try:
            while (state := await run_in_threadpool(next, states, None)) is not None:
                if session.closed or searches != mine:
                    return
                if state.matches != matches:
                    matches = state.matches
                    with client:
                        _show(session, candidates, matches)
            line = f"The designs most like {name}: click one to open it."
        except DraperyError as error:
            if corners is not None or not is_photo or not isinstance(error, OptionError):
                say("")
                raise
            line = NO_FLAG
        say(line)

    async def take_corners(corners: Sequence[Corner]) -> None:
        with client, errors_shown():
            await search(corners)

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
    photo = PhotoCorners(take_corners)
    row = ui.element("div").classes("letters candidates").props('role="group"')
    row.props["aria-label"] = translated("Candidates")
    candidates: KeptElements[DesignButton] = KeptElements(row)


def _read(path: Path, name: str) -> Texels:
    """The pixels of a picture. Raises OptionError with the user's name of the file."""
    try:
        return read_pixels(path)
    except DraperyError as error:  # it names the file as it is stored here
        raise type(error)(str(error).replace(path.name, name)) from None


def _states(
    pixels: Texels,
    name: str,
    packs: Packs,
    is_photo: bool,
    corners: Sequence[Corner] | None,
) -> Iterator[MatchProgress]:
    """The states of the search for a picture's designs. Raises OptionError or PackError."""
    if is_photo:
        yield MatchProgress(1.0, tuple(match_photo(pixels, corners, packs=packs)))
        return
    seen = fit_picture(pixels, name=name)
    yield from Matcher(packs).iter_matches(
        seen.face, weights=seen.weights, layers=LOOM_LAYERS, alternatives=COUNT, effort=EFFORT
    )


def closeness(match: Match) -> str:
    """How close a design is to the picture, in words."""
    return next((words for most, words in CLOSENESS.items() if match.error <= most), "similar")


def _show(
    session: Session, candidates: KeptElements[DesignButton], matches: tuple[Match, ...]
) -> None:
    def candidate(number: int, match: Match) -> DesignButton:
        text = translated(closeness(match))
        return DesignButton(session, "found", match.banner, label=str(number), text=text, side=50)

    numbered = enumerate(matches, 1)
    candidates.show(
        {
            (number, match.banner, closeness(match)): partial(candidate, number, match)
            for number, match in numbered
        }
    )
