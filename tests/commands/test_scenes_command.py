"""Scenes on the command line: listed, set by options, in a gallery; errors in one line."""

import json
import re
from dataclasses import replace
from html import escape

import pytest
from PIL import Image

from drapery.commands import options, scene
from drapery.scenes.catalogue import find_scene, scene_names
from drapery.settings import LOOP_OPTIONS


def test_the_list_names_every_scene(drapery) -> None:
    code, out, _ = drapery("scene", "--list")
    assert code == 0
    assert [line.split()[0] for line in out.splitlines()] == scene_names()
    assert all(len(line) < 120 for line in out.splitlines())


def test_a_scene_alone_lists_its_parameters(drapery) -> None:
    code, out, _ = drapery("scene", "blocky")
    assert code == 0
    assert "steps = 4" in out and "pixel_snap = True" in out


def test_parameters_are_options(drapery, tmp_path) -> None:
    ways = (
        ["--steps", "2", "--pixel-snap", "no"],
        ["--steps=2", "--pixel-snap=no"],
        ["-p", "steps=2", "--set", "pixel_snap=no"],
    )
    pictures = []
    for number, words in enumerate(ways):
        target = tmp_path / f"{number}.png"
        clip = ("--seconds", "0.05", "--size", "64x32")
        code, _, err = drapery("scene", "blocky", *words, *clip, "-o", target)
        assert code == 0, err
        pictures.append(target.read_bytes())
    assert pictures[0] == pictures[1] == pictures[2]


def test_a_sail_follows_its_script(drapery, tmp_path) -> None:
    script = tmp_path / "wind.txt"
    script.write_text("0 strength 9\n0.2 direction 60\n")
    clip = ("--seconds", "0.4", "--fps", "10", "--size", "48x48")
    code, _, _ = drapery("scene", "sail", "--script", script, *clip, "-o", tmp_path / "sail.gif")
    assert code == 0
    with Image.open(tmp_path / "sail.gif") as image:
        assert (image.n_frames, image.size) == (4, (48, 48))


def test_a_scene_is_a_3d_file_whose_parts_have_names_and_move(drapery, tmp_path) -> None:
    path, clip = tmp_path / "hall.glb", ("--seconds", "0.8", "--fps", "10")
    assert drapery("scene", "hall", *clip, "-o", path)[0] == 0
    data = path.read_bytes()
    length = int.from_bytes(data[12:16], "little")
    document = json.loads(data[20 : 20 + length])
    nodes = [node["name"] for node in document["nodes"]]
    assert {"banner/pole", "banner/cloth", "camera", "block/oak_planks"} < set(nodes)
    (motion,) = document["animations"]
    assert motion["name"] == "wave"
    assert {nodes[each["target"]["node"]] for each in motion["channels"]} == {"banner/cloth"}
    assert drapery("scene", "flag", *clip, "-o", tmp_path / "flag.obj")[0] == 0


@pytest.mark.parametrize(
    ("words", "fault"),
    [
        (["fold", "-o", "x.glb"], "scene fold is several pictures, no 3-D scene; use .png"),
        (["hall", "--style", "ink", "-o", "x.glb"], "style does nothing for a 3-D file"),
    ],
)
def test_what_a_3d_file_cannot_hold_is_refused(
    drapery, tmp_path, monkeypatch, words, fault
) -> None:
    monkeypatch.chdir(tmp_path)
    code, _, err = drapery("scene", *words, "--seconds", "0.1")
    assert code == 2 and fault in err and err.strip().count("\n") == 0
    assert not (tmp_path / "x.glb").exists()


def test_an_option_that_is_for_animations_alone_is_refused_for_other_files(
    drapery, tmp_path, monkeypatch
) -> None:
    alone = replace(LOOP_OPTIONS["fps"], name="of_animations", not_for=("still", "model", "page"))
    monkeypatch.setattr(options, "LOOP_OPTIONS", {**LOOP_OPTIONS, alone.name: alone})
    with_it = options.pictured("loop", without=options.OF_PICTURES)(scene.run.__wrapped__)
    monkeypatch.setattr(scene, "run", with_it)
    monkeypatch.chdir(tmp_path)
    for name in ("x.glb", "x.obj", "x.png"):
        code, _, err = drapery("scene", "blocky", "-o", name, "--of-animations", "5")
        assert code == 2 and f"{name}: of_animations does nothing for" in err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("words", "fault"),
    [
        (["nope"], "scene 'nope' is not known; use one of: banner"),
        (["blocky", "--stps", "3"], "has no parameter 'stps'; it has: steps"),
        (["blocky", "--pixel-snap", "maybe"], "pixel_snap 'maybe' is not yes or no"),
        (["blocky", "--steps", "0"], "steps 0 is out of range"),
        (["blocky", "stray"], "'stray' follows no option"),
        (["banner", "--wind", "nan"], "wind nan is out of range; use 0 to 40 m/s"),
        (["banner", "--left", "white nosuch:red"], "nosuch"),
        (["banner", "--left-grid", "1x5"], "left_grid 1 is out of range; use 2 to 65 particles"),
        (["banner", "--left-grid", "5"], "left_grid '5' is not 2 numbers; write it like 3x5"),
        (["sail", "--script", "none.txt"], "script none.txt cannot be read"),
        (["cape", "--dye", "sky"], "dye 'sky' is not known"),
        ([], "no scene is given"),
    ],
)
def test_an_error_is_one_line_and_leaves_no_file(drapery, tmp_path, words, fault) -> None:
    target = tmp_path / "x.png"
    code, _, err = drapery("scene", *words, "-o", target, "--seconds", "0.05")
    assert code == 2
    assert fault in err and err.strip().count("\n") == 0
    assert not target.exists()


def test_the_gallery_shows_every_scene_that_it_drew(drapery, tmp_path) -> None:
    folder = tmp_path / "new" / "gallery"
    chosen = ("cape-pixel", "julia")
    code, _, _ = drapery(
        "gallery", *chosen, "-o", folder, "--seconds", "0.1", "--size", "96x96", "--as", "webp"
    )
    assert code == 0
    page = (folder / "index.html").read_text()
    assert re.findall(r'src="([^"]+)"', page) == [f"{name}.webp" for name in chosen]
    for name in chosen:
        assert escape(find_scene(name).summary).replace("&#x27;", "&#39;") in page
        with Image.open(folder / f"{name}.webp") as image:
            assert image.size == (96, 96)


def test_a_gallery_refuses_an_unknown_format_and_a_file_as_folder(drapery, tmp_path) -> None:
    code, _, err = drapery("gallery", "-o", tmp_path / "g", "--as", "bmp")
    assert code == 2 and "use one of: apng, webp, avif, gif" in err
    assert not (tmp_path / "g").exists()
    (tmp_path / "file").write_text("")
    code, _, err = drapery("gallery", "julia", "-o", tmp_path / "file", "--seconds", "0.1")
    assert code == 2 and "name a folder" in err
