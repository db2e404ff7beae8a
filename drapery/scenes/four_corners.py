"""A cloth held at four corners sags into a hammock."""

from collections.abc import Iterator
from dataclasses import dataclass

from drapery.render import Scene
from drapery.scenes.catalogue import Clip
from drapery.scenes.corners import CornersParameters, show
from drapery.scenes.parameters import MAX_DRAG, parameter


@dataclass(frozen=True)
class FourCornersParameters(CornersParameters):
    """More drag than in the other scenes, so that the cloth comes to rest within the clip."""

    drag: float = parameter(2.0, "Drag of the air", (0, MAX_DRAG), "1/s")


def play(parameters: FourCornersParameters, clip: Clip) -> Iterator[Scene]:
    """From the moment of its release."""
    return show("four-corners", parameters, clip)
