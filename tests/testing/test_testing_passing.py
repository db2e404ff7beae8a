"""Goldens that pass are compared without numpy, and none passes that the usual check refuses."""

import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from drapery.comparison import Tolerance
from drapery.testing import agrees, encode
from drapery.testing.passing import passes

SIZE = (5, 7, 4)


def pixels(seed: int, alpha: int | None = None) -> np.ndarray:
    drawn = np.random.default_rng(seed).integers(0, 256, SIZE, np.uint8)
    if alpha is not None:
        drawn[..., 3] = alpha
    return drawn


def image(seed: int, mode: str = "RGBA") -> Image.Image:
    return Image.fromarray(pixels(seed, 255)).convert(mode)


def loop(folder: Path, *seeds: int) -> Image.Image:
    first, *others = map(image, seeds)
    first.save(folder / "loop.png", save_all=True, append_images=others, duration=50)
    return Image.open(folder / "loop.png")


def saved(picture: Image.Image, path: Path, **words: Any) -> Path:
    picture.save(path, **words)
    return path


def cleared(folder: Path) -> Image.Image:
    """A picture of mode RGB of which one colour is transparent."""
    path = saved(Image.new("RGB", (7, 5)), folder / "clear.png", transparency=(0, 0, 0))
    return Image.open(path)


def pictures(folder: Path) -> list[Any]:
    hidden = pixels(1, 0)
    near = pixels(1, 255)
    near[2, 3, 1] ^= 1
    return [
        *(image(1), image(1, "RGB"), image(1, "L"), image(1, "P"), image(2)),
        *(image(1).resize((4, 4)), Image.fromarray(hidden), Image.fromarray(near)),
        *(Image.fromarray(hidden // 2), Image.new("RGB", (7, 5)), cleared(folder)),
        *(Image.fromarray(np.full(SIZE[:2], 9000, np.uint16)), loop(folder, 1, 2)),
        *(pixels(1, 255), pixels(1, 255).astype(np.uint16) * 257),
        saved(image(1), folder / "same.png"),
        str(saved(image(2), folder / "other.png")),
        saved(image(1), folder / "lossless.webp", lossless=True),
    ]


TOLERANCES = (Tolerance(), Tolerance(channel=1), Tolerance(pixels=1), Tolerance(ciede2000=1))


def test_what_passes_quickly_agrees(tmp_path: Path) -> None:
    passed = 0
    for approved in pictures(tmp_path):
        golden = tmp_path / "golden.png"
        golden.write_bytes(encode(approved))
        for picture in pictures(tmp_path):
            for tolerance in TOLERANCES:
                quick = passes(golden, picture, tolerance)
                passed += quick
                assert not quick or agrees(golden, picture, tolerance), (approved, picture)
    assert passed > 20


@pytest.mark.parametrize("picture", [image(1), image(1, "RGB")])
def test_usual_pictures_pass_quickly(tmp_path: Path, picture: Image.Image) -> None:
    golden = tmp_path / "golden.png"
    golden.write_bytes(encode(picture))
    assert passes(golden, picture, Tolerance())
    assert passes(golden, saved(picture, tmp_path / "a.png"), Tolerance(channel=2))
    assert not passes(golden, image(2), Tolerance())
    variant = tmp_path / "golden~other.png"
    variant.write_bytes(encode(image(2)))
    assert passes(golden, image(2), Tolerance())
    golden.write_bytes(golden.read_bytes()[:-30])
    assert not passes(golden, image(2), Tolerance())
    golden.unlink()
    assert passes(golden, image(2), Tolerance())
    assert not passes(golden, picture, Tolerance())


def test_a_picture_is_as_it_was_after_the_check(tmp_path: Path) -> None:
    picture = Image.fromarray(pixels(1, 0))
    golden = tmp_path / "golden.png"
    golden.write_bytes(encode(Image.fromarray(pixels(2, 0))))
    before = picture.tobytes()
    assert passes(golden, picture, Tolerance())
    assert picture.tobytes() == before


def test_a_passing_test_imports_neither_numpy_nor_the_renderer(tmp_path: Path) -> None:
    picture = saved(image(1), tmp_path / "picture.png")
    (tmp_path / "goldens" / "test_one").mkdir(parents=True)
    for test in ("test_path[1]", "test_image[1]"):
        (tmp_path / "goldens" / "test_one" / f"{test}.png").write_bytes(picture.read_bytes())
    (tmp_path / "test_one.py").write_text(
        "from PIL import Image\n"
        "def test_path(golden): golden('picture.png', tolerance=1)\n"
        "def test_image(golden): golden(Image.open('picture.png'))\n",
        encoding="utf-8",
    )
    program = (
        "import sys, pytest\n"
        "code = pytest.main(['-q', '-p', 'drapery.testing.plugin', 'test_one.py'])\n"
        "heavy = {'numpy', 'trimesh', 'numba', 'drapery.render', 'drapery.settings'}\n"
        "print(int(code), sorted(heavy & set(sys.modules)))"
    )
    done = subprocess.run(
        [sys.executable, "-c", program],
        cwd=tmp_path,
        env=os.environ | {"PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1"},
        check=True,
        capture_output=True,
        text=True,
    )
    assert done.stdout.splitlines()[-1] == "0 []", done.stdout
