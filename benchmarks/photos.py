"""How often the design of a banner in a photo is found.

`python -m benchmarks.photos --count 200` draws random designs of one to six layers as cloth, in
perspective, in the light of the game or the studio and a wind of 0 to 4 m/s, saves them as JPEG
files, and looks for the designs: with the corners given, and with corners that are found. Each
result is printed as it comes, with the design if it was not the first; `--first` and `--count`
choose some of the photos.
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

from benchmarks.quick import add_quick
from drapery import Banner, DraperyError, Layer, Settings
from drapery.banner import DYE_NAMES, PATTERN_NAMES
from drapery.match import match_photo
from drapery.mesh import Mesh
from drapery.packs import open_packs
from drapery.pictures import draw_face, draw_scenes
from drapery.render import Camera, Scene
from drapery.render.camera import clip_matrix
from drapery.scenes import still

SIZE = 480
RIGHT = 2.5
CALM = 2.0
"""Winds below this are also counted by themselves [m/s]."""
WAYS = ("given", "found")
"""How the corners of the flag are known."""


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
    scene = replace(still(banner, packs, settings), camera=random_camera(pick))
    (frame,) = draw_scenes([scene], packs, settings)
    file = io.BytesIO()
    Image.fromarray(frame.pixels[..., :3]).save(file, "JPEG", quality=pick.randint(60, 92))
    picture = np.asarray(Image.open(file).convert("RGB"))
    return PhotoCase(picture, banner, flag_corners(scene), settings.wind)


def flag_corners(scene: Scene) -> tuple[tuple[float, float], ...]:
    """The corners of a scene's flag in its picture [px]."""
    mesh = scene.models[1].mesh
    texels, front = mesh.uvs * 64, front_vertices(mesh)
    nearest = [
        front[np.abs(texels[front] - corner).sum(axis=1).argmin()]
        for corner in ((1, 1), (21, 1), (21, 41), (1, 41))
    ]
    return tuple((x, y) for x, y in pixels_of(scene.camera, mesh.positions[nearest]).tolist())


def front_vertices(mesh: Mesh) -> NDArray[np.intp]:
    """The vertices of the front of a flag; some of its lower side have the same texels."""
    middles = (mesh.uvs * 64)[mesh.triangles].mean(axis=1)
    inside = ((middles > 1) & (middles < (21, 41))).all(axis=1)
    return np.unique(mesh.triangles[inside]).astype(np.intp)


def pixels_of(camera: Camera, points: NDArray[np.generic]) -> NDArray[np.float64]:
    """Where points [n, 3] are seen in a picture, to the right and down [px], [n, 2]."""
    clip = np.concatenate([points, np.ones((len(points), 1))], axis=1)
    x, y, _, w = np.einsum("ij,kj->ik", clip_matrix(camera, (SIZE, SIZE)), clip)
    return np.stack([(x / w + 1) / 2 * SIZE, (1 - y / w) / 2 * SIZE], axis=1)


def random_camera(pick: random.Random) -> Camera:
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


def is_right(found: Banner, truth: Banner) -> bool:
    """Whether two designs look alike."""
    faces = [draw_face(one, scale=1).pixels.astype(np.int64) for one in (found, truth)]
    return float(np.abs(faces[0] - faces[1])[..., :3].mean()) < RIGHT


@dataclass(frozen=True)
class PhotoResult:
    """At which place the right design was found, from 0, or None; and the processor time [s]."""

    wind: float
    place: int | None
    seconds: float


def search_photo(case: PhotoCase, *, by_hand: bool) -> PhotoResult:
    """Look for the design of a photo, with the corners given `by_hand` or found."""
    start = time.process_time()
    try:
        found = match_photo(case.picture, case.corners if by_hand else None)
    except DraperyError:
        found = []
    seconds = time.process_time() - start
    right = [is_right(one.banner, case.banner) for one in found]
    return PhotoResult(case.wind, right.index(True) if any(right) else None, seconds)


def summary(results: list[PhotoResult]) -> str:
    """The shares of right designs."""
    three = sum(one.place is not None for one in results)
    first = sum(one.place == 0 for one in results)
    calm = [one for one in results if one.wind < CALM]
    return (
        f"{three} of {len(results)} within the best three ({three / len(results):.1%}), {first}"
        f" first; {sum(one.place is not None for one in calm)} of {len(calm)} below {CALM:g} m/s;"
        f" {sum(one.seconds for one in results) / len(results):.1f} s each"
    )


def main() -> None:
    """Print each result as it comes, then the shares of right designs."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--first", type=int, default=0, help="seed of the first photo")
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--corners", choices=("given", "found"), nargs="+", default=WAYS)
    add_quick(parser)
    chosen = parser.parse_args()
    if chosen.quick:
        chosen.count, chosen.corners = 1, ["given"]
    results: dict[str, list[PhotoResult]] = {way: [] for way in chosen.corners}
    for seed in range(chosen.first, chosen.first + chosen.count):
        case = photo_case(seed)
        for way, done in results.items():
            one = search_photo(case, by_hand=way == "given")
            done.append(one)
            place = "missed" if one.place is None else f"place {one.place + 1}"
            if one.place != 0:
                place += f", {case.banner}"
            print(f"{seed} {way}: {one.wind:.1f} m/s, {one.seconds:.1f} s, {place}", flush=True)
    for way, done in results.items():
        print(f"corners {way}: {summary(done)}")


if __name__ == "__main__":
    main()
