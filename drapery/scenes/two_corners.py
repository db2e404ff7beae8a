"""A cloth held at two corners swings down and hangs like a curtain."""

from collections.abc import Iterator

from drapery.render.scene import Scene
from drapery.scenes.catalogue import Shot
from drapery.scenes.corners import Parameters, show

__all__ = ["Parameters", "play"]


def play(parameters: Parameters, shot: Shot) -> Iterator[Scene]:
    """From the moment when it is let go."""
    return show("corners", parameters, shot)
