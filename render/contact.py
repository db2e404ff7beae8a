"""Contact sheets: labelled pictures in rows on a light background."""

from collections.abc import Sequence

import numpy as np
from PIL import Image

from drapery.arrays import Pixels
from drapery.render.contact_images import (
    CHECKER_CELL,
    GAP,
    LEAST_LABEL,
    LINE_HEIGHT,
    PAPER,
    checkered,
    label_cells,
    label_lines,
    label_width,
    write_label,
    write_lines,
)
from drapery.render.frame import Frame


def contact_sheet(pictures: Sequence[tuple[str, Pixels]], columns: int | None = None) -> Frame:
    """Labelled pictures in rows on a light background.

    pictures: labels and pixels, of any sizes.
    columns: pictures in a row; None is one row.
    """
    columns = columns or len(pictures)
    rows = -(-len(pictures) // columns)
    width, height = _largest([picture for _, picture in pictures])
    labels, above, cell_w = label_cells([label for label, _ in pictures], width)
    cell_h = height + above + GAP
    sheet = Image.new("RGB", (columns * cell_w + GAP, rows * cell_h + GAP), PAPER)
    for place, (lines, (_, picture)) in enumerate(zip(labels, pictures, strict=True)):
        row, column = divmod(place, columns)
        x, y = GAP + column * cell_w, GAP + row * cell_h + above
        write_label(sheet, lines, x, y)
        sheet.paste(checkered(Image.fromarray(picture)), (x, y))
    return _frame(sheet)


def contact_table(across: Sequence[str], down: Sequence[str], pictures: Sequence[Pixels]) -> Frame:
    """Pictures row by row on a light background, with a heading for each column and each row.

    across, down: the headings. pictures: len(across) * len(down) of them, row by row.
    """
    width, height = _largest(pictures)
    names, heads = (
        [label_lines(name, 2 * LEAST_LABEL) for name in down],
        [label_lines(h, width) for h in across],
    )
    left = max(map(label_width, names)) + 2 * GAP
    top = LINE_HEIGHT * max(map(len, heads)) + 2 * GAP
    cell_w = max(width, *map(label_width, heads)) + GAP
    cell_h = max(height, LINE_HEIGHT * max(map(len, names))) + GAP
    size = left + len(across) * cell_w, top + len(down) * cell_h
    sheet = Image.new("RGB", size, PAPER)
    for column, lines in enumerate(heads):
        write_lines(sheet, lines, left + column * cell_w, top - LINE_HEIGHT * len(lines) - 4)
    for row, lines in enumerate(names):
        write_lines(sheet, lines, GAP, top + row * cell_h)
    for place, picture in enumerate(pictures):
        row, column = divmod(place, len(across))
        corner = left + column * cell_w, top + row * cell_h
        sheet.paste(checkered(Image.fromarray(picture)), corner)
    return _frame(sheet)


def stack_frames(frames: Sequence[Frame]) -> Frame:
    """Pictures below one another on a light background, aligned at the left."""
    if len(frames) == 1:
        return frames[0]
    width = max(frame.pixels.shape[1] for frame in frames)
    height = sum(frame.pixels.shape[0] for frame in frames)
    sheet = np.full((height, width, 4), (*PAPER, 255), np.uint8)
    top = 0
    for frame in frames:
        rows, columns = frame.pixels.shape[:2]
        sheet[top : top + rows, :columns] = frame.pixels
        top += rows
    return Frame(sheet)


def on_checker(pixels: Pixels, cell: int = CHECKER_CELL) -> Pixels:
    """The picture over a light checker, which shows transparency."""
    if pixels[..., 3].min() == 255:
        return pixels
    return _frame(checkered(Image.fromarray(pixels), cell)).pixels


def _frame(image: Image.Image) -> Frame:
    return Frame(np.asarray(image.convert("RGBA")))


def _largest(pictures: Sequence[Pixels]) -> tuple[int, int]:
    return max(p.shape[1] for p in pictures), max(p.shape[0] for p in pictures)
