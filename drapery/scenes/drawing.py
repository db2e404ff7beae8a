"""The pictures of a ready-made scene."""

from collections import deque
from collections.abc import Iterator
from typing import Any

from drapery.render.backends import backend as backend_named
from drapery.render.frame import Frame
from drapery.scenes.catalogue import Clip, SceneEntry
from drapery.scenes.picture_grid import drawn
from drapery.settings import OPTIONS


def scene_frames(
    scene: SceneEntry, parameters: Any, clip: Clip, backend: str = "auto", *, last: bool = False
) -> Iterator[Frame]:
    """The frames of a ready-made scene, or only its last, drawn one by one.

    Raises OptionError or BackendError.
    """
    OPTIONS["size"].check(clip.size)
    draw_scene = backend_named(backend)
    pictures = scene.play(parameters, clip)
    if last:
        pictures = iter([*deque(pictures, maxlen=1)])
    return (drawn(picture, draw_scene) for picture in pictures)
