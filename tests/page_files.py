"""The files that pages tell a reader to have: pictures, packs, skins and a pose of his own."""

import json
import shutil
from pathlib import Path

import numpy as np
from pack_maker import mcmeta, png, zip_pack
from PIL import Image
from skin_maker import marked

from drapery import Banner, draw_face
from drapery.styles import find_style

PACKS = ("faithful.zip", "pack.zip")
CORNERS = ((52, 21), (118, 30), (112, 171), (47, 160))
"""Of the flag in the photo, as the page on photos gives them."""


def write_files(folder: Path) -> None:
    """Write all of them into a folder, beside the pack `my-pack` of the tutorial."""
    shutil.make_archive(str(folder / "my-pack"), "zip", folder / "my-pack")
    (folder / "my.toml").write_text(find_style("ink").describe(), "utf-8")
    face = draw_face(Banner.parse("white cross:red"), scale=2)
    face.save(folder / "flag.png")
    flag = Image.fromarray(face.pixels[..., :3])
    for name in ("flag.jpg", "painting.webp"):
        flag.save(folder / name, quality=95)
    photo(flag).save(folder / "screenshot.png")
    for name in ("skin", "a", "b"):
        Image.fromarray(marked()).save(folder / f"{name}.png")
    for name in ("cape", "my-cape"):
        Image.fromarray(marked(32)).save(folder / f"{name}.png")
    for name in PACKS:
        zip_pack(folder / name, pack())
    profile = "{texture:'acme:knight',cape:'acme:red',model:'slim'}"
    (folder / "mannequin.snbt").write_text(f"{{profile:{profile}}}", "utf-8")
    (folder / "pose.json").write_text(json.dumps({"right_arm": [-170, 0, -10]}), "utf-8")


def photo(flag: Image.Image) -> Image.Image:
    """A flag in a photo, upright between its corners in front of the sky."""
    width, height = flag.size
    ends = ((0, 0), (width, 0), (width, height), (0, height))
    rows, values = [], []
    for (x, y), (u, v) in zip(CORNERS, ends, strict=True):
        rows += [[x, y, 1, 0, 0, 0, -u * x, -u * y], [0, 0, 0, x, y, 1, -v * x, -v * y]]
        values += [u, v]
    found = np.linalg.solve(np.array(rows, float), np.array(values, float))
    sky = Image.new("RGB", (170, 190), "#9cc4ec")
    shape = Image.new("L", flag.size, 255)
    place = (sky.size, Image.Transform.PERSPECTIVE, tuple(found), Image.Resampling.BICUBIC)
    sky.paste(flag.transform(*place), mask=shape.transform(*place))
    return sky


def pack() -> dict[str, bytes]:
    """A pack with the armour, the trim and the skin that the page on players names."""
    texels = np.full((32, 64, 4), (120, 200, 210, 255), np.uint8)
    ramp = np.array([[(200 - 20 * n, 160 - 16 * n, 40, 255) for n in range(8)]], np.uint8)
    pictures = {
        "entity/equipment/humanoid/diamond": texels,
        "entity/equipment/humanoid_leggings/diamond": texels,
        "trims/entity/humanoid/coast": texels,
        "trims/entity/humanoid_leggings/coast": texels,
        "trims/color_palettes/trim_palette": ramp[:, ::-1],
        "trims/color_palettes/gold": ramp,
    }
    files = {f"minecraft/textures/{name}.png": png(each) for name, each in pictures.items()}
    files |= {f"acme/textures/{n}.png": png(marked()) for n in ("knight",)}
    files |= {"acme/textures/red.png": png(marked(32))}
    return {"pack.mcmeta": mcmeta()} | {f"assets/{name}": data for name, data in files.items()}
