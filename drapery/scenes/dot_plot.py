"""A plot of dots in the plane, with axes and grid lines at whole numbers."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from drapery.mesh import Array
from drapery.render import Frame

FINER = 3
"""A plot is drawn this many times larger and then reduced, for smooth dots."""
DOT, RIM, INK, LINES, PAPER = (
    (0, 154, 250),
    (12, 40, 70),
    (60, 60, 64),
    (226, 226, 228),
    (255, 255, 255),
)


@dataclass(frozen=True)
class DotPlot:
    """The axes of a plot. size: of the picture [pixels]. x_range, y_range: their whole numbers."""

    size: tuple[int, int]
    x_range: tuple[int, int]
    y_range: tuple[int, int]

    def frame(self, dots: Array) -> Frame:
        """The plot of dots [N, 2 or 3]; those beyond the axes are not shown."""
        image = self._empty.copy()
        pen = ImageDraw.Draw(image)
        radius = max(1.0, self.size[0] / 160) * FINER
        for x, y in self._places(dots[:, :2]):
            pen.ellipse((x - radius, y - radius, x + radius, y + radius), DOT, RIM, width=FINER)
        (x0, x1), (y0, y1) = self.x_range, self.y_range
        ends = np.rint(self._places(np.array([(x0, y1), (x1, y0)]))).astype(int)
        (left, top), (right, low) = ends.tolist()
        whole = self._empty.copy()
        whole.paste(image.crop((left, top, right, low)), (left, top, right, low))
        return Frame(np.asarray(whole.reduce(FINER).convert("RGBA")))

    @cached_property
    def _empty(self) -> Image.Image:
        """Axes, their numbers and grid lines, FINER times larger."""
        image = Image.new("RGB", (self.size[0] * FINER, self.size[1] * FINER), PAPER)
        pen = ImageDraw.Draw(image)
        (left, right), (low, high) = self.x_range, self.y_range
        uprights = [[(x, low), (x, high)] for x in range(left, right + 1)]
        levels = [[(left, y), (right, y)] for y in range(low, high + 1)]
        for ends in (*uprights, *levels):
            pen.line([tuple(p) for p in self._places(np.array(ends))], LINES, FINER)
        corners = self._places(np.array([(left, high), (left, low), (right, low)]))
        pen.line([tuple(p) for p in corners], INK, FINER)
        small = image.reduce(FINER)
        self._write_ticks(ImageDraw.Draw(small))
        return small.resize(image.size, Image.Resampling.NEAREST)

    def _write_ticks(self, pen: ImageDraw.ImageDraw) -> None:
        """Write the numbers beside the axes."""
        font = ImageFont.load_default_imagefont()
        (left, right), (low, high) = self.x_range, self.y_range
        for x in range(left, right + 1):
            at = self._places(np.array([(x, low)]))[0] / FINER
            pen.text((at[0] - 3, at[1] + 4), str(x), fill=INK, font=font)
        for y in range(low, high + 1):
            at = self._places(np.array([(left, y)]))[0] / FINER
            pen.text((at[0] - 6 * len(str(y)) - 4, at[1] - 6), str(y), fill=INK, font=font)

    def _places(self, points: Array) -> Array:
        """Places of points [N, 2] on the enlarged plot [pixels], shape [N, 2]."""
        width, height = self.size[0] * FINER, self.size[1] * FINER
        margin = min(24 * FINER, width // 6, height // 6)
        (left, right), (low, high) = self.x_range, self.y_range
        x = margin + (points[:, 0] - left) / (right - left) * (width - 1.5 * margin)
        y = height - margin - (points[:, 1] - low) / (high - low) * (height - 1.5 * margin)
        return np.stack([x, y], axis=1)
