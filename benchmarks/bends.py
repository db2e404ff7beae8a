"""The usual ways in which the cloth of a banner bends, as `drapery/match/bends.txt` holds them.

`python -m benchmarks.bends --count 61 -o FILE` simulates flags in winds of 0 to 4 m/s, looks at
them from random sides, and asks where the texels lie in the picture, next to where the four corners
alone would put them. The principal components of these shifts are written as polynomials. None of
the flags is one of `benchmarks.photos`.
"""

import argparse
import random
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from benchmarks.photos import flag_corners, front_vertices, pixels_of, random_camera
from benchmarks.quick import add_quick
from drapery import Banner, Settings
from drapery.match.perspective import BEND_ORDERS, PhotoView
from drapery.match.smooth import products
from drapery.packs import open_packs
from drapery.render import Scene
from drapery.scenes import still

FIRST = 100_000
"""The seed of the first flag."""
SIDES = 3
"""From how many sides each flag is seen."""
MODES = 20
"""How many components are written."""
HEAD = f"""# How the cloth of banners usually bends, by `python -m benchmarks.bends`.
# A row is a way of bending, with its usual size: the factors [texels] of products of Chebyshev
# polynomials of orders 0 to {BEND_ORDERS[0]} across (they change fastest) and 0 to
# {BEND_ORDERS[1]} down, first of the shift across, then of that down."""

Array = NDArray[np.float64]


def texel_middles() -> tuple[Array, Array]:
    """In the unit square, [800] each."""
    v, u = np.divmod(np.arange(800), 20)
    return (u + 0.5) / 20, (v + 0.5) / 40


def shifts_of(scene: Scene, u: Array, v: Array) -> Array:
    """How far places of the flag lie from where its corners put them [texels], [2, n]."""
    from scipy.interpolate import LinearNDInterpolator

    mesh = scene.models[1].mesh
    used = front_vertices(mesh)
    places = (mesh.uvs[used] * 64 - 1) / (20, 40)
    points = LinearNDInterpolator(places, mesh.positions[used])(u, v)
    view = PhotoView(np.zeros((1, 1, 3), np.uint8), flag_corners(scene))
    x, y = pixels_of(scene.camera, points).T
    across, down, scale = (row[0] * x + row[1] * y + row[2] for row in np.linalg.inv(view.to_photo))
    return np.stack([(across / scale - u) * 20, (down / scale - v) * 40])


def random_shifts(count: int) -> Array:
    """Those of the middles of texels of random flags, [count * SIDES, 2, 800]."""
    packs, places, found = open_packs(()), texel_middles(), []
    for seed in range(FIRST, FIRST + count):
        pick = random.Random(seed)
        settings = Settings(wind=pick.uniform(0, 4), time=pick.uniform(0.5, 3), seed=seed)
        scene = still(Banner("white"), packs, settings)
        for _ in range(SIDES):
            found.append(shifts_of(replace(scene, camera=random_camera(pick)), *places))
    return np.array(found)


def usual_bends(shifts: Array) -> Array:
    """The principal components of shifts [n, 2, 800] and of their mirror images, as polynomials.

    With their usual sizes, [MODES, 2 * terms].
    """
    mirrored = shifts.reshape(-1, 2, 40, 20)[..., ::-1] * np.array((-1, 1))[:, None, None]
    every = np.concatenate([shifts, mirrored.reshape(shifts.shape)])
    terms = products(*texel_middles(), *BEND_ORDERS)
    independent, triangle = np.linalg.qr(terms.T)
    factors = (every @ independent).reshape(len(every), -1)
    squares, modes = np.linalg.eigh(factors.T @ factors / len(every))
    usual = (modes * np.sqrt(np.maximum(squares, 0))).T[: -MODES - 1 : -1]
    return np.linalg.solve(triangle, usual.reshape(2 * MODES, -1).T).T.reshape(MODES, -1)


def main() -> None:
    """Write the file."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--count", type=int, default=61)
    parser.add_argument("-o", "--out", type=Path, help="the file to write")
    add_quick(parser)
    chosen = parser.parse_args()
    shifts = random_shifts(1 if chosen.quick else chosen.count)
    lines = [" ".join(f"{factor:.3f}" for factor in row) for row in usual_bends(shifts)]
    text = "\n".join([HEAD, *lines, ""])
    if chosen.out is None:
        print(text)
    else:
        chosen.out.write_text(text, "utf-8")


if __name__ == "__main__":
    main()
