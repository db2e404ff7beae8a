"""One table of file formats: nothing else lists endings, and each command writes each format."""

import ast
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import av
import numpy as np
import pytest
from conftest import Run
from source_modules import modules

from drapery.comparison import read_picture
from drapery.errors import OptionError
from drapery.file_formats import (
    FORMATS,
    FileFormat,
    Kind,
    endings_of,
    format_of,
    formats_of,
    known_format,
)
from drapery.mesh_file import MESH_ENDINGS, read_mesh_file
from drapery.render import Frame, save_animation
from drapery.render.encode import writer_of

SIDE, COUNT = 16, 2
SIZE = ("--size", f"{SIDE}x{SIDE}")
LOOK = (*SIZE, "--samples", 1)
LOOP = ("--seconds", 0.2, "--fps", 10)

OTHER_TABLES = {
    "drapery.file_formats": "the table",
    "drapery.mesh_headers": "the readers of 3-D files that a user names",
}
"""Modules that may list endings, and what they list."""


def _endings() -> dict[str, str]:
    drawn = {ending: each.name for each in FORMATS for ending in each.endings if ending != "/"}
    drawn = {e: name for e, name in drawn.items() if name not in ("HTML", "JSON")}
    return drawn | {ending[1:]: name for ending, name in drawn.items()}


DRAWN = _endings()
"""The name of the format of each ending of pictures and 3-D files, with its dot and without."""


def lists_of_endings(source: str) -> Iterator[str]:
    """The literals of a source that name two or more formats of pictures or 3-D files by ending."""
    tree = ast.parse(source)
    for node in ast.walk(tree):
        if isinstance(node, ast.Tuple | ast.List | ast.Set):
            found = node.elts
        elif isinstance(node, ast.Dict):
            found = [key for key in node.keys if key is not None]
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            found = [ast.Constant(part.strip()) for part in node.value.split(",")]
        else:
            continue
        texts = [each.value for each in found if isinstance(each, ast.Constant)]
        named = {DRAWN[text] for text in texts if isinstance(text, str) and text in DRAWN}
        if len(named) > 1:
            yield f"line {node.lineno}: {', '.join(sorted(named))}"


def test_a_second_list_of_endings_is_found() -> None:
    for text in (
        'A = (".png", ".gif")',
        'A = {".glb": 1, ".obj": 2}',
        'x.endswith((".mp4", ".webm"))',
        'A = ".png, .webp"',
        'A = ["png", *B, "apng"]',
        'A: Literal[".png", ".gif"]',
    ):
        assert list(lists_of_endings(text)), text
    assert not list(lists_of_endings('A = (".png", ".json"), ".png", "a png and a gif"'))


def test_no_other_module_lists_endings() -> None:
    found = [
        f"{name} {listed}"
        for name in sorted(set(modules()) - OTHER_TABLES.keys())
        for listed in lists_of_endings(modules()[name].read_text(encoding="utf-8"))
    ]
    assert not found, "read drapery.file_formats instead"


@pytest.mark.parametrize("format", FORMATS, ids=lambda each: each.name)
def test_a_row_is_whole(format: FileFormat) -> None:
    assert (format.usual is None) or format.usual in format.kinds
    if {"still", "loop", "model"}.intersection(format.kinds):
        assert callable(writer_of(format)) and format.about
    else:
        assert not format.writer
    assert format.media_type or not format.single
    assert (format.alpha == "full") or format.matte
    for kind in format.kinds:
        for ending in format.endings:
            assert known_format(f"a{ending}", kind) == format


def test_the_longest_ending_counts_and_a_name_without_one_is_a_folder(tmp_path: Path) -> None:
    named = {
        "a.sheet.PNG": "sprite sheet",
        "a.png": "PNG",
        "a": "folder",
        "a.png/": "folder",
        "a.geo.json": "Bedrock geometry",
        "a.json": "JSON",
        "a.htm": "HTML",
    }
    every: tuple[Kind, ...] = ("still", "loop", "model", "page", "data")
    for name, wanted in named.items():
        found = known_format(name, *every)
        assert found is not None and found.name == wanted
    (tmp_path / "a.gif").mkdir()
    assert format_of(tmp_path / "a.gif", "loop").name == "folder"
    assert format_of(tmp_path / "a.gif", "still", "loop").name == "GIF"
    still = known_format("a.sheet.png", "still")
    assert still is not None and still.name == "PNG"
    assert known_format(".png", "still") is known_format(".geo.json", "model") is None


def test_a_message_says_what_was_given_and_what_is_known() -> None:
    with pytest.raises(OptionError) as caught:
        format_of("a.mp4", "still", "page")
    assert str(caught.value) == (
        "a.mp4: MP4 holds no picture or page; use"
        f" {', '.join(endings_of('still', 'page')[:-1])} or .htm"
    )
    with pytest.raises(OptionError, match=r"a\.xyz: no 3-D file is written with this ending; use"):
        format_of("a.xyz", "model")
    with pytest.raises(OptionError, match="a: without an ending it holds no picture; use"):
        format_of("a", "still")


@pytest.mark.parametrize("format", formats_of("still", "loop"), ids=lambda each: each.name)
def test_limits_and_the_matte_are_those_of_the_table(format: FileFormat, tmp_path: Path) -> None:
    target = f"{tmp_path}/a{format.ending}"
    small, black = Frame(np.zeros((2, 2, 4), np.uint8)), (0, 0, 0)
    if "loop" in format.kinds:
        with pytest.raises(OptionError, match=f"fps {format.max_fps + 1}: "):
            save_animation([small], format.max_fps + 1, target)
        if not format.matte:
            with pytest.raises(OptionError, match="matte does nothing for"):
                save_animation([small], 10, target, matte=black)
    if "still" in format.kinds and format.max_side:
        wide = Frame(np.zeros((1, format.max_side + 1, 4), np.uint8))
        with pytest.raises(OptionError, match=rf"{format.name}, which has at most .* use \.png"):
            wide.save(target)
    assert not list(tmp_path.iterdir())


def check_file(path: str, format: FileFormat, kind: Kind) -> None:
    """Read a file back: it has the size, the number of frames and the kind that were asked for."""
    place = Path(path)
    if format.ending == "/":
        assert len(list(place.glob("frame_*.png"))) == COUNT
    elif format.ending == ".sheet.png":
        assert len(json.loads(place.with_suffix(".json").read_text())["frames"]) == COUNT
    elif kind in ("still", "loop") and format.reader:
        picture = read_picture(place)
        assert picture.size == (SIDE, SIDE) and picture.frames[0][..., 3].max() == 255
        assert len(picture.frames) == (COUNT if kind == "loop" else 1)
    elif kind == "loop":
        with av.open(path) as video:
            assert sum(1 for _ in video.decode(video=0)) == COUNT
    elif format.ending in MESH_ENDINGS:
        assert read_mesh_file(place)
    elif kind == "model":
        assert json.loads(place.read_text(encoding="utf-8"))
    else:
        assert "<html" in place.read_text(encoding="utf-8")


COMMANDS: dict[str, tuple[tuple[Any, ...], tuple[Kind, ...]]] = {
    "render": (("white", *LOOK), ("still",)),
    "animate": (("white", *LOOK, *LOOP), ("loop",)),
    "model": (("white",), ("model",)),
    "garment": (("pennon", *SIZE), ("still", "loop", "model")),
    "player": ((*LOOK,), ("still", "loop")),
    "scene": (("flag", "--size", f"{SIDE}x{SIDE}", *LOOP), ("still", "loop")),
}
"""Words of each command, and what it writes."""


@pytest.mark.parametrize("command", COMMANDS)
def test_each_command_that_draws_writes_each_format(
    command: str, tmp_path: Path, drapery: Run
) -> None:
    words, kinds = COMMANDS[command]
    for format in formats_of(*kinds):
        kind = format.kind() if len(kinds) > 1 else kinds[0]
        timed = LOOP if (kind == "loop" or format.moving) and LOOP[0] not in words else ()
        target = f"{tmp_path}/{command}{format.endings[-1]}"
        code, _, err = drapery(command, *words, *timed, "-o", target)
        assert code == 0, (target, err)
        check_file(target, format, kind)


@pytest.mark.parametrize("words", [("garment", "flag"), ("player",), ("model", "red")])
def test_the_length_and_rate_of_a_loop_are_refused_where_there_is_none(
    words: tuple[str, ...], tmp_path: Path, drapery: Run
) -> None:
    fixed = [each for each in formats_of("model") if not each.moving]
    stills = formats_of("still") if words[0] != "model" else ()
    for format in (*fixed, *(each for each in stills if each.kind() == "still")):
        for option in ("seconds", "fps"):
            target = f"{tmp_path}/a{format.ending}"
            code, _, err = drapery(*words, f"--{option}", 2, "-o", target)
            assert code == 2 and f"{target}: {option} does nothing for" in err, (format.name, err)
    if words[0] == "model":
        code, _, err = drapery(*words, "--seconds", 0, "--fps", 5, "-o", tmp_path / "a.glb")
        assert code == 2 and "fps does nothing for one pose" in err
    assert not list(tmp_path.iterdir())


def test_faces_sheets_and_comparisons_are_written_in_each_format_of_pictures(
    tmp_path: Path, drapery: Run
) -> None:
    commands = (
        ("flat", "white"),
        ("sheet", "patterns", "--dyes", "red", "--scale", 1),
        ("compare", tmp_path / "a.png", tmp_path / "b.png"),
    )
    for name, dye in (("a", "red"), ("b", "blue")):
        assert drapery("flat", dye, "-o", tmp_path / f"{name}.png")[0] == 0
    for words in commands:
        sizes = set()
        for format in formats_of("still"):
            target = tmp_path / f"{words[0]}{format.ending}"
            code, _, err = drapery(*words, "-o", target)
            assert code == (1 if words[0] == "compare" else 0), err
            if words[0] != "compare" or format.kind(timed=False) == "still":
                sizes.add(read_picture(target).size)
        assert len(sizes) == 1


def test_a_batch_writes_each_format_that_is_one_file(tmp_path: Path, drapery: Run) -> None:
    formats = [each for each in formats_of("still", "loop") if each.single]
    rows = [
        {"out": f"{kind}{each.ending}", "design": "white", "size": f"{SIDE}x{SIDE}"}
        | ({"seconds": 0.2, "fps": 10} if kind == "loop" else {})
        for each in formats
        for kind in dict.fromkeys((each.kind(timed=False), each.kind(timed=True)))
    ]
    (tmp_path / "jobs.jsonl").write_text("\n".join(map(json.dumps, rows)))
    code, _, err = drapery("batch", tmp_path / "jobs.jsonl", "-o", tmp_path / "out", "--workers", 1)
    assert code == 0, err
    for row in rows:
        kind: Kind = "loop" if "seconds" in row else "still"
        check_file(f"{tmp_path}/out/{row['out']}", format_of(str(row["out"]), kind), kind)
