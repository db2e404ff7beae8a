"""SNBT: what the union of its ages reads, and that writing and reading agree."""

import math

import pytest
from hypothesis import given, strategies as st

from drapery.banner.formats.snbt import Brackets, parse_command, parse_snbt, write_snbt

LEAVES = (
    st.text(max_size=12)
    | st.integers(-(2**70), 2**70)
    | st.floats(allow_nan=False, allow_infinity=False)
)
TREES = st.recursive(
    LEAVES,
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=8), inner),
    max_leaves=20,
)


@given(TREES)
def test_a_written_tree_is_read_as_itself(tree: object):
    assert parse_snbt(write_snbt(tree)) == tree


@pytest.mark.parametrize(
    ("text", "value"),
    [
        *(("5", 5), ("-5b", -5), ("5S", 5), ("5l", 5), ("+5", 5), ("007", 7)),
        *(("255ub", 255), ("-1sI", -1), ("1_000_000", 1_000_000)),
        *(("0x1F", 31), ("-0xff", -255), ("0xABuL", 171), ("0b101", 5), ("0B1_0", 2), ("0b", 0)),
        *(
            ("1.5", 1.5),
            (".5", 0.5),
            ("1.", 1.0),
            ("1e3", 1000.0),
            ("-1.5E-1f", -0.15),
            ("2d", 2.0),
        ),
        *(("true", 1), ("false", 0), ("bool(1)", 1), ("bool(0.0)", 0), ("bool(true)", 1)),
        *(("True", "True"), ("1.5.2", "1.5.2"), ("0x_", "0x_"), ("a.b-c+d_e", "a.b-c+d_e")),
        *(("minecraft:stone", "minecraft:stone"), ("null", "null"), ("9" * 81, "9" * 81)),
        *(("''", ""), ('"a\'b"', "a'b"), ("'a\"b'", 'a"b'), (r"'a\'b'", "a'b"), ('"a\nb"', "a\nb")),
        *((r'"\\\"\b\s\t\n\f\r"', '\\"\b \t\n\f\r'), (r'"\x41\u0042\U00000043"', "ABC")),
        *((r'"\N{Snowman}"', "☃"), (r'"\q"', "q")),
        *(("[]", []), ("[ ]", []), ("[1,]", [1]), ("[1,'a',{},[]]", [1, "a", {}, []])),
        *(
            ("[B;1b,0x2]", [1, 2]),
            ("[I;]", []),
            ("[L;1L,]", [1]),
            ("[I]", ["I"]),
            ("[a,b]", ["a", "b"]),
        ),
        *(("[0:{a:1},1:[b],2:'c']", [{"a": 1}, ["b"], "c"]), ("[a:b]", ["a:b"])),
        *(("{}", {}), ("{a:1,}", {"a": 1}), ("{'a b':1,2:3}", {"a b": 1, "2": 3})),
        *(("{a:1,a:2}", {"a": 2}), ("{a:x:y}", {"a": "x:y"}), (" {\n a\t: 1 } ", {"a": 1})),
        (
            "uuid(f81d4fae-7dec-11d0-a765-00a0c91e6bf6)",
            [-132296786, 2112623056, -1486552928, -920753162],
        ),
    ],
)
def test_values_of_every_age(text: str, value: object):
    read = parse_snbt(text)
    assert read == value and isinstance(read, type(value))


def test_numbers_past_all_bounds_stay_numbers():
    assert parse_snbt("1e999") == math.inf
    assert parse_snbt("9" * 80) == int("9" * 80)


def test_a_command_falls_into_words_brackets_and_compounds():
    text = "/give @p[tag=,distance=..5,type=!a:b] minecraft:x[a:b=[1],!c,d={e:1}]{f:'g h'} ~-1.5 12"
    assert parse_command(text) == [
        "/give",
        "@p",
        Brackets({"tag": None, "distance": "..5", "type": "!a:b"}),
        "minecraft:x",
        Brackets({"a:b": [1], "!c": None, "d": {"e": 1}}),
        {"f": "g h"},
        "~-1.5",
        "12",
    ]


def test_the_columns_of_words_are_known():
    assert [part.column for part in parse_command("give  @p x")] == [1, 7, 10]
