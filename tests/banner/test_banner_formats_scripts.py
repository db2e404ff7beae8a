"""Scripts of Skript and Denizen: what their lines make, in any order and spelling."""

import pytest

from drapery.banner.formats import parse_banner, parse_banners
from drapery.errors import DesignError

RED = "set {_f} to a red banner\n"
CREEPER = "creeper banner pattern colored black"
BORDER = "border banner pattern colored yellow"
BOTH = RED + f"add a {CREEPER} and a {BORDER} to banner patterns of {{_f}}\n"


@pytest.mark.parametrize(
    ("lines", "design"),
    [
        (
            BOTH + "set the 1st banner pattern of {_f} to a skull banner pattern colored white",
            "red skull:white border:yellow",
        ),
        (
            BOTH + "set {_f}'s 2nd banner pattern to a skull banner pattern colored white",
            "red creeper:black skull:white",
        ),
        (
            RED + f"set the 2nd banner pattern of {{_f}} to a {BORDER}",
            "red base:white border:yellow",
        ),
        (BOTH + "clear the 1st banner pattern of {_f}", "red border:yellow"),
        (BOTH + "clear the banner patterns of {_f}", "red"),
        (BOTH + "delete all of the banner patterns of {_f}", "red"),
        (
            RED + f"add a {CREEPER} to banner patterns of {{_f}}\nclear {{_f}}'s banner patterns\n"
            f"add {BORDER} to {{_f}}'s banner patterns",
            "red border:yellow",
        ),
        (BOTH + f"remove a {CREEPER} from banner patterns of {{_f}}", "red border:yellow"),
        (BOTH + "remove a skull banner pattern colored black from {_f}'s banner patterns", BOTH),
        (BOTH + f"set banner patterns of {{_f}} to a {BORDER}", "red border:yellow"),
        (BOTH + f"set banner patterns of {{_f}} to {BORDER}, {CREEPER}", "red bo:yellow cre:black"),
        (
            RED + f"set {{_p}} to a {CREEPER}\nadd {{_p}} to banner patterns of {{_f}}\n"
            f"add a {BORDER} to banner patterns of {{_f}}\n"
            "remove {_p} from banner patterns of {_f}",
            "red border:yellow",
        ),
        (
            RED + f"set {{_p::*}} to a {CREEPER} and a {BORDER}\nset banner patterns of {{_f}} to"
            " {_p::*}",
            BOTH,
        ),
        (
            f"{RED}add a {CREEPER} to {{_p::*}}\nadd a {BORDER} to {{_p::*}}\nadd {{_p::*}} to"
            " banner patterns of {_f}",
            BOTH,
        ),
        (
            "set player's tool to a red banner\nadd creeper banner pattern colored black to the"
            " banner patterns of player's tool",
            "red creeper:black",
        ),
        (
            f'set {{_f}} to a red banner named "# &4blue banner" # a white banner\n# add {BORDER}'
            f" to banner patterns of {{_f}}\nadd {CREEPER} to banner patterns of {{_f}} # it",
            "red creeper:black",
        ),
        (BOTH + "broadcast banner patterns of {_f}\nclear {_f}", BOTH),
    ],
)
def test_a_script_is_followed_line_by_line(lines: str, design: str) -> None:
    expected = parse_banner(design)
    assert parse_banner(lines) == parse_banner(lines, form="skript") == expected
    below = "on join:\n" + "".join(f"\t{line}\n" for line in lines.split("\n"))
    assert parse_banner(below) == expected


def test_each_banner_that_a_script_makes_is_found() -> None:
    script = (
        f"command /a:\n  trigger:\n    {RED}    add {CREEPER} to banner patterns of {{_f}}\n"
        f"command /b:\n  trigger:\n    set {{_f}} to a blue banner\n"
        f"    add {BORDER} to banner patterns of {{_f}}\n    give player a light gray banner\n"
    )
    found = parse_banners(script)
    assert [one.banner for one in found] == [
        parse_banner(text) for text in ("red creeper:black", "blue border:yellow", "light_gray")
    ]
    assert [one.where for one in found] == ["line 3 {_f}", "line 7 {_f}", "line 9"]
    copy = BOTH + "set {_g} to {_f}\nclear 1st banner pattern of {_g}"
    copy += "\nset slot 3 of {_gui} to {_f}\nadd {_f} to inventory of player"
    assert [one.banner for one in parse_banners(copy)] == [
        parse_banner(BOTH),
        parse_banner("red border:yellow"),
    ]


@pytest.mark.parametrize(
    ("lines", "parts"),
    [
        (RED + "add loop-value to banner patterns of {_f}", ["line 2", "'loop-value'", "creeper"]),
        (RED + "add {_x} to banner patterns of {_f}", ["line 2", "'{_x}'"]),
        (RED + "reset banner patterns of {_f}", ["line 2", "'reset banner", "add, set"]),
        (BOTH + f"add {CREEPER} to 1st banner pattern of {{_f}}", ["line 3", "set to one"]),
        (BOTH + f"set 99th banner pattern of {{_f}} to {CREEPER}", ["line 3", "at most 16"]),
        (
            f"command /a:\n  trigger:\n    {RED}command /b:\n  trigger:\n    add {CREEPER} to"
            " banner patterns of {_f}",
            ["{_f}", "the base is missing"],
        ),
        (
            f"set {{_p::*}} to {CREEPER}\n" + "add {_p::*} to {_p::*}\n" * 99,
            ["line 11", "1024 layers", "at most 16"],
        ),
        ("hello world", ["no banner in the text"]),
    ],
)
def test_a_line_that_is_not_understood_is_named(lines: str, parts: list[str]) -> None:
    with pytest.raises(DesignError) as caught:
        parse_banners(lines, form="skript")
    message = str(caught.value)
    assert [part for part in parts if part not in message] == [], message


@pytest.mark.parametrize("section", ["if player is op:", "loop 3 times:", "else:"])
def test_a_line_that_may_not_be_run_once_is_named(section: str) -> None:
    script = f"on join:\n  {RED}  {section}\n    add {CREEPER} to banner patterns of {{_f}}\n"
    with pytest.warns(UserWarning, match=f"line 4 stands below '{section}'.*run once"):
        assert parse_banner(script) == parse_banner("red creeper:black")


ITEM = """flag:
  type: item
  material: blue_banner
  mechanisms:
    hides: all
    patterns: WHITE/CREEPER|BLACK/BORDER
"""


@pytest.mark.parametrize(
    ("script", "design"),
    [
        (ITEM, "blue creeper:white border:black"),
        (ITEM.replace("BORDER", "BORDER  # a comment"), "blue creeper:white border:black"),
        (ITEM.replace("\n", "\n\n"), "blue creeper:white border:black"),
        (ITEM.replace("\n", "\r\n"), "blue creeper:white border:black"),
        (
            ITEM.replace(
                "WHITE/CREEPER|BLACK/BORDER", "\n    - WHITE/CREEPER\n    # x\n    - black/bo"
            ),
            "blue creeper:white border:black",
        ),
        (
            ITEM.replace(
                "WHITE/CREEPER|BLACK/BORDER", "# two\n      - WHITE/CREEPER\n      - BLACK/BO"
            ),
            "blue creeper:white border:black",
        ),
        (
            ITEM.replace("WHITE/CREEPER|BLACK/BORDER", "<list[WHITE/CREEPER|BLACK/BORDER]>"),
            "blue creeper:white border:black",
        ),
        (
            ITEM.replace("WHITE/CREEPER|BLACK/BORDER", '"WHITE/CREEPER|BLACK/BORDER"'),
            "blue creeper:white border:black",
        ),
        (
            ITEM.replace("blue_banner", "minecraft:shield").replace(
                "hides: all", "base_color: RED"
            ),
            "shield red creeper:white border:black",
        ),
        (
            "flag:\n  type: item\n  mechanisms:\n    patterns: WHITE/CREEPER\n"
            "  material: red_banner\n",
            "red creeper:white",
        ),
    ],
)
def test_an_item_script_has_its_keys_in_any_order_and_spelling(script: str, design: str) -> None:
    assert parse_banner(script) == parse_banner(design)
    plain = "other:\n  type: item\n  material: red_banner\n"
    for both in (plain + script, script + plain):
        found = {one.banner for one in parse_banners(both)}
        assert found == {parse_banner("red"), parse_banner(design)}


def test_patterns_that_a_script_changes_elsewhere_are_named() -> None:
    for change in ("<[flag].with[patterns=RED/CREEPER]>", "- adjust <[flag]> patterns:RED/BORDER"):
        with pytest.warns(UserWarning, match="line 7: patterns of an item that is not named"):
            parse_banner(f"{ITEM}{change}\n")
