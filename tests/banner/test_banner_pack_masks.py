"""Masks from before 1.15 are told from present sheets by a vote of the pack's sheets."""

from pathlib import Path

import numpy as np
import pytest
from pack_maker import BANNER, META, OLD_BASE, SHIELD, folder_pack, mcmeta, noise, plain, png

from drapery.banner.packs import Packs, open_packs
from drapery.banner.packs.contents import describe_packs

NAMES = ("creeper", "flower", "mojang", "skull", "cross")


def mask(number: int, translucent: int = 0) -> np.ndarray:
    """Opaque black with a white disc; some texels above the disc are translucent."""
    y, x = np.mgrid[:64, :64]
    sheet = np.zeros((64, 64, 4), np.uint8)
    sheet[..., 3] = 255
    sheet[(x - 11) ** 2 + (y - 20) ** 2 < (5 + number) ** 2, :3] = 255
    sheet[0, :translucent] = 120
    return sheet


def present(number: int) -> np.ndarray:
    """White cloth with a disc as its alpha; every third has soft edges."""
    sheet = np.full((64, 64, 4), 240, np.uint8)
    shape = mask(number)[..., 0]
    sheet[..., 3] = np.where(shape > 0, 255, 0)
    if number % 3 == 0:
        sheet[30:, ..., 3] = np.linspace(0, 255, 34).astype(np.uint8)[:, None]
    return sheet


def pack(path: Path, sheets: dict[str, np.ndarray], format: int | None, kind: str = BANNER) -> Path:
    meta = {} if format is None else {META: mcmeta(format)}
    base = noise(1)
    base[..., 3] = 255
    files = {f"{kind}{name}.png": png(sheet) for name, sheet in sheets.items()}
    return folder_pack(path, {OLD_BASE: png(base), **files, **meta})


def alphas(packs: Packs, names: tuple[str, ...] = NAMES) -> list[bool]:
    """Whether each sheet shows through at its right end, which no disc reaches."""
    return [bool(packs.sheet(name)[10, 60, 3] == 0) for name in names]


@pytest.mark.parametrize("format", [1, 4, None])
def test_a_few_translucent_texels_do_not_turn_a_mask_black(
    tmp_path: Path, format: int | None
) -> None:
    sheets = {name: mask(n, 16 if n in (1, 2) else 0) for n, name in enumerate(NAMES)}
    packs = open_packs([pack(tmp_path, sheets, format)])
    assert alphas(packs) == [True] * 5
    assert packs.sheet("flower")[0, :16, 3].tolist() == [120] * 16
    assert not any("black" in line for line in packs.warnings())


@pytest.mark.parametrize("format", [1, None])
def test_present_art_in_a_pack_of_an_old_format_is_read_as_it_is(
    tmp_path: Path, format: int | None
) -> None:
    sheets = {name: present(n) for n, name in enumerate(NAMES)}
    packs = open_packs([pack(tmp_path, sheets, format)])
    for name, sheet in sheets.items():
        assert (packs.sheet(name) == sheet).all(), name
    notes = [line for line in packs.warnings() if "format 1" in line]
    assert len(notes) == (format == 1)
    assert all(str(tmp_path) in line and "use format 4" in line for line in notes)


def test_a_given_format_overrules_the_vote(tmp_path: Path) -> None:
    old = pack(tmp_path / "old", {name: mask(n) for n, name in enumerate(NAMES)}, 4)
    new = pack(tmp_path / "new", {name: present(n) for n, name in enumerate(NAMES)}, 1)
    opaque = open_packs([old], format=46)
    assert alphas(opaque) == [False] * 5 and "black" in opaque.warnings()[0]
    masked = open_packs([new], format=4)
    assert (masked.sheet("creeper")[..., 3] == np.where(present(0)[..., 3] > 0, 240, 0)).all()


def test_sheets_that_tell_nothing_follow_the_format(tmp_path: Path) -> None:
    grey = np.zeros((64, 64, 4), np.uint8)
    grey[10:30, 5:15] = (100, 100, 100, 255)
    for format, alpha in ((3, 100), (None, 255), (5, 255)):
        packs = open_packs([pack(tmp_path / str(format), {"creeper": grey}, format)])
        assert packs.sheet("creeper")[20, 10, 3] == alpha, format


def test_a_pack_of_a_newer_format_is_drawn_as_the_game_draws_it(tmp_path: Path) -> None:
    packs = open_packs([pack(tmp_path, {n: mask(i) for i, n in enumerate(NAMES)}, 5)])
    assert alphas(packs) == [False] * 5


def test_banners_and_shields_vote_apart_and_broken_sheets_do_not_vote(tmp_path: Path) -> None:
    path = pack(tmp_path, {name: mask(n) for n, name in enumerate(NAMES)}, 2)
    pack(tmp_path, {name: present(n) for n, name in enumerate(NAMES)}, 2, SHIELD)
    folder_pack(tmp_path, {BANNER + "border.png": b"broken", SHIELD + "border.png": b"broken"})
    packs = open_packs([path])
    assert alphas(packs) == [True] * 5
    assert (packs.sheet("creeper", "shield") == present(0)).all()


def test_the_report_says_how_the_sheets_were_read(tmp_path: Path) -> None:
    new = pack(tmp_path / "new", {name: present(n) for n, name in enumerate(NAMES)}, 1)
    (report,) = describe_packs([new])
    assert any("not masks" in line for line in report.notes)
    (plain_report,) = describe_packs([folder_pack(tmp_path / "b", {OLD_BASE: plain(1, 1, 1, 255)})])
    assert plain_report.notes == ()
