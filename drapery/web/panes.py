"""What the viewer shows at a moment: one picture, or several side by side."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from drapery.render import UNLIT, Camera, Frame, Material, Mesh, Model, Scene, TextureLayer
from drapery.scenes import ClipPicture, PictureGrid

Framing = Callable[[float], Camera]
"""A callable that gives the camera for a picture of this aspect ratio, width / height."""

Wind = tuple[float, float, bool]
"""Speed [m/s], heading in the world [degrees from +z towards +x], whether the wind blows."""


@dataclass(frozen=True, eq=False)
class Pane:
    """One picture. flat: whether it is a finished 2-D picture, which has only one side."""

    scene: Scene
    framing: Framing
    label: str = ""
    flat: bool = False


@dataclass(frozen=True, eq=False)
class ViewerState:
    """Everything that the viewer shows.

    columns: panes in a row. grip: the models of each pane that can be grabbed. live: whether it
    shows the design, not a scene. wind: None if keys cannot change it. cut: when its value
    changes, the viewer resets its view. time: the simulated time [s].
    """

    panes: tuple[Pane, ...]
    columns: int = 1
    grip: frozenset[int] = frozenset()
    live: bool = False
    wind: Wind | None = None
    cut: object = None
    time: float = 0.0


def shown_picture(picture: ClipPicture) -> ViewerState:
    """A picture of a ready-made scene."""
    if isinstance(picture, PictureGrid):
        panes = map(_pane, picture.pictures, picture.labels)
        return ViewerState(tuple(panes), picture.columns)
    return ViewerState((_pane(picture),))


def _pane(picture: Scene | Frame, label: str = "") -> Pane:
    if isinstance(picture, Frame):
        return Pane(_poster(picture), lambda aspect: _facing(picture, aspect), label, True)
    return Pane(picture, lambda aspect: picture.camera, label)


def _poster(frame: Frame) -> Scene:
    """A finished picture as a scene: a rectangle, 1 m high, that faces the camera."""
    height, width = frame.pixels.shape[:2]
    half = width / height / 2
    positions = np.array(
        [(-half, 0.5, 0), (half, 0.5, 0), (-half, -0.5, 0), (half, -0.5, 0)], np.float32
    )
    normals = np.tile(np.array([0, 0, 1], np.float32), (4, 1))
    uvs = np.array([(0, 0), (1, 0), (0, 1), (1, 1)], np.float64)
    mesh = Mesh(positions, normals, np.array([(0, 2, 1), (1, 2, 3)], np.int32), uvs)
    material = Material((TextureLayer(frame.pixels),), "blend", False)
    return Scene((Model(mesh, (material,)),), _facing(frame, 1.0), (width, height), UNLIT)


def _facing(frame: Frame, aspect: float) -> Camera:
    """A camera that faces the picture and shows all of it."""
    height, width = frame.pixels.shape[:2]
    return Camera((0, 0, 2), (0, 0, 0), height=max(1.0, width / height / aspect))
