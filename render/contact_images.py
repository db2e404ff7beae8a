"""Labelled pictures in a row as Pillow's images, strip by strip, without the import of numpy."""

from collections.abc import Iterable, Iterator, Sequence
from functools import cache

from PIL import Image, ImageDraw, ImageFont

GAP = 8
LINE_HEIGHT = 16
LEAST_LABEL = 100
"""Labels are broken into lines no narrower than this [pixels]."""
PAPER = (246, 246, 244)
INK = (40, 40, 44)
CHECKER = (224, 214)
CHECKER_CELL = 8
"""The side of a square of the checker [pixels]."""


def contact_strips(
    labels: Sequence[str], size: tuple[int, int], strips: Iterable[Sequence[Image.Image]]
) -> Iterator[Image.Image]:
    """A contact sheet of one row, in strips from its top to its bottom, mode RGB.

    labels: one for each picture. size: width and height of all pictures. strips: for each strip the
    part of each picture; together they have the height.
    """
    lines, above, cell = label_cells(labels, size[0])
    width = len(labels) * cell + GAP
    head = Image.new("RGB", (width, GAP + above), PAPER)
    for number, each in enumerate(lines):
        write_label(head, each, GAP + number * cell, GAP + above)
    yield head
    for parts in strips:
        strip = Image.new("RGB", (width, parts[0].height), PAPER)
        for number, part in enumerate(parts):
            strip.paste(part, (GAP + number * cell, 0))
        yield strip
    yield Image.new("RGB", (width, GAP), PAPER)


def label_cells(labels: Sequence[str], width: int) -> tuple[list[list[str]], int, int]:
    """The lines of each label, the height above all pictures, and the width of a cell [pixels].

    width: of the widest picture.
    """
    lines = [label_lines(label, max(width, LEAST_LABEL)) for label in labels]
    above = LINE_HEIGHT * max(map(len, lines)) + 4
    return lines, above, max(width, *map(label_width, lines)) + GAP


def write_label(sheet: Image.Image, lines: Sequence[str], x: int, bottom: int) -> None:
    """Write a label that ends above the row `bottom`."""
    write_lines(sheet, lines, x, bottom - 4 - LINE_HEIGHT * len(lines))


def write_lines(sheet: Image.Image, lines: Sequence[str], x: int, y: int) -> None:
    """Write lines from a corner on, mode RGB."""
    pen = ImageDraw.Draw(sheet)
    for number, line in enumerate(lines):
        pen.text((x, y + LINE_HEIGHT * number), line, fill=INK, font=_font())


def label_lines(label: str, width: int) -> list[str]:
    """A label broken after blanks and underscores into lines of at most `width` pixels."""
    lines = [""]
    for word in label.replace(" ", " \n").replace("_", "_\n").split("\n"):
        if lines[-1] and label_width([lines[-1] + word]) > width:
            lines.append("")
        lines[-1] += word
    return lines


def label_width(lines: Sequence[str]) -> int:
    return max(int(_font().getlength(line.rstrip())) + 1 for line in lines)


@cache
def _font() -> ImageFont.FreeTypeFont | ImageFont.ImageFont:
    return ImageFont.load_default(size=13)


def checkered(image: Image.Image, cell: int = CHECKER_CELL) -> Image.Image:
    """A picture of mode RGB or RGBA over a light checker, mode RGB.

    cell: the side of a square of the checker [pixels].
    """
    if image.mode == "RGB":
        return image
    alpha = image.getchannel("A")
    colours = image.convert("RGB")
    if alpha.getextrema()[0] == 255:
        return colours
    board = _checker(*image.size, cell).convert("RGB")
    board.paste(colours, mask=alpha)
    return board


def _checker(width: int, height: int, cell: int) -> Image.Image:
    """Squares of two greys, the darker one in the upper left corner, mode L."""
    light, dark = (bytes([grey]) * cell for grey in CHECKER)
    pair = (dark + light) * (width // (2 * cell) + 2)
    rows = (pair[:width], pair[cell : cell + width])
    return Image.frombytes(
        "L", (width, height), b"".join(rows[y // cell % 2] for y in range(height))
    )
