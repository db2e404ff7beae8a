"""OpenGL and our own rasteriser draw the same pictures; and OpenGL fails politely."""

import gc
import os
import subprocess
import sys
import threading
from collections.abc import Callable
from dataclasses import fields, replace
from pathlib import Path

import numpy as np
import pytest

from drapery import Banner, Settings
from drapery.errors import BackendError, OptionError
from drapery.mesh import Mesh, vertex_normals
from drapery.packs import open_packs
from drapery.render import Buffers, doctor, gl, soft
from drapery.render.backends import draw_with_buffers
from drapery.render.camera import Camera
from drapery.render.gl import platform as gl_platform
from drapery.render.light import STUDIO_LIGHT, Light
from drapery.render.scene import Material, Model, Scene, TextureLayer
from drapery.scenes import still


@pytest.fixture(scope="module", autouse=True)
def opengl() -> None:
    try:
        gl.describe()
    except BackendError as error:
        pytest.skip(f"OpenGL is not compared: {error}")


def texture(seed: int, size: int, holes: bool = False) -> np.ndarray:
    texels = np.random.default_rng(seed).integers(0, 256, (size, size, 4), dtype=np.uint8)
    if holes:
        texels[..., 3] = np.where(texels[..., 3] < 128, 0, 255)
    return texels


def sheet(seed: int, cells: int = 6, bumps: float = 0.15) -> Mesh:
    """A bumpy square, two metres wide, of 2 * cells * cells triangles."""
    u, v = np.meshgrid(*[np.linspace(0, 1, cells + 1)] * 2)
    z = bumps * np.random.default_rng(seed).standard_normal(u.shape)
    positions = np.stack([2 * u - 1, 1 - 2 * v, z], axis=-1).reshape(-1, 3).astype(np.float32)
    corner = (np.arange(cells)[:, None] * (cells + 1) + np.arange(cells)).ravel()
    a, b, c, d = corner, corner + 1, corner + cells + 1, corner + cells + 2
    triangles = np.concatenate([np.stack([a, c, d], 1), np.stack([a, d, b], 1)]).astype(np.int32)
    uvs = np.stack([u, v], axis=-1).reshape(-1, 2).astype(np.float32)
    return Mesh(positions, vertex_normals(positions, triangles), triangles, uvs)


def moved(mesh: Mesh, *offset: float) -> Mesh:
    return replace(mesh, positions=mesh.positions + np.array(offset, np.float32))


CAMERA = Camera((1.2, 1.0, 3.2), (0.0, 0.0, 0.0))
LAYERS = (
    TextureLayer(texture(1, 16), (255, 40, 90)),
    TextureLayer(texture(2, 32), (10, 250, 80)),
    TextureLayer(texture(3, 8, holes=True), (30, 40, 255)),
)
SOLID = Model(sheet(0), (Material(LAYERS),))


def crowd() -> Model:
    """Sixty sheets in one batch with three looks of one to three layers."""
    mesh = sheet(5, cells=3)
    offsets = np.random.default_rng(6).uniform(-3, 3, (60, 1, 3)).astype(np.float32)
    positions = 0.3 * mesh.positions + offsets
    normals = np.broadcast_to(mesh.normals, positions.shape)
    materials = tuple(Material(LAYERS[:count]) for count in (1, 2, 3))
    index = (np.arange(60) % 3).astype(np.int32)
    return Model(Mesh(positions, normals, mesh.triangles, mesh.uvs), materials, index)


def layers() -> tuple[Model, ...]:
    """A solid sheet, one with holes before it and two that shine through, the near one first."""
    return (
        SOLID,
        Model(moved(sheet(8), 0.3, 0.2, 0.5), (Material(LAYERS[2:] + LAYERS[:1], "cutout"),)),
        Model(moved(sheet(9), -0.4, 0.2, 1.1), (Material(LAYERS[:2], "blend"),)),
        Model(moved(sheet(7), 0.4, -0.3, 0.8), (Material(LAYERS[:1], "blend", lit=False),)),
    )


def on_pixel_centres() -> Scene:
    """Triangles whose corners and edges lie on the centres of pixels."""
    random = np.random.default_rng(12)
    corners = random.integers(-16, 16, (40, 3, 2)) + 0.5
    depth = np.broadcast_to(random.uniform(-1, 1, (40, 1, 1)), (40, 3, 1))
    positions = np.concatenate([corners, depth], axis=2).reshape(-1, 3).astype(np.float32)
    triangles = np.arange(120, dtype=np.int32).reshape(-1, 3)
    uvs = random.uniform(0.3, 0.7, (120, 2)).astype(np.float32)
    mesh = Mesh(positions, vertex_normals(positions, triangles), triangles, uvs)
    camera = Camera((0, 0, 5), (0, 0, 0), height=32.0)
    return Scene((Model(mesh, (Material((TextureLayer(texture(1, 1)),)),)),), camera, (32, 32))


WARM = Light(((1.0, 2.0, 0.5),), 0.3, 0.7, tint=(1.0, 0.8, 0.6))
SCENES = {
    "layers": Scene((SOLID,), CAMERA, (300, 200)),
    "crowd": Scene((crowd(), SOLID), Camera((4, 3, 6), (0, 0, 0)), (320, 240)),
    "orthographic": Scene((SOLID,), replace(CAMERA, height=2.5), (200, 200)),
    "alpha": Scene(layers(), CAMERA, (256, 256)),
    "alpha over a colour": Scene(layers(), CAMERA, (256, 256), background=(40, 160, 220, 255)),
    "alpha over half a colour": Scene(layers(), CAMERA, (99, 77), background=(200, 60, 20, 130)),
    "coloured light": Scene((SOLID,), CAMERA, (128, 128), WARM),
    "unlit": Scene((replace(SOLID, materials=(Material(LAYERS, lit=False),)),), CAMERA, light=WARM),
    "shadows": Scene(layers(), CAMERA, (200, 150), STUDIO_LIGHT),
    "shadows, 4 samples": Scene((SOLID, crowd()), CAMERA, (99, 77), STUDIO_LIGHT, samples=4),
    "4 samples": Scene(layers(), CAMERA, (100, 100), samples=4),
    "16 samples": Scene(layers(), CAMERA, (60, 60), samples=16),
    "camera inside": Scene((crowd(),), Camera((0.1, 0.2, 0.1), (0, 0, -3), fov=90), (200, 150)),
    "pixel centres": on_pixel_centres(),
    "nothing": Scene((), CAMERA, (8, 8), background=(1, 2, 3, 255)),
}


@pytest.mark.parametrize("stacked", [False, True], ids=["flat", "stacked"])
@pytest.mark.parametrize("name", SCENES)
def test_opengl_draws_what_our_rasteriser_draws(name: str, stacked: bool) -> None:
    """Coverage equal but for 0.1 % of the samples; elsewhere colours within 2/255.

    A colour counts by its weight: at an alpha of 3 a channel has three visible steps.
    """
    ours = soft.draw_scene(SCENES[name]).pixels.astype(int)
    theirs = gl.draw_scene(SCENES[name], stacked=stacked).pixels.astype(int)
    weighed = [np.dstack([p[..., :3] * p[..., 3:] / 255, p[..., 3]]) for p in (ours, theirs)]
    covered = ours[..., 3] > 0
    assert name == "nothing" or covered.mean() > 0.05
    assert (covered != (theirs[..., 3] > 0)).mean() <= 0.001
    off = np.abs(weighed[0] - weighed[1]).max(axis=-1) > 2.5
    assert off.mean() <= 0.001 * SCENES[name].samples


def test_opengl_casts_the_shadows_of_our_rasteriser() -> None:
    """Colours within 2/255 but for 0.1 % of the pixels, of which shadows darken a tenth."""
    settings = Settings(size=(160, 200), view="hero", samples=4, finish="plain")
    scene = still(Banner.parse("white creeper:lime border:black"), open_packs(()), settings)
    plain = replace(scene, light=replace(scene.light, shadows=False))
    ours = soft.draw_scene(scene).pixels.astype(int)
    theirs, bare = (gl.draw_scene(each).pixels.astype(int) for each in (scene, plain))
    assert (np.abs(theirs - bare).max(axis=-1) > 2).mean() > 0.1
    assert (np.abs(theirs - ours).max(axis=-1) > 2).mean() <= 0.001
    assert np.array_equal(gl.draw_scene(scene).pixels, theirs)


@pytest.mark.parametrize("name", SCENES)
def test_opengl_has_the_buffers_of_our_rasteriser(name: str) -> None:
    """The same surface but for 0.1 % of the pixels, and there the same to the precision."""
    assert_alike(SCENES[name])


def test_opengl_has_the_buffers_of_a_banner_on_its_block() -> None:
    settings = Settings(size=(160, 200), view="hero", light="game")
    scene = still(Banner.parse("white creeper:lime border:black"), open_packs(()), settings)
    found = assert_alike(scene)
    assert len(np.unique(found.material)) > 3
    frame, make_buffers = draw_with_buffers(scene, gl.draw_scene)
    assert np.array_equal(make_buffers().depth, found.depth)
    assert np.array_equal(frame.pixels, gl.draw_scene(scene).pixels)


def assert_alike(scene: Scene) -> Buffers:
    ours, theirs = soft.draw_buffers(scene), gl.draw_buffers(scene)
    for each in fields(Buffers):
        one, other = getattr(ours, each.name), getattr(theirs, each.name)
        assert one.shape == other.shape and one.dtype == other.dtype, each.name
    same = (ours.model == theirs.model) & (ours.material == theirs.material)
    assert (~same).mean() <= 0.001
    seen = same & ours.coverage
    assert np.isinf(theirs.depth[~theirs.coverage]).all()
    for name, tolerance in (("depth", 1e-3), ("normal", 2e-2), ("uv", 2e-3)):
        apart = np.abs(getattr(ours, name)[seen] - getattr(theirs, name)[seen])
        assert (apart > tolerance).mean() <= 0.001 if len(apart) else True, name
    return theirs


def test_edges_on_pixel_centres_belong_to_the_same_pixels() -> None:
    scene = SCENES["pixel centres"]
    ours, theirs = (draw(scene).pixels for draw in (soft.draw_scene, gl.draw_scene))
    assert np.array_equal(ours[..., 3], theirs[..., 3])


def test_every_frame_has_its_own_vertices_and_the_same_bits_again() -> None:
    scenes = [
        replace(SCENES["layers"], models=(replace(SOLID, mesh=moved(SOLID.mesh, x, 0, 0)),))
        for x in (0.0, 0.4)
    ]
    first, second = (gl.draw_scene(scene).pixels for scene in scenes)
    assert not np.array_equal(first, second)
    gl.draw_scene(SCENES["alpha"])
    gl.draw_scene(replace(scenes[0], size=(64, 32)))
    assert np.array_equal(gl.draw_scene(scenes[0]).pixels, first)
    assert np.array_equal(gl.draw_scene(scenes[1]).pixels, second)


def test_any_thread_may_draw() -> None:
    pictures: list[np.ndarray] = []
    threads = [
        threading.Thread(target=lambda: pictures.append(gl.draw_scene(SCENES["alpha"]).pixels))
        for _ in range(3)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    pictures.append(gl.draw_scene(SCENES["alpha"]).pixels)
    assert len(pictures) == 4 and all(np.array_equal(pictures[0], other) for other in pictures)


def resident() -> float:
    """Memory of this process [MB]."""
    gc.collect()
    pages = int(Path("/proc/self/statm").read_text(encoding="utf-8").split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") / 1e6


def growth(draw: Callable[[int], object], warm: int, count: int) -> float:
    for number in range(warm):
        draw(number)
    before = resident()
    for number in range(count):
        draw(number)
    return resident() - before


def test_memory_stays_flat_over_frames() -> None:
    def draw(number: int) -> None:
        mesh = moved(SOLID.mesh, 0.001 * number, 0, 0)
        gl.draw_scene(Scene((replace(SOLID, mesh=mesh),), CAMERA, (128, 128)))

    assert growth(draw, 60, 300) < 2


def test_memory_stays_flat_over_scenes_and_sizes() -> None:
    def draw(number: int) -> None:
        materials = (Material((TextureLayer(texture(number, 256)),)),)
        model = Model(sheet(number, cells=40), materials)
        gl.draw_scene(Scene((model,), CAMERA, (64 + number % 7, 64)))

    assert growth(draw, 40, 120) < 8


def test_bad_scenes_are_refused() -> None:
    broken = replace(SOLID.mesh, positions=np.where(SOLID.mesh.positions > 0.9, np.nan, 0.1))
    scene = SCENES["layers"]
    for bad, message in [
        (replace(scene, models=(SOLID, replace(SOLID, mesh=broken))), "model 1 has positions"),
        (replace(scene, size=(0, 10)), "size 0x10"),
        (replace(scene, size=(100_000, 10)), "size 100000x10"),
        (replace(scene, samples=3), "samples 3"),
        (replace(scene, camera=Camera((0, 0, 0), (0, 0, 0))), "camera"),
    ]:
        with np.errstate(all="ignore"), pytest.raises(OptionError, match=message):
            gl.draw_scene(bad)


def test_missing_parts_are_named_with_what_installs_them(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("PYOPENGL_PLATFORM", raising=False)
    monkeypatch.setattr(gl_platform, "pyrender_installed", lambda: False)
    with pytest.raises(BackendError, match=r'pip install "drapery-mc\[gl\]"$'):
        gl_platform.load_pyrender()
    monkeypatch.undo()
    monkeypatch.delenv("PYOPENGL_PLATFORM", raising=False)
    monkeypatch.setattr(gl_platform, "loaded_library", lambda name: None)
    with pytest.raises(BackendError, match=r"libGL.so.1 is missing.*apt-get install .*libegl1"):
        gl_platform.load_pyrender()


def test_the_named_device_is_the_one_that_starts(monkeypatch: pytest.MonkeyPatch) -> None:
    first = gl_platform.probe_egl()
    if not first.works:
        pytest.skip(f"EGL does not start: {first.missing}")
    monkeypatch.setenv("EGL_DEVICE_ID", str(first.device))
    assert gl_platform.probe_egl() == first
    monkeypatch.setenv("EGL_DEVICE_ID", "63")
    assert gl_platform.probe_egl().missing == "no EGL device 63 starts"


FORKED = """
import os
from drapery import BackendError
from drapery.render import Camera, Scene
from drapery.render.gl import draw_scene

scene = Scene((), Camera((0, 0, 3), (0, 0, 0)), (16, 16))
draw_scene(scene)
child = os.fork()
if child == 0:
    try:
        draw_scene(scene)
    except BackendError:
        os._exit(7)
    os._exit(1)
assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 7
draw_scene(scene)
"""


def test_a_forked_process_is_refused() -> None:
    # In a process of one thread: Python warns of a fork of several.
    done = subprocess.run([sys.executable, "-c", FORKED], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def test_absurd_meshes_are_drawn_without_harm() -> None:
    """Zero area, far aside, behind the camera, before the near plane, wider than float32."""
    random = np.random.default_rng(9)
    for size in (0.0, 1e-30, 1.0, 1e6, 1e20, 3e38):
        positions = (size * random.uniform(-1, 1, (300, 3))).astype(np.float32)
        triangles = np.arange(300, dtype=np.int32).reshape(-1, 3)
        normals = np.tile(np.float32([0, 1, 0]), (300, 1))
        mesh = Mesh(positions, normals, triangles, random.uniform(0, 1, (300, 2)))
        scene = Scene((Model(mesh, (Material(LAYERS[:1]),)),), CAMERA, (64, 64))
        assert gl.draw_scene(scene).pixels.shape == (64, 64, 4)


def test_the_doctor_knows_what_works() -> None:
    reports = {report.name: report for report in doctor.backend_report()}
    assert reports["soft"].works and reports["pyrender"].works and reports["video"].works
    assert reports["pyrender"].detail == gl.describe()


@pytest.mark.parametrize(
    ("program", "detail"),
    [
        ("import os; os.abort()", "crashed with signal 6"),
        ("raise SystemExit('no')", "no"),
    ],
)
def test_the_doctor_survives_a_crash_of_opengl(
    monkeypatch: pytest.MonkeyPatch, program: str, detail: str
) -> None:
    monkeypatch.setattr(doctor, "DRAW_GL", program)
    reports = {report.name: report for report in doctor.backend_report()}
    assert not reports["pyrender"].works
    assert detail in reports["pyrender"].detail and "apt-get" in reports["pyrender"].remedy


def test_a_process_that_drew_ends_quietly() -> None:
    child = subprocess.run(
        [sys.executable, "-c", doctor.DRAW_GL], capture_output=True, text=True, timeout=60
    )
    assert (child.returncode, child.stderr) == (0, "")
