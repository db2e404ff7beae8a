"""The file of the flat faces that an editor lays over each other, in the textures of packs."""

import gzip
from collections.abc import Sequence
from typing import Literal

import numpy as np

from drapery.banner import FLAG_REGIONS, SHIELD_REGIONS
from drapery.packs import Packs
from drapery.web.messages import pack

UNITS = 64
"""The side of a sheet whose face has one texel a unit."""
MAX_SCALE = 4
"""The most texels of a unit, so that the file of a large pack stays small."""


def face_bytes(kind: Literal["banner", "shield"], packs: Packs, patterns: Sequence[str]) -> bytes:
    """The front of each pattern's sheet, behind the fronts of the bare cloth or plate and the base.

    A message, compressed with gzip: the header has `sheets`, the patterns' names, "" for what is
    bare; `front`, the width and height of a face [texels]; and `scale`, the texels of a unit. The
    array `masks` has the texels of all faces, RGBA. Raises PackError.
    """
    regions = FLAG_REGIONS if kind == "banner" else SHIELD_REGIONS
    names = ["", *dict.fromkeys(("base", *patterns))]
    bare = packs.base_sheet() if kind == "banner" else packs.base("shield_base")
    sheets = [bare, *(packs.sheet(name, kind) for name in names[1:])]
    scale = min(MAX_SCALE, max(1, max(len(sheet) for sheet in sheets) // UNITS))
    faces = [regions["front"].sample(sheet, scale) for sheet in sheets]
    height, width = faces[0].shape[:2]
    header = {"sheets": names, "front": {"width": width, "height": height}, "scale": scale}
    return gzip.compress(pack(header, {"masks": np.concatenate(faces).reshape(-1)}), mtime=0)
