"""The small pictures of packs are true to the texel, whatever the packs' sizes."""

from pathlib import Path

import numpy as np
import pytest
from pack_maker import BANNER, META, NEW_BASE, mcmeta, noise, png, zip_pack

from drapery.banner.design import Banner, Layer
from drapery.banner.packs import Packs, open_packs
from drapery.banner.packs.png import read_png
from drapery.errors import OptionError, PackError
from drapery.settings import Settings
from drapery.studio.art import (
    THUMBNAIL_SCALE,
    face_png,
    style_png,
)
from drapery.studio.pack_store import PackContents
from drapery.studio.session import Session

NAMES = ("creeper", "border", "gradient")


@pytest.fixture(params=[(32, 64), (128, 64), (64, 256), (96, 64)])
def packs(request: pytest.FixtureRequest, tmp_path: Path) -> Packs:
    side, base = request.param
    sheets = {f"{BANNER}{name}.png": png(noise(n, side)) for n, name in enumerate(NAMES)}
    files = {META: mcmeta(), NEW_BASE: png(noise(9, base)), **sheets}
    return open_packs([zip_pack(tmp_path / "pack.zip", files)])


@pytest.mark.parametrize("kind", ["banner", "shield"])
def test_a_thumbnail_is_the_face_made_small(kind, packs: Packs) -> None:
    banner = Banner("red", (Layer("creeper", "lime"),), kind)
    face = read_png(face_png(banner, packs), "face")
    small = read_png(face_png(banner, packs, THUMBNAIL_SCALE), "small")
    assert small.shape == (face.shape[0] // 4, face.shape[1] // 4, 4)
    np.testing.assert_array_equal(small, face[2::4, 2::4])


def test_a_pack_has_the_warnings_of_the_commands_and_the_format_is_chosen(tmp_path: Path) -> None:
    mask = np.zeros((64, 64, 4), np.uint8)
    mask[..., :3], mask[8:20, 8:20, :3], mask[..., 3] = 0, 255, 255
    files = {META: mcmeta(), f"{BANNER}creeper.png": png(mask)}
    path = zip_pack(tmp_path / "old.zip", files)
    session = Session(Settings(packs=(path,)))
    store, notified = session.pack_store, []
    session.listen(lambda: notified.append(store.entries[0].contents), "packs")

    def warnings(format: int | None) -> tuple[str, ...]:
        store.read_as(format, store.contents_as(format))
        return store.entries[0].contents.warnings

    assert ["use format 4" in line for line in warnings(None)] == [True]
    assert warnings(4) == ()
    assert session.settings.format == 4
    with pytest.raises(PackError):
        warnings(-3)
    assert session.settings.format == 4
    assert [len(contents.warnings) for contents in notified] == [1, 0]
    session.close()


def test_a_pack_with_a_broken_sheet_for_shields_is_refused(tmp_path: Path) -> None:
    from drapery.studio.pack_store import contents_of

    files = {META: mcmeta(), "assets/minecraft/textures/entity/shield/creeper.png": b"broken"}
    path = zip_pack(tmp_path / "a.zip", files)
    with pytest.raises(PackError, match=r"shield/creeper\.png is not a PNG file"):
        contents_of(path, "a.zip", None)


def test_no_pack_is_read_before_the_page_is_there(tmp_path: Path) -> None:
    """A pack with which the studio was started is read whole in a thread, as one that is sent."""
    files = {META: mcmeta(), f"{BANNER}creeper.png": png(noise(1, 64))}
    session = Session(Settings(packs=(zip_pack(tmp_path / "pack.zip", files),)))
    (entry,) = session.pack_store.entries
    assert entry.contents == PackContents()
    assert session.pack_store.contents_as(None) == {entry.number: PackContents("Patterns: 1")}
    session.close()


def test_a_style_is_not_drawn_for_a_page_that_is_gone() -> None:
    with pytest.raises(OptionError, match="the page is gone"):
        style_png(Banner("red"), open_packs(()), "game", lambda: False)
