"""Words as rows of banners."""

from pathlib import Path

import numpy as np
import pytest
from conftest import Run

from drapery import Banner
from drapery.banner import (
    LOOM_LAYERS,
    Layer,
    letter_banners,
    letter_characters,
    read_designs,
    simplify,
)
from drapery.banner.letters import MAX_LETTERS
from drapery.errors import DesignError
from drapery.packs import open_packs
from drapery.pictures import face_pixels
from drapery.sheets import cloth_row, faces_row

EVERY = letter_characters()


def test_letters_digits_and_punctuation_have_designs() -> None:
    assert EVERY.startswith("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789")
    assert set(".,!?-+=/:'\"") < set(EVERY)


def test_every_design_can_be_made_at_a_loom() -> None:
    assert all(len(banner.layers) <= LOOM_LAYERS for banner in letter_banners(EVERY))


def test_no_layer_of_a_design_is_hidden() -> None:
    packs = open_packs(())
    assert [simplify(banner, packs) for banner in letter_banners(EVERY)] == list(
        letter_banners(EVERY)
    )


def test_no_two_characters_look_alike() -> None:
    packs = open_packs(())
    faces = np.stack([face_pixels(one, packs, 1)[..., 0] for one in letter_banners(EVERY)])
    for number, face in enumerate(faces):
        apart = np.abs(faces.astype(int) - face).mean(axis=(1, 2))
        apart[number] = 255
        assert apart.min() > 4.5, (EVERY[number], EVERY[int(apart.argmin())])


def test_any_two_dyes_and_a_border() -> None:
    plain = letter_banners("L", ink="red", ground="blue", border="none")
    assert plain == (Banner("blue", (Layer("stripe_left", "red"), Layer("stripe_bottom", "red"))),)
    framed = letter_banners("L", ink="red", ground="blue", border="lime")
    assert framed[0].layers == (*plain[0].layers, Layer("border", "lime"))


def test_a_space_is_plain_and_signs_have_plainer_ones() -> None:
    assert letter_banners("a b")[1] == Banner("white")
    assert letter_banners("a b", border="red")[1] == Banner("white", (Layer("border", "red"),))
    assert letter_banners("’–”") == letter_banners("'-\"")


@pytest.mark.parametrize(
    ("text", "line"),
    [
        (" ", "the text is empty"),
        ("héllo", "no letter for 'É'; use A to Z, 0 to 9"),
        ("Привет", "no letter for 'П'"),
        ("A" * (MAX_LETTERS + 1), "write at most 200 at once"),
        ("A\nB", r"no letter for '\\n'"),
    ],
)
def test_texts_without_banners_are_refused(text: str, line: str) -> None:
    with pytest.raises(DesignError, match=line) as caught:
        letter_banners(text)
    assert len(str(caught.value).splitlines()) == 1


def test_a_text_has_a_largest_length() -> None:
    assert len(letter_banners("A" * MAX_LETTERS)) == MAX_LETTERS
    with pytest.raises(DesignError):
        letter_banners("A" * (MAX_LETTERS + 1))


def test_ink_and_ground_differ() -> None:
    with pytest.raises(DesignError, match="both white"):
        letter_banners("A", ink="white")
    with pytest.raises(DesignError, match="ink"):
        letter_banners("A", ink="bluu")


def test_a_row_has_all_faces_in_order() -> None:
    packs = open_packs(())
    banners = letter_banners("HI")
    row = faces_row(banners, packs, scale=2).pixels
    assert row.shape == (80, 84, 4) and not row[:, 40:44].any()
    np.testing.assert_array_equal(row[:, 44:], face_pixels(banners[1], packs, 2))


def test_the_command_prints_draws_and_writes_blocks(drapery: Run, tmp_path: Path) -> None:
    code, out, _ = drapery("letters", "hi", "--as", "give")
    assert code == 0 and len(out.splitlines()) == 2 and out.startswith("/give")
    picture, blocks = tmp_path / "row.png", tmp_path / "row.schem"
    assert drapery("letters", "HI", "-o", picture, "--scale", 1) == (0, "", "")
    assert picture.exists()
    assert drapery("letters", "hi", "-o", picture, "--scale", 1, "--as", "give") == (0, out, "")
    assert drapery("letters", "HI", "-o", blocks)[0] == 0
    assert [found.banner for found in read_designs(str(blocks))] == list(letter_banners("HI"))


def test_a_bad_word_is_one_line(drapery: Run, tmp_path: Path) -> None:
    for words in (
        ["Ж"],
        ["A", "--ink", "white"],
        ["A", "-o", tmp_path / "a.bmp"],
        ["A", "--as", "x"],
    ):
        code, _, err = drapery("letters", *words)
        assert code == 2 and len(err.splitlines()) == 1


def test_cloth_stands_side_by_side() -> None:
    from drapery import Settings

    chosen = Settings(size=(32, 48), view="front", pose="vanilla")
    row = cloth_row(letter_banners("HI"), chosen).pixels
    assert row.shape == (48, 64, 4) and row[:, :32].any() and row[:, 32:].any()
