"""Objects of JavaScript: what is written out is read, what is computed is refused."""

import warnings

import pytest

from drapery.banner.formats import parse_banner, parse_banners, recognise
from drapery.errors import DesignError

LIME = parse_banner("red creeper:lime")
LAYERS = "[{ pattern: 'creeper', color: 'lime', }, ]"
COMPONENTS = f"components: {{ 'minecraft:banner_patterns': {LAYERS} }}"


@pytest.mark.parametrize(
    "text",
    [
        f"const banner = {{ base: 'red', layers: {LAYERS}, }};",
        f"{{ id: 'minecraft:red_banner', count: 32 * 2, {COMPONENTS} }}",
        f"{{ /* red */ base: 'red', // a note\n layers: {LAYERS} }}",
        f"export default {{ base: `red`, layers: {LAYERS} }}",
        f"'use strict';\nmodule.exports = {{ base: 'r\\x65\\u0064', layers: {LAYERS} }};",
        f"spawn({{ id: 'red_banner', {COMPONENTS} }}, 3);",
        f"let items = [{{ id: 'red_banner', at: pos(1, 'x'), use() {{ go(); }}, {COMPONENTS} }}]",
        f"import a from 'b';\nf((x) => {{ if (x) {{ return {{ a: 1 }}; }} }}, {{ b: 3 > 2 }});\n"
        f"// const old = {{ base: 'blue', layers: {LAYERS} }};\n"
        f"const banner = {{ base: 'red', layers: {LAYERS} }};",
        f"var b = {{ id: 'red_banner', name: `a ${{b}}`, on: () => {{ a(); }}, {COMPONENTS} }};",
        '{"base": "red", /* "base": "blue", */ "layers": [{"pattern": "cre", "color": "lime"}]}',
    ],
)
def test_an_object_is_read(text: str) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert [one.banner for one in parse_banners(text)] == [LIME]


def test_each_object_has_its_line() -> None:
    text = f"const a = {{ base: 'red', layers: {LAYERS} }};\nconst b = {{ base: 'blue' }};"
    found = parse_banners(text)
    assert [(str(one.banner.base), one.where) for one in found] == [
        ("red", "line 1"),
        ("blue", "line 2"),
    ]


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        (
            f"{{ id: 'red_banner', {COMPONENTS} }}".replace("'lime'", "a[0]"),
            ["banner_patterns[0].color", "the dye is the expression 'a[0]'"],
        ),
        (
            "const b = { base: 'red', layers: [{ pattern: dark ? 'a' : 'b', color: 'lime' }] };",
            ["line 1: layers[0].pattern", "the pattern is the expression"],
        ),
        ("const b = { base: dye(3), layers: [] };", ["line 1: base", "the base dye is the expr"]),
        ("const b = { base: 'red', layers: make(3) };", ["list of layers is the expression"]),
        ("const b = { base: 'red', layers };", ["list of layers is the expression 'layers'"]),
        ("const b = { base: 'red', layers: [...more] };", ["layer is the expression '...more'"]),
        (f"const b = {{ id: 'red_' + kind, {COMPONENTS} }};", ["base dye is the expression"]),
        (
            "const b = { id: 'red_banner' };\nb.p.push({ pattern: 'creeper', color: 'lime' });",
            ["line 2: these layers belong to no banner"],
        ),
        ("const b = { base: 'red', layers: [{ pattern: 'creeper'", ["ends within an object"]),
        ("const b = { base: 'red', layers: ['x };", ["a quote that is not closed"]),
        ("const banner = { a: 1 };", ["no banner in the objects"]),
        ("const banner = " + "[" * 70, ["line 1", "deep"]),
    ],
)
def test_what_is_computed_is_refused(text: str, parts: list[str]) -> None:
    with pytest.raises(DesignError) as caught:
        parse_banners(text)
    message = str(caught.value)
    assert [part for part in parts if part not in message] == [], message


@pytest.mark.parametrize("entry", ["...design", "[key]: value"])
def test_an_entry_that_may_hold_layers_never_leaves_a_plain_banner(entry: str) -> None:
    with pytest.raises(DesignError, match="cannot be read here"):
        parse_banners(f"const b = {{ id: 'minecraft:red_banner', {entry} }};")
    with pytest.warns(UserWarning, match="is not read, since it is an expression"):
        found = parse_banners(f"const b = {{ {entry}, id: 'red_banner', {COMPONENTS} }};")
    assert [one.banner for one in found] == [LIME]


def test_objects_have_a_largest_depth() -> None:
    deep = f"const b = {'[' * 64}{{ id: 'minecraft:red_banner', {COMPONENTS} }}{']' * 64};"
    with pytest.raises(DesignError, match="brackets nest over 64 deep"):
        parse_banners(deep)
    assert parse_banners(deep.replace("[" * 62, "", 1).replace("]" * 62, "", 1))[0].banner == LIME


def test_details_that_are_computed_are_not_kept() -> None:
    text = f"const b = {{ id: 'red_banner', count: n, {COMPONENTS[:-2]}, lore: lines(2) }} }};"
    details = parse_banners(text)[0].details
    assert details is not None and details.components == {}
    assert len(details.left_out) == 2


def test_a_program_is_recognised() -> None:
    assert recognise("const banner = { base: 'red' };").name == "javascript"
    assert recognise("{ id: 'red_banner' }").name != "javascript"


@pytest.mark.parametrize("word", ["return run", "execute as @a run"])
def test_a_command_is_no_program(word: str) -> None:
    text = f"{word} summon item ~ ~ ~ {{a:[1,{{Item:{{id:red_banner,count:1}}}}]}}"
    assert recognise(text).name != "javascript"
