"""Give commands with a player, a count, a name and lore, in the syntax of each version."""

from typing import Any

import pytest
from conftest import Run
from hypothesis import given, strategies as st

from drapery import Banner, DesignError
from drapery.banner import (
    GIVE_FORMS,
    ItemDetails,
    not_kept,
    parse_banner,
    parse_banners,
    plain_text,
    write_banner,
    write_give,
)
from drapery.banner.formats.snbt import parse_snbt, write_snbt

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


TREES = st.recursive(
    st.booleans().map(lambda value: "true" if value else "false")
    | st.integers(-99, 99).map(str)
    | st.sampled_from(["1b", "2s", "3L", "1.5f", "2.5d", "0x1F", "1e3", "[I;1,2]", "[B;1b]"])
    | st.text(st.characters(codec="utf-8", categories=["L", "N", "P", "S", "Cc"]), max_size=8).map(
        write_snbt
    ),
    lambda inner: (
        st.lists(inner, min_size=1, max_size=3).map(lambda items: f"[{','.join(items)}]")
        | st.dictionaries(st.text("abc_", min_size=1, max_size=4), inner, max_size=3).map(
            lambda entries: "{" + ",".join(f"{k}:{v}" for k, v in entries.items()) + "}"
        )
    ),
    max_leaves=8,
)
"""Trees of SNBT as text, in the spelling of `write_snbt`."""


@given(TREES)
def test_a_tree_that_is_read_is_written_as_it_was(text: str) -> None:
    assert write_snbt(parse_snbt(text)) == text


NAMES = st.sampled_from(
    [
        '"Flag"',
        r'{text:"My \"Best\" Flag",color:"gold"}',
        '["a",{text:"b",bold:true}]',
        r'"{\"text\":\"Flag\"}"',
    ]
)
TARGETS = ["@p", "@s", "@a[distance=..5,tag=!x]", "Steve", '@a[nbt={a:[1]},name="x y"]']


@given(st.sampled_from(TARGETS), NAMES, st.dictionaries(st.text("xyz", min_size=1), TREES), TREES)
def test_everything_of_a_command_comes_back(
    target: str, name: str, others: dict[str, str], line: str
) -> None:
    more = "".join(f",mod:{key}={value}" for key, value in others.items())
    is_json = name.startswith('"{')
    lore = f",lore=[{line}]" if not is_json and not line.startswith('"') else ""
    text = (
        f'/give {target} minecraft:red_banner[banner_patterns=[{{pattern:"creeper",color:"lime"}}]'
        f",custom_name={name}{lore}{more},!minecraft:damage] 16"
    )
    (found,) = parse_banners(text)
    assert found.details is not None and not_kept(found.details, "give") == ""
    again = parse_banners(write_give(found.banner, "give", found.details))[0]
    assert again == found and again.details == found.details


@pytest.mark.parametrize(
    "text",
    [
        r'/give @p minecraft:red_banner{display:{Name:"{\"text\":\"A\",\"bold\":true}",'
        r'Lore:["{\"text\":\"b\"}"]}} 2',
        "/give @p minecraft:banner 2 1 {BlockEntityTag:{Base:1},ench:[{id:1s}],"
        'display:{Name:"\u00a76Sea",Lore:["b"]}}',
        "/give @p minecraft:shield{BlockEntityTag:{Base:14},Unbreakable:1b}",
    ],
)
def test_commands_of_older_versions_come_back(text: str) -> None:
    (found,) = parse_banners(text)
    assert found.details is not None
    form = "give-1.12" if "banner 2 1" in text else "give-legacy"
    (again,) = parse_banners(write_give(found.banner, form, found.details))
    assert again == found and again.details == found.details
    assert not_kept(found.details, form) == ""


@pytest.mark.parametrize(
    ("text", "form", "said"),
    [
        ("/give @p red_banner{HideFlags:1}", "give", "does not keep 'HideFlags'"),
        ("/give @p red_banner[glider={}]", "give-legacy", "does not keep 'glider'"),
        ('/give @p red_banner[custom_name="a"]', "json", "does not keep the name"),
        ("/give Steve red_banner 3", "text", "does not keep the count 3, the player Steve"),
        ('/give @p red_banner[custom_name={text:"a",bold:true}]', "give-1.12", "the looks of name"),
        ('/give @p red_banner[custom_name={text:"a"}]', "give-1.12", ""),
        ("/give @p red_banner 5000", "give", "the count 5000"),
        ("$give $(who) red_banner", "give", "the player '$(who)'"),
        (
            "/give @p red_banner{BlockEntityTag:{CustomName:'a'}}",
            "give",
            "BlockEntityTag.CustomName",
        ),
        (
            f"/give @p red_banner[custom_data={{a:{'[' * 70}{']' * 70}}},glider={{}}]",
            "give",
            "'custom_data', which is nested",
        ),
        ("/give @p red_banner", "json", ""),
    ],
)
def test_what_is_not_kept_is_said(text: str, form: str, said: str, drapery: Run) -> None:
    details = parse_banners(text)[0].details
    assert details is not None
    assert said in not_kept(details, form) and bool(said) == bool(not_kept(details, form))
    code, _, notice = drapery("show", text, "--as", form)
    assert code == 0 and said in notice and bool(said) == bool(notice)


def test_show_keeps_the_details_of_each_command(drapery: Run) -> None:
    lines = [
        '/give @a minecraft:red_banner[custom_name={text:"A"}] 2',
        '/give @s minecraft:blue_banner[lore=["b"]]',
    ]
    assert drapery("show", "\n".join(lines), "--as", "give")[1].split("\n")[:2] == lines
    second = drapery("show", "\n".join(lines), "--as", "give", "--number", "2")
    assert second[1].strip() == lines[1]
    item = '{id:"minecraft:red_banner",count:3,components:{"minecraft:custom_name":"A"}}'
    expected = '/give @p minecraft:red_banner[custom_name="A"] 3'
    assert drapery("show", item, "--as", "give")[1].strip() == expected


@pytest.mark.parametrize(
    ("component", "text"),
    [("a", "a"), (["a", {"text": "b"}], "ab"), ({"translate": "x", "fallback": "y"}, "y"), (3, "")],
)
def test_the_words_of_a_component(component: Any, text: str) -> None:
    assert plain_text(component) == text
