"""The designer in a real browser: edits, undo, commands, links, keys, and all widths."""

import base64
import io
import json
import zipfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from PIL import Image
from selenium.webdriver import ActionChains, Keys
from studio_browser import PHONE, resize, wait_until
from web_sites import served

from drapery import Banner
from drapery.banner import PATTERN_NAMES, ItemDetails, write_give
from drapery.settings import Settings
from drapery.web.designer_page import write_designer

DESKTOP = (1440, 900)
HOST = "document.querySelector('drapery-designer')"
ROOT = f"{HOST}.shadowRoot"
COPIED = """
window.copied = [];
navigator.clipboard.writeText = async (text) => { window.copied.push(text); };
"""


@pytest.fixture(scope="module")
def site(
    playable: Callable[..., Settings], tmp_path_factory: pytest.TempPathFactory
) -> Iterator[str]:
    folder = tmp_path_factory.mktemp("designer")
    write_designer(folder, playable(size=(320, 480)))
    yield from served(folder)


def open_designer(chromium: Any, address: str, size: tuple[int, int] = DESKTOP) -> None:
    """Load the page without what it kept, and wait for its controls."""
    resize(chromium, size)
    chromium.get(address)
    chromium.execute_script("sessionStorage.clear(); document.title = 'old'; location.reload();")
    wait_until(lambda: chromium.title != "old" and run(chromium, f"!!{ROOT}.querySelector('.app')"))
    chromium.execute_script(COPIED)


def run(chromium: Any, expression: str, *words: Any) -> Any:
    return chromium.execute_script(f"return {expression};", *words)


def press(chromium: Any, selector: str) -> None:
    """Press what a selector finds in the element."""
    chromium.execute_script(f"{ROOT}.querySelector(arguments[0]).click();", selector)


def typed(chromium: Any, selector: str, text: str) -> Any:
    """The field that a selector finds, with a text typed into it in place of its own."""
    field = run(chromium, f"{ROOT}.querySelector(arguments[0])", selector)
    chromium.execute_script("arguments[0].focus(); arguments[0].select();", field)
    ActionChains(chromium).send_keys(text).perform()
    return field


def design(chromium: Any) -> str:
    return str(run(chromium, f"{HOST}.design"))


def test_layers_are_added_undone_and_copied_as_a_command(chromium: Any, site: str) -> None:
    open_designer(chromium, f"{site}/#white,creeper:lime")
    chromium.execute_script(
        "window.heard = [];"
        f"{HOST}.addEventListener('drapery-change', (event) => heard.push(event.detail));"
    )
    press(chromium, '[data-dye="red"]')
    press(chromium, '[data-pattern="border"]')
    assert design(chromium) == "white creeper:lime border:red"
    assert run(chromium, "heard.at(-1).commands['1.8']").startswith(
        "/give @p minecraft:banner 1 15"
    )
    assert run(chromium, "location.hash") == "#white,creeper:lime,border:red"
    press(chromium, ".main")
    banner = Banner.parse("white creeper:lime border:red")
    wait_until(lambda: run(chromium, "copied[0]"))
    assert run(chromium, "copied[0]") == write_give(banner, "give", ItemDetails())
    app = run(chromium, f"{ROOT}.querySelector('.layer')")
    app.send_keys(Keys.CONTROL + "z")
    assert design(chromium) == "white creeper:lime"
    app = run(chromium, f"{ROOT}.querySelector('.layer')")
    app.send_keys(Keys.CONTROL + "y")
    assert design(chromium) == "white creeper:lime border:red"
    shown = f"{ROOT}.querySelector('drapery-banner').getAttribute('design')"
    assert run(chromium, shown) == "white creeper:lime border:red"


def test_a_link_opens_the_design_and_a_reload_keeps_the_history(chromium: Any, site: str) -> None:
    open_designer(chromium, f"{site}/#white,creeper:lime")
    press(chromium, '[data-pattern="skull"]')
    press(chromium, ".side .row + .command + .hint + .row button")
    link = wait_until(lambda: run(chromium, "copied[0]"))
    assert link == f"{site}/index.html#white,creeper:lime,skull:black" or link == (
        f"{site}/#white,creeper:lime,skull:black"
    )
    chromium.execute_script("location.reload();")
    wait_until(lambda: run(chromium, f"!!{ROOT}?.querySelector('.app') && !window.copied"))
    press(chromium, '[aria-keyshortcuts="Control+Z"]')
    assert design(chromium) == "white creeper:lime"
    open_designer(chromium, link)
    assert design(chromium) == "white creeper:lime skull:black"


def test_the_keyboard_alone_edits_layers(chromium: Any, site: str) -> None:
    open_designer(chromium, f"{site}/#white,creeper:lime,border:black,skull:red")
    layer = run(chromium, f"{ROOT}.querySelector('.layer')")  # the skull
    layer.send_keys(Keys.ALT + Keys.ARROW_DOWN)
    assert design(chromium) == "white creeper:lime skull:red border:black"
    focused = f"{ROOT}.activeElement"
    run(chromium, focused).send_keys("h")
    assert design(chromium) == "white creeper:lime border:black"
    run(chromium, focused).send_keys("d")
    run(chromium, focused).send_keys(Keys.ARROW_UP)
    run(chromium, focused).send_keys(Keys.DELETE)
    run(chromium, focused).send_keys(Keys.ENTER)
    assert run(chromium, f"{focused}.getAttribute('aria-pressed')") == "true"
    pattern = run(chromium, f"{ROOT}.querySelector('.pattern[tabindex=\"0\"]')")
    pattern.send_keys(Keys.ARROW_RIGHT)
    assert run(chromium, f"{focused}.dataset.pattern") == PATTERN_NAMES[1]
    pattern.send_keys("/")
    assert run(chromium, f"{focused}.type") == "search"


@pytest.mark.parametrize("words", ["Totenkopf", "pirate", "skull charge", "sku", "czaszki", "头颅"])
def test_patterns_are_found_by_names_codes_and_everyday_words(
    chromium: Any, site: str, words: str
) -> None:
    open_designer(chromium, site)
    typed(chromium, ".find", words).send_keys(Keys.ENTER)
    assert design(chromium).split()[-1] == "skull:black"


def test_numbers_are_typed_with_a_comma_and_errors_stand_at_their_field(
    chromium: Any, site: str
) -> None:
    open_designer(chromium, site)
    wind = f"{ROOT}.querySelector('drapery-banner').getAttribute('wind')"
    typed(chromium, ".number", "2,5")
    assert run(chromium, wind) == "2.5"
    for wrong in ("-5", "1e9", "41", "fast"):
        field = typed(chromium, ".number", wrong)
        assert run(chromium, "arguments[0].getAttribute('aria-invalid')", field) == "true"
        assert field.get_attribute("value") == wrong
        assert 0 <= float(run(chromium, wind)) <= 40
    fault = run(chromium, f"{ROOT}.querySelector('.number-field .fault').textContent")
    assert fault == "Write a number from 0 to 40."
    press(chromium, '[aria-keyshortcuts="Control+Z"]')
    assert run(chromium, wind) == "6"


def chosen(chromium: Any, name: str, value: str) -> None:
    """Choose in the menu of a name."""
    chromium.execute_script(
        f"const menu = [...{ROOT}.querySelectorAll('.menu')].find((e) => e.innerText.startsWith("
        "arguments[0])).querySelector('select');"
        "menu.value = arguments[1]; menu.dispatchEvent(new Event('change'));",
        *(name, value),
    )


def test_fabric_view_placement_and_daylight_are_chosen_undone_and_kept(
    chromium: Any, site: str
) -> None:
    open_designer(chromium, site)
    banner = f"{ROOT}.querySelector('drapery-banner')"
    names = ("kind", "fabric", "view", "daylight")
    now = f"{json.dumps(names)}.map((name) => {banner}.getAttribute(name))"
    assert run(chromium, now) == ["standing", None, None, None], "as the package has them"
    chosen(chromium, "Placement", "wall")
    chosen(chromium, "Fabric", "silk")
    chosen(chromium, "View", "iso")
    field = run(chromium, f"{ROOT}.querySelectorAll('.number')[2]")
    chromium.execute_script("arguments[0].focus(); arguments[0].select();", field)
    ActionChains(chromium).send_keys("0,4").perform()
    assert run(chromium, now) == ["wall", "silk", "iso", "0.4"]
    chromium.execute_script("window.copied.length = 0;")
    press(chromium, ".side .row + .command + .hint + .row button:last-child")
    embed = wait_until(lambda: run(chromium, "copied[0]"))
    assert 'kind="wall"' in embed and 'fabric="silk" view="iso" daylight="0.4">' in embed
    chromium.execute_script("location.reload();")
    wait_until(lambda: run(chromium, f"!!{ROOT}?.querySelector('.app') && !window.copied"))
    assert run(chromium, now) == ["wall", "silk", "iso", "0.4"]
    for wanted in (["wall", "silk", "iso"], ["wall", "silk", None], ["wall", None, None]):
        press(chromium, '[aria-keyshortcuts="Control+Z"]')
        assert run(chromium, now) == [*wanted, None]
    assert run(chromium, f"{ROOT}.querySelectorAll('.number')[2].value") == "1"


def test_a_shield_is_drawn_as_a_shield(chromium: Any, site: str) -> None:
    open_designer(chromium, f"{site}/#white,creeper:lime")
    chromium.execute_script(f"{ROOT}.querySelector('[data-value=shield]').click()")
    banner = f"{ROOT}.querySelector('drapery-banner')"
    assert run(chromium, f"{banner}.getAttribute('kind')") == "shield"
    name = f"{banner}.shadowRoot.querySelector('canvas').ariaLabel"
    wait_until(lambda: run(chromium, name) == "white shield, lime creeper")
    hidden = f"[...{ROOT}.querySelectorAll('.motion [hidden]')].filter((e) => !e.matches('.fault'))"
    assert run(chromium, f"{hidden}.length") == 4, "wind, direction, fabric, placement"
    press(chromium, '[aria-keyshortcuts="Control+Z"]')
    assert run(chromium, f"{banner}.getAttribute('kind')") == "standing"


DROPPED = """
const [root, name, text, done] = arguments;
const bytes = Uint8Array.from(atob(text), (each) => each.charCodeAt(0));
const dataTransfer = new DataTransfer();
dataTransfer.items.add(new File([bytes], name));
const options = { dataTransfer, cancelable: true, bubbles: true, composed: true };
root.querySelector(".app").dispatchEvent(new DragEvent("drop", options));
"""
DROP = f"""{DROPPED}
const told = root.querySelector(".pack");
const seen = () => told.textContent
  ? done([told.textContent, told.matches(".fault")])
  : requestAnimationFrame(seen);
told.textContent = "";
seen();
"""
COLOURS = """
const [root, done] = arguments;
const mean = (canvas, size) => {
  const context = new OffscreenCanvas(1, 1).getContext("2d");
  context.drawImage(canvas, ...size, 0, 0, 1, 1);
  return [...context.getImageData(0, 0, 1, 1).data].slice(0, 3);
};
const live = root.querySelector(".sky > :first-child").shadowRoot.querySelector("canvas");
const middle = [live.width / 2 - 2, live.height / 2 - 2, 4, 4];
const face = root.querySelector('[data-pattern="creeper"] canvas');
done([mean(face, [4, 4, 2, 2]), [face.width, face.height], mean(live, middle)]);
"""


def pack_of(**files: bytes) -> bytes:
    """A zip in base64 with textures of entities, by their names with `__` for a folder."""
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files.items():
            path = name.replace("__", "/")
            archive.writestr(f"mine/assets/minecraft/textures/entity/{path}.png", data)
    return base64.b64encode(content.getvalue())


def sheet(side: int, *colour: int) -> bytes:
    """A PNG of one colour."""
    content = io.BytesIO()
    Image.new("RGBA", (side, side), colour).save(content, "PNG")
    return content.getvalue()


def test_a_pack_shows_in_all_pictures_and_says_what_it_lacks(chromium: Any, site: str) -> None:
    """One that is no pack changes nothing."""
    open_designer(chromium, f"{site}/#white,creeper:white")
    root, kinds = run(chromium, ROOT), f"{ROOT}.querySelector('.segments [data-value=ARG]').click()"

    def drop(name: str, data: bytes) -> Any:
        return chromium.execute_async_script(DROP, root, name, data.decode())

    def colours() -> Any:
        return chromium.execute_async_script(COLOURS, root)

    grey, red, green = (sheet(128, *rgb, 255) for rgb in ((9, 9, 9), (200, 0, 0), (0, 200, 0)))
    pack = pack_of(
        banner_base=grey, banner__creeper=red, shield__creeper=green, banner__bricks=b"x"
    )
    told, is_wrong = drop("mine.zip", pack)
    assert told.startswith("mine.zip: 3 textures. It lacks Base, Square bottom left,")
    assert told.endswith(" + 35. Not used: entity/banner/bricks.") and not is_wrong
    wait_until(lambda: colours()[2][0] > 120 and colours()[2][1] == 0)
    assert colours()[0] == [23, 0, 0] and colours()[1] == [20, 40]
    chromium.execute_script(kinds.replace("ARG", "shield"))
    wait_until(lambda: colours()[:2] == [[0, 23, 0], [12, 22]])
    wait_until(lambda: colours()[2][1] > 120 and colours()[2][0] == 0)
    for data in (b"", base64.b64encode(b"PK" * 40), pack_of(block=red)):
        told, is_wrong = drop("none.zip", data)
        assert told.startswith("none.zip ") and is_wrong
    assert colours()[0] == [0, 23, 0], "the pack is still there"
    press(chromium, ".without")
    wait_until(lambda: colours()[0] != [0, 23, 0])


def test_the_loom_names_materials_and_steps(chromium: Any, site: str) -> None:
    open_designer(chromium, f"{site}/#white,creeper:lime,flow:red,border:lime")
    lines = f"[...{ROOT}.querySelectorAll('ARG.loom li')].map((e) => e.textContent)"
    assert run(chromium, lines.replace("ARG", "ol")) == [
        *("Lime: CreeperBanner pattern: Creeper", "Red: FlowBanner pattern: Flow", "Lime: Border"),
    ]
    assert run(chromium, lines.replace("ARG", "ul")) == [
        *("6 × Wool (White)", "1 × Stick", "2 × Dye (Lime)", "1 × Dye (Red)", "1 × Paper"),
        *("1 × Creeper head", "1 × Banner pattern: Creeperkept"),
        "1 × Banner pattern: Flowkept, from trial chambers",
    ]


def test_layers_that_change_nothing_are_left_out(chromium: Any, site: str) -> None:
    open_designer(chromium, f"{site}/#white,creeper:lime,skull:blue,base:red,border:lime")
    button = f"{ROOT}.querySelector('details.panel button')"
    wait_until(lambda: run(chromium, f"{button}.textContent.endsWith(': 2')"))
    run(chromium, f"{button}.click()")
    wait_until(lambda: run(chromium, f"{button}.hidden"))
    assert run(chromium, f"{HOST}.design") == "white base:red border:lime"


FILM = """
const [banner, done] = arguments;
const film = document.createElement("video");
banner.record(0.7).then(async (blob) => {
  film.src = URL.createObjectURL(blob);
  film.muted = true;
  await film.play();
  done([blob.type.split(";")[0], blob.size, film.videoWidth, film.videoHeight, banner.paused]);
}).catch((error) => done(String(error)));
"""


def test_a_film_of_the_moving_cloth_is_played_by_the_browser(chromium: Any, site: str) -> None:
    open_designer(chromium, site)
    banner = f"{ROOT}.querySelector('drapery-banner')"
    canvas = f"{banner}.shadowRoot.querySelector('canvas')"
    wait_until(lambda: run(chromium, f"!{canvas}.hidden"))
    kind, size, *shown, paused = chromium.execute_async_script(FILM, run(chromium, banner))
    assert kind in ("video/webm", "video/mp4") and size > 2000
    assert shown == run(chromium, f"[{canvas}.width, {canvas}.height]"), "from its first frame on"
    assert paused, "as it was"


def test_texts_are_pasted_with_name_lore_and_count(chromium: Any, site: str) -> None:
    open_designer(chromium, site)
    details = ItemDetails("@a", 3, "Flag", ("of the north",))
    text = write_give(Banner.parse("red cross:white"), "give", details)
    typed(chromium, ".paste", text).send_keys(Keys.ENTER)
    assert design(chromium) == "red cross:white"
    for version, form in (("1.21.5", "give"), ("1.8", "give-1.12")):
        found = run(chromium, f"{HOST}.getDesign().commands['{version}']")
        assert found == write_give(Banner.parse("red cross:white"), form, details)
    typed(chromium, ".paste", "plaid <b>").send_keys(Keys.ENTER)
    fault = run(chromium, f"{ROOT}.querySelector('#paste-fault').textContent")
    assert fault.startswith("unknown dye 'plaid'") and "drapery studio" in fault
    assert design(chromium) == "red cross:white"


def test_properties_and_methods_take_every_form(chromium: Any, site: str) -> None:
    open_designer(chromium, site)
    chromium.execute_script(f"{HOST}.design = '/give @p minecraft:red_banner';")
    assert design(chromium) == "red"
    given = {"base": "blue", "layers": [{"pattern": "skull", "dye": "white"}], "kind": "shield"}
    assert run(chromium, f"{HOST}.setDesign(arguments[0])", given) == []
    assert design(chromium) == "shield blue skull:white"
    chromium.execute_script(f"{HOST}.setAttribute('design', 'lime')")
    assert design(chromium) == "lime"
    thrown = "(() => { try { %s.design = 'plaid'; } catch (e) { return e.message; } })()"
    assert "unknown dye" in run(chromium, thrown % HOST)


def test_a_page_without_a_clipboard_copies_too(chromium: Any, site: str) -> None:
    open_designer(chromium, f"{site}/#red")
    chromium.execute_script("Object.defineProperty(navigator, 'clipboard', { value: undefined });")
    field = f"{ROOT}.querySelector('.command').value"
    command = run(chromium, field)
    link = ".side .row + .command + .hint + .row button"
    run(chromium, f"{ROOT}.querySelector('{link}')").click()  # pages copy only for a user
    status = f"{ROOT}.querySelector('.status').textContent"
    wait_until(lambda: run(chromium, status) == "Copied")
    assert run(chromium, field) == command


def test_layers_are_dragged(chromium: Any, site: str) -> None:
    open_designer(chromium, f"{site}/#white,creeper:lime,border:black,skull:red")
    grip = run(chromium, f"{ROOT}.querySelector('.grip')")  # of the skull
    high = run(chromium, f"{ROOT}.querySelector('li').getBoundingClientRect().height")
    chain = ActionChains(chromium).move_to_element(grip).click_and_hold()
    chain.move_by_offset(0, int(1.2 * high)).release().perform()
    assert design(chromium) == "white creeper:lime skull:red border:black"


def test_random_designs_have_no_layer_that_is_not_seen(chromium: Any, site: str) -> None:
    open_designer(chromium, site)
    seen = set()
    for _ in range(10):
        press(chromium, '[aria-label="Random design"]')
        seen.add(design(chromium))
    assert len(seen) == 10
    assert all(3 <= len(text.split()) <= 7 and " base:" not in text for text in seen)


def test_all_patterns_are_on_one_screen_and_no_page_is_too_wide(chromium: Any, site: str) -> None:
    open_designer(chromium, site)
    below = f"[...{ROOT}.querySelectorAll('.pattern')].map((e) => e.getBoundingClientRect().bottom)"
    bottoms = run(chromium, below)
    assert len(bottoms) == len(PATTERN_NAMES) and max(bottoms) <= DESKTOP[1]
    for size in (DESKTOP, PHONE, (320, 640), (1000, 700)):
        resize(chromium, size)
        assert run(chromium, "document.documentElement.scrollWidth") <= size[0], size
        dyes = run(chromium, f"{ROOT}.querySelector('.dye-grid').getBoundingClientRect().bottom")
        assert size != PHONE or dyes <= PHONE[1]  # in reach
        rows = f"new Set([...{ROOT}.querySelectorAll('.tools > *')].map((e) => e.offsetTop)).size"
        assert run(chromium, rows) == (1 if size[0] > 320 else 2)


CUT = """
const [root] = arguments;
const cut = [...root.querySelectorAll("select")].filter((each) => {
  const alone = each.cloneNode();
  alone.append(each.selectedOptions[0].cloneNode(true));
  alone.style.inlineSize = "auto";
  each.parentElement.append(alone);
  const is = getComputedStyle(each).opacity > 0 && alone.offsetWidth > each.offsetWidth;
  alone.remove();
  return is;
});
const { content } = getComputedStyle(root.querySelector(".language"), "::before");
return [JSON.parse(content), cut.map((each) => each.selectedOptions[0].text)];
"""
"""What stands for the chosen language on a phone, and lists whose chosen words are cut."""


def test_a_language_is_chosen_and_kept(chromium: Any, site: str) -> None:
    open_designer(chromium, site)
    title = f"{ROOT}.querySelector('h1').textContent"
    assert run(chromium, title) == "Banner designer"
    chromium.execute_script(
        f"const menu = {ROOT}.querySelector('.language select'); menu.value = 'de';"
        "menu.dispatchEvent(new Event('change'));"
    )
    wait_until(lambda: run(chromium, title) == "Banner-Designer")
    resize(chromium, PHONE)
    assert chromium.execute_script(CUT, run(chromium, ROOT)) == ["de", []]
    resize(chromium, DESKTOP)
    assert run(chromium, f"{ROOT}.querySelector('[data-dye]').title") == "Weiß"
    chromium.get("about:blank")
    chromium.get(site)
    wait_until(
        lambda: run(chromium, f"{ROOT}?.querySelector('h1')?.textContent === 'Banner-Designer'")
    )
    chromium.execute_script("localStorage.clear()")


def test_controls_have_names(chromium: Any, site: str) -> None:
    open_designer(chromium, site)
    nameless = f"""[...{ROOT}.querySelectorAll('button, input, select, textarea')].filter((e) =>
      !(e.getAttribute('aria-label') || e.textContent || e.labels?.[0]?.innerText || '').trim()
    ).length"""
    wait_until(lambda: run(chromium, nameless) == 0)
    assert run(chromium, f"{ROOT}.querySelector('.status').getAttribute('role')") == "status"


def test_the_picture_is_that_of_the_package(chromium: Any, site: str) -> None:
    open_designer(chromium, site)
    banner = f"{ROOT}.querySelector('drapery-banner')"
    wait_until(lambda: run(chromium, f"!{banner}.shadowRoot.querySelector('canvas').hidden"))
    size = chromium.execute_async_script(
        f"const done = arguments[0]; {banner}.picture().then((p) => done([p.width, p.height]));"
    )
    assert size == [320, 480]


def test_the_package_has_types_and_no_sources_of_ours(site: str, tmp_path: Path) -> None:
    from urllib.request import urlopen

    with urlopen(f"{site}/drapery-designer.d.ts") as answer:
        assert b"class DraperyDesigner" in answer.read()


def test_a_dropped_skin_shows_a_player_with_the_design_as_its_cape(
    chromium: Any, site: str
) -> None:
    open_designer(chromium, f"{site}/#red,square_top_left:red")
    root, shown = run(chromium, ROOT), f"{ROOT}.querySelector('.sky').firstChild"
    loaded = "performance.getEntriesByType('resource').map((each) => each.name.split('/').at(-1))"

    def drop(name: str, data: bytes) -> None:
        chromium.execute_script(DROPPED, root, name, base64.b64encode(data).decode())

    def told() -> str:
        return str(run(chromium, f"{ROOT}.querySelector('.pack').textContent"))

    def middle() -> list[int]:
        colours: list[list[int]] = chromium.execute_async_script(COLOURS, root)
        return colours[2]

    drop("small.png", sheet(40, 0, 0, 255, 255))
    wait_until(lambda: told().startswith("small.png is 40 x 40 px; use 64 x 64"))
    assert run(chromium, f"{shown}.localName") == "drapery-banner"
    assert "wearer-cape.bin" not in run(chromium, loaded)
    drop("me.png", sheet(64, 0, 0, 255, 255))
    wait_until(lambda: told() == "me.png: a player has the design.")
    assert run(chromium, f"{shown}.localName") == "drapery-wearer"
    wait_until(lambda: middle()[0] > 100 > 2 * middle()[1])
    hidden = f"[...{ROOT}.querySelectorAll('.motion [hidden]')].filter((e) => !e.matches('.fault'))"
    assert run(chromium, f"{hidden}.length") == 3, "fabric, placement, view"
    assert "wearer-cape.bin" in run(chromium, loaded)
    press(chromium, '[data-dye="lime"]')
    press(chromium, '[data-pattern="base"]')
    wait_until(lambda: middle()[1] > 120 > middle()[0])
    press(chromium, ".bare")
    assert run(chromium, f"{shown}.localName") == "drapery-banner"
    assert told() == ""


EARLY = """
const waiting = setInterval(() => {
  const designer = document.querySelector("drapery-designer");
  if (!designer?.shadowRoot) return;
  clearInterval(waiting);
  window.early = !designer.shadowRoot.querySelector(".app");
  const [dataTransfer, clipboardData] = [new DataTransfer(), new DataTransfer()];
  const more = { bubbles: true, cancelable: true };
  clipboardData.setData("text/plain", "blue skull:white");
  document.body.dispatchEvent(new ClipboardEvent("paste", { clipboardData, ...more }));
  dataTransfer.items.add(new File(["nothing"], "early.zip"));
  designer.dispatchEvent(new DragEvent("drop", { dataTransfer, ...more }));
}, 1);
"""


def test_what_comes_before_the_designer_is_there_is_read(chromium: Any, site: str) -> None:
    added = chromium.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": EARLY})
    try:
        open_designer(chromium, site)
        assert run(chromium, "window.early")
        wait_until(lambda: design(chromium) == "blue skull:white")
        told = f"{ROOT}.querySelector('.pack').textContent"
        wait_until(lambda: run(chromium, told).startswith("early.zip is no zip"))
    finally:
        chromium.execute_cdp_cmd("Page.removeScriptToEvaluateOnNewDocument", added)


SHARES = """
const [root, done] = arguments;
(async () => {
  const image = await createImageBitmap(await root.querySelector(".sky > :first-child").snapshot());
  const context = new OffscreenCanvas(image.width, image.height).getContext("2d");
  context.drawImage(image, 0, 0);
  const { data } = context.getImageData(0, 0, image.width, image.height);
  const shares = [0, 0];
  for (let at = 0; at < data.length; at += 4) {
    const [red, green, blue] = data.subarray(at, at + 3);
    if (Math.max(red, green) < 90 || blue > Math.max(red, green) / 2) continue;
    if (red > 2 * green) shares[0] += 4 / data.length;
    else if (green > 1.4 * red) shares[1] += 4 / data.length;
  }
  done(shares);
})();
"""


@pytest.mark.parametrize("garment", ["tabard", "shield"])
def test_the_player_of_a_skin_has_the_design_as_tabard_or_shield_too(
    chromium: Any, site: str, garment: str
) -> None:
    open_designer(chromium, f"{site}/#red,square_top_left:red")
    root, shown = run(chromium, ROOT), f"{ROOT}.querySelector('.sky').firstChild"

    def shares() -> list[float]:
        """Of the picture, what is red and what is lime."""
        found: list[float] = chromium.execute_async_script(SHARES, root)
        return found

    choice = f".stage .segments [data-value={garment}]"
    assert not run(chromium, f"{ROOT}.querySelector('{choice}').checkVisibility()")
    skin = base64.b64encode(sheet(64, 0, 0, 255, 255)).decode()
    chromium.execute_script(DROPPED, root, "me.png", skin)
    wait_until(lambda: run(chromium, f"{shown}.localName") == "drapery-wearer")
    wait_until(lambda: run(chromium, f"!{shown}.shadowRoot.querySelector('canvas').hidden"))
    press(chromium, choice)
    loaded = "performance.getEntriesByType('resource').map((each) => each.name.split('/').at(-1))"
    wait_until(lambda: f"wearer-{garment}.bin" in run(chromium, loaded))
    assert "wearer-cape.bin" in run(chromium, loaded)
    wait_until(lambda: run(chromium, f"{ROOT}.querySelector('{choice}').ariaPressed") == "true")
    assert design(chromium).startswith("shield ") == (garment == "shield")
    wait_until(lambda: shares()[0] > 0.04)
    grass = shares()[1]
    press(chromium, '[data-dye="lime"]')
    press(chromium, '[data-pattern="base"]')
    wait_until(lambda: shares()[0] < 0.01 and shares()[1] > grass + 0.04)
    press(chromium, ".stage .segments [data-value=cape]")
    assert not design(chromium).startswith("shield ")


def test_the_back_of_a_worn_shield_has_the_texture_of_a_dropped_pack(
    chromium: Any, site: str
) -> None:
    open_designer(chromium, f"{site}/#red")
    root, shown = run(chromium, ROOT), f"{ROOT}.querySelector('.sky').firstChild"

    def greens() -> float:
        """How much of the picture is green."""
        return float(chromium.execute_async_script(SHARES, root)[1])

    skin = base64.b64encode(sheet(64, 0, 0, 255, 255)).decode()
    chromium.execute_script(DROPPED, root, "me.png", skin)
    wait_until(lambda: run(chromium, f"{shown}.localName") == "drapery-wearer")
    press(chromium, ".stage .segments [data-value=shield]")
    loaded = "performance.getEntriesByType('resource').map((each) => each.name.split('/').at(-1))"
    wait_until(lambda: "wearer-shield.bin" in run(chromium, loaded))
    wait_until(lambda: run(chromium, f"!{shown}.shadowRoot.querySelector('canvas').hidden"))
    chromium.execute_script(f"{shown}.setAttribute('view', 'back')")
    before = greens()
    pack = pack_of(shield_base=sheet(128, 0, 220, 0, 255))
    chromium.execute_async_script(DROP, root, "mine.zip", pack.decode())
    wait_until(lambda: greens() > before + 0.015)
    press(chromium, ".without")
    wait_until(lambda: greens() == before)


SILHOUETTE = """
const [root, done] = arguments;
(async () => {
  const image = await createImageBitmap(await root.querySelector(".sky > :first-child").snapshot());
  const context = new OffscreenCanvas(image.width, image.height).getContext("2d");
  context.drawImage(image, 0, 0);
  const { data } = context.getImageData(0, 0, image.width, image.height);
  done(Array.from({ length: data.length / 4 }, (_, at) => Math.sign(data[4 * at + 3])).join(""));
})();
"""


def test_an_edit_of_a_worn_design_leaves_motion_and_view(chromium: Any, site: str) -> None:
    open_designer(chromium, f"{site}/#red")
    resize(chromium, DESKTOP, moves=True)
    root, shown = run(chromium, ROOT), f"{ROOT}.querySelector('.sky').firstChild"

    def middle() -> list[int]:
        colours: list[list[int]] = chromium.execute_async_script(COLOURS, root)
        return colours[2]

    def silhouette() -> str:
        return str(chromium.execute_async_script(SILHOUETTE, root))

    me = base64.b64encode(sheet(64, 0, 0, 255, 255)).decode()
    chromium.execute_script(DROPPED, root, "me.png", me)
    wait_until(lambda: run(chromium, f"{shown}.localName") == "drapery-wearer")
    wait_until(lambda: middle()[0] > 100 > 2 * middle()[1])
    run(chromium, f"{shown}.shadowRoot.querySelector('canvas').focus()")
    ActionChains(chromium).send_keys(Keys.ARROW_LEFT).perform()
    first = silhouette()
    wait_until(lambda: silhouette() != first)
    press(chromium, ".pause")
    before = silhouette()
    press(chromium, '[data-dye="lime"]')
    press(chromium, '[data-pattern="base"]')
    wait_until(lambda: middle()[1] > 120 > middle()[0])
    assert silhouette() == before
    resize(chromium, DESKTOP)
