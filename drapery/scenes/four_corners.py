"""A cloth held at four corners sags into a hammock."""

from collections.abc import Iterator
from dataclasses import dataclass

from drapery.render.scene import Scene
from drapery.scenes import corners
from drapery.scenes.catalogue import Shot


@dataclass(frozen=True)
class Parameters(corners.Parameters):
    """More drag than the others have: it comes to rest while one looks."""

    drag: float = 2.0


def play(parameters: Parameters, shot: Shot) -> Iterator[Scene]:
    """From the moment when it is let go."""
    return corners.show("four-corners", parameters, shot)
