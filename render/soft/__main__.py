"""Compile the rasteriser into numba's cache: `python -m drapery.render.soft`."""

import numpy as np

from drapery.mesh import Mesh
from drapery.render.camera import Camera
from drapery.render.scene import Material, Model, Scene, TextureLayer
from drapery.render.soft import draw_scene


def main() -> None:
    """Draw one triangle."""
    corners = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0)], np.float32)
    triangle = Mesh(corners, corners, np.array([[0, 1, 2]], np.int32), corners[:, :2])
    material = Material((TextureLayer(np.zeros((1, 1, 4), np.uint8)),))
    draw_scene(
        Scene((Model(triangle, (material,)),), Camera((0, 0, 3), (0, 0, 0)), (8, 8)), threads=1
    )


if __name__ == "__main__":
    main()
