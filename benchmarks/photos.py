"""How often the design of a banner in a photo is found.

`python -m benchmarks.photos --count 200` draws random designs of one to six layers as cloth, in
perspective, in the light of the game or the studio and a wind of 0 to 4 m/s, saves them as JPEG
files, and looks for the designs: with the corners given, and with corners that are found.
A design is right if the mean difference of its plain face is below 2.5 of 255 levels.
"""

import argparse
import io
import math
import random
import time
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from drapery import Banner, DraperyError, Layer, Settings
from drapery.banner import DYE_NAMES, PATTERN_NAMES
from drapery.match import match_photo
from drapery.packs import open_packs
from drapery.pictures import draw_face, draw_scenes
from drapery.render import Camera
from drapery.render.camera import clip_matrix
from drapery.scenes import still

SIZE = 480
RIGHT = 2.5


@dataclass(frozen=True, eq=False)
class PhotoCase:
    """A photo [SIZE, SIZE, 3], its design, the flag's corners, and the wind [m/s]."""

    picture: NDArray[np.uint8]
    banner: Banner
    corners: tuple[tuple[float, float], ...]
    wind: float


def photo_case(seed: int) -> PhotoCase:
    """A photo, the same one for the same seed."""
    pick = random.Random(seed)
    patterns = [name for name in PATTERN_NAMES if name != "base"]
    layers = [
        Layer(pick.choice(patterns), pick.choice(DYE_NAMES)) for _ in range(pick.randint(1, 6))
    ]
    banner = Banner(pick.choice(DYE_NAMES), tuple(layers))
    background = "#" + "".join(f"{pick.randint(40, 230):02x}" for _ in range(3))
    settings = Settings(
        size=(SIZE, SIZE),
        wind=pick.uniform(0, 4),
        time=pick.uniform(0.5, 3),
        seed=seed,
        background=background,
        light=pick.choice(("game", "studio")),
        samples=4,
    )
    packs = open_packs(())
    scene = replace(still(banner, packs, settings), camera=_camera(pick))
    (frame,) = draw_scenes([scene], packs, settings)
    file = io.BytesIO()
    Image.fromarray(frame.pixels[..., :3]).save(file, "JPEG", quality=pick.randint(60, 92))
    mesh = scene.models[1].mesh
    points = [
        _place(mesh.uvs * 64, mesh.positions, mesh.normals, u, v)
        for u, v in ((1, 1), (21, 1), (21, 41), (1, 41))
    ]
    clip = np.concatenate([np.array(points), np.ones((4, 1))], axis=1)
    clip = np.einsum("ij,kj->ki", clip_matrix(scene.camera, (SIZE, SIZE)), clip)
    corners = [((x / w + 1) / 2 * SIZE, (1 - y / w) / 2 * SIZE) for x, y, _, w in clip.tolist()]
    picture = np.asarray(Image.open(file).convert("RGB"))
    return PhotoCase(picture, banner, tuple(corners), settings.wind)


def _camera(pick: random.Random) -> Camera:
    """Up to 35 degrees to the side, 15 below to 25 above, 2.6 to 3.6 m away."""
    yaw, pitch = math.radians(pick.uniform(-35, 35)), math.radians(pick.uniform(-15, 25))
    away, (x, y, z) = pick.uniform(2.6, 3.6), (0.5, 0.95, 0.55)
    position = (
        x + away * math.sin(yaw) * math.cos(pitch),
        y + away * math.sin(pitch),
        z + away * math.cos(yaw) * math.cos(pitch),
    )
    target = (x + pick.uniform(-0.15, 0.15), y + pick.uniform(-0.1, 0.1), z)
    return Camera(position, target, fov=pick.uniform(40, 50))


def _place(
    texels: NDArray[np.generic],
    positions: NDArray[np.generic],
    normals: NDArray[np.generic],
    u: float,
    v: float,
) -> NDArray[np.generic]:
    """Where a texel's corner lies on the front of the flag."""
    apart = np.abs(texels - (u, v)).sum(axis=1)
    near = np.flatnonzero(apart < apart.min() + 0.01)
    return np.asarray(positions[near[normals[near, 2].argmax()]])


def is_right(found: Banner, truth: Banner) -> bool:
    """Whether two designs look alike."""
    faces = [draw_face(one, scale=1).pixels.astype(np.int64) for one in (found, truth)]
    return float(np.abs(faces[0] - faces[1])[..., :3].mean()) < RIGHT


def main() -> None:
    """Print the shares of right designs."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--misses", action="store_true", help="name the designs that were missed")
    chosen = parser.parse_args()
    for by_hand in (True, False):
        first = three = calm = calm_right = 0
        start = time.process_time()
        for seed in range(chosen.count):
            case = photo_case(seed)
            try:
                found = match_photo(case.picture, case.corners if by_hand else None)
            except DraperyError:
                found = []
            right = [is_right(one.banner, case.banner) for one in found]
            first, three = first + any(right[:1]), three + any(right)
            calm, calm_right = calm + (case.wind < 2), calm_right + (case.wind < 2 and any(right))
            if chosen.misses and not any(right):
                print(seed, f"{case.wind:.1f} m/s", case.banner)
        spent = (time.process_time() - start) / max(chosen.count, 1)
        print(
            f"corners {'given' if by_hand else 'found'}: {three} of {chosen.count} within the best"
            f" three, {first} first; {calm_right} of {calm} below 2 m/s; {spent:.1f} s each"
        )


if __name__ == "__main__":
    main()
