"""A walking figure of boxes: its parts, poses and materials.

It stands on y = 0 at the origin, faces +z, and is 32 texels (1.875 m) tall, as the game's players
are. Its skin is any texture of their layout, 64 x 64 texels.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from drapery.banner.packs import Packs
from drapery.mesh import Array, Mesh
from drapery.render.scene import Material, TextureLayer
from drapery.style.boxes import ModelBox, box_mesh, join, upright
from drapery.style.uv_mapping import BoxMapping, box_mapping

TEXEL = 0.9375 / 16.0
"""Metres per texel of players, capes and elytra: the game draws them at 15/16 of the size of
blocks, whose texels are 1/16 m."""
SKIN_SHEET = (64, 64)
"""Width and height of the built-in textures of skins and capes [texels]."""
CAPE_SIZE = (10 * TEXEL, 16 * TEXEL)
"""Width and length of a cape [m]; it is one texel thick."""

SKINS = ("traveller", "dancer")
"""The built-in skins."""

Placed = tuple[Array, Array]
"""A rigid pose: position [m], shape [3], and rotation matrix, shape [3, 3]."""


@dataclass(frozen=True)
class FigurePart:
    """A box of the figure and the joint about which it turns [texels, y down, the ground at 0]."""

    box: ModelBox
    joint: tuple[float, float, float]

    @property
    def centre(self) -> Array:
        """Middle of the box at rest [m], shape [3]."""
        return to_metres(np.array(self.box.corner) + np.array(self.box.size) / 2)

    @cached_property
    def pivot(self) -> Array:
        """Its joint at rest [m], shape [3]."""
        return to_metres(np.array(self.joint))

    @property
    def extent(self) -> Array:
        """Edge lengths [m], shape [3]."""
        return np.array(self.box.size) * TEXEL


def cape_mapping(sheet: tuple[int, int]) -> BoxMapping:
    """Where the sides of a cape lie on its texture of this width and height [texels]."""
    return box_mapping((0, 0), (10, 16, 1), sheet)


def to_metres(texels: Array) -> Array:
    """A place in the model [texels, y down, z back] as one in the world [m, y up, z front]."""
    metres: Array = texels * np.array([TEXEL, -TEXEL, -TEXEL])
    return metres


PARTS: dict[str, FigurePart] = {
    "head": FigurePart(ModelBox((-4, -32, -4), (8, 8, 8), (0, 0)), (0, -24, 0)),
    "body": FigurePart(ModelBox((-4, -24, -2), (8, 12, 4), (16, 16)), (0, -24, 0)),
    "right_arm": FigurePart(ModelBox((-8, -24, -2), (4, 12, 4), (40, 16)), (-6, -22, 0)),
    "left_arm": FigurePart(ModelBox((4, -24, -2), (4, 12, 4), (32, 48)), (6, -22, 0)),
    "right_leg": FigurePart(ModelBox((-4, -12, -2), (4, 12, 4), (0, 16)), (-2, -12, 0)),
    "left_leg": FigurePart(ModelBox((0, -12, -2), (4, 12, 4), (16, 48)), (2, -12, 0)),
}

WING_JOINTS = {"right_wing": (-5, -24, 2), "left_wing": (5, -24, 2)}
"""Where wings turn on the back, as the game's do [texels, y down]. Nothing else has these bones."""


def figure_mesh(poses: Mapping[str, Placed]) -> Mesh:
    """The figure with each part in its pose; a part without one is at rest."""
    return join([posed(mesh, poses.get(name)) for name, mesh in _REST.items()])


def figure_material(skin: str, packs: Packs) -> Material:
    """A figure's skin, or a cape, by name: `traveller`, `dancer`, `cape`. Raises PackError."""
    return Material((TextureLayer(packs.texture(f"entity/player/{skin}")),))


def posed(mesh: Mesh, pose: Placed | None) -> Mesh:
    """A mesh at rest moved to a pose; as it is without one."""
    if pose is None:
        return mesh
    position, rotation = pose
    # einsum adds in a fixed order; BLAS may not.
    return replace(
        mesh,
        positions=np.einsum("ij,vj->vi", rotation, mesh.positions) + position,
        normals=np.einsum("ij,vj->vi", rotation, mesh.normals),
    )


_REST = {name: upright(box_mesh(part.box), TEXEL, (0, 0, 0)) for name, part in PARTS.items()}
