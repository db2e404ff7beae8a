"""How a walking figure is drawn: in place, over ground that passes below."""

import numpy as np

from drapery.banner.packs import Packs
from drapery.render.camera import Camera
from drapery.render.scene import Material, Model
from drapery.render.views import View, frame_points
from drapery.scenes.gait import Gait
from drapery.style.figure import figure_mesh
from drapery.style.scenery import moved, path_ground, shadow

BEHIND = View(azimuth=214, elevation=14, fov=26)
BEFORE = View(azimuth=32, elevation=12, fov=26)
PERIOD = 10
"""The ground repeats after this number of blocks, the distance walked in a loop."""


def walker(
    gait: Gait, time: float, skin: Material, causeway: tuple[Model, ...]
) -> tuple[Model, ...]:
    """The figure, its shadow and the ground at a time of its walk [s]."""
    passed = np.array([0.0, 0.0, -(gait.speed * time % PERIOD)])
    figure = Model(figure_mesh(gait.poses(time)), (skin,))
    return (*moved(causeway, passed), shadow((0, 0), 0.5), figure)


def ground(packs: Packs) -> tuple[Model, ...]:
    """The path that it walks on."""
    return path_ground(24, PERIOD, packs)


def camera(size: tuple[int, int], view: View = BEHIND, tail: float = 0.9) -> Camera:
    """A view of the figure. tail: how far its cloth streams behind it [m]."""
    framed = np.array([[-0.5, 0, -tail], [0.5, 0, 0.5], [0.5, 2, 0.4], [-0.5, 2, -0.4]])
    return frame_points(view, framed, size[0] / size[1], margin=0.1)
