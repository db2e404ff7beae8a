"""Designs under work: what the page's editor sends, and who hears of it."""

import json
from dataclasses import replace
from typing import Any

import pytest
from hypothesis import given, strategies as st

from drapery import Banner, Settings
from drapery.banner.design import MAX_LAYERS, Layer
from drapery.banner.dyes import DYE_NAMES
from drapery.banner.patterns import PATTERN_NAMES
from drapery.errors import DesignError, OptionError, PackError
from drapery.studio.session import MAX_SESSIONS, Session, Sessions
from drapery.studio.sketch import (
    MAX_ORIGIN,
    MAX_TITLE,
    Sketch,
    banner_of,
    edited_sketch,
    editor_tree,
    sketch_of,
)

LAYERS = st.builds(Layer, st.sampled_from(PATTERN_NAMES), st.sampled_from(DYE_NAMES))
BANNERS = st.builds(
    Banner,
    st.sampled_from(DYE_NAMES),
    st.lists(LAYERS, max_size=MAX_LAYERS).map(tuple),
    st.sampled_from(["banner", "shield"]),
)
THREE = sketch_of(Banner.parse("white creeper:lime border:black flower:red"))


@given(BANNERS)
def test_a_banner_comes_back_from_its_sketch(banner: Banner) -> None:
    assert banner_of(sketch_of(banner)) == banner


@given(BANNERS, st.text(max_size=90), st.integers(0, MAX_ORIGIN - 1))
def test_the_editor_of_the_page_gives_back_what_it_gets(
    banner: Banner, title: str, origin: int
) -> None:
    sketch = replace(sketch_of(banner), title=title, origin=origin)
    again = edited_sketch(json.loads(json.dumps(editor_tree(sketch))))
    assert replace(again, title="") == replace(sketch, title="")
    assert again.title.isprintable() and len(again.title) <= MAX_TITLE


@pytest.mark.parametrize(
    "change",
    [
        {"base": "mauve"},
        {"kind": "tent"},
        {"layers": [{"pattern": "creeper", "dye": "lime"}] * (MAX_LAYERS + 1)},
        {"layers": [{"pattern": "../x", "dye": "lime"}]},
        {"layers": [{"pattern": "creeper"}]},
        {"layers": "creeper"},
        {"layers": [7]},
        {"title": 7},
        {"origin": -1},
        {"origin": "1"},
    ],
)
def test_what_is_no_design_of_an_editor_is_refused(change: dict[str, Any]) -> None:
    tree = editor_tree(THREE)
    assert edited_sketch(tree) == THREE
    for wrong in (tree | change, None, [], {}):
        with pytest.raises(DesignError):
            edited_sketch(wrong)


def test_a_hidden_stroke_is_stored_but_not_drawn() -> None:
    strokes = (THREE.strokes[0], replace(THREE.strokes[1], hidden=True), THREE.strokes[2])
    hidden = edited_sketch(editor_tree(replace(THREE, strokes=strokes)))
    assert hidden.strokes == strokes
    assert [layer.pattern for layer in banner_of(hidden).layers] == ["creeper", "flower"]


def test_a_session_notifies_of_edits() -> None:
    session, events = Session(), []
    session.listen(lambda: events.append(("sketch", session.sketch)), "sketch")
    session.listen(lambda: events.append(("laid", session.sketch)), "laid")
    session.edit(THREE)
    session.take(THREE)
    session.take(Sketch())
    session.name(" Flag ")
    named = Sketch(title="Flag")
    assert events == [
        *(("sketch", THREE), ("laid", THREE), ("sketch", Sketch())),
        *(("sketch", named), ("laid", named)),
    ]
    session.close()


def test_settings_out_of_bounds_change_nothing(tmp_path) -> None:
    session, events = Session(), []
    session.listen(lambda: events.append("settings"), "settings")
    session.listen(lambda: events.append("packs"), "packs")
    with pytest.raises(OptionError):
        session.adjust(wind=-1)
    with pytest.raises(PackError):
        session.adjust(packs=(tmp_path / "none.zip",))
    assert session.settings == Session().settings and not events
    session.adjust(wind=7.0)
    session.adjust(wind=7.0)
    assert events == ["settings"]


def test_a_closed_session_leaves_nothing() -> None:
    sessions, ended = Sessions(), []
    session = sessions.open()
    assert sessions.find(session.token) is session
    folder = session.folder
    (folder / "pack.zip").write_bytes(b"PK")
    session.on_close(lambda: ended.append(1))
    session.close()
    session.close()
    assert ended == [1] and not folder.exists() and sessions.find(session.token) is None
    session.on_close(lambda: ended.append(2))
    assert ended == [1, 2]


def test_of_too_many_sessions_the_oldest_ends() -> None:
    sessions = Sessions()
    first, *rest = [sessions.open() for _ in range(MAX_SESSIONS + 1)]
    assert first.closed and not any(session.closed for session in rest)
    assert len({session.token for session in rest}) == len(sessions) == MAX_SESSIONS
    sessions.close_all()
    assert len(sessions) == 0


def test_another_design_has_another_origin() -> None:
    session = Session()
    session.lay_out(sketch_of(Banner.parse("red creeper:lime")))
    first = session.sketch.origin
    session.lay_out(sketch_of(Banner.parse("blue")))
    assert session.sketch.origin != first
    session.close()


def test_a_shield_is_not_on_a_wall() -> None:
    session = Session(Settings(placement="wall", facing="east"))
    session.take(Sketch(kind="shield"))
    assert session.settings.placement == "standing" and session.settings.facing is None
    session.close()
