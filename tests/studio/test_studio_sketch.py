"""Designs under work: strokes keep their names, edits keep the rest, and all can be undone."""

from dataclasses import replace
from itertools import pairwise

import pytest
from hypothesis import given, strategies as st

from drapery import Banner
from drapery.banner.design import MAX_LAYERS, Layer
from drapery.banner.dyes import DYE_NAMES
from drapery.banner.patterns import PATTERN_NAMES
from drapery.errors import DesignError, OptionError, PackError
from drapery.studio import sketch as edits
from drapery.studio.descriptions import described
from drapery.studio.history import LIMIT, History
from drapery.studio.session import MAX_SESSIONS, Session, Sessions
from drapery.studio.sketch import Sketch, banner_of, sketch_of

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


@given(BANNERS.filter(lambda banner: banner.layers), st.data())
def test_a_move_keeps_the_others_in_order(banner: Banner, data: st.DataObject) -> None:
    sketch = sketch_of(banner)
    number = data.draw(st.sampled_from([stroke.number for stroke in sketch.strokes]))
    place = data.draw(st.integers(-3, 20))
    moved = edits.move(sketch, number, place)
    others = [stroke for stroke in sketch.strokes if stroke.number != number]
    assert [stroke for stroke in moved.strokes if stroke.number != number] == others
    assert edits.place_of(moved, number) == min(max(place, 0), len(others))


def test_a_hidden_stroke_is_stored_but_not_drawn() -> None:
    hidden = edits.hide(THREE, 2)
    assert [layer.pattern for layer in banner_of(hidden).layers] == ["creeper", "flower"]
    assert edits.hide(hidden, 2) == THREE


def test_a_copy_lies_on_its_original_under_a_new_name() -> None:
    copied = edits.duplicate(THREE, 1)
    assert [stroke.pattern for stroke in copied.strokes] == [
        *("creeper", "creeper", "border", "flower")
    ]
    assert len({stroke.number for stroke in copied.strokes}) == 4
    assert edits.remove(copied, copied.strokes[1].number) == THREE


def test_a_stroke_is_changed_in_its_place() -> None:
    changed = edits.repattern(edits.recolour(THREE, 2, "blue"), 2, "Lozenge")
    assert changed.strokes[1] == replace(THREE.strokes[1], pattern="rhombus", dye="blue")
    assert (changed.strokes[0], changed.strokes[2]) == (THREE.strokes[0], THREE.strokes[2])
    assert edits.dye_field(THREE, "silver").base == "light_gray"
    assert edits.clear(THREE) == replace(THREE, strokes=())


def test_impossible_edits_are_refused() -> None:
    full = sketch_of(Banner("white", (Layer("cross", "red"),) * MAX_LAYERS))
    for edit in (
        lambda: edits.add(full, "border", "red"),
        lambda: edits.duplicate(full, 1),
        lambda: edits.add(THREE, "cabbage", "red"),
        lambda: edits.recolour(THREE, 1, "mauve"),
        lambda: edits.move(THREE, 9, 0),
        lambda: edits.remove(THREE, 0),
    ):
        with pytest.raises(DesignError):
            edit()


@given(st.integers(0, 2**32))
def test_a_random_design_is_the_same_for_the_same_seed(seed: int) -> None:
    sketch = edits.random_sketch(seed)
    assert sketch == edits.random_sketch(seed)
    layers = [Layer("base", sketch.base), *banner_of(sketch).layers]
    assert all(low.dye != high.dye for low, high in pairwise(layers))
    assert 2 <= len(sketch.strokes) <= 6


@given(st.lists(st.sampled_from(["undo", "redo"]) | st.integers(0, 3)))
def test_undo_then_redo_changes_nothing(steps: list[str | int]) -> None:
    history = History(0)
    for step in steps:
        history = history.push(step) if isinstance(step, int) else getattr(history, step)()
        if history.past:
            assert history.undo().redo() == history
        if history.future:
            assert history.redo().undo() == history
        assert len(history.past) <= LIMIT


def test_history_is_bounded_and_an_equal_state_adds_no_step() -> None:
    history = History(0)
    for state in range(LIMIT + 50):
        history = history.push(state)
    assert len(history.past) == LIMIT
    assert history.push(history.present) is history


def test_a_session_notifies_of_edits() -> None:
    session, events = Session(), []
    session.listen(lambda: events.append(session.sketch), "sketch")
    session.edit(THREE)
    session.edit(THREE)
    session.undo()
    session.undo()
    session.redo()
    assert events == [THREE, Sketch(), THREE]


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


def test_a_click_dyes_what_is_chosen() -> None:
    session = Session()
    selection = session.selection
    selection.press_dye("blue")
    selection.press_pattern("creeper")
    selection.press_dye("red")
    selection.press_pattern("border")
    selection.choose(1)
    selection.press_dye("lime")
    assert banner_of(session.sketch) == Banner.parse("blue creeper:lime border:red")
    selection.set_swaps(True)
    selection.press_pattern("skull")
    selection.act_on_chosen("move", 1)
    assert banner_of(session.sketch) == Banner.parse("blue border:red skull:lime")
    selection.act_on_chosen("remove")
    assert selection.chosen is None and not selection.swaps
    session.close()


def test_a_new_layer_is_chosen_so_that_a_dye_recolours_it() -> None:
    selection = (session := Session()).selection
    selection.press_pattern("creeper")
    assert selection.chosen == 1
    selection.press_dye("lime")
    assert banner_of(session.sketch) == Banner.parse("white creeper:lime")
    session.close()


@pytest.mark.parametrize(("field", "dye"), [("black", "white"), ("white", "black")])
def test_a_new_pattern_differs_from_the_field(field: str, dye: str) -> None:
    selection = (session := Session()).selection
    selection.press_dye("red")
    selection.press_dye(field)
    assert selection.pattern_dye == dye
    selection.press_pattern("skull")
    assert banner_of(session.sketch) == Banner.parse(f"{field} skull:{dye}")
    selection.press_dye(field)
    assert selection.pattern_dye == dye
    session.close()


def test_a_repeated_edit_belongs_to_the_same_design_and_another_design_does_not() -> None:
    selection = (session := Session()).selection
    selection.lay_out(sketch_of(Banner.parse("red creeper:lime")))
    first = session.sketch.origin
    selection.press_pattern("border")
    selection.lay_out(session.sketch, same=True)
    assert session.sketch.origin == first
    selection.lay_out(sketch_of(Banner.parse("blue")))
    assert session.sketch.origin != first
    session.undo()
    assert session.sketch.origin == first
    session.close()


def test_a_design_is_described() -> None:
    assert (
        described(THREE)
        == "White banner with lime Creeper Charge, black Bordure, red Flower Charge"
    )
    assert described(Sketch("light_blue", kind="shield")) == "Light blue shield"
