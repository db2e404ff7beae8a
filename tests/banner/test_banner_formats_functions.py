"""Function files: every design among any other commands, and no alarm for lines without one."""

import warnings
from pathlib import Path

import pytest
from conftest import Run

from drapery.banner import Banner
from drapery.banner.formats import (
    FoundBanner,
    functions,
    parse_banner,
    parse_banners,
    read_designs,
    recognise,
)
from drapery.errors import DesignError

LAYER = '{pattern:"creeper",color:"lime"}'
LIME = parse_banner("red creeper:lime")
GIVE = f"give @s red_banner[banner_patterns=[{LAYER}]]"

NOISE = """\
# /give @p blue_banner: as of version 2
#> banner_patterns=[{pattern:"creeper",color:"lime"}]

say it's a banner: patterns:[{pattern:creeper,color:red}]
function ns:banner/give
scoreboard players add @s banner_patterns 1
tellraw @a {"text":"click","clickEvent":{"action":"run_command","value":"/trigger banner"}}
execute if entity @a[nbt={Inventory:[{id:"minecraft:red_banner"}]}] run tag @s add banner
execute unless block ~ ~ ~ #minecraft:banners run return 0
execute if block ~ ~ ~ minecraft:white_banner[rotation=0] run data merge entity @s {Rotation:[0f]}
clear @s minecraft:red_banner
clear @s red_banner[banner_patterns=[{pattern:"creeper",color:"lime"}]]
execute if block 1 2 3 red_banner{patterns: [{pattern:a,color:lime}]} run teleport @a 1 2 3
fill ~ ~ ~ ~1 ~1 ~1 air replace red_wall_banner
give @s minecraft:creeper_banner_pattern
give @s diamond_chestplate[trim={material:"gold",pattern:"sentry"}]
data modify storage a:b name set value "red_banner"
data get block ~ ~ ~ Items[{id:"minecraft:red_banner"}]
kill @e[type=item,nbt={Item:{id:"minecraft:red_banner"}}]
execute as @a[nbt=!{SelectedItem:{id:"minecraft:shield"}}] run tag @s remove shield
playsound minecraft:item.shield.block master @s
summon zombie ~ ~ ~ {HandItems:[{},{id:"minecraft:shield",Count:1b}]}
"""


@pytest.mark.parametrize(
    "line",
    [
        GIVE,
        f"/{GIVE} 1",
        f"  {GIVE}  ",
        f"$give @s red_banner[banner_patterns=[{LAYER}],lore=['$(line)'],custom_data={{a:$(n)}}]",
        f"$execute as $(who) run {GIVE}",
        f"execute as @a[scores={{a=1..}},nbt=!{{a:1}}] at @s run {GIVE}",
        f"return run {GIVE}",
        f"execute store result score @s a run execute at @p run {GIVE}",
        f"item replace entity @s armor.head with red_banner[banner_patterns=[{LAYER}]] 1",
        f"loot give @s loot {{id:red_banner,components:{{banner_patterns:[{LAYER}]}}}}",
        f"setblock ~ ~ ~ red_wall_banner[facing=north]{{patterns:[{LAYER}]}} keep",
        f"fill ~ ~ ~ ~ ~9 ~ red_banner{{patterns:[{LAYER}]}} replace air",
        f"summon item ~ ~ ~ {{Item:{{id:red_banner,components:{{banner_patterns:[{LAYER}]}}}}}}",
        "data modify storage a:b list set value"
        f" [{{id:red_banner,components:{{banner_patterns:[{LAYER}]}}}}]",
        f"data modify storage a:b list append value [[{{a:1}},{{id:red_banner,components:"
        f"{{banner_patterns:[{LAYER}]}}}}],5]",
        "data merge entity @s {Item:{id:red_banner,Count:1b,tag:{BlockEntityTag:"
        "{Patterns:[{Pattern:cre,Color:5}]}}}}",
        'tellraw @a ["",{"text":"a","clickEvent":{"action":"run_command","value":"/give @s '
        'red_banner{BlockEntityTag:{Patterns:[{Pattern:\\"cre\\",Color:5}]}}"}}]',
        'tellraw @a {"hoverEvent":{"action":"show_item","contents":{"id":"minecraft:red_banner",'
        '"tag":"{BlockEntityTag:{Patterns:[{Pattern:cre,Color:5}]}}"}}}',
        "setblock ~ ~ ~ command_block{Command:'/give @p red_banner[banner_patterns="
        "[{pattern:creeper,color:lime}]]'}",
        f"give @s chest[container=[{{slot:0,item:{{id:red_banner,components:"
        f"{{banner_patterns:[{LAYER}]}}}}}}]]",
        "give @s red_banner[banner_patterns=[\\\n    {pattern:cree\\\n  per,\\\r\n"
        " color:lime}\\\n]]",
    ],
)
def test_one_design_is_found_among_any_other_commands(line: str) -> None:
    text = f"{NOISE}{line}\n{NOISE}"
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = parse_banners(text)
    assert [one.banner for one in found] == [LIME]
    assert found[0].where.startswith(f"line {NOISE.count(chr(10)) + 1} ")


def test_one_command_with_any_other_line_is_a_function() -> None:
    for text in (f"# my banner\n{GIVE}", f"{GIVE}\nsay done\n", f"\n\ntitle @a x\n{GIVE}\n"):
        assert recognise(text).name == "function"
        assert parse_banner(text) == LIME == parse_banner(text, form="function")


@pytest.mark.parametrize(
    ("line", "parts"),
    [
        (
            "$give @s red_banner[banner_patterns=[{pattern:creeper,color:$(dye)}]]",
            ["banner_patterns[0].color", "dye is the macro's parameter $(dye)"],
        ),
        (
            '$give @s red_banner[banner_patterns=[{pattern:"$(a)_b",color:"red"}]]',
            ["banner_patterns[0].pattern", "pattern is the macro's parameter $(a)"],
        ),
        ("$give @s $(dye)_banner", ["base dye is the macro's parameter $(dye)"]),
        (
            f"$give @s minecraft:$(dye)_banner[banner_patterns=[{LAYER}]]",
            ["base dye is the macro's parameter $(dye)"],
        ),
        ("$give @s red_banner[banner_patterns=$(all)]", ["macro's parameter $(all)"]),
        ("$give @s red_banner[banner_patterns=[$(all)]]", ["macro's parameter $(all)"]),
        (
            f"$give @s red_banner[banner_patterns=[{LAYER}$(more)]]",
            ["unexpected", "write out its parameters"],
        ),
        ("$give @s red_banner[$(components)]", ["macro's parameter $(components)"]),
        (
            "$give @s shield[base_color=$(dye)]",
            ["base_color", "dye is the macro's parameter $(dye)"],
        ),
        (
            "$summon item ~ ~ ~ {Item:{id:red_banner,tag:{BlockEntityTag:"
            "{Patterns:[{Pattern:cre,Color:$(n)}]}}}}",
            ["Patterns[0].Color", "dye is the macro's parameter $(n)"],
        ),
        (
            f"$summon item ~ ~ ~ {{Item:{{id:'$(c)_banner',components:{{banner_patterns:[{LAYER}]"
            "}}}",
            ["Item.id", "base dye is the macro's parameter $(c)"],
        ),
    ],
)
def test_a_macro_whose_design_is_a_parameter_says_so(line: str, parts: list[str]) -> None:
    with pytest.raises(DesignError) as caught:
        parse_banner(line)
    message = str(caught.value)
    assert [part for part in ["line 1", *parts] if part not in message] == [], message
    with pytest.warns(UserWarning, match="line 2") as warned:
        assert parse_banner(f"say hi\n{line}\n{GIVE}") == LIME
    assert parts[-1] in str(warned[0].message)


@pytest.mark.parametrize(
    ("line", "part"),
    [
        ("data merge block ~ ~ ~ {patterns:[{pattern:cross,color:red}]}", "base dye"),
        ("data modify block ~ ~ ~ patterns set value [{pattern:cross,color:red}]", "base dye"),
        ("give @s red_banner[banner_pattern=[]]", "banner_pattern"),
        ("modcommand red_banner[banner_patterns=[{pattern:cross,color:red}]]", "modcommand"),
        ("give @s red_banner[banner_patterns=[{pattern:cross,\\", "backslash"),
    ],
)
def test_a_design_that_is_lost_is_warned_of(line: str, part: str) -> None:
    with pytest.warns(UserWarning, match=r"^line 3") as warned:
        assert parse_banner(f"say hi\n{GIVE}\n{line}") == LIME
    assert part in str(warned[0].message) and len(warned) == 1


def test_places_in_lines_that_go_on_are_those_of_the_file() -> None:
    text = f"say hi\n{GIVE}\ngive @s red_banner[\\\n  banner_patterns=[\\\n  {{pattern:5!]\\\n]]\n"
    with pytest.warns(UserWarning, match=r"^line 5, column 14: unexpected '\]'"):
        parse_banners(text)


def test_a_function_without_a_banner_says_so(tmp_path: Path) -> None:
    with pytest.raises(DesignError, match="no banner in the commands"):
        parse_banners(NOISE)
    file = tmp_path / "a.mcfunction"
    file.write_text("say banner\n", "utf-8")
    with pytest.raises(DesignError, match=r"a\.mcfunction: there is no banner in the commands"):
        read_designs(file)


def test_a_file_of_one_line_is_a_function_by_its_name(tmp_path: Path) -> None:
    file = tmp_path / "a.mcfunction"
    file.write_text(f"$execute as $(who) run {GIVE}\r\n", "utf-8")
    assert read_designs(file) == [FoundBanner(LIME, "line 1 red_banner")]


def test_long_functions_are_read_in_linear_time() -> None:
    lines = ["say banner"] * 50_000 + ["pattern:" * 5_000] + ["give @s stick\\"] * 9_999
    assert functions.find("\n".join(lines) + "\n", lambda error: None) == []


@pytest.mark.parametrize("count", [2, 5000])
def test_a_line_of_many_dollars_is_refused(count: int):
    """Found by fuzzing: each dollar was read as the start of a macro within the macro."""
    give = 'give @s red_banner[banner_patterns=[{pattern:"creeper",color:"lime"}]]'
    with pytest.raises(DesignError, match="holds a design; give a /give command"):
        parse_banners("$" * count + give, form="function")


def test_a_line_that_cannot_be_read_is_warned_of_once() -> None:
    wrong = GIVE.replace("creeper", "zzz")
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        found = parse_banners(f"{GIVE}\n{wrong}\nwhite creeper:lime\nred border:black\n")
    assert len(found) == 3 and len(told) == 1 and "zzz" in str(told[0].message)


ITEM = '{id:"minecraft:red_banner",components:{banner_patterns:[{pattern:"creeper",color:"lime"}]}}'
OLD_TAG = '{BlockEntityTag:{Patterns:[{Pattern:"cre",Color:5}]}}'
OLD_ITEM = f"{{id:red_banner,tag:'{OLD_TAG}'}}"


@pytest.mark.parametrize(
    "command",
    [
        '/tellraw @a {text:"our flag",hover_event:{action:"show_item",' + ITEM[1:] + "}",
        f"title @a title {{text:x,hoverEvent:{{action:show_item,contents:{OLD_ITEM}}}}}",
        f"/dialog show @a {{type:notice,title:x,body:[{{type:item,item:{ITEM}}}]}}",
        f"/particle minecraft:item{{item:{ITEM}}} ~ ~ ~",
        f"/particle item red_banner{OLD_TAG} ~ ~ ~",
    ],
)
def test_a_command_that_shows_an_item_is_read_alone_and_in_a_list(command: str) -> None:
    expected = Banner.parse("red creeper:lime")
    assert parse_banner(command) == expected
    found = [one.banner for one in parse_banners(f"white\n{command}\nblue\n{command}\n")]
    assert found.count(expected) == 2


STONE = "//replace stone red_banner[rotation=0]{patterns:[{pattern:creeper,color:lime}]}"


@pytest.mark.parametrize("edit", [STONE, STONE.replace("replace stone", "set")])
def test_worldedit_places_blocks(edit: str) -> None:
    expected = Banner.parse("red creeper:lime")
    assert parse_banner(edit) == expected
    found = [
        one.banner for one in parse_banners(f"white\n//set the base\n{edit}\n// a banner\nblue")
    ]
    assert found == [Banner("white"), expected, Banner("blue")]


def test_worldedit_replaces_one_banner_by_another() -> None:
    assert parse_banner("//replace red_banner blue_banner") == Banner("blue")
    with pytest.raises(DesignError, match="line 1, column"):
        parse_banner("//set 50%red_banner{patterns:[{pattern:creeper,color:lime}]},50%stone")


@pytest.mark.parametrize(
    "text", [STONE, STONE.removeprefix("//replace stone "), "red_banner{patterns:[]}"]
)
def test_what_belongs_to_a_block_is_not_named_as_left_out(text: str, drapery: Run) -> None:
    code, _, err = drapery("show", text, "--as", "json")
    assert (code, err) == (0, "")


BROKEN = [
    f"give @p red_banner[\n    banner_patterns=[\n        {LAYER}\n    ]\n] 1",
    f"give @p red_banner[ \\\n  banner_patterns=[ \\\n    {LAYER} \\\n  ] \\\n] 1",
    f"give @p\n  red_banner[banner_patterns=[{LAYER}]]\n  1",
    f"setblock ~ ~ ~\n  red_banner[rotation=4]\n  {{patterns:[{LAYER}]}}",
    f"execute as @a at @s\n\trun give @s\n\t\tred_banner[banner_patterns=[\n{LAYER}]]",
    "give @p red_banner{\n  BlockEntityTag: {\n Patterns: [\n {Pattern:cre,Color:5}\n]}} 1",
]


@pytest.mark.parametrize("command", BROKEN)
def test_a_command_may_be_broken_over_lines(command: str) -> None:
    assert parse_banner(command) == LIME
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = parse_banners(f"say it's [\n{command}\nsay done\n{command}\n")
    assert [one.banner for one in found] == [LIME, LIME]
    assert found[0].where.startswith("line 2 ")


@pytest.mark.parametrize(
    "broken", ["red_banner[banner_pat\nterns=", "banner_patterns=[{patte\nrn", "color:li\r\nme"]
)
def test_a_command_may_be_broken_within_a_word(broken: str) -> None:
    whole = broken.replace("\r", "").replace("\n", "")
    command = "/give @p red_banner[banner_patterns=[{pattern:creeper,color:lime}]] 1"
    assert whole in command
    assert parse_banner(command.replace(whole, broken)) == LIME


def test_a_bracket_that_is_never_closed_takes_no_other_command() -> None:
    text = f"give @p red_banner[\n  banner_patterns=[{LAYER}\n{GIVE}\n"
    with pytest.warns(UserWarning, match="line 2, column .* the text ends too early"):
        found = parse_banners(text)
    assert [(one.banner, one.where) for one in found] == [(LIME, "line 3 red_banner")]


def test_a_list_of_commands_in_yaml_is_read() -> None:
    text = f"commands:\n  - '{GIVE}'\n  - \"give @p blue_banner[banner_patterns=[]]\"\n"
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert [one.banner for one in parse_banners(text)] == [LIME, Banner("blue")]
