"""Contact sheets: labelled pictures in rows on a light background."""

from collections.abc import Sequence
from functools import cache

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from drapery.render.frame import Frame, Pixels

GAP = 8
LINE_HEIGHT = 16
LEAST_LABEL = 100
"""Labels are broken into lines no narrower than this [pixels]."""
PAPER = (246, 246, 244, 255)
INK = (40, 40, 44, 255)
CHECKER = (224, 214)


def contact_sheet(pictures: Sequence[tuple[str, Pixels]], columns: int | None = None) -> Frame:
    """Labelled pictures in rows on a light background.

    pictures: labels and pixels, of any sizes. columns: pictures in a row; None is one row.
    """
    columns = columns or len(pictures)
    rows = -(-len(pictures) // columns)
    width, height = _largest([picture for _, picture in pictures])
    labels = [_lines(label, max(width, LEAST_LABEL)) for label, _ in pictures]
    above = LINE_HEIGHT * max(map(len, labels)) + 4
    cell_w = max(width, *map(_width, labels)) + GAP
    cell_h = height + above + GAP
    sheet = Image.new("RGBA", (columns * cell_w + GAP, rows * cell_h + GAP), PAPER)
    for place, (lines, (_, picture)) in enumerate(zip(labels, pictures, strict=True)):
        row, column = divmod(place, columns)
        x, y = GAP + column * cell_w, GAP + row * cell_h
        _write(sheet, lines, x, y + above - 4 - LINE_HEIGHT * len(lines))
        sheet.paste(Image.fromarray(on_checker(picture)), (x, y + above))
    return Frame(np.asarray(sheet))


def contact_table(across: Sequence[str], down: Sequence[str], pictures: Sequence[Pixels]) -> Frame:
    """Pictures row by row on a light background, with a heading for each column and each row.

    across, down: the headings. pictures: len(across) * len(down) of them, row by row.
    """
    width, height = _largest(pictures)
    names, heads = (
        [_lines(name, 2 * LEAST_LABEL) for name in down],
        [_lines(h, width) for h in across],
    )
    left = max(map(_width, names)) + 2 * GAP
    top = LINE_HEIGHT * max(map(len, heads)) + 2 * GAP
    cell_w = max(width, *map(_width, heads)) + GAP
    cell_h = max(height, LINE_HEIGHT * max(map(len, names))) + GAP
    size = left + len(across) * cell_w, top + len(down) * cell_h
    sheet = Image.new("RGBA", size, PAPER)
    for column, lines in enumerate(heads):
        _write(sheet, lines, left + column * cell_w, top - LINE_HEIGHT * len(lines) - 4)
    for row, lines in enumerate(names):
        _write(sheet, lines, GAP, top + row * cell_h)
    for place, picture in enumerate(pictures):
        row, column = divmod(place, len(across))
        corner = left + column * cell_w, top + row * cell_h
        sheet.paste(Image.fromarray(on_checker(picture)), corner)
    return Frame(np.asarray(sheet))


def stack_frames(frames: Sequence[Frame]) -> Frame:
    """Pictures below one another on a light background, aligned at the left."""
    if len(frames) == 1:
        return frames[0]
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
    """The picture over a light checker, which shows transparency."""
    if pixels[..., 3].min() == 255:
        return pixels
    height, width = pixels.shape[:2]
    rows, columns = np.ogrid[:height, :width]
    dark, light = (np.uint16(grey) for grey in CHECKER)
    board = np.where((rows // cell + columns // cell) % 2, dark, light)[..., None]
    alpha = pixels[..., 3:].astype(np.uint16)
    mixed = np.full(pixels.shape, 255, np.uint8)
    # At most 255 * 255 + 127, which fits in 16 bits.
    mixed[..., :3] = (pixels[..., :3] * alpha + board * (255 - alpha) + np.uint16(127)) // 255
    return mixed


def _largest(pictures: Sequence[Pixels]) -> tuple[int, int]:
    return max(p.shape[1] for p in pictures), max(p.shape[0] for p in pictures)


@cache
def _font() -> ImageFont.FreeTypeFont | ImageFont.ImageFont:
    return ImageFont.load_default(size=13)


def _lines(label: str, width: int) -> list[str]:
    """A label broken after blanks and underscores into lines of at most `width` pixels."""
    lines = [""]
    for word in label.replace(" ", " \n").replace("_", "_\n").split("\n"):
        if lines[-1] and _width([lines[-1] + word]) > width:
            lines.append("")
        lines[-1] += word
    return lines


def _width(lines: Sequence[str]) -> int:
    return max(int(_font().getlength(line.rstrip())) + 1 for line in lines)


def _write(sheet: Image.Image, lines: Sequence[str], x: int, y: int) -> None:
    pen = ImageDraw.Draw(sheet)
    for number, line in enumerate(lines):
        pen.text((x, y + LINE_HEIGHT * number), line, fill=INK, font=_font())
