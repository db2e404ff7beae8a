"""JSON that is no JSON is said in words of ours, with its place; its depth is bounded."""

import json
import re

import pytest

from drapery.json_text import MAX_DEPTH, JSONTextError, parse_json


def test_what_is_json_is_read() -> None:
    text = '{"a": [1, 2.5, null, true, "\\u00e9\\" ["], "b": {}}'
    assert parse_json(text) == json.loads(text)
    assert parse_json('"a\tb"', strict=False) == "a\tb"
    deep = "[" * MAX_DEPTH + "]" * MAX_DEPTH
    assert parse_json(deep) == json.loads(deep)
    assert parse_json(f'"{"[" * 1000}"') == "[" * 1000, "brackets in a text are no depth"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", ", line 1, column 1: the text ends too early; complete the JSON"),
        ('{"a": 1,\n "b" 2}', ", line 2, column 6: '2' cannot stand here; correct the JSON"),
        ("[1, 2", ", line 1, column 6: the text ends too early; complete the JSON"),
        ("[1] x", ", line 1, column 5: 'x' cannot stand here; correct the JSON"),
        ('"\n"', ", line 1, column 2: '\\n' cannot stand here; correct the JSON"),
        ("[" * 100_000, f"lists and objects are nested too deep; use at most {MAX_DEPTH}"),
        ('{"a":' * 201, ", line 1: lists and objects are nested too deep"),
        ("9" * 5000, ": a number with too many digits; shorten it"),
    ],
)
def test_a_fault_names_its_place_and_the_remedy(text: str, said: str) -> None:
    with pytest.raises(JSONTextError, match=re.escape(said)):
        parse_json(text)
