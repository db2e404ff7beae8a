"""Designs that are found for a face: exactly where a design shows it, most nearly elsewhere."""

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from drapery import Banner, OptionError, draw_face
from drapery.banner import DYE_NAMES
from drapery.match import Matcher, match
from drapery.match.art import read_art
from drapery.match.colours import MEASURED, PERCEIVED, Metric, oklab
from drapery.match.exact import ExactSearch
from drapery.match.nearest import NearestSearch
from drapery.packs import MemoryPack, open_packs

SIX = (
    "red stripe_left:yellow flow:gray triangle_top:blue gradient:purple creeper:brown border:black"
)


def face_of(text: str, **options: Any) -> NDArray[np.uint8]:
    return draw_face(Banner.parse(text), scale=1, **options).pixels[..., :3]


@pytest.fixture(scope="module")
def matcher() -> Matcher:
    return Matcher()


def test_a_face_is_painted_as_it_is_drawn(matcher: Matcher) -> None:
    stack = (14, ((5, 4), (40, 7), (16, 11), (31, 10)))
    painted = matcher.art.paint(*stack).reshape(40, 20, 3)
    drawn = draw_face(matcher.art.banner(*stack), scale=1).pixels[..., :3]
    np.testing.assert_array_equal(painted, drawn)


@pytest.mark.parametrize(
    "text", ["lime", "white cross:red", "white gradient:red gradient_up:blue", SIX]
)
def test_the_design_of_a_face_is_found(matcher: Matcher, text: str) -> None:
    (found,) = matcher.match(face_of(text), alternatives=1, effort=0)
    assert found.error == 0
    np.testing.assert_array_equal(face_of(text), draw_face(found.banner, scale=1).pixels[..., :3])


def test_random_designs_are_found_exactly() -> None:
    rng, art = np.random.default_rng(3), read_art(open_packs(()))
    search = ExactSearch(art)
    for _ in range(3):
        layers = [(int(rng.integers(42)), int(rng.integers(16))) for _ in range(6)]
        face = art.paint(int(rng.integers(16)), layers)
        found = search.find(face, 6)
        assert found is not None
        np.testing.assert_array_equal(art.paint(*found), face)


def test_layers_that_hide_much_are_found_from_the_top_downwards(matcher: Matcher) -> None:
    """The gradient and the border hide most of the crosses, so nothing begins with these."""
    text = "black cross:lime straight_cross:black gradient:orange border:orange"
    goal = NearestSearch(matcher.art).goal(face_of(text), np.ones(800, np.int32), MEASURED)
    downwards = [stack for stacks in goal.lowered(4, 4) for stack in stacks]
    upwards = [stack for stacks in goal.grow(4, 12) for stack in stacks]
    assert 100 * min(map(goal.error, downwards)) < min(map(goal.error, upwards))


def test_hidden_layers_are_left_out(matcher: Matcher) -> None:
    text = "red creeper:lime border:pink half_vertical:white half_vertical_right:white cross:black"
    (found,) = matcher.match(face_of(text), alternatives=1, effort=0)
    assert found.error == 0
    assert len(found.banner.layers) <= 3


def test_a_face_that_is_slightly_off_is_found_within_a_tolerance() -> None:
    art = read_art(open_packs(()))
    layers = [(4, 3), (31, 9), (23, 1)]
    face = art.paint(2, layers)
    noisy = face + np.random.default_rng(0).integers(-1, 2, face.shape).astype(np.int32)
    assert ExactSearch(art).find(noisy, 6) is None
    assert ExactSearch(art).find(noisy, 6, tolerance=1) == (2, tuple(layers))


def test_a_face_with_a_hole_is_found_exactly(matcher: Matcher) -> None:
    face, weights = face_of("white creeper:lime border:black").copy(), np.ones((40, 20))
    face[22:26, 3:17], weights[22:26, 3:17] = (9, 200, 250), 0
    (found,) = matcher.match(face, weights=weights, alternatives=1, effort=0)
    assert found.error == 0
    assert {layer.pattern for layer in found.banner.layers} >= {"border", "creeper"}


def test_the_design_is_found_in_the_look_of_a_pack() -> None:
    mask = np.zeros((64, 64), np.uint8)
    mask[1:11, 1:21] = 255
    pack = MemoryPack(patterns={"creeper": mask})
    face = face_of("white creeper:red", packs=pack)
    (found,) = match(face, packs=pack, alternatives=1, effort=0)
    assert found.error == 0
    np.testing.assert_array_equal(
        draw_face(found.banner, packs=pack, scale=1).pixels[..., :3], face
    )


@pytest.mark.parametrize("metric", [PERCEIVED, MEASURED])
def test_errors_of_all_choices_are_those_of_the_faces(metric: Metric) -> None:
    art = read_art(open_packs(()))
    face = np.random.default_rng(0).integers(0, 256, 2400)
    goal = NearestSearch(art).goal(face, np.ones(800), metric)
    base, layers = 3, ((5, 2), (33, 7), (10, 1), (32, 4))
    table = goal.choices(goal.below(base, layers[:2]), goal.over(layers[3:]))
    for choice in ((5, 5), (32, 2), (40, 9)):
        true = goal.error((base, (*layers[:2], choice, layers[3])))
        assert abs(table[choice] - true) < 0.002 * true


def test_layers_below_the_top_ones_are_searched_anew() -> None:
    art = read_art(open_packs(()))
    names = ("triangle_top", "stripe_bottom", "circle")
    triangle, stripe, circle = map(art.patterns.index, names)
    right = (0, ((triangle, 14), (stripe, 15), (circle, 4)))
    goal = NearestSearch(art).goal(art.paint(*right), np.ones(800))
    wrong = (7, ((stripe, 3), (triangle, 5), (circle, 4)))
    assert min(map(goal.error, goal.regrown(wrong, 3, 4))) == 0


def test_layers_in_a_wrong_order_are_swapped() -> None:
    art = read_art(open_packs(()))
    right = (0, ((4, 15), (31, 1), (20, 10)))
    goal = NearestSearch(art).goal(art.paint(*right), np.ones(800))
    assert goal.error(goal.reordered((0, ((20, 10), (31, 1), (4, 15))))) == 0


def test_alternatives_differ_and_come_best_first(matcher: Matcher) -> None:
    y, x = np.mgrid[:40, :20]
    face = np.stack([6 * y, 250 - 12 * x, 90 + x], axis=-1).astype(np.uint8)
    found = matcher.match(face, layers=2, alternatives=3, effort=1)
    assert len({one.banner for one in found}) == 3
    assert [one.error for one in found] == sorted(one.error for one in found)
    assert found == matcher.match(face, layers=2, alternatives=3, effort=1)


def test_the_second_design_is_one_next_to_the_best(matcher: Matcher) -> None:
    face, text = face_of("red stripe_middle:white circle:blue"), "red stripe_middle:white circle:"
    apart = [
        np.linalg.norm(oklab(face) - oklab(face_of(text + dye)), axis=-1).mean()
        for dye in DYE_NAMES
        if dye != "blue"
    ]
    _, second = matcher.match(face, layers=2, alternatives=2, effort=0)
    assert second.error < min(apart) + 1e-4


def test_there_is_an_answer_before_the_search_for_exact_designs(matcher: Matcher) -> None:
    first = next(matcher.iter_matches(face_of(SIX), alternatives=1))
    assert first.share == 0
    assert first.matches[0].error > 0


def test_texels_of_weight_0_do_not_count(matcher: Matcher) -> None:
    face, weights = face_of("white half_horizontal:red"), np.zeros((40, 20))
    weights[:18] = 1
    (found,) = matcher.match(face, layers=0, weights=weights, alternatives=1, effort=0)
    assert found.banner == Banner("red")


@pytest.mark.parametrize(
    ("face", "options", "message"),
    [
        ((20, 40, 3), {}, r"uint8 \[20, 40, 3\]"),
        ((40, 20, 3), {"layers": 17}, "layers"),
        ((40, 20, 3), {"weights": np.zeros((40, 20))}, "at least one texel"),
        ((40, 20, 3), {"weights": np.ones((20, 40))}, "numbers from 0"),
    ],
)
def test_bad_arguments_are_refused(
    matcher: Matcher, face: tuple[int, ...], options: dict[str, Any], message: str
) -> None:
    with pytest.raises(OptionError, match=message):
        matcher.match(np.zeros(face, np.uint8), **options)
