"""Samples, squares of pixels, light and shadow as they are asked of any picture."""

import numpy as np
import pytest

from drapery import Banner, DraperyError, draw
from drapery.render.frame import Pixels

BANNER = Banner.parse("white creeper:lime border:black")
SIZE = (48, 64)


def pixels(**options: object) -> Pixels:
    return draw(BANNER, **({"size": SIZE, "view": "hero"} | options)).pixels  # type: ignore[arg-type]


def test_large_pixels_are_squares_of_the_small_picture() -> None:
    small = pixels(size=(24, 32))
    assert np.array_equal(pixels(pixel=2), small.repeat(2, axis=0).repeat(2, axis=1))


def test_samples_soften_edges_and_leave_the_inside() -> None:
    hard, soft = pixels(), pixels(samples=16)
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


@pytest.mark.parametrize("solver", ["xpbd", "pbd"])
def test_every_solver_moves_the_banner_its_own_way(solver: str) -> None:
    assert (pixels(solver=solver) != pixels()).any()
    with pytest.raises(DraperyError, match="solver 'magic' is not known"):
        pixels(solver="magic")


def test_the_solvers_are_those_of_the_cloth() -> None:
    from typing import get_args

    from drapery.cloth.solvers.registry import SOLVERS
    from drapery.settings import SolverName

    assert tuple(SOLVERS) == get_args(SolverName)


def test_a_shadow_is_added_under_the_banner_and_nowhere_else() -> None:
    plain, shaded = pixels(), pixels(shadow=True)
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
    ],
    ids=str,
)
def test_what_cannot_be_is_refused(wrong: dict[str, object]) -> None:
    with pytest.raises(DraperyError, match=next(iter(wrong)).split("_")[0]):
        pixels(**wrong)
