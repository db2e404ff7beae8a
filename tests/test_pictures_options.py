"""Samples, squares of pixels, light and shadow as they are asked of any picture."""

import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from drapery import Banner, DraperyError, OptionError, draw
from drapery.arrays import Pixels
from drapery.banner.packs import open_packs
from drapery.cloth import FABRICS, Drag, Fabric, SolverXPBD, Wind
from drapery.mesh import Array
from drapery.render.backends import backend
from drapery.render.views import VIEWS
from drapery.scenes import still, wind_of
from drapery.settings import Settings

BANNER = Banner.parse("white creeper:lime border:black")
SIZE = (48, 64)


def pixels(**options: object) -> Pixels:
    return draw(BANNER, **({"size": SIZE, "view": "hero"} | options)).pixels  # type: ignore[arg-type]


def test_large_pixels_are_squares_of_the_small_picture() -> None:
    small = pixels(size=(24, 32))
    assert np.array_equal(pixels(pixel=2), small.repeat(2, axis=0).repeat(2, axis=1))


def test_samples_soften_edges_and_leave_the_inside() -> None:
    hard, soft = pixels(samples=1), pixels(samples=16)
    assert set(np.unique(hard[..., 3])) == {0, 255}
    assert len(np.unique(soft[..., 3])) > 4
    assert (soft[..., 3][hard[..., 3] == 0] < 255).all()


def test_flat_light_shows_the_textures_own_colours() -> None:
    dark, plain = pixels(), pixels(light="flat")
    seen = dark[..., 3] > 0
    assert (plain[seen] >= dark[seen]).all() and (plain[seen] > dark[seen]).any()


def test_night_is_darker_than_noon_and_a_torch_is_warm() -> None:
    noon, night = pixels(), pixels(daylight=0.0)
    torch = pixels(sky_light=0, block_light=12)
    seen = noon[..., 3] > 0
    assert night[seen][:, :3].mean() < 0.5 * noon[seen][:, :3].mean()
    red, _, blue, _ = torch[seen].mean(axis=0)
    assert red > 1.3 * blue


@pytest.mark.parametrize("solver", ["desbrun", "pbd"])
def test_every_solver_moves_the_banner_its_own_way(solver: str) -> None:
    assert (pixels(solver=solver) != pixels()).any()
    with pytest.raises(DraperyError, match="solver 'magic' is not known"):
        pixels(solver="magic")


def test_the_solvers_are_those_of_the_cloth() -> None:
    from typing import get_args

    from drapery.cloth.solvers.registry import SOLVERS
    from drapery.settings import SolverName

    assert tuple(SOLVERS) == get_args(SolverName)


def cloth(**options: object) -> Array:
    """The flag's vertices [m], shape [V, 3]."""
    settings = Settings(**({"size": SIZE} | options))  # type: ignore[arg-type]
    positions: Array = still(BANNER, open_packs(()), settings).models[-1].mesh.positions
    return positions


@pytest.mark.parametrize("direction", [0.0, 40.0, -40.0, 180.0])
def test_the_wind_carries_the_cloth_where_it_blows_to(direction: float) -> None:
    heading = math.radians(direction)
    drift = cloth(wind=9.0, direction=direction, gusts=0.0) - cloth(wind=0.0)
    along = drift @ np.array([math.sin(heading), 0.0, math.cos(heading)])
    assert along.mean() > 0.02


def test_gusts_are_of_the_wind_and_make_seeds_differ() -> None:
    assert np.array_equal(cloth(gusts=0.0, seed=1), cloth(gusts=0.0, seed=2))
    assert not np.array_equal(cloth(seed=1), cloth(seed=2))
    assert np.array_equal(cloth(wind=0.0, gusts=2.0), cloth(wind=0.0))


def test_cloth_hangs_by_its_pins() -> None:
    assert np.array_equal(cloth(pins="top"), cloth())
    middle = 8
    assert cloth(pins="corners")[middle, 1] < cloth()[middle, 1] - 0.01
    assert cloth(pins="none", contact="none")[:, 1].max() < -20
    assert abs(cloth(pins="none")[:, 1].min()) < 0.05  # it lies on the ground


def test_the_pins_are_those_of_the_cloth() -> None:
    from typing import get_args

    from drapery.cloth.pins import PinName
    from drapery.settings import Pins

    assert get_args(PinName) == get_args(Pins)


def test_a_shadow_is_added_under_the_banner_and_nowhere_else() -> None:
    settings = Settings(size=SIZE, view="hero", shadow=True, samples=1, ground="none")
    shaded_scene = still(BANNER, open_packs(), settings)
    draw_scene = backend("soft")
    # The first model is the shadow; without it the camera is the same.
    plain_scene = replace(shaded_scene, models=shaded_scene.models[1:])
    plain, shaded = draw_scene(plain_scene).pixels, draw_scene(shaded_scene).pixels
    changed = (plain != shaded).any(axis=-1)
    # The lowest texel of the pole stands in it.
    assert (plain[changed][:, 3] == 0).mean() > 0.95
    assert np.argwhere(changed)[:, 0].min() > SIZE[1] // 2


@pytest.mark.parametrize(
    "wrong",
    [
        {"samples": 2},
        {"pixel": 0},
        {"pixel": 5},
        {"light": "sun"},
        {"block_light": 16},
        {"sky_light": -1},
        {"daylight": 2.0},
        {"direction": 361.0},
        {"gusts": -0.1},
        {"pins": "left"},
    ],
    ids=str,
)
def test_what_cannot_be_is_refused(wrong: dict[str, object]) -> None:
    with pytest.raises(DraperyError, match=next(iter(wrong)).split("_")[0]):
        pixels(**wrong)


@pytest.mark.parametrize(
    ("name", "by_name", "by_object"),
    [
        ("view", "iso", VIEWS["iso"]),
        ("backend", "soft", backend("soft")),
        ("solver", "xpbd", SolverXPBD()),
        ("wind", 4.0, wind_of(Settings(wind=4.0))),
        ("fabric", "silk", FABRICS["silk"]),
        ("packs", (), open_packs(())),
        ("packs", (), [open_packs(())]),
    ],
    ids=["view", "backend", "solver", "wind", "fabric", "packs", "a list of packs"],
)
def test_an_object_draws_as_its_name_does(name: str, by_name: object, by_object: object) -> None:
    assert np.array_equal(pixels(**{name: by_name}), pixels(**{name: by_object}))


def test_a_texture_is_a_file_or_an_array(tmp_path: Path) -> None:
    texels = np.random.default_rng(1).integers(0, 256, (32, 64, 4), np.uint8)
    art = tmp_path / "cape.png"
    Image.fromarray(texels).save(art)
    options: dict[str, Any] = {"kind": "cape", "size": SIZE, "time": 0.1}
    drawn = draw(texture=texels, **options)
    assert np.array_equal(draw(texture=art, **options).pixels, drawn.pixels)
    with pytest.raises(OptionError, match=r"texture: an array of float64 \[8, 8\]; use uint8"):
        draw(texture=np.zeros((8, 8)), **options)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    "other",
    [
        {"solver": SolverXPBD(substeps=1)},
        {"wind": Wind((0.0, 3.0, 3.0))},
        {"fabric": Fabric(density=3.0)},
        {"forces": [Drag(9.0)]},
    ],
    ids=lambda options: next(iter(options)),
)
def test_objects_say_what_no_name_can(other: dict[str, object]) -> None:
    assert not np.array_equal(cloth(**other), cloth())
