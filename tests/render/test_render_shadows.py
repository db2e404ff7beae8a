"""Cast shadows and ambient occlusion lie where geometry puts them, and nowhere else."""

import hashlib
from dataclasses import replace

import numpy as np
import pytest
from render_shapes import mesh, painted

from drapery.mesh import Mesh, vertex_normals
from drapery.render.camera import Camera
from drapery.render.light import STUDIO_LIGHT, Light
from drapery.render.scene import Material, Model, Scene, TextureLayer
from drapery.render.soft import draw_scene

SUN = Light(((1.0, 1.0, 0.0),), 0.25, 0.75 * 2**0.5, shadows=True)
"""From the right, halfway up: ground in its light is fully bright, in shadow a quarter."""
WHITE = painted(255, 255, 255, 255, lit=True)
SIZE = (200, 200)
ABOVE = Camera((0, 10, 0), (0, 0, 0), up=(0, 0, -1), height=2.0, near=1, far=20)
"""Straight down on 2 x 2 m: a pixel is 1 cm, x to the right."""


def level(left: float, right: float, height: float, depth: float = 1.0) -> Mesh:
    """A horizontal rectangle that faces up."""
    corners = [(left, height, -depth), (right, height, -depth)]
    corners += [(left, height, depth), (right, height, depth)]
    flat = mesh(corners, [(0, 2, 1), (1, 2, 3)])
    return replace(flat, normals=np.tile(np.array([0, 1, 0], np.float32), (4, 1)))


def scene(*models: Model, light: Light = SUN, **more: object) -> Scene:
    return Scene(models, ABOVE, SIZE, light, **more)  # type: ignore[arg-type]


GROUND = Model(level(-3, 3, 0, 3), (WHITE,))
BOARD = Model(level(0.6, 0.9, 0.8, 0.5), (WHITE,))
"""Its shadow lies at x -0.2 to 0.1."""


def reds(picture: Scene) -> np.ndarray:
    return draw_scene(picture, threads=1).pixels[..., 0].astype(int)


@pytest.mark.parametrize("samples", [1, 4, 16])
def test_a_board_casts_its_shadow_where_the_light_says(samples: int) -> None:
    row = reds(scene(GROUND, BOARD, samples=samples))[100]
    assert (row[3:76] == 255).all() and (row[84:106] == 64).all() and (row[114:158] == 255).all()
    for edge in (slice(76, 84), slice(106, 114)):
        assert row[edge].min() >= 64 and row[edge].max() <= 255
    column = reds(scene(GROUND, BOARD, samples=samples))[:, 95]
    assert (column[:46] == 255).all() and (column[54:146] == 64).all()


def test_without_shadows_the_light_is_that_of_the_game() -> None:
    assert (reds(scene(GROUND, BOARD, light=replace(SUN, shadows=False))) == 255).all()


@pytest.mark.parametrize(
    "material",
    [
        Material(painted(255, 255, 255, 255).layers, "opaque", lit=False),
        Material(painted(255, 255, 255, 90).layers, "blend"),
        Material(painted(255, 255, 255, 0).layers, "cutout"),
    ],
)
def test_what_glows_blends_or_is_cut_out_casts_no_shadow(material: Material) -> None:
    assert (reds(scene(GROUND, replace(BOARD, materials=(material,))))[100, :150] == 255).all()


def test_a_hole_in_a_board_lets_the_light_through() -> None:
    texels = np.full((1, 2, 4), 255, np.uint8)
    texels[0, 0, 3] = 0  # the left half, whose shadow would lie at x -0.2 to -0.05
    board = replace(
        BOARD,
        mesh=replace(BOARD.mesh, uvs=np.array([(0, 0), (1, 0), (0, 1), (1, 1)], np.float32)),
        materials=(Material((TextureLayer(texels),), "cutout"),),
    )
    row = reds(scene(GROUND, board))[100]
    assert (row[3:90] == 255).all() and (row[99:106] == 64).all()


def test_a_curved_sheet_alone_in_the_light_has_no_shadow_of_its_own() -> None:
    u, v = np.meshgrid(np.linspace(-0.9, 0.9, 25), np.linspace(-0.9, 0.9, 25))
    points = np.stack([u, 0.4 - 0.4 * u * u, v], axis=-1).reshape(-1, 3)
    a = (np.arange(24)[:, None] * 25 + np.arange(24)).reshape(-1)
    triangles = np.stack([a, a + 25, a + 1, a + 1, a + 25, a + 26], axis=-1).reshape(-1, 3)
    triangles = triangles.astype(np.int32)
    normals = vertex_normals(points, triangles)
    hill = Model(Mesh(points, normals, triangles, np.zeros((625, 2))), (WHITE,))
    with_shadows, without = reds(scene(hill)), reds(scene(hill, light=replace(SUN, shadows=False)))
    assert np.abs(with_shadows - without).max() <= 2


def test_a_fold_is_darker_inside_than_outside() -> None:
    u, v = np.meshgrid(np.linspace(-0.8, 0.8, 33), np.linspace(-0.9, 0.9, 33))
    points = np.stack([u, 0.5 * np.cos(np.pi * u / 0.4) * 0.8, v], axis=-1).reshape(-1, 3)
    a = (np.arange(32)[:, None] * 33 + np.arange(32)).reshape(-1)
    triangles = np.stack([a, a + 33, a + 1, a + 1, a + 33, a + 34], axis=-1).reshape(-1, 3)
    triangles = triangles.astype(np.int32)
    folds = Mesh(points, vertex_normals(points, triangles), triangles, np.zeros((1089, 2)))
    sky = Light(((0.0, -1.0, 0.0),), 1.0, 0.0, shadows=True)
    row = reds(scene(Model(folds, (WHITE,)), light=sky))[100]
    ridge, valley = row[100], (row[60] + row[140]) / 2
    assert ridge > 240 and valley < ridge - 60


def test_threads_and_runs_change_no_bit() -> None:
    picture = scene(GROUND, BOARD, light=STUDIO_LIGHT, samples=4)
    digests = {
        hashlib.sha256(draw_scene(picture, threads=threads).pixels.tobytes()).hexdigest()
        for threads in (1, 2, 3, 1)
    }
    assert len(digests) == 1


def test_ground_that_reaches_behind_the_camera_keeps_its_shadows() -> None:
    near = Camera((0, 0.7, 2.5), (-0.05, 0, 0), fov=50)
    far_ground = Model(level(-6, 6, 0, 6), (WHITE,))
    far, short = (
        reds(replace(scene(ground, BOARD), camera=near)) for ground in (far_ground, GROUND)
    )
    assert far[100, 100] == short[100, 100] == 64
    assert far[198, 10] == 255


def test_an_empty_scene_can_be_lit_for_shadows() -> None:
    assert (reds(Scene((), ABOVE, SIZE, SUN)) == 0).all()


def test_light_shines_through_cloth_from_its_far_side() -> None:
    board = Model(level(-0.9, 0.9, 0.0, 0.9), (WHITE,))
    below = replace(board, mesh=replace(board.mesh, normals=-board.mesh.normals))
    thin = replace(below, materials=(replace(WHITE, transmission=0.4),))
    assert reds(scene(below))[100, 100] == 64  # a quarter, what is ambient
    assert reds(scene(thin))[100, 100] == round(255 * (0.25 + 0.4 * 0.75))
    # The side that the light falls on stays as it is.
    lit = replace(board, materials=thin.materials)
    assert np.array_equal(reds(scene(board)), reds(scene(lit)))


@pytest.mark.parametrize("thickness", [0.005, 0.04])
def test_the_far_side_of_thin_cloth_hides_no_sky_from_its_near_side(thickness: float) -> None:
    u, v = np.meshgrid(np.linspace(-0.8, 0.8, 33), np.linspace(-0.8, 0.8, 33))
    points = np.stack([u, 0.05 * np.cos(np.pi * u / 0.4), v], axis=-1).reshape(-1, 3)
    a = (np.arange(32)[:, None] * 33 + np.arange(32)).reshape(-1)
    triangles = np.stack([a, a + 33, a + 1, a + 1, a + 33, a + 34], axis=-1).reshape(-1, 3)
    triangles = triangles.astype(np.int32)
    normals = vertex_normals(points, triangles)
    near = Mesh(points, normals, triangles, np.zeros((1089, 2)))
    far = replace(near, positions=points - (0, thickness, 0), normals=-normals)
    sky = Light(((0.0, -1.0, 0.0),), 1.0, 0.0, shadows=True)
    alone, both = (
        reds(scene(*(Model(side, (WHITE,)) for side in sides), light=sky))[100]
        for sides in ((near,), (near, far))
    )
    # The maps have 60 samples across, so single places differ by a few in 255 in both directions.
    assert abs(alone.mean() - both.mean()) < 2 and np.abs(alone - both).max() <= 10
    assert both[21:179].min() > 230
