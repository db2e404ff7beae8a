"""Garments of a tab's own: a file that is sent is checked, then shown as those of the package."""

import asyncio
from collections.abc import AsyncIterator, Iterator
from dataclasses import replace

import numpy as np
import pytest

from drapery import Banner
from drapery.errors import DesignError, OptionError
from drapery.garments import Garment, find_garment
from drapery.render import png_bytes
from drapery.studio.garment_store import MAX_FILES, MAX_PARTICLES
from drapery.studio.session import Session
from drapery.studio.snippets import (
    ExportRequest,
    as_command,
    as_python,
    drawn_garment,
    subject_of,
)

SHAWL = """\
description = "A shawl"
[[piece]]
name = "shawl"
size = [8, 8]
points = [3, 3]
place = [0, 20, 0]
[[pin]]
piece = "shawl"
at = "top"
"""


@pytest.fixture
def session() -> Iterator[Session]:
    opened = Session()
    yield opened
    opened.close()


def send(session: Session, text: str, name: str = "My Shawl.toml") -> int:
    async def pieces() -> AsyncIterator[bytes]:
        yield text.encode()

    return asyncio.run(session.uploads.receive(pieces(), "garment", name)).number


def test_a_file_is_found_by_its_path_as_is_one_sent_later(session: Session) -> None:
    path = session.garment_store.adopt(send(session, SHAWL), "garment")
    assert find_garment(path).name == "my-shawl"
    assert session.garment_store.titles("garment") == {path: "My Shawl.toml: A shawl"}
    session.viewport.update(garment=path)
    assert session.viewport.shown["note"] == "The garment my-shawl is getting ready."
    other = session.garment_store.adopt(send(session, SHAWL, "..toml"), "garment")
    assert [*session.garment_store.titles("garment")] == [path, other]


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("[8, 8]", "[8]", r"^My Shawl\.toml line 4: size has too few values"),
        ('at = "top"', 'at = "rim"', "piece shawl has no edge rim; use one of: top"),
        (
            "place = [0, 20, 0]",
            'texture = { file = "/etc/passwd" }',
            "names '/etc/passwd', which was not sent",
        ),
        (
            "[[pin]]",
            '[wearer]\nskin = "../me.png"\n[[pin]]',
            r"names '\.\./me\.png', which was not sent",
        ),
    ],
)
def test_a_file_that_cannot_be_used_is_refused_in_one_line(
    session: Session, old: str, new: str, said: str
) -> None:
    number = send(session, SHAWL.replace(old, new))
    with pytest.raises(OptionError, match=said) as caught:
        session.garment_store.adopt(number, "garment")
    assert "\n" not in str(caught.value) and str(session.folder) not in str(caught.value)
    assert not session.garment_store.titles("garment")
    with pytest.raises(DesignError, match="not here any more"):
        session.garment_store.adopt(number, "garment")


def test_a_garment_has_a_largest_size(session: Session) -> None:
    big = SHAWL.replace("[3, 3]", "[65, 65]")
    with pytest.raises(OptionError, match=f"has 4225 particles; use at most {MAX_PARTICLES}"):
        session.garment_store.adopt(send(session, big), "garment")
    with pytest.raises(DesignError, match=r"is over 65536 bytes; send a smaller one"):
        send(session, "#" * 70_000)


def test_a_tab_keeps_so_many_files(session: Session) -> None:
    for _ in range(MAX_FILES):
        session.garment_store.adopt(send(session, SHAWL), "garment")
    number = send(session, SHAWL)
    with pytest.raises(OptionError, match=f"this tab has {MAX_FILES} garments and skins"):
        session.garment_store.adopt(number, "garment")


def textures(request: ExportRequest) -> set[str]:
    """The sources of the textures of a garment and of what is over it."""
    garment = subject_of(request)
    assert isinstance(garment, Garment)
    worn = (garment, *garment.over)
    return {(each.texture or one.texture).source for one in worn for each in one.piece}


def test_a_skin_that_is_sent_becomes_a_player_with_the_design_on_its_head(
    session: Session,
) -> None:
    texels = np.full((64, 64, 4), 255, np.uint8)

    async def pieces(data: bytes) -> AsyncIterator[bytes]:
        yield data

    def upload(data: bytes) -> int:
        return asyncio.run(session.uploads.receive(pieces(data), "skin", "Me & I.png")).number

    path = session.garment_store.adopt(upload(png_bytes(texels)), "skin")
    request = ExportRequest(Banner.parse("red"), session.settings, garment="cape", skin=path)
    player = drawn_garment(request)
    assert player is not None and player.wearer is not None
    assert player.wearer.skin == path and player.wearer.head == Banner("red")
    assert [each.name for each in player.over] == ["cape"]
    command = as_command(request, session.garment_store.names)
    words = 'drapery player --skin "Me & I.png" --wear cape --head red --worn-design red -o'
    assert command.startswith(words)
    code = as_python(request, session.garment_store.names)
    assert (
        'player_of(PlayerSettings(skin="Me & I.png", wear=["cape"], head="red", worn_design="red"))'
        in code
    )
    bare = replace(request, banner=None)
    for name, shows in (("cape", True), ("elytra", True), ("tabard", True), ("dress", False)):
        dressed = replace(request, garment=name)
        same = subject_of(dressed) == subject_of(replace(dressed, banner=Banner("blue")))
        assert textures(dressed) == ({"design"} if shows else textures(replace(bare, garment=name)))
        assert not same  # the banner on the head is another
        alone = replace(dressed, skin=None)
        assert ("design" in textures(alone)) == shows
        assert ("--design red" in as_command(alone)) == shows
    for name, kind in (("tent", "tent"), ("caparison", "caparison")):  # no player wears these
        other = drawn_garment(replace(request, garment=name))
        assert other is not None and other.name == kind
    with pytest.raises(OptionError, match=r"Me & I\.png"):
        session.garment_store.adopt(upload(png_bytes(texels[:40])), "skin")
