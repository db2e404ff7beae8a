"""One table describes every option, and all that takes options agrees with it."""

from dataclasses import fields
from pathlib import Path
from typing import Any, Literal, get_args, get_origin

import numpy as np
import pytest
import typer.main
from conftest import Run
from cost import limited_cost

from drapery import Banner, draw, settings
from drapery.cloth import Drag, Fabric, Gravity, SolverXPBD, Wind
from drapery.commands.app import command_line
from drapery.errors import OptionError, shown
from drapery.option import Option, Output, limits, one_of, whole, within
from drapery.option_checks import check_options
from drapery.render.views import VIEWS, View
from drapery.settings import (
    LOOP_OPTIONS,
    NAMED_OPTIONS,
    OPTIONS,
    LoopSettings,
    Options,
    Settings,
    ViewName,
)

HUGE = 10**310 - 1
"""A whole number that is too large for a float."""
ALL = {**OPTIONS, **LOOP_OPTIONS}
NUMBERS = [
    name for name, option in ALL.items() if option.type in (int, float) and not option.several
]


def test_the_table_the_settings_and_the_keywords_are_the_same() -> None:
    made = [field for field in fields(Settings) if field.name != "given"]
    assert list(OPTIONS) == [field.name for field in made]
    assert {name: kind.__forward_arg__ for name, kind in Options.__annotations__.items()} == {
        field.name: field.type + (" | None" if OPTIONS[field.name].resolve else "")
        for field in made
    }
    assert {name: option.default for name, option in OPTIONS.items()} == {
        field.name: field.default for field in made
    }


@pytest.mark.parametrize("name", OPTIONS)
def test_the_choices_are_those_of_the_annotation(name: str) -> None:
    option, annotation = OPTIONS[name], str(Settings.__annotations__[name])
    may_be_none = option.default is None and option.resolve is None
    assert annotation.endswith("| None") is may_be_none
    assert {type(choice) for choice in option.choices} <= {option.type}
    named = [getattr(settings, part, None) for part in annotation.split(" | ")]
    literals = [get_args(kind) for kind in named if get_origin(kind) is Literal]
    if name != "view":
        assert literals == ([option.choices] if option.choices else [])


def test_the_views_are_those_of_the_renderer() -> None:
    assert tuple(VIEWS) == get_args(ViewName)


@pytest.mark.parametrize("option", ALL.values(), ids=lambda o: o.name)
def test_a_default_is_allowed_and_reads_back_from_its_text(option: Option) -> None:
    assert option.check(option.default) == option.default
    if option.default is not None and option.audience != "python":
        assert option.parse(option.to_text(option.default)) == option.default


@pytest.mark.parametrize("option", ALL.values(), ids=lambda o: o.name)
def test_help_is_a_sentence_with_the_limits(option: Option) -> None:
    said = option.describe()
    assert said.endswith(".") and not said.endswith("..") and option.limits in said


def commands() -> dict[str, Any]:
    found: dict[str, Any] = typer.main.get_command(command_line()).commands  # type: ignore[attr-defined]
    return found


@pytest.mark.parametrize(
    ("command", "output"), [("render", "still"), ("animate", "loop"), ("model", "model")]
)
def test_the_command_line_has_every_option_once(command: str, output: Output) -> None:
    flags = [flag for each in commands()[command].params for flag in each.opts]
    for option in NAMED_OPTIONS.values():
        expected = int(option.applies(output=output))
        assert flags.count(option.command_flag) == expected, option.name
    helps = {each.opts[0]: each.help for each in commands()[command].params if each.opts}
    assert helps["--wind"] == "Mean wind speed (0 to 40 m/s)."


@pytest.mark.parametrize("name", NUMBERS)
@pytest.mark.parametrize(
    "value", [HUGE, -HUGE, 10**5000, float("inf"), float("nan")], ids=lambda v: shown(v)[:8]
)
def test_a_number_beyond_every_float_is_refused_in_one_line(name: str, value: float) -> None:
    option = ALL[name]
    with pytest.raises(OptionError) as caught:
        option.check((value, 9) if option.parts else value)
    line = str(caught.value)
    assert name in line and len(line) < 160 and "\n" not in line


@pytest.mark.parametrize(
    ("timing", "fault"),
    [
        ((4.0, HUGE), r"fps .* is out of range; use 1 to 120 frames/s"),
        ((4.0, 0.0), r"fps 0 is out of range; use 1 to 120 frames/s"),
        ((HUGE, 20.0), r"seconds .* is out of range; use 0\.05 to 180 s at 20 frames/s"),
        ((1e9, 20.0), r"seconds .* is out of range; use 0\.05 to 180 s at 20 frames/s"),
        ((float("nan"), 20.0), r"seconds nan is out of range; use 0\.05 to 180 s at 20 frames/s"),
    ],
)
def test_a_loop_out_of_bounds_is_refused(timing: tuple[float, float], fault: str) -> None:
    with pytest.raises(OptionError, match=fault):
        LoopSettings(*timing)


def test_a_loop_counts_its_frames() -> None:
    assert LoopSettings().count == 80
    assert LoopSettings(0.05, 20.0).count == 1
    assert LoopSettings(1 / 3, 10.0).count == 3
    assert LoopSettings(180.0, 20.0).count == 3600
    assert LoopSettings(1 / 3, 10.0).length == 0.3


@pytest.mark.parametrize("flag", ["--seed", "--rotation", "--pixel", "--block-light", "--format"])
def test_the_command_line_refuses_them_too(drapery: Run, tmp_path: Path, flag: str) -> None:
    code, _, err = drapery("render", "white", "-o", tmp_path / "x.png", flag, HUGE)
    assert code == 2 and "is out of range" in err and len(err.splitlines()) == 1


@pytest.mark.parametrize(
    ("given", "line"),
    [
        ({"wind": "fast"}, "wind 'fast' is not a number; use 0 to 40 m/s"),
        ({"wind": True}, "wind True is not a number; use 0 to 40 m/s"),
        ({"wind": float("nan")}, "wind nan is out of range; use 0 to 40 m/s"),
        ({"seed": 1.5}, "seed 1.5 is not a whole number; round it"),
        ({"size": "64"}, "size '64' is not two whole numbers; write it like 512x512"),
        ({"size": (64,)}, "size (64,) is not two whole numbers; write it like 512x512"),
        ({"size": (0, 9)}, "size (width) 0 is out of range; use 1 to 8192 pixels"),
        ({"pose": "still"}, "pose 'still' is not known; use one of: cloth, vanilla"),
        ({"samples": True}, "samples True is not known; use one of: 1, 4, 16"),
        ({"view": 5}, "view 5 is not known; use one of: front, back, iso, gui, hero"),
        ({"shadow": "dark"}, "shadow 'dark' is not yes or no; use one of them"),
        ({"background": 112233}, "background 112233 is not a text; put it in quotes"),
        ({"texture": 5}, "texture 5 is not a path; give the path of a file"),
        ({"packs": 5}, "packs 5 is not a list; put it in brackets: [...]"),
        ({"rotation": 2, "placement": "item"}, "applies only to standing banners; leave it out"),
        ({"facing": "west"}, "facing west applies only to banners on a wall; use rotation"),
        ({"size": (9, 9), "pixel": 2}, "size 9x9 is not a multiple of pixel 2; use one"),
    ],
    ids=str,
)
def test_a_message_names_the_option_and_the_remedy(given: dict[str, Any], line: str) -> None:
    with pytest.raises(OptionError) as caught:
        Settings(**given)
    assert line in str(caught.value)


@pytest.mark.parametrize(
    ("name", "value", "read"),
    [
        ("wind", "6", 6.0),
        ("wind", 6, 6.0),
        ("seed", "4294967295", 2**32 - 1),
        ("seed", "3.0", 3),
        ("seed", 3.0, 3),
        ("samples", "4", 4),
        ("shadow", "yes", True),
        ("shadow", "FALSE", False),
        ("size", "64X48", (64, 48)),
        ("grid", [9, 17], (9, 17)),
        ("facing", None, None),
        ("packs", "a; b.zip;", (Path("here/a"), Path("here/b.zip"))),
        ("packs", ["a"], (Path("here/a"),)),
        ("packs", Path("a"), (Path("here/a"),)),
        ("texture", "/x.png", Path("/x.png")),
    ],
)
def test_a_text_from_outside_becomes_a_value(name: str, value: object, read: object) -> None:
    parsed = OPTIONS[name].parse(value, Path("here"))
    assert parsed == read and type(parsed) is type(read)


def test_every_fault_of_many_options_is_listed() -> None:
    given = {"wind": "-1", "pose": "x", "wnid": "3", "seed": "9" * 310, "view": "hero"}
    faults = check_options(given, Path())
    assert isinstance(faults, list)
    assert [line.split()[0] for line in faults] == ["wind", "pose", "'wnid'", "seed"]
    assert faults[2].endswith("did you mean wind?")
    assert check_options({"wind": "3", "view": "hero"}, Path()) == Settings(wind=3, view="hero")


def test_options_that_fit_together_are_judged_together() -> None:
    read = check_options({"facing": "west", "placement": "wall", "wind": 99}, Path())
    assert read == ["wind 99 is out of range; use 0 to 40 m/s"]


def test_checks_accept_numpy_numbers_but_not_booleans() -> None:
    within("wind", np.float32(3), 0, 40)
    whole("seed", np.int64(3), 0, 40)
    one_of("samples", np.int64(4), (1, 4, 16))
    assert type(Settings(seed=np.int64(3)).seed) is int  # type: ignore[arg-type]
    for wrong in (np.zeros(3), np.bool_(True), [1], None):
        with pytest.raises(OptionError):
            one_of("samples", wrong, (1, 4, 16))
        with pytest.raises(OptionError):
            whole("seed", wrong, 0, 40)
    assert limits(0, 2**32 - 1) == "0 to 4294967295"


class Anything:
    """An object with whatever attributes a test needs."""

    def __init__(self, **attributes: object) -> None:
        self.__dict__.update(attributes)


OBJECTS = {
    "packs": Anything(sheet=1, base=1),
    "texture": np.zeros((32, 64, 4), np.uint8),
    "view": View(10, 20, None),
    "solver": SolverXPBD(substeps=8),
    "fabric": Fabric(),
    "wind": Wind((0.0, 0.0, 3.0)),
    "backend": lambda scene: None,
}


@pytest.mark.parametrize("name", OBJECTS)
def test_an_object_goes_where_a_name_goes(name: str) -> None:
    given = OBJECTS[name]
    held = getattr(Settings(**{name: given}), name)  # type: ignore[arg-type]
    assert (held[0] if name == "packs" else held) is given


def test_forces_are_given_as_objects() -> None:
    forces = [Gravity(), Drag(0.5)]
    assert Settings(forces=forces).forces == tuple(forces)
    with pytest.raises(OptionError, match="forces 'gravity' cannot be used; give forces on the"):
        Settings(forces=["gravity"])  # type: ignore[list-item]


def test_options_that_take_objects_are_not_text_options() -> None:
    assert "forces" not in NAMED_OPTIONS
    assert check_options({"forces": "wool"}, Path()) == ["'forces' is not an option; leave it out"]


@pytest.mark.parametrize("name", ["solver", "fabric", "wind", "view"])
def test_an_unfit_object_is_refused(name: str) -> None:
    for wrong in (object(), 3j, SolverXPBD, [1]):
        with pytest.raises(OptionError, match=name):
            Settings(**{name: wrong})  # type: ignore[arg-type]


def test_paths_and_packs_in_memory_are_distinguished() -> None:
    assert Settings(packs=("a.zip", Path("b"))).pack_paths == ("a.zip", Path("b"))
    with pytest.raises(OptionError, match="packs: one is in memory"):
        Settings(packs=(Anything(read=1, label="x"),)).pack_paths  # type: ignore[arg-type] # noqa: B018
    with pytest.raises(OptionError, match="texture: it is an array"):
        Settings(texture=np.zeros((32, 64, 4), np.uint8)).texture_path  # noqa: B018


def test_many_unknown_names_are_refused_soon() -> None:
    with limited_cost():
        faults = check_options({f"winds{number}": 1 for number in range(20_000)}, Path())
    assert isinstance(faults, list) and len(faults) == 20_000
    assert "did you mean wind" in faults[0] and "leave it out" in faults[-1]


def test_a_pair_is_a_text_in_python_too() -> None:
    settings = Settings(size="64x48", grid="5x9")  # type: ignore[arg-type]
    assert (settings.size, settings.grid) == ((64, 48), (5, 9))
    assert draw(Banner("white"), **{"size": "8x6", "grid": "3x4", "time": 0.0}).pixels.shape == (
        6,
        8,
        4,
    )
    for name, option in OPTIONS.items():
        if option.parts:
            text = option.to_text(option.default)
            assert option.check(text) == option.parse(text) == option.default, name
            with pytest.raises(OptionError, match=f"{name} '64' is not two whole numbers"):
                option.check("64")
