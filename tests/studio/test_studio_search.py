"""Patterns are found by every name that people have for them."""

import pytest

from drapery.banner import PATTERN_NAMES
from drapery.web.pattern_words import search_words


@pytest.mark.parametrize(
    ("words", "pattern"),
    [
        *(("small_stripes", "small_stripes"), ("ss", "small_stripes"), ("pirate", "skull")),
        *(("corner", "square_top_left"), ("diamond", "rhombus"), ("dot", "circle")),
        *(("frame", "border"), ("fade", "gradient"), ("zigzag", "triangles_bottom")),
        *(("vertical", "stripe_center"), ("andreaskreuz", "cross"), ("flw", "flow")),
    ],
)
def test_a_pattern_has_this_word(words: str, pattern: str) -> None:
    assert words in search_words()[pattern]


def test_every_pattern_has_words_of_its_own() -> None:
    assert set(search_words()) == set(PATTERN_NAMES)
    assert all(len(words.split()) > 6 for words in search_words().values())
