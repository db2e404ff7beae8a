"""A key stands for the bytes of a picture: for what it is made of, not for how it was asked for."""

import importlib
import shutil
import sys
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from conftest import GIVE
from hypothesis import given, strategies as st
from pack_maker import CREEPER, make_pack, plain

from drapery.banner.design import Banner
from drapery.batch import keys
from drapery.batch.keys import DigestCache, code_version, picture_key
from drapery.errors import PackError
from drapery.settings import LoopSettings, Settings

SHORT = "white creeper:lime border:black"


def key(design: str = SHORT, ending: str = ".png", timing=None, **options) -> str:
    settings = Settings(**options)
    return picture_key(Banner.parse(design), settings, DigestCache(), ending=ending, timing=timing)


def test_the_spelling_of_a_design_does_not_count() -> None:
    assert key(GIVE) == key(SHORT)
    assert len(key()) == 64


CHANGES = [
    {"design": "white creeper:lime"},
    {"ending": ".webp"},
    {"ending": ".gif", "timing": LoopSettings(4.0, 20.0)},
    {"ending": ".gif", "timing": LoopSettings(4.0, 10.0)},
    {"wind": 5.0},
    {"size": (512, 511)},
    {"format": 46},
    {"pose": "vanilla"},
]


def test_every_part_counts() -> None:
    made = [key(), *(key(**change) for change in CHANGES)]
    assert len(set(made)) == len(made)


def test_a_given_light_and_ground_count_though_the_view_has_the_same() -> None:
    """A style has its own light, and a shield stands on what is given alone."""
    assert key(view="hero", style="ink") != key(view="hero", style="ink", light="studio")
    shield = {"view": "hero", "kind": "shield"}
    assert key(**shield) != key(**shield, ground="grass")


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


SPARKLE = """
from drapery.styles import Style, StyleStep

def brighter(canvas):
    return canvas

def wireframe(scene):
    return {!r}

sparkle = Style("sparkle", (StyleStep("picture", brighter),))
"""
ENTRIES = """
[drapery.styles]
sparkle = sparkle_code:sparkle
[drapery.backends]
wireframe = sparkle_code:wireframe
"""


@pytest.fixture
def added(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Callable[[str, str], None]]:
    """A function that installs a package with a style and a backend, as of a new process."""
    monkeypatch.syspath_prepend(str(tmp_path))

    def install(version: str, code: str) -> None:
        folder = tmp_path / "sparkle.dist-info"
        folder.mkdir(exist_ok=True)
        about = f"Metadata-Version: 2.1\nName: sparkle\nVersion: {version}\n"
        (folder / "METADATA").write_text(about, encoding="utf-8")
        (folder / "entry_points.txt").write_text(ENTRIES, encoding="utf-8")
        (folder / "top_level.txt").write_text("sparkle_code\n", encoding="utf-8")
        package = tmp_path / "sparkle_code"
        package.mkdir(exist_ok=True)
        (package / "__init__.py").write_text(SPARKLE.format(code), encoding="utf-8")
        forget()

    def forget() -> None:
        sys.modules.pop("sparkle_code", None)
        shutil.rmtree(tmp_path / "sparkle_code" / "__pycache__", ignore_errors=True)
        importlib.invalidate_caches()
        keys.code_of.cache_clear()

    yield install
    forget()


@pytest.mark.parametrize("option", [{"style": ("sparkle",)}, {"backend": "wireframe"}])
def test_the_code_of_other_packages_counts_where_it_draws(
    option: dict[str, Any], added: Callable[[str, str], None]
) -> None:
    plain, made = key(), []
    for release, code in (("1.0", "1"), ("1.0", "1"), ("1.0", "2"), ("1.1", "2")):
        added(release, code)
        made.append(key(**option))
        assert key() == plain
    assert made[0] == made[1]
    assert len(set(made)) == 3


def test_the_version_is_one_for_the_same_code() -> None:
    assert code_version() == code_version.__wrapped__()
