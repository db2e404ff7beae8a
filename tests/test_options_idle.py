"""An option that changes nothing in a placement is refused by every way to give it."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import Run
from option_values import OTHERS, SAME_LOOK

from drapery import Banner, Settings, animate, draw, iter_frames, save_model
from drapery.errors import OptionError
from drapery.option import Subject
from drapery.option_checks import check_options
from drapery.serve.request_params import ServiceConfig, read_request
from drapery.settings import NAMED_OPTIONS
from drapery.studio.snippets import ExportRequest, as_command, as_python
from drapery.style import check_kind

CREEPER = Banner.parse("white creeper:lime")
UNSEEN = {
    **SAME_LOOK,
    "packs": "is a file",
    "texture": "is a file",
    "placement": "is the placement itself",
    "time": "textures of packs move",
}
"""Options that need not change this picture."""


@pytest.mark.parametrize("name", sorted(NAMED_OPTIONS))
def test_each_option_changes_an_item_or_is_refused(name: str) -> None:
    if name in UNSEEN:
        return
    dark = {"sky_light": 3} if name in ("block_light", "daylight") else {}
    plain = {"placement": "item", "size": (32, 32), **dark}
    given = {**plain, name: OTHERS[name]}
    try:
        changed = draw(CREEPER, **given).pixels
    except OptionError as error:
        assert name in str(error)
        assert str(error).endswith(("leave it out", "use rotation"))
        return
    assert not np.array_equal(changed, draw(CREEPER, **plain).pixels)


IDLE = [
    name
    for name, option in NAMED_OPTIONS.items()
    if name not in ("texture", "turntable", "ground", "rotation", "facing")  # in other words
    and not option.applies(Subject(placement="item"))
]


@pytest.mark.parametrize("name", IDLE)
def test_all_ways_to_give_it_refuse_it(name: str, drapery: Run, tmp_path: Path) -> None:
    option = NAMED_OPTIONS[name]
    said = f"{name} does nothing for placement item; leave it out"
    given = {"placement": "item", name: OTHERS[name]}
    texts = {"placement": "item", name: option.to_text(OTHERS[name])}
    assert check_options(texts, Path()) == [said]
    calls = (
        lambda: draw(CREEPER, **given),
        lambda: draw(CREEPER, Settings(placement="item"), **{name: OTHERS[name]}),
        lambda: animate(CREEPER, **given),
        lambda: iter_frames(CREEPER, **given),
        lambda: save_model(CREEPER, tmp_path / "x.glb", **given),
    )
    for call in calls:
        with pytest.raises(OptionError, match=said):
            call()
    words = [option.command_flag]
    words += [] if option.type is bool else [option.to_text(OTHERS[name])]
    for command, file in (("render", "x.png"), ("animate", "x.gif"), ("model", "x.glb")):
        if command == "model" and not option.applies(output="model"):
            continue  # a 3-D file has no shadow, for one
        answer = drapery(command, "red", "--placement", "item", *words, "-o", tmp_path / file)
        assert answer == (2, "", f"drapery: {said}\n")
    assert not list(tmp_path.iterdir())


def test_a_given_default_is_refused_too_and_none_is_not() -> None:
    said = ["view does nothing for placement item; leave it out"]
    assert check_options({"placement": "item", "view": "front"}, Path()) == said
    assert isinstance(check_options({"placement": "item", "direction": None}, Path()), Settings)
    assert isinstance(check_options({"placement": "wall", "view": "back"}, Path()), Settings)


@pytest.mark.parametrize("kind", NAMED_OPTIONS["kind"].choices[1:])
def test_a_kind_takes_a_texture_or_a_design(kind: Any) -> None:
    textured = NAMED_OPTIONS["texture"].applies(Subject(kind))
    read = read_request([("design", "red"), ("kind", kind)], ".png", ServiceConfig())
    assert (read == [f"kind {kind} shows a file, which an address cannot name"]) == textured
    if textured:
        with pytest.raises(OptionError, match=f"kind {kind} takes no design"):
            check_kind(CREEPER, Settings(kind=kind))
    else:
        with pytest.raises(OptionError, match="texture is for a cape or elytra"):
            check_kind(CREEPER, Settings(kind=kind, texture="x.png"))


def test_the_studio_writes_no_option_that_does_nothing() -> None:
    settings = Settings(placement="item", view="hero", wind=9.0, size=(64, 64))
    for code in (as_command, as_python):
        text = code(ExportRequest(CREEPER, settings))
        assert "item" in text and "64" in text
        assert "wind" not in text and "view" not in text
