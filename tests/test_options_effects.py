"""Each option changes something in each output for which the table says that it applies.

A motion that a cache keeps under too few options, or an option that nothing reads, fails here.
"""

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import pytest
from option_values import OTHERS, SHEET, another

from drapery import Banner, Frame, OptionError, Settings, animate, draw, save_model
from drapery.garments import Garment, PlayerSettings, player_of
from drapery.option import Output, Subject
from drapery.packs import open_packs
from drapery.scenes import live_panels, played_body
from drapery.settings import OPTIONS
from drapery.style import body_of
from drapery.web.wasm.image import Image

# Cloth of a thickness of 4 on a coarse grid begins in what it hangs on.
pytestmark = pytest.mark.filterwarnings("ignore:pins or colliders pull cloth")

CREEPER = Banner.parse("white creeper:lime")
SHIELD = replace(CREEPER, kind="shield")
RUG = Garment.model_validate(
    {"name": "rug", "piece": [{"name": "rug", "size": [8, 8], "points": [4, 4],
     "place": [0, 16, 0]}], "pin": [{"piece": "rug", "at": "top"}]}
)  # fmt: skip
SMALL: dict[str, Any] = {"size": (24, 32), "time": 0.5, "wind": 9.0, "grid": (4, 7)}
BESIDE: dict[str, dict[str, Any]] = {
    "block_light": {"sky_light": 3},
    "daylight": {"sky_light": 3},
    "shadow": {"view": "iso"},
    "thickness": {"view": "iso"},
    "contact": {"direction": 180.0, "time": 2.0},
}
"""What makes an option seen."""


@dataclass(frozen=True)
class Shown:
    """What is drawn.

    subject: a design or garment. options: which say the rest. others: other values of options.
    same: options that need not change its pictures, and why.
    """

    subject: Any
    options: dict[str, Any] = field(default_factory=dict)
    others: dict[str, Any] = field(default_factory=dict)
    same: dict[str, str] = field(default_factory=dict)

    def words(self, options: dict[str, Any]) -> Subject:
        """What the table calls it."""
        if isinstance(self.subject, Garment):
            return Subject("garment")
        return self.settings(options).subject(self.subject.kind if self.subject else "banner")

    def settings(self, options: dict[str, Any]) -> Settings:
        """What its own options and the words of a subject among some set."""
        own = self.subject.picture if isinstance(self.subject, Garment) else {}
        named = {name: options[name] for name in Subject._fields if name in options}
        return Settings(**own, **named)

    def useful(self, options: dict[str, Any], output: Output, kept: str) -> dict[str, Any]:
        """The options that do something, and that one."""
        words = self.words(options)
        return {
            name: value
            for name, value in options.items()
            if name == kept or OPTIONS[name].applies(words, output)
        }


OWN = {"packs": "its textures are its own"}
STANDS = {"placement": "it has only one"}
TURNS = {"turntable": "what does not move is shown from all sides"}
STIFF = {**TURNS, "time": "its textures do not move"}
PICTURE = {"style": "pixel-art"}
CAPE: dict[str, Any] = {"kind": "cape", "texture": SHEET}
SHOWN = {
    "banner": Shown(CREEPER),
    "wall": Shown(
        CREEPER,
        {"placement": "wall"},
        {"placement": "standing"},
        {"kind": "what it would be is on no wall"},
    ),
    "item": Shown(CREEPER, {"placement": "item"}, {"placement": "standing", **PICTURE}, STIFF),
    "vanilla": Shown(CREEPER, {"pose": "vanilla"}, {"pose": "cloth", **PICTURE}),
    "shield": Shown(SHIELD, {}, {"kind": "banner", "placement": "item", **PICTURE}, STIFF),
    "shield item": Shown(
        SHIELD,
        {"placement": "item"},
        {"kind": "banner", "placement": "standing", **PICTURE},
        STIFF,
    ),
    "cape": Shown(None, CAPE, {"kind": "elytra"}, OWN | STANDS),
    "vanilla cape": Shown(
        None,
        {**CAPE, "pose": "vanilla"},
        {"kind": "elytra", "pose": "cloth", **PICTURE},
        OWN | STANDS | TURNS,
    ),
    "elytra": Shown(
        None, {**CAPE, "kind": "elytra"}, {"kind": "cape", **PICTURE}, OWN | STANDS | TURNS
    ),
    "garment": Shown(RUG, same=OWN),
    "player": Shown(
        player_of(PlayerSettings(wear=("cape",), motion="stand")),
        same=OWN | {"finish": "the fabric of its cape is no preset, so it is plain"},
    ),
}
OUTPUTS: tuple[Output, ...] = ("still", "loop", "model")


def made(subject: Any, output: Output, folder: Path, options: dict[str, Any]) -> bytes:
    if output == "still":
        return draw(subject, **options).pixels.tobytes()
    if output == "loop":
        frames = animate(subject, seconds=0.3, fps=10, **options).frames
        return b"".join(frame.pixels.tobytes() for frame in frames)
    save_model(subject, folder / "x.glb", seconds=0, **options)
    return (folder / "x.glb").read_bytes()


CASES = [(n, o) for n in SHOWN for o in OUTPUTS if n != "player" or o == "still"]
"""A player's cloth is sewn for each option, which takes long."""


@pytest.mark.parametrize(("name", "output"), CASES)
def test_an_option_changes_what_it_applies_to_and_is_refused_elsewhere(
    name: str, output: Output, tmp_path: Path
) -> None:
    shown = SHOWN[name]
    faults = [fault(shown, option, output, tmp_path) for option in OTHERS.keys() - shown.same]
    assert not any(faults), "; ".join(filter(None, faults))


def fault(shown: Shown, option: str, output: Output, folder: Path) -> str | None:
    """What is wrong with an option of a subject in an output."""
    if option == "style" and option in shown.others and output == "model":
        return None  # stiff parts are styled in pictures alone
    plain = {**SMALL, **BESIDE.get(option, {}), **shown.options}
    value = shown.others.get(option, another(OPTIONS[option], shown.settings(plain)))
    if option == "texture" and isinstance(shown.subject, Garment):
        value = folder / "texture.png"
        Frame(SHEET).save(value)
    one, other = (shown.useful(each, output, option) for each in (plain, {**plain, option: value}))
    said = OPTIONS[option].refusal(shown.words(other), output)
    if option not in plain or said is not None:
        one.pop(option, None)
    try:
        first, second = (made(shown.subject, output, folder, each) for each in (one, other))
    except OptionError as error:
        if said is None:
            return f"{option} applies, but: {error}"
        # A facing or rotation that fits no placement is refused before.
        fits = str(error) == said or option in ("facing", "rotation", "turntable", "ground")
        return None if fits else f"{option} is refused as: {error}"
    return None if first != second else f"{option} does nothing"


MOVING = [n for n in OTHERS if {"motion", "wind"}.issuperset(OPTIONS[n].affects)]


@pytest.mark.parametrize("name", ["banner", "wall", "cape"])
def test_an_option_of_the_cloth_or_the_wind_changes_what_a_page_plays(name: str) -> None:
    shown, idle = SHOWN[name], []
    for option in MOVING:
        plain = {**SMALL, **BESIDE.get(option, {}), **shown.options}
        other = {**plain, option: another(OPTIONS[option], shown.settings(plain))}
        changed = played(shown.subject, plain) != played(shown.subject, other)
        if OPTIONS[option].applies(shown.words(plain), "page") and not changed:
            idle.append(option)
    assert idle == []


def played(subject: Any, options: dict[str, Any]) -> tuple[str, bytes]:
    """What a page plays: its cloths and kernels, and the arguments of these in the free wind."""
    settings, image = Settings(**options), Image()
    body = body_of(subject, open_packs(settings.packs), settings)
    panels = live_panels(played_body(body, settings))
    for panel in panels:
        aim = panel.calls["aim"]
        assert aim.function(*aim.arguments) == 0
        for kernel in panel.calls.values():
            image.add_call(kernel.arguments, {each: each for each in panel.functions})
    return str([(panel.header, list(panel.functions)) for panel in panels]), bytes(image.data)


def test_each_option_affects_something() -> None:
    assert [name for name, option in OPTIONS.items() if not option.affects] == []
