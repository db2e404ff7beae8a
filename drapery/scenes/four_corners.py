"""A cloth held at four corners sags into a hammock."""

from collections.abc import Iterator
from dataclasses import dataclass

from drapery.render import Scene
from drapery.scenes.catalogue import Clip
from drapery.scenes.corners import CornersParameters, show
from drapery.scenes.parameters import drag_parameter


@dataclass(frozen=True)
class FourCornersParameters(CornersParameters):
    """More drag than in the other scenes, so that the cloth comes to rest within the clip."""

    drag: float = drag_parameter(2.0)


def play(parameters: FourCornersParameters, clip: Clip) -> Iterator[Scene]:
    """From the moment of its release."""
    return show(parameters, clip, ("corners",))
