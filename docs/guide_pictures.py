"""Draw the pictures that open guides and have no command of their own.

`python docs/guide_pictures.py [NAME ...]` writes them to `docs/pictures`, all by default.
"""

import sys
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from drapery import Banner, draw, draw_face
from drapery.banner import alt_text
from drapery.garments import PlayerSettings, find_garment, player_of
from drapery.match import find_corners, match_photo

PICTURES = Path(__file__).resolve().parent / "pictures"
SKY = "#9cc4ec"
LAND = ((64, 112, 200), (84, 146, 226), (222, 208, 152), (122, 178, 84), (86, 142, 66))
"""Colours of a map from deep water to a wood."""
PLACES = {
    (116, 50): "red border:black",
    (300, 140): "white creeper:lime",
    (470, 50): "blue straight_cross:white border:yellow",
    (170, 222): "lime rhombus:white flower:purple",
}
"""Where banners of a town stand on the map [pixels]."""


def photos() -> Image.Image:
    """A banner before the sky, the corners that are found, and the best designs of two layers."""
    banner = Banner.parse("red straight_cross:white border:yellow")
    where = {"placement": "wall", "view": "front"}
    photo = draw(banner, **where, wind=4, size=(192, 320), background=SKY)
    corners = find_corners(photo.pixels[..., :3])
    picture = Image.new("RGB", (640, 320), "white")
    picture.paste(Image.fromarray(photo.pixels), (0, 0))
    pen = ImageDraw.Draw(picture)
    for x, y in corners:
        pen.ellipse((x - 5, y - 5, x + 5, y + 5), outline="black", fill="white", width=2)
    for number, found in enumerate(match_photo(photo.pixels[..., :3], corners, layers=2)):
        face = Image.fromarray(draw_face(found.banner, scale=6).pixels)
        picture.paste(face, (224 + 138 * number, 40))
    return picture


def map_markers() -> Image.Image:
    """A map with a marker for each banner of a town, each with its title."""
    rows, columns = np.mgrid[0:280, 0:640] / 40.0
    height = np.sin(columns * 0.9 + 1.1 * np.sin(rows * 0.7)) + np.sin(rows * 0.8 - columns * 0.35)
    steps = np.digitize(np.round(height * 8) / 8, (-1.2, -0.7, -0.5, 0.9))
    picture = Image.fromarray(np.array(LAND, np.uint8)[steps])
    pen, font = ImageDraw.Draw(picture), ImageFont.load_default(13)
    for (x, y), text in PLACES.items():
        banner = Banner.parse(text)
        icon = draw(banner, placement="item", size=(48, 48), samples=1)
        picture.paste(Image.fromarray(icon.pixels), (x - 24, y - 40), Image.fromarray(icon.pixels))
        title = alt_text(banner, plain=True)
        left = x - pen.textlength(title, font) / 2
        box = pen.textbbox((left, y + 10), title, font)
        pen.rectangle((box[0] - 4, box[1] - 3, box[2] + 4, box[3] + 3), fill="white")
        pen.text((left, y + 10), title, "black", font)
    return picture


def models() -> Image.Image:
    """Three models at four moments: a banner, a cape and a player with a skirt and a scarf."""
    shown = (
        Banner.parse("white creeper:lime border:black"),
        find_garment("cape"),
        player_of(PlayerSettings(skin="dancer", motion="walk", wear=("skirt", "scarf"))),
    )
    picture = Image.new("RGB", (4 * 144, 3 * 176))
    for row, each in enumerate(shown):
        for column in range(4):
            frame = draw(each, view="iso", size=(144, 176), background=SKY, time=2 + 0.25 * column)
            picture.paste(Image.fromarray(frame.pixels), (144 * column, 176 * row))
    return picture


DRAWN = {"photos": photos, "server-map": map_markers, "models": models}

if __name__ == "__main__":
    for name in sys.argv[1:] or DRAWN:
        DRAWN[name]().save(PICTURES / f"{name}.webp", quality=88, method=6)
