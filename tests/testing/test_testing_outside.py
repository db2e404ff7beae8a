"""The pytest plugin in a project that is not ours, from nothing but the built wheel."""

import os
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from PIL import Image
from plain_runs import PLAIN

from drapery.banner.packs import open_packs
from release.build import MAX_WHEEL, copy_sources, size_of_sources

PROJECT_TEST = """
from drapery import Banner, draw

def test_creeper(golden):
    banner = Banner.parse("white creeper:lime border:black")
    golden(draw(banner, packs=["pack"], size=(96, 128)), banner=banner, packs=["pack"])
"""

pytestmark = pytest.mark.slow
Pytest = Callable[..., subprocess.CompletedProcess[str]]


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The wheel of what git knows: setuptools adds what an earlier build left in `build/`."""
    folder = tmp_path_factory.mktemp("wheel")
    copy_sources(folder / "source", with_built=False)
    words = ["--no-deps", "--no-build-isolation", "-w", folder, folder / "source"]
    command = [sys.executable, "-m", "pip", "wheel", "-q", *words]
    subprocess.run(command, check=True)
    (built,) = folder.glob("*.whl")
    return built


@pytest.fixture(scope="module")
def outside(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Pytest]:
    """A project's folder and its own pytest; the wheel's dependencies are lent by this one's."""
    project = tmp_path_factory.mktemp("project")
    env = tmp_path_factory.mktemp("env")
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", env], check=True)
    python = env / ("Scripts" if os.name == "nt" else "bin") / "python"
    pip = [sys.executable, "-m", "pip", "--python", python]
    subprocess.run([*pip, "install", "-q", "--no-deps", wheel], check=True)
    ask = "import sysconfig; print(sysconfig.get_paths()['purelib'])"
    own = subprocess.run([python, "-c", ask], check=True, capture_output=True, text=True)
    others = [path for path in sys.path if path.endswith("site-packages")]
    # A path in a .pth file is only added: an editable drapery over there stays out of sight.
    (Path(own.stdout.strip()) / "lent.pth").write_text("\n".join(others))
    clean = {k: v for k, v in os.environ.items() if not k.startswith(("PYTEST", "PYTHONPATH"))}

    def run(*words: str) -> subprocess.CompletedProcess[str]:
        command = [str(python), "-m", "pytest", "-q", *PLAIN, *words]
        return subprocess.run(command, cwd=project, env=clean, capture_output=True, text=True)

    (project / "test_banner.py").write_text(PROJECT_TEST)
    return project, run


def test_a_wheel_is_as_small_as_a_release_wants_it(wheel: Path) -> None:
    assert size_of_sources(wheel) <= MAX_WHEEL


def test_create_pass_fail_report_update_pass(outside: tuple[Path, Pytest]) -> None:
    project, run = outside
    sprite = project / "pack/assets/minecraft/textures/entity/banner/creeper.png"
    sprite.parent.mkdir(parents=True)
    (project / "pack/pack.mcmeta").write_text('{"pack": {"pack_format": 34, "description": ""}}')
    texels = open_packs(()).sheet("creeper").copy()
    Image.fromarray(texels).save(sprite)

    missing = run()
    assert missing.returncode == 1 and "no golden" in missing.stdout
    assert run("--drapery-update").returncode == 0
    (kept,) = project.glob("goldens/test_banner/*.png")
    before = kept.read_bytes()

    texels[20, 8] = 255 - texels[20, 8]
    Image.fromarray(texels).save(sprite)
    failed = run()
    assert failed.returncode == 1
    assert "layer 1 (creeper, lime) has 1 changed texel" in failed.stdout
    page = project / "drapery-report/index.html"
    assert str(page) in failed.stdout and "data:image/png" in page.read_text()
    assert {p.name.split(".")[1] for p in page.parent.glob("*.png")} == {
        "expected",
        "actual",
        "panel",
        "difference",
    }
    assert kept.read_bytes() == before

    assert run("--drapery-update").returncode == 0
    assert kept.read_bytes() != before
    assert run().returncode == 0
    assert not page.exists()


HARMS: dict[str, tuple[bytes | str | tuple[int, int], str]] = {
    "text": (b"not a picture", "not a readable PNG"),
    "empty": (b"", "not a readable PNG"),
    "mode": ("L", "64 pixels differ, max 255"),
    "size": ((9, 8), "size changed from 9x8 to 8x8"),
}


def test_harmed_and_unused_goldens_are_named_by_workers_in_one_report(
    outside: tuple[Path, Pytest],
) -> None:
    project, run = outside
    test = project / "test_many.py"
    test.write_text(
        "import numpy as np, pytest\n"
        f"@pytest.mark.parametrize('name', {[*HARMS, 'whole']})\n"
        "def test_many(golden, name):\n"
        "    golden(np.full((8, 8, 4), 255, np.uint8), name)\n"
        "def test_gone(golden):\n"
        "    golden(np.full((8, 8, 4), 255, np.uint8))\n"
    )
    assert run("test_many.py", "--drapery-update").returncode == 0
    goldens = {name: project / f"goldens/test_many/test_many[{name}][{name}].png" for name in HARMS}
    for name, (harm, _) in HARMS.items():
        _harm(goldens[name], harm)
    data = {name: path.read_bytes() for name, path in goldens.items()}
    test.write_text(test.read_text().partition("def test_gone")[0])

    # All tests, for only then can a golden be known as unused.
    (project / "test_banner.py").unlink(missing_ok=True)
    failed = run("-n", "2")
    assert failed.returncode == 1 and "4 failed, 1 passed" in failed.stdout
    assert "Traceback" not in failed.stdout
    for name, (_, says) in HARMS.items():
        assert says in failed.stdout
        assert goldens[name].read_bytes() == data[name]
    page = (project / "drapery-report/index.html").read_text()
    assert "4 goldens not as expected" in page

    assert run("--drapery-update").returncode == 0
    listed, pruned = run().stdout, run("--drapery-prune").stdout
    assert re.search(r"drapery: \d goldens? (is|are) named by no test", listed)
    assert re.search(r"drapery: \d goldens? deleted", pruned)
    left = {path.stem.partition("[")[0] for path in project.glob("goldens/*/*.png")}
    assert left == {"test_many"}


def _harm(path: Path, harm: bytes | str | tuple[int, int]) -> None:
    if isinstance(harm, bytes):
        path.write_bytes(harm)
    else:
        mode, size = (harm, (8, 8)) if isinstance(harm, str) else ("RGBA", harm)
        Image.new(mode, size).save(path)
