"""PNG files are compared without numpy and typer, with the same figures, words and exit codes."""

import subprocess
import sys
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
from conftest import Run
from PIL import Image

from drapery.comparison import (
    Tolerance,
    measure_files,
    measure_pictures,
    read_picture,
    read_stills,
    side_by_side,
)
from drapery.errors import OptionError
from drapery.render.encode.quick_png import quick_png_of_strips


def saved(pixels: np.ndarray, path: Path) -> Path:
    Image.fromarray(pixels).save(path)
    return path


def changed(rng: np.random.Generator, pixels: np.ndarray) -> np.ndarray:
    """The same picture with some channels of some pixels a little different."""
    some = rng.random(pixels.shape) < rng.choice([0, 0.001, 0.3])
    return np.where(some, pixels + rng.integers(0, 9, pixels.shape), pixels).astype(np.uint8)


def files(folder: Path, seed: int) -> tuple[Path, Path]:
    """Two files of pictures that differ in few channels, many or none, some of them transparent."""
    rng = np.random.default_rng(seed)
    height, width = rng.integers(1, (700, 40))
    old = rng.integers(0, 256, (height, width, 4), np.uint8)
    if seed % 3:
        old[..., 3] *= rng.random((height, width)) < 0.5
    new = changed(rng, old)
    if seed % 4 == 0:
        old[..., 3] = new[..., 3] = 255
    a = saved(old, folder / "a.png")
    return a, saved(new[..., :3] if seed % 8 == 0 else new, folder / "b.png")


@pytest.mark.parametrize("seed", range(24))
def test_files_have_the_figures_of_arrays(tmp_path: Path, seed: int) -> None:
    a, b = files(tmp_path, seed)
    tolerance = Tolerance(channel=seed % 5, pixels=seed, ratio=0.01 * (seed % 2))
    pictures = read_picture(a), read_picture(b)
    assert measure_files(a, b, tolerance) == measure_pictures(*pictures, tolerance)
    assert measure_files(a, a, tolerance) == measure_pictures(pictures[0], pictures[0], tolerance)


@pytest.mark.parametrize("seed", range(24))
def test_the_picture_of_files_is_that_of_arrays(tmp_path: Path, seed: int) -> None:
    a, b = files(tmp_path, seed)
    for pair in ((a, b), (a, a)):
        stills = read_stills(*pair)
        assert stills is not None
        data = quick_png_of_strips(stills.sheet_strips(("one", "the other_of_two")))
        frames = [read_picture(each).frames[0] for each in pair]
        sheet = side_by_side(frames[0], frames[1], ("one", "the other_of_two")).pixels
        assert np.array_equal(np.asarray(Image.open(BytesIO(data)).convert("RGBA")), sheet)


def test_files_of_other_kinds_are_left_to_arrays(tmp_path: Path) -> None:
    plain = saved(np.full((3, 4, 4), 9, np.uint8), tmp_path / "plain.png")
    other = saved(np.full((4, 4, 4), 9, np.uint8), tmp_path / "size.png")
    grey = saved(np.full((3, 4), 9, np.uint8), tmp_path / "grey.png")
    deep = saved(np.full((3, 4), 900, np.uint16), tmp_path / "deep.png")
    clear = tmp_path / "clear.png"
    Image.new("RGB", (4, 3)).save(clear, transparency=(0, 0, 0))
    loop = tmp_path / "loop.png"
    still = Image.new("RGBA", (4, 3))
    still.save(loop, save_all=True, append_images=[Image.new("RGBA", (4, 3), "red")])
    for path in (other, grey, deep, clear, loop):
        assert measure_files(plain, path) is None, path
        assert measure_files(path, plain) is None, path
    assert measure_files(loop, loop) is None
    for tolerance in (Tolerance(ignore=((0, 0, 1, 1),)), Tolerance(flip=0.1)):
        assert measure_files(plain, plain, tolerance) is None


@pytest.mark.parametrize("places", [(0, 1), (1, 0), (1, 1)])
def test_a_broken_file_is_named(tmp_path: Path, places: tuple[int, int]) -> None:
    whole = saved(np.zeros((64, 64, 4), np.uint8), tmp_path / "whole.png")
    broken = tmp_path / "broken.png"
    broken.write_bytes(whole.read_bytes()[:-40])
    both = [(whole, broken)[place] for place in places]
    with pytest.raises(OptionError, match=r"broken\.png is a broken picture"):
        measure_files(*both)


@pytest.mark.parametrize("step", [0, 3])
def test_the_command_says_the_same_without_and_with_options(
    drapery: Run, tmp_path: Path, step: int
) -> None:
    a = saved(np.full((9, 8, 4), 90, np.uint8), tmp_path / "a.png")
    b = saved(np.full((9, 8, 4), 90 + step, np.uint8), tmp_path / "b.png")
    quick = drapery("compare", a, b)
    assert quick == drapery("compare", a, b, "--tolerance", "0")
    assert quick[0] == (1 if step else 0)
    written = [tmp_path / "quick.png", tmp_path / "usual.png"]
    assert drapery("compare", a, b, "-o", written[0]) == quick
    assert drapery("compare", a, b, "--tolerance", "0", "-o", written[1]) == quick
    pictures = [read_picture(each).frames[0] for each in written]
    assert np.array_equal(*pictures)


@pytest.mark.parametrize("target", ["missing/c.png", "folder.png", "c.txt"])
def test_a_target_that_cannot_be_written_is_refused_alike(
    drapery: Run, tmp_path: Path, target: str
) -> None:
    (tmp_path / "folder.png").mkdir()
    a = saved(np.full((9, 8, 4), 90, np.uint8), tmp_path / "a.png")
    path = tmp_path / target
    quick = drapery("compare", a, a, "-o", path)
    assert quick[0] == 2 and quick == drapery("compare", a, a, "--tolerance", "0", "-o", path)


def test_two_pictures_are_compared_without_numpy_and_typer(tmp_path: Path) -> None:
    a = saved(np.zeros((8, 8, 4), np.uint8), tmp_path / "a.png")
    b = saved(np.ones((8, 8, 4), np.uint8), tmp_path / "b.png")
    program = (
        "import sys\nfrom drapery.cli import main\n"
        "try: main()\nexcept SystemExit as end: code = end.code\n"
        "heavy = {'numpy', 'typer', 'rich', 'numba', 'scipy', 'subprocess', 'PIL.GifImagePlugin'}\n"
        "print(code, sorted(heavy & set(sys.modules)))"
    )
    words = [sys.executable, "-c", program, "compare", str(a), str(b)]
    for more in ([], ["-o", str(tmp_path / "c.png")]):
        done = subprocess.run([*words, *more], check=True, capture_output=True, text=True)
        assert done.stdout.splitlines()[-1] == "1 []"
