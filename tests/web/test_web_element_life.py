"""An element through its life on a page: gusts of its own, changes, moves, other screens, loss."""

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest
from studio_browser import resize, wait_until
from web_sites import ELEMENT, changes, first_picture, is_live, open_site, picture, served

from drapery.settings import Settings
from drapery.web import package

PAGE = """<!doctype html><html lang="en"><title>Life</title>
<script type="module" src="drapery-banner.js"></script>
<main><drapery-banner design="red"></drapery-banner></main><aside></aside></html>
"""
WATCH = """
window.contexts = [];
const get = HTMLCanvasElement.prototype.getContext;
HTMLCanvasElement.prototype.getContext = function (kind, ...more) {
  const context = get.call(this, kind, ...more);
  if (kind === "webgl2") window.contexts.push(context);
  return context;
};
window.heard = [];
for (const name of ["ready", "error", "pause"])
  addEventListener(`drapery-${name}`, ({ detail }) => window.heard.push([name, detail]));
"""


@pytest.fixture(scope="module")
def address(
    playable: Callable[..., Settings], tmp_path_factory: pytest.TempPathFactory
) -> Iterator[str]:
    folder = tmp_path_factory.mktemp("life")
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(package, "POSES", {})
        package.write_component(folder, playable(size=(320, 480)))
    (folder / "index.html").write_text(PAGE, encoding="utf-8")
    yield from served(folder)


@pytest.fixture(scope="module")
def loaded(chromium: Any, address: str) -> Any:
    open_site(chromium, address, moves=False, script=WATCH)
    return chromium


@pytest.fixture
def life(loaded: Any) -> Any:
    """The page with one still red banner, and nothing heard."""
    resize(loaded, (1280, 800))
    loaded.execute_script(
        "document.querySelector('aside').replaceChildren();"
        f"for (const name of {ELEMENT}.getAttributeNames()) {ELEMENT}.removeAttribute(name);"
        f"{ELEMENT}.setAttribute('design', 'red');"
    )
    settled(loaded)
    loaded.execute_script("heard.length = 0")
    return loaded


def settled(browser: Any) -> None:
    """Wait until all that was asked is shown."""
    browser.execute_async_script("const [done] = arguments; setTimeout(done, 60)")


def heard(browser: Any) -> list[list[Any]]:
    settled(browser)
    found: list[list[Any]] = browser.execute_script("return heard.splice(0)")
    return found


def added(browser: Any, **attributes: Any) -> np.ndarray:
    """The still picture of another element with these attributes."""
    element = "document.querySelector('aside').lastChild"
    browser.execute_script(
        "const each = document.createElement('drapery-banner');"
        "Object.entries(arguments[0]).forEach((pair) => each.setAttribute(...pair));"
        "document.querySelector('aside').append(each);",
        attributes,
    )
    wait_until(lambda: is_live(browser, element))
    return first_picture(browser, element)


def test_seed_and_phase_give_each_banner_gusts_of_its_own(life: Any) -> None:
    plain = added(life, design="red")
    assert np.array_equal(added(life, design="red", seed=0, phase=0), plain)
    for own in ({"seed": 7}, {"phase": 1.5}, {"phase": 2.5}):
        other = added(life, design="red", **own)
        assert not np.array_equal(other, plain), own
        assert np.array_equal(added(life, design="red", **own), other), own


def test_cloth_in_a_strong_wind_stays_in_the_picture(life: Any) -> None:
    for view in ("iso", "hero"):
        shown = added(life, design="red", fabric="silk", wind=15, view=view)[..., 3] > 0
        edges = (shown[0], shown[-1], shown[:, 0], shown[:, -1])
        assert shown.any() and not any(edge.any() for edge in edges), view


RECORD = """
const [element, done] = arguments;
const said = (seconds) => element.record(seconds).catch((error) => error.message);
Promise.all([-1, 0, 3601, NaN, "x", null].map(said)).then(done);
"""


def test_a_film_has_a_length_that_loops_have(life: Any) -> None:
    element = life.execute_script(f"return {ELEMENT}")
    range_, number = "is out of range; use 0.00833 to 3600", 'is not a number; write seconds="4"'
    assert life.execute_async_script(RECORD, element) == [
        *(f'seconds="{given}" {range_}' for given in ("-1", "0", "3601")),
        *(f'seconds="{given}" {number}' for given in ("NaN", "x", "null")),
    ]


def test_fabric_view_daylight_and_shield_are_those_of_the_package(life: Any) -> None:
    plain = added(life, design="red")
    for own in ({"fabric": "wool"}, {"view": "front"}, {"daylight": 1}, {"kind": "standing"}):
        assert np.array_equal(added(life, design="red", **own), plain), own
    night = added(life, design="red", daylight=0)
    assert night[..., :3].sum() < 0.5 * plain[..., :3].sum()
    assert np.array_equal(night[..., 3], plain[..., 3])
    for own in ({"fabric": "silk"}, {"view": "back"}, {"view": "iso"}, {"daylight": 0.4}):
        assert not np.array_equal(added(life, design="red", **own), plain), own
    shield = added(life, design="red creeper:lime", kind="shield", wind=9)
    lime = (shield[..., 1] > shield[..., 0].astype(int) + 40) & (shield[..., 3] == 255)
    assert 0.02 < lime.mean() < 0.3
    opaque = shield[..., 3] == 255
    assert abs(np.ptp(np.nonzero(opaque.any(0))[0]) / np.ptp(np.nonzero(opaque.any(1))[0])) < 0.6
    assert np.array_equal(added(life, design="red creeper:lime", kind="shield"), shield)


def test_attributes_that_change_give_the_same_picture_as_those_from_the_start(life: Any) -> None:
    wanted = added(life, design="red", fabric="silk", view="iso", daylight=0.3)
    added(life, design="red")
    each = "document.querySelector('aside').lastChild"
    life.execute_script(f"Object.assign({each}, {{ view: 'iso', daylight: 0.3, fabric: 'silk' }})")
    wait_until(lambda: np.array_equal(picture(life, each), wanted))


@pytest.mark.parametrize(
    ("name", "value", "reason"),
    [
        ("view", "side", 'view="side" is not known; use front, back, iso, gui, hero'),
        ("daylight", "2", 'daylight="2" is out of range; use 0 to 1'),
        (
            "fabric",
            "velvet",
            'fabric="velvet" is not known; use wool, cotton, linen, silk, canvas, leather, felt',
        ),
        ("seed", "1.5", 'seed="1.5" is not a whole number; write seed="4"'),
        ("seed", "-1", 'seed="-1" is out of range; use 0 to 4294967295'),
        ("phase", "soon", 'phase="soon" is not a number; write phase="4"'),
        ("phase", "1e9", 'phase="1e9" is out of range; use 0 to 3600'),
    ],
)
def test_a_wrong_seed_or_phase_is_an_error(life: Any, name: str, value: str, reason: str) -> None:
    life.execute_script(f"{ELEMENT}.setAttribute('{name}', '{value}')")
    assert heard(life) == [["error", f"drapery: {reason}"]]


def test_one_event_tells_each_good_change(life: Any) -> None:
    life.execute_script(f"{ELEMENT}.design = 'blue'")
    assert heard(life) == [["ready", None]]
    life.execute_script(f"Object.assign({ELEMENT}, {{ design: 'lime', wind: 7, seed: 3 }})")
    assert heard(life) == [["ready", None]]
    life.execute_script(f"{ELEMENT}.design = 'lime'")
    assert heard(life) == []
    life.execute_script(f"{ELEMENT}.design = 'plaid'")
    ((name, line),) = heard(life)
    assert name == "error" and "unknown dye 'plaid'" in line
    life.execute_script(f"Object.assign({ELEMENT}, {{ kind: 'wall', design: 'black' }})")
    wait_until(lambda: life.execute_script("return heard.length > 0"))
    assert heard(life) == [["ready", None]]


def test_less_motion_is_read_live_and_never_written_onto_the_element(life: Any) -> None:
    paused = f"return [{ELEMENT}.paused, {ELEMENT}.hasAttribute('paused')]"
    assert life.execute_script(paused) == [True, False]
    resize(life, (1280, 800), moves=True)
    wait_until(lambda: life.execute_script(paused) == [False, False])
    assert heard(life) == [["pause", False]]
    life.execute_script(f"{ELEMENT}.setAttribute('paused', '')")
    assert life.execute_script(paused) == [True, True]
    life.execute_script(f"{ELEMENT}.paused = false")
    assert life.execute_script(paused) == [False, True]
    resize(life, (1280, 800))
    wait_until(lambda: life.execute_script(paused) == [True, True])
    made = "const one = document.createElement('drapery-banner'); one.paused = true;"
    assert life.execute_script(f"{made} return one.hasAttribute('paused')"), "the page's own wish"


def test_the_pixels_of_another_screen_are_used_at_once(life: Any) -> None:
    before = first_picture(life).shape
    # Chromium tells pages of another ratio only where another thing changes too.
    metrics = {"width": 1200, "height": 800, "deviceScaleFactor": 2, "mobile": False}
    life.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", metrics)
    wait_until(lambda: picture(life).shape == (2 * before[0], 2 * before[1], 4))
    resize(life, (1280, 800))
    wait_until(lambda: picture(life).shape == before)


MOVED = """
const element = document.querySelector("drapery-banner");
const canvas = element.shadowRoot.querySelector("canvas");
const shown = [];
new MutationObserver(() => shown.push(canvas.hidden)).observe(canvas, { attributes: true });
for (const place of ["aside", "main"]) {
  document.querySelector(place).append(element);
  if ("moveBefore" in Element.prototype) document.querySelector(place).moveBefore(element, null);
}
setTimeout(() => arguments[0](shown), 60);
"""


def test_an_element_that_is_moved_goes_on(life: Any) -> None:
    before = first_picture(life)
    assert life.execute_async_script(MOVED) == []
    assert heard(life) == [] and not changes(life, before)
    life.execute_script(f"window.kept = {ELEMENT}; kept.remove();")
    settled(life)
    life.execute_script("document.querySelector('main').append(kept)")
    wait_until(lambda: is_live(life))
    assert heard(life) == [["ready", None]]


def test_an_element_is_ready_only_with_a_whole_context(life: Any) -> None:
    life.execute_script(
        "window.lost = contexts.at(-1).getExtension('WEBGL_lose_context'); lost.loseContext();"
        "const late = document.createElement('drapery-banner');"
        "late.setAttribute('design', 'blue');"
        "document.querySelector('aside').append(late);"
    )
    element = "document.querySelector('aside').lastChild"
    assert heard(life) == [] and not is_live(life, element)
    life.execute_script("lost.restoreContext()")
    wait_until(lambda: is_live(life, element))
    assert first_picture(life, element)[..., 3].any()
    assert ["ready", None] in heard(life)
