"""Give commands with a player, a count, a name and lore, in the syntax of each version."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drapery import Banner, DesignError
from drapery.banner import GIVE_FORMS, ItemDetails, parse_banner, write_banner, write_give

BANNER = Banner.parse("red creeper:lime")
DETAILS = ItemDetails("@a[distance=..5]", 3, "Sea Star", ("one", "two"))


@pytest.mark.parametrize("form", GIVE_FORMS)
@pytest.mark.parametrize("design", ["red creeper:lime", "white", "shield blue cross:red"])
def test_without_details_it_is_the_command_of_its_form(form: str, design: str) -> None:
    banner = Banner.parse(design)
    if form == "give-1.12" and banner.kind == "shield":
        with pytest.raises(DesignError, match="cannot hold shields"):
            write_give(banner, form, ItemDetails())
    else:
        assert write_give(banner, form, ItemDetails()) == write_banner(banner, form)


def test_each_version_has_its_syntax() -> None:
    patterns = '[{pattern:"creeper",color:"lime"}]'
    assert write_give(BANNER, "give", DETAILS) == (
        "/give @a[distance=..5] minecraft:red_banner["
        f'banner_patterns={patterns},custom_name="Sea Star",lore=["one","two"]] 3'
    )
    json = ItemDetails(name="Sea Star", json_text=True)
    assert write_give(Banner("red"), "give", json) == (
        '/give @p minecraft:red_banner[custom_name="{\\"text\\":\\"Sea Star\\"}"]'
    )
    assert write_give(Banner("red"), "give-legacy", ItemDetails(name="Sea", lore=("a",))) == (
        '/give @p minecraft:red_banner{display:{Name:"{\\"text\\":\\"Sea\\"}",'
        'Lore:["{\\"text\\":\\"a\\"}"]}}'
    )
    assert write_give(Banner("red"), "give-1.12", ItemDetails(count=2, name="Sea")) == (
        '/give @p minecraft:banner 2 1 {BlockEntityTag:{Base:1},display:{Name:"Sea"}}'
    )


@given(
    st.sampled_from(GIVE_FORMS),
    st.text(st.characters(codec="utf-8", categories=["L", "N", "P", "S"]), max_size=12),
    st.booleans(),
)
def test_no_name_changes_the_design(form: str, name: str, json_text: bool) -> None:
    details = ItemDetails("@s", 16, name, (name,), json_text)
    assert parse_banner(write_give(BANNER, form, details)) == BANNER


@pytest.mark.parametrize(
    ("wrong", "line"),
    [
        ({"target": "@x"}, "is not a player"),
        ({"target": "@a run op me"}, "is not a player"),
        ({"count": 0}, "use 1 to 1600"),
        ({"name": "a\nb"}, "without a shape"),
        ({"lore": ("x",) * 257}, "at most 256"),
    ],
)
def test_impossible_details_are_refused(wrong: dict[str, object], line: str) -> None:
    with pytest.raises(DesignError, match=line):
        ItemDetails(**wrong)


def test_another_form_is_refused() -> None:
    with pytest.raises(DesignError, match="is not a give command"):
        write_give(BANNER, "setblock", ItemDetails())
