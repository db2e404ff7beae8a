"""Every form of text: its example, any banner to it and back, and what it cannot hold."""

import re

import forms_page
import pytest
from conftest import Run
from hypothesis import given, settings, strategies as st

from drapery.banner import BinaryForm, Form, binary_forms
from drapery.banner.design import Banner, Layer
from drapery.banner.dyes import DYE_NAMES, DYES
from drapery.banner.formats import FORMS, parse_banner, parse_banners, recognise, write_banner
from drapery.banner.formats.tree import OMINOUS
from drapery.banner.patterns import PATTERN_NAMES, PATTERNS
from drapery.errors import DesignError


def shorthand(text: str) -> Banner:
    return parse_banner(text, form="shorthand")


PATHS = st.lists(st.text("abz059_-.", min_size=1, max_size=5), min_size=1, max_size=3).map("/".join)
CUSTOM = st.builds("{}:{}".format, st.sampled_from(["acme", "a.b-c_9"]), PATHS).filter(
    lambda name: not re.search(r"(^|[:/])\.\.?(/|$)", name)
)
DYE = st.sampled_from(DYE_NAMES)
LAYERS = st.lists(st.builds(Layer, st.sampled_from(PATTERN_NAMES) | CUSTOM, DYE), max_size=16).map(
    tuple
)
BANNERS = st.builds(Banner, DYE, LAYERS, st.sampled_from(["banner", "banner", "shield"])) | st.just(
    OMINOUS
)

NO_CODE = {"flow", "guster"}
LACKS = {
    "give-legacy": NO_CODE,
    "give-1.12": NO_CODE | {"globe", "piglin"},
    "planet-minecraft": {"base"},
    "minecraft-tools": {"base"} | NO_CODE,
    "gamergeeks": NO_CODE,
    "optifine": {"mojang"},
    "bannotation": {"base"} | NO_CODE,
    "bannerfont": {"base"},
    "essentialsx": NO_CODE,
}
NO_SHIELDS = {
    *("give-1.12", "setblock", "block-entity", "bedrock", "wynncraft"),
    *("planet-minecraft", "needcoolshoes", "gamergeeks", "optifine", "bannotation"),
    *("bannerfont", "bannermaker", "java"),
    *("bentobox", "commandpanels", "crazycrates", "skript", "loom-assistant"),
}
NO_DATA_PACKS = {
    *(NO_SHIELDS - {"setblock", "block-entity", "loom-assistant", "bannermaker"}),
    *("give-legacy", "minecraft-tools"),
    *("deluxemenus", "denizen", "essentialsx", "mythicmobs"),
}
MOST_LAYERS = {"optifine": 8}


def can_hold(form: str, banner: Banner) -> bool:
    patterns = {layer.pattern for layer in banner.layers}
    return not (
        len(banner.layers) > MOST_LAYERS.get(form, 16)
        or (banner.kind == "shield" and form in NO_SHIELDS)
        or patterns & LACKS.get(form, set())
        or (form in NO_DATA_PACKS and patterns - set(PATTERNS))
    )


@pytest.mark.parametrize("form", FORMS)
@settings(max_examples=40)
@given(banner=BANNERS)
def test_any_banner_comes_back_from_a_form_that_can_hold_it(form: str, banner: Banner):
    if can_hold(form, banner):
        text = write_banner(banner, form)
        assert parse_banner(text) == banner
        assert parse_banner(text, form=form) == banner
    else:
        with pytest.raises(DesignError):
            write_banner(banner, form)


@pytest.mark.parametrize("form", FORMS)
def test_an_example_is_known_as_its_own_form(form: str):
    assert recognise(FORMS[form].example).name == form
    assert parse_banners(FORMS[form].example)


def test_the_docs_are_generated_from_the_registry():
    page = forms_page.PAGE.read_text("utf-8")
    assert forms_page.generated(page) == page, "run `python tests/forms_page.py`"


@pytest.mark.parametrize("form", [*FORMS.values(), *binary_forms().values()], ids=lambda f: f.name)
def test_every_form_names_its_source(form: Form | BinaryForm):
    assert form.source.startswith(("https://", "our own", "the notes"))


CREEPER = shorthand("white creeper:lime border:black")
SAME = [
    '/give @p minecraft:white_banner[banner_patterns=[{pattern:"creeper",color:"lime"},'
    '{pattern:"border",color:"black"}]]',
    'minecraft:give Steve white_banner[minecraft:banner_patterns=[{pattern:"minecraft:creeper",'
    "color:lime},{pattern:'border',color:'black',},],!damage,item_name='\"x\"',"
    "hide_additional_tooltip={}] 64",
    "white_banner[banner_patterns=[{color:'lime',pattern:'creeper'},{pattern:border,color:black}],"
    'tooltip_display={hidden_components:["minecraft:banner_patterns"]},custom_model_data={floats:'
    "[0x1F,0b1,1_000,.5f,1e3]},custom_data={n:bool(1),u:uuid('f81d4fae-7dec-11d0-a765-00a0c91e6bf6'"
    '),s:"\\u2603\\x41\\N{SNOWMAN}",mixed:[1ub,"a",{}],},]',
    '/give @p minecraft:white_banner{BlockEntityTag:{Patterns:[{Pattern:"cre",Color:5},'
    '{Pattern:"bo",Color:15}]},display:{Name:\'{"text":"My \\\\"own\\\\""}\'}} 1',
    '/give @p minecraft:banner 1 15 {BlockEntityTag:{Base:15,Patterns:[{Pattern:"cre",Color:10},'
    '{Pattern:"bo",Color:0}]}}',
    "give @p banner 1 15 {BlockEntityTag:{Patterns:[0:{Pattern:cre,Color:10},1:{Pattern:bo,"
    "Color:0}]}}",
    '/setblock ~ ~1 ~-2 white_wall_banner[facing=north]{patterns:[{pattern:"creeper",'
    'color:"lime"},{pattern:"border",color:"black"}]} replace',
    '/setblock 1 2 3 minecraft:white_banner[rotation=9]{Patterns:[{Pattern:"cre",Color:5},'
    '{Pattern:"bo",Color:15}]}',
    "/setblock ~ ~ ~ standing_banner 8 replace {Base:15,Patterns:[{Pattern:cre,Color:10},"
    "{Pattern:bo,Color:0}]}",
    "/setblock ~ ~ ~ wall_banner facing=east replace {Base:15,Patterns:[{Pattern:cre,Color:10},"
    "{Pattern:bo,Color:0}]}",
    '/summon item_frame ~ ~ ~ {Item:{id:"white_banner",Count:1b,tag:{BlockEntityTag:{Patterns:['
    '{Pattern:"cre",Color:5},{Pattern:"bo",Color:15}]}}}}',
    '/summon minecraft:armor_stand ~ ~ ~ {equipment:{head:{id:"minecraft:white_banner",components:'
    '{"banner_patterns":[{pattern:"creeper",color:"lime"},{pattern:"border",color:"black"}]}}}}',
    "/summon ArmorStand ~ ~ ~ {Equipment:[{},{},{},{},{id:minecraft:banner,Damage:15s,Count:1b,"
    "tag:{BlockEntityTag:{Patterns:[{Pattern:cre,Color:10},{Pattern:bo,Color:0}]}}}]}",
    "/replaceitem entity @p slot.armor.head banner 1 15 {BlockEntityTag:{Base:15,Patterns:["
    "{Pattern:cre,Color:10},{Pattern:bo,Color:0}]}}",
    '/execute as @a[nbt={SelectedItem:{id:"minecraft:red_banner"}},distance=..5,tag=,'
    "advancements={minecraft:story/root=true}] at @s run item replace entity @s armor.head with "
    'white_banner[banner_patterns=[{pattern:"creeper",color:"lime"},{pattern:"border",'
    'color:"black"}]]',
    'Steve has the following entity data: {Inventory:[{Slot:0b,id:"minecraft:shield",count:1},'
    '{Slot:1b,id:"minecraft:white_banner",count:1,components:{"minecraft:banner_patterns":['
    '{pattern:"creeper",color:"lime"},{pattern:"border",color:"black"}]}}]}',
    '{"Name":"minecraft:banner","Damage":15,"Count":1,"tag":{"Patterns":[{"Pattern":"cre",'
    '"Color":10},{"Pattern":"bo","Color":0}],"Type":0}}',
    '{"name":"Guild","banner":{"base":"WHITE","tier":1,"structure":"tier1","layers":['
    '{"colour":"LIME","pattern":"CREEPER"},{"colour":"BLACK","pattern":"BORDER"}]}}',
    '{"base":"White","layers":[{"pattern":"Creeper Charge","color":"LIME"},{"pattern":"bo",'
    '"color":"minecraft:black"}]}',
    "White Banner\nLime Creeper Charge\nBlack Bordure",
    "white creeper : lime, Bordure: black",
    "minecraft:white_banner cre:lime BORDER:black",
]


@pytest.mark.quick
@pytest.mark.parametrize("text", SAME)
def test_every_age_and_spelling_of_one_banner_is_that_banner(text: str):
    assert parse_banner(text) == CREEPER


@settings(max_examples=40)
@given(banner=BANNERS.filter(lambda banner: can_hold("give-1.12", banner)))
def test_the_ages_agree_on_every_dye_and_pattern(banner: Banner):
    texts = [write_banner(banner, form) for form in ("give", "give-legacy", "give-1.12", "bedrock")]
    assert [parse_banner(text) for text in texts] == [banner] * 4


def test_dye_numbers_of_1_12_and_bedrock_count_from_black():
    for name, dye in DYES.items():
        assert parse_banner(f"/give @p banner 1 {15 - dye.number}").base == name
        assert parse_banner(f'{{id:"Banner",Base:{15 - dye.number}}}').base == name


def test_the_number_of_an_old_item_is_its_base_but_its_tag_knows_better():
    assert parse_banner("/give @p banner 1 1").base == "red"
    with pytest.warns(UserWarning, match=r"the base is blue, .* 1\.12 show red"):
        assert parse_banner("/give @p banner 1 1 {BlockEntityTag:{Base:4}}").base == "blue"
    assert parse_banner("/setblock ~ ~ ~ standing_banner 8").base == "black"


@pytest.mark.parametrize(
    "text",
    [
        '{id:"Banner",Base:0,Type:1}',
        '{Name:"minecraft:banner",Damage:15s,Count:1b,tag:{Type:1}}',
        '{Name:"minecraft:banner",Count:1b,tag:{BlockEntityTag:{Type:1}}}',
        '/give @p white_banner{BlockEntityTag:{Patterns:[{Pattern:"mr",Color:9},{Pattern:"bs",'
        'Color:8},{Pattern:"cs",Color:7},{Pattern:"bo",Color:8},{Pattern:"ms",Color:15},'
        '{Pattern:"hh",Color:8},{Pattern:"mc",Color:8},{Pattern:"bo",Color:15}]}}',
    ],
)
def test_the_ominous_banner_is_the_same_on_bedrock_as_in_java(text: str):
    assert parse_banner(text) == OMINOUS
    assert parse_banner(write_banner(OMINOUS, "bedrock")) == OMINOUS


def test_a_pattern_defined_on_the_spot_is_its_asset():
    pattern = '{{asset_id:"{}",translation_key:"k"}}'
    item = f"white_banner[banner_patterns=[{{{{pattern:{pattern},color:red}}}}]]"
    assert parse_banner(item.format("acme:x")) == shorthand("white acme:x:red")
    assert parse_banner(item.format("minecraft:creeper")) == shorthand("white creeper:red")


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ('shield[base_color="red"]', "shield red"),
        ('shield[banner_patterns=[{pattern:"cross",color:"red"}]]', "shield white cross:red"),
        (
            "/give @p shield{BlockEntityTag:{Base:14,Patterns:[{Pattern:cre,Color:5}]}}",
            "shield red cre:lime",
        ),
        ('{id:"shield",count:1,components:{base_color:"red"}}', "shield red"),
        ('{id:"shield",Damage:0s,Count:1b,tag:{BlockEntityTag:{Base:1}}}', "shield red"),
    ],
)
def test_shields(text: str, expected: str):
    assert parse_banner(text) == shorthand(expected)


def test_bukkits_diagonal_right_is_the_pattern_with_the_code_rd():
    text = '{"base":"WHITE","layers":[{"colour":"RED","pattern":"DIAGONAL_RIGHT"}]}'
    assert (
        parse_banner(text) == shorthand("white rd:red") == shorthand("white diagonal_up_right:red")
    )
    assert parse_banner(text.replace("colour", "color")) == shorthand("white rd:red")
    assert parse_banner(text.replace("RIGHT", "RIGHT_MIRROR")) == shorthand("white rud:red")


@given(banner=BANNERS)
def test_banner_parse_is_the_same_parser(banner: Banner):
    assert Banner.parse(write_banner(banner, "give")) == banner


@pytest.mark.parametrize("form", FORMS)
def test_show_explains_the_example_of_every_form(form: str, drapery: Run):
    banner = parse_banner(FORMS[form].example)
    code, out, err = drapery("show", FORMS[form].example)
    assert (code, err) == (0, "")
    assert banner.base in out
    assert [layer.pattern for layer in banner.layers if layer.pattern not in out] == []


def test_who_says_wynncraft_means_bukkits_names():
    text = '{"base":"white","layers":[{"color":"red","pattern":"diagonal_right"}]}'
    assert parse_banner(text) == shorthand("white rud:red")
    assert parse_banner(text, form="wynncraft") == shorthand("white rd:red")
