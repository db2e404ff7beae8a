"""Packs on drawn bodies: every pattern in one scene, animated textures, pack formats."""

import json
import warnings
from pathlib import Path

import numpy as np
import pytest
from conftest import Run
from pack_maker import CREEPER, META, NEW_BASE, OLD_BASE, folder_pack, mcmeta, plain, png
from PIL import Image

from drapery.banner.design import Banner, Layer
from drapery.banner.dyes import DYE_NAMES
from drapery.banner.packs import Packs, open_packs
from drapery.banner.patterns import PATTERN_NAMES
from drapery.banner.sprites import FLAG_REGIONS, composite, flag_layers
from drapery.mesh import Mesh
from drapery.render.camera import Camera
from drapery.render.light import UNLIT
from drapery.render.scene import Model, Scene
from drapery.render.soft import draw_scene
from drapery.scenes import loop
from drapery.settings import Settings
from drapery.stage.bodies import texture_times
from drapery.style.block import FLAG_MAPPING
from drapery.style.board import stiff_board
from drapery.style.layers import flag_material

CREEPER_BANNER = Banner("white", (Layer("creeper", "white"),))
SHORT = Settings(size=(16, 20), pose="vanilla")

# From where each side is seen: towards the camera, and up in the picture.
SIDES = {
    "front": ((0, 0, 1), (0, 1, 0)),
    "back": ((0, 0, -1), (0, 1, 0)),
    "left": ((-1, 0, 0), (0, 1, 0)),
    "right": ((1, 0, 0), (0, 1, 0)),
    "top": ((0, 1, 0), (0, 0, -1)),
    "bottom": ((0, -1, 0), (0, 0, 1)),
}


def banners() -> list[Banner]:
    """Every pattern once; dye and base change from one to the next."""
    dyes = len(DYE_NAMES)
    return [
        Banner(DYE_NAMES[n % dyes], (Layer(name, DYE_NAMES[(n * 5 + 3) % dyes]),))
        for n, name in enumerate(PATTERN_NAMES)
    ]


def places(count: int) -> np.ndarray:
    """Middles of the top edges [texels]: no flag covers another, seen from either side."""
    number = np.arange(count)
    return np.stack([24 * (number % 7), -44 * (number // 7), 3 * number], axis=-1).astype(float)


def batch(packs: Packs) -> Model:
    """All patterns as one model of stiff flags, one metre per texel."""
    board = stiff_board((20, 40), 1.0, FLAG_MAPPING)
    materials = tuple(flag_material(banner, packs) for banner in banners())
    where = places(len(materials))
    mesh = Mesh(
        board.positions + where[:, None],
        np.broadcast_to(board.normals, (len(materials), *board.normals.shape)),
        board.triangles,
        board.uvs,
    )
    return Model(mesh, materials, np.arange(len(materials), dtype=np.int32))


def side_picture(model: Model, side: str) -> tuple[np.ndarray, np.ndarray]:
    """A picture of one side, one pixel per texel, and the place of each banner in it, [B, 2]."""
    back, up = (np.array(vector, float) for vector in SIDES[side])
    right = np.cross(up, back)
    points = model.mesh.positions @ np.stack([right, -up], axis=1)
    low, high = points.min(axis=(0, 1)), points.max(axis=(0, 1))
    width, height = np.rint(high - low).astype(int)
    centre = right * (low + high)[0] / 2 - up * (low + high)[1] / 2
    camera = Camera(
        tuple(centre + 1000 * back), tuple(centre), tuple(up), height=height, near=1, far=3000
    )
    scene = Scene((model,), camera, (int(width), int(height)), UNLIT)
    corners = np.rint(points.min(axis=1) - low).astype(int)
    return draw_scene(scene).pixels, corners


def check_side(packs: Packs, side: str) -> None:
    picture, corners = side_picture(batch(packs), side)
    for banner, (x, y) in zip(banners(), corners, strict=True):
        texels = FLAG_REGIONS[side].crop(composite(flag_layers(banner, packs)))
        height, width = texels.shape[:2]
        assert np.array_equal(picture[y : y + height, x : x + width], texels), banner


@pytest.mark.parametrize("side", SIDES)
def test_every_pattern_shows_its_texels_in_one_scene(side: str) -> None:
    check_side(open_packs(), side)


@pytest.mark.parametrize("side", SIDES)
def test_every_pattern_of_the_real_pack_shows_its_texels(real_pack: Path, side: str) -> None:
    packs = open_packs([real_pack])
    check_side(packs, side)
    (line,) = packs.warnings()
    assert line.endswith("our own art: flow, guster")


def animated_pack(path: Path, *, ticks: int) -> Path:
    """A pack whose creeper is red, green and blue in turn, each for a number of ticks."""
    colours = np.repeat(np.eye(3, dtype=np.uint8) * 255, 16, axis=0)
    frames = np.broadcast_to(
        np.append(colours, np.full((48, 1), 255, np.uint8), 1)[:, None], (48, 16, 4)
    )
    meta = json.dumps({"animation": {"frametime": ticks}})
    files = {META: mcmeta(), CREEPER: png(frames), f"{CREEPER}.mcmeta": meta}
    return folder_pack(path, files)


def flag_colours(packs: Packs, count: int, fps: float) -> list[int]:
    """Which of red, green and blue the creeper is in each scene of a loop."""
    scenes = loop(CREEPER_BANNER, packs, SHORT, count, fps)
    sheets = [scene.models[1].materials[0].layers[-1].texels for scene in scenes]
    return [int(sheet[0, 0, :3].argmax()) for sheet in sheets]


def test_animated_packs_move_and_close_the_loop(tmp_path: Path) -> None:
    packs = open_packs([animated_pack(tmp_path, ticks=2)])
    # A period of 0.3 s in 0.6 s; then one of 0.3 s that is stretched to fill 0.4 s.
    assert flag_colours(packs, 6, 10) == [0, 1, 2, 0, 1, 2]
    assert flag_colours(packs, 4, 10) == [0, 0, 1, 2]


def test_a_loop_too_short_for_its_textures_says_so(tmp_path: Path) -> None:
    packs = open_packs([animated_pack(tmp_path, ticks=40)])
    with pytest.warns(UserWarning, match="use seconds 6"):
        assert flag_colours(packs, 4, 2) == [0, 0, 0, 0]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert flag_colours(packs, 6, 1) == [0, 0, 1, 1, 2, 2]


def test_textures_fill_a_loop_by_whole_periods() -> None:
    for period in (0.05, 0.3, 0.7, 2.0, 2.9):
        times = texture_times(period, 40, 20)
        pace = times[1] * 20
        assert (pace * 2.0 / period) == pytest.approx(round(2.0 / period))
    assert texture_times(0.0, 3, 10) == pytest.approx([0, 0.1, 0.2])


def test_textures_that_look_the_same_give_the_same_material(tmp_path: Path) -> None:
    """The renderer prepares each material once and recognises it by identity."""
    still_looks = {
        tuple(id(material) for model in scene.models for material in model.materials)
        for scene in list(loop(CREEPER_BANNER, open_packs(), SHORT, 6, 10))
    }
    assert len(still_looks) == 1
    packs = open_packs([animated_pack(tmp_path, ticks=2)])
    flags = [s.models[1].materials[0] for s in list(loop(CREEPER_BANNER, packs, SHORT, 6, 10))]
    assert len({id(material) for material in flags}) == 3 and flags[0] is flags[3]


def test_the_pack_format_chooses_the_place_of_the_base(drapery: Run, tmp_path: Path) -> None:
    pack = folder_pack(
        tmp_path / "pack",
        {
            META: mcmeta(46),
            OLD_BASE: plain(200, 0, 0, 255),
            NEW_BASE: plain(0, 0, 200, 255),
        },
    )
    colours = {}
    for number in (46, 80):
        target = tmp_path / f"{number}.png"
        words = ("-o", target, "--pack", pack, "--format", str(number), "--view", "back")
        assert drapery("render", "white", *words, "--size", "40x50")[0] == 0
        pixels = np.asarray(Image.open(target)).astype(int)
        colours[number] = (pixels[..., 0] > pixels[..., 2] + 20).any()
    assert colours == {46: True, 80: False}
