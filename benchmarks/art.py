"""How well our masks cover those of another pack: `python -m benchmarks.art --textures FOLDER`.

FOLDER is the `textures` folder of a resource pack with `entity/banner` and `entity/shield`. For
each pattern it prints two figures, both 1 for equal masks and 0 for masks that do not meet:
`seen`, the intersection over union (IoU) of the texels that can be seen; and `alpha`, the same with
each texel weighted by its alpha, sum(min) / sum(max), which also compares soft edges.
"""

import argparse
from collections.abc import Callable
from pathlib import Path

import numpy as np
from PIL import Image

from assets.drawing.banner import pattern_sheet
from assets.drawing.canvas import FLAG, SHEET_SIZE, Grey, TexelRect, Texels
from assets.drawing.charges import CHARGES
from assets.drawing.shield import FIELD, shield_sheet
from benchmarks.quick import add_quick
from drapery.banner.patterns import PATTERN_NAMES

SHEETS: dict[str, tuple[TexelRect, Callable[[str], Texels]]] = {
    "banner": (FLAG.front, pattern_sheet),
    "shield": (FIELD, shield_sheet),
}
"""The region to compare and our sheet of a pattern, for each kind."""

OURS = Path(__file__).parents[1] / "assets" / "minecraft" / "textures"

SEEN = 4
"""The least alpha that counts as seen, of 255: packs have stray texels that nobody can see."""


def their_sheet(file: Path) -> Texels:
    """The file's texels, each the middle one of a block where its sheet is larger than ours."""
    with Image.open(file) as image:
        texels = np.asarray(image.convert("RGBA"))
    scale = len(texels) // SHEET_SIZE
    return texels[scale // 2 :: scale, scale // 2 :: scale]


def overlap(first: Grey, second: Grey) -> float:
    """Weighted intersection over union of two masks, 0 to 1; 1 where both are empty."""
    union = float(np.maximum(first, second).sum(dtype=np.int64))
    return float(np.minimum(first, second).sum(dtype=np.int64)) / union if union else 1.0


def compare(kind: str, pattern: str, textures: Path) -> tuple[float, float, int, int]:
    """`seen` and `alpha` of a pattern, and the seen texels of our mask and of theirs."""
    region, draw = SHEETS[kind]
    theirs = their_sheet(textures / "entity" / kind / f"{pattern}.png")[region.slices][..., 3]
    ours = draw(pattern)[region.slices][..., 3]
    ours_seen, theirs_seen = (ours >= SEEN).astype(np.uint8), (theirs >= SEEN).astype(np.uint8)
    counts = int(ours_seen.sum()), int(theirs_seen.sum())
    return overlap(ours_seen, theirs_seen), overlap(ours, theirs), *counts


def main() -> None:
    words = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    words.add_argument("--textures", type=Path, help="by default ours, of which all figures are 1")
    add_quick(words)
    textures = words.parse_args().textures or OURS
    for kind in SHEETS:
        figures = {name: compare(kind, name, textures) for name in PATTERN_NAMES}
        print(f"{kind:24} {'seen':>6} {'alpha':>6} {'ours':>5} {'theirs':>6}")
        for name, (seen, alpha, ours, theirs) in figures.items():
            print(f"{name:24} {seen:6.3f} {alpha:6.3f} {ours:5} {theirs:6}")
        groups = {
            "mean of shapes": [name for name in figures if name not in CHARGES],
            "mean of charges": list(CHARGES),
            "mean of all": list(figures),
        }
        for title, names in groups.items():
            seen, alpha = np.mean([figures[name][:2] for name in names], axis=0)
            print(f"{title:24} {seen:6.3f} {alpha:6.3f}")
        print()


if __name__ == "__main__":
    main()
