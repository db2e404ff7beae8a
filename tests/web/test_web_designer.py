"""The designer reads texts and writes the commands of all versions as Python does."""

import re
from collections.abc import Iterator
from itertools import cycle

import fuzz_targets
import fuzzing
import pytest
from page_reader import NODE, plain, read_in_page, some_banners

from drapery import Banner, DesignError
from drapery.banner import (
    FORMS,
    ItemDetails,
    crafting_items,
    parse_banners,
    write_banner,
    write_give,
)
from drapery.web import tables

pytestmark = pytest.mark.skipif(NODE is None, reason="node is not installed (apt: nodejs)")

VERSIONS = ("give", "give", "give-legacy", "give-1.12", "bedrock")
"""The forms of the texts that the designer writes, in its order; the second has names in JSON."""
DETAILS = (
    ItemDetails(),
    ItemDetails(count=16, name="Flag of the North"),
    ItemDetails("@a", 3, 'A "quoted" name', ("First line", "second \\ line")),
    ItemDetails("Steve", 1, {"text": "Drache", "color": "red"}, ({"text": "aus Glück"},)),
    ItemDetails("@s", 64, "骷髅", ("",)),
)
HELD = (
    '/summon zombie ~ ~ ~ {equipment:{head:{id:"red_banner",count:1}}}',
    '/summon minecraft:zombie ~ ~1 ~ {ArmorItems:[{},{},{},{id:"minecraft:lime_banner",Count:1b,'
    'tag:{BlockEntityTag:{Patterns:[{Pattern:"cre",Color:15}]}}}]}',
    'summon Zombie ~ ~ ~ {Equipment:[{},{},{},{},{id:"minecraft:banner",Damage:4s,tag:'
    '{BlockEntityTag:{Patterns:[{Pattern:"cre",Color:0}]}}}]}',
    '/summon item ~ ~ ~ {Item:{id:"shield",count:1,components:{base_color:"red"}}}',
)


def texts() -> Iterator[str]:
    """Over 400 texts, of every form that people paste, with and without an item's details."""
    details = cycle(DETAILS)
    forms = (*fuzz_targets.PAGE_FORMS, "summon", "bedrock")
    for form in forms:
        for banner in some_banners():
            try:
                yield write_banner(banner, form)
                if form.startswith("give"):
                    yield from (write_give(banner, form, next(details)) for _ in range(3))
            except DesignError:
                continue
    yield from HELD


def written(banner: Banner, details: ItemDetails) -> list[str | None]:
    """What Python writes for the designer's versions; None for what a version cannot hold."""
    found: list[str | None] = []
    for number, form in enumerate(VERSIONS):
        as_json = ItemDetails(
            details.target, details.count, details.name, details.lore, json_text=number == 1
        )
        try:
            text = write_give(banner, form, as_json) if form != "bedrock" else None
            found.append(text or write_banner(banner, form))
        except DesignError:
            found.append(None)
    return found


def test_the_tables_are_those_of_python() -> None:
    assert tables.DESIGNER_PATH.read_text(encoding="utf-8") == tables.designer_module()


def test_all_languages_have_all_texts_with_their_places() -> None:
    texts = tables.english()
    assert len(tables.languages()) == 9
    for language in tables.languages().values():
        assert language["texts"].keys() == texts.keys()
        for key, text in language["texts"].items():
            places = re.findall(r"{\w+}", text)
            assert sorted(places) == sorted(re.findall(r"{\w+}", texts[key])), (key, text)


def test_the_designer_reads_and_writes_what_python_does() -> None:
    given = [*texts()]
    assert len(given) > 400
    for text in given:
        (found,) = parse_banners(text)
        answer = read_in_page("pasted", text)
        assert answer.found is not None, (text, answer)
        assert answer.found["design"] == plain(found.banner), text
        details = found.details or ItemDetails()
        assert answer.found["texts"] == written(found.banner, details), text
        assert answer.found["left"] == [], text


def test_the_materials_are_those_of_python() -> None:
    for banner in some_banners():
        items = crafting_items(banner)
        found = read_in_page("materials", write_banner(banner, "shorthand")).found
        named = [("_".join([*filter(None, (m.get("dye"), m["item"]))]), m["count"]) for m in found]
        kept = sum(not item.consumed and item.item != "loom" for item in items)
        used = [(item.item, item.count) for item in items if item.consumed]
        assert named == [*used, *kept * [("bannerPattern", 1)]]


def test_the_address_of_a_design_is_read_again() -> None:
    for banner in some_banners():
        address = read_in_page("pasted", write_banner(banner, "shorthand")).found["hash"]
        again = read_in_page("pasted", f"https://example.com/designer/#{address}")
        assert again.found["design"] == plain(banner), address
        assert len(address) < 400


def test_what_is_not_kept_is_named() -> None:
    text = '/give Steve red_banner[custom_name="Flag",enchantments={sharpness:1},rarity=epic] 2000'
    answer = read_in_page("pasted", text)
    assert answer.found["left"] == ["enchantments", "rarity", "count"]
    assert answer.found["texts"][0] == '/give Steve minecraft:red_banner[custom_name="Flag"]'


def test_texts_that_no_page_reads_are_errors() -> None:
    for text in (
        "plaid",
        "https://example.com/#plaid",
        "/summon pig ~ ~ ~",
        "/summon pig ~ ~ ~ {}",
    ):
        assert read_in_page("pasted", text).error == "DesignError", text


def test_changed_texts_are_read_alike_or_refused() -> None:
    target = fuzz_targets.designer_target()
    report = fuzzing.fuzz(target.read, target.samples, target.mutate, 600, seed=3)
    assert not report.failures, report.failures[0]
    assert report.count == 600 and report.outcomes["a banner"] > 10


def test_forms_of_the_corpus_are_known() -> None:
    assert set(VERSIONS) <= set(FORMS)
