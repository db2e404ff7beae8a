"""The ground of a picture, and what the hero view sets by itself."""

from pathlib import Path

import numpy as np
import pytest
from conftest import Run
from pack_maker import folder_pack, plain

from drapery.banner.design import Banner, Layer
from drapery.banner.packs import open_packs
from drapery.errors import BackendError, OptionError
from drapery.packs import MemoryPack
from drapery.pictures import draw
from drapery.render import backend
from drapery.render.light import GAME_LIGHT, STUDIO_LIGHT
from drapery.scenes import still
from drapery.settings import Settings

HALVES = Banner("white", (Layer("half_vertical", "red"),))
SMALL = (96, 120)


def test_the_hero_view_has_its_own_light_samples_and_ground() -> None:
    hero, front = Settings(view="hero"), Settings()
    assert (hero.light, hero.samples, hero.ground) == ("studio", 4, "grass")
    assert (front.light, front.samples, front.ground) == ("game", 1, "none")
    assert Settings(view="hero", placement="wall").ground == "stone_bricks"
    item = Settings(view="hero", placement="item")
    assert (item.light, item.samples, item.ground) == ("game", 1, "none")
    plain_hero = Settings(view="hero", light="game", samples=1, ground="none")
    assert (plain_hero.light, plain_hero.samples, plain_hero.ground) == ("game", 1, "none")


def test_the_games_light_is_exact_in_the_hero_view_too() -> None:
    scene = still(HALVES, open_packs(), Settings(view="hero", light="game", ground="none"))
    assert scene.light == GAME_LIGHT and len(scene.models) == 2
    assert still(HALVES, open_packs(), Settings(view="hero")).light == STUDIO_LIGHT


def test_a_block_lies_below_and_fills_the_lower_edge_of_the_picture() -> None:
    bare = draw(HALVES, view="hero", ground="none", size=SMALL).pixels
    stone = draw(HALVES, view="hero", ground="stone", size=SMALL).pixels
    assert not bare[-2:, :, 3].any() and stone[-1, 40:56, 3].all()
    assert not stone[:, :3, 3].any() and not stone[:, -3:, 3].any()


def test_a_wall_fills_the_picture_and_turns_with_its_banner() -> None:
    south = draw(HALVES, view="hero", placement="wall", size=SMALL).pixels
    assert south[..., 3].all()
    seen = draw(HALVES, view="front", placement="wall", ground="stone", facing="west", size=SMALL)
    assert not seen.pixels[..., 3].all()


def test_the_block_does_not_turn_with_the_banner() -> None:
    corners = [
        still(HALVES, open_packs(), Settings(ground="stone", rotation=rotation)).models[0].mesh
        for rotation in (0, 2)
    ]
    assert np.array_equal(corners[0].positions, corners[1].positions)


def test_ground_wears_the_textures_of_packs(tmp_path: Path) -> None:
    texture = "assets/minecraft/textures/block/clay.png"
    pack = folder_pack(tmp_path, {texture: plain(9, 90, 9, 255, side=16)})
    with pytest.warns(UserWarning, match="no texture comes from"):
        pixels = draw(HALVES, packs=pack, ground="clay", light="flat", size=SMALL).pixels
    assert (pixels == (9, 90, 9, 255)).all(axis=2).any()


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"ground": "clay"}, "ground clay has no texture block/clay"),
        ({"ground": "Grass Block"}, "is not a block; use none, grass, stone"),
        ({"ground": "stone", "placement": "item"}, "is not for an item"),
    ],
)
def test_other_ground_is_refused(options: dict[str, str], message: str) -> None:
    with pytest.raises(OptionError, match=message):
        draw(HALVES, size=SMALL, **options)  # type: ignore[arg-type]


def test_the_command_line_takes_a_ground(drapery: Run, tmp_path: Path) -> None:
    words = ("--ground", "grass", "--light", "studio", "--size", "24x32")
    assert drapery("render", "red", "-o", tmp_path / "a.png", *words)[0] == 0


@pytest.mark.parametrize("view", ["front", "iso", "hero", "back"])
def test_the_contact_shadow_stays_within_the_picture(view: str) -> None:
    options = {"view": view, "ground": "none", "light": "game", "size": SMALL}
    pixels = draw(HALVES, shadow=True, **options).pixels  # type: ignore[arg-type]
    edge = np.concatenate([pixels[0], pixels[-1], pixels[:, 0], pixels[:, -1]])
    assert not edge[:, 3].any()


@pytest.mark.parametrize("name", ["soft", "pyrender"])
@pytest.mark.parametrize("pose", ["cloth", "vanilla"])
def test_a_bare_sheet_shows_each_side_to_its_viewer(name: str, pose: str) -> None:
    try:
        backend(name)
    except BackendError as error:
        pytest.skip(str(error))
    for view in ("front", "back"):
        options = {"view": view, "pose": pose, "backend": name, "size": SMALL, "samples": 1}
        if pose == "cloth":
            options["contact"] = "world"  # what meets itself moves as its thickness lets it
        bare, thick = (
            draw(HALVES, thickness=thickness, light="flat", **options).pixels.astype(int)  # type: ignore[arg-type]
            for thickness in (0.0, 0.2)
        )
        middle = (slice(20, 80), slice(30, 66))
        differs = (np.abs(bare[middle] - thick[middle]) > 40).any(axis=2)
        assert differs.mean() < 0.05, view


def test_the_contact_shadow_ends_with_the_block() -> None:
    settings = Settings(view="hero", shadow=True, size=SMALL)
    scene = still(HALVES, open_packs(), settings)
    below = [model for model in scene.models if model.materials[0].alpha == "blend"]
    (shadow,) = below
    height, width = shadow.materials[0].layers[0].texels.shape[:2]
    places = shadow.mesh.positions[:, [0, 2]]
    rows, columns = np.nonzero(shadow.materials[0].layers[0].texels[..., 3])
    low, span = places.min(axis=0), np.ptp(places, axis=0)
    x = low[0] + (columns + 0.5) / width * span[0]
    z = low[1] + (rows + 0.5) / height * span[1]
    assert x.min() > 0 and x.max() < 1 and z.min() > 0 and z.max() < 1


def test_an_item_has_the_brightness_of_the_games_lightmap() -> None:
    white = np.full((64, 64, 4), 255, np.uint8)
    pack = MemoryPack(patterns={"base": white})
    seen = draw(Banner("white"), packs=pack, placement="item", size=SMALL).pixels
    # The dye is F9FFFE; the lightmap's full light is 252 of 255.
    assert seen.reshape(-1, 4).max(axis=0).tolist() == [246, 252, 251, 255]
