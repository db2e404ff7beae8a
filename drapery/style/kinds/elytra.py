"""Elytra: two folded stiff wings, their outer side to the front.

The wings are rigid, so no wind moves them.
"""

import numpy as np

from drapery.banner.design import Banner
from drapery.banner.packs import Packs
from drapery.elementary import cos, sin
from drapery.mesh import Array, Mesh
from drapery.render.scene import Material, TextureLayer
from drapery.settings import Settings
from drapery.style.body import Body, Part
from drapery.style.boxes import ModelBox, box_mesh
from drapery.style.figure import TEXEL
from drapery.style.kinds.back import SHEET, SHOULDERS, back_texture
from drapery.style.uv_mapping import box_mapping

_LEFT_WING = ModelBox((-10, 0, 0), (10, 20, 2), (22, 0), grown=1.0)
_WING_MAPPING = box_mapping(_LEFT_WING.offset, _LEFT_WING.size, SHEET)
_ROOT = (5.0, 0.0, 0.0)
"""Where the left wing is attached to the shoulders [texels]."""
SPREAD = 15.0
"""Angle between a folded wing and the back, and between the two wings [degrees]."""


def body(design: Banner | None, packs: Packs, settings: Settings) -> Body:
    """Both wings, cut out by their texture. Raises OptionError or PackError."""
    material = Material((TextureLayer(back_texture(settings, packs, _WING_MAPPING)),), "cutout")
    left = _left_wing()
    wings = {"elytra/left": left, "elytra/right": _mirrored(left)}
    return Body(tuple(Part(wing, lambda time: material, name) for name, wing in wings.items()))


def _left_wing() -> Mesh:
    """The wing as someone behind the player sees it, at the left [m]."""
    box = box_mesh(_LEFT_WING, SHEET)
    matrix = _folded(np.radians(SPREAD))
    positions = np.einsum("ij,...j->...i", matrix, box.positions) + np.array(_ROOT)
    # The normals of box_mesh have y and z reversed; this rotation needs x and y reversed.
    upright = np.array([-1.0, -1.0, 1.0])
    normals = np.einsum("ij,...j->...i", matrix, box.normals * [1, -1, -1]) * upright
    return Mesh(positions * upright * TEXEL + np.array(SHOULDERS), normals, box.triangles, box.uvs)


def _folded(angle: float) -> Array:
    """The rotation of the left wing in the model: about x, then about -z, shape [3, 3]."""
    cosine, sine = cos(angle), sin(angle)
    about_x = np.array([[1, 0, 0], [0, cosine, -sine], [0, sine, cosine]])
    about_z = np.array([[cosine, sine, 0], [-sine, cosine, 0], [0, 0, 1]])
    matrix: Array = np.einsum("ij,jk->ik", about_z, about_x)
    return matrix


def _mirrored(wing: Mesh) -> Mesh:
    """The other wing, mirrored at the middle of the player together with its texture."""
    across = np.array([-1.0, 1.0, 1.0])
    middle = np.array([2 * SHOULDERS[0], 0, 0])
    return Mesh(
        wing.positions * across + middle,
        wing.normals * across,
        np.ascontiguousarray(wing.triangles[:, ::-1]),
        wing.uvs,
    )
