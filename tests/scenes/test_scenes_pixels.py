"""Flat and blocky scenes: the tutorial's curtain, the pixel cape, bends in steps, level texels."""

from itertools import islice

import numpy as np
import pytest

from drapery.mesh import Array
from drapery.scenes import hero_run, julia
from drapery.scenes.catalogue import Clip, find_scene
from drapery.scenes.dots import CapeTweaks, dot_grid, step
from drapery.scenes.hero_cape import cape_dots, hooks_of, worn_dots
from drapery.settings import LoopSettings
from drapery.style.block import FLAG_MAPPING, FLAG_SIZE, SCALE
from drapery.style.grids import grid_shell
from drapery.style.hero import LEGS, sprite
from drapery.style.piece import Piece
from drapery.styles.shape_steps import boards, voxels

NONE = CapeTweaks(False, False, False, False)


def published(steps: int) -> list[list[tuple[float, float]]]:
    """The tutorial's loop in plain numbers: after each step the dots, row by row from below."""
    nx, ny, spacing, dt = 25, 20, 0.2, 0.02
    x = [[(i + 1) * spacing for i in range(nx)] for _ in range(ny)]
    y = [[(j + 1) * spacing for _ in range(nx)] for j in range(ny)]
    before = [[*row] for row in x], [[*row] for row in y]
    after = []
    for number in range(1, steps + 1):
        push = 2 * np.sin(0.05 * number) * dt**2, -9.8 * dt**2
        for j in range(ny - 1):
            for i in range(nx):
                for places, old, a in zip((x, y), before, push, strict=True):
                    places[j][i], old[j][i] = 2 * places[j][i] - old[j][i] + a, places[j][i]
        for _ in range(6):
            for j in range(ny):
                for i in range(nx):
                    for jj, ii in ((j, i + 1), (j + 1, i)):
                        if ii < nx and jj < ny:
                            dx, dy = x[jj][ii] - x[j][i], y[jj][ii] - y[j][i]
                            length = (dx * dx + dy * dy) ** 0.5
                            half = 0.5 * (length - spacing) / length
                            if j < ny - 1:
                                x[j][i] += dx * half
                                y[j][i] += dy * half
                            if jj < ny - 1:
                                x[jj][ii] -= dx * half
                                y[jj][ii] -= dy * half
        after.append([(x[j][i], y[j][i]) for j in range(ny) for i in range(nx)])
    return after


def test_the_curtain_moves_by_the_published_numbers() -> None:
    parameters = julia.JuliaParameters()
    states = islice(julia.steps(parameters), 1, 301)
    for state, dots in zip(states, published(300), strict=True):
        rows = state.positions[0].reshape(20, 25, 3)[::-1].reshape(-1, 3)
        assert abs(rows[:, :2] - dots).max() < 1e-8
        assert not rows[:, 2].any()


def test_the_curtain_plays_at_its_own_rate() -> None:
    own = find_scene("julia").clip
    assert (own.count, own.fps) == (300, 30.0)
    assert find_scene("banner").clip == Clip()
    assert own.timing == LoopSettings(10.0, 30.0)


@pytest.mark.parametrize("fps", [1.0, 12.0, 24000 / 1001, 60.0, 120.0])
def test_a_film_as_long_as_a_clip_has_its_frames(fps: float) -> None:
    for count in range(1, 3601):
        clip = Clip((24, 36), count, fps)
        assert Clip.timed((24, 36), clip.timing) == clip


def cape(tweaks: CapeTweaks) -> tuple[Array, list[float]]:
    """Two loops of the dots from the hero's feet, [F, N, 2], and the times."""
    frames = list(worn_dots(cape_dots((3, 6)), tweaks, 3, Clip((64, 64), 240, 60.0)))
    return np.stack([places for places, _ in frames]), [time for _, time in frames]


@pytest.mark.parametrize("tweaks", [NONE, CapeTweaks()])
def test_a_pixel_cape_stays_on_its_hooks_and_above_the_ground(tweaks) -> None:
    places, times = cape(tweaks)
    dots = cape_dots((3, 6))
    for dot, time in zip(places, times, strict=True):
        hero = hero_run.hero_at(time)
        hooks = hooks_of(dots, hero, tweaks)
        np.testing.assert_allclose(dot[dots.pinned], hooks, atol=1e-9)
        assert (dot[:, 1] + hero.feet[1]).max() <= 1e-9


def test_neighbouring_dots_stay_near() -> None:
    dots = dot_grid(3, 6, 2.0, 2.0)
    random = np.random.default_rng(0)
    now = np.cumsum(np.full((18, 2), 0.3), axis=0)
    for _ in range(60):
        later = step(
            dots, now, now - random.normal(0, 0.3, (18, 2)), now[:3], np.zeros(2), NONE, 40
        )
        now = later
    apart = np.linalg.norm(now[dots.pairs[:, 1]] - now[dots.pairs[:, 0]], axis=1)
    assert (apart < dots.max_distance * 1.1).all()


def test_each_tweak_does_what_it_is_for() -> None:
    plain, times = cape(NONE)
    end = slice(9, 18)  # the lower half of the dots

    def speed(places: Array) -> float:
        return float(np.linalg.norm(np.diff(places[:, end], axis=0), axis=-1).mean())

    assert speed(cape(CapeTweaks(True, False, False, False))[0]) < 0.8 * speed(plain)
    assert speed(cape(CapeTweaks(False, True, False, False))[0]) < 0.8 * speed(plain)
    runs = [hero_run.hero_at(time).velocity[0] > 0 for time in times]
    behind = [
        cape(t)[0][runs][:, end, 0].mean() for t in (NONE, CapeTweaks(False, False, True, False))
    ]
    assert behind[1] < behind[0] - 1  # pushed against the run
    calm = CapeTweaks(hooks=False)
    heights = [np.ptp(cape(t)[0][20:50, :, 1], axis=1).mean() for t in (calm, CapeTweaks())]
    assert heights[1] > heights[0]  # keeps volume while it streams


def test_the_hero_runs_jumps_and_lands_and_a_loop_has_no_seam() -> None:
    legs = {hero_run.hero_at(time).legs for time in np.arange(0, 4, 0.02)}
    assert legs == set(LEGS)
    feet = np.stack([hero_run.hero_at(time).feet for time in np.arange(0, 4.01, 0.02)])
    assert np.isclose(feet[-1, 0] - feet[0, 0], hero_run.DISTANCE, atol=2)
    assert feet[:, 1].max() == 0 and np.isclose(feet[:, 1].min(), -17, atol=0.2)
    assert (np.diff(feet[:, 0]) >= 0).all()
    for name in LEGS:
        assert sprite(name).shape == (21, 12, 4)


@pytest.mark.parametrize("debug", ["yes", "no"])
def test_the_art_is_enlarged_by_a_whole_number(debug) -> None:
    scene = find_scene("cape-pixel")
    clip = Clip((288, 288), 1)
    words = {"compare": "no", "debug": debug}
    (picture,) = next(scene.play(scene.parameters(words), clip)).pictures
    blocks = picture.pixels.reshape(96, 3, 96, 3, 4)
    flat = (blocks == blocks[:, :1, :, :1]).all()
    assert flat == (debug == "no")
    colours = {tuple(c) for c in picture.pixels[..., :3].reshape(-1, 3)}
    works = {(60, 200, 80), (60, 110, 230), (220, 40, 40), (240, 150, 40)}
    assert works <= colours if debug == "yes" else not works & colours


FLAG = Piece(grid_shell(6, 3, FLAG_MAPPING), SCALE, SCALE, FLAG_SIZE)


def crumpled(flat: bool = False) -> np.ndarray:
    rows = np.zeros((6, 3, 3))
    rows[..., 0] = np.linspace(-0.4, 0.4, 3)
    bends = np.array([0.1, 0.5, 0.9, 0.3, -0.4])
    rows[1:, :, 1] = -0.3 * np.cumsum(np.cos(bends))[:, None]
    rows[1:, :, 2] = 0.3 * np.cumsum(np.sin(bends))[:, None]
    positions: np.ndarray = rows.reshape(-1, 3) * [1, 1, 0 if flat else 1]
    return positions


@pytest.mark.parametrize("steps", [1, 4, 7])
def test_steps_bend_only_by_whole_angles_and_keep_lengths(steps) -> None:
    given = crumpled()
    piece, bent = boards(FLAG, given, steps=steps)
    rows = piece.rows(bent)
    np.testing.assert_allclose(rows[0], FLAG.rows(given)[0])
    along = np.diff(rows[:, 1], axis=0)
    np.testing.assert_allclose(np.linalg.norm(along, axis=1), 0.3)
    turns = np.arctan2(along[:, 2], -along[:, 1]) / (np.pi / 2 / steps)
    np.testing.assert_allclose(turns, np.round(turns), atol=1e-9)
    np.testing.assert_allclose(np.ptp(rows[..., 0], axis=1), 0.8)


def test_a_hanging_sheet_needs_no_steps() -> None:
    flat = crumpled(flat=True)
    np.testing.assert_allclose(boards(FLAG, flat, steps=4)[1], flat, atol=1e-12)


def test_texels_of_a_steep_sheet_reach_back_to_their_neighbours() -> None:
    steep = crumpled() * [1, 1, 5]
    blocks = voxels(FLAG, steep).positions.reshape(40, 20, 24, 3)
    front, back = blocks[..., 2].max(axis=2), blocks[..., 2].min(axis=2)
    assert (np.abs(np.diff(front, axis=0)) / SCALE).max() > 2.5
    for one, other in ((np.s_[:, :-1], np.s_[:, 1:]), (np.s_[:-1], np.s_[1:])):
        apart = np.maximum(back[one], back[other]) - np.minimum(front[one], front[other])
        assert apart.max() < 1e-9
    np.testing.assert_allclose(np.ptp(blocks, axis=2)[..., :2], SCALE)


def test_snapped_texels_are_level_cubes_on_one_lattice() -> None:
    mesh = voxels(FLAG, crumpled())
    cubes = mesh.positions.reshape(800, 24, 3)
    np.testing.assert_allclose(np.ptp(cubes, axis=1), SCALE)
    places = (cubes.mean(axis=1) - cubes[0].mean(axis=0)) / SCALE
    np.testing.assert_allclose(places, np.round(places), atol=1e-6)
    uvs = mesh.uvs.reshape(800, 24, 2) * 64
    middles = uvs.reshape(800, 6, 4, 2).mean(axis=2)
    np.testing.assert_allclose(middles[0, 0], [1.5, 1.5])  # the front's first texel
    np.testing.assert_allclose(middles[0, 1], [41.5, 1.5])  # behind it, the back's last column
