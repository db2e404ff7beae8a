"""Another value of each option, for tests that change one after another.

An option with choices or bounds needs no line here.
"""

from typing import Any

import numpy as np

from drapery import Settings
from drapery.cloth import Drag
from drapery.option import Option
from drapery.packs import MemoryPack
from drapery.settings import OPTIONS

TEXELS = np.full((64, 64, 4), (200, 10, 10, 255), np.uint8)
SHEET = np.full((32, 64, 4), (10, 10, 200, 255), np.uint8)
SHEET[::2] = 200
CHOSEN: dict[str, Any] = {
    "packs": [MemoryPack(textures={
        f"minecraft:entity/{name}": TEXELS
        for name in ("banner/banner_base", "banner/base", "shield/shield_base", "shield/base")
    })],
    "kind": "shield", "texture": SHEET[::-1], "placement": "wall", "view": "back",
    "size": (32, 24), "grid": (5, 8), "solver": "desbrun", "fabric": "silk", "forces": [Drag(9.0)],
    "pins": "corners", "contact": "none", "wind": 4.5, "time": 1.0, "style": "felt",
    "thickness": 4.0, "background": "#ff0000", "ground": "stone", "pixel": 2,
}  # fmt: skip
"""Values that follow from no bounds, show more, or take less time."""
SHARE = 0.75
"""How far a number goes from the default to the farther bound."""


def another(option: Option, settings: Settings | None = None) -> Any:
    """Another value of an option than in some settings, by default plain ones."""
    if option.name in CHOSEN:
        return CHOSEN[option.name]
    usual = getattr(settings or Settings(), option.name)
    if option.type is bool:
        return not usual
    if option.choices:
        return [choice for choice in option.choices if choice != usual][-1]
    assert option.bounds and option.type, f"{option.name} needs a line in {__name__}.CHOSEN"
    start = usual or 0
    far = max(option.bounds, key=lambda bound: abs(bound - start))
    return option.type(start + SHARE * (far - start))


SAME_LOOK = {
    "format": "is for packs of another layout",
    "layers": "looks the same where nothing is translucent",
    "pbr": "needs maps of a pack",
    "backend": "draws the same",
}
"""Options that need not change a picture, and why."""
OTHERS = {name: another(option) for name, option in OPTIONS.items() if name not in SAME_LOOK}
"""Another value of each option that changes plain pictures."""
