"""The pictures of a ready-made scene."""

from collections import deque
from collections.abc import Iterable, Iterator
from typing import Any

from drapery.render.backends import backend as backend_named
from drapery.render.frame import Frame
from drapery.scenes.catalogue import Clip, SceneEntry
from drapery.scenes.picture_grid import drawn
from drapery.scenes.styling import styled_pictures
from drapery.settings import OPTIONS, StyleLike
from drapery.styles.catalogue import combined_style


def scene_frames(
    scene: SceneEntry,
    parameters: Any,
    clip: Clip,
    backend: str = "auto",
    *,
    last: bool = False,
    style: StyleLike | Iterable[StyleLike] = (),
) -> Iterator[Frame]:
    """The frames of a ready-made scene, drawn one by one.

    scene: one of the catalogue.
    parameters: the values of the scene's own options.
    clip: size and length of the film.
    backend: see `drapery.render.backend`.
    last: draws only the last frame.
    style: a style, or several in their order.

    Raises OptionError or BackendError for what cannot be drawn.
    """
    OPTIONS["size"].check(clip.size)
    draw_scene, chosen = backend_named(backend), combined_style(style)
    pictures = scene.play(parameters, clip)
    if last:
        pictures = iter([*deque(pictures, maxlen=1)])
    pictures = styled_pictures(pictures, chosen, draw_scene)
    return (drawn(picture, draw_scene) for picture in pictures)
