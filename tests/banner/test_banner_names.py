"""Names of patterns and dyes: every tongue of the game comes to the same ids."""

import numpy as np
import pytest
from hypothesis import given, strategies as st

from drapery.banner.design import Banner, Layer
from drapery.banner.dyes import DYES
from drapery.banner.names import bukkit_pattern, dye_name, is_custom, pattern_id, shown
from drapery.banner.patterns import BY_CODE, PATTERN_NAMES, PATTERNS
from drapery.errors import DesignError

HERALDS_OTHER = {"Base": "base", "Cross": "cross"}
"""Titles that are spelt like the id of another pattern, which wins."""


def test_there_are_43_patterns_of_which_41_have_a_code():
    assert len(PATTERNS) == 43
    assert sorted(set(PATTERNS) - {p.name for p in BY_CODE.values()}) == ["flow", "guster"]
    assert len({p.title for p in PATTERNS.values()}) == 43


@pytest.mark.parametrize("name", PATTERN_NAMES)
def test_a_pattern_is_known_by_all_its_names(name: str):
    pattern = PATTERNS[name]
    for spelling in (name, f"minecraft:{name}", name.replace("_", " "), name.replace("_", "-")):
        assert pattern_id(spelling) == name
    assert pattern_id(name.title()) == name
    if pattern.code:
        assert pattern_id(pattern.code) == name
    if pattern.title not in HERALDS_OTHER:
        for title in (pattern.title, pattern.title.upper(), f" {pattern.title.lower()} "):
            assert pattern_id(title) == name
    assert pattern_id(bukkit_pattern(name), bukkit=True) == name


def test_titles_that_are_ids_are_the_ids():
    for title, name in HERALDS_OTHER.items():
        assert pattern_id(title) == name
    assert PATTERNS["stripe_bottom"].title == "Base"
    assert PATTERNS["straight_cross"].title == "Cross"


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("DIAGONAL_RIGHT", "diagonal_up_right"),
        ("diagonal_right", "diagonal_right"),
        ("DIAGONAL_LEFT_MIRROR", "diagonal_up_left"),
        ("DIAGONAL_RIGHT_MIRROR", "diagonal_right"),
        ("STRIPE_SMALL", "small_stripes"),
        ("RHOMBUS_MIDDLE", "rhombus"),
        ("CIRCLE_MIDDLE", "circle"),
        ("HALF_VERTICAL_MIRROR", "half_vertical_right"),
        ("HALF_HORIZONTAL_MIRROR", "half_horizontal_bottom"),
        ("flw", "flow"),
        ("gus", "guster"),
        ("Chief", "stripe_top"),
        ("Per  Bend Sinister", "diagonal_left"),
        ("Bordure Indented", "curly_border"),
        ("Snout", "piglin"),
        ("Thing", "mojang"),
        ("Field Masoned", "bricks"),
        ("acme:deep/anvil.1", "acme:deep/anvil.1"),
    ],
)
def test_names_of_other_tongues(name: str, expected: str):
    assert pattern_id(name) == expected


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        *(("light grey", "light_gray"), ("Grey", "gray"), ("silver", "light_gray")),
        *(("LIGHT_BLUE", "light_blue"), ("Light Blue", "light_blue"), ("minecraft:red", "red")),
        *((0, "white"), (15, "black"), (14, "red")),
    ],
)
def test_dyes(name: str | int, expected: str):
    assert dye_name(name) == expected


def test_the_numbers_of_dyes_turned_round_turn_back():
    for name, dye in DYES.items():
        assert dye_name(dye.number) == dye_name(15 - dye.number, inverted=True) == name


@pytest.mark.parametrize("value", [16, -1, None, True, 2.0, [], {}, "", "rde", "x" * 100_000])
def test_a_wrong_dye_is_refused_in_one_line_with_its_place(value: object):
    with pytest.raises(DesignError, match=r"^somewhere: ") as caught:
        dye_name(value, "somewhere")
    assert len(str(caught.value)) < 300 and "\n" not in str(caught.value)


@pytest.mark.parametrize("value", [5, None, [], "", "kreeper", "A:b", "a:", ":b", "x\n" * 50_000])
def test_a_wrong_pattern_is_refused_in_one_line_with_its_place(value: object):
    with pytest.raises(DesignError, match=r"^somewhere: ") as caught:
        pattern_id(value, "somewhere")
    assert len(str(caught.value)) < 300 and "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("name", "meant"),
    [
        ("creper", "creeper"),
        ("striped_top", "stripe_top"),
        ("per bend sinster", "per_bend_sinister"),
    ],
)
def test_a_slip_gets_a_hint(name: str, meant: str):
    with pytest.raises(DesignError, match=f"did you mean '{meant}'"):
        pattern_id(name)


@pytest.mark.parametrize("name", ["a:../b", "a:b/..", "a:/b", "a:b//c", "a/b:c", "..:b", "a:b\n"])
def test_a_data_packs_pattern_cannot_climb_out_of_its_folder(name: str):
    assert not is_custom(name)


@given(st.sampled_from(PATTERN_NAMES), st.sampled_from(list(DYES)))
def test_layers_and_banners_keep_ids_whatever_they_are_given(name: str, dye: str):
    title = PATTERNS[name].title
    if title not in HERALDS_OTHER:
        assert Layer(title, dye.upper()) == Layer(name, dye)
    assert Banner(dye.replace("_", " ")).base == dye


def test_a_banner_of_17_layers_is_refused():
    with pytest.raises(DesignError, match="17 layers"):
        Banner("white", (Layer("cross", "red"),) * 17)


@pytest.mark.parametrize("value", [-(10**400), "x\n" * 999, [1] * 999, np.eye(99), {1}])
def test_any_value_is_quoted_on_one_short_line(value: object):
    assert len(shown(value)) < 90 and "\n" not in shown(value)
    with pytest.raises(DesignError) as caught:
        Banner("white", (value,))
    assert len(str(caught.value)) < 150 and "\n" not in str(caught.value)
    with pytest.raises(DesignError):
        dye_name(value)
    assert shown(10**5000) == "a number of 16610 bits"
