"""A design becomes a picture, a seamless loop, and the plain face."""

import sys
from pathlib import Path

from drapery import Banner, animate, draw
from drapery.pictures import draw_face


def main(folder: Path) -> None:
    banner = Banner.parse("blue gradient_up:light_blue rhombus:yellow flower:white border:black")
    draw(banner, view="hero", wind=6, size=(256, 320)).save(folder / "banner.png")
    animate(banner, view="hero", wind=6, seconds=2, size=(128, 160)).save(folder / "banner.gif")
    draw_face(banner).save(folder / "face.png")


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "."))
