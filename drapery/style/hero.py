"""A small hero of pixels, seen from the side: running, in the air, and standing."""

import numpy as np
from numpy.typing import NDArray

from drapery.arrays import Texels

PALETTE: dict[str, tuple[int, int, int]] = {
    "h": (92, 58, 34),
    "s": (228, 176, 138),
    "k": (46, 34, 40),
    "t": (70, 122, 92),
    "a": (92, 150, 112),
    "l": (122, 84, 48),
    "p": (74, 70, 92),
    "q": (54, 50, 70),
    "b": (98, 62, 38),
}
OUTLINE = (34, 28, 40)

BUST = """
...hhhhh..
..hhhhhhh.
..hhhssss.
..hhssksk.
..hhsssss.
...ssssss.
...ttttt..
..tttaatt.
..tttaatt.
..tttaatt.
..tttaas..
...lllll..
...ttttt..
"""
LEGS = {
    "stand": """
...ppqq...
...ppqq...
...ppqq...
...ppqq...
...bbbb...
...bbbbbb.
""",
    "stride": """
...ppqqq..
..ppp.qqq.
.qpp...qq.
bqq.....pp
bb......pb
b.......bb
""",
    "pass": """
...pppq...
...pppqq..
...pp.qq..
...pp.bb..
...bb.....
...bbb....
""",
    "other": """
...qqppp..
..qqq.ppp.
.pqq...pp.
bpp.....qq
bb......qb
b.......bb
""",
    "rise": """
...ppqqq..
..ppp.qqq.
..pp..qqb.
.ppb..bb..
.bb.......
.b........
""",
    "fall": """
...ppqq...
..ppp.qq..
..pp...qq.
.ppb...qbb
.bb....b..
..........
""",
}
RUN = ("stride", "pass", "other", "pass")


def sprite(legs: str) -> Texels:
    """The hero, facing right, with an outline: shape [21, 12, 4]."""
    letters = np.array([list(row) for row in (BUST + LEGS[legs]).split()])
    texels = np.zeros((letters.shape[0] + 2, letters.shape[1] + 2, 4), np.uint8)
    inner = texels[1:-1, 1:-1]
    for letter, colour in PALETTE.items():
        inner[letters == letter] = (*colour, 255)
    texels[_rim(texels[..., 3] > 0)] = (*OUTLINE, 255)
    return texels


def _rim(solid: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Empty texels that touch a solid one by a side."""
    near = np.zeros_like(solid)
    near[1:] |= solid[:-1]
    near[:-1] |= solid[1:]
    near[:, 1:] |= solid[:, :-1]
    near[:, :-1] |= solid[:, 1:]
    return near & ~solid
