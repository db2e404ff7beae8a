"""Which layer makes two designs differ: the build-up of both, step by step."""

import sys
from pathlib import Path

from drapery.comparison.pairs import build_up_sheet, compare_variants
from drapery.comparison.variants import draw_variants
from drapery.settings import Settings


def main(folder: Path) -> None:
    designs = [
        "white stripe_bottom:red creeper:lime border:black",
        "white stripe_bottom:red creeper:green border:black",
    ]
    (pair,) = compare_variants(draw_variants(designs, Settings(size=(160, 200))))
    print(pair.line())
    sheet = build_up_sheet(pair)
    assert sheet is not None
    sheet.save(folder / "layers.png")


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "."))
