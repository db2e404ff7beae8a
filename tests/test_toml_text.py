"""TOML from users: bounds on depth and words, what only looks deep, a byte order mark."""

from pathlib import Path

import pytest
from cost import limited_cost

from drapery.errors import OptionError
from drapery.garments import Garment
from drapery.styles import Style
from drapery.testing.cases import read_cases
from drapery.toml_text import MAX_DEPTH, MAX_WORD, parse_toml

DEEP = {
    "dotted key": ("a." * 32_000 + "a = 1", "line 1: a name has over 32 parts"),
    "quoted dotted key": ("'a' . " * 10_000 + "a = 1", "line 1: a name has over 32 parts"),
    "head": ("\n\n[" + "a." * 32_000 + "a]", "line 3: a name has over 32 parts"),
    "list": ("a = " + "[" * 60_000, "line 1: lists and tables nest over 32 deep"),
    "inline table": ("a = " + "{a = " * 12_000, "line 1: lists and tables nest over 32 deep"),
    "mixed": ("a = " + "[{a.b = " * 8_000, "line 1: lists and tables nest over 32 deep"),
    "number": ("# ]\na = " + "9" * 60_000, "line 2: a word without quotes has over 100"),
    "hexadecimal": ("a = 0x" + "f" * 60_000, "line 1: a word without quotes has over 100"),
}


@pytest.mark.parametrize("name", DEEP)
@pytest.mark.parametrize("kind", ["style", "garment", "cases"])
def test_depth_is_refused_before_the_parser_sees_it(name: str, kind: str, tmp_path: Path) -> None:
    text, said = DEEP[name]
    path = tmp_path / "deep.toml"
    path.write_text(text)
    read = {"style": Style.load, "garment": Garment.load, "cases": read_cases}[kind]
    with limited_cost(1), pytest.raises(OptionError, match=rf"deep\.toml {said}"):
        read(path)


def test_what_is_just_within_the_bounds_is_read() -> None:
    names = ".".join("a" for _ in range(MAX_DEPTH))
    assert parse_toml(f"{names} = 1", "a")
    assert parse_toml("a = " + "[" * MAX_DEPTH + "]" * MAX_DEPTH, "a")
    assert parse_toml("a" * MAX_WORD + " = 1", "a")


def test_texts_and_comments_do_not_nest() -> None:
    deep = "[{a." * 100
    text = f"""
a = "{deep}\\"{deep}"  # {deep} "
b = '{deep}\\'
c = \"\"\"{deep}
""{deep}\\\"\"\"{deep}\"\"\"\"\"
d = '''{deep}
''{deep}'''''
[[e]]
f = [1.5, {{ g.h = 2024-01-01 }}] # '''
""" + "x = [[1], {a = 2}]\n[y.z]\n".join(f"# {n}\n" for n in range(2))
    assert sorted(parse_toml(text, "a")) == ["a", "b", "c", "d", "e", "y"]


def test_long_files_are_scanned_in_linear_time() -> None:
    with limited_cost(5):
        for text in (
            "a = [" + "[1]," * 15_000 + "]",
            '"""' + '\\"' * 30_000,
            "'''" + "''x" * 20_000,
        ):
            try:
                parse_toml(text, "a")
            except OptionError:
                continue


def test_a_byte_order_mark_is_read(tmp_path: Path) -> None:
    path = tmp_path / "a.toml"
    path.write_text('description = "x"\n', encoding="utf-8-sig")
    assert Style.load(path).description == "x"
    path.write_text('[[case]]\nname = "a"\ndesign = "red"\n', encoding="utf-8-sig")
    assert len(read_cases(path).case) == 1
