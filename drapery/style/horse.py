"""A horse of boxes. It stands on y = 0 at the origin, looks to +z, and has the player's scale."""

from dataclasses import dataclass

from drapery.style.boxes import ModelBox
from drapery.style.figure import FigurePart


@dataclass(frozen=True)
class HorseBox:
    """A box of the horse [texels, y down, z back], the bone that it moves with, and its dye."""

    bone: str
    box: ModelBox
    dye: str


def _box(low: tuple[float, float, float], high: tuple[float, float, float]) -> ModelBox:
    """A box between two corners [texels, y up, z to the front]."""
    size = tuple(float(b - a) for a, b in zip(low, high, strict=True))
    return ModelBox((low[0], -high[1], -high[2]), (size[0], size[1], size[2]), (0, 0))


def _leg(x: float, z: float) -> tuple[ModelBox, ModelBox]:
    """A leg and its hoof; x, z: its middle."""
    return (
        _box((x - 2, 2, z - 2), (x + 2, 12, z + 2)),
        _box((x - 2.2, 0, z - 2.2), (x + 2.2, 2.5, z + 2.2)),
    )


LEGS = {"right_arm": (-3, 8), "left_arm": (3, 8), "right_leg": (-3, -8), "left_leg": (3, -8)}
"""Middles of the legs, x and z; the front legs are the arms."""

HORSE_PARTS: dict[str, FigurePart] = {
    "head": FigurePart(_box((-2.5, 17, 7), (2.5, 30.5, 15)), (0, -20, -9)),
    "body": FigurePart(_box((-5, 11, -11), (5, 21, 11)), (0, -16, 0)),
    **{
        bone: FigurePart(_box((x - 2, 0, z - 2), (x + 2, 12, z + 2)), (x, -12, -z))
        for bone, (x, z) in LEGS.items()
    },
}
"""What cloth meets, and the joints of the bones."""

HORSE_BOXES = (
    HorseBox("body", HORSE_PARTS["body"].box, "brown"),
    HorseBox("body", _box((-1.5, 8, -14), (1.5, 20, -10.5)), "black"),
    HorseBox("head", _box((-2, 17, 7), (2, 25, 13)), "brown"),
    HorseBox("head", _box((-2, 22, 9.5), (2, 29.5, 15)), "brown"),
    HorseBox("head", _box((-1, 18, 5.5), (1, 27, 7)), "black"),
    HorseBox("head", _box((-1, 23, 7), (1, 31, 9.5)), "black"),
    HorseBox("head", _box((-2.5, 25.5, 11.5), (2.5, 30.5, 18)), "brown"),
    HorseBox("head", _box((-2, 25.5, 18), (2, 29, 21.5)), "gray"),
    HorseBox("head", _box((-2.3, 30.5, 11.5), (-0.8, 32.8, 13)), "brown"),
    HorseBox("head", _box((0.8, 30.5, 11.5), (2.3, 32.8, 13)), "brown"),
    HorseBox("head", _box((-2.6, 28.2, 15), (-2.4, 29.6, 16.4)), "black"),
    HorseBox("head", _box((2.4, 28.2, 15), (2.6, 29.6, 16.4)), "black"),
    *(
        HorseBox(bone, box, dye)
        for bone, (x, z) in LEGS.items()
        for box, dye in zip(_leg(x, z), ("brown", "gray"), strict=True)
    ),
)
"""What is drawn."""

SHEET = (96, 64)
"""Texels that hold any of the boxes unfolded."""
