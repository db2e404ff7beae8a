"""How fast pictures are compared, as ratios to other tools in the same run.

`python -m benchmarks.comparison --node FOLDER --snapshot PYTHON` compares with what is given:

FOLDER has been made by `npm install odiff-bin pixelmatch`. PYTHON is that of an environment into
which `pip install pytest-image-snapshot numpy` was run. The tools take turns, and the least time of
each counts: what else the machine does lengthens all of them. A ratio below 1 says that ours takes
less. Python's bytecode is kept from run to run, as where a package is installed, and the pictures
differ so far that each tool writes a picture of the difference.
"""

import argparse
import os
import subprocess
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from multiprocessing import Process
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter

import numpy as np
from PIL import Image, ImageDraw

from benchmarks.quick import add_quick

OURS = (sys.executable, "-m", "drapery", "compare")


def environment(folder: Path) -> dict[str, str]:
    """Variables with which pytest loads only the plugin that is measured, and all Pythons keep
    their bytecode in the folder."""
    kept = {name: text for name, text in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    bytecode = {"PYTHONPYCACHEPREFIX": str(folder / "bytecode")}
    return kept | bytecode | {"PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1"}


@dataclass(frozen=True)
class Cost:
    """The time on the clock and of the processor [s], and the most memory [MiB]."""

    wall: float
    used: float
    memory: float


def cost_of(words: Sequence[str], folder: Path) -> Cost:
    """What a command takes. Raises SystemExit if it ends with another code than 0, 1, 22 or 66,
    which say that pictures agree or differ."""
    start = perf_counter()
    with (folder / "said.txt").open("w+b") as said:
        known = environment(folder)
        run = subprocess.Popen(words, cwd=folder, stdout=said, stderr=said, env=known)
        _, status, usage = os.wait4(run.pid, 0)
        run.returncode = os.waitstatus_to_exitcode(status)
        if run.returncode not in (0, 1, 22, 66):
            said.seek(0)
            sys.exit(f"{' '.join(words)}: exit code {run.returncode}\n{said.read().decode()}")
    unit = 1 << 20 if sys.platform == "darwin" else 1 << 10
    used = usage.ru_utime + usage.ru_stime
    return Cost(perf_counter() - start, used, usage.ru_maxrss / unit)


def least(runs: Sequence[Cost]) -> Cost:
    """The least of each figure."""
    return Cost(*(min(getattr(run, name) for run in runs) for name in ("wall", "used", "memory")))


def print_costs(what: str, commands: dict[str, Sequence[str]], folder: Path, count: int) -> None:
    """The cost of each command, and the ratio of the first one, ours, to each other."""
    runs: dict[str, list[Cost]] = {name: [] for name in commands}
    for _ in range(count):
        for name, words in commands.items():
            runs[name].append(cost_of(words, folder))
    found = {name: least(each) for name, each in runs.items()}
    ours = next(iter(found.values()))
    print(what)
    for name, cost in found.items():
        line = f"  {name:22} {cost.wall:6.3f} s, of the processor {cost.used:6.3f} s"
        line += f", {cost.memory:4.0f} MiB"
        if cost is not ours:
            line += f"; ours over it {ours.wall / cost.wall:.2f} and {ours.used / cost.used:.2f}"
        print(line, flush=True)


def make_beside(folder: Path, name: str, width: int, height: int) -> None:
    """Make pictures in another process: a child's most memory counts that of its parent's."""
    maker = Process(target=make_pictures, args=(folder, name, width, height))
    maker.start()
    maker.join()


def make_pictures(folder: Path, name: str, width: int, height: int) -> None:
    """Two PNG files: shaded, with smoothed edges and stripes of fabric; one part differs."""
    across, down = np.meshgrid(np.linspace(0, 1, width), np.linspace(0, 1, height))
    light = 0.75 + 0.25 * np.sin(9 * across + 4 * down) * np.cos(5 * down)
    weave = 1 - 0.04 * ((np.arange(width) // 2 + np.arange(height)[:, None] // 2) % 2)
    shade = (light * weave)[..., None]
    for ending, colour in (("a", (200, 60, 40)), ("b", (120, 160, 40))):
        image = Image.new("RGB", (width // 2, height // 2), (128, 199, 31))
        draw = ImageDraw.Draw(image)
        draw.ellipse((width * 0.2, height * 0.1, width * 0.3, height * 0.3), colour)
        draw.polygon([(0, height // 2), (width // 4, height // 5), (width // 2, height // 2)], 0)
        large = np.asarray(image.resize((width, height), Image.Resampling.BILINEAR))
        pixels = np.dstack([large * shade, np.full((height, width), 255)]).astype(np.uint8)
        Image.fromarray(pixels).save(folder / f"{name}{ending}.png")


OUR_TESTS = """
import pytest
from PIL import Image

@pytest.mark.parametrize("number", range({count}))
def test_picture(golden, number):
    golden(Image.open(f"{{number}}.png"), "picture")
"""
THEIR_TESTS = """
import pytest
from PIL import Image

@pytest.mark.parametrize("number", range({count}))
def test_picture(image_snapshot, number):
    image_snapshot(Image.open(f"{{number}}.png"), f"approved/{{number}}.png")
"""


def print_goldens(python: str, folder: Path, count: int, size: tuple[int, int], runs: int) -> None:
    """Passing tests of pictures: ours, and those of pytest-image-snapshot."""
    for number in range(count):
        make_beside(folder, f"{number}-", *size)
        (folder / f"{number}-a.png").rename(folder / f"{number}.png")
    (folder / "approved").mkdir()
    (folder / "test_ours.py").write_text(OUR_TESTS.format(count=count))
    (folder / "test_theirs.py").write_text(THEIR_TESTS.format(count=count))
    plain = ("-q", "-p", "no:cacheprovider")
    ours = (sys.executable, "-m", "pytest", *plain, "-p", "drapery.testing.plugin", "test_ours.py")
    commands: dict[str, Sequence[str]] = {"drapery": ours}
    cost_of((*ours, "--drapery-update"), folder)
    if python:
        plugin = "pytest_image_snapshot"
        theirs = (python, "-m", "pytest", *plain, "-p", plugin, "test_theirs.py")
        cost_of((*theirs, "--image-snapshot-update"), folder)
        commands["pytest-image-snapshot"] = theirs
    title = f"{count} passing goldens of {size[0]} x {size[1]}"
    print_costs(title, commands, folder, runs)


def peer(found: Callable[[], Path | None], name: str) -> str:
    """The path of another tool; a line says what is left out."""
    path = found()
    if path is None or not path.exists():
        print(f"{name} is not given: left out")
        return ""
    return str(path.absolute())


def main() -> None:
    """Print the figures."""
    words = argparse.ArgumentParser(description=__doc__)
    words.add_argument("--node", type=Path, help="a folder with odiff-bin and pixelmatch of npm")
    words.add_argument("--snapshot", type=Path, help="a Python with pytest-image-snapshot")
    words.add_argument("--runs", type=int, default=7)
    add_quick(words)
    asked = words.parse_args()
    runs = 1 if asked.quick else asked.runs
    large, goldens = ((96, 64), 2) if asked.quick else ((3840, 2160), 20)
    node = asked.node
    odiff = peer(lambda: node and node / "node_modules/.bin/odiff", "odiff")
    pixelmatch = peer(lambda: node and node / "node_modules/.bin/pixelmatch", "pixelmatch")
    python = peer(lambda: asked.snapshot, "pytest-image-snapshot")
    if hasattr(os, "getloadavg"):
        print(f"load of the machine: {os.getloadavg()[0]:.1f} on {os.cpu_count()} processors")
    with TemporaryDirectory() as kept:
        folder = Path(kept)
        make_beside(folder, "large-", *large)
        make_beside(folder, "small-", 512, 256)
        pair = ("large-a.png", "large-b.png")

        def beside(
            ours: Sequence[str], theirs: dict[str, Sequence[str]]
        ) -> dict[str, Sequence[str]]:
            return {"drapery": (*OURS, *ours)} | {k: v for k, v in theirs.items() if v[0]}

        title = f"{large[0]} x {large[1]}"
        print_costs(f"verdict, {title}", beside(pair, {"odiff": (odiff, *pair)}), folder, runs)
        small = ("small-a.png", "small-b.png")
        print_costs("verdict, 512 x 256", beside(small, {"odiff": (odiff, *small)}), folder, runs)
        others = {
            "odiff": (odiff, *pair, "odiff.png"),
            "pixelmatch": (pixelmatch, *pair, "pixelmatch.png"),
        }
        ours = (*pair, "-o", "drapery.png")
        print_costs(f"with a picture, {title}", beside(ours, others), folder, max(1, runs // 2))
        for name in ("drapery.png", "odiff.png", "pixelmatch.png"):
            if (folder / name).exists():
                print(f"  {name}: {(folder / name).stat().st_size / 2**20:.2f} MiB")
        print_costs(
            f"--perceptual, {title}",
            beside((*pair, "--perceptual"), {}),
            folder,
            max(1, runs // 2),
        )
        golden_folder = folder / "goldens-of-tests"
        golden_folder.mkdir()
        size = (60, 40) if asked.quick else (1200, 800)
        print_goldens(python, golden_folder, goldens, size, max(1, runs // 2))


if __name__ == "__main__":
    main()
