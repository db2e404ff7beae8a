"""Models merged into one list; textures packed into one sheet."""

import numpy as np
import pytest
from hypothesis import given, strategies as st
from render_shapes import noise, painted, plain, quad

from drapery.errors import OptionError
from drapery.mesh import Mesh
from drapery.render.atlas import FEW_SIZES, PADDING, make_atlas
from drapery.render.drawlist import draw_list, make_topology
from drapery.render.light import GAME_LIGHT
from drapery.render.materials import make_material_tables
from drapery.render.scene import Material, Model, TextureLayer

SIZES = st.lists(st.tuples(st.integers(1, 70), st.integers(1, 70)), min_size=1, max_size=40)


@given(SIZES)
def test_an_atlas_keeps_each_sprite_and_its_border(sizes: list[tuple[int, int]]) -> None:
    """Around each sprite lie copies of its border; so no two lie on one another."""
    sprites = [noise(i, *size) for i, size in enumerate(sizes)]
    atlas = make_atlas(sprites)
    for sprite, (x, y, width, height) in zip(sprites, atlas.rects, strict=True):
        assert (height, width) == sprite.shape[:2]
        around = atlas.texels[y - PADDING : y + height + PADDING, x - PADDING : x + width + PADDING]
        padding = ((PADDING, PADDING), (PADDING, PADDING), (0, 0))
        assert (around == np.pad(sprite, padding, mode="edge")).all()


@given(SIZES)
def test_an_atlas_wastes_little(sizes: list[tuple[int, int]]) -> None:
    atlas = make_atlas([np.zeros((*size, 4), np.uint8) for size in sizes])
    needed = sum((w + 2) * (h + 2) for w, h in sizes)
    longest = max(max(size) for size in sizes) + 2
    # In a block for each of a few sizes, the last row may be almost empty.
    rows = FEW_SIZES * longest * (needed**0.5 + 2 * longest)
    assert atlas.texels.shape[0] * atlas.texels.shape[1] <= 2.2 * needed + rows


def test_sprites_of_one_size_lie_in_a_grid_without_a_packer() -> None:
    import sys

    trimesh = sys.modules.pop("trimesh.path.packing", None)
    try:
        atlas = make_atlas([np.zeros((64, 64, 4), np.uint8)] * 60)
        assert "trimesh.path.packing" not in sys.modules
        assert atlas.texels.shape[:2] == (8 * 66, 8 * 66)
    finally:
        if trimesh:
            sys.modules["trimesh.path.packing"] = trimesh


def test_each_texture_is_packed_once() -> None:
    """However many layers wear it, in whatever tint, and if it was loaded twice."""
    texels = noise(1, 16, 16)
    layers = [TextureLayer(texels, (i, 0, 0)) for i in range(50)] + [TextureLayer(texels.copy())]
    worn = make_material_tables([Material((layer,)) for layer in layers])
    assert len(np.unique(worn.layer_rects, axis=0)) == 1
    assert worn.atlas.shape == (18, 18, 4)
    assert (worn.layer_tints[:50, 0] == np.arange(50)).all()


def crowd(count: int = 30) -> Model:
    one = quad()
    positions = np.random.default_rng(0).random((count, 4, 3)).astype(np.float32)
    normals = np.broadcast_to(one.normals, positions.shape).copy()
    index = (np.arange(count) % 2).astype(np.int32)
    shape = Mesh(positions, normals, one.triangles, one.uvs)
    return Model(shape, (painted(1, 2, 3, 255, lit=True), painted(4, 5, 6, 255)), index)


def test_a_merged_list_holds_every_model_in_order() -> None:
    first, batch = Model(quad(), (painted(9, 9, 9, 255),)), crowd()
    merged = draw_list((first, batch))
    constant = merged.topology
    assert (merged.positions[:4] == first.mesh.positions).all()
    assert (merged.positions[4:] == batch.mesh.positions.reshape(-1, 3)).all()
    assert constant.vertex_start.tolist() == [0, 4, 4 + 4 * 30]
    for member in range(30):
        part = constant.triangles[2 + 2 * member : 4 + 2 * member]
        assert (part == batch.mesh.triangles + 4 + 4 * member).all()
    assert constant.triangle_material.tolist() == [0, 0] + [1, 1, 2, 2] * 15
    tints = constant.material_tables.layer_rects[constant.triangle_material]
    assert len(np.unique(tints, axis=0)) == 3


def test_lit_materials_have_the_brightness_of_the_light() -> None:
    batch = crowd()
    lit = GAME_LIGHT.brightness(batch.mesh.normals)
    lit[1::2] = 1
    assert (draw_list((batch,)).brightness(GAME_LIGHT) == lit.ravel()).all()


def test_what_does_not_move_is_prepared_once() -> None:
    batch = crowd()
    moved = Mesh(batch.mesh.positions + 1, batch.mesh.normals, batch.mesh.triangles, batch.mesh.uvs)
    again = Model(moved, batch.materials, batch.material_index)
    assert make_topology((batch,)) is make_topology((again,))
    other = Model(batch.mesh, batch.materials, batch.material_index[::-1].copy())
    assert make_topology((other,)) is not make_topology((batch,))


def bad(**change: object) -> Model:
    shape = quad()
    parts = {name: getattr(shape, name) for name in ("positions", "normals", "triangles", "uvs")}
    return Model(Mesh(**{**parts, **change}), (painted(1, 2, 3, 4),))  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("model", "words"),
    [
        (bad(triangles=np.array([[0, 1, 4]])), "model 1: its triangles name vertices outside 0..3"),
        (bad(triangles=np.array([[0, 1, -1]])), "model 1: its triangles name vertices outside"),
        (bad(triangles=np.array([[0, 1, 2, 3]])), r"triangles have shape \(1, 4\); use \[T, 3\]"),
        (bad(uvs=np.zeros((3, 2))), r"model 1: uvs have shape \(3, 2\)"),
        (bad(uvs=np.full((4, 2), np.nan)), "model 1: uvs have shape .* all finite"),
        (bad(normals=np.zeros((3, 3))), r"model 1: normals have shape \(3, 3\)"),
        (bad(positions=np.zeros((4, 2)), normals=np.zeros((4, 2))), "model 1: positions have"),
        (
            Model(quad(), (painted(1, 2, 3, 4),), np.array([1])),
            "material_index names materials outside",
        ),
        (Model(quad(), (painted(1, 2, 3, 4),), np.array([0, 0])), "material_index have shape"),
        (Model(quad(), (Material(()),)), "material 1 has no layers"),
        (
            Model(quad(), (Material((TextureLayer(np.zeros((4, 4, 3), np.uint8)),)),)),
            "cannot be drawn",
        ),
        (
            Model(quad(), (Material((TextureLayer(np.zeros((4, 4, 4))),)),)),
            "type float64 cannot be drawn",
        ),  # type: ignore[arg-type]
        (
            Model(quad(), (Material((TextureLayer(np.zeros((0, 4, 4), np.uint8)),)),)),
            "cannot be drawn",
        ),
        (
            Model(quad(), (Material((TextureLayer(np.zeros((1, 16385, 4), np.uint8)),)),)),
            "1 to 16384",
        ),
    ],
)
def test_arrays_that_do_not_fit_are_refused(model: Model, words: str) -> None:
    with pytest.raises(OptionError, match=words):
        draw_list((Model(quad(), (Material((plain(1, 1, 1, 1),)),)), model))
