"""Contact sheets: labelled pictures in rows on paper."""

from collections.abc import Sequence

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from drapery.render.frame import Frame, Pixels

GAP = 8
LABEL_HEIGHT = 20
PAPER = (246, 246, 244, 255)
INK = (40, 40, 44, 255)
CHECKER = (224, 214)


def strip(pictures: Sequence[tuple[str, Pixels]], columns: int | None = None) -> Frame:
    """Labelled pictures in rows on paper."""
    columns = columns or len(pictures)
    rows = -(-len(pictures) // columns)
    cell_w = max(_label_width(label, picture) for label, picture in pictures) + GAP
    cell_h = max(picture.shape[0] for _, picture in pictures) + LABEL_HEIGHT + GAP
    sheet = Image.new("RGBA", (columns * cell_w + GAP, rows * cell_h + GAP), PAPER)
    pen = ImageDraw.Draw(sheet)
    for place, (label, picture) in enumerate(pictures):
        row, column = divmod(place, columns)
        x, y = GAP + column * cell_w, GAP + row * cell_h
        pen.text((x, y), label, fill=INK, font=_font())
        sheet.paste(Image.fromarray(on_checker(picture)), (x, y + LABEL_HEIGHT))
    return Frame(np.asarray(sheet))


def stack(frames: Sequence[Frame]) -> Frame:
    """Pictures under one another on paper, flush left."""
    width = max(frame.pixels.shape[1] for frame in frames)
    height = sum(frame.pixels.shape[0] for frame in frames)
    sheet = np.full((height, width, 4), PAPER, np.uint8)
    top = 0
    for frame in frames:
        rows, columns = frame.pixels.shape[:2]
        sheet[top : top + rows, :columns] = frame.pixels
        top += rows
    return Frame(sheet)


def on_checker(pixels: Pixels, cell: int = 8) -> Pixels:
    """The picture over a light checker, so that transparency shows."""
    height, width = pixels.shape[:2]
    rows, columns = np.ogrid[:height, :width]
    board = np.where((rows // cell + columns // cell) % 2, *CHECKER)[..., None]
    alpha = pixels[..., 3:].astype(np.uint16)
    mixed = (pixels[..., :3] * alpha + board * (255 - alpha) + 127) // 255
    opaque = np.full((height, width, 1), 255)
    return np.concatenate([mixed, opaque], axis=-1).astype(np.uint8)


def enlarge(pixels: Pixels, scale: int) -> Pixels:
    """Every pixel as a square of `scale` pixels."""
    return pixels.repeat(scale, axis=0).repeat(scale, axis=1)


def _font() -> ImageFont.FreeTypeFont | ImageFont.ImageFont:
    return ImageFont.load_default(size=13)


def _label_width(label: str, picture: Pixels) -> int:
    return max(picture.shape[1], int(_font().getlength(label)) + 1)
