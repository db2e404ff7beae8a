"""YAML from outside: what is read, and what is refused before it costs memory or time."""

import tracemalloc

import pytest
import yaml
from hypothesis import given, strategies as st

from drapery import yaml_text
from drapery.errors import OptionError
from drapery.yaml_text import MAX_DEPTH, MAX_REPEATED, load_yaml

TEXTS = st.text(st.characters(min_codepoint=32, max_codepoint=126), max_size=20)
VALUES = st.recursive(
    st.none() | st.booleans() | st.integers() | TEXTS,
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(TEXTS, inner, max_size=4),
    max_leaves=20,
)


STAIRS = "".join(" " * step + "a:\n" for step in range(1000))
"""Each line is a mapping inside that of the line before."""


def bomb(levels: int) -> str:
    """Each line holds the line before nine times; `levels` of 9 is some 400 bytes."""
    lines = ["a0: &a0 lol"]
    for number in range(1, levels + 1):
        inner = ", ".join([f"*a{number - 1}"] * 9)
        lines.append(f"a{number}: &a{number} [{inner}]")
    return "\n".join(lines)


@given(VALUES)
def test_plain_values_come_back(value: object) -> None:
    assert load_yaml(yaml.safe_dump(value), "x.yaml") == value


def test_lists_know_the_lines_of_their_items() -> None:
    jobs = load_yaml("# jobs\n- design: red\n\n- design: blue\n- [1,\n   2]\n", "x.yaml")
    assert jobs.lines == [2, 4, 5]
    assert jobs[2].lines == [5, 6]


def test_keys_are_texts_as_they_are_written() -> None:
    text = "3: a\nyes: b\n~: c\n010: d\n2026-01-01: e\n'': f\n<<: {1.0: g, 3: h}\n"
    keys = ["1.0", "3", "yes", "~", "010", "2026-01-01", ""]
    assert load_yaml(text, "x.yaml") == dict(zip(keys, "gabcdef", strict=True))


def test_anchors_and_merges_are_read() -> None:
    text = "base: &base {size: 64x64, view: iso}\ncase:\n- {<<: *base, view: hero}\n- *base\n"
    read = load_yaml(text, "x.yaml")
    assert read["case"] == [{"size": "64x64", "view": "hero"}, {"size": "64x64", "view": "iso"}]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("a: 1\nb: [", "x.yaml, line "),
        ("a:\n  b: c: d\n", "x.yaml, line 2, column 7: ':' cannot stand here"),
        ("a: {b: 1\nc: 2", "cannot stand here in what begins in line 1; correct the YAML there"),
        ("a:\n\tb: 1\n", "x.yaml, line 2, column 1: a tab cannot stand here; use spaces"),
        ("[" * 30_000, "x.yaml, line 1, column 65: lists and mappings nest more than 64 deep"),
        ("{a: " * 30_000, "x.yaml, line 1, column 257: lists and mappings nest more than 64 deep"),
        ("- " * 30_000, "x.yaml, line 1, column 129: lists and mappings nest more than 64 deep"),
        ("? " * 30_000, "x.yaml, line 1, column 129: lists and mappings nest more than 64 deep"),
        (STAIRS, "x.yaml, line 65, column 65: lists and mappings nest more than 64 deep"),
        ("- [" * 65, "x.yaml, "),
        (bomb(9), f"aliases repeat more than {MAX_REPEATED} values"),
        ("a: &a {x: 1}\nb: *c\n", "x.yaml, line 2, column 4: *c repeats nothing: no &c stands"),
        ("a: &a [*a]\n", "x.yaml, line 1, column 8: *a repeats a value inside itself"),
        ("? [a, b]\n: 1\n", "x.yaml, line 1, column 3: a list or a mapping is no key"),
        ("- {x: 1, {}: 2}", "x.yaml, line 1, column 10: a list or a mapping is no key"),
        ("- a: 1\n  a: 2\n", "x.yaml, line 2, column 3: the key 'a' is given twice"),
        ("1: a\n'1': b\n", "x.yaml, line 2, column 1: the key '1' is given twice"),
        (f"? {'9' * 1025}\n: a\n", "x.yaml, line 1, column 3: a key has more than 1024 characters"),
        ("- <<: {[a]: 1}\n", "a list or a mapping is no key"),
        (f"a: {'9' * 5000}", "x.yaml, line 1, column 4: a number has more than 100 characters"),
        (f"a: 1{':59' * 5000}", "a number has more than 100 characters"),
        ("a: 2020-13-45", "x.yaml, line 1, column 4: '2020-13-45' is not of the type timestamp"),
        ("a: !!int x", "x.yaml, line 1, column 4: 'x' is not of the type int"),
        ("a: !!bool x", "x.yaml, line 1, column 4: 'x' is not of the type bool"),
        ("a: !!timestamp x", "x.yaml, line 1, column 4: 'x' is not of the type timestamp"),
        ("a: 1\n---\nb: 2\n", "x.yaml, line 2, column 1: a second document begins"),
        (
            "a: !!python/object:os.system x",
            "line 1, column 4: the tag tag:yaml.org,2002:python/object:os.system is not read",
        ),
        ("a: ok\nb: \x00", "x.yaml, line 2, column 4: character"),
        ("a: ok\nb: \ud800", "x.yaml, line 2, column 4: character"),
    ],
)
def test_a_fault_names_the_file_the_line_and_the_remedy(text: str, message: str) -> None:
    with pytest.raises(OptionError) as raised:
        load_yaml(text, "x.yaml")
    said = str(raised.value)
    assert message in said
    assert said.endswith("; correct the YAML there")
    assert len(said) < 300 and "\n" not in said


@pytest.mark.parametrize("loader", ["CSafeLoader", "SafeLoader"])
@pytest.mark.parametrize("before", ["", f"- '{'[' * 70}'\n", f"# {'{' * 70}\n"])
@pytest.mark.parametrize(
    ("opening", "middle", "closing"), [("[", "", "]"), ("{a: ", "1", "}"), ("- ", "1", "")]
)
def test_64_levels_are_read_and_one_more_is_refused(
    monkeypatch: pytest.MonkeyPatch,
    loader: str,
    before: str,
    opening: str,
    middle: str,
    closing: str,
) -> None:
    """Of all loaders of PyYAML, whose own limits differ; brackets in texts count for nothing."""
    monkeypatch.setattr(yaml_text, "BASE", getattr(yaml, loader))
    for depth in (MAX_DEPTH, MAX_DEPTH + 1, 1100):
        text = before + "- " + opening * (depth - 1) + middle + closing * (depth - 1)
        if depth == MAX_DEPTH:
            load_yaml(text, "x.yaml")
        else:
            with pytest.raises(OptionError, match=f"nest more than {MAX_DEPTH} deep"):
                load_yaml(text, "x.yaml")


def test_a_bomb_of_aliases_takes_no_memory() -> None:
    tracemalloc.start()
    with pytest.raises(OptionError):
        load_yaml(bomb(9), "x.yaml")
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 1 << 20


@given(st.text(st.sampled_from("ab:-[]{}&*!?|>'\"% \n#,<0159.~\t"), max_size=60))
def test_any_text_is_read_or_refused(text: str) -> None:
    try:
        load_yaml(text, "x.yaml")
    except OptionError as error:
        assert "\n" not in str(error)
