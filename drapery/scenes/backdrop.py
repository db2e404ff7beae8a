"""What a scene's pictures have in common: the camera, what stands still, the light and the sky."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from drapery.mesh import Array
from drapery.render import GAME_LIGHT, Camera, Light, Model, Scene, View, frame_points
from drapery.style.scenery import SKY


@dataclass(frozen=True, eq=False)
class Backdrop:
    """The pictures of a scene without what moves in them.

    camera: its view.
    size: width and height of each picture [pixels].
    still: models that do not move.
    light: on all models.
    background: its colour, straight-alpha sRGB.
    """

    camera: Camera
    size: tuple[int, int]
    still: tuple[Model, ...] = ()
    light: Light = GAME_LIGHT
    background: tuple[int, int, int, int] = SKY

    def scene(self, moving: Iterable[Model]) -> Scene:
        """One picture, with the models that move."""
        models = (*self.still, *moving)
        return Scene(models, self.camera, self.size, self.light, self.background, samples=4)


def framing(
    view: View,
    points: Array | Sequence[Sequence[float]],
    size: tuple[int, int],
    still: tuple[Model, ...] = (),
    margin: float = 0.05,
) -> Backdrop:
    """A backdrop by day whose camera frames points.

    view: direction of the camera.
    points: [m], shape [..., 3].
    size: width and height of the picture [pixels].
    still: models that do not move.
    margin: the free share at each side of the picture.
    """
    camera = frame_points(view, np.asarray(points, float), size[0] / size[1], margin=margin)
    return Backdrop(camera, size, still)
