"""What the viewer shows at a moment: one picture, or several beside each other."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from drapery.mesh import Mesh
from drapery.render.camera import Camera
from drapery.render.frame import Frame
from drapery.render.light import UNLIT
from drapery.render.scene import Material, Model, Scene, TextureLayer
from drapery.scenes.picture_grid import Picture, PictureGrid

Framing = Callable[[float], Camera]
"""The camera for a picture of width / height."""

Wind = tuple[float, float, bool]
"""Speed [m/s], where it blows to in the world [degrees from +z towards +x], whether it blows."""


@dataclass(frozen=True, eq=False)
class Pane:
    """One picture. flat: a finished picture, which nobody walks around."""

    scene: Scene
    framing: Framing
    label: str = ""
    flat: bool = False


@dataclass(frozen=True, eq=False)
class Shown:
    """All that is seen.

    columns: panes in a row. grip: the models of each pane that a hand can take. live: whether it is
    the body that is being designed. wind: None where nothing can be steered. cut: another value
    than before asks the viewer to look anew. time: how long the cloth has moved [s].
    """

    panes: tuple[Pane, ...]
    columns: int = 1
    grip: frozenset[int] = frozenset()
    live: bool = False
    wind: Wind | None = None
    cut: object = None
    time: float = 0.0


def shown_picture(picture: Picture) -> Shown:
    """A picture of a ready-made scene."""
    if isinstance(picture, PictureGrid):
        panes = map(_pane, picture.pictures, picture.labels)
        return Shown(tuple(panes), picture.columns)
    return Shown((_pane(picture),))


def _pane(picture: Scene | Frame, label: str = "") -> Pane:
    if isinstance(picture, Frame):
        return Pane(_poster(picture), lambda aspect: _facing(picture, aspect), label, True)
    return Pane(picture, lambda aspect: picture.camera, label)


def _poster(frame: Frame) -> Scene:
    """A finished picture as a scene: a plain sheet, a metre high, straight before the camera."""
    height, width = frame.pixels.shape[:2]
    half = width / height / 2
    positions = np.array(
        [(-half, 0.5, 0), (half, 0.5, 0), (-half, -0.5, 0), (half, -0.5, 0)], np.float32
    )
    normals = np.tile(np.array([0, 0, 1], np.float32), (4, 1))
    uvs = np.array([(0, 0), (1, 0), (0, 1), (1, 1)], np.float64)
    mesh = Mesh(positions, normals, np.array([(0, 2, 1), (1, 2, 3)], np.int32), uvs)
    look = Material((TextureLayer(frame.pixels),), "blend", False)
    return Scene((Model(mesh, (look,)),), _facing(frame, 1.0), (width, height), UNLIT)


def _facing(frame: Frame, aspect: float) -> Camera:
    """Straight at it, so that all of it is seen."""
    height, width = frame.pixels.shape[:2]
    return Camera((0, 0, 2), (0, 0, 0), height=max(1.0, width / height / aspect))
