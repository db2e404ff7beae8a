"""What a caller gave: kept by Settings, and put in place of a garment's own options."""

import pickle
import re
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import Run
from option_values import another
from source_modules import modules

from drapery import Banner, Settings, draw
from drapery.cloth import Wind
from drapery.errors import OptionError
from drapery.garments import Garment
from drapery.option import Subject
from drapery.settings import OPTIONS, settled

FLAG = Garment.model_validate(
    {
        "name": "flag",
        "piece": [{"name": "flag", "size": [8, 8], "points": [3, 3]}],
        "picture": {"view": "iso", "rotation": 8, "wind": 2, "size": "16x24", "time": 0.1},
    }
)


def test_given_are_the_names_in_a_call_and_what_differs_from_a_default() -> None:
    given = Settings(wind=4.0, view="iso")
    assert given.given == {"wind", "view"}
    assert replace(given, gusts=1.0).given >= {"wind", "view", "gusts"}
    assert given.changed(seed=0).given == {"wind", "view", "seed"}
    assert given.changed() is given and Settings().given == frozenset()
    assert pickle.loads(pickle.dumps(given)).given == given.given
    assert given.given_values == {"view": "iso", "wind": 4.0}


def test_a_default_that_depends_on_others_is_made_anew_and_is_not_given() -> None:
    hero = Settings(view="hero", samples=None)
    assert (hero.light, hero.samples, hero.ground, hero.given) == ("studio", 4, "grass", {"view"})
    assert hero.changed(view="front") == Settings() and hero.changed(samples=None) == hero
    fixed = hero.changed(view="front", light="studio")
    assert (fixed.light, fixed.samples, fixed.given) == ("studio", 1, {"view", "light"})
    assert fixed.changed(light=None).light == "game"
    assert (hero.as_given("light"), fixed.as_given("light")) == (None, "studio")
    # A style has its own light, which is that of the first alone.
    assert hero != Settings(view="hero", light="studio")


def test_the_package_changes_settings_by_their_method() -> None:
    """`replace` would keep the values of options whose default depends on others."""
    wrong = re.compile(r"(?<![.\w])replace\(\s*([\w.]*\b)?(settings|chosen|base),")
    texts = {name: path.read_text(encoding="utf-8") for name, path in modules().items()}
    found = [name for name, text in texts.items() if wrong.search(text)]
    assert found == []


IN_A_WIND = [n for n, o in OPTIONS.items() if o.affects == ("wind",) and n != "wind"]
"""The options that a `Wind` has in itself."""


@pytest.mark.parametrize("name", IN_A_WIND)
def test_an_option_of_the_wind_beside_a_wind_is_refused(name: str) -> None:
    wind = Wind((0.0, 0.0, 3.0))
    said = f"{name} does nothing beside a Wind of your own; set it in that Wind"
    for subject in (Banner.parse("white"), FLAG):
        with pytest.raises(OptionError, match=re.escape(said)):
            draw(subject, Settings(wind=wind), **{name: another(OPTIONS[name])})


def test_a_wind_counts_in_place_of_the_wind_of_a_garments_file() -> None:
    own = FLAG.model_copy(update={"picture": {"direction": 180.0, "gusts": 0.2, "view": "iso"}})
    settings = own.settings(wind=Wind((0.0, 0.0, 3.0)))
    assert settings.given == {"wind", "view"}


def test_given_names_are_no_part_of_the_value() -> None:
    assert Settings(wind=4.0) == Settings() and hash(Settings(wind=4.0)) == hash(Settings())
    assert "given" not in repr(Settings()) and "given" not in OPTIONS
    assert set(asdict(Settings())) - set(OPTIONS) == {"given"}


@pytest.mark.parametrize(
    "options", [{}, {"size": (24, 16)}, {"view": "front"}, {"wind": 4.0}, {"view": "iso"}], ids=str
)
def test_a_garment_keeps_its_own_options_where_settings_give_none(options: dict[str, Any]) -> None:
    by_name = draw(FLAG, **options).pixels
    assert np.array_equal(draw(FLAG, Settings(**options)).pixels, by_name)
    assert np.array_equal(draw(FLAG, FLAG.settings(**options)).pixels, by_name)


def test_a_given_option_replaces_the_subjects_own() -> None:
    own = {"wind": 2.0, "view": "iso", "rotation": 8}
    read = settled(Settings(wind=4.0), Subject("garment"), own=own)
    assert (read.wind, read.view, read.rotation) == (4.0, "iso", 8)
    assert settled(Settings(view="back"), Subject("garment"), own=own).rotation == 0
    assert settled(read, Subject("garment"), own=own) == read


@pytest.mark.parametrize("contact", ["none", "world", "all"])
def test_a_garment_refuses_each_value_of_what_its_file_sets(contact: Any) -> None:
    said = "contact does nothing for a garment; set it in the garment's file"
    for settings in (Settings(contact=contact), None):
        options = {} if settings else {"contact": contact}
        with pytest.raises(OptionError, match=said):
            draw(FLAG, settings, **options)


def test_the_command_line_gives_only_what_stands_there(drapery: Run, tmp_path: Path) -> None:
    words = ("render", "red", "--placement", "item", "--size", "8x8", "-o", tmp_path / "x.png")
    assert drapery(*words)[0] == 0
    code, _, said = drapery(*words, "--wind", "4")  # the default
    assert (code, said) == (2, "drapery: wind does nothing for placement item; leave it out\n")
