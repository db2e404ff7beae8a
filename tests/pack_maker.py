"""Small resource packs for tests, as folders and zips."""

import json
import zipfile
from collections.abc import Mapping
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from drapery.banner.packs import Packs

BANNER = "assets/minecraft/textures/entity/banner/"
SHIELD = "assets/minecraft/textures/entity/shield/"
OLD_BASE = "assets/minecraft/textures/entity/banner_base.png"
CREEPER = BANNER + "creeper.png"
META = "pack.mcmeta"
NEW_BASE = BANNER + "banner_base.png"


def png(texels: np.ndarray, **options: Any) -> bytes:
    """A PNG file of an array [H, W], [H, W, 2], [H, W, 3] or [H, W, 4]."""
    file = BytesIO()
    Image.fromarray(texels).save(file, "png", **options)
    return file.getvalue()


def plain(*rgba: int, side: int = 64) -> bytes:
    """A square PNG of one colour."""
    return png(np.full((side, side, 4), rgba, np.uint8))


def noise(seed: int, side: int = 64) -> np.ndarray:
    """Random texels [side, side, 4], each channel independent."""
    return np.random.default_rng(seed).integers(0, 256, (side, side, 4), np.uint8)


def mcmeta(pack_format: int = 46, **more: Any) -> bytes:
    """A `pack.mcmeta`; `pack` and other sections may be given."""
    root = {"pack": {"pack_format": pack_format, "description": "a test"}} | more
    return json.dumps(root).encode()


def strip(*reds: int) -> bytes:
    """A texture of frames 8 x 8 one under the other, told apart by their red."""
    frames = [np.full((8, 8, 4), (red, 0, 0, 255), np.uint8) for red in reds]
    return png(np.concatenate(frames))


def red(packs: Packs, pattern: str = "creeper", time: float = 0.0) -> int:
    """The first texel's red, by which tests number their files."""
    return int(packs.sheet(pattern, time=time)[0, 0, 0])


def folder_pack(path: Path, files: Mapping[str, bytes | str]) -> Path:
    """Write a pack's files into a folder."""
    for name, data in files.items():
        target = path / name
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(data.encode() if isinstance(data, str) else data)
    return path


def zip_pack(path: Path, files: Mapping[str, bytes | str], top: str = "") -> Path:
    """Write a pack's files into a zip, under a top folder if one is given."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files.items():
            archive.writestr(top + name, data)
    return path


def make_pack(folder: Path) -> Path:
    """A folder with a white creeper."""
    (folder / CREEPER).parent.mkdir(parents=True)
    (folder / META).write_bytes(mcmeta())
    (folder / CREEPER).write_bytes(plain(255, 255, 255, 255))
    return folder
