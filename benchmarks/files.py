"""How large files are, and how near to what was drawn: `python -m benchmarks.files`.

A loop of 4 s and a still of a waving banner, with the options that commands have by default, in
each format of pictures; the banner as 3-D files. PSNR is that of all pixels over white, as they are
read back, but for videos, whose colours have half the resolution. Time is the encoder's, of all
cores. Beside PNG is what optipng makes of it, if it is installed; beside 3-D files what gzip makes
of them, as servers do.
"""

import argparse
import gzip
import shutil
import subprocess
import tempfile
import time
from pathlib import Path

import numpy as np
from PIL import Image, ImageSequence

from benchmarks.quick import add_quick
from drapery import Banner, Frame, Settings, animate, draw, save_model
from drapery.arrays import Floats
from drapery.render import save_animation, save_frame

DESIGN = "red creeper:lime"
LOOPS = (".webp", ".apng", ".gif", ".avif", ".mp4", ".webm")
STILLS = (".png", ".webp", ".avif")
MODELS = (".glb", ".obj", ".ply", ".bbmodel", ".geo.json")


def over_white(pixels: Floats) -> Floats:
    """Pixels with alpha [..., 4], over white [..., 3]."""
    alpha = pixels[..., 3:] / 255.0
    return pixels[..., :3] * alpha + 255.0 * (1 - alpha)


def psnr(frames: list[Frame], path: Path) -> float:
    """How near the pictures of a file are to frames [dB]."""
    with Image.open(path) as file:
        back = [np.asarray(each.convert("RGBA"), float) for each in ImageSequence.Iterator(file)]
    errors = [
        ((over_white(seen) - over_white(frame.pixels.astype(float))) ** 2).mean()
        for seen, frame in zip(back, frames, strict=True)
    ]
    error = float(np.mean(errors))
    return 10 * float(np.log10(255**2 / error)) if error else float("inf")


def row(name: str, length: int, more: str = "") -> None:
    """Print a line of the table."""
    print(f"  {name:22} {length / 1e3:9.1f} kB  {more}", flush=True)


def pictures(frames: list[Frame], endings: tuple[str, ...], folder: Path) -> None:
    """Write frames in some formats; one frame is a still."""
    for ending in endings:
        path, start = folder / f"a{ending}", time.process_time()
        if len(frames) == 1:
            save_frame(frames[0], path)
        else:
            save_animation(frames, 20, path)
        taken = time.process_time() - start
        is_video = ending in (".mp4", ".webm")
        near = "" if is_video else f"{psnr(frames, path):5.1f} dB"
        row(ending, path.stat().st_size, f"{taken:6.2f} s  {near}")


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--design", default=DESIGN)
    add_quick(parser)
    given = parser.parse_args()
    banner = Banner.parse(given.design)
    settings, seconds = (Settings(size=(48, 64)), 0.2) if given.quick else (Settings(), 4.0)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        width, height = settings.size
        print(f"a loop of {seconds:g} s, {width} x {height}")
        pictures(list(animate(banner, settings, seconds=seconds)), LOOPS, folder)
        print("a still")
        pictures([draw(banner, settings)], STILLS, folder)
        if shutil.which("optipng"):
            subprocess.run(["optipng", "-quiet", folder / "a.png"], check=True)
            row("optipng of the .png", (folder / "a.png").stat().st_size)
        print("3-D files")
        for ending in MODELS:
            path = folder / f"b{ending}"
            save_model(banner, path, settings, seconds=seconds)
            packed = len(gzip.compress(path.read_bytes()))
            row(ending, path.stat().st_size, f"{packed / 1e3:.1f} kB by gzip")


if __name__ == "__main__":
    main()
