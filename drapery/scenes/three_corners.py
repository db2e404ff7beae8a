"""A cloth held at three corners droops at the free one."""

from collections.abc import Iterator

from drapery.render import Scene
from drapery.scenes.catalogue import Clip
from drapery.scenes.corners import CornersParameters, show


def play(parameters: CornersParameters, clip: Clip) -> Iterator[Scene]:
    """From the moment of its release."""
    return show(parameters, clip, ("top-left", "top-right", "bottom-left"))
