"""A program of a user passes strict type checks, with a wheel and with an editable install."""

import json
import re
import shutil
import subprocess
import sys
import sysconfig
import venv
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
SOURCES = ("drapery", "render", "assets", "pyproject.toml", "README.md", "LICENSE")
PROGRAM = """
from collections.abc import Iterator
from pathlib import Path

import numpy as np

import drapery
from drapery import Animation, Banner, Frame, Settings, animate, compare, draw, draw_face
from drapery import iter_frames, parse_banners, read_designs, save_model, simulate
from drapery.cloth import Drag, Fabric, SolverXPBD, State, Wind, grid
from drapery.packs import MemoryPack, open_packs
from drapery.render import VIEWS, backend

banner: Banner = Banner.parse("white creeper:lime")
settings = Settings(wind=6, size=(64, 64), solver="xpbd", packs=["a.zip", Path("b")])
frame: Frame = draw(banner, settings, view="hero", pins="top", samples=4)
waving: Animation = animate(banner, seconds=2, fps=10, background="#ffffff")
frames: Iterator[Frame] = iter_frames(banner, settings, wind=Wind((1.0, 0.0, 3.0)))
face: Frame = draw_face(banner, packs=open_packs(), scale=4, side="back")
draw(
    banner,
    solver=SolverXPBD(substeps=8),
    fabric=Fabric(density=0.2),
    forces=[Drag(0.2)],
    packs=open_packs(MemoryPack(patterns={"own:dot": np.zeros((64, 64), np.uint8)})),
    view=VIEWS["hero"],
    backend=backend("soft"),
)
draw(kind="cape", texture=np.zeros((32, 64, 4), np.uint8))
save_model(banner, "banner.glb", seconds=1, grid=(9, 17))
same: bool = compare(banner, frame, size=(64, 64)).difference.same
bases: list[str] = [found.banner.base for found in (*parse_banners("red"), *read_designs("red"))]
states: Iterator[State] = simulate(grid(5, 9, 1.0, 2.0))
version: str = drapery.__version__
"""
WRONG = {
    "draw(banner, wnid=6)": "wnid",
    "draw(banner, wind='strong')": "wind",
    "draw(banner, pose='still')": "pose",
    "draw('white')": "Banner",
    "frame.pixel": "pixel",
}
"""Mistakes that a type checker must find, and a word of its message."""
WRONG_LINES = [PROGRAM.count("\n") + number for number in range(1, len(WRONG) + 1)]


@pytest.fixture(scope="module", params=["wheel", "editable"])
def python(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An interpreter that sees Drapery installed this way, and our other packages."""
    folder = tmp_path_factory.mktemp(request.param)
    sources = folder / "sources"
    sources.mkdir()
    for name in SOURCES:
        if (ROOT / name).is_dir():
            shutil.copytree(ROOT / name, sources / name)
        else:
            shutil.copy(ROOT / name, sources)
    venv.create(folder / "env", symlinks=True)
    scripts = "Scripts" if sys.platform == "win32" else "bin"
    found = folder / "env" / scripts / Path(sys.executable).name
    paths = {"base": str(folder / "env"), "platbase": str(folder / "env")}
    site = Path(sysconfig.get_path("purelib", vars=paths))
    others = [path for path in sys.path if path.endswith("site-packages")]
    (site / "others.pth").write_text("\n".join(others))
    words = ["--no-deps", "--no-build-isolation", "--disable-pip-version-check", "-q"]
    if request.param == "editable":
        words += ["--config-settings", "editable_mode=strict", "-e"]
    pip = [sys.executable, "-m", "pip", "--python", str(found), "install", *words, "."]
    subprocess.run(pip, cwd=sources, check=True, timeout=300)
    return found


@pytest.fixture
def program(tmp_path: Path) -> Path:
    """The right program with the mistakes at its end."""
    path = tmp_path / "program.py"
    path.write_text(PROGRAM + "\n".join(WRONG) + "\n")
    return path


@pytest.fixture(scope="module")
def cache(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """What mypy knows of our other packages, which are the same for both installs."""
    return tmp_path_factory.mktemp("mypy")


def test_mypy_finds_the_mistakes_and_nothing_else(python: Path, program: Path, cache: Path) -> None:
    words = ["--strict", "--no-pretty", "--hide-error-context", "--no-color-output"]
    words += ["--python-executable", str(python), "--cache-dir", str(cache)]
    ran = subprocess.run(
        [sys.executable, "-m", "mypy", *words, program.name],
        cwd=program.parent,
        capture_output=True,
        text=True,
        timeout=300,
    )
    found = re.findall(r"(?m)^(.*):(\d+): error: (.*)$", ran.stdout)
    assert {name for name, _, _ in found} == {program.name}, ran.stdout + ran.stderr
    assert sorted({int(line) for _, line, _ in found}) == WRONG_LINES, ran.stdout
    assert all(word in ran.stdout for word in WRONG.values()), ran.stdout


def test_pyright_finds_them_too(python: Path, program: Path) -> None:
    pyright = shutil.which("pyright")
    if pyright is None:
        pytest.skip("pyright is not installed")
    words = ["--pythonpath", str(python), "--outputjson", program.name]
    ran = subprocess.run([pyright, *words], cwd=program.parent, capture_output=True, text=True)
    try:
        found = json.loads(ran.stdout)["generalDiagnostics"]
    except json.JSONDecodeError:
        pytest.skip(f"pyright cannot start: {(ran.stderr or ran.stdout)[-200:]}")
    wrong = [one["range"]["start"]["line"] + 1 for one in found if one["severity"] == "error"]
    assert sorted(set(wrong)) == WRONG_LINES, found
