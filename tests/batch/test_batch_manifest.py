"""A manifest is read whole before anything is drawn: all jobs, or all faults with their lines."""

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from conftest import Run
from hypothesis import given, strategies as st
from PIL import Image
from world_maker import LIME, RED, SHIELD, make_world

from drapery.banner.design import Banner, Layer
from drapery.batch.jobs import make_job, plan
from drapery.batch.keys import DigestCache
from drapery.batch.manifest import ManifestError, PictureRequest, numbered, read_manifest
from drapery.errors import DraperyError, OptionError
from drapery.garments import find_garment
from drapery.output_files import replacing
from drapery.packs import MemoryPack
from drapery.settings import Settings
from drapery.styles import combined_style

JOBS = [
    {"name": "lime", "design": "white creeper:lime", "view": "hero", "wind": 6},
    {"out": "guilds/red.gif", "design": "red border:black", "seconds": 2, "fps": 10},
    {"design": "blue", "size": "32x48", "pose": "vanilla", "rotation": 4},
]


def write(path: Path, text: str) -> Path:
    path.write_text(text, encoding="utf-8")
    return path


def as_csv(path: Path) -> Path:
    names = sorted({name for one in JOBS for name in one})
    rows = [",".join(str(one.get(name, "")) for name in names) for one in JOBS]
    return write(path / "m.csv", "\n".join(["# grid = 3x5", ",".join(names), *rows]))


def as_jsonl(path: Path) -> Path:
    lines = [{"defaults": {"grid": "3x5"}}, *JOBS]
    return write(path / "m.jsonl", "\n\n".join(map(json.dumps, lines)))


def as_yaml(path: Path) -> Path:
    return write(path / "m.yaml", yaml.safe_dump({"defaults": {"grid": [3, 5]}, "jobs": JOBS}))


def bare(requests: list[PictureRequest]) -> list[tuple[object, ...]]:
    return [(r.out, r.banner, r.settings, r.seconds, r.fps) for r in requests]


@pytest.mark.parametrize("form", [as_csv, as_jsonl, as_yaml])
def test_the_same_jobs_from_every_form(form, tmp_path: Path) -> None:
    lime = Banner("white", (Layer("creeper", "lime"),))
    red = Banner("red", (Layer("border", "black"),))
    few = {"grid": (3, 5)}
    turned = Settings(size=(32, 48), pose="vanilla", rotation=4)  # a stiff pose has no grid
    assert bare(read_manifest(form(tmp_path))) == [
        ("lime.png", lime, Settings(view="hero", wind=6.0, **few), None, None),
        ("guilds/red.gif", red, Settings(**few), 2.0, 10.0),
        ("00003.png", Banner("blue"), turned, None, None),
    ]


def test_a_row_names_a_garment_or_its_file(tmp_path: Path) -> None:
    own = tmp_path / "towel.toml"
    write(own, 'picture = { wind = 7 }\npiece = [{ name = "a", size = [4, 4], points = [3, 3] }]')
    rows = "garment,design,view,out\nflag,red,,flag.png\ntowel.toml,,front,towel.gif\n"
    flag, towel = read_manifest(write(tmp_path / "m.csv", rows))
    wanted = find_garment("flag").with_design("red")
    assert (flag.banner, flag.settings) == (wanted, wanted.settings())
    assert (towel.settings.wind, towel.settings.view, towel.fps) == (7.0, "front", 20.0)
    keys = [make_job(each, DigestCache()).key for each in (flag, towel)]
    write(own, 'picture = { wind = 7 }\npiece = [{ name = "a", size = [5, 4], points = [3, 3] }]')
    again = [make_job(each, DigestCache()).key for each in read_manifest(tmp_path / "m.csv")]
    assert again[0] == keys[0] and again[1] != keys[1]


def test_the_key_of_a_garment_holds_the_bytes_of_its_files(tmp_path: Path) -> None:
    text = 'texture = { file = "a.png" }\npiece = [{ name = "a", size = [4, 4], points = [3, 3] }]'
    write(tmp_path / "towel.toml", text)
    keys = []
    for colour in ("red", "blue"):
        Image.new("RGBA", (4, 4), colour).save(tmp_path / "a.png")
        (request,) = read_manifest([{"garment": str(tmp_path / "towel.toml")}])
        keys.append(make_job(request, DigestCache()).key)
    assert keys[0] != keys[1]


@pytest.mark.parametrize(
    ("row", "said"),
    [
        ({"garment": "toga"}, "garment 'toga' is not known; use a file that ends with .toml"),
        ({"garment": "none.toml"}, "none.toml"),
        ({"garment": "flag", "grid": "3x5"}, "grid does nothing for a garment"),
        ({"garment": "flag", "wind": 99}, "wind 99"),
        ({"garment": "flag", "design": "wite"}, "wite"),
    ],
)
def test_a_garment_that_cannot_be_drawn_is_a_fault(row: dict[str, object], said: str) -> None:
    with pytest.raises(ManifestError, match=said):
        read_manifest([row])


@pytest.mark.parametrize("several", [str, lambda text: [text]])
def test_files_of_defaults_lie_in_the_current_folder(
    several: Callable[[str], Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Those of the manifest lie beside it."""
    here, there = tmp_path / "here", tmp_path / "there"
    for folder, light in ((here, "flat"), (there, "studio")):
        folder.mkdir()
        (folder / "my.toml").write_text(f'light = "{light}"', encoding="utf-8")
    (here / "my.txt").write_text("red", encoding="utf-8")
    monkeypatch.chdir(here)
    path = there / "m.jsonl"
    path.write_text('{"name": "a", "style": "my.toml"}\n{"name": "b"}\n', encoding="utf-8")
    given = {"style": several("my.toml"), "design": "my.txt", "wind": "7"}
    requests = read_manifest(path, given)
    assert [combined_style(one.settings.style).light for one in requests] == ["studio", "flat"]
    assert [one.banner for one in requests] == [Banner.parse("red")] * 2
    assert "my.toml" not in str(read_manifest([{"design": "red"}], {"style": "cel; ink"}))


def test_defaults_lie_under_the_manifests_own(tmp_path: Path) -> None:
    given_here = {"grid": "9x9", "wind": "7", "packs": "."}
    first, second, _ = read_manifest(as_csv(tmp_path), given_here, "webp")
    assert (first.settings.grid, first.settings.wind, second.settings.wind) == ((3, 5), 6.0, 7.0)
    assert first.out == "lime.webp"


def test_defaults_lie_under_the_manifests_own_but_packs_must_be_packs(tmp_path: Path) -> None:
    with pytest.raises(ManifestError, match="not a resource pack") as caught:
        read_manifest(as_csv(tmp_path), {"packs": str(tmp_path)})
    assert [fault.place for fault in caught.value.faults] == ["line 3", "line 4", "line 5"]


BAD = """\
name,design,wind,size,colour
a,white creeper:lime,99,0x4,
b,wite,x,48x48,
a,red,4,48x48,blue
a,red,4,48x48,
A,red,4,48x48,
../up,red,4,48x48,
c,"two
lines",4,48x48,
d,,4,48x48,
e,red,4,48x48,,,
"""


def test_semicolons_between_columns_are_named(tmp_path: Path) -> None:
    path = write(tmp_path / "m.csv", "name;design\na;red creeper:lime\n")
    with pytest.raises(ManifestError) as caught:
        read_manifest(path)
    assert "separated by semicolons; separate them by commas" in str(caught.value)


def test_commands_with_quotes_are_cells_in_quotes(tmp_path: Path) -> None:
    give = '/give @p white_banner[banner_patterns=[{pattern:""creeper"",color:""lime""}]]'
    (request,) = read_manifest(write(tmp_path / "m.csv", f'name,design\na,"{give}"\n'))
    assert request.banner == Banner.parse("white creeper:lime")


def test_all_faults_are_listed_with_their_lines(tmp_path: Path, drapery: Run) -> None:
    path = write(tmp_path / "m.csv", BAD)
    with pytest.raises(ManifestError) as caught:
        read_manifest(path)
    faults = [(fault.place, fault.message.split(":")[0][:22]) for fault in caught.value.faults]
    assert sorted(faults) == sorted(
        [
            ("line 2", "wind 99 is out of rang"),
            ("line 2", "size (width) 0 is out "),
            ("line 3", "wind 'x' is not a numb"),
            ("line 3", "design"),
            ("line 4", "'colour' is not an opt"),
            ("line 6", "A.png is written by li"),
            ("line 7", "'../up.png' is not a f"),
            ("line 8", "design"),
            ("line 10", "no design is given; wr"),
            ("line 11", "7 cells for 5 columns;"),
        ]
    )
    code, out, err = drapery("batch", path, "-o", tmp_path / "out")
    assert (code, out) == (2, "")
    assert len(err.splitlines()) == len(faults) + 1
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("name", "text", "place"),
    [
        ("m.jsonl", '{"design": "red"}\n{"design": \n', "line 2"),
        ("m.jsonl", '{"design": "red"}\n\n[1]\n', "line 3"),
        ("m.yaml", "- design: red\n- 3\n", "line 2"),
        ("m.yaml", "- design: red\n\n- design: red\n  sise: 3x3\n", "line 3"),
        ("m.csv", 'design\nred\n"red\n', "line 3"),
    ],
)
def test_broken_text_is_placed(name: str, text: str, place: str, tmp_path: Path) -> None:
    with pytest.raises(ManifestError) as caught:
        read_manifest(write(tmp_path / name, text))
    assert [fault.place for fault in caught.value.faults] == [place]


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("- design: red\n- design: [\n", "line 3"),
        ("[" * 30_000, "deep"),
        ("? [a, b]\n: 1\n", "no key"),
        ("- ? [a, b]\n  : 1\n", "no key"),
        ("- design: red\n  design: blue\n", "twice"),
        ("defaults: 0\njobs: [{design: red}]\n", "write defaults as names"),
        ("jobs: [{design: red}]\nother: 1\n", "a list of jobs"),
    ],
)
def test_yaml_that_is_not_a_manifest_is_one_line(text: str, reason: str, tmp_path: Path) -> None:
    with pytest.raises(OptionError, match=reason) as caught:
        read_manifest(write(tmp_path / "m.yaml", text))
    assert len(str(caught.value)) < 1000
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(("name", "bad"), [("fps", 0), ("seconds", 0), ("fps", -1), ("fps", 1e9)])
def test_a_time_out_of_range_is_a_fault_with_its_row_and_column(
    name: str, bad: float, tmp_path: Path
) -> None:
    path = write(tmp_path / "m.csv", f"out,design,{name}\na.gif,red,20\nb.gif,red,{bad}\n")
    with pytest.raises(ManifestError) as caught:
        read_manifest(path)
    (fault,) = caught.value.faults
    assert fault.place == "line 3"
    assert fault.message.startswith(f"{name} {bad:g} is out of range")


@pytest.mark.parametrize("mark", ["\u2028", "\u2029", "\x0b", "\x0c", "\x1c", "\x85"])
def test_only_line_ends_end_the_lines_of_defaults(mark: str, tmp_path: Path) -> None:
    path = write(tmp_path / "m.csv", f"# by{mark}me\n# size = 8x8\nname,design\na,red\nb,wite\n")
    with pytest.raises(ManifestError) as caught:
        read_manifest(path)
    assert [fault.place for fault in caught.value.faults] == ["line 5"]


@pytest.mark.parametrize("end", ["\r\n", "\r"])
def test_lines_may_end_as_on_other_systems(end: str, tmp_path: Path) -> None:
    path = tmp_path / "m.csv"
    path.write_bytes(end.join(["# size = 8x8", "name,design", "a,red", ""]).encode())
    (request,) = read_manifest(path)
    assert (request.out, request.settings.size) == ("a.png", (8, 8))


@pytest.mark.parametrize(
    ("out", "reason"),
    [
        *((f"{name}.png", "device") for name in ("CON", "nul", "Com1", "lpt9", "nul.tar", "com²")),
        ("nul/a.png", "device"),
        ("a./b.png", "ends with a dot"),
        ("a /b.png", "ends with a dot or space"),
        ("é" * 116 + ".png", "over 230 bytes"),
        ("a" * 120 + "/" + "é" * 116 + ".png", "over 230 bytes"),
        ("a\\b.png", "not a file name"),
        ("a:b.png", "not a file name"),
        ("/a.png", "not a file name"),
    ],
)
def test_names_that_some_system_refuses_are_faults(out: str, reason: str) -> None:
    with pytest.raises(ManifestError, match=reason) as caught:
        read_manifest([{"design": "red", "out": out}])
    assert len(str(caught.value)) < 300


def test_the_longest_name_that_is_allowed_can_be_written(tmp_path: Path) -> None:
    names = ["é" * 110 + ".png", "console.png", "com.png", "a..png"]
    for request in read_manifest([{"design": "red", "out": name} for name in names]):
        with replacing(tmp_path / request.out) as partial:
            partial.write_bytes(b"x")
    assert {path.name for path in tmp_path.iterdir()} == set(names)


@pytest.mark.parametrize(
    "outs",
    [
        ("a.png", "a.png/b.png"),
        ("x/y.png/z/b.png", "x/Y.png"),
        ("a.png", "A.PNG"),
        ("\u212b.png", "\u00c5.png"),
    ],
)
def test_outputs_that_get_in_the_way_of_each_other_are_faults(outs: tuple[str, str]) -> None:
    with pytest.raises(ManifestError, match=r"job [12] writes|is written by job 1") as caught:
        read_manifest([{"design": "red", "out": out} for out in outs])
    assert len(caught.value.faults) == 1


def test_rows_may_be_given_in_memory(tmp_path: Path) -> None:
    banner = Banner("red", (Layer("border", "black"),))
    rows = [{"design": banner, "size": (8, 8)}, {"name": "b", "design": "blue", "wind": 2}]
    first, second = read_manifest(rows, {"grid": (3, 5)}, "webp")
    assert (first.place, first.out, first.banner) == ("job 1", "00001.webp", banner)
    assert (second.out, second.settings.wind, second.settings.grid) == ("b.webp", 2.0, (3, 5))
    with pytest.raises(ManifestError) as caught:
        read_manifest([{"design": "red", "wnd": 1}, ["red"], {"design": 3.5, "size": "8x8"}])
    assert [fault.place for fault in caught.value.faults] == ["job 1", "job 2", "job 3"]


@pytest.mark.parametrize(
    ("row", "reason"),
    [
        ({"packs": MemoryPack()}, "packs is an object"),
        ({"packs": [MemoryPack()]}, "packs is an object"),
        ({"texture": np.zeros((32, 64, 4), np.uint8)}, "texture is an object"),
        ({"design": ["red"]}, r"design \['red'\] is not a text"),
        ({"design": "x" * (1 << 20) + "x"}, "design has over 1048576 characters"),
        ({"seconds": "long"}, "seconds 'long' is not a number"),
        ({"out": "a.gif", "fps": True}, "fps True is not a number"),
    ],
)
def test_values_that_no_worker_can_be_sent_are_faults(row, reason: str) -> None:
    with pytest.raises(ManifestError, match=reason) as caught:
        read_manifest([{"design": "red", **row}])
    assert len(str(caught.value)) < 400


def test_banners_of_a_world_with_alike_places_get_free_numbers() -> None:
    used: dict[str, int] = {}
    requests = read_manifest([{"design": "red", "out": f"{n}.png"} for n in range(5)])
    outs = ("a.png", "A.png", "a-2.png", "a.png", "a-2.png")
    named = [numbered(replace(r, out=out), used) for r, out in zip(requests, outs, strict=True)]
    assert [r.out for r in named] == ["a.png", "A-2.png", "a-2-2.png", "a-3.png", "a-2-3.png"]


def test_each_banner_of_a_file_of_banners_is_a_job(tmp_path: Path) -> None:
    path = write(
        tmp_path / "all.mcfunction",
        "give @p red_banner\ngive @p lime_banner\ngive @p red_banner\n",
    )
    requests = read_manifest(path, {"size": "8x8"}, "gif")
    assert [r.banner.base for r in requests] == ["red", "lime", "red"]
    assert len({r.out for r in requests}) == 3
    assert {r.settings.size for r in requests} == {(8, 8)}
    first, second = plan(requests)
    assert (len(first.outs), len(second.outs)) == (2, 1)


def test_each_banner_of_a_world_is_a_job_named_by_its_place(tmp_path: Path) -> None:
    make_world(tmp_path / "world")
    requests = read_manifest(tmp_path / "world", {"size": "8x8"})
    assert [(r.out, r.banner) for r in requests] == [
        ("level.dat.Data.Player.Item.png", LIME),
        ("DIM-1_region_r.0.0.mca_chunk_3_0_block_48_71_9.png", RED),
        ("dimensions_a_b_entities_r.0.0.mca_chunk_3_0_block_48_71_9.png", RED),
        ("playerdata_x.dat.Inventory_0.png", SHIELD),
        ("region_r.0.0.mca_chunk_3_0_block_48_71_9.png", RED),
    ]


def test_a_design_may_be_a_file_beside_the_manifest(tmp_path: Path) -> None:
    write(tmp_path / "red.txt", "red border:black")
    path = write(tmp_path / "m.jsonl", '{"design": "red.txt"}')
    assert read_manifest(path)[0].banner == Banner.parse("red border:black")


def test_jobs_of_one_motion_stand_together(tmp_path: Path) -> None:
    lines = [
        {"design": f"{dye} border:black", "wind": wind}
        for dye in ("red", "blue", "lime")
        for wind in (3, 4)
    ]
    path = write(tmp_path / "m.jsonl", "\n".join(map(json.dumps, lines)))
    assert [job.settings.wind for job in plan(read_manifest(path))] == [3.0] * 3 + [4.0] * 3


WORDS = st.sampled_from(
    [
        *("design", "red", "size", "4x4", "wind", "-1", "nan", "1e999", "true", "null", "é"),
        *("jobs", "defaults", "name", "out", "packs", "a/../b.png", "!!python/x", "<<", "{", "}"),
        *("[", "]", ":", ",", "#", "&a ", "*a", "- ", '"', "\n", "\0"),
    ]
)


@given(st.sampled_from(["csv", "jsonl", "yaml"]), st.lists(WORDS, max_size=12))
def test_any_text_is_jobs_or_an_error_of_ours(form: str, words: list[str]) -> None:
    from tempfile import TemporaryDirectory

    with TemporaryDirectory() as folder:
        path = write(Path(folder) / f"m.{form}", "".join(words))
        try:
            assert read_manifest(path)
        except ManifestError as error:
            assert all("\n" not in str(fault) for fault in error.faults)
        except DraperyError as error:
            assert "\n" not in str(error)


def test_times_of_a_still_are_refused_and_defaults_of_loops_are_not() -> None:
    for words in ({}, {"out": "x.png"}, {"out": "x.tiff"}):
        with pytest.raises(ManifestError) as caught:
            read_manifest([{"design": "red", "seconds": 2, **words}])
        out = words.get("out", "00001.png")
        said = "name an animation such as x.gif, or leave it out"
        assert caught.value.faults[0].message == (
            f"{out}: seconds does nothing for a still picture; {said}"
        )
    rows = [{"design": "red"}, {"design": "red", "out": "x.gif"}]
    still, loop = read_manifest(rows, defaults={"seconds": 2})
    assert (still.seconds, loop.seconds) == (None, 2)
    assert read_manifest([{"design": "red", "seconds": 2}], format="gif")[0].seconds == 2


def test_a_default_is_left_out_where_it_does_nothing(tmp_path: Path) -> None:
    path = tmp_path / "rows.jsonl"
    path.write_text(
        '{"defaults": {"wind": 9, "facing": "east", "placement": "wall"}}\n'
        '{"design": "red", "turntable": false, "out": "x.gif"}\n'
        '{"design": "red", "placement": "item"}\n{"garment": "cape"}\n'
    )
    wall, item, cape = (
        each.settings for each in read_manifest(path, {"turntable": True, "seed": 7})
    )
    assert wall.given_values == {
        "wind": 9, "facing": "east", "placement": "wall", "turntable": False, "seed": 7
    }  # fmt: skip
    assert item.given_values == {"placement": "item"}
    assert (cape.wind, cape.seed, cape.placement, cape.facing) == (9, 7, "standing", None)
    path.write_text('{"design": "red", "placement": "item", "wind": 9}\n')
    with pytest.raises(ManifestError, match="wind does nothing for placement item"):
        read_manifest(path)
