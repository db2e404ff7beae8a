"""Every example runs, leaves its pictures and uses public names; most of them have few lines."""

import ast
import importlib.util
import io
import runpy
import subprocess
import sys
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from PIL import Image
from public_api import PACKAGES
from service_process import service

from drapery.testing.plugin import Golden

EXAMPLES = Path(__file__).parent.parent / "examples"
PROGRAMS = {
    "render": ("banner.png", "face.png"),
    "animate": ("waving.webp", *(f"frame-{number}.png" for number in range(4))),
    "own_pack": ("heart.png",),
    "own_cloth": ("sheet.png",),
    "own_collider": ("own_collider.png",),
    "own_physics": ("own_physics.png",),
    "own_style": ("comic.png",),
    "video": ("banner.mp4",),
    "compare_designs": ("difference.png",),
    "batch": tuple(f"pictures/{dye}.png" for dye in ("white", "yellow", "orange", "red")),
    "animated_gltf": ("banner.glb",),
    "own_garment": ("towel.png",),
    "own_force": ("forces.npz",),
    "positions": ("positions.npz",),
    "sprites": ("banner.sheet.png", "banner.sheet.json"),
    "compare_solvers": ("stretch.csv",),
}
"""Programs of at most fifteen lines, and what each leaves in the current folder."""
STUDIES = sorted(path.stem for path in EXAMPLES.glob("*.py") if path.stem not in (*PROGRAMS, "bot"))
SMALLER: dict[str, dict[str, Any]] = {"crowd": {"side": 5}}
"""The same program on less, where the whole takes long."""


def run(name: str, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Run a program in a folder; that of many processes must be a process of its own."""
    program = EXAMPLES / f"{name}.py"
    if name == "batch":
        subprocess.run([sys.executable, program], cwd=folder, check=True, timeout=300)
        return
    monkeypatch.chdir(folder)
    runpy.run_path(str(program), run_name="__main__")


@pytest.mark.parametrize("name", PROGRAMS)
def test_a_program_is_short(name: str) -> None:
    text = (EXAMPLES / f"{name}.py").read_text()
    assert len([line for line in text.splitlines() if line.strip()]) <= 15


@pytest.mark.parametrize("name", [*PROGRAMS, *STUDIES, "bot"])
def test_an_example_uses_only_public_names(name: str) -> None:
    text = (EXAMPLES / f"{name}.py").read_text()
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("drapery"):
            assert node.module in PACKAGES
            public = import_module(node.module).__all__
            assert {alias.name for alias in node.names} <= set(public)
        elif isinstance(node, ast.Import):
            assert not any(alias.name.startswith("drapery") for alias in node.names)


@pytest.mark.parametrize("name", PROGRAMS)
def test_a_program_draws_what_it_drew_before(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, golden: Golden
) -> None:
    run(name, tmp_path, monkeypatch)
    for target in PROGRAMS[name]:
        path = tmp_path / target
        if path.suffix in (".png", ".webp"):
            with Image.open(path) as picture:
                golden(picture.convert("RGBA"), f"{name}-{path.stem}")


def test_the_video_has_every_frame(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    av = pytest.importorskip("av")
    run("video", tmp_path, monkeypatch)
    with av.open(str(tmp_path / "banner.mp4")) as video:
        frames = [frame.to_ndarray(format="rgb24") for frame in video.decode(video=0)]
    assert len(frames) == 80 and frames[0].shape == (320, 256, 3)
    assert np.abs(frames[0].astype(int) - frames[40]).max() > 64


def test_the_model_has_a_morph_target_for_every_frame(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    run("animated_gltf", tmp_path, monkeypatch)
    assert trimesh.load_scene(tmp_path / "banner.glb").geometry
    header, _, _ = (tmp_path / "banner.glb").read_bytes()[20:].partition(b"\x00")
    assert header.count(b'"POSITION"') > 20


def test_four_sheets_part_in_the_gusts(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    run("positions", tmp_path, monkeypatch)
    written = np.load(tmp_path / "positions.npz")
    positions = written["positions"]
    assert positions.shape == (len(written["times"]), 4, 9 * 17, 3)
    spread = np.ptp(positions, axis=1)
    assert spread[0].max() == 0.0 and spread[-1].max() > 0.01


def test_an_own_force_whirls_what_is_not_pinned(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    run("own_force", tmp_path, monkeypatch)
    written = np.load(tmp_path / "forces.npz")
    positions, gained = written["positions"][0], written["accelerations"][0]
    pinned = (gained == 0.0).all(axis=1)
    assert pinned.sum() == 9
    x, z = positions[~pinned, 0], positions[~pinned, 2]
    turning = x * gained[~pinned, 2] - z * gained[~pinned, 0]
    assert turning.mean() > (x**2 + z**2).mean()


def test_the_solver_of_hard_constraints_stretches_less(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    run("compare_solvers", tmp_path, monkeypatch)
    assert (tmp_path / "stretch.csv").read_text().startswith("seconds,XPBD,Verlet\n")
    seconds, hard, springs = np.loadtxt(tmp_path / "stretch.csv", delimiter=",", skiprows=1).T
    assert np.allclose(np.diff(seconds), 0.1)
    assert (hard[1:] < springs[1:]).all() and springs.max() < 0.2


@pytest.mark.parametrize("name", STUDIES)
def test_a_study_writes_its_pictures(name: str, tmp_path: Path) -> None:
    spec = importlib.util.spec_from_file_location(name, EXAMPLES / f"{name}.py")
    assert spec is not None and spec.loader is not None
    program = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(program)
    program.main(tmp_path, **SMALLER.get(name, {}))
    written = list(tmp_path.iterdir())
    assert written
    for path in written:
        with Image.open(path) as picture:
            texels = np.asarray(picture.convert("RGBA"))
        assert len(np.unique(texels.reshape(-1, 4), axis=0)) > 8, path.name


def test_a_bot_answers_with_a_moving_banner_or_with_the_reason_why_there_is_none(
    untraced_processes: None,
) -> None:
    pytest.importorskip("fastapi", reason="fastapi is not installed (drapery-mc[serve])")
    answer = runpy.run_path(str(EXAMPLES / "bot.py"))["answer"]
    with service() as (address, _):
        with Image.open(io.BytesIO(answer("white creeper:lime", address))) as picture:
            assert picture.format == "GIF" and picture.size == (192, 240)
            assert picture.n_frames == 20  # type: ignore[attr-defined]
        assert "unknown pattern 'creper'" in answer("white creper:lime", address)
    assert answer("white", address) == "No picture now; try again later."


def test_the_guide_shows_the_bot_of_the_example() -> None:
    program = (EXAMPLES / "bot.py").read_text("utf-8")
    assert len([line for line in program.splitlines() if line.strip()]) <= 30
    guide = (EXAMPLES.parent / "docs/guides/wikis-and-bots.md").read_text("utf-8")
    assert f'```python title="bot.py"\n{program}```\n' in guide


def test_the_guide_shows_the_solver_of_the_example() -> None:
    guide = (EXAMPLES.parent / "docs/guides/research.md").read_text("utf-8")
    program = (EXAMPLES / "own_solver.py").read_text("utf-8")
    shown = program[program.index("class SolverEuler") : program.index("def main")]
    assert shown.strip() in guide


def test_every_example_is_listed() -> None:
    listed = (EXAMPLES / "README.md").read_text()
    assert all(f"`{path.name}`" in listed for path in EXAMPLES.glob("*.py"))
