"""Styles that read the dyes of a design keep its charges under gradients and translucent texels."""

from dataclasses import replace

import numpy as np
import pytest

from drapery import Banner
from drapery.banner import DYES, PATTERNS
from drapery.packs import open_packs
from drapery.render import Material, TextureLayer
from drapery.style import flag_material
from drapery.styles import STEPS
from drapery.styles.charges import charges_of

STYLED = ("hatch", "stained-glass", "embroider")
GRADIENTS = ("gradient", "gradient_up")
CHARGES = sorted(set(PATTERNS) - {"base", *GRADIENTS})
FRONT = np.s_[1:41, 1:21]
"""The front of a flag on its sheet [texels]."""


def material_of(design: str) -> Material:
    return flag_material(Banner.parse(design), open_packs(()))


def styled(step: str, material: Material) -> np.ndarray:
    """The front after a material step, shape [40, 20, 8, 8, 3], by texels."""
    (layer,) = STEPS["material"][step](material).layers
    fine = layer.texels.shape[1] // 64
    texels = layer.texels[..., :3].astype(int).reshape(64, fine, 64, fine, 3).swapaxes(1, 2)
    return texels[FRONT]


def uppermost(material: Material) -> np.ndarray:
    """The number of the uppermost layer that covers half of each texel of the front."""
    shown = np.zeros((64, 64), int)
    for number, layer in enumerate(material.layers):
        shown[layer.texels[..., 3] >= 128] = number
    return shown[FRONT]


@pytest.mark.parametrize("gradient", GRADIENTS)
@pytest.mark.parametrize("charge", CHARGES)
def test_a_charge_keeps_its_edges_below_a_gradient(charge: str, gradient: str) -> None:
    design = f"black {charge}:white"
    below, given = material_of(design), material_of(f"{design} {gradient}:purple")
    shown, labels = uppermost(below), charges_of(given).labels[FRONT]
    for axis in (0, 1):
        assert np.array_equal(np.diff(shown, axis=axis) != 0, np.diff(labels, axis=axis) != 0)
    assert np.array_equal(charges_of(given).dyes, charges_of(below).dyes)


@pytest.mark.parametrize("gradient", GRADIENTS)
def test_lines_and_lead_follow_a_skull_and_a_border_below_a_gradient(gradient: str) -> None:
    given = material_of(f"black skull:white border:red {gradient}:purple")
    shown = uppermost(replace(given, layers=given.layers[:-1]))
    edge = np.diff(shown, axis=1) != 0
    assert edge.sum() > 100
    for step in STYLED[:2]:
        ends = styled(step, given)[:, :-1, :, -1].max(axis=(-1, -2))
        assert (ends[edge] < 110).all(), step


@pytest.mark.parametrize("gradient", GRADIENTS)
@pytest.mark.parametrize("step", STYLED)
def test_a_gradient_of_the_dye_of_the_field_draws_nothing(step: str, gradient: str) -> None:
    plain, given = (material_of(f"yellow{each}") for each in ("", f" {gradient}:yellow"))
    one, other = styled(step, plain), styled(step, given)
    if step == "embroider":  # dyed as the textures are, which are no plain white
        one, other = (
            each / np.maximum(each.mean(axis=(2, 3, 4), keepdims=True), 1) for each in (one, other)
        )
        np.testing.assert_allclose(one, other, atol=0.06)
    else:
        assert np.abs(one - other).max() <= 1


def test_lines_of_a_gradient_become_wider_as_it_becomes_denser() -> None:
    front = styled("hatch", material_of("white gradient_up:purple"))
    dark = 255 - front.mean(axis=(1, 2, 3, 4)).reshape(8, 5).mean(axis=1)
    assert (np.diff(dark) > 0).all() and dark[-1] > 3 * (dark[0] - dark.min() + 1)


def test_glass_below_a_gradient_has_the_mixture_of_the_dyes() -> None:
    front = styled("stained-glass", material_of("white gradient_up:red"))
    red = [np.median(part[..., 0] - part[..., 2]) for part in np.split(front, 8)]
    assert (np.diff(red) > 0).all() and red[0] < 30 and red[-1] > 90


def test_a_translucent_charge_of_a_pack_is_one_charge() -> None:
    """Its texels shade it from a third to nine tenths; its outline is hard."""
    noise = np.random.default_rng(3)
    texels = np.zeros((64, 64, 4), np.uint8)
    texels[..., :3] = 255
    texels[10:30, 6:16, 3] = noise.integers(140, 230, (20, 10))
    plain = material_of("white")
    given = Material((*plain.layers, TextureLayer(texels, (176, 46, 38))))
    assert np.array_equal(charges_of(given).dyes == 14, texels[..., 3] > 0)


def test_flat_charges_have_the_colours_of_their_dyes_and_no_other() -> None:
    given = material_of("white creeper:lime border:black")
    colours = {DYES[name].rgb for name in ("white", "lime", "black")}
    (layer,) = STEPS["material"]["flatten"](given).layers
    assert {tuple(map(int, each)) for each in layer.texels[..., :3].reshape(-1, 3)} == colours
    assert (layer.texels[..., 3] == 255).all()


def test_a_gradient_of_half_the_strength_leaves_half_of_each_charge() -> None:
    given, flatten = (
        material_of("black skull:white gradient_up:purple"),
        STEPS["material"]["flatten"],
    )
    none, half, full = (
        flatten(given, gradients=strength).layers[0].texels[..., :3].astype(int)
        for strength in (0.0, 0.5, 1.0)
    )
    assert np.abs(2 * half - none - full).max() <= 2
    assert {tuple(map(int, each)) for each in none.reshape(-1, 3)} == {
        DYES[name].rgb for name in ("black", "white")
    }


def test_a_texture_without_dyes_stays_as_it_is() -> None:
    plain = Material((TextureLayer(np.full((64, 64, 4), 77, np.uint8)),))
    assert STEPS["material"]["flatten"](plain) is plain


def test_a_gradient_of_a_large_pack_is_one_too() -> None:
    material = material_of("white skull:black gradient:red")
    large = tuple(
        replace(layer, texels=layer.texels.repeat(8, axis=0).repeat(8, axis=1))
        for layer in material.layers
    )
    labels = charges_of(replace(material, layers=large)).labels
    assert np.array_equal(labels[::8, ::8], charges_of(material).labels)


@pytest.mark.parametrize("charge", ["skull", "creeper", "rhombus", "flower"])
def test_no_lead_goes_over_a_charge(charge: str) -> None:
    given = material_of(f"white {charge}:red")
    charged = charges_of(given).dyes[FRONT] == 14
    inside = charged.copy()
    for step in (1, -1):
        for axis in (0, 1):
            inside &= np.roll(charged, step, axis)
    assert inside.any() or charge == "skull"
    middle = styled("stained-glass", given)[:, :, 3:5, 3:5]
    assert (middle[inside][..., 0] > 120).all()


def test_a_plain_field_of_glass_is_in_diamonds() -> None:
    dark = styled("stained-glass", material_of("white")).max(axis=-1) < 110
    assert 0.05 < dark.mean() < 0.4
