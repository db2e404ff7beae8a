"""The same bits whatever kernels the BLAS and NumPy choose for the processor."""

import ast
import subprocess
import sys
from pathlib import Path

import pytest
from tracing import untraced_environment

PROGRAM = """
import hashlib
import numpy as np
from drapery import Banner, draw
from drapery.cloth import Wind, disc, simulate
from drapery.render import *
from drapery.render.gl import far_to_near

random = np.random.default_rng(5)
found = {}

def note(name, *values):
    digest = found.setdefault(name, hashlib.sha256())
    for value in values:
        digest.update(value if isinstance(value, bytes) else repr(value).encode())

for number in range(300):
    position, target = (tuple(map(float, random.normal(size=3))) for _ in range(2))
    camera = Camera(position, target, fov=50)
    note("view matrix", view_matrix(camera).tobytes())
    note("clip matrix", clip_matrix(camera, (40, 30)).tobytes())
    points = random.normal(size=(20, 3))
    note("frame_view", [frame_view(name, points, 1.5) for name in VIEWS])
    note("turntable", turntable(VIEWS["hero"], points, 1.0, 5))
    note("light", Light((position,), 0.3, 0.6).brightness(points).tobytes())

triangles = random.integers(0, 20, (500, 3)).astype(np.int32)
note("depth", far_to_near(triangles, points, clip_matrix(camera, (40, 30))).tobytes())
cloth = make_mesh(random.normal(size=(300, 3)), random.integers(0, 300, (400, 3)))
texture = random.integers(0, 256, (16, 16, 4), dtype=np.uint8)
model = make_model(cloth, texture=texture, alpha="blend")
camera = frame_view("hero", cloth.positions, 1.0)
edges = edges_model(cloth, camera, 200)
dots = dot_model(cloth.positions, (255, 0, 0, 255), camera, 200)
shadow = contact_shadow([model], float(cloth.positions[:, 1].min()))
picture = draw_models([model, edges, dots, shadow], view="hero", size=(200, 200))
note("picture", picture.pixels.tobytes())
scene = Scene((make_model(cloth, texture=texture),), camera)
save_scenes(scene, "scene.glb")
note("glb", open("scene.glb", "rb").read())
wind = Wind((3, 0, 1), ripples=1)
for cloth in (disc(12, 0.6), disc(12, 0.6, pins=[0])):
    for _, state in zip(range(20), simulate(cloth, forces=(wind,))):
        note("disc", state.positions.tobytes())
banner = Banner.parse("white creeper:lime border:black")
for style in ("embroidered", "ink"):
    note(style, draw(banner, style=style, view="hero", size=(96, 128)).pixels.tobytes())
for name, digest in found.items():
    print(name, digest.hexdigest())
"""


@pytest.fixture(scope="module")
def usual(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    return results(tmp_path_factory.mktemp("usual"), OPENBLAS_CORETYPE="Haswell")


def results(folder: object, **variables: str) -> dict[str, str]:
    said = subprocess.run(
        [sys.executable, "-c", PROGRAM],
        env=untraced_environment() | variables,
        cwd=str(folder),
        capture_output=True,
        text=True,
        check=True,
    ).stdout
    return dict(line.rsplit(" ", 1) for line in said.splitlines())


@pytest.mark.parametrize("kernels", ["Nehalem", "Prescott"])
@pytest.mark.slow
def test_the_blas_reaches_no_result(tmp_path: object, kernels: str, usual: dict[str, str]) -> None:
    assert len(usual) == 11
    assert results(tmp_path, OPENBLAS_CORETYPE=kernels) == usual


@pytest.mark.slow
def test_the_instructions_of_the_processor_reach_no_result(
    tmp_path: object, usual: dict[str, str]
) -> None:
    """NumPy's sines and unstable sorts, and the C library's sines, differ between processors."""
    names = "X86_V3 X86_V4 AVX512_ICL AVX512_SPR AVX2 FMA3 AVX512F AVX512CD AVX512_SKX ASIMDHP SVE"
    plain = "glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2,-AVX2_Usable,-FMA_Usable"
    assert results(tmp_path, NPY_DISABLE_CPU_FEATURES=names, GLIBC_TUNABLES=plain) == usual


OF_THE_PROCESSOR = {
    *("sin", "cos", "tan", "arcsin", "arccos", "arctan", "arctan2", "sinh", "cosh", "tanh"),
    *("exp", "exp2", "expm1", "log", "log2", "log10", "log1p", "cbrt", "power", "float_power"),
}
ROUNDED_OFF = {
    *("drapery/match", "drapery/studio"),
    *("drapery/comparison/colours.py", "drapery/comparison/flip.py"),
}
"""What these find is no picture, or is rounded to fewer bits; comparison prints four digits."""


def test_sources_use_no_function_that_numpy_has_for_each_processor() -> None:
    root = Path(__file__).parents[2]
    for path in [*root.glob("drapery/**/*.py"), *root.glob("render/**/*.py")]:
        name = path.relative_to(root).as_posix()
        if name.startswith(tuple(ROUNDED_OFF)):
            continue
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Attribute) and ast.unparse(node.value) == "np":
                assert node.attr not in OF_THE_PROCESSOR, (name, node.lineno)


EXACT_PRODUCTS = {
    "drapery/cloth/colliders/check.py": 1,  # compared with a tolerance
    "drapery/cloth/colliders/meshes.py": 3,  # of whole numbers
    "drapery/cloth/filters.py": 1,  # of whole numbers
    "drapery/match/peel.py": 2,  # of whole numbers
    "render/encode/palette.py": 1,  # of whole numbers
}


def test_sources_use_no_other_matrix_products() -> None:
    root = Path(__file__).parents[2]
    found = {}
    for path in [*root.glob("drapery/**/*.py"), *root.glob("render/**/*.py")]:
        nodes = ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if count := sum(isinstance(node, ast.MatMult) for node in nodes):
            found[path.relative_to(root).as_posix()] = count
    assert found == EXACT_PRODUCTS
