"""Pictures as faces, murals, and `drapery match`."""

import json
from io import BytesIO
from pathlib import Path
from typing import Any
from zlib import crc32

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from drapery import Banner, OptionError, draw_face
from drapery.banner import read_designs
from drapery.cli import main
from drapery.match import (
    Match,
    Matcher,
    Mural,
    decode_pixels,
    fit_mural,
    fit_picture,
    nearest_dye,
    read_pixels,
    shared_materials,
)
from drapery.packs import open_packs

DESIGN = "white half_vertical:red"


def picture(width: int, height: int, alpha: int = 255) -> NDArray[np.uint8]:
    """Its left half is red and its right half blue."""
    pixels = np.zeros((height, width, 4), np.uint8)
    pixels[:, : width // 2, 0] = pixels[:, width // 2 :, 2] = 200
    pixels[..., 3] = alpha
    return pixels


def saved(pixels: NDArray[np.uint8], path: Path) -> Path:
    Image.fromarray(pixels).save(path)
    return path


def run(monkeypatch: pytest.MonkeyPatch, *words: object) -> int:
    monkeypatch.setattr("sys.argv", ["drapery", "match", *map(str, words)])
    with pytest.raises(SystemExit) as ended:
        main()
    return int(ended.value.code or 0)


def test_a_face_that_was_enlarged_is_the_same_again() -> None:
    frame = draw_face(Banner.parse("white creeper:lime border:black"), scale=7)
    small = draw_face(Banner.parse("white creeper:lime border:black"), scale=1)
    seen = fit_picture(frame.pixels)
    np.testing.assert_array_equal(seen.face, small.pixels[..., :3])
    assert (seen.weights == 1).all()


def test_cover_cuts_off_and_contain_leaves_stripes_without_weight() -> None:
    wide = picture(400, 100)
    assert (fit_picture(wide).face[:, 0] == (200, 0, 0)).all()
    contained = fit_picture(wide, fit="contain")
    assert not contained.weights[:10].any()
    assert contained.weights[19:21].all()
    stretched = fit_picture(wide, fit="stretch")
    assert (stretched.face[:, 9] == (200, 0, 0)).all()
    assert (stretched.face[:, 10] == (0, 0, 200)).all()


def test_a_crop_is_the_part_that_is_used() -> None:
    assert (fit_picture(picture(100, 100), crop=(60, 0, 100, 80)).face == (0, 0, 200)).all()
    with pytest.raises(OptionError, match="crop 0,0,101,5 is not within"):
        fit_picture(picture(100, 100), crop=(0, 0, 101, 5))


def test_transparent_pixels_have_no_weight_or_the_background() -> None:
    clear = picture(20, 40)
    clear[:20, :, 3] = 0
    seen = fit_picture(clear)
    assert not seen.weights[:20].any()
    assert seen.weights[20:].all()
    shown = fit_picture(clear, background=(1, 2, 3))
    assert (shown.face[:20] == (1, 2, 3)).all()
    with pytest.raises(OptionError, match="transparent everywhere; give a background"):
        fit_picture(picture(20, 40, alpha=0))


def test_a_mask_and_weights_say_what_counts() -> None:
    mask = picture(20, 40)
    mask[..., :3] = 0
    mask[:, :10, :3] = 255
    seen = fit_picture(picture(20, 40), mask=mask)
    assert seen.weights[:, :10].all()
    assert not seen.weights[:, 10:].any()
    edges = fit_picture(picture(20, 40), weighting="edges").weights
    assert edges[5, 9] > edges[5, 0] == 1
    stroke = picture(20, 40)
    stroke[:, :9], stroke[:, 11:] = (90, 90, 90, 255), (92, 90, 90, 255)
    rare = fit_picture(stroke, weighting="rare").weights
    assert (rare[:, 9:11] > 8).all() and (rare[:, :9] == 1).all()
    centre = fit_picture(picture(20, 40), weighting="centre").weights
    assert centre[20, 10] > centre[0, 0]
    with pytest.raises(OptionError, match="the mask is 3 x 5 px"):
        fit_picture(picture(20, 40), mask=picture(3, 5))


@pytest.mark.parametrize("kind", ["PNG", "JPEG", "WEBP"])
def test_pictures_are_read(kind: str, tmp_path: Path) -> None:
    path = tmp_path / "picture"
    Image.fromarray(picture(20, 40)).convert("RGB").save(path, kind)
    assert read_pixels(path).shape == (40, 20, 4)


def test_pictures_of_cameras_are_turned_upright() -> None:
    data, exif = BytesIO(), Image.Exif()
    exif[0x0112] = 6
    Image.fromarray(picture(40, 20)).convert("RGB").save(data, "JPEG", exif=exif)
    assert decode_pixels(data.getvalue()).shape == (40, 20, 4)


def test_what_is_not_a_picture_is_refused(tmp_path: Path) -> None:
    with pytest.raises(OptionError, match="cannot be read"):
        read_pixels(tmp_path / "missing.png")
    with pytest.raises(OptionError, match="not a picture that can be read; save it as PNG"):
        decode_pixels(b"GIF89a or a text")
    data = BytesIO()
    Image.fromarray(picture(20, 40)).save(data, "PNG")
    with pytest.raises(OptionError, match="broken PNG file"):
        decode_pixels(data.getvalue()[:80])
    data = BytesIO()
    Image.fromarray(picture(200, 400)).convert("RGB").save(data, "JPEG")
    with pytest.raises(OptionError, match="broken picture"):
        decode_pixels(data.getvalue()[:900])


@pytest.mark.parametrize(
    ("side", "message"),
    [(5000, "5000 x 5000 px; at most 8192 px a side and 16 million"), (50_000, "50000 x 50000")],
)
def test_a_bomb_is_refused_before_it_is_decoded(side: int, message: str) -> None:
    data = BytesIO()
    Image.new("1", (8, 8)).save(data, "PNG")
    plain = data.getvalue()
    header = b"IHDR" + side.to_bytes(4, "big") * 2 + plain[24:29]
    bomb = plain[:12] + header + crc32(header).to_bytes(4, "big") + plain[33:]
    with pytest.raises(OptionError, match=message):
        decode_pixels(bomb)


def test_a_large_picture_is_refused_before_it_is_decoded() -> None:
    data = BytesIO()
    Image.new("L", (4200, 4200)).save(data, "JPEG")
    with pytest.raises(OptionError, match="4200 x 4200 px; at most 16 million pixels"):
        decode_pixels(data.getvalue())


def test_the_nearest_dye_is_named() -> None:
    assert nearest_dye(np.array([250, 10, 20])) == "red"
    assert nearest_dye(np.array([255, 255, 255])) == "white"


def test_a_mural_shows_the_parts_of_a_picture() -> None:
    faces = fit_mural(picture(88, 176), 2, 1)
    assert (faces[0].face == (200, 0, 0)).all()
    assert (faces[1].face == (0, 0, 200)).all()
    with pytest.raises(OptionError, match="transparent everywhere"):
        fit_mural(picture(88, 176, alpha=0), 2, 1)


def test_a_mural_is_written_as_schematic_and_function(tmp_path: Path) -> None:
    texts = ["red", "white creeper:lime", "blue border:black", "lime"]
    banners = tuple(map(Banner.parse, texts))
    mural = Mural(2, 2, banners)
    for form, ending in (("schem", "schem"), ("schem3", "schem"), ("litematic", "litematic")):
        path = tmp_path / f"mural.{ending}"
        path.write_bytes(mural.schematic(form))
        found = read_designs(str(path))
        assert {one.where.split()[-1]: one.banner for one in found} == dict(
            zip(("0,3,1", "1,3,1", "0,1,1", "1,1,1"), banners, strict=True)
        )
    (tmp_path / "mural.mcfunction").write_text(mural.function(), encoding="utf-8")
    again = read_designs(str(tmp_path / "mural.mcfunction"))
    assert [one.banner for one in again] == list(banners)
    assert mural.picture(open_packs(()), scale=1).pixels.shape == (88, 44, 4)
    with pytest.raises(OptionError, match="4 banners cannot fill 2 x 3"):
        Mural(2, 3, banners)


def test_pattern_items_of_many_banners_are_made_once() -> None:
    banners = [Banner.parse("white creeper:lime skull:red")] * 3 + [Banner.parse("red bricks:red")]
    items = {item.item: item.count for item in shared_materials(banners)}
    assert items["white_wool"] == 18
    assert items["stick"] == 4
    assert items["red_dye"] == 4
    assert items["paper"] == 3
    assert items["creeper_banner_pattern"] == items["loom"] == 1


def test_the_command_prints_designs_and_draws_a_sheet(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "face.png"
    draw_face(Banner.parse(DESIGN), scale=2).save(path)
    sheet = tmp_path / "sheet.png"
    words = ("--layers", 1, "--alternatives", 2, "--effort", 0)
    assert run(monkeypatch, path, "-o", sheet, *words, "--json") == 0
    best, other = json.loads(capsys.readouterr().out)
    assert best["text"] == DESIGN
    assert best["error"] == 0 < other["error"]
    assert Image.open(sheet).size[0] > 3 * 160
    assert run(monkeypatch, path, *words, "--as", "give") == 0
    assert capsys.readouterr().out.startswith("/give @p")


def test_the_command_makes_a_mural(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = saved(picture(88, 40), tmp_path / "two.png")
    out = tmp_path / "two.mcfunction"
    words = ("--mural", "2x1", "--layers", 1, "--effort", 0)
    assert run(monkeypatch, path, *words, "-o", out) == 0
    assert "12\t" not in capsys.readouterr().out
    assert [one.banner.base for one in read_designs(str(out))] == ["red", "blue"]


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--crop", "1,2"), "not four whole numbers"),
        (("--crop", f"0,0,{'9' * 5000},9"), "not four whole numbers"),
        (("--mural", f"{'9' * 5000}x3"), "not two whole numbers"),
        (("--mural", "4"), "not two whole numbers"),
        (("--mural", "0x3"), "1 to 1024 banners"),
        (("--mural", "1x1", "-o", "a.doc"), "ends in none of"),
        (("--mural", "1x1", "-o", "a.schematic"), "ends in none of"),
        (("--mural", "1x1", "--as", "give"), "use one of: schem, schem3"),
        (("--mural", "1x1", "--as", "schem3"), "add -o wall.schem"),
        (("--mural", "1x1", "--json"), "--json does not apply to a mural"),
        (("--layers", "17"), "layers"),
        (("--crop", "0,0,4,8"), "one colour only; the nearest dye is red"),
    ],
)
def test_the_command_refuses_what_it_cannot_do(
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    words: tuple[Any, ...],
    message: str,
) -> None:
    path = saved(picture(20, 40), tmp_path / "two.png")
    assert run(monkeypatch, path, *words) == 2
    error = capsys.readouterr().err
    assert message in error
    assert error.count("\n") == 1


def test_ctrl_c_shows_the_best_so_far(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    def stopped(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(np.random, "default_rng", stopped)
    path = saved(picture(20, 40), tmp_path / "two.png")
    assert run(monkeypatch, path, "--layers", 1, "--alternatives", 1, "--effort", 4) == 0
    shown = capsys.readouterr()
    assert "blue half_vertical:red" in shown.out or "red half_vertical_right:blue" in shown.out
    assert "the best designs so far" in shown.err


def stopped_at(count: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Ctrl-C while the banner of this number is searched for."""
    whole, faces = Matcher.match, []

    def match(matcher: Matcher, *words: Any, **named: Any) -> list[Match]:
        faces.append(words)
        if len(faces) == count:
            raise KeyboardInterrupt
        return whole(matcher, *words, **named)

    monkeypatch.setattr(Matcher, "match", match)


def test_ctrl_c_keeps_the_banners_of_a_mural(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    stripes = np.tile(picture(20, 40), (1, 4, 1))[:, :64]
    path, out = saved(stripes, tmp_path / "three.png"), tmp_path / "three.mcfunction"
    words = ("--mural", "3x1", "--layers", 1, "--effort", 0, "-o", out)
    stopped_at(2, monkeypatch)
    assert run(monkeypatch, path, *words) == 0
    assert "1 of 3 banners found, the others have one colour" in capsys.readouterr().err
    assert [len(one.banner.layers) for one in read_designs(str(out))] == [1, 0, 0]


def test_ctrl_c_before_the_first_banner_of_a_mural_writes_nothing(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    path, out = saved(picture(88, 40), tmp_path / "two.png"), tmp_path / "two.mcfunction"
    stopped_at(1, monkeypatch)
    assert run(monkeypatch, path, "--mural", "2x1", "-o", out) == 130
    assert not out.exists()
