"""A share link holds the whole design and its options, and nothing else that could hurt."""

import json
import zlib
from base64 import urlsafe_b64decode, urlsafe_b64encode
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, strategies as st

from drapery.banner.dyes import DYE_NAMES
from drapery.banner.formats.studio_link import MAX_JSON, MAX_LINK, VERSION
from drapery.banner.patterns import PATTERN_NAMES
from drapery.errors import DesignError
from drapery.settings import OPTIONS, Settings
from drapery.studio.session import Session
from drapery.studio.share import motion_of, opened_link, read_link, write_link
from drapery.studio.sketch import Sketch, Stroke
from drapery.styles import find_style, style_names

patterns = st.one_of(
    st.sampled_from(PATTERN_NAMES), st.sampled_from(("acme:x", "a_b:c/d.e", "x-y.z:_"))
)
pairs = st.lists(st.tuples(patterns, st.sampled_from(DYE_NAMES), st.booleans()), max_size=16)
titles = st.text(max_size=80).map(str.strip).filter(str.isprintable)
sketches = st.builds(
    Sketch,
    st.sampled_from(DYE_NAMES),
    pairs.map(lambda each: tuple(Stroke(*one) for one in each)),
    st.sampled_from(("banner", "shield")),
    titles,
)
all_settings = st.builds(
    Settings,
    format=st.none() | st.integers(1, 99),
    pose=st.sampled_from(("cloth", "vanilla")),
    rotation=st.integers(0, 15),
    view=st.sampled_from(OPTIONS["view"].choices),
    size=st.tuples(st.integers(1, 256), st.integers(1, 256)).map(lambda s: (s[0] * 4, s[1] * 4)),
    grid=st.tuples(st.integers(2, 129), st.integers(2, 129)),
    solver=st.sampled_from(("desbrun", "xpbd", "implicit")),
    wind=st.floats(0, 40),
    time=st.floats(0, 3600),
    seed=st.integers(0, 2**32 - 1),
    layers=st.sampled_from(("stacked", "flat")),
    thickness=st.floats(0, 8),
    background=st.sampled_from(("transparent", "#00ff7f")),
    samples=st.sampled_from((1, 4, 16)),
    pixel=st.sampled_from((1, 2, 4)),
    block_light=st.integers(0, 15),
    daylight=st.floats(0, 1),
    shadow=st.booleans(),
    style=st.lists(st.sampled_from(style_names()), max_size=3).map(tuple),
)
FULL = Sketch(
    "red", tuple(Stroke(PATTERN_NAMES[n + 3], DYE_NAMES[n]) for n in range(16)), "banner", "Flag"
)


@given(sketches, all_settings)
def test_what_is_read_is_what_was_written(sketch: Sketch, settings: Settings) -> None:
    link = write_link(sketch, settings)
    assert len(link) <= MAX_LINK
    assert read_link(link) == (sketch, settings)


def test_a_link_keeps_options_that_do_nothing_now() -> None:
    settings = Settings(placement="item", wind=9.0, view="iso")
    assert read_link(write_link(FULL, settings))[1] == settings


def test_a_link_is_short_and_needs_no_quoting() -> None:
    link = write_link(FULL, Settings(view="iso", wind=7.5))
    assert len(link) < 600
    assert link.isascii() and link.replace("-", "").replace("_", "").isalnum()


def test_strokes_are_numbered_anew() -> None:
    sketch = Sketch("red", (Stroke("creeper", "lime"), Stroke("border", "black", True)))
    read, _ = read_link(write_link(sketch, Settings()))
    assert read == sketch


def test_files_stay_behind(tmp_path: Path) -> None:
    settings = Settings(packs=(tmp_path,), texture=tmp_path / "cape.png", backend="soft", wind=3.0)
    link = write_link(FULL, settings)
    assert str(tmp_path).encode() not in zlib.decompress(urlsafe_b64decode(link[1:] + "=="))
    assert read_link(link)[1] == Settings(wind=3.0)


def test_a_link_without_styles_reads_as_before_and_leaves_styles_that_it_cannot_name() -> None:
    link = made(GOOD | {"options": {"wind": 3.0}})
    assert read_link(link)[1] == Settings(wind=3.0)
    mine, cel = Path("my.toml"), find_style("cel")
    assert opened_link(Settings(style=(mine, "ink", cel)), link)[0].style == (mine, cel)
    written = write_link(FULL, Settings(style=(mine, "ink", cel, "other.toml")))
    assert read_link(written)[1].style == ("ink",)
    assert opened_link(Settings(style=(mine,)), written)[0].style == ("ink",)


def test_a_style_that_is_not_installed_is_left_out_with_a_warning() -> None:
    link = made(GOOD | {"options": {"style": ["sparkle", "cel"]}})
    with pytest.warns(UserWarning, match="'sparkle' of the link is not installed here"):
        _, settings = read_link(link)
    assert settings.style == ("cel",)


def test_a_link_is_laid_over_what_the_studio_was_started_with() -> None:
    own = Settings(packs=("a.zip",), format=46, wind=9.0, backend="soft")
    link = write_link(FULL, Settings(view="iso"))
    wanted = Settings(packs=("a.zip",), format=46, view="iso", backend="soft")
    merged, sketch = opened_link(own, link)
    assert merged == wanted and sketch.title == "Flag"
    assert opened_link(own, write_link(FULL, Settings(format=4)))[0].format == 4


def made(tree: Any) -> str:
    """A link of any JSON, as an ill-meaning person makes it."""
    data = tree if isinstance(tree, bytes) else json.dumps(tree).encode()
    return VERSION + urlsafe_b64encode(zlib.compress(data)).decode().rstrip("=")


GOOD: dict[str, Any] = {"base": "red", "layers": [{"pattern": "creeper", "color": "lime"}]}


@pytest.mark.parametrize(
    "options",
    [
        {"packs": ["/etc"]},
        {"texture": "/etc/passwd"},
        {"kind": "cape"},
        {"backend": "os"},
        {"style": ["/etc/my.toml"]},
        {"style": "cel"},
        {"style": [["cel"]]},
        {"style": ["cel"] * 17},
        {"__class__": 1},
        {"view": "../../x"},
        {"view": 5},
        {"size": [512]},
        {"size": "9999999x1"},
        {"size": [512.5, 3]},
        {"wind": "NaN"},
        {"wind": None},
        {"wind": 1e308},
        {"samples": 7},
        {"shadow": {"a": 1}},
        {"seed": -1},
        {"grid": [[1, 2], 3]},
        {"background": "url(http://x)"},
        ["wind"],
        7,
    ],
)
def test_options_are_checked(options: object) -> None:
    with pytest.raises(DesignError) as fault:
        read_link(made(GOOD | {"options": options}))
    assert "\n" not in str(fault.value)


@pytest.mark.parametrize(
    "change",
    [
        {"base": "mauve"},
        {"base": ["red"]},
        {"layers": [{"pattern": "creeper", "color": "lime"}] * 17},
        {"layers": "creeper"},
        {"layers": [{"pattern": "../../etc/passwd", "color": "lime"}]},
        {"layers": [{"pattern": "a:../b", "color": "lime"}]},
        {"kind": "cape"},
        {"title": "a\nb"},
        {"title": "x" * 81},
        {"title": 3},
        {"hidden": [1]},
        {"hidden": [True]},
        {"hidden": {"0": 1}},
        {"hidden": [-1]},
    ],
)
def test_designs_are_checked(change: dict[str, object]) -> None:
    with pytest.raises(DesignError) as fault:
        read_link(made(GOOD | change))
    assert "\n" not in str(fault.value)


@pytest.mark.parametrize(
    "link",
    [
        "",
        " ",
        "b" + write_link(FULL, Settings())[1:],
        "../../etc/passwd",
        write_link(FULL, Settings())[:-9],
        write_link(FULL, Settings()) + "AAAA",
        "a" * (MAX_LINK + 1),
        "aAAAA",
        made(b"[" * 9000),
        made(b"\xff\xfe"),
        made(b"null"),
        made([]),
        made({}),
    ],
)
def test_junk_is_one_line(link: str) -> None:
    with pytest.raises(DesignError) as fault:
        read_link(link)
    assert "\n" not in str(fault.value) and len(str(fault.value)) < 300


def test_a_bomb_does_not_unpack() -> None:
    bomb = made(b" " * (3 << 20))
    assert len(bomb) < MAX_LINK + 1000
    with pytest.raises(DesignError):
        read_link(bomb)
    small = made(b" " * (MAX_JSON + 1))
    assert len(small) < MAX_LINK
    with pytest.raises(DesignError, match=r"unpacks to over"):
        read_link(small)


@given(st.text(max_size=200))
def test_any_text_is_a_design_or_one_line(text: str) -> None:
    try:
        read_link(text)
    except DesignError as fault:
        assert "\n" not in str(fault)


@given(st.integers(0, 10_000), st.sampled_from("ABCxyz019-_"))
def test_a_link_with_a_wrong_letter_is_refused_or_the_same(place: int, letter: str) -> None:
    good = write_link(FULL, Settings(wind=2.0))
    place %= len(good)
    bad = good[:place] + letter + good[place + 1 :]
    try:
        # Some bits of the last character are not used.
        assert read_link(bad) == read_link(good)
    except DesignError:
        assert bad != good


def test_a_hidden_layer_counts_as_one_of_sixteen() -> None:
    hidden = replace(FULL, strokes=tuple(replace(s, hidden=True) for s in FULL.strokes))
    assert [s.hidden for s in read_link(write_link(hidden, Settings()))[0].strokes] == [True] * 16


def test_a_step_of_the_history_brings_back_the_options_that_it_had() -> None:
    session = Session(Settings(wind=9, view="hero", style=("cel",)))
    before = motion_of(session.settings)
    assert before == {"view": "hero", "wind": 9.0, "style": ["cel"]}
    session.adjust(wind=2, direction=90, time=1.5, format=46, placement="wall")
    session.move(before)
    assert motion_of(session.settings) == before
    kept = session.settings.time, session.settings.format  # of a pause, and of packs
    assert kept == (1.5, 46)
    with pytest.raises(DesignError, match="wind"):
        session.move({"wind": "strong"})
    with pytest.raises(DesignError, match="backend"):
        session.move({"backend": "metal"})
    assert motion_of(session.settings) == before
