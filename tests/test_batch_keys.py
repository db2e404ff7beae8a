"""A key stands for the bytes of a picture: for what it is made of, not for how it was asked for."""

import shutil
from dataclasses import replace
from pathlib import Path

import pytest
from conftest import GIVE
from hypothesis import given
from hypothesis import strategies as st
from pack_maker import CREEPER, META, mcmeta, plain

from drapery.banner.design import Banner
from drapery.batch.keys import DigestCache, code_version, picture_key
from drapery.errors import PackError
from drapery.settings import Settings

SHORT = "white creeper:lime border:black"


def key(design: str = SHORT, ending: str = ".png", times=(None, None), **options) -> str:
    seconds, fps = times
    settings = Settings(**options)
    return picture_key(
        Banner.parse(design), settings, DigestCache(), ending=ending, seconds=seconds, fps=fps
    )


def make_pack(folder: Path) -> Path:
    (folder / CREEPER).parent.mkdir(parents=True)
    (folder / META).write_bytes(mcmeta())
    (folder / CREEPER).write_bytes(plain(255, 255, 255, 255))
    return folder


def test_the_spelling_of_a_design_does_not_count() -> None:
    assert key(GIVE) == key(SHORT)
    assert len(key()) == 64


CHANGES = [
    {"design": "white creeper:lime"},
    {"ending": ".webp"},
    {"ending": ".gif", "times": (4.0, 20.0)},
    {"ending": ".gif", "times": (4.0, 10.0)},
    {"wind": 5.0},
    {"size": (512, 511)},
    {"format": 46},
    {"pose": "vanilla"},
]


def test_every_part_counts() -> None:
    keys = [key(), *(key(**change) for change in CHANGES)]
    assert len(set(keys)) == len(keys)


@given(st.integers(0, 1 << 20), st.floats(0, 40))
def test_equal_settings_have_equal_keys(seed: int, wind: float) -> None:
    settings = Settings(seed=seed, wind=wind)
    assert key(seed=seed, wind=wind) == key(seed=seed, wind=replace(settings).wind)


def test_of_a_pack_its_bytes_count_and_not_its_name(tmp_path: Path) -> None:
    first = make_pack(tmp_path / "first")
    shutil.copytree(first, tmp_path / "second")
    before = key(packs=[first])
    assert before == key(packs=[tmp_path / "second"]) != key()
    (first / CREEPER).write_bytes(plain(254, 255, 255, 255))
    assert before != key(packs=[first])


def test_a_pack_that_is_gone_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(PackError, match="check the path"):
        DigestCache().of(tmp_path / "none.zip")


def test_the_version_is_one_for_the_same_code() -> None:
    assert code_version() == code_version.__wrapped__()
