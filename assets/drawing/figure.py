"""Skins of the figures in the scenes, in the game's layout, drawn from rows of characters."""

from dataclasses import dataclass

import numpy as np

from assets.drawing.canvas import TexelRect, Texels, TextureBox, blank, put, wrap
from assets.drawing.noise import grid, ranked, scatter, speckle

HEAD = TextureBox(0, 0, 8, 8, 8)
BODY = TextureBox(16, 16, 8, 12, 4)
RIGHT_ARM, LEFT_ARM = TextureBox(40, 16, 4, 12, 4), TextureBox(32, 48, 4, 12, 4)
RIGHT_LEG, LEFT_LEG = TextureBox(0, 16, 4, 12, 4), TextureBox(16, 48, 4, 12, 4)
CAPE = TextureBox(0, 0, 10, 16, 1)

Tones = tuple[tuple[int, int, int], ...]

STUFFS: dict[str, Tones] = {
    "h": ((58, 38, 24), (70, 46, 28), (84, 56, 34)),  # brown hair
    "y": ((168, 116, 48), (188, 134, 58), (206, 154, 74)),  # fair hair
    "s": ((198, 146, 112), (210, 158, 124), (218, 168, 134)),  # skin
    "n": ((182, 128, 98), (190, 136, 104)),  # skin in shadow
    "m": ((150, 84, 72), (158, 90, 78)),  # mouth
    "w": ((236, 236, 232), (242, 242, 240)),  # white of an eye, linen
    "e": ((54, 84, 132), (60, 92, 142)),  # iris
    "t": ((46, 88, 62), (54, 100, 70), (62, 112, 80)),  # tunic
    "r": ((112, 36, 48), (128, 42, 54), (142, 50, 62)),  # bodice
    "l": ((78, 50, 30), (90, 58, 34), (100, 66, 40)),  # leather
    "g": ((208, 166, 58), (222, 184, 78)),  # brass
    "p": ((66, 62, 74), (76, 72, 84), (86, 82, 94)),  # trousers
    "k": ((44, 42, 52), (52, 50, 60)),  # stockings
}
"""Tones of each character of a drawing, from dark to light."""


@dataclass(frozen=True)
class Outfit:
    """The drawing of a figure in the characters of STUFFS.

    face: the front of the head. hair: the rest of it, row by row.
    chest: the front of the body. back: its other sides, row by row.
    arm, leg: row by row, shoulder to hand and hip to sole.
    """

    face: str
    hair: str
    chest: str
    back: str
    arm: str
    leg: str


TRAVELLER = Outfit(
    face="hhhhhhhh hhhhhhhh hsssssss ssssssss swessews sssnnsss ssmmmmss ssssssss",
    hair="hhhhhhsn",
    chest="ttwsswtt tttwwttt tttttttt tttttttt tttttttt tttttttt tttttttt llllllll lllgglll"
    " tttttttt tttttttt tttttttt",
    back="tttttttllttt",
    arm="tttttttlssss",
    leg="ppppppppllll",
)
DANCER = Outfit(
    face="yyyyyyyy yyyssyyy ysssssys yssssssy ywessewy yssssssy yssmmssy yyssssyy",
    hair="yyyyyyyy",
    chest="wsssssss wwsssssw wwwwwwww rwwwwwwr rrwwwwrr rrrwwrrr rrrggrrr rrrwwrrr rrrggrrr"
    " llllllll rrrrrrrr rrrrrrrr",
    back="wwwrrrrrrlrr",
    arm="wwwwwnssssss",
    leg="kkkkkkkkklll",
)


def texels_of_rows(rows: list[str], seed: int) -> Texels:
    """Opaque texels of drawn rows; each texel has a tone of its character."""
    noise = speckle(len(rows[0]), len(rows), seed)
    face = np.zeros((*noise.shape, 4), np.uint8)
    face[..., 3] = 255
    for y, row in enumerate(rows):
        for x, character in enumerate(row):
            tones = STUFFS[character]
            face[y, x, :3] = tones[int(noise[y, x]) * len(tones) >> 16]
    return face


def _rows(column: str, region: TexelRect) -> list[str]:
    return [character * region.width for character in column]


def _paint(sheet: Texels, box: TextureBox, sides: str, front: str | None, seed: int) -> None:
    put(sheet, box.sides, texels_of_rows(_rows(sides, box.sides), seed))
    if front is not None:
        put(sheet, box.front, texels_of_rows(front.split(), seed + 1))
    for character, cap in ((sides[0], box.top), (sides[-1], box.bottom)):
        put(sheet, cap, texels_of_rows(_rows(character * cap.height, cap), seed + 2))


def figure_sheet(outfit: Outfit) -> Texels:
    """A skin, shape [64, 64, 4]; texels outside the boxes are transparent."""
    sheet = blank()
    _paint(sheet, HEAD, outfit.hair, outfit.face, 101)
    _paint(sheet, BODY, outfit.back, outfit.chest, 111)
    for seed, arm in ((121, RIGHT_ARM), (131, LEFT_ARM)):
        _paint(sheet, arm, outfit.arm, None, seed)
    for seed, leg in ((141, RIGHT_LEG), (151, LEFT_LEG)):
        _paint(sheet, leg, outfit.leg, None, seed)
    return sheet


CREST = """
..........
..........
..........
..........
....##....
...#..#...
..#.##.#..
.#.####.#.
.#.####.#.
..#.##.#..
...#..#...
....##....
..........
..........
..........
..........
"""
"""A simple emblem for a cape; its texels have the colour of the trim."""


def cape_sheet() -> Texels:
    """A light cape for dyes, shape [64, 64, 4]: a weave, a darker hem, an emblem."""
    tones = 2 + ranked(speckle(CAPE.width, CAPE.height, 161), (1, 3, 1)) - 1
    x, y = grid(CAPE.width, CAPE.height)
    fold = scatter(x, 0 * x, 162) % 3 == 0
    tones = tones - fold
    hem = (y >= CAPE.height - 2) | (x == 0) | (x == CAPE.width - 1)
    device = np.array([[sign == "#" for sign in row] for row in CREST.split()])
    shade = np.choose(np.clip(tones, 0, 3), [196, 210, 222, 232])
    shade = np.where(hem | device, shade - 92, shade).astype(np.uint8)
    sheet = blank()
    opaque = np.full_like(shade, 255)
    wrap(sheet, CAPE, np.dstack([shade, shade, shade, opaque]))
    return sheet
