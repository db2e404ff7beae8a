"""What looks like a design and is not understood is an error or a warning, never a plain banner."""

import warnings

import pytest

from drapery.banner.formats import parse_banner, parse_banners
from drapery.banner.formats.leftovers import looks_like_design
from drapery.errors import DesignError

LAYER = '{pattern:"creeper",color:"lime"}'
OLD = "{BlockEntityTag:{Base:15,Patterns:[{Pattern:cre,Color:10}]}}"
BLOCK = f"red_banner[rotation=4]{{patterns:[{LAYER}]}}"
OLD_BLOCK = "{Base:15,Patterns:[{Pattern:cre,Color:10}]}"
OLD_ITEM = f'{{id:"shield",Count:1b,tag:{OLD}}}'
OLD_SHIELD = parse_banner("shield white creeper:lime")
NEW_SHIELD = parse_banner("shield black creeper:purple")


def fault(text: str) -> str:
    with pytest.raises(DesignError) as caught:
        parse_banners(text)
    message = str(caught.value)
    assert "\n" not in message and len(message) < 400
    return message


@pytest.mark.parametrize(
    "text",
    [
        f"/give @p shield 1 0 {OLD}",
        f"/give @p minecraft:shield 1 0 {OLD}",
        f"/give @p shield 1 {OLD}",
        f"replaceitem entity @p slot.weapon.offhand shield 1 0 {OLD}",
        f"/summon Zombie ~ ~ ~ {{HandItems:[{{}},{OLD_ITEM}]}}",
        f"/summon minecraft:vindication_illager ~ ~ ~ {{HandItems:[{{}},{OLD_ITEM}]}}",
        f"/summon zombie ~ ~ ~ {{HandItems:[{{}},{OLD_ITEM.replace('Count', 'Damage:3s,Count')}]}}",
        f"/summon zombie ~ ~ ~ {{ArmorItems:[{{id:bow,ench:[{{id:1}}]}}],HandItems:[{OLD_ITEM}]}}",
        f"/give @p chest 1 0 {{BlockEntityTag:{{Items:[{OLD_ITEM}]}}}}",
        f"/setblock ~ ~ ~ chest 0 replace {{Items:[{OLD_ITEM}]}}",
        f"/blockdata ~ ~ ~ {{Items:[{OLD_ITEM}]}}",
        f"/execute @p ~ ~ ~ detect ~ ~ ~ stone 0 give @p shield 1 0 {OLD}",
    ],
)
def test_shields_up_to_1_12_count_their_dyes_from_black(text: str) -> None:
    assert parse_banner(text) == OLD_SHIELD


@pytest.mark.parametrize(
    "text",
    [
        f"/give @p shield{OLD}",
        f"/give @p shield{OLD} 1",
        f"/summon zombie ~ ~ ~ {{HandItems:[{{}},{OLD_ITEM}]}}",
        f"item replace entity @p weapon.offhand with shield{OLD} 1",
    ],
)
def test_shields_since_1_13_count_their_dyes_from_white(text: str) -> None:
    assert parse_banner(text) == NEW_SHIELD


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        ("red_banner[pattern=YELLOW/FLOWER|RED/CREEPER]", ["pattern", "banner_patterns"]),
        (f"/give @p red_banner[banner_pattern=[{LAYER}]]", ["banner_pattern", "did you mean"]),
        (f"/give @p red_banner[BlockEntityTag={{Patterns:[{LAYER}]}}]", ["BlockEntityTag"]),
        (f"/give @p red_banner[other:banner_pattern=[{LAYER}]]", ["other:banner_pattern"]),
        ("/give @p red_banner[creeper=lime]", ["creeper", "banner_patterns"]),
        ("/give @p red_banner[banner_patterns]", ["banner_patterns", "no value"]),
        ("/give @p shield[base_color]", ["base_color", "no value"]),
        ("/give @p shield[banner_pattern=[]]", ["banner_pattern"]),
        (f"red_banner{{banner_patterns:[{LAYER}]}}", ["banner_patterns"]),
        (f"red_banner{{BlockEntityTag:{{banner_patterns:[{LAYER}]}}}}", ["banner_patterns"]),
        (f"red_banner{{Pattern:[{LAYER}],BlockEntityTag:{{}}}}", ["Pattern"]),
        (f"shield{{BlockEntityTag:{{Base:1,patterns:[{LAYER}]}}}}", ["patterns"]),
        (f"/setblock ~ ~ ~ red_banner{{banner_patterns:[{LAYER}]}}", ["banner_patterns"]),
        (f"red_banner[banner_patterns=[{LAYER}]]{{Patterns:[]}}", ["both"]),
        (f'{{id:"red_banner",banner_patterns:[{LAYER}]}}', ["banner_patterns"]),
        (f'{{id:"red_banner",components:{{patterns:[{LAYER}]}}}}', ["components.patterns"]),
        (f'{{id:"red_banner",tag:{{Layers:[{LAYER}]}}}}', ["tag.Layers"]),
        (f'{{id:"rad_banner",components:{{banner_patterns:[{LAYER}]}}}}', ["'rad_banner'"]),
        (f"{{Items:[{{count:1,components:{{banner_patterns:[{LAYER}]}}}}]}}", ["Items[0].id"]),
        (f'{{id:"Banner",Base:1,Pattern:[{LAYER}]}}', ["Pattern"]),
        ('{"base":"red","patterns":[{"pattern":"creeper","color":"lime"}]}', ["patterns"]),
        ('{"base":"red","tier":1,"layer":[{"pattern":"CREEPER","colour":"LIME"}]}', ["layer"]),
        (f"/give @p red_banner{{BlockEntityTags:{{Patterns:[{LAYER}]}}}}", ["BlockEntityTags"]),
        (f"/give @p red_banner[custom_data={{a:[{LAYER}]}}]", ["custom_data"]),
        (f"/give @p red_banner[block_entity_data={{id:banner,a:[{LAYER}]}}]", ["block_entity"]),
        (f'{{id:"red_banner",component:{{banner_patterns:[{LAYER}]}}}}', ["component"]),
        (f'{{id:"red_banner",Tag:{{BlockEntityTag:{{Patterns:[{LAYER}]}}}}}}', ["Tag"]),
        (
            f"red_banner[banner_patterns=[{LAYER}],minecraft:banner_patterns=[{LAYER}]]",
            ["banner_patterns", "twice"],
        ),
        (
            f"item modify entity @s weapon {{function:set_banner_pattern,patterns:[{LAYER}]}}",
            ["no"],
        ),
        (f"/give @p stick[banner_patterns=[{LAYER}]]", ["no banner", "base dye"]),
        (f"/data merge block ~ ~ ~ {{patterns:[{LAYER}]}}", ["no banner", "base dye"]),
        ("/clear @p red_banner", ["clear makes no banner", "/give"]),
        ("/fill ~ ~ ~ ~9 ~9 ~9 air replace red_banner", ["no banner in the command"]),
        ("/fill ~ ~ ~ ~9 ~9 ~9 minecraft:air replace standing_banner 8", ["no banner"]),
        ("/clone 1 2 3 4 5 6 7 8 9 filtered red_banner", ["clone makes no banner"]),
        ("/execute if block ~ ~ ~ red_banner", ["execute makes no banner", "/give"]),
        ("/execute as @a if items entity @s weapon red_banner run kill @s", ["makes no banner"]),
        ("/testforblock ~ ~ ~ standing_banner 8", ["testforblock makes no banner"]),
        (f"/clear @p red_banner[banner_patterns=[{LAYER}]]", ["clear makes no banner"]),
        (f"execute if block ~ ~ ~ {BLOCK}", ["execute makes no banner", "only tests", "/give"]),
        (f"execute unless block ~ ~ ~ {BLOCK}", ["execute makes no banner"]),
        (f"execute if block ~ ~ ~ {BLOCK} run say hi", ["execute makes no banner"]),
        (f"execute if data block ~ ~ ~ {{patterns:[{LAYER}]}}", ["execute makes no banner"]),
        (
            f"execute if items entity @s * red_banner[banner_patterns=[{LAYER}]]",
            ["execute makes no banner"],
        ),
        (f"execute as @a give @s red_banner[banner_patterns=[{LAYER}]]", ["runs no", "write run"]),
        (f"testfor @p {{Inventory:[{{id:banner,tag:{OLD}}}]}}", ["testfor makes no banner"]),
        (f"testforblock ~ ~ ~ standing_banner 4 {OLD_BLOCK}", ["testforblock makes no banner"]),
        (f"fill ~ ~ ~ ~ ~ ~ air replace {BLOCK}", ["no banner in the command"]),
        ('/data remove block ~ ~ ~ Items[{id:"minecraft:red_banner"}]', ["no banner"]),
    ],
)
def test_what_is_not_understood_is_named(text: str, parts: list[str]) -> None:
    message = fault(text)
    assert [part for part in parts if part not in message] == [], message


@pytest.mark.parametrize(
    ("text", "design"),
    [
        ("red_banner[rotation=8]", "red"),
        ('red_banner[minecraft:custom_name=\'{"text":"patterns"}\',!damage]', "red"),
        ("red_banner[somemod:glow=1,provides_banner_patterns='#a:b']", "red"),
        ("/give @p red_banner[banner_patterns=[]]", "red"),
        ("/fill 1 2 3 4 5 6 red_banner replace blue_banner", "red"),
        ("/fill 1 2 3 4 5 6 standing_banner 8 replace {Base:1}", "red"),
        (f"/give @p red_banner 1 [banner_patterns=[{LAYER}]]", "red creeper:lime"),
        (
            f"/summon falling_block ~ ~ ~ {{BlockState:{{Name:red_banner}},TileEntityData:"
            f"{{patterns:[{LAYER}]}}}}",
            "red creeper:lime",
        ),
        ("/summon block_display ~ ~ ~ {block_state:{Name:'minecraft:red_banner'}}", "red"),
        (
            f"/loot give @s loot {{pools:[{{entries:[{{type:item,name:red_banner,functions:"
            f"[{{function:set_banner_pattern,patterns:[{LAYER}]}}]}}]}}]}}",
            "red creeper:lime",
        ),
        (f"red_banner[container=[{{item:{{id:a,b:[{LAYER}]}}}}]]", "red"),
        ('/execute as @a[nbt=!{a:"red_banner"}] run give @s blue_banner', "blue"),
        ("/execute if items entity @s * *[custom_data~{a:1}] run give @s red_banner", "red"),
        ("/blockdata ~ ~ ~ {Base:1,Patterns:[{Pattern:cre,Color:10}]}", "red creeper:lime"),
        (f"/give @p red_banner[banner_patterns=[\\\n  {LAYER}\\\n]]\n", "red creeper:lime"),
    ],
)
def test_what_is_understood_is_read(text: str, design: str) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert parse_banner(text) == parse_banner(design)


@pytest.mark.parametrize(
    ("text", "is_one"),
    [
        ('white_banner[banner_patterns=[{pattern:"cross"}]]', True),
        ('{\\"Patterns\\":[{\\"Pattern\\":\\"cre\\"}]}', True),
        ("patterns:$(layers)", True),
        ("banner_patterns~[{}]", True),
        ('{"color": "red", "pattern": "minecraft:cross"}', True),
        ("diamond_chestplate[trim={material:gold,pattern:sentry}]", False),
        ('{"pattern": ["AAA", "B B"], "key": {"A": {"item": "red_wool"}}}', False),
        ("provides_banner_patterns=[a]", False),
        ("say I like banner patterns: [they] are fine", False),
        ("banner_patterns=[]", False),
    ],
)
def test_layers_are_recognised_in_any_text(text: str, is_one: bool) -> None:
    assert looks_like_design(text) == is_one


def test_an_old_item_with_two_base_dyes_says_which_one_it_has() -> None:
    text = "{id:banner,Damage:0s,Count:1b,tag:{BlockEntityTag:{Base:4,Patterns:[]}}}"
    with pytest.warns(UserWarning, match="the base is blue, by its Base, .* show black"):
        assert parse_banner(text) == parse_banner("blue")
