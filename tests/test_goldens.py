"""Six pictures that have been looked at; `pytest --drapery-update` accepts new ones."""

from pathlib import Path

from conftest import GIVE

from drapery import Banner, draw
from drapery.testing.plugin import Golden

SIX_LAYERS = Banner.parse(
    "blue gradient_up:light_blue stripe_bottom:green rhombus:yellow flower:white"
    " curly_border:black triangles_top:red"
)
SIZE = (192, 256)


def test_plain(golden: Golden) -> None:
    golden(draw(Banner("red"), size=SIZE), "plain")


def test_six_layers(golden: Golden) -> None:
    golden(draw(SIX_LAYERS, size=SIZE), "six-layers", banner=SIX_LAYERS)


def test_on_a_wall(golden: Golden) -> None:
    golden(draw(Banner.parse(GIVE), size=SIZE, placement="wall", view="iso"), "wall")


def test_from_behind(golden: Golden) -> None:
    golden(draw(SIX_LAYERS, size=SIZE, view="back"), "back")


def test_as_in_the_inventory(golden: Golden) -> None:
    golden(draw(Banner.parse(GIVE), size=(128, 128), view="gui", pose="vanilla"), "gui")


def test_with_a_real_pack(golden: Golden, real_pack: Path) -> None:
    banner = Banner.parse("yellow bricks:orange creeper:green border:purple")
    # Only the hash: the pack's art is not ours to keep here.
    golden(draw(banner, size=SIZE, packs=[real_pack]), "pack", hashed=True)
