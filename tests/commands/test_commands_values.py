"""Options of all commands that take a value say so when another option follows them."""

import re
from collections.abc import Iterator

import pytest
from conftest import Run
from typer.main import get_command

from drapery.commands.app import command_line


def valued() -> Iterator[tuple[tuple[str, ...], list[str]]]:
    """The words of each command, and its options that take a value."""
    root = get_command(command_line())
    for name, each in root.commands.items():  # type: ignore[attr-defined]
        parts = getattr(each, "commands", {"": each})
        for part, command in parts.items():
            flags = [
                flag
                for option in command.params
                if option.param_type_name == "option" and not (option.is_flag or option.count)
                for flag in option.opts
            ]
            yield tuple(filter(None, (name, part))), flags


COMMANDS = [(words, flags) for words, flags in valued() if flags]


@pytest.mark.parametrize(("words", "flags"), COMMANDS, ids=lambda each: " ".join(each)[:40])
def test_an_option_without_its_value_names_itself(
    drapery: Run, words: tuple[str, ...], flags: list[str]
) -> None:
    for flag, after in zip(flags, [*flags[1:], "--help"], strict=True):
        code, out, err = drapery(*words, flag, after, "x")
        assert (code, out) == (2, ""), (flag, out, err)
        (line,) = err.splitlines()
        assert line.startswith(f"drapery: {flag} takes a value") and f"but {after} follows" in line


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("player", "--cape", "--motion", "run"), "--cape takes a value (.*cape.*), but --motion"),
        (("player", "--cape", "--moton", "run"), "--cape takes a value .*, but --moton follows it"),
        (("render", "red", "-o", "--view", "back"), "-o takes a value .*; write -o FILE --view"),
        (("render", "red", "-o"), "-o.*requires an argument"),
    ],
)
def test_what_is_said(drapery: Run, words: tuple[str, ...], said: str) -> None:
    code, _, err = drapery(*words)
    assert code == 2
    assert len(err.splitlines()) == 1
    assert re.search(said, err), err


def test_values_that_begin_with_a_dash_are_values(drapery: Run, tmp_path) -> None:
    target = tmp_path / "x.png"
    words = ("red", "-o", target, "--size", "8x8", "--time", "0")
    assert drapery("render", *words, "--direction", "-90")[0] == 0
    assert drapery("render", "--size=8x8", "--time", "0", "-o", target, "--", "red")[0] == 0
