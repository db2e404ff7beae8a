"""The picture that `drapery render` draws without options: cloth, contact, light and the file."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image


@pytest.mark.quick
def test_a_banner_of_cloth_is_drawn_the_same_twice(
    tmp_path: Path, untraced_processes: None
) -> None:
    for name in ("first.png", "second.png"):
        words = ["render", "red creeper:lime", "-o", str(tmp_path / name)]
        subprocess.run([sys.executable, "-m", "drapery", *words], check=True)
    assert (tmp_path / "first.png").read_bytes() == (tmp_path / "second.png").read_bytes()
    with Image.open(tmp_path / "first.png") as picture:
        pixels = np.asarray(picture.convert("RGBA")).astype(int)
    assert pixels.shape == (512, 512, 4) and not pixels[[0, 0, -1], [0, -1, 0], 3].any()
    red, green, _, shown = np.moveaxis(pixels, -1, 0)
    cloth = shown == 255
    for main, other in ((red, green), (green, red)):  # the field, and the charge on it
        rows, columns = np.nonzero(cloth & (main > 1.3 * other))
        assert len(rows) > 4000 and abs(columns.mean() - 256) < 64
