"""A check of styles for their authors."""

from collections import Counter

import numpy as np
from numpy.typing import NDArray

from drapery import animate, draw
from drapery.banner import parse_banner
from drapery.errors import OptionError, counted
from drapery.mesh import Mesh
from drapery.packs import open_packs
from drapery.scenes import loop
from drapery.settings import Settings
from drapery.styles import Style

DESIGN = "white creeper:lime border:black"
SIZE = (48, 64)
FRAMES, FPS = 12, 10.0
SEAM = 3.0
"""The step over the seam of a loop may be this multiple of the largest other step."""
WELD = 1e-6
"""Vertices that are nearer than this are one [m]."""


def check_style(style: Style) -> None:
    """Check a style on a banner that waves. These are faults:

    - two drawings of the same banner differ;
    - the size of the picture is not the chosen one;
    - the last frame of a loop leads to the first by a larger step than between other frames;
    - a mesh has a hole: an edge with an odd number of triangles; or it has numbers that are not
      finite, or normals that are not unit vectors.

    Raises OptionError with the first fault found.
    """
    banner = parse_banner(DESIGN)
    settings = Settings(size=SIZE, grid=(5, 9), style=(style,))
    one, other = (draw(banner, settings).pixels for _ in range(2))
    if not np.array_equal(one, other):
        raise OptionError(f"style {style.name}: two drawings differ; use a seed, and no clock")
    if one.shape != (SIZE[1], SIZE[0], 4):
        raise OptionError(
            f"style {style.name}: a picture of {SIZE[0]}x{SIZE[1]} became one of"
            f" {one.shape[1]}x{one.shape[0]}; keep the size of the canvas"
        )
    frames = animate(banner, settings, seconds=FRAMES / FPS, fps=FPS).frames
    _check_seam(style.name, [frame.pixels.astype(float) for frame in frames])
    for scene in loop(banner, open_packs(()), settings, 2, FPS):
        _check_mesh(style.name, scene.models[-1].mesh)


def _check_seam(name: str, frames: list[NDArray[np.float64]]) -> None:
    steps = [
        float(np.abs(after - before).mean())
        for before, after in zip(frames, [*frames[1:], frames[0]], strict=True)
    ]
    if steps[-1] > SEAM * max(steps[:-1]):
        raise OptionError(
            f"style {name}: a loop jumps at its end, by {steps[-1]:.3g} where other frames differ"
            f" by at most {max(steps[:-1]):.3g}; let motion steps end where they begin"
        )


def _check_mesh(name: str, mesh: Mesh) -> None:
    points, normals = mesh.positions.reshape(-1, 3), mesh.normals.reshape(-1, 3)
    if not (np.isfinite(points).all() and np.isfinite(normals).all()):
        raise OptionError(f"style {name}: its mesh has numbers that are not finite; correct a step")
    lengths = np.sqrt((normals * normals).sum(axis=-1))
    if np.abs(lengths - 1).max() > 1e-3:
        raise OptionError(f"style {name}: its normals are not of length 1; scale them")
    _, welded = np.unique(np.rint(points / WELD), axis=0, return_inverse=True)
    corners = welded.reshape(-1)[mesh.triangles]
    edges = np.sort(corners[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    counts = Counter(map(tuple, edges.tolist()))
    if odd := [edge for edge, count in counts.items() if edge[0] != edge[1] and count % 2]:
        raise OptionError(
            f"style {name}: its mesh has a hole: {counted(len(odd), 'edge')} with an odd"
            " number of triangles; return a Piece, whose thickness closes it, or close the mesh"
        )
