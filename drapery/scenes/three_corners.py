"""A cloth held at three corners droops at the free one."""

from collections.abc import Iterator

from drapery.render.scene import Scene
from drapery.scenes.catalogue import Shot
from drapery.scenes.corners import Parameters, show

__all__ = ["Parameters", "play"]


def play(parameters: Parameters, shot: Shot) -> Iterator[Scene]:
    """From the moment when it is let go."""
    return show("three-corners", parameters, shot)
