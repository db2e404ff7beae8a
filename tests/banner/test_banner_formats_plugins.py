"""The forms of plugins, mods and editors, and what surrounds a copied text."""

import re

import pytest

from drapery.banner.design import Banner, Layer
from drapery.banner.formats import FORMS, parse_banner, parse_banners, recognise, write_banner
from drapery.errors import DesignError

CREEPER = Banner.parse("white creeper:lime border:black")
ACME = Banner("white", (Layer("acme:anvil", "red"),))

STACK = """saved:
  one:
    ==: org.bukkit.inventory.ItemStack
    v: 2586
    type: WHITE_BANNER
    meta:
      ==: ItemMeta
      meta-type: BANNER
      display-name: '{"text":"One"}'
      patterns:
      - ==: Pattern
        color: LIME
        pattern: cre
      - ==: Pattern
        color: BLACK
        pattern: bo
  two:
    ==: org.bukkit.inventory.ItemStack
    type: STONE
"""
NEW_STACK = """==: org.bukkit.inventory.ItemStack
DataVersion: 4325
id: minecraft:white_banner
count: 1
components:
  minecraft:banner_patterns: '[{color:"lime",pattern:"creeper"},{color:"black",pattern:"border"}]'
  minecraft:custom_name: '"One"'
schema_version: 1
"""
OLD_STACK = """item:
  ==: org.bukkit.inventory.ItemStack
  type: BANNER
  damage: 15
  meta:
    ==: ItemMeta
    meta-type: BANNER
    base-color: WHITE
    patterns:
    - {color: LIME, pattern: cre}
    - {color: BLACK, pattern: bo}
"""
LAYERS = '[{pattern:"creeper",color:"lime"},{pattern:"minecraft:border",color:"black"}]'
NEW = f"[banner_patterns={LAYERS}]"
TAG = '{BlockEntityTag:{Patterns:[{Pattern:"cre",Color:5},{Pattern:"bo",Color:15}]}}'

NEW_ITEM = (
    "ItemStack i = new ItemStack(Material.RED_BANNER); BannerMeta m = (BannerMeta) i.getItemMeta();"
)
PATTERN = "new Pattern(DyeColor.LIME, PatternType.CREEPER)"
ADDED = f"m.addPattern({PATTERN});"
CODE = """ItemStack a = new ItemStack(Material.WHITE_BANNER, 1);
BannerMeta meta = (BannerMeta) a.getItemMeta(); // meta.addPattern(new Pattern(DyeColor.RED,
meta.addPattern(new Pattern(DyeColor.LIME, PatternType.CREEPER));
/* meta.addPattern(new Pattern(DyeColor.RED, PatternType.CROSS)); */
meta.addPattern(new org.bukkit.block.banner.Pattern(
    DyeColor.BLACK, PatternType.BORDER));
a.setItemMeta(meta);
"""

SAME = {
    "java": [
        CODE,
        CODE.replace("WHITE_BANNER, 1", "BANNER, 1, (short) 15"),
        CODE.replace("WHITE_BANNER, 1", "BANNER") + "meta.setBaseColor(DyeColor.WHITE);",
        "val flag = ItemStack(Material.WHITE_BANNER)\nval meta = flag.itemMeta as BannerMeta\n"
        "meta.setPatterns(listOf(Pattern(DyeColor.LIME, PatternType.CREEPER),\n"
        "    Pattern(DyeColor.BLACK, PatternType.BORDER)))\n",
        "new ItemBuilder(Material.WHITE_BANNER).addPattern(new Pattern(DyeColor.RED,"
        " PatternType.FLOW))\n.addPattern(new Pattern(DyeColor.BLACK, PatternType.BORDER))"
        ".setPattern(0, new Pattern(DyeColor.LIME, PatternType.CREEPER))",
        "block.setType(Material.WHITE_BANNER);\nBanner flag = (Banner) block.getState();\nflag"
        ".addPattern(new Pattern(DyeColor.RED, PatternType.CROSS));\nflag.removePattern(0);\n"
        "flag.setPatterns(List.of(new Pattern(DyeColor.LIME, PatternType.CREEPER), new"
        " Pattern(DyeColor.BLACK, PatternType.BORDER)));",
    ],
    "bannermaker": ["Qk0Cd2hpdGU7Y3JlZXBlcjpsaW1lO2JvcmRlcjpibGFjaw=="],
    "bukkit": [
        STACK,
        NEW_STACK,
        OLD_STACK,
        "a:\n  ==: org.bukkit.inventory.ItemStack\n  id: minecraft:white_banner\n  components: '{\""
        'minecraft:banner_patterns":[{"pattern":"creeper","color":"lime"},{"pattern":"border",'
        '"color":"black"}]}\'\n',
    ],
    "bentobox": [
        "WHITE_BANNER:1:CREEPER:LIME:BORDER:BLACK",
        "meta:\n  banner: WHITE_BANNER:1:CREEPER:LIME:BORDER:BLACK\n",
    ],
    "deluxemenus": [
        "items:\n  flag:\n    material: WHITE_BANNER\n    slot: 3\n    banner_meta:\n"
        "    - 'LIME;CREEPER'\n    - 'black;border'\n",
    ],
    "crazycrates ": [
        "x:\n  material: white_banner\n  meta:\n    patterns: [LIME:CREEPER, BLACK:BORDER]\n",
    ],
    "deluxemenus ": [
        "x:\n  material: white_banner\n  meta:\n    banner_meta:\n    - LIME;CREEPER\n"
        "    - BLACK;BORDER\n",
    ],
    "commandpanels": [
        "item:\n  '3':\n    material: white_banner\n    banner:\n    - LIME,CREEPER\n"
        "    - BLACK,BORDER\n",
    ],
    "mythicmobs": [
        "Flag:\n  Id: white_banner\n  BannerLayers:\n  - LIME CREEPER\n  - BLACK BORDER\n",
        "Flag:\n  Id: banner\n  Options:\n    Color: WHITE\n  BannerLayers:\n  - LIME CREEPER\n"
        "  - BLACK BORDER\n",
    ],
    "crazycrates": [
        'Prizes:\n  "6":\n    DisplayItem: white_banner\n    DisplayPatterns:\n'
        "    - creeper:lime\n    - border:black\n",
        "Items:\n  '1':\n    material: white_banner\n    settings:\n      patterns:\n"
        "        creeper: lime\n        border: black\n",
    ],
    "yaml": [
        "item:\n  type: white_banner\n  banner-patterns:\n    1:\n      type: creeper\n"
        "      color: lime\n    2: {color: BLACK, type: minecraft:border}\n",
        "item:\n  banner-patterns:\n    2: {color: BLACK, type: border}\n    1: {color: LIME, type:"
        " creeper}\n  type: white_banner\n",
        "banner:\n  base-color: WHITE\n  patterns:\n    '1':\n      type: CREEPER\n"
        "      color: LIME\n    '2':\n      type: BORDER\n      color: BLACK\n",
        "icon: white_banner # it\nmeta:\n  banner-patterns: # LIME:CREEPER\n  - LIME:creeper\n"
        "  - BLACK:minecraft:border\n  lore: ['Red: cross', 'red:cross']\n",
        "- base: WHITE_BANNER\n  banner-patterns:\n    CREEPER: LIME\n    BORDER: BLACK\n",
        "item: WHITE_BANNER\nlayers: [{dye: lime, pattern: creeper}, {dye: black, pattern: bo}]\n",
        "item: WHITE_BANNER\nbanner-patterns: creeper:lime|border:black\n",
        "'1718':\n  color: WHITE\n  patterns:\n  - cre:LIME\n  - bo:BLACK\n",
    ],
    "essentialsx": [
        "white_banner 1 basecolor:16383998 cre,8439583 bo,1908001",
        "kits:\n  flag:\n  - white_banner 1 name:&4Flag cre,8439583 bo,1908001\n",
        "kits:\n  a:\n    items:\n    - BANNER:15 1 basecolor:16777215 cre:8375321 bo:1644825\n",
        "- 'white_banner 1  name:My Flag cre,8439583 bo,1908001'",
        "- banner:15 1 basecolor:16777215 CREEPER:8375321 BORDER:1644825",
        "/give Steve white_banner 1 basecolor:WHITE cre,8439583 bo,1908001",
    ],
    "denizen": [
        "white_banner[patterns=LIME/CREEPER|BLACK/BORDER]",
        "- give i@white_banner[display=Flag;patterns=li@LIME/CREEPER|BLACK/BORDER|]",
        "- define flag <item[white_banner].with[patterns=LIME/CREEPER|BLACK/BORDER]>",
        "flag:\n  type: item\n  material: white_banner\n  mechanisms:\n    hides: ALL\n"
        "    patterns: lime/CREEPER|black/BORDER\n",
        "    equipment: air|air|air|white_banner[patterns=<list[lime/creeper|black/border]>]",
        "flag:\n    type: item\n    material: white_banner\n    mechanisms:\n        patterns:\n"
        "        # two\n        - LIME/CREEPER\n        - 'BLACK/BORDER' # the rim\n",
        "flag:\n  type: item\n  material: white_banner\n  mechanisms:\n"
        "    patterns: <list[LIME/CREEPER|BLACK/BORDER]>\n",
        "flag:\n  type: item\n  mechanisms:\n    patterns: lime/creeper|black/border  # comment\n"
        "    hides: all\n  material: white_banner\n",
    ],
    "skript": [
        "set {_b} to a white banner\n"
        "add a creeper banner pattern colored lime to banner patterns of {_b}\n"
        "add bordure banner pattern coloured black to {_b}'s banner patterns\n",
        "set {_b} to white banner\nset {_p} to a creeper banner pattern colored lime\n"
        "add {_p} to banner patterns of {_b}\n"
        "set the 2nd banner pattern of {_b} to a border banner pattern colored black",
        "command /flag:\n  trigger:\n    set {_b} to white banner\n    add (creeper charged banner"
        " pattern colored lime), (border banner pattern colored black) to banner patterns of {_b}",
    ],
    "crafttweaker": [
        f"<item:minecraft:white_banner>.withTag({TAG})",
        'craftingTable.addShapeless("x", <item:minecraft:white_banner>.withTag(\n  {BlockEntityTag:'
        ' {Patterns: [{Pattern: "cre" as string, Color: 5 as int}, {Pattern: "bo", Color: 15}],'
        ' id: "minecraft:banner"}}), [<item:minecraft:red_banner>]);',
        "<item:minecraft:white_banner>.withJsonComponent(<componenttype:minecraft:banner_patterns>"
        ', [\n  {color: "lime", pattern: "minecraft:creeper"},\n'
        '  {color: "black", pattern: "minecraft:border"}\n])',
        "<minecraft:banner:15>.withTag({BlockEntityTag: {Patterns: [{Color: 10, Pattern: "
        '"cre"}, {Color: 0, Pattern: "bo"}]}})',
    ],
    "kubejs": [
        f"Item.of('minecraft:white_banner', '{TAG}')",
        f"Item.of('minecraft:shield', '{{Damage:0}}'); Item.of('white_banner', '{TAG}')",
        f"e.shaped(Item.of('minecraft:white_banner', 2, '{TAG}'), ['A'], {{A: 'minecraft:dirt'}})",
        f"Item.of('minecraft:white_banner').withNBT({TAG})",
        'Item.of(\'white_banner[banner_patterns=[{pattern:"creeper",color:"lime"},'
        '{pattern:"border",color:"black"}]]\')',
        f"Item.of('white_banner', '{TAG[:-1]},display:{{Name:\\'{{\"text\":\"x\"}}\\'}}}}')",
        f"Item.of('2x minecraft:white_banner{NEW}')",
        f"Item.of(`white_banner`, 3, `{NEW}`)",
        f"event.shapeless(Item.of('ominous_bottle'), [`minecraft:white_banner{NEW}`, 'stick'])",
        f"Item.of('white_banner', {{'minecraft:banner_patterns': {LAYERS}}})",
        f"Item.of('white_banner').withCount(2).set('banner_patterns', {LAYERS}).withLore('x')",
        f"const flag = {TAG};\nevent.shaped(Item.of('white_banner', flag), ['AAA'])",
        f"let layers = {LAYERS}\nItem.of('white_banner').set('minecraft:banner_patterns', layers)",
    ],
    "loom-assistant": [
        '{"description":"x","author":"y","banner_color":"white","layers":[{"pattern":'
        '"minecraft:creeper","color":"lime"},{"pattern":"minecraft:border","color":"black"}]}',
    ],
    "gamergeeks": [
        "https://www.gamergeeks.net/apps/minecraft/banner-maker#mcb=a0cre5bo15",
        "gamergeeks.nz/apps/minecraft/banner-maker#mcb=a0cre5bo15",
        "a0cre5bo15",
    ],
    "bannotation": ["Wh. Li-Cr. Bk-F.", "Wh. Li-Cr. Bk-F", "Wh.Li-Cr.\nBk-F."],
    "bannerfont": [
        "\ue000\U000cfff7\ue804\U000cfff7\ue301",
        "\ue00d\ue000\U000cfff7\ue804\U000cfff7\ue301\ue00f",
        "https://banner-writer.web.app/?writing=%EE%80%80%F3%8F%BF%B7%EE%A0%84%F3%8F%BF%B7%EE%8C%81",
    ],
    "optifine": [
        "http://optifine.net/showBanner?format=pakkac&valign=m",
        "https://optifine.net/banners&&pakkac",
    ],
}


@pytest.mark.parametrize(("form", "text"), [(f, t) for f, texts in SAME.items() for t in texts])
def test_every_form_of_a_program_is_recognised_and_read(form: str, text: str):
    assert recognise(text).name == form.strip()
    assert parse_banner(text) == CREEPER


def test_a_variable_has_the_value_that_it_had_last():
    other = TAG.replace("cre", "flo")
    item = "Item.of('white_banner', nbt)"
    first, second = parse_banners(f"let nbt = {TAG}\n{item}\nnbt = {other}\n{item}")
    assert first.banner == CREEPER and second.banner.layers[0].pattern == "flower"


def test_the_patterns_of_code_go_to_their_own_items():
    code = (
        "ItemStack a = new ItemStack(Material.RED_BANNER), b = new"
        " ItemStack(Material.BLUE_BANNER);\nBannerMeta one = (BannerMeta) a.getItemMeta();"
        " BannerMeta two = (BannerMeta) b.getItemMeta();"
        f"\ntwo.addPattern({PATTERN});\none.addPattern({PATTERN.replace('LIME', 'BLACK')});"
    )
    assert [one.banner for one in parse_banners(code)] == [
        Banner.parse("red creeper:black"),
        Banner.parse("blue creeper:lime"),
    ]


@pytest.mark.parametrize(
    "call",
    [
        "Item.of('white_banner').withNBT(makeNbt('creeper'))",
        "Item.of('white_banner', 2, design)",
        "Item.of('white_banner', design)",
        "Item.of('white_banner', Object.assign({}, base))",
        "Item.of('white_banner').set('banner_patterns', layers)",
    ],
)
def test_a_tag_that_a_script_makes_is_not_a_plain_banner(call: str):
    with pytest.raises(DesignError, match="is not in the text; write it into the call"):
        parse_banner(call)


def test_other_components_may_be_anything():
    text = "Item.of('shield').set('custom_name', name).set('lore', f(1)).set('base_color', 'red')"
    assert parse_banner(text) == Banner.parse("red shield")


@pytest.mark.parametrize("amount", ["2", "2 * 3", "count", "n", "stackSize"])
def test_an_amount_is_not_a_tag(amount: str):
    assert parse_banner(f"Item.of('white_banner', {amount})") == Banner.parse("white")


@pytest.mark.parametrize("form", ["bukkit", "crafttweaker", "kubejs", "loom-assistant"])
def test_patterns_of_data_packs_are_written_where_the_program_reads_them(form: str):
    assert parse_banner(write_banner(ACME, form)) == ACME


def test_bukkit_is_written_for_old_servers_where_that_holds_the_banner():
    assert "meta-type: BANNER" in write_banner(CREEPER, "bukkit")
    assert "schema_version: 1" in write_banner(Banner.parse("white flow:red"), "bukkit")


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        (STACK.replace("pattern: bo", "pattern: zz"), ["one.meta.patterns[1].pattern", "'zz'"]),
        (STACK.replace("LIME", "LIMEY"), ["one.meta.patterns[0].color", "'LIMEY'", "'lime'"]),
        (
            STACK.replace("WHITE_BANNER", "STONE").replace("BANNER", "X"),
            ["no banner", "type: RED_BANNER"],
        ),
        ("meta-type: BANNER\npatterns: []\n", ["meta-type", "type: RED_BANNER"]),
        ("banner_meta:\n- LIME;CREEPER\n", ["banner_meta", "the item is missing", "material"]),
        ("material: RED_BANNER\nbanner_meta:\n- LIME\n", ["banner_meta[0]", "RED;CREEPER"]),
        ("material: STONE\nbanner_meta:\n- RED;BASE\n", ["material", "'STONE'", "WHITE_BANNER"]),
        ("material: RED_BANNER\nbanner_meta: 5\n", ["banner_meta", "5", "not a list of layers"]),
        ("material: RED_BANNER\npatterns: [LIME:KREEPER]\n", ["patterns[0]", "'KREEPER'"]),
        ("material: RED_BANNER\npatterns: [LIMEY:CREEPER]\n", ["patterns[0]", "'LIMEY'"]),
        (
            "material: RED_BANNER\na: {patterns: [RED:CROSS]}\nb: {patterns: [RED:CROSS]}\n",
            ["b.patterns", "a.patterns too"],
        ),
        ("x:\n  patterns: [RED:CROSS]\n  y: {material: RED_BANNER}\n", ["x.patterns", "missing"]),
        (
            "x:\n  base_color: RED\n  y: {material: SHIELD, patterns: [RED:CROSS]}\n",
            ["x.base_color", "beside no item"],
        ),
        (
            "x:\n  type: BANNER\n  patterns: [RED:CROSS]\n  base-color: RED\n  a: {base: BLUE}\n",
            ["x.a.base", "x.base-color too"],
        ),
        (ADDED, ["line 1", "the base dye is missing", "Material.WHITE_BANNER"]),
        (f"{NEW_ITEM}{ADDED}m.addPattern(layer);", ["line 1", "'layer' is not a layer"]),
        (f"{NEW_ITEM}layers.add({PATTERN});", ["line 1", "keeps before it adds them"]),
        (f"{NEW_ITEM}m.setPattern(3, {PATTERN});", ["line 1", "there is no layer 3"]),
        (f"{NEW_ITEM}m.setBaseColor(dye);{ADDED}", ["line 1", "'dye' is not a dye"]),
        (f"{NEW_ITEM}m.addPattern({PATTERN}", ["line 1", "not closed"]),
        ("Qk0CcmVkO2NyZWVwZXI6YmxhY2", ["not a whole code of BannerMaker"]),
        ("Qk0CcmVkO2NyZWVwZXI=", ["layer 1", "'creeper' has no dye"]),
        ("RED_BANNER:1:CREEPER", ["'CREEPER' has no dye", "PATTERN:DYE"]),
        ("PINKY_BANNER:1:CREEPER:RED", ["'PINKY_BANNER'", "RED_BANNER"]),
        ("white_banner 1 cre,8439583;", ["'cre,8439583;' is not a layer"]),
        ("white_banner 1 basecolor:5", ["'5'", "RED"]),
        ("red_banner[patterns=LIME]", ["'LIME'", "LIME/CREEPER"]),
        ("red_banner[patterns=<[layers]>|LIME/CREEPER]", ["filled in by the script"]),
        (
            "add creeper banner pattern colored lime to banner patterns of {_b}",
            ["{_b}", "the base is missing", "set {_b} to white banner"],
        ),
        ("Item.of('minecraft:white_banner', '{BlockEntityTag:5}')", ["line 1", "5"]),
        ("Item.of('minecraft:white_banner', '{Blo", ["line 1", "is not closed"]),
        ("Item.of('white_banner', flagTag)", ["line 1 white_banner", "flagTag is not in the text"]),
        ("event.shaped('white_banner[banner_patterns=[')", ["line 1 white_banner", "expected ']'"]),
        ("\nevent.x('white_banner[", ["line 2", "the quote ' is not closed"]),
        ("Item.of('red_banner[lore=[]]').set('banner_patterns', [])", ["a tag and calls of set()"]),
        ("Item.of('red_banner').set('banner_patterns', [5])", ["line 1 red_banner", "5"]),
        ("<item:minecraft:white_banner>.withTag({a:})", ["line 1", "minecraft:white_banner"]),
        ('{"banner_color":"whit","layers":[]}', ["banner_color", "did you mean 'white'"]),
        ("https://www.gamergeeks.net/apps/minecraft/banners/letters", ["no #mcb="]),
        ("https://www.gamergeeks.net/apps/minecraft/banner-maker#mcb=a15zz3", ["'zz'"]),
        ("https://optifine.net/home", ["no ?format="]),
    ],
)
def test_a_fault_names_its_place_and_what_to_write(text: str, parts: list[str]):
    with pytest.raises(DesignError) as caught:
        parse_banners(text)
    message = str(caught.value)
    assert [part for part in parts if part not in message] == [], message
    assert len(message.splitlines()) == 1


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        ("flag:\n  item: RED_BANNER\n  slot: 3\n", ["YAML of a plugin", "DeluxeMenus"]),
        ("meta.addPattern(new Pattern(DyeColor.RED, type));", ["program code", "not written out"]),
        ("<!DOCTYPE html>\n<p>banner</p>", ["a web page", "/give"]),
        ("H4sIAAAAAAAA" * 9, ["base64", "/data get entity @s SelectedItem"]),
    ],
)
def test_a_text_of_no_form_is_told_what_it_resembles(text: str, parts: list[str]):
    with pytest.raises(DesignError) as caught:
        parse_banners(text)
    assert [part for part in parts if part not in str(caught.value)] == [], str(caught.value)


def test_bannotation_joins_patterns_of_a_dye_and_gradients_of_a_base():
    gradient = parse_banner("Gn+Li-Gx. Bk-Tmb+Tmt+Sch.")
    assert gradient == Banner.parse(
        "green gradient_up:lime triangles_bottom:black triangles_top:black stripe_middle:black"
    )
    with pytest.raises(DesignError, match="'Zz' is not a dye; the sixteen are Wh, Lg"):
        parse_banner("Wh. Zz-Cr.")
    with pytest.raises(DesignError, match="'Qq' is not a pattern"):
        parse_banner("Wh. Bk-Qq.")


def test_optifine_shows_eight_layers_without_mojang():
    nine = Banner("red", (Layer("cross", "lime"),) * 9)
    with pytest.raises(DesignError, match="at most 8 layers"):
        write_banner(nine, "optifine")
    with pytest.raises(DesignError, match="mojang"):
        write_banner(Banner.parse("red mojang:lime"), "optifine")
    give = '/give @p red_banner[banner_patterns=[{pattern:"cross",color:"lime"}]]'
    assert "showBanner?format=bakj&" in write_banner(parse_banner(give), "optifine")


def test_all_items_of_a_file_are_found_with_their_places():
    text = "a:\n  material: RED_BANNER\n  banner_meta: [LIME;CROSS]\nb:\n- material: BLUE_BANNER\n"
    assert [one.where for one in parse_banners(text)] == ["a", "b[0]"]
    inner = (
        "a:\n  material: RED_BANNER\n  next: {material: BLUE_BANNER, banner_meta: [LIME;CROSS]}\n"
    )
    assert [one.where for one in parse_banners(inner)] == ["a", "a.next"]
    script = "- give red_banner[patterns=LIME/CROSS]\n- give blue_banner[patterns=RED/CROSS]\n"
    assert [one.where for one in parse_banners(script)] == [
        "line 1 red_banner",
        "line 2 blue_banner",
    ]


WRAPPED = [
    "`{}`",
    "```mcfunction\n{}\n```",
    "“{}”",
    "„{}“",
    "«{}»",
    "{},8",
    "{}:256",
    "\u200b{}\u00a0",
]


@pytest.mark.parametrize("wrapping", WRAPPED)
@pytest.mark.parametrize(
    "form", ["give-legacy", "shorthand", "planet-minecraft", "needcoolshoes", "gamergeeks", "item"]
)
def test_what_surrounds_a_copied_text_is_removed(form: str, wrapping: str):
    text = write_banner(CREEPER, form)
    assert parse_banner(wrapping.format(text)) == CREEPER


@pytest.mark.parametrize("bullet", ["- ", "* ", "1. "])
@pytest.mark.parametrize("form", ["give", "give-legacy", "shorthand", "item", "essentialsx"])
def test_an_item_of_a_list_is_read_by_itself(form: str, bullet: str):
    assert parse_banner(bullet + write_banner(CREEPER, form)) == CREEPER


@pytest.mark.parametrize("text", ["<{}>", "[mine]({})", '[mine]({} "title")', "![mine](<{}>)"])
def test_links_are_unwrapped(text: str):
    assert parse_banner(text.format(write_banner(CREEPER, "planet-minecraft"))) == CREEPER


def test_typographic_and_escaped_quotes_of_a_command_are_quotes():
    give = write_banner(CREEPER, "give")
    left_right = give.replace('"', "“", 1).replace('"', "”")
    escaped = give.replace('"', '\\"')
    texts = (escaped, left_right, give.replace('"', "’"), f'"{give}"', f'\\"{escaped}\\"')
    for text in texts:
        assert parse_banner(text) == CREEPER


def test_an_amount_after_a_plain_item_is_removed():
    assert parse_banner("minecraft:red_banner,8") == parse_banner("red_banner:64") == Banner("red")
    with pytest.raises(DesignError):
        parse_banner("red:5")


@pytest.mark.parametrize(
    ("text", "form"),
    [
        ("2c729cmcf28", "planet-minecraft"),
        ("b1f", "planet-minecraft"),
        ("ealleNhEehppai", "needcoolshoes"),
        ("paalpwpEac", "needcoolshoes"),
        ("color_id_0=4&shape_id_1=28&color_id_1=15", "minecraft-tools"),
        ("?color_id_0=4", "minecraft-tools"),
        ("a15bs0", "gamergeeks"),
        ("beige", "shorthand"),
        ("cafe", "shorthand"),
        ("Beige", "shorthand"),
        ("lime", "shorthand"),
        ("123", "shorthand"),
    ],
)
def test_the_code_of_an_editor_is_known_without_its_address(text: str, form: str):
    assert recognise(text).name == form


def test_a_command_over_several_lines_is_one():
    give = write_banner(CREEPER, "give").replace("[", "[\n  ").replace("{", "\n  {")
    assert parse_banner(give) == CREEPER


def test_all_forms_have_a_writer():
    assert [name for name, form in FORMS.items() if form.write is None] == []


def test_bannerfont_has_several_banners_and_names_a_bad_character():
    found = FORMS["bannerfont"].read("\ue600_\ue300\U000cfff7\ue022\ue00a \uec00")
    assert [(one.banner.base, len(one.banner.layers), one.where) for one in found] == [
        ("red", 0, "banner 1"),
        ("black", 1, "banner 2"),
        ("blue", 0, "banner 3"),
    ]
    assert found[1].banner.layers[0].pattern == "skull"
    for text, named in {
        "\ue000\U000cfff7\ue80a": "character 3, U+E80A",
        "\ue000\U000cfff7\ue843": "character 3, U+E843",
        "\ue804": "character 1, U+E804",
        "\ue000\ue804": "character 2, U+E804",
        "\ue000x": "character 2, U+0078",
    }.items():
        with pytest.raises(DesignError, match=re.escape(named)):
            FORMS["bannerfont"].read(text)


def test_scripts_of_denizen_have_plain_banners_and_shields_with_a_base() -> None:
    text = (
        "plain:\n  type: item\n  material: red_banner\n\ntask:\n  type: task\n"
        "  material: blue_banner\n\nshield:\n  type: item\n  material: shield\n"
        "  mechanisms:\n    base_color: 'RED'\n    patterns: WHITE/CREEPER\n"
    )
    found = [one.banner for one in parse_banners(text, form="denizen")]
    shield = Banner("red", (Layer("creeper", "white"),), "shield")
    assert found == [Banner("red"), shield]
    with pytest.raises(DesignError, match="line 3: the item is missing"):
        parse_banners(
            "flag:\n  type: item\n  patterns: WHITE/CREEPER\nother:\n  material: red_banner",
            form="denizen",
        )
