"""The block textures of our scenes, by name. All are opaque and repeat without a seam."""

from collections.abc import Callable

from assets.drawing import ground, masonry, timber
from assets.drawing.canvas import Texels

BLOCKS: dict[str, Callable[[], Texels]] = {
    "grass_block_top": ground.grass_block_top,
    "grass_block_side": ground.grass_block_side,
    "dirt": ground.dirt,
    "sand": ground.sand,
    "white_wool": ground.white_wool,
    "stone": masonry.stone,
    "cobblestone": masonry.cobblestone,
    "stone_bricks": masonry.stone_bricks,
    "oak_planks": timber.oak_planks,
    "spruce_planks": timber.spruce_planks,
    "oak_log": timber.oak_log,
    "oak_log_top": timber.oak_log_top,
}
"""Functions that draw a texture of shape [16, 16, 4]."""
