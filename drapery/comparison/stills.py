"""The difference of two PNG files of 8 bits a channel, by the sums that Pillow makes.

The import of numpy takes longer than all else in the comparison of two small pictures, and pictures
as arrays take the memory of two more. The figures are those of `measure`.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from threading import Thread
from typing import TYPE_CHECKING
from warnings import catch_warnings

from drapery.comparison.difference import Difference, box_around
from drapery.comparison.files import opened, picture_bytes
from drapery.comparison.limits import Box
from drapery.comparison.painting import GAIN, LEAST, MOST, difference_image, shown_scale
from drapery.comparison.tolerance import EXACT, Tolerance

if TYPE_CHECKING:
    from PIL.Image import Image

_STRIP = 32
"""How many rows are compared at a time: they stay in the cache."""
_SIZE, _KIND = slice(16, 24), slice(24, 29)
"""Where in a PNG file the size of the picture and the kind of its pixels are."""
_KINDS = (b"\x08\x02\0\0\0", b"\x08\x06\0\0\0")
"""8 bits a channel of colour, without and with alpha, and not interlaced."""
_STRENGTH = [0, *(min(max(LEAST, GAIN * error), MOST) for error in range(1, 256))]
"""How strongly an error is shown."""
_CLEAR = [255, *[0] * 255]
"""A table that makes white what is fully transparent, and all else black."""


@dataclass(frozen=True, eq=False)
class StillPair:
    """Two pictures of one size and one mode, RGB or RGBA; one and the same for equal files.

    old: the expected picture.
    new: the other picture.
    """

    old: "Image"
    new: "Image"

    def measure(self, tolerance: Tolerance = EXACT) -> Difference:
        """The figures of `measure`. tolerance: of channels and pixels alone."""
        return _compared(self.old, self.new, tolerance)

    def sheet_strips(self, labels: tuple[str, str]) -> "Iterator[Image]":
        """The sheet of `side_by_side` in strips from its top to its bottom, mode RGB."""
        from drapery.render.contact_images import contact_strips

        width, height = self.old.size
        scale = shown_scale(width, height)
        size = width * scale, height * scale
        return contact_strips((*labels, "difference"), size, self._panel_strips(scale))

    def _panel_strips(self, scale: int) -> "Iterator[list[Image]]":
        """Strips of both pictures and of their difference, enlarged."""
        from PIL import Image

        from drapery.render.contact_images import checkered

        nearest = Image.Resampling.NEAREST
        for area in _strips(self.old.size):
            old, new = self.old.crop(area), self.new.crop(area)
            size = scale * old.width, scale * old.height
            # The squares of the checker keep their size.
            parts = [checkered(each.resize(size, nearest)) for each in (old, new)]
            shown = checkered(old)
            strength = _lightest(_change(old, new)[0]).point(_STRENGTH)
            parts.append(difference_image(shown, strength).resize(size, nearest))
            yield parts


def read_stills(expected: Path, actual: "Path | Image") -> StillPair | None:
    """Two pictures that can be compared as they are.

    None for what only `measure_pictures` compares: other files than PNG stills of colours with 8
    bits a channel, images of other modes, and two sizes.

    expected: the file of the expected picture.
    actual: the file of the other picture, or a Pillow image.

    Raises OptionError for a file that cannot be read or is broken.
    """
    data = picture_bytes(expected)
    pictures: tuple[Image, Image] | None
    if isinstance(actual, Path):
        both = data, picture_bytes(actual)
        if not all(map(_is_usual, both)) or both[0][_SIZE] != both[1][_SIZE]:
            return None
        pictures = _decoded(both, (str(expected), str(actual)))
    else:
        pictures = _beside(data, str(expected), actual)
    if pictures is None:
        return None
    old, new = pictures
    if old.mode != new.mode:
        old, new = old.convert("RGBA"), new.convert("RGBA")
    return StillPair(old, new)


def measure_files(
    expected: Path, actual: "Path | Image", tolerance: Tolerance = EXACT
) -> Difference | None:
    """Measure a picture against a file.

    None for what `read_stills` does not read, and for tolerances of more than channels and pixels.

    expected: the file of the expected picture.
    actual: the file of the picture to measure, or a Pillow image.
    tolerance: what counts as a difference.

    Raises OptionError for a file that cannot be read or is broken.
    """
    if not tolerance.limits().keys() <= {"tolerance", "pixels", "ratio"}:
        return None
    pair = read_stills(expected, actual)
    return None if pair is None else pair.measure(tolerance)


def _is_usual(data: bytes) -> bool:
    """Whether a file is a PNG of colours with 8 bits a channel."""
    return data[:8] == b"\x89PNG\r\n\x1a\n" and data[_KIND] in _KINDS


def _beside(data: bytes, name: str, image: "Image") -> "tuple[Image, Image] | None":
    """The picture in a file and an image; None if one of them needs the usual reader."""
    size = int.from_bytes(data[16:20], "big"), int.from_bytes(data[20:24], "big")
    if not _is_usual(data) or image.mode not in ("RGB", "RGBA") or image.size != size:
        return None
    if getattr(image, "n_frames", 1) > 1 or "transparency" in image.info:
        return None

    def loaded() -> "Image":
        image.load()
        return image

    _, old = _at_once(loaded, lambda: _still(data, name))
    return None if old is None else (old, image)


def _decoded(data: tuple[bytes, bytes], names: tuple[str, str]) -> "tuple[Image, Image] | None":
    """Both pictures; those of equal files are one. None if one needs the usual reader."""
    if data[0] == data[1]:
        one = _still(data[0], names[0])
        return None if one is None else (one, one)
    first, second = _at_once(lambda: _still(data[0], names[0]), lambda: _still(data[1], names[1]))
    return None if first is None or second is None else (first, second)


def _at_once(
    decode: "Callable[[], Image | None]", beside: "Callable[[], Image | None]"
) -> "tuple[Image | None, Image | None]":
    """What both functions return; the second one runs in another thread."""
    found: list[Image | None] = []
    faults: list[BaseException] = []

    def work() -> None:
        try:
            found.append(beside())
        except BaseException as fault:
            faults.append(fault)

    # Each thread changes the filters of warnings and sets them back, in any order.
    with catch_warnings():
        other = Thread(target=work, daemon=True)
        other.start()
        try:
            first = decode()
        finally:
            other.join()
    if faults:
        raise faults[0]
    return first, found[0]


def _still(data: bytes, name: str) -> "Image | None":
    """The picture; None for a loop, and for one whose alpha is in a chunk of its own."""
    with opened(data, name, ("PNG",)) as image:
        if getattr(image, "n_frames", 1) > 1 or "transparency" in image.info:
            return None
        image.load()
        return image


def _compared(old: "Image", new: "Image", tolerance: Tolerance) -> Difference:
    """The figures of `measure`, strip by strip."""
    width, height = old.size
    count = width * height
    beyond = hidden = total = 0
    values, boxes, far_boxes = [0] * 256, [], []
    for strip in _strips(old.size) if old is not new else ():
        area = _changed_area(old, new, strip)
        if area is None:
            continue
        change, unseen = _change(old.crop(area), new.crop(area))
        hidden += unseen
        worst = _lightest(change)
        values = [a + b for a, b in zip(values, worst.histogram(), strict=True)]
        total += sum(n * (value % 256) for value, n in enumerate(change.histogram()))
        far = worst.point([255 * (value > tolerance.channel) for value in range(256)])
        boxes.append(_moved(worst.getbbox(), area))
        far_boxes.append(_moved(far.getbbox(), area))
    beyond = sum(values[tolerance.channel + 1 :])
    return Difference(
        pixels=count,
        changed=sum(values[1:]),
        max_error=max(value for value in range(256) if value == 0 or values[value]),
        mean_error=total / (4 * count),
        beyond=beyond,
        allowed=tolerance.allowed(count),
        hidden=hidden,
        box=box_around(filter(None, far_boxes if beyond else boxes)),
    )


def _strips(size: tuple[int, int]) -> Iterator[Box]:
    """The corners of the strips of a picture."""
    width, height = size
    for top in range(0, height, _STRIP):
        yield 0, top, width, min(top + _STRIP, height)


def _changed_area(old: "Image", new: "Image", area: Box) -> Box | None:
    """The corners of what differs in an area of both pictures, which is all that is measured."""
    from PIL import ImageChops

    change = ImageChops.difference(old.crop(area), new.crop(area))
    inner: Box | None = change.getbbox(alpha_only=False)
    if inner is None:
        return None
    left, top = area[:2]
    return inner[0] + left, inner[1] + top, inner[2] + left, inner[3] + top


def _change(old: "Image", new: "Image") -> "tuple[Image, int]":
    """The absolute errors, and in how many pixels none can be seen though the bits differ."""
    from PIL import ImageChops

    change = ImageChops.difference(old, new)
    if change.mode == "RGB":
        return change, 0
    clear = [picture.getchannel("A").point(_CLEAR) for picture in (old, new)]
    if not any(mask.getbbox() for mask in clear):
        return change, 0
    every = sum(_lightest(change).histogram()[1:])
    for picture, mask in zip((old, new), clear, strict=True):
        picture.paste((0, 0, 0, 0), mask=mask)
    change = ImageChops.difference(old, new)
    return change, every - sum(_lightest(change).histogram()[1:])


def _lightest(picture: "Image") -> "Image":
    """The largest channel of each pixel, mode L."""
    from PIL import ImageChops

    first, *rest = picture.split()
    for band in rest:
        first = ImageChops.lighter(first, band)
    return first


def _moved(corners: Box | None, area: Box) -> Box | None:
    """Corners in an area of a picture as left, top, width and height in the whole one."""
    if corners is None:
        return None
    left, upper, right, lower = corners
    return area[0] + left, area[1] + upper, right - left, lower - upper
