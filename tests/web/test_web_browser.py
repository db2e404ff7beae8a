"""Pages with live cloth in a real browser: they wave, obey pointer and keys, and fall back."""

import re
import shutil
from collections.abc import Callable, Iterator
from hashlib import sha256
from pathlib import Path
from typing import Any

import pytest
from selenium.webdriver import ActionChains, Keys
from selenium.webdriver.common.by import By
from studio_browser import wait_until
from web_sites import (
    CANVAS,
    ELEMENT,
    changes,
    first_picture,
    is_live,
    open_site,
    picture,
    served,
    warnings,
)

from drapery import Banner, draw
from drapery.banner import DYE_NAMES, PATTERN_NAMES
from drapery.settings import Settings
from drapery.web import package
from drapery.web.page import write_page

HERE = Path(__file__).parents[1]
NO_WEBGL = """
const get = HTMLCanvasElement.prototype.getContext;
HTMLCanvasElement.prototype.getContext = function (kind, ...more) {
  return kind === "webgl2" ? null : get.call(this, kind, ...more);
};
"""
ALONE = """<!doctype html><html lang="en"><meta charset="utf-8"><title>Inline</title><body>
<drapery-banner design="white creeper:lime"></drapery-banner>
<drapery-designer language="de"></drapery-designer>
<script type="module" src="drapery-inline.js"></script>
"""
INNER = "document.querySelector('drapery-designer')?.shadowRoot?.querySelector('drapery-banner')"
NO_SIMD = """
WebAssembly.compile = async () => {
  throw new WebAssembly.CompileError("Wasm SIMD unsupported");
};
"""
COUNT = """
window.contexts = 0;
const get = HTMLCanvasElement.prototype.getContext;
HTMLCanvasElement.prototype.getContext = function (kind, ...more) {
  window.contexts += kind === "webgl2";
  return get.call(this, kind, ...more);
};
"""
MANY = """<!doctype html><html lang="en"><title>Many</title>
<script type="module" src="drapery-banner.js"></script><main>
<drapery-banner design="red" wind="3"></drapery-banner>
<drapery-banner design="blue cross:white" kind="wall"></drapery-banner>
<drapery-banner design="plaid"><img alt="A plaid banner" src="data:,"></drapery-banner>
<div style="height: 3000px"></div>
<drapery-banner design="lime" id="below"></drapery-banner></main></html>
"""
PIXEL = "R0lGODlhAQABAIAAAP///wAAACwAAAAAAQABAAACAkQBADs="
"""A GIF of one pixel."""
LOST = """<!doctype html><html lang="en"><title>Lost</title>
<script type="module" src="drapery-banner.js"></script>
<drapery-banner kind="{kind}">
<img alt="A banner" src="data:image/gif;base64,{pixel}"></drapery-banner>
</html>
"""
KINDS = "wall", "lost", "../wall", "https://example.com/wall", "constructor"
"""The first is a kind of the component."""


def batched_layers() -> list[list[str]]:
    """Every pattern in a dye, two or three and once sixteen of them for each dye of a base."""
    each = [f"{name}:{DYE_NAMES[n % 16]}" for n, name in enumerate(PATTERN_NAMES)]
    return [each[-16:], *(each[n::15] for n in range(15))]


@pytest.fixture(scope="module")
def site(
    playable: Callable[..., Settings], tmp_path_factory: pytest.TempPathFactory
) -> Iterator[str]:
    """The address of a page of one file, of a package, and of a page with many of its elements."""
    folder = tmp_path_factory.mktemp("site")
    design = Banner.parse("white creeper:lime border:black")
    write_page(folder / "banner.html", design, playable(size=(320, 480)))
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(package, "POSES", {})
        package.write_component(folder, playable(size=(320, 480)))
    (folder / "many.html").write_text(MANY, encoding="utf-8")
    bare = folder / "bare"  # with the module and no other file of the package
    bare.mkdir()
    shutil.copy(folder / package.MODULE, bare)
    inline = folder / "inline"
    inline.mkdir()
    shutil.copy(folder / package.INLINE, inline)
    (inline / "index.html").write_text(ALONE, encoding="utf-8")
    for number, kind in enumerate(KINDS):
        text = LOST.format(kind=kind, pixel=PIXEL)
        (bare / f"lost{number}.html").write_text(text, encoding="utf-8")
    yield from served(folder)


def name_of(browser: Any) -> Any:
    """The first element's name for people who do not see it."""
    return ask(browser, f"{CANVAS}.ariaLabel")


def ask(browser: Any, what: str) -> Any:
    return browser.execute_script(f"return {ELEMENT}.{what}")


def element(browser: Any) -> Any:
    return browser.find_element(By.CSS_SELECTOR, "drapery-banner")


def is_fallback(browser: Any) -> bool:
    image = f"{ELEMENT}.querySelector('img')"
    return bool(
        browser.execute_script(
            f"return {image}.checkVisibility() && {image}.naturalWidth > 0 &&"
            f" {ELEMENT}.{CANVAS}.hidden"
        )
    )


def test_a_page_of_one_file_waves_and_is_named(chromium: Any, site: str) -> None:
    open_site(chromium, f"{site}/banner.html")
    before = first_picture(chromium)
    lime = (before[..., 1] > before[..., 0].astype(int) + 40) & (before[..., 3] == 255)
    assert 0.01 < lime.mean() < 0.2, "the creeper is there"
    wait_until(lambda: changes(chromium, before))
    assert name_of(chromium) == "Banner: Argent, a creeper Lime within a bordure Sable"
    for script in ("page_names.js", "page_contrast.js"):
        assert chromium.execute_script((HERE / script).read_text(encoding="utf-8")) == []
    assert warnings(chromium) == []


def test_the_module_with_all_files_needs_no_other(chromium: Any, site: str) -> None:
    open_site(chromium, f"{site}/inline/index.html")
    before = first_picture(chromium)
    wait_until(lambda: changes(chromium, before))
    wait_until(lambda: is_live(chromium, INNER))
    asked = chromium.execute_script(
        "return performance.getEntriesByType('resource').map((e) => e.name)"
    )
    assert {name.rpartition("/")[2] for name in asked} <= {"drapery-inline.js", "favicon.ico"}
    assert warnings(chromium) == []


def test_keys_turn_it_and_pause_it(chromium: Any, site: str) -> None:
    open_site(chromium, f"{site}/banner.html", moves=False)
    assert ask(chromium, "paused"), "who wants less motion gets a still picture"
    still = first_picture(chromium)
    ActionChains(chromium).send_keys(Keys.TAB).perform()
    focused = chromium.execute_script(f"return document.activeElement === {ELEMENT}")
    outline = chromium.execute_script(f"return getComputedStyle({ELEMENT}.{CANVAS}).outlineStyle")
    assert focused and outline == "solid"
    assert not changes(chromium, still)
    ActionChains(chromium).send_keys(Keys.ARROW_RIGHT * 4).perform()
    wait_until(lambda: changes(chromium, still))
    ActionChains(chromium).send_keys(Keys.HOME).perform()
    wait_until(lambda: not changes(chromium, still))
    ActionChains(chromium).send_keys(Keys.SPACE).perform()
    wait_until(lambda: not ask(chromium, "paused") and changes(chromium, still))


def test_the_pointer_pulls_the_cloth_and_turns_the_background(chromium: Any, site: str) -> None:
    open_site(chromium, f"{site}/banner.html", moves=False)
    still = first_picture(chromium)
    width, height = element(chromium).size["width"], element(chromium).size["height"]
    drag = ActionChains(chromium).move_to_element(element(chromium)).click_and_hold()
    drag.move_by_offset(int(0.3 * width), int(-0.1 * height)).pause(0.5).perform()
    right = slice(int(0.75 * still.shape[1]), None)
    edge = still[:, right, 3].mean()  # cloth follows to the right
    wait_until(lambda: picture(chromium)[:, right, 3].mean() > edge)
    ActionChains(chromium).release().perform()
    open_site(chromium, f"{site}/banner.html", moves=False)
    still = first_picture(chromium)
    corner = (-int(0.45 * width), -int(0.45 * height))
    turn = ActionChains(chromium).move_to_element_with_offset(element(chromium), *corner)
    turn.click_and_hold().move_by_offset(60, 0).release().perform()
    wait_until(lambda: changes(chromium, still))


FAULTS = (
    "window.faults = []; addEventListener('drapery-error', (event) => faults.push(event.detail))"
)


def test_a_wrong_value_is_told_once_for_each_time_it_is_set(chromium: Any, site: str) -> None:
    open_site(chromium, f"{site}/many.html", moves=False)
    chromium.execute_script(FAULTS)
    wrong = ("design", "paisley"), ("wind", "strong"), ("direction", "90"), ("alt", "Cloth")
    for name, value in wrong:
        chromium.execute_script(f"{ELEMENT}.setAttribute('{name}', '{value}')")
        chromium.execute_script(f"{ELEMENT}.paused = !{ELEMENT}.paused")
    ActionChains(chromium).move_to_element(element(chromium)).move_by_offset(20, 0).perform()
    design, wind = chromium.execute_script("return faults")
    assert "unknown dye 'paisley'" in design
    assert wind == 'drapery: wind="strong" is not a number; write wind="4"'


def test_attributes_change_what_is_shown(chromium: Any, site: str) -> None:
    open_site(chromium, f"{site}/many.html", moves=False)
    red = first_picture(chromium)
    assert name_of(chromium) == "red banner"
    chromium.execute_script(f"{ELEMENT}.setAttribute('design', 'blue skull:white')")
    wait_until(lambda: changes(chromium, red))
    blue = picture(chromium)
    assert blue[..., 2].sum() > blue[..., 0].sum()
    assert name_of(chromium) == "blue banner, white skull"
    chromium.execute_script(f"{ELEMENT}.setAttribute('design', 'paisley')")
    chromium.execute_script(f"{ELEMENT}.setAttribute('wind', 'strong')")
    assert not changes(chromium, blue), "what was seen stays"
    lines = [line for line in warnings(chromium) if "plaid" not in line]
    assert len(lines) == 2 and "'paisley'" in lines[0] and "wind" in lines[1]
    chromium.execute_script(f"{ELEMENT}.setAttribute('design', 'blue skull:white')")
    chromium.execute_script(f"{ELEMENT}.setAttribute('kind', 'wall')")
    wait_until(lambda: changes(chromium, blue))


DESIGNS = (
    *("white", "red creeper:black", "ominous", "white Per Fess Inverted:blue Base:red"),
    *(f"{dye} {' '.join(layers)}" for dye, layers in zip(DYE_NAMES, batched_layers(), strict=True)),
)
PICTURES = """
const [designs, done] = arguments;
const element = document.querySelector("drapery-banner");
(async () => {
  const found = [];
  for (const design of designs) {
    element.setAttribute("design", design);
    const { data, width, height } = await element.picture();
    const digest = new Uint8Array(await crypto.subtle.digest("SHA-256", data));
    found.push([width, height, [...digest]]);
  }
  return found;
})().then(done, (error) => done(String(error)));
"""


def test_a_picture_has_the_bits_of_the_renderer(
    chromium: Any, site: str, playable: Callable[..., Settings]
) -> None:
    open_site(chromium, f"{site}/many.html", moves=False)
    found = chromium.execute_async_script(PICTURES, DESIGNS)
    settings = playable(size=(320, 480))
    drawn = [draw(Banner.parse(design), settings).pixels for design in DESIGNS]
    assert len(DESIGNS) == 20
    assert found == [[320, 480, [*sha256(each.tobytes()).digest()]] for each in drawn]


MEMORY = """
const instantiate = WebAssembly.instantiate;
window.memories = [];
WebAssembly.instantiate = async (...words) => {
  const instance = await instantiate(...words);
  window.memories.push(instance.exports.memory);
  return instance;
};
"""
LATE = """
const [done] = arguments;
const main = document.querySelector("main");
for (let n = 0; n < 200; n++) {
  const element = document.createElement("drapery-banner");
  main.append(element);
  element.remove();
}
const last = document.createElement("drapery-banner");
last.addEventListener("drapery-ready", () => done(memories.map(({ buffer }) => buffer.byteLength)));
main.append(last);
"""


def test_elements_that_are_gone_before_they_are_ready_take_no_memory(
    chromium: Any, site: str
) -> None:
    open_site(chromium, f"{site}/many.html", script=MEMORY)
    before = chromium.execute_script("return memories.map(({ buffer }) => buffer.byteLength)")
    after = chromium.execute_async_script(LATE)
    assert len(before) == len(after) == 1 and after[0] - before[0] < 4 << 20


def test_properties_say_what_attributes_say(chromium: Any, site: str) -> None:
    open_site(chromium, f"{site}/many.html", moves=False)
    chromium.execute_script(f"{ELEMENT}.design = 'blue'; {ELEMENT}.wind = 7;")
    assert name_of(chromium) == "blue banner"
    found = "return [element.design, element.wind, element.direction, element.getAttribute('wind')]"
    assert chromium.execute_script(f"const element = {ELEMENT}; {found}") == [
        "blue",
        "7",
        None,
        "7",
    ]
    chromium.execute_script(f"{ELEMENT}.design = null;")
    assert name_of(chromium) == "white banner"
    early = "const e = document.createElement('drapery-cape'); e.pose = 'run'; return e.pose"
    assert chromium.execute_script(early) == "run"


def test_all_elements_of_a_page_share_a_context_and_rest_out_of_sight(
    chromium: Any, site: str
) -> None:
    open_site(chromium, f"{site}/many.html", script=COUNT)
    below = "document.getElementById('below')"
    wait_until(lambda: is_live(chromium, below))
    assert chromium.execute_script("return contexts") == 1
    first, hidden = first_picture(chromium), first_picture(chromium, below)
    wait_until(lambda: changes(chromium, first))
    assert not changes(chromium, hidden, below)
    chromium.execute_script(f"{below}.scrollIntoView()")
    wait_until(lambda: changes(chromium, hidden, below))
    chromium.execute_script("document.querySelector('main').replaceChildren()")
    assert [line for line in warnings(chromium) if "plaid" not in line] == []


def test_elements_of_all_sizes_have_the_pixels_of_the_screen(chromium: Any, site: str) -> None:
    open_site(chromium, f"{site}/many.html", moves=False)
    blue, below = "document.querySelector('[kind=wall]')", "document.getElementById('below')"
    for element in (blue, below):
        wait_until(lambda element=element: is_live(chromium, element))
    whole = first_picture(chromium, blue)
    assert whole.shape == (336, 224, 4)
    chromium.execute_script(f"{below}.style.inlineSize = '90px'; {blue}.after({below})")
    wait_until(lambda: picture(chromium, below).shape == (135, 90, 4))
    wait_until(lambda: picture(chromium, below)[..., 3].any())
    drawn = "arguments[0](1)"
    chromium.execute_async_script(f"{blue}.snapshot().then(() => {drawn})")
    alone = picture(chromium, blue).astype(float)
    assert abs(alone - whole).mean() < 0.5, "it looks the same alone and beside others"
    metrics = {"width": 1280, "height": 900, "deviceScaleFactor": 2, "mobile": False}
    chromium.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", metrics)
    try:
        chromium.execute_async_script(f"{blue}.snapshot().then(() => {drawn})")
        assert picture(chromium, blue).shape == (672, 448, 4)
    finally:
        chromium.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})


@pytest.mark.parametrize(
    ("query", "script", "reason"),
    [
        ("?policy", "", "WebAssembly"),
        ("", NO_WEBGL, "WebGL 2 is missing"),
        ("", "delete window.WebAssembly", "this browser has no WebAssembly"),
        ("", NO_SIMD, "Wasm SIMD unsupported"),
    ],
)
def test_where_it_cannot_play_its_picture_is_shown(
    chromium: Any, site: str, query: str, script: str, reason: str
) -> None:
    open_site(chromium, f"{site}/banner.html{query}", ready=False, script=script)
    (line,) = wait_until(lambda: warnings(chromium))
    assert reason in line
    assert is_fallback(chromium)


def test_a_file_that_cannot_be_loaded_shows_what_the_page_put_there(
    chromium: Any, site: str
) -> None:
    for number in range(len(KINDS)):
        open_site(chromium, f"{site}/bare/lost{number}.html", ready=False)
        (line,) = wait_until(lambda: warnings(chromium))
        if number:
            # Nothing is fetched: no other site, and no file of another name.
            assert "kind=" in line and "is not known; use standing, wall" in line
        else:
            # The files are fetched side by side; the first that is missing is named.
            assert re.match(r"\w+\.bin: the server answers 404; put the files of the package", line)
        assert is_fallback(chromium)


def test_an_unknown_design_shows_what_the_page_put_there(chromium: Any, site: str) -> None:
    open_site(chromium, f"{site}/many.html")
    plaid = "document.querySelector('[design=plaid]')"
    assert chromium.execute_script(f"return {plaid}.querySelector('img').checkVisibility()")
    assert not is_live(chromium, plaid)
    assert len([line for line in warnings(chromium) if "unknown dye 'plaid'" in line]) == 1
