"""Pictures that the service has answered."""

from io import BytesIO
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image, UnidentifiedImageError


def opened(answer: Any, kind: str = "png") -> Image.Image:
    """The picture of an answer. Fails with the start of what came if that is no such picture.

    answer: of httpx. kind: `png` or `gif`.
    """
    got = answer.status_code, answer.headers.get("content-type"), answer.headers.get("etag")
    assert got[:2] == (200, f"image/{kind}"), (got, answer.text[:300])
    data = answer.content
    try:
        return Image.open(BytesIO(data))
    except UnidentifiedImageError:
        raise AssertionError(f"{got}: {len(data)} bytes, no {kind}: {data[:64]!r}") from None


def pixels_of(answer: Any) -> NDArray[np.uint8]:
    """The pixels of a PNG file, shape [H, W, 4]."""
    with opened(answer) as image:
        return np.asarray(image.convert("RGBA"))
