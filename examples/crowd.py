"""Thousands of simulated banners in one draw list: the cube of 4913."""

import sys
from pathlib import Path

from drapery.scenes.catalogue import Shot, find
from drapery.scenes.drawing import scene_frames


def main(folder: Path, side: int = 17) -> None:
    cube = find("stress")
    parameters = cube.parameters({"side": str(side)})
    for frame in scene_frames(cube, parameters, Shot((640, 640), 1)):
        frame.save(folder / "crowd.png")


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "."))
