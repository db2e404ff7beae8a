"""The public names of `drapery.render`, and pictures of meshes in a line or two."""

import ast
import inspect
from pathlib import Path

import numpy as np
import pytest

import drapery.render
from drapery.errors import OptionError
from drapery.render import Camera, draw_models, draw_scene, frame_view, make_mesh, make_model

SQUARE = make_mesh([(-1, 1, 0), (1, 1, 0), (-1, -1, 0), (1, -1, 0)], [(0, 2, 1), (1, 2, 3)])


def test_a_mesh_in_one_line_fills_its_picture() -> None:
    frame = draw_models(
        [make_model(SQUARE, colour="#c80032", lit=False)], view="front", size=(20, 20)
    )
    assert (frame.pixels[2:-2, 2:-2] == (200, 0, 50, 255)).all()
    assert not frame.pixels[0].any()


def test_a_bare_mesh_is_white_and_a_camera_replaces_the_view() -> None:
    camera = Camera((0, 0, 5), (0, 0, 0), height=4.0)
    frame = draw_models([SQUARE], camera=camera, size=(8, 8), samples=1, background="black")
    assert (frame.pixels[2:6, 2:6, :3].min() > 150) and (frame.pixels[0] == (0, 0, 0, 255)).all()


def test_a_texture_of_three_channels_is_opaque_and_the_colour_multiplies_it() -> None:
    texture = np.full((2, 2, 3), 200, np.uint8)
    model = make_model(SQUARE, texture=texture, colour=(255, 0, 51), lit=False)
    pixels = draw_models([model], view="front", size=(8, 8)).pixels
    assert (pixels[3, 3] == (200, 0, 40, 255)).all()


def test_the_line_and_the_scene_are_the_same_picture() -> None:
    model = make_model(SQUARE, colour="red")
    camera = frame_view("iso", SQUARE.positions, 1.0)
    scene = drapery.render.Scene((model,), camera, (32, 32), samples=4)
    assert (draw_scene(scene).pixels == draw_models([model], size=(32, 32)).pixels).all()


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: make_model(SQUARE, colour="reddish"), "colour 'reddish' is not a colour"),
        (lambda: make_model(SQUARE, colour=(1, 2, 256)), "is not a colour"),
        (lambda: make_model(SQUARE, texture=np.zeros((4, 4, 3))), "type float64; use"),
        (lambda: draw_models([]), "there is nothing to frame"),
        (lambda: draw_models([SQUARE], view="side"), "view 'side' is not known"),
        (lambda: make_mesh(np.zeros((3, 2)), [(0, 1, 2)]), r"use \[\.\.\., V, 3\]"),
        (lambda: make_mesh(np.full((3, 3), np.nan), [(0, 1, 2)]), "finite numbers"),
        (lambda: make_mesh(np.zeros((3, 3)), [(0, 1, 3)]), "outside the 3 positions"),
        (lambda: make_mesh(np.zeros((3, 3)), [(0, 1, 2.0)]), "of integers"),
        (lambda: make_mesh(np.zeros((3, 3)), [(0, 1, 2)], [(0, 0)]), r"use \(3, 2\)"),
    ],
)
def test_bad_input_is_refused_in_one_line(make: object, message: str) -> None:
    with pytest.raises(OptionError, match=message) as raised:
        make()  # type: ignore[operator]
    assert "\n" not in str(raised.value)


def test_numbers_of_a_mesh_keep_their_precision() -> None:
    single = make_mesh(SQUARE.positions.astype(np.float32), SQUARE.triangles)
    assert single.positions.dtype == single.normals.dtype == np.float32
    assert (single.normals == (0, 0, 1)).all()


def test_no_circle_of_imports() -> None:
    """Imports inside functions count; those for type checkers alone do not."""
    folder = Path(inspect.getfile(drapery.render)).parent
    imports = {}
    for path in folder.rglob("*.py"):
        parts = path.relative_to(folder).with_suffix("").parts
        name = ".".join(("drapery.render", *parts)).removesuffix(".__init__")
        imports[name] = _imported(ast.parse(path.read_text(encoding="utf-8")))
    # Modules that import no module left in the table are taken out until none is left.
    while imports:
        free = [name for name, others in imports.items() if not others & (imports.keys() - {name})]
        assert free, f"a circle among {sorted(imports)}"
        for name in free:
            del imports[name]


def _imported(tree: ast.AST) -> set[str]:
    found: set[str] = set()
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, ast.If) and "TYPE_CHECKING" in ast.unparse(node.test):
            continue
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            found |= {str(node.module), *(f"{node.module}.{alias.name}" for alias in node.names)}
        found |= _imported(node)
    return found


@pytest.mark.parametrize(
    "models", [[], [make_model(make_mesh(np.zeros((0, 3)), np.zeros((0, 3), int)))]]
)
def test_a_shadow_of_nothing_is_refused(models: list[drapery.render.Model]) -> None:
    with pytest.raises(OptionError, match="needs models with finite positions"):
        drapery.render.contact_shadow(models, 0.0)
