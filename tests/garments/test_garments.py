"""Garments as data: files, faults, shapes, seams, textures, and their pictures."""

import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh
from conftest import Run
from cost import limited_cost
from PIL import Image
from pydantic import ValidationError

from drapery import Banner, draw, iter_frames, mesh_headers, save_model
from drapery.cloth import max_stretch
from drapery.commands.app import command_line
from drapery.errors import OptionError
from drapery.garments import (
    ClothTexture,
    Garment,
    GarmentMesh,
    GarmentPin,
    GarmentSeam,
    GarmentWearer,
    GridPiece,
    PolygonPiece,
    RingPiece,
    StripPiece,
    find_garment,
    garment_names,
    meshes,
    tailor,
)
from drapery.garments.loading import MAX_BYTES
from drapery.garments.meshes import read_stiff_mesh
from drapery.garments.model import MAX_POINTS
from drapery.garments.players import dressed_player, make_wearer, player_of
from drapery.garments.shapes import cut_pieces
from drapery.garments.textures import texture_of
from drapery.mesh import face_normals, vertex_normals
from drapery.packs import open_packs
from drapery.player_settings import PlayerSettings
from drapery.scenes import Dressed, Schedule
from drapery.settings import Settings
from drapery.sheets import garments_sheet
from drapery.style.block import FLAG_MAPPING
from drapery.style.figure import TEXEL, cape_mapping
from drapery.testing import check_garment
from drapery.testing.plugin import Golden

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "guides" / "garments.md").read_text(encoding="utf-8")
FILES = ROOT / "drapery" / "garments" / "files"
CAPE = """\
description = "A cape"
fabric = "wool"
[wearer]
speed = 2.5
[[piece]]
name = "cape"
size = [10, 16]
points = [6, 9]
texture = { pack = "entity/player/cape" }
[[pin]]
piece = "cape"
at = "top"
to = "body"
"""


def load(text: str, folder: Path) -> Garment:
    path = folder / "mine.toml"
    path.write_text(text, encoding="utf-8")
    return Garment.load(path)


def flat(**fields: object) -> Garment:
    """A garment of one piece, a grid unless given."""
    piece = fields.pop("piece", GridPiece(name="cloth", size=(8, 12), points=(5, 7)))
    pieces = piece if isinstance(piece, tuple) else (piece,)
    return Garment(piece=pieces, **fields)  # type: ignore[arg-type]


@pytest.mark.parametrize("name", garment_names())
def test_a_file_of_the_package_is_short_and_complete(name: str) -> None:
    lines = (FILES / f"{name}.toml").read_text(encoding="utf-8").splitlines()
    assert len(lines) <= 25 and max(map(len, lines)) <= 130
    garment = find_garment(name)
    assert garment.name == name and garment.description and garment.picture
    assert f"`{name}`" in PAGE
    for sewn in tailor(garment, open_packs(())):
        assert (sewn.cloth.inv_mass == 0).any() == (name not in ("drape", "freefall"))


@pytest.mark.parametrize(
    ("old", "new", "line", "said"),
    [
        ("wool", "wol", 2, "fabric 'wol' is not known; use one of: wool, cotton"),
        ('"wool"', "{ density = -1 }", 2, "fabric density -1 is out of range; use a number"),
        ('"wool"', "{ weight = 1 }", 2, "fabric has no weight; use some of: density"),
        ("speed = 2.5", "speed = 25", 4, "speed 25 cannot be used; it should be less than"),
        ("speed = 2.5", 'solid = ["tail"]', 3, "solid 'tail' is not a bone; use some of: head"),
        ('name = "cape"', 'name = "Cape"', 6, "name 'Cape' cannot be used; it should match"),
        ("[10, 16]", "[10, true]", 7, "size True cannot be used; it should be a number"),
        ("size = [10, 16]\n", "", 5, "size is missing; add it"),
        ("[10, 16]", "[10]", 7, "size has too few values: 1; give at least 2"),
        ("size", "extent", 7, "extent is not a field here; use one of: name, place, turn"),
        ("points = [6, 9]", 'shape = "tube"', 5, "shape 'tube' is not known; use one of: grid"),
        ("points = [6, 9]", "points = [6, 99]", 8, "points 99 cannot be used"),
        ("{ pack =", '{ block = "stone", pack =', 9, "texture has both block and pack"),
        ("{ pack =", "{ packs =", 9, "packs is not a field here; use one of: block, dye"),
        ('{ pack = "entity/player/cape" }', '{ design = "wite" }', 9, "wite"),
        ('piece = "cape"', 'piece = "cap"', 11, "piece 'cap' is not known; use one of: cape"),
        ('to = "body"', 'to = "tail"', 13, "to 'tail' is not known; use one of: fixed, head"),
        ("[wearer]", "colour = 1\n[wearer]", 3, "colour is not a field here; use one of"),
        ("[wearer]", "picture = { wnd = 3 }\n[wearer]", 3, "did you mean wind"),
        ("[wearer]", "picture = { wind = 99 }\n[wearer]", 3, "wind 99 is out of range; use 0"),
        ("[wearer]", "picture = { grid = '5x9' }\n[wearer]", 3, "'grid' is not an option"),
        ("description", "name", 1, "name is taken from the file's path; leave it out"),
        ("[wearer]", "mesh = [{ file = 'a.txt' }]\n[wearer]", 3, "file 'a.txt' is not a 3-D file"),
    ],
)
def test_a_fault_names_the_line_and_the_remedy(
    old: str, new: str, line: int, said: str, tmp_path: Path
) -> None:
    with pytest.raises(OptionError, match=f"mine.toml line {line}: .*{re.escape(said)}"):
        load(CAPE.replace(old, new, 1), tmp_path)


def test_a_garment_has_a_largest_number_of_particles(tmp_path: Path) -> None:
    def pieces(count: int, mirror: str = "") -> str:
        return "".join(
            f'[[piece]]\nname = "p{n}"\nsize = [16, 16]\npoints = [65, 63]\n{mirror.format(n)}'
            for n in range(count)
        )

    assert load(pieces(4), tmp_path).particles == 4 * 65 * 63 <= MAX_POINTS
    with limited_cost(), pytest.raises(OptionError) as caught:
        load(pieces(64), tmp_path)
    assert str(caught.value) == (
        f"{tmp_path / 'mine.toml'} line 20: with piece p4 the garment has 20475 particles; at most"
        f" {MAX_POINTS} are drawn: give its pieces fewer, or leave some out"
    )
    with pytest.raises(OptionError, match=r"line 14: with piece p2 the garment has 24570 parti"):
        load(pieces(4, 'mirror = "q{}"\n'), tmp_path)
    half = load(pieces(3), tmp_path)
    with pytest.raises(OptionError, match=r"over has 24570 particles, 12285 of them in mine; at"):
        dressed_player(make_wearer(), wear=(half, half))


SHAPES = {
    "grid": "size = [{0}, {0}]\npoints = [65, 2]",
    "strip": "shape = 'strip'\nlength = {0}\nends = [[0, 0, 0], [{0}, 0, 0]]\npoints = 65",
    "ring": "shape = 'ring'\nprofile = [[{0}, 9, 9], [0, 9, 9]]\npoints = [4, 65]",
    "narrow ring": "shape = 'ring'\nprofile = [[9, {1}, {1}], [0, {1}, {1}]]\npoints = [64, 3]",
    "disc": "shape = 'disc'\nradius = {1}\nrings = 32",
    "polygon": "shape = 'polygon'\ncorners = [[0, 0], [3, 0], [0, 3]]\nspacing = {2}",
}
"""Pieces of a size, of a radius, and of a distance [texels]."""


@pytest.mark.parametrize("shape", SHAPES)
def test_particles_have_a_least_distance(shape: str, tmp_path: Path) -> None:
    text = '[[piece]]\nname = "a"\n' + SHAPES[shape]
    made = load(text.format(8, 8, 0.125), tmp_path)
    (cut,) = cut_pieces(made)
    assert math.isclose(len(cut.cloth.inv_mass), made.particles, rel_tol=0.1)
    with (
        limited_cost(),
        pytest.raises(OptionError, match=r"line \d: (\w+) of piece a puts") as seen,
    ):
        load(text.format(0.01, 0.01, 0.09), tmp_path)
    assert re.search(
        "texels apart, and the least is 0.1; use .* or a larger piece", str(seen.value)
    )


def test_a_file_of_a_garment_has_a_largest_size(tmp_path: Path) -> None:
    with pytest.raises(OptionError, match="a garment is shorter"):
        load("#" * (MAX_BYTES + 1), tmp_path)


def test_names_of_pieces_and_garments_are_checked() -> None:
    piece = GridPiece(name="cloth", size=(8, 12), points=(5, 7), mirror="cloth")
    with pytest.raises(ValidationError, match="mirror 'cloth' is taken"):
        flat(piece=piece)
    with pytest.raises(OptionError, match=r"garment 'toga' is not known; use a file .* awning"):
        find_garment("toga")


@pytest.mark.parametrize(
    ("fields", "said"),
    [
        ({"pin": (GarmentPin(piece="cloth", at="rim"),)}, "piece cloth has no edge rim; use one"),
        ({"seam": (GarmentSeam(join=("cloth.top", "cloth.left")),)}, "with 5 particles and"),
    ],
)
def test_pins_and_seams_must_fit(fields: dict[str, object], said: str) -> None:
    with pytest.raises(OptionError, match=said):
        tailor(flat(**fields), open_packs(()))


def test_each_corner_of_a_grid_has_a_name() -> None:
    (cut,) = cut_pieces(flat())
    named = [
        cut.edges[f"{row}-{column}"] for row in ("top", "bottom") for column in ("left", "right")
    ]
    assert np.concatenate(named).tolist() == cut.edges["corners"].tolist() == [0, 4, 30, 34]


def test_a_mirrored_piece_is_the_mirror_image() -> None:
    corners = ((0.0, 0.0), (0.0, -12.0), (6.0, -9.0))
    left = PolygonPiece(
        name="left", shape="polygon", corners=corners, spacing=3, place=(2, 9, 1),
        turn=(20, 30, 40), mirror="right",
    )  # fmt: skip
    one, other = cut_pieces(flat(piece=left))
    mirrored = one.cloth.rest_positions * [-1, 1, 1]
    away = np.abs(mirrored[:, None] - other.cloth.rest_positions).sum(axis=-1)
    near = away.min(axis=1) < 1e-9
    assert near[one.edges["rim"]].all() and other.piece.name == "right"
    normals = [
        face_normals(c.cloth.rest_positions, c.cloth.triangles).sum(axis=0) for c in (one, other)
    ]
    np.testing.assert_allclose(normals[0] * [-1, 1, 1], normals[1], atol=1e-12)
    both = flat(piece=GridPiece(name="a", size=(4, 4), points=(3, 3), mirror="b", place=(5, 0, 0)))
    first, second = cut_pieces(both)
    np.testing.assert_allclose(first.uvs, second.uvs * [-1, 1] + [1, 0])


@pytest.mark.parametrize("spacing", [1.0, 2.5, 7.0])
def test_a_polygon_is_covered_once_and_looks_to_the_front(spacing: float) -> None:
    corners = ((-11.0, 0.0), (-11.0, -46.0), (0.0, -32.0), (11.0, -46.0), (11.0, 0.0))
    piece = PolygonPiece(name="tail", shape="polygon", corners=corners, spacing=spacing)
    (cut,) = cut_pieces(flat(piece=piece))
    areas = face_normals(cut.cloth.rest_positions, cut.cloth.triangles)[:, 2] / 2
    assert (areas > 0).all()
    assert np.isclose(areas.sum(), (22 * 46 - 22 * 14 / 2) / 16**2)
    assert len(cut.edges["top"]) == round(22 / spacing) + 1
    assert cut.uvs.min() == 0 and cut.uvs.max() == 1


def test_a_polygon_whose_sides_cross_is_refused() -> None:
    corners = ((0.0, 0.0), (8.0, 0.0), (2.0, 6.0), (9.0, 9.0), (0.0, 8.0), (7.0, 3.0))
    piece = PolygonPiece(name="knot", shape="polygon", corners=corners, spacing=1)
    with pytest.raises(OptionError, match="piece knot: its sides cross"):
        cut_pieces(flat(piece=piece))


@pytest.mark.parametrize(("height", "spacing"), [(1000.0, 15), (0.5, 1)])
def test_a_polygon_has_a_limit_of_particles(height: float, spacing: float) -> None:
    corners = ((0.0, 0.0), (1000.0, 0.0), (0.0, height))
    piece = PolygonPiece(name="map", shape="polygon", corners=corners, spacing=spacing)
    refusal = rf"piece map: its spacing {spacing} is too fine for its size; use at least \d"
    with pytest.raises(OptionError, match=refusal):
        cut_pieces(flat(piece=piece))


def test_a_ring_is_closed_and_an_open_one_has_two_more_edges() -> None:
    skirt = find_garment("skirt")
    (cut,) = cut_pieces(skirt)
    assert len(cut.drawn) == len(cut.cloth.inv_mass) + 6
    outwards = vertex_normals(cut.cloth.rest_positions, cut.cloth.triangles)
    assert ((outwards * cut.cloth.rest_positions * [1, 0, 1]).sum(axis=1) > 0).all()
    ring = RingPiece(
        name="ring", shape="ring", profile=((9, 4, 4), (0, 4, 4)), points=(8, 3), open=90
    )
    (cut,) = cut_pieces(flat(piece=ring))
    left, right = (cut.cloth.rest_positions[cut.edges[side]] for side in ("left", "right"))
    np.testing.assert_allclose(left * [-1, 1, 1], right, atol=1e-12)
    assert (left[:, 2] > 0).all() and np.isclose(left[0, 0], left[0, 2])
    assert cut.nearest((180, 9)) == cut.edges["top"][4]


def test_slack_cloth_begins_with_short_springs() -> None:
    strip = StripPiece(name="rope", shape="strip", ends=((0, 8, 0), (8, 8, 0)), length=12, points=9)
    (cut,) = cut_pieces(flat(piece=strip))
    assert np.isclose(np.ptp(cut.start[:, 0]) * 16, 8)
    assert np.isclose(np.ptp(cut.cloth.rest_positions[:, 0]) * 16, 12)
    with pytest.raises(ValidationError, match="strip is 4 texels long, its ends are 8 apart"):
        StripPiece(name="rope", shape="strip", ends=((0, 8, 0), (8, 8, 0)), length=4, points=9)


def test_a_cape_at_rest_hangs_in_folds_on_shoulders_of_the_games_width() -> None:
    stand = dressed_player(make_wearer(motion="stand", speed=0.0), wear=("cape",))
    dressed = Dressed(stand, open_packs(()), replace(stand.settings(), wind=0.0))
    (cape,), ((last,),) = dressed.cloths, dressed.record(Schedule.still(3.0, dressed.step))
    columns = find_garment("cape").piece[0].points[0]
    assert np.isclose(np.ptp(last[:columns, 0]), 10 * TEXEL, rtol=1e-6)
    for row in last.reshape(-1, columns, 3)[: len(last) // columns // 2]:
        chord = np.interp(row[:, 0], row[[-1, 0], 0], row[[-1, 0], 2])
        assert np.ptp(row[:, 2] - chord) > 0.5 * TEXEL
    assert max_stretch(last[None], cape.cloth) < 0.02


def test_fullness_gathers_a_grid_that_is_fine_enough_for_folds() -> None:
    piece = GridPiece(name="cloth", size=(8, 8), points=(11, 5), fullness=0.25)
    coarse = piece.model_copy(update={"points": (10, 5)})  # as a scene's option does
    garment = flat(piece=piece)
    for each, wide in ((coarse, 8), (piece, 10)):
        (cut,) = cut_pieces(garment.model_copy(update={"piece": (each,)}))
        assert np.isclose(np.ptp(cut.cloth.rest_positions[:, 0]) * 16, wide)
        assert np.isclose(np.ptp(cut.start[:, 0]) * 16, 8)
        assert (np.ptp(cut.start[:, 2]) > 0) == (wide > 8) and cut.size == (8, 8)


def test_a_fullness_that_does_nothing_is_refused() -> None:
    with pytest.raises(ValidationError, match="grid has both fullness and hem; leave one out"):
        GridPiece(name="cloth", size=(8, 8), points=(11, 5), fullness=0.25, hem=9)
    with pytest.raises(
        ValidationError, match="fullness does nothing where points across are 10; use"
    ):
        GridPiece(name="cloth", size=(8, 8), points=(10, 5), fullness=0.25)


def test_seams_sew_the_nearest_edges_and_layers_lie_farther_out() -> None:
    tent = find_garment("tent")
    (sewn,) = tailor(tent, open_packs(()))
    assert len(sewn.cloth.inv_mass) == 2 * 13 * 12 - 13
    assert set(sewn.bones) == {"fixed"} and len(sewn.bones) == 13 + 2 * 3
    piece = GridPiece(name="coat", size=(8, 12), points=(5, 7), layer=2)
    under, over = (tailor(flat(piece=p), open_packs(()))[0] for p in (
        piece.model_copy(update={"layer": 0}), piece))  # fmt: skip
    assert under.distance == under.thickness and over.distance == 6 * under.distance


def test_textures_lie_on_exact_texels() -> None:
    packs = open_packs(())
    cape = find_garment("cape")
    assert texture_of(cape.piece[0].texture, (10, 16), packs, Path())[1] == cape_mapping((64, 64))  # type: ignore[arg-type]
    flag = ClothTexture(design="red cross:white")
    assert texture_of(flag, (20, 40), packs, Path())[1] == FLAG_MAPPING
    half = ClothTexture(design="red cross:white", front=(0, 0, 10, 40))
    mapping = texture_of(half, (10, 40), packs, Path())[1]
    assert mapping.front(np.array([[0.0, 0], [1, 1]])).tolist() == [
        [1 / 64, 1 / 64],
        [11 / 64, 41 / 64],
    ]
    striped = ClothTexture(dye="red", stripes=("blue",), width=2, trim="lime", trim_width=3)
    texels = texture_of(striped, (8, 9), packs, Path())[0].layers[0].texels
    assert texels.shape == (9, 8, 4)
    redder = texels[:6, :, 0].astype(int) > texels[:6, :, 2]
    assert redder.all(axis=0).tolist() == [True, True, False, False] * 2
    assert (texels[6:, :, 1] > texels[6:, :, 0]).all()


def test_a_texture_file_lies_beside_the_garment(tmp_path: Path) -> None:
    text = CAPE.replace('pack = "entity/player/cape"', 'file = "red.png"')
    garment = load(text, tmp_path)
    with pytest.raises(OptionError, match=r"texture .*red\.png.* cannot be read"):
        tailor(garment, open_packs(()))
    Image.new("RGBA", (64, 32), "red").save(tmp_path / "red.png")
    (sewn,) = tailor(garment, open_packs(()))
    assert sewn.pieces[0].material_at(0.0).layers[0].texels.shape == (32, 64, 4)


def test_a_design_and_a_texture_replace_those_of_a_garment() -> None:
    flag, cape, tent = (find_garment(name) for name in ("flag", "cape", "tent"))
    assert (flag.with_design("black").piece[0].texture or 0).design == Banner.parse("black")  # type: ignore[union-attr]
    worn = cape.with_texture("other.png").piece[0].texture
    assert worn is not None and worn.box == (0, 0, 10, 16, 1) and worn.file is not None
    assert all(piece.texture is not None for piece in tent.with_design("black").piece)


def test_a_design_and_a_texture_go_to_the_garments_over_a_player() -> None:
    player = player_of(PlayerSettings(wear=("poncho", "cape")))
    poncho, cape = player.with_texture("other.png").over
    assert poncho == player.over[0] and cape == find_garment("cape").with_texture("other.png")
    assert all(each.texture for worn in player.with_design("black").over for each in worn.piece)
    with pytest.raises(OptionError, match="garment player has no cloth to show it; give it a cape"):
        player_of(PlayerSettings()).with_texture("other.png")


def test_pins_move_with_their_bone() -> None:
    garment = find_garment("leash").model_copy(update={"wearer": find_garment("cape").wearer})
    dressed = Dressed(garment, open_packs(()), Settings(wind=0))
    (sewn,) = dressed.cloths
    (sheet,) = dressed.record(Schedule.at([0.0, 0.2], dressed.step))
    held = np.flatnonzero(sewn.cloth.inv_mass == 0)
    moved = np.abs(sheet[1, held] - sheet[0, held]).max(axis=1)
    by_bone = dict(zip(sewn.bones, moved.tolist(), strict=True))
    assert by_bone["fixed"] == 0 and by_bone["left_arm"] > TEXEL


@pytest.mark.parametrize("name", ["flag", "tent", "pennants", "hammock", "skirt"])
def test_a_garment_passes_its_check(name: str) -> None:
    check_garment(find_garment(name), 0.3)


def test_the_check_names_what_is_wrong() -> None:
    rope = StripPiece(name="rope", shape="strip", ends=((-2, 2, 3), (2, 2, 3)), length=4, points=4)
    pins = (
        GarmentPin(piece="rope", at="start", to="right_leg"),
        GarmentPin(piece="rope", at="end", to="left_leg"),
    )
    stretches = pytest.raises(OptionError, match=r"rope stretches by .*; use a stiffer fabric")
    with pytest.warns(UserWarning, match="pins or colliders pull cloth 0 apart"), stretches:
        check_garment(flat(piece=rope, pin=pins, wearer=GarmentWearer(speed=3)), 0.5)


@pytest.mark.parametrize("name", ["tent", "skirt", "swallow-tail"])
def test_a_garment_looks_as_it_did(name: str, golden: Golden) -> None:
    garment = find_garment(name)
    golden(draw(garment, size=(120, 120), time=0.2))


def test_a_loop_of_a_garment_has_no_seam() -> None:
    flag = find_garment("flag")
    frames = [f.pixels.astype(float) for f in iter_frames(flag, size=(48, 48), seconds=1, fps=10)]
    steps = [np.abs(a - b).mean() for a, b in zip(frames, [*frames[1:], frames[0]], strict=True)]
    assert len(frames) == 10 and steps[-1] <= 2 * max(steps[:-1])


def test_a_garment_becomes_a_model_and_takes_a_style(tmp_path: Path) -> None:
    pennants = find_garment("pennants")
    save_model(pennants, tmp_path / "p.glb", seconds=0.2, fps=10)
    assert b"weights" in (tmp_path / "p.glb").read_bytes()
    plain, inked = (draw(pennants, size=(64, 64), time=0.1, style=s) for s in ((), "woven"))
    assert not np.array_equal(plain.pixels, inked.pixels)


def test_an_option_that_a_garment_does_not_use_is_refused() -> None:
    with pytest.raises(OptionError, match="grid does nothing for a garment; set it in"):
        draw(find_garment("flag"), grid=(5, 9))


def test_a_sheet_has_a_row_for_each_garment() -> None:
    sheet = garments_sheet(Settings(size=(24, 24)), ("flag", "tent"))
    assert sheet.down == ("flag", "tent") and len(sheet.cells) == 8


def test_the_blocks_of_the_page_work(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    found = re.findall(r"```(\w+)\n(.*?)```", PAGE, re.DOTALL)
    blocks = [(kind, code) for kind, code in found if kind != "text"]
    assert [kind for kind, _ in blocks] == ["toml", "python", "python"]
    monkeypatch.chdir(tmp_path)
    check_garment(load(blocks[0][1], tmp_path), 0.2)
    with pytest.raises(OptionError) as caught:
        load(blocks[0][1].replace('"ring"', '"tube"'), tmp_path)
    assert str(caught.value).rpartition("/")[2].replace("mine", "shawl") in PAGE
    for kind, code in blocks:
        if kind == "python":
            exec(code, {})
    assert (tmp_path / "towel.png").exists() and (tmp_path / "flag.glb").exists()


TETRAHEDRON = """\
v -1 0 -1
v 1 0 -1
v 0 0 1
v 0 1 0
f 1 2 3
f 1 4 2
f 2 4 3
f 3 4 1
"""


def test_a_3d_file_stops_cloth_and_is_drawn(tmp_path: Path) -> None:
    (tmp_path / "hill.obj").write_text("mtllib /etc/passwd\n" + TETRAHEDRON)
    over = GridPiece(
        name="over", size=(24, 24), points=(9, 9), place=(0, 20, -12), turn=(-90, 0, 0)
    )
    hill = GarmentMesh(file=Path("hill.obj"), place=(0, 2, 0))
    garment = flat(piece=over, mesh=(hill,), folder=tmp_path)
    assert garment.paths == (tmp_path / "hill.obj",)
    dressed = Dressed(garment, open_packs(()), garment.settings())
    (model,) = dressed.fixed
    assert model.mesh.positions.max(axis=0).tolist() == [1, 1 + 2 / 16, 1]
    (sheet,) = dressed.record(Schedule.at([0.6], dressed.step))
    assert abs(sheet[0, 40, 1] - 1.125) < 0.1  # the middle lies on the top
    assert sheet[0, :, 1].min() < 0.9  # its sides hang lower


@pytest.mark.parametrize(
    ("name", "content", "said"),
    [
        ("none.obj", None, "cannot be read: No such file"),
        ("text.stl", "solid no", "text.stl"),
        ("empty.obj", "v 0 0 0", "empty.obj"),
        ("bad.glb", "glTF", "bad.glb is no .glb file"),
    ],
)
def test_a_3d_file_that_cannot_be_used_is_named(
    name: str, content: str | None, said: str, tmp_path: Path
) -> None:
    if content is not None:
        (tmp_path / name).write_text(content)
    with pytest.raises(OptionError, match=f"mesh .*{said}"):
        read_stiff_mesh(GarmentMesh(file=Path(name)), tmp_path, 1 / 16)


def test_the_size_of_a_3d_file_is_limited(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "hill.obj").write_text(TETRAHEDRON)
    for name, said in (("MAX_FACES", "over 3 triangles"), ("MAX_FILE", "over 3 bytes")):
        with monkeypatch.context() as patch:
            patch.setattr(meshes, name, 3)
            with pytest.raises(OptionError, match=said):
                read_stiff_mesh(GarmentMesh(file=Path("hill.obj")), tmp_path, 1 / 16)


def test_a_3d_file_is_judged_before_its_parts_are_made(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    image = Image.new("RGB", (mesh_headers.MAX_TEXTURE + 1, 1))
    material = trimesh.visual.material.PBRMaterial(baseColorTexture=image)
    part = trimesh.creation.box()
    part.visual = trimesh.visual.TextureVisuals(np.zeros((8, 2)), material=material)
    scene = trimesh.Scene({"box": part})
    for number in range(3):
        matrix = trimesh.transformations.translation_matrix((number, 0, 0))
        scene.graph.update(f"node {number}", matrix=matrix, geometry="box")
    (tmp_path / "boxes.glb").write_bytes(scene.export(file_type="glb"))
    monkeypatch.setattr(trimesh, "load", None)
    for limit, said in ((1000, "a texture over 1024 px"), (2, "over 2 parts")):
        monkeypatch.setattr(mesh_headers, "MAX_PARTS", limit)
        with pytest.raises(OptionError, match=said):
            read_stiff_mesh(GarmentMesh(file=Path("boxes.glb")), tmp_path, 1 / 16)


def command(*words: object) -> None:
    command_line()([str(word) for word in words], standalone_mode=False)


def test_the_command_draws_a_file_as_picture_loop_and_model(tmp_path: Path) -> None:
    small, timed = ("--size", "32x32"), ("--seconds", 0.2, "--fps", 10)
    for target, words in (("pennon.png", ()), ("pennon.gif", timed), ("pennon.glb", timed)):
        command("garment", "pennon", "-o", tmp_path / target, "--design", "black", *small, *words)
        assert (tmp_path / target).stat().st_size > 100
    command("sheet", "garments", "tent", "-o", tmp_path / "sheet.png", "--size", "24x24")
    assert (tmp_path / "sheet.png").exists()


def test_the_command_takes_what_is_not_given_from_the_file(tmp_path: Path) -> None:
    command("garment", "tent", "-o", tmp_path / "own.png", "--size", "32x32", "--time", 0.1)
    front = ("--view", "front", "--wind", 0)
    command("garment", "tent", "-o", tmp_path / "a.png", "--size", "32x32", "--time", 0.1, *front)
    with Image.open(tmp_path / "own.png") as own, Image.open(tmp_path / "a.png") as other:
        drawn = draw(find_garment("tent"), size=(32, 32), time=0.1).pixels
        assert np.array_equal(np.asarray(own.convert("RGBA")), drawn)
        assert not np.array_equal(np.asarray(other.convert("RGBA")), drawn)


def test_the_command_lists_and_describes(capsys: pytest.CaptureFixture[str]) -> None:
    command("garment", "--list")
    command("garment", "tent")
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == len(garment_names()) + 1 and lines[-1] == "A tent over a ridge pole"
    with pytest.raises(OptionError, match="no garment is given"):
        command("garment")


@pytest.mark.parametrize(("name", "turn"), [("cape", 5), ("elytra", 8)])
def test_another_view_shows_its_side_and_an_own_view_keeps_its_turn(name: str, turn: int) -> None:
    garment = find_garment(name)
    assert garment.settings().rotation == garment.settings(wind=1.0).rotation == turn
    assert garment.settings(view="back").rotation == garment.settings(view="front").rotation == 0
    assert garment.settings(view="back", rotation=8).rotation == 8
    assert garment.settings(view="iso").rotation == turn


def test_the_view_from_behind_shows_a_cape(drapery: Run, tmp_path: Path) -> None:
    seen = []
    for view in ("front", "back"):
        path = tmp_path / f"{view}.png"
        words = ("--view", view, "--size", "24x36", "--time", "0.1", "--light", "flat", "-o", path)
        assert drapery("garment", "cape", *words)[0] == 0
        red, green, _, _ = np.moveaxis(np.asarray(Image.open(path).convert("RGBA"), int), -1, 0)
        seen.append(int(((red > 90) & (green < 60)).sum()))
    ahead, behind = seen
    assert behind > 3 * ahead
