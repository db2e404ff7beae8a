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
PROGRAM = (Path(__file__).parent / "typed_program.py").read_text(encoding="utf-8")
IGNORED = re.compile(r"  # type: ignore\[[\w-]+\]$", re.MULTILINE)
WRONG_LINES = [1 + PROGRAM.count("\n", 0, found.start()) for found in IGNORED.finditer(PROGRAM)]


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
    """The program, whose mistakes are not ignored."""
    path = tmp_path / "program.py"
    path.write_text(IGNORED.sub("", PROGRAM), encoding="utf-8")
    return path


def check(*command: str, program: Path) -> list[tuple[str, int, str]]:
    """The file, line and text of each error that a type checker finds."""
    ran = subprocess.run(
        [*command, program.name], cwd=program.parent, capture_output=True, text=True, timeout=300
    )
    found = re.findall(r"(?m)^(.*?):(\d+):(?:\d+:)? error(?:: |\[.*?\] )(.*)$", ran.stdout)
    assert found, ran.stdout + ran.stderr
    return [(name, int(line), text) for name, line, text in found]


@pytest.mark.slow
def test_ty_finds_the_mistakes_and_nothing_else(python: Path, program: Path) -> None:
    words = ["--python", str(python), "--output-format", "concise", "--color", "never"]
    found = check("ty", "check", *words, program=program)
    # Its present versions find no wrong name in an unpacked TypedDict, the first mistake.
    lines = {line for _, line, _ in found}
    assert lines | {WRONG_LINES[0]} == set(WRONG_LINES), found
