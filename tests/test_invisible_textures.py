"""A texture that is transparent where it is used is said, by every way to draw it."""

import warnings
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from drapery import draw
from drapery.garments import dressed_player, find_garment, make_wearer, tailor
from drapery.packs import open_packs
from drapery.style.visible import is_invisible

PARTS = {"cape": np.s_[0:17, 0:22], "elytra": np.s_[0:22, 22:46]}
"""Where each lies on a sheet of 64 x 32 texels: rows and columns."""
OTHER = {"cape": "elytra", "elytra": "cape"}


@pytest.fixture
def sheet(tmp_path: Path) -> Callable[[str], Path]:
    """The file of a texture on which only the cape or the elytra are drawn."""

    def write(drawn: str) -> Path:
        texels = np.zeros((32, 64, 4), np.uint8)
        texels[PARTS[drawn]] = 200, 40, 40, 255
        path = tmp_path / f"only-{drawn}.png"
        Image.fromarray(texels).save(path)
        return path

    return write


@pytest.mark.parametrize("kind", ["cape", "elytra"])
def test_a_kind_that_its_texture_does_not_show_is_said(
    kind: str, sheet: Callable[[str], Path]
) -> None:
    small = {"kind": kind, "size": (24, 24)} | ({"time": 0.5} if kind == "cape" else {})
    with pytest.warns(UserWarning, match=f"its part for kind {kind}, from ") as caught:
        frame = draw(texture=sheet(OTHER[kind]), **small)  # type: ignore[arg-type]
    assert not frame.pixels[..., 3].any() and len(caught) == 1
    with warnings.catch_warnings(action="error"):
        assert draw(texture=sheet(kind), **small).pixels[..., 3].any()  # type: ignore[arg-type]


@pytest.mark.parametrize("worn", ["cape", "elytra"])
def test_a_player_whose_cape_cannot_be_seen(worn: str, sheet: Callable[[str], Path]) -> None:
    def dress(drawn: str) -> None:
        player = dressed_player(make_wearer(), cape=sheet(drawn), elytra=worn == "elytra")
        tailor(player, open_packs(()))

    said = rf"garment {worn}: texture '.*only-{OTHER[worn]}\.png' is transparent where piece"
    with pytest.warns(UserWarning, match=said):
        dress(OTHER[worn])
    with warnings.catch_warnings(action="error"):
        dress(worn)


def test_a_garment_whose_file_cannot_be_seen(sheet: Callable[[str], Path]) -> None:
    cape = find_garment("cape").with_texture(sheet("elytra"))
    with pytest.warns(UserWarning, match="piece cape shows it"):
        tailor(cape, open_packs(()))


@pytest.mark.parametrize(
    "words",
    [
        ("render", "--kind", "elytra", "--texture"),
        ("player", "--elytra", "--time", "0", "--cape"),
    ],
)
def test_commands_print_one_line_for_each(
    words: tuple[str, ...], sheet: Callable[[str], Path], tmp_path: Path, drapery
) -> None:
    picture = tmp_path / "x.png"
    code, _, err = drapery(*words, sheet("cape"), "--size", "24x24", "-o", picture)
    lines = err.splitlines()
    assert code == 0 and picture.exists()
    assert 1 <= len(lines) <= 2 and all("is transparent" in line for line in lines)


def test_parts_of_textures() -> None:
    texels = np.zeros((8, 8, 4), np.uint8)
    texels[2, 3, 3] = 128
    assert is_invisible(texels, [(0, 0, 3 / 8, 1)])
    assert not is_invisible(texels, [(0, 0, 3.1 / 8, 1)])
    assert not is_invisible(texels, [(0, 0, 2 / 8, 1), (4 / 8, 3 / 8, 3 / 8, 2 / 8)])
    texels[2, 3, 3] = 127
    assert is_invisible(texels, [(0, 0, 1, 1)])
    texels[7, 7, 3] = 255
    assert not is_invisible(texels, [(1, 1, 1.5, 1.5)])
