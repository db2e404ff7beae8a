"""Skins against the format: 20 skins of marked texels, seen straight from six sides.

Each texel has a colour of its own. What each pixel must show is worked out here from the layout of
the format alone: where the sides of a box lie on a skin, and where the boxes are.
"""

from dataclasses import dataclass

import numpy as np
import pytest

from drapery.render.camera import Camera
from drapery.render.light import UNLIT
from drapery.render.scene import Material, Model, Scene, TextureLayer
from drapery.render.soft import draw_scene
from drapery.style.figure import TEXEL
from drapery.style.skins import Skin, read_skin

PIXELS = 2
"""Pixels of a texel."""
SIZE = (24 * PIXELS, 40 * PIXELS)
MIDDLE = (0.013, 16.029, 0.017)
"""What a picture's middle shows [texels]; no pixel's middle lies on the border of a texel."""

# Lowest and highest x, y and z [texels; the player looks to +z, its right arm is at -x], then the
# corner of the first layer and of the second on a skin, and how far the second stands off.
BOXES = {
    "head": ((-4, 24, -4), (4, 32, 4), (0, 0), (32, 0), 0.5),
    "body": ((-4, 12, -2), (4, 24, 2), (16, 16), (16, 32), 0.25),
    "right_leg": ((-4, 0, -2), (0, 12, 2), (0, 16), (0, 32), 0.25),
    "left_leg": ((0, 0, -2), (4, 12, 2), (16, 48), (0, 48), 0.25),
}
ARMS = {
    "classic": {
        "right_arm": ((-8, 12, -2), (-4, 24, 2), (40, 16), (40, 32), 0.25),
        "left_arm": ((4, 12, -2), (8, 24, 2), (32, 48), (48, 48), 0.25),
    },
    "slim": {
        "right_arm": ((-7, 11.5, -2), (-4, 23.5, 2), (40, 16), (40, 32), 0.25),
        "left_arm": ((4, 11.5, -2), (7, 23.5, 2), (32, 48), (48, 48), 0.25),
    },
}
# Of each side: its axis and end, then the axes along its columns and its rows, each with the sign
# of their direction. Rows of the sides go down; those of top and bottom from the back to the front.
SIDES = {
    "front": (2, 1, (0, 1), (1, -1)),
    "back": (2, -1, (0, -1), (1, -1)),
    "right": (0, -1, (2, 1), (1, -1)),
    "left": (0, 1, (2, -1), (1, -1)),
    "top": (1, 1, (0, 1), (2, 1)),
    "bottom": (1, -1, (0, 1), (2, 1)),
}
# Of each view: what is to the right and up in its picture.
VIEWS = {
    "front": ((0, 1), (1, 1)),
    "back": ((0, -1), (1, 1)),
    "right": ((2, 1), (1, 1)),
    "left": ((2, -1), (1, 1)),
    "top": ((0, 1), (2, -1)),
    "bottom": ((0, 1), (2, 1)),
}


@dataclass(frozen=True)
class MarkedSkin:
    """A skin of our own making. unit: pixels of a texel. old: 64 x 32. holes: the share of texels
    of the second layer that are transparent."""

    number: int
    arms: str
    unit: int = 1
    old: bool = False
    holes: float = 0.0

    def texels(self) -> np.ndarray:
        side, random = 64 * self.unit, np.random.default_rng(self.number)
        height = side // 2 if self.old else side
        colours = random.permutation(1 << 20)[: side * height].reshape(height, side)
        # Bits are spread over the channels, so that neighbours differ in each of them.
        channels = [colours * 37 % 256, colours >> 8 & 255, colours >> 12 & 255]
        alpha = np.where(random.random((height, side)) < self.holes, 0, 255)
        return np.stack([*channels, alpha], axis=-1).astype(np.uint8)


SKINS = (
    *(MarkedSkin(number, "classic") for number in range(4)),
    *(MarkedSkin(number, "slim") for number in range(4, 8)),
    *(MarkedSkin(number, arms, 1, False, 0.4) for number, arms in enumerate(
        ("classic", "slim", "classic", "slim"), 8)),
    *(MarkedSkin(number, arms, unit) for number, (arms, unit) in enumerate(
        (("classic", 2), ("slim", 2), ("classic", 4), ("slim", 4)), 12)),
    *(MarkedSkin(number, "classic", 1, True, holes) for number, holes in enumerate(
        (0.0, 0.4), 16)),
    MarkedSkin(18, "classic", 2, True, 0.2), MarkedSkin(19, "slim", 1, False, 1.0),
)  # fmt: skip


def regions(box: tuple) -> dict[str, tuple[int, int, int, int]]:
    """Where the sides of a box lie, from its corner: left, top, width, height [texels]."""
    w, h, d = (int(b - a) for a, b in zip(box[0], box[1], strict=True))
    return {
        "front": (d, d, w, h), "back": (2 * d + w, d, w, h),
        "right": (0, d, d, h), "left": (d + w, d, d, h),
        "top": (d, 0, w, d), "bottom": (d + w, 0, w, d),
    }  # fmt: skip


def seen(skin: Skin, view: str) -> tuple[np.ndarray, np.ndarray]:
    """What a view must show, shape [H, W, 4], and whether only one surface is the nearest."""
    axis, end, *_ = SIDES[view]
    (across, right), (along, up) = VIEWS[view]
    width, height = SIZE
    x = right * (np.arange(width) + 0.5 - width / 2) / PIXELS + MIDDLE[across]
    y = up * (height / 2 - np.arange(height) - 0.5) / PIXELS + MIDDLE[along]
    place = {across: x[None, :], along: y[:, None]}
    nearest = np.full((height, width), -np.inf)
    picture = np.zeros((height, width, 4), np.uint8)
    alone = np.ones((height, width), bool)
    unit = len(skin.texels) // 64
    for box in {**BOXES, **ARMS[skin.arms]}.values():
        for corner, grown in ((box[2], 0.0), (box[3], box[4])):
            low, high = np.array(box[0]) - grown, np.array(box[1]) + grown
            for side, (normal, which, *directions) in SIDES.items():
                if normal != axis:
                    continue
                left, top, *size = regions(box)[side]
                texel = []
                for (a, sign), start, count in zip(directions, (left, top), size, strict=True):
                    share = (place[a] - low[a]) / (high[a] - low[a])
                    share = share if sign > 0 else 1 - share
                    inside = (share > 0) & (share < 1)
                    number = np.where(inside, np.clip(share, 0, 1 - 1e-9) * count * unit, -1)
                    texel.append((np.floor(number).astype(int), start * unit))
                (column, first), (row, upper) = texel
                column, row = np.broadcast_arrays(column, row)
                shown = skin.texels[
                    upper + corner[1] * unit + row.clip(0),
                    first + corner[0] * unit + column.clip(0),
                ]
                depth = end * (high[axis] if which > 0 else low[axis])
                drawn = (column >= 0) & (row >= 0) & (shown[..., 3] > 127)
                alone[drawn & (nearest == depth)] = False
                nearer = drawn & (depth > nearest)
                picture[nearer], nearest[nearer], alone[nearer] = shown[nearer], depth, True
    return picture, alone


def drawn(skin: Skin, view: str) -> np.ndarray:
    axis, end, *_ = SIDES[view]
    along, up = VIEWS[view][1]
    target = np.array(MIDDLE) * TEXEL
    position, upwards = target.copy(), np.zeros(3)
    position[axis] += end * 4
    upwards[along] = up
    camera = Camera(tuple(position), tuple(target), tuple(upwards), height=SIZE[1] / PIXELS * TEXEL)
    material = Material((TextureLayer(skin.texels),), "cutout")
    return draw_scene(Scene((Model(skin.mesh({}), (material,)),), camera, SIZE, UNLIT)).pixels


@pytest.mark.parametrize("skin", SKINS, ids=str)
def test_each_texel_is_where_the_format_says(skin: MarkedSkin) -> None:
    read = read_skin(skin.texels(), None if skin.old else skin.arms)
    assert read.arms == skin.arms
    for view in VIEWS:
        wanted, alone = seen(read, view)
        found = drawn(read, view)
        assert alone.mean() > 0.9 and (wanted[..., 3] > 0).mean() > 0.05
        assert np.array_equal(found[alone], wanted[alone]), view


def test_an_old_skin_shows_its_right_limbs_mirrored_on_the_left() -> None:
    read = read_skin(MarkedSkin(16, "classic", old=True).texels())
    for name in ("leg", "arm"):
        parts = {**BOXES, **ARMS["classic"]}
        right, left = parts[f"right_{name}"], parts[f"left_{name}"]
        for side, (x, y, w, h) in regions(right).items():
            other = {"right": "left", "left": "right"}.get(side, side)
            x2, y2, *_ = regions(left)[other]
            one = read.texels[right[2][1] + y :, right[2][0] + x :][:h, :w]
            two = read.texels[left[2][1] + y2 :, left[2][0] + x2 :][:h, :w]
            assert np.array_equal(one, two[:, ::-1]), (name, side)


def test_one_texel_of_the_second_layer_is_a_box_with_four_walls() -> None:
    texels = np.zeros((64, 64, 4), np.uint8)
    texels[10, 43] = (9, 8, 7, 255)  # on the front of the head, away from its edges
    flat, voxels, none = (
        read_skin(texels, "classic", overlay=overlay).mesh({}, ("head",))
        for overlay in ("flat", "voxels", "none")
    )
    assert len(none.triangles) == 12 and len(flat.triangles) == 12 + 2
    assert len(voxels.triangles) == 12 + 2 + 2 * 4
    walls = voxels.positions[-16:] / TEXEL
    # Column 3 and row 2 of 8, on a layer that stands off by half a texel.
    low, high = np.array([-4.5, 32.5]) + np.array([[3, -3], [4, -2]]) * 9 / 8
    np.testing.assert_allclose(walls.min(axis=0), [*low, 4], atol=1e-9)
    np.testing.assert_allclose(walls.max(axis=0), [*high, 4.5], atol=1e-9)
    assert np.allclose(voxels.uvs[-16:], [43.5 / 64, 10.5 / 64])
    a, b, c = (voxels.positions[voxels.triangles[-8:, corner]] for corner in range(3))
    normals = np.cross(b - a, c - a)
    assert ((normals * voxels.normals[voxels.triangles[-8:, 0]]).sum(axis=1) > 0).all()


def test_no_wall_stands_inside_a_closed_layer() -> None:
    read = read_skin(np.full((64, 64, 4), 255, np.uint8), "slim", overlay="voxels")
    flat = read_skin(np.full((64, 64, 4), 255, np.uint8), "slim")
    assert len(read.mesh({}).triangles) == len(flat.mesh({}).triangles)
