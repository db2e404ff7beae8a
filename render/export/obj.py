"""Wavefront OBJ with its material file (MTL), written here, so that no library changes the bytes.

http://paulbourke.net/dataformats/obj/ and http://paulbourke.net/dataformats/mtl/
"""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from drapery.render.encode.png import png_bytes
from drapery.render.export.parts import MeshParts
from drapery.render.scene import Scene


def obj_files(parts: MeshParts, scene: Scene, fps: float, name: str) -> dict[str, bytes]:
    """The files of the first frame: NAME.obj, NAME.mtl and NAME_texture.png."""
    texture = f"{name}_texture"
    return {
        f"{texture}.png": png_bytes(parts.atlas),
        f"{name}.mtl": _material(texture).encode(),
        f"{name}.obj": "\n".join(_lines(parts, name, texture)).encode(),
    }


def _material(texture: str) -> str:
    """The texture without highlights."""
    colours = (("Ka", 1.0), ("Kd", 1.0), ("Ks", 0.0))
    rows = [f"{key} {value:.8f} {value:.8f} {value:.8f}" for key, value in colours]
    lines = ["# drapery", "", f"newmtl {texture}", *rows, "Ns 1.00000000"]
    return "\n".join([*lines, f"map_Kd {texture}.png", ""])


def _lines(parts: MeshParts, name: str, texture: str) -> Iterator[str]:
    yield from ("# drapery", f"mtllib {name}.mtl", "")
    first = 1  # corners count from 1 through all parts
    for part in parts.parts:
        yield from (f"o {part.name}", f"usemtl {texture}")
        yield from _rows("v", part.positions[0])
        yield from _rows("vn", part.normals[0])
        yield from _rows("vt", np.stack([part.uvs[:, 0], 1 - part.uvs[:, 1]], axis=1))  # v upwards
        for corners in (part.triangles + first).tolist():
            yield "f " + " ".join(f"{corner}/{corner}/{corner}" for corner in corners)
        yield ""
        first += len(part.uvs)
    yield ""


def _rows(keyword: str, values: NDArray[np.floating]) -> Iterator[str]:
    for row in values.tolist():
        yield f"{keyword} " + " ".join(f"{value:.8f}" for value in row)
