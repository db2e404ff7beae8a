"""What a design takes to make by hand."""

import json

import pytest
from conftest import Run

from drapery import Banner
from drapery.banner import PATTERN_NAMES, crafting_items
from drapery.banner.pattern_items import PATTERN_ITEMS

pytestmark = pytest.mark.quick


def counts(text: str, *, consumed: bool) -> dict[str, int]:
    items = crafting_items(Banner.parse(text))
    return {one.item: one.count for one in items if one.consumed is consumed}


def test_a_plain_banner_is_wool_and_a_stick() -> None:
    assert counts("red", consumed=True) == {"red_wool": 6, "stick": 1}
    assert counts("red", consumed=False) == {}


def test_dyes_are_counted_and_pattern_items_are_kept() -> None:
    design = "white creeper:lime border:lime curly_border:black creeper:red globe:blue"
    assert counts(design, consumed=True) == {
        **{"white_wool": 6, "stick": 1, "lime_dye": 2, "black_dye": 1, "red_dye": 1},
        **{"blue_dye": 1, "paper": 2, "creeper_head": 1, "vine": 1},
    }
    assert counts(design, consumed=False) == {
        **{"creeper_banner_pattern": 1, "bordure_indented_banner_pattern": 1},
        **{"globe_banner_pattern": 1, "loom": 1},
    }


def test_a_shield_takes_a_shield() -> None:
    assert counts("shield red cross:white", consumed=True)["shield"] == 1


def test_every_pattern_that_needs_an_item_has_one() -> None:
    for pattern in PATTERN_NAMES:
        kept = counts(f"white {pattern}:red", consumed=False)
        assert len(kept) == (2 if pattern in PATTERN_ITEMS else 1), pattern


def test_older_looms_need_no_item_for_bricks() -> None:
    sources = {one.item: one.source for one in crafting_items(Banner.parse("white bricks:red"))}
    assert sources["field_masoned_banner_pattern"] == (
        "crafted from paper and bricks; not needed before 1.21.2"
    )


def test_layers_prints_the_materials(drapery: Run) -> None:
    code, out, _ = drapery("layers", "red skull:white")
    assert code == 0
    assert "takes 6 red wool, 1 stick, 1 white dye, 1 paper, 1 wither skeleton skull\n" in out
    assert "needs, but keeps, skull banner pattern, loom\n" in out


def test_layers_prints_json(drapery: Run) -> None:
    facts = json.loads(drapery("layers", "red" + " cross:white" * 7, "--json")[1])
    assert facts["survival"] is False and facts["most_layers"] == 6 and len(facts["steps"]) == 7
    assert facts["steps"][0] == {"pattern": "cross", "dye": "white", "item": None}
    dye = {"item": "white_dye", "count": 7, "consumed": True, "source": ""}
    assert dye in facts["materials"]
