"""A cloth held at two corners swings down and hangs like a curtain."""

from collections.abc import Iterator

from drapery.render import Scene
from drapery.scenes.catalogue import Clip
from drapery.scenes.corners import CornersParameters, show


def play(parameters: CornersParameters, clip: Clip) -> Iterator[Scene]:
    """From the moment of its release. Its first row is over the middle of the ground, so that it
    has room to swing."""
    return show(parameters, clip, ("top-left", "top-right"), back=0.0)
