"""A camera that goes once around a banner that has settled in the wind."""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np

from drapery import Animation, Banner, Settings
from drapery.packs import open_packs
from drapery.render import VIEWS, backend, turntable
from drapery.scenes import still

FRAMES = 24


def main(folder: Path) -> None:
    settings = Settings(size=(128, 160), wind=6, background="#b9cfe4")
    scene = still(Banner.parse("red cross:white border:yellow"), open_packs(()), settings)
    points = np.concatenate([model.mesh.positions.reshape(-1, 3) for model in scene.models])
    draw_scene = backend()
    cameras = turntable(VIEWS["hero"], points, 128 / 160, FRAMES)
    frames = tuple(draw_scene(replace(scene, camera=camera)) for camera in cameras)
    Animation(frames, 12).save(folder / "turntable.webp")


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "."))
