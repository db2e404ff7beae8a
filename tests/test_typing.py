"""A program of a user passes strict type checks, with a wheel and with an editable install."""

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


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An interpreter that sees Drapery as a wheel installs it, and our other packages."""
    return installed(tmp_path_factory.mktemp("wheel"))


@pytest.fixture(scope="module")
def editable(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The same for an editable install."""
    words = "--config-settings", "editable_mode=strict", "-e"
    return installed(tmp_path_factory.mktemp("editable"), *words)


@pytest.fixture(params=["wheel", "editable"])
def python(request: pytest.FixtureRequest) -> Path:
    found: Path = request.getfixturevalue(request.param)
    return found


def installed(folder: Path, *more: str) -> Path:
    """The interpreter of an environment in a folder, with Drapery and our other packages."""
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
    words = ["--no-deps", "--no-build-isolation", "--disable-pip-version-check", "-q", *more]
    pip = [sys.executable, "-m", "pip", "--python", str(found), "install", *words, "."]
    subprocess.run(pip, cwd=sources, check=True, timeout=300)
    return found


@pytest.fixture
def program(tmp_path: Path) -> Path:
    """The right program with the mistakes at its end."""
    path = tmp_path / "program.py"
    path.write_text(PROGRAM + "\n".join(WRONG) + "\n")
    return path


def check(*command: str, program: Path) -> list[tuple[str, int, str]]:
    """The file, line and text of each error that a type checker finds."""
    ran = subprocess.run(
        [*command, program.name], cwd=program.parent, capture_output=True, text=True, timeout=300
    )
    found = re.findall(r"(?m)^(.*?):(\d+):(?:\d+:)? error(?:: |\[.*?\] )(.*)$", ran.stdout)
    assert found, ran.stdout + ran.stderr
    return [(name, int(line), text) for name, line, text in found]


def test_ty_finds_the_mistakes_and_nothing_else(python: Path, program: Path) -> None:
    words = ["--python", str(python), "--output-format", "concise", "--color", "never"]
    found = check("ty", "check", *words, program=program)
    # Its present versions find no wrong name in an unpacked TypedDict, the first mistake.
    lines = {line for _, line, _ in found}
    assert lines | {WRONG_LINES[0]} == set(WRONG_LINES), found


def test_mypy_finds_them_with_a_wheel(wheel: Path, program: Path, tmp_path: Path) -> None:
    words = ["--strict", "--no-pretty", "--hide-error-context", "--no-color-output"]
    words += ["--python-executable", str(wheel), "--cache-dir", str(tmp_path)]
    found = check(sys.executable, "-m", "mypy", *words, program=program)
    assert {name for name, _, _ in found} == {program.name}, found
    assert sorted({line for _, line, _ in found}) == WRONG_LINES, found
    texts = " ".join(text for *_, text in found)
    assert all(word in texts for word in WRONG.values()), found
