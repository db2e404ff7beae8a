"""Compile the rasteriser into numba's cache: `python -m drapery.render.soft`."""

import numpy as np

from drapery.mesh import Mesh
from drapery.render.camera import Camera
from drapery.render.light import STUDIO_LIGHT
from drapery.render.scene import Material, Model, Scene, TextureLayer
from drapery.render.soft import draw_scene


def main() -> None:
    """Draw one triangle, with the shadows of most pictures."""
    corners = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0)], np.float32)
    triangle = Mesh(corners, corners, np.array([[0, 1, 2]], np.int32), corners[:, :2])
    material = Material((TextureLayer(np.zeros((1, 1, 4), np.uint8)),))
    camera, models = Camera((0, 0, 3), (0, 0, 0)), (Model(triangle, (material,)),)
    draw_scene(Scene(models, camera, (8, 8), STUDIO_LIGHT), threads=1)


if __name__ == "__main__":
    main()
