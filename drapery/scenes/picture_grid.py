"""What a scene yields: a `Scene` to be drawn, a finished `Frame`, or several side by side."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from drapery.arrays import Pixels
from drapery.render import Frame, Scene

INK, PAPER = (255, 255, 255), (24, 26, 34)
"""Colours of the labels."""


@dataclass(frozen=True)
class PictureGrid:
    """Pictures in rows, all of one size, each with a label in its lower left.

    pictures: scenes or finished frames, row by row.
    labels: one for each picture.
    columns: pictures in a row.
    """

    pictures: tuple[Scene | Frame, ...]
    labels: tuple[str, ...]
    columns: int = 2


ClipPicture = Scene | Frame | PictureGrid
"""One picture of a ready-made scene: to be drawn, drawn already, or several side by side."""


def panel_size(size: tuple[int, int], columns: int, rows: int = 1) -> tuple[int, int]:
    """Width and height of each panel [pixels] of a picture of this size."""
    return max(1, size[0] // columns), max(1, size[1] // rows)


def drawn(picture: ClipPicture, draw_scene: Callable[[Scene], Frame]) -> Frame:
    """The picture as pixels."""
    if isinstance(picture, PictureGrid):
        frames = [drawn(part, draw_scene) for part in picture.pictures]
        labelled = [_labelled(f, text) for f, text in zip(frames, picture.labels, strict=True)]
        rows = range(0, len(labelled), picture.columns)
        return Frame(np.vstack([np.hstack(labelled[r : r + picture.columns]) for r in rows]))
    return picture if isinstance(picture, Frame) else draw_scene(picture)


def _labelled(frame: Frame, text: str) -> Pixels:
    """The frame with its label, if it fits, and a line to its right and below."""
    image = Image.fromarray(frame.pixels)
    pen = ImageDraw.Draw(image)
    font = ImageFont.load_default_imagefont()  # whole pixels, and the same in every version
    width, height = (int(side) for side in font.getbbox(text)[2:])
    if text and width + 8 < image.width and height + 6 < image.height // 4:
        pen.rectangle((0, image.height - height - 6, width + 7, image.height), fill=PAPER)
        pen.text((4, image.height - height - 3), text, fill=INK, font=font)
    pen.line((image.width - 1, 0, image.width - 1, image.height), fill=PAPER)
    pen.line((0, image.height - 1, image.width, image.height - 1), fill=PAPER)
    return np.asarray(image)
