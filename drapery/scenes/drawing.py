"""The pictures of a ready-made scene."""

from collections import deque
from collections.abc import Iterator
from typing import Any

from drapery.render.backends import backend as backend_named
from drapery.render.frame import Frame
from drapery.scenes.catalogue import Entry, Shot
from drapery.scenes.panels import drawn
from drapery.settings import OPTIONS


def scene_frames(
    scene: Entry, parameters: Any, shot: Shot, backend: str = "auto", *, last: bool = False
) -> Iterator[Frame]:
    """The frames of a ready-made scene, or only its last, drawn one by one.

    Raises OptionError or BackendError.
    """
    OPTIONS["size"].check(shot.size)
    draw_scene = backend_named(backend)
    pictures = scene.play(parameters, shot)
    if last:
        pictures = iter([*deque(pictures, maxlen=1)])
    return (drawn(picture, draw_scene) for picture in pictures)
