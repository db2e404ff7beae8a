"""Each option changes something in each output for which the table says that it applies.

A motion that a cache keeps under too few options, or an option that nothing reads, fails here.
"""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from drapery import Banner, OptionError, animate, draw, save_model
from drapery.cloth import Drag
from drapery.garments import Garment
from drapery.option import Output, Subject
from drapery.packs import MemoryPack
from drapery.settings import OPTIONS

CREEPER = Banner.parse("white creeper:lime")
RUG = Garment.model_validate(
    {"name": "rug", "piece": [{"name": "rug", "size": [8, 8], "points": [4, 4]}],
     "pin": [{"piece": "rug", "at": "top"}]}
)  # fmt: skip
TEXELS = np.full((64, 64, 4), (200, 10, 10, 255), np.uint8)
SMALL: dict[str, Any] = {"size": (24, 32), "time": 0.5, "wind": 9.0}
OTHERS: dict[str, Any] = {
    "packs": [MemoryPack(textures={"minecraft:entity/banner/banner_base": TEXELS})],
    "kind": "shield", "pose": "vanilla", "placement": "wall", "rotation": 5, "facing": "east",
    "view": "back", "turntable": True, "size": (32, 24), "grid": (5, 8), "solver": "desbrun",
    "fabric": "silk", "forces": [Drag(9.0)], "pins": "corners", "contact": "none", "wind": 4.5,
    "direction": 100.0, "gusts": 1.5, "time": 1.0, "seed": 7, "style": "felt", "thickness": 4.0,
    "background": "#ff0000", "ground": "stone", "samples": 4, "pixel": 2, "light": "flat",
    "block_light": 9, "sky_light": 2, "daylight": 0.1, "shadow": True,
}  # fmt: skip
"""Another value of each option."""
BESIDE: dict[str, dict[str, Any]] = {
    "facing": {"placement": "wall"},
    "block_light": {"sky_light": 3},
    "daylight": {"sky_light": 3},
    "shadow": {"view": "iso"},
    "contact": {"direction": 180.0, "time": 2.0},
}
"""What makes an option seen."""
UNSEEN = {
    "format": "is for packs of another layout",
    "texture": "is a file",
    "layers": "looks the same where nothing is translucent",
    "pbr": "needs maps of a pack",
    "backend": "draws the same",
}
"""Options that need not change these pictures."""
ELSEWHERE = {
    ("garment", "packs"): "its texture is of our own art alone",
    ("loop", "time"): "defaults of a file of cases are those of its stills too",
}
OUTPUTS: tuple[Output, ...] = ("still", "loop", "model")


def made(subject: Any, output: Output, folder: Path, options: dict[str, Any]) -> bytes:
    if output == "still":
        return draw(subject, **options).pixels.tobytes()
    if output == "loop":
        frames = animate(subject, seconds=0.2, fps=10, **options).frames
        return b"".join(frame.pixels.tobytes() for frame in frames)
    save_model(subject, folder / "x.glb", seconds=0, **options)
    return (folder / "x.glb").read_bytes()


@pytest.mark.parametrize("output", OUTPUTS)
@pytest.mark.parametrize("kind", ["banner", "garment"])
@pytest.mark.parametrize("name", OPTIONS)
def test_an_option_changes_what_it_applies_to_and_is_refused_elsewhere(
    name: str, kind: str, output: Output, tmp_path: Path
) -> None:
    assert (name in OTHERS) != (name in UNSEEN)
    if name in UNSEEN or (kind, name) in ELSEWHERE or (output, name) in ELSEWHERE:
        return
    subject, option = (CREEPER if kind == "banner" else RUG), OPTIONS[name]
    plain = {**SMALL, **BESIDE.get(name, {})}
    if kind == "banner":
        plain["grid"] = (4, 7)
    plain = {n: v for n, v in plain.items() if OPTIONS[n].applies(Subject(kind), output)}
    given = {**plain, name: OTHERS[name]}
    if option.applies(Subject(kind), output):
        one, other = (made(subject, output, tmp_path, each) for each in (plain, given))
        assert one != other
        return
    with pytest.raises(OptionError) as caught:
        made(subject, output, tmp_path, given)
    # A facing that fits no placement is refused before.
    said = option.refusal(Subject(kind), output) if name != "facing" else "facing east applies only"
    assert said is not None and str(caught.value).startswith(said)


def test_each_option_affects_something() -> None:
    assert [name for name, option in OPTIONS.items() if not option.affects] == []
