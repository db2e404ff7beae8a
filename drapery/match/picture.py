"""Any picture as the face that designs are searched for: read, cropped, fitted and weighted."""

from dataclasses import dataclass
from pathlib import Path
from typing import Literal, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray
from PIL import Image, ImageOps

from drapery.arrays import Floats, Pixels, Texels
from drapery.banner import DYES
from drapery.errors import OptionError, PackError
from drapery.match.art import HEIGHT, WIDTH
from drapery.match.colours import UNIT, distances, oklab
from drapery.packs import read_png
from drapery.picture_file import opened_picture
from drapery.picture_pixels import pixels_of
from drapery.user_files import read_user_file

Fit = Literal["cover", "contain", "stretch"]
Weighting = Literal["even", "centre", "edges", "rare"]

FITS: tuple[Fit, ...] = get_args(Fit)
"""How a picture is brought to the shape of a banner, 1 : 2.

`cover` cuts off what does not fit, `contain` shows the whole picture, and `stretch` changes its
shape.
"""
WEIGHTINGS: tuple[Weighting, ...] = get_args(Weighting)
"""Which texels count more when a design is compared with a picture.

`even` none, `centre` those near the middle, `edges` those at outlines, `rare` those of colours that
few texels have.
"""

MAX_BYTES = 64 << 20
_PNG = b"\x89PNG\r\n\x1a\n"
PICTURE_FORMATS = ("PNG", "JPEG", "WEBP")
"""The formats of pictures that banners are found for, by Pillow's names."""

PITCH = (24, 48)
"""From one banner of a mural to the next, across and down [texels]; 24 are a block."""

_EXTRA = 2.0
"""The weight in the centre by `centre`, and at the strongest edge by `edges`, is 1 + this."""
_ALIKE = UNIT // 10
"""Colours that are nearer to each other are alike."""


@dataclass(frozen=True, eq=False)
class PictureFace:
    """A picture at the size of a face.

    face: sRGB, uint8, shape [40, 20, 3].
    weights: how much each texel counts, shape [40, 20], 0 where nothing is shown.
    """

    face: Pixels
    weights: Floats


def read_pixels(path: str | Path) -> Texels:
    """The pixels of a PNG, JPEG or WebP file, upright, uint8 [H, W, 4].

    Raises OptionError for a file that cannot be read, is not such a picture, or is too large.
    """
    name = Path(path).name
    remedy, shorter = "give a picture", "shrink it"
    data = read_user_file(path, MAX_BYTES, name=name, remedy=remedy, shorter=shorter)
    return decode_pixels(data, name)


def decode_pixels(data: bytes, name: str = "the picture") -> Texels:
    """The pixels of the bytes of a picture, upright, uint8, shape [H, W, 4].

    data: those of a PNG, JPEG or WebP file.
    name: the picture's name in errors.

    Raises OptionError for other bytes, and for a picture that is too large.
    """
    if len(data) > MAX_BYTES:
        raise OptionError(f"{name} has over {MAX_BYTES >> 20} MB; shrink it")
    if data.startswith(_PNG):
        try:
            return read_png(data, name)
        except PackError as error:
            raise OptionError(str(error)) from None
    with opened_picture(data, name, PICTURE_FORMATS) as image:
        return pixels_of(ImageOps.exif_transpose(image))


def fit_picture(
    pixels: Texels,
    *,
    fit: Fit = "cover",
    crop: tuple[int, int, int, int] | None = None,
    background: tuple[int, int, int] | None = None,
    mask: Texels | None = None,
    weighting: Weighting = "even",
    name: str = "the picture",
) -> PictureFace:
    """A picture at the size of a face.

    pixels: the picture, shape [H, W, 4].
    fit: `cover` cuts off what does not fit, `contain` leaves empty stripes, `stretch` distorts.
    crop: left, top, right and bottom of the part to use [px].
    background: sRGB behind transparent pixels and in empty stripes; None gives them no weight.
    mask: a picture of the same size that is bright where pixels count, shape [H, W, 4].
    weighting: `even`, or more in the `centre` or at `edges`.
    name: the picture's name in errors.

    Raises OptionError for a wrong argument.
    """
    (part,) = _windows(pixels, [(0, 0)], (WIDTH, HEIGHT), fit, crop, name)
    counts = np.ones((HEIGHT, WIDTH))
    if mask is not None:
        if mask.shape[:2] != pixels.shape[:2]:
            raise OptionError(
                f"the mask is {mask.shape[1]} x {mask.shape[0]} px, and {name} is"
                f" {pixels.shape[1]} x {pixels.shape[0]} px; make them alike"
            )
        (bright,) = _windows(mask, [(0, 0)], (WIDTH, HEIGHT), fit, crop, "the mask")
        counts = bright[..., :3].max(axis=2) / 255 * (bright[..., 3] / 255)
    return _weighted(part, counts, background, weighting, name)


def fit_mural(
    pixels: Texels,
    across: int,
    down: int,
    *,
    fit: Fit = "cover",
    crop: tuple[int, int, int, int] | None = None,
    background: tuple[int, int, int] | None = None,
    name: str = "the picture",
) -> list[PictureFace]:
    """The faces of the banners on a wall that show one picture, row by row.

    Banners hang one block apart and two blocks below each other. What lies between their cloths is
    not shown.

    pixels: the picture, shape [H, W, 4].
    across: banners in a row.
    down: rows.
    fit: see `fit_picture`.
    crop: left, top, right and bottom of the part to use [px].
    background: sRGB behind transparent pixels and in empty stripes; None gives them no weight.
    name: the picture's name in errors.

    Raises OptionError for a wrong argument.
    """
    corners = [(x * PITCH[0], y * PITCH[1]) for y in range(down) for x in range(across)]
    size = (across - 1) * PITCH[0] + WIDTH, (down - 1) * PITCH[1] + HEIGHT
    parts = _windows(pixels, corners, size, fit, crop, name)
    even = np.ones((HEIGHT, WIDTH))
    black = background or (0, 0, 0)
    empty = not any(part[..., 3].any() for part in parts)
    if empty and background is None:
        raise OptionError(_transparent(name))
    # A banner of which nothing is seen is wholly background.
    return [
        _weighted(part, even, background if part[..., 3].any() else black, "even", name)
        for part in parts
    ]


def nearest_dye(rgb: ArrayLike) -> str:
    """The name of the dye that looks most like an sRGB colour [3]."""
    dyes = oklab(np.array([dye.rgb for dye in DYES.values()]))
    return list(DYES)[int(distances(dyes, oklab(rgb)).argmin())]


def _windows(
    pixels: Texels,
    corners: list[tuple[int, int]],
    size: tuple[int, int],
    fit: Fit,
    crop: tuple[int, int, int, int] | None,
    name: str,
) -> list[Texels]:
    """Faces at corners of a picture that is fitted to a size [texels], each [40, 20, 4]."""
    left, top, right, bottom = _checked_crop(pixels, crop, name)
    image = Image.fromarray(np.ascontiguousarray(pixels[top:bottom, left:right])).convert("RGBa")
    if fit == "contain":
        image = ImageOps.pad(image, _at_least(image.size, size), Image.Resampling.BOX)
    box = (0.0, 0.0, float(image.width), float(image.height))
    if fit == "cover":
        scale = min(image.width / size[0], image.height / size[1])
        x, y = (image.width - size[0] * scale) / 2, (image.height - size[1] * scale) / 2
        box = (x, y, x + size[0] * scale, y + size[1] * scale)
    whole = np.asarray(image.resize(size, Image.Resampling.BOX, box).convert("RGBA"))
    return [whole[y : y + HEIGHT, x : x + WIDTH] for x, y in corners]


def _at_least(given: tuple[int, int], size: tuple[int, int]) -> tuple[int, int]:
    """The smallest multiple of a size that holds a picture without shrinking it."""
    times = max(-(-given[0] // size[0]), -(-given[1] // size[1]))
    return size[0] * times, size[1] * times


def _checked_crop(
    pixels: Texels, crop: tuple[int, int, int, int] | None, name: str
) -> tuple[int, int, int, int]:
    height, width = pixels.shape[:2]
    left, top, right, bottom = crop or (0, 0, width, height)
    if not (0 <= left < right <= width and 0 <= top < bottom <= height):
        raise OptionError(
            f"crop {left},{top},{right},{bottom} is not within {name}, which is {width} x {height}"
            " px; give left, top, right and bottom"
        )
    return left, top, right, bottom


def _transparent(name: str) -> str:
    return f"{name} is transparent everywhere; give a background colour, or another picture"


def _weighted(
    part: Texels,
    counts: NDArray[np.float64],
    background: tuple[int, int, int] | None,
    weighting: Weighting,
    name: str,
) -> PictureFace:
    colour = part[..., :3].astype(np.int32)
    alpha = part[..., 3:].astype(np.int32)
    if background is None:
        counts = counts * (alpha[..., 0] / 255)
        if not counts.any():
            raise OptionError(_transparent(name))
    else:
        colour = (alpha * colour + (255 - alpha) * np.array(background) + 127) // 255
    face = colour.astype(np.uint8)
    return PictureFace(face, counts * _importance(face, weighting))


def _importance(face: NDArray[np.uint8], weighting: Weighting) -> NDArray[np.float64]:
    """How much texels count by their places or contrast, [40, 20]."""
    if weighting == "centre":
        y = np.linspace(-1, 1, HEIGHT)[:, None] ** 2
        x = np.linspace(-1, 1, WIDTH) ** 2
        return 1 + _EXTRA * np.clip(1 - (x + y) / 2, 0, 1)
    if weighting == "edges":
        lab = oklab(face).astype(np.float64)
        steps = np.zeros((HEIGHT, WIDTH))
        for axis in (0, 1):
            change = np.gradient(lab, axis=axis)
            steps += (change * change).sum(axis=2)
        strength = np.sqrt(steps)
        return 1 + _EXTRA * strength / max(float(strength.max()), 1e-9)
    if weighting == "rare":
        colours = oklab(face).reshape(-1, 3)
        alike = (distances(colours[:, None], colours) < _ALIKE).sum(axis=1)
        weights: NDArray[np.float64] = alike.max() / alike
        return weights.reshape(HEIGHT, WIDTH)
    return np.ones((HEIGHT, WIDTH))
