"""Packs in memory: patterns and textures from arrays."""

from collections.abc import Mapping
from io import BytesIO

import numpy as np

from drapery.arrays import Mask, Texels
from drapery.banner.packs.checks import within
from drapery.banner.packs.png import MAX_PIXELS, MAX_SIDE
from drapery.banner.packs.texture_ids import full_id, split_id, texture_file
from drapery.banner.packs.textures import MAX_SHEET
from drapery.errors import PackError, counted

ImageArray = Texels | Mask
"""Texels [H, W, 4], sRGB with straight alpha, or a mask [H, W]: white with this alpha."""


class MemoryPack:
    """A resource pack from arrays, for `open_packs`, alone or among paths.

    patterns: banner sheets by pattern id: `creeper`, or `mymod:heart` for a new pattern, which a
        `Layer` can then name. Sheets are square, at most MAX_SHEET [px] a side.
    shields: shield sheets by pattern id.
    textures: any texture by its id: `minecraft:block/stone`, `minecraft:entity/banner/banner_base`,
        `minecraft:entity/banner/creeper_n` for a LabPBR map.
    contents: further files by their name in the pack: `pack.mcmeta`, an `.mcmeta` of an animation.
    label: the name of the pack in messages.

    Arrays are uint8 [H, W, 4] (sRGB with straight alpha), or uint8 or bool [H, W] (a mask: white
    with this alpha, bool meaning 0 or 255). They are copied.

    Raises PackError for an unknown id, dtype, shape or size.
    """

    def __init__(
        self,
        *,
        patterns: Mapping[str, ImageArray] | None = None,
        shields: Mapping[str, ImageArray] | None = None,
        textures: Mapping[str, ImageArray] | None = None,
        contents: Mapping[str, bytes] | None = None,
        label: str = "pack in memory",
    ) -> None:
        self._label = label
        self._contents: dict[str, bytes] = dict(contents or {})
        for kind, sheets in (("banner", patterns), ("shield", shields)):
            for name, image in (sheets or {}).items():
                namespace, path = split_id(full_id(name, f"{label}: pattern"))
                place = f"{label}: pattern {name!r}"
                texels = _checked(image, place)
                _check_square(texels, place)
                self._contents[texture_file(f"{namespace}:entity/{kind}/{path}")] = _png(texels)
        for name, image in (textures or {}).items():
            texels = _checked(image, f"{label}: texture {name!r}")
            self._contents[texture_file(full_id(name, f"{label}: texture"))] = _png(texels)

    def __repr__(self) -> str:
        return f"<MemoryPack {self._label!r} of {counted(len(self._contents), 'file')}>"

    @property
    def label(self) -> str:
        """The name of the pack in messages."""
        return self._label

    def read(self, name: str, limit: int) -> bytes | None:
        """The bytes of a file, or None if the pack has none of this name.

        name: the path in the pack.
        limit: the largest size that is read [bytes].

        Raises PackError for a file over the limit.
        """
        data = self._contents.get(name)
        return None if data is None else within(data, limit, f"{self._label}: {name}")

    def files(self, folder: str) -> tuple[str, ...]:
        """See `PackSource`."""
        return tuple(sorted(name for name in self._contents if name.startswith(f"{folder}/")))

    def folders(self, folder: str) -> tuple[str, ...]:
        """See `PackSource`."""
        inside = (name[len(folder) + 1 :] for name in self.files(folder))
        return tuple(sorted({rest.split("/", 1)[0] for rest in inside if "/" in rest}))


def _checked(image: ImageArray, place: str) -> Texels:
    """The image as texels, shape [H, W, 4]. Raises PackError naming the place."""
    array = np.asarray(image)
    is_mask = array.ndim == 2 and array.dtype in (np.uint8, np.bool_)
    if not is_mask and (array.ndim != 3 or array.shape[2] != 4 or array.dtype != np.uint8):
        raise PackError(
            f"{place} is an array of {array.dtype} {list(array.shape)};"
            " give uint8 [H, W, 4], or a mask [H, W] of uint8 or bool"
        )
    height, width = array.shape[:2]
    if not (0 < width <= MAX_SIDE and 0 < height <= MAX_SIDE and width * height <= MAX_PIXELS):
        raise PackError(
            f"{place} is {width} x {height} px; give 1 to {MAX_SIDE} px a side and at most"
            f" {MAX_PIXELS} px in all"
        )
    if not is_mask:
        return array.astype(np.uint8)
    texels = np.full((height, width, 4), 255, np.uint8)
    texels[..., 3] = np.where(array, 255, 0) if array.dtype == np.bool_ else array
    return texels


def _check_square(texels: Texels, place: str) -> None:
    height, width = texels.shape[:2]
    if height != width or height > MAX_SHEET:
        raise PackError(
            f"{place} is {width} x {height} px; a sheet is square, at most {MAX_SHEET} px a side"
        )


def _png(texels: Texels) -> bytes:
    """A PNG file, so that packs in memory are read as those on disk are."""
    from PIL import Image

    file = BytesIO()
    Image.fromarray(np.ascontiguousarray(texels)).save(file, "png", compress_level=1)
    return file.getvalue()
