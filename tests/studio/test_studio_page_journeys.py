"""Twelve journeys through the studio's page, each from the first click to what its user came for.

`DRAPERY_STUDIO_SHOTS=FOLDER` keeps a picture of the page at the end of each.
"""

import os
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pack_maker import CREEPER, META, mcmeta, noise, plain, png, zip_pack
from PIL import Image
from selenium.webdriver import ActionChains, Keys
from selenium.webdriver.common.actions.action_builder import ActionBuilder
from selenium.webdriver.common.actions.interaction import POINTER_TOUCH
from selenium.webdriver.common.actions.pointer_input import PointerInput
from studio_browser import (
    PHONE,
    WIDE,
    Studio,
    console_errors,
    drop,
    open_page,
    open_tab,
    paste,
    resize,
    wait_until,
)
from world_maker import block_id, entity, nbt_file, schem

from drapery.banner.design import Banner
from drapery.banner.formats import write_banner
from drapery.banner.letters import letter_banners
from drapery.pictures import draw_face

SHOTS = os.environ.get("DRAPERY_STUDIO_SHOTS")


@pytest.fixture
def page(chromium: Any, studio: Studio, request: pytest.FixtureRequest) -> Iterator[Any]:
    resize(chromium, WIDE)
    open_page(chromium, studio)
    chromium.find_element("css selector", ".live-bar button[aria-label=Pause]").click()
    yield chromium
    if SHOTS:
        time.sleep(3)  # until the cloth and all faces show the last step
        Path(SHOTS).mkdir(parents=True, exist_ok=True)
        chromium.save_screenshot(f"{SHOTS}/{request.node.name.removeprefix('test_')}.png")
    assert console_errors(chromium) == []
    assert "Traceback" not in "".join(studio.log)


def find(page: Any, selector: str) -> Any:
    return wait_until(lambda: page.find_elements("css selector", selector))[0]


def click(page: Any, selector: str) -> None:
    find(page, selector).click()


def click_text(page: Any, text: str) -> None:
    found = wait_until(lambda: page.find_elements("xpath", f"//button[normalize-space()='{text}']"))
    next(each for each in found if each.is_displayed()).click()


def fill(page: Any, label: str, value: str) -> None:
    """Set the field with this label as its user does."""
    path = f"//label[starts-with(normalize-space(.), '{label}')]"
    field = wait_until(lambda: page.find_elements("xpath", f"{path}//input | {path}//select"))[0]
    if field.tag_name == "input":
        field.send_keys(Keys.CONTROL + "a" + Keys.NULL, value, Keys.TAB)
    else:
        wait_until(lambda: page.execute_script(CHOOSE, field, value))


CHOOSE = """
const [field, value] = arguments;
if (![...field.options].some((each) => each.value === value)) return false;
field.value = value;
field.dispatchEvent(new Event("change", { bubbles: true }));
return true;
"""


def text(page: Any, selector: str) -> str:
    script = "return document.querySelector(arguments[0])?.innerText ?? ''"
    return str(page.execute_script(script, selector))


def value(page: Any, element_id: str) -> str:
    script = "return document.getElementById(arguments[0]).value"
    return str(page.execute_script(script, element_id))


def is_now(page: Any, design: str) -> None:
    wanted = write_banner(Banner.parse(design), "give")
    wait_until(lambda: value(page, "written") == wanted)


def press(page: Any, *keys: str) -> None:
    ActionChains(page).send_keys(*keys).perform()


def press_with(page: Any, held: str, key: str) -> None:
    ActionChains(page).key_down(held).send_keys(key).key_up(held).perform()


def test_a_pirate_flag(page: Any) -> None:
    click(page, "[data-dye=black]")
    search = find(page, ".panel-patterns input")
    search.send_keys("pirate", Keys.ENTER)
    is_now(page, "black skull:white")
    click(page, "[data-dye=gray]")
    search.send_keys(Keys.CONTROL + "a" + Keys.NULL, "frame", Keys.ENTER)
    is_now(page, "black skull:white border:gray")
    find(page, "input.title").send_keys("Jolly Roger", Keys.TAB)
    wait_until(lambda: page.title.startswith("Jolly Roger - "))
    open_tab(page, "export")
    click(page, "#panel-export button[aria-label='Export the file']")
    wait_until(lambda: text(page, "#panel-export .export-link").startswith("jolly-roger.png, "))


def test_the_flag_of_a_country(page: Any) -> None:
    open_tab(page, "start")
    click(page, "#panel-start [data-own=Ukraine]")
    is_now(page, "blue half_horizontal_bottom:yellow")
    assert find(page, "input.title").get_property("value") == "Ukraine"
    click(page, ".layer-list .layer")
    click(page, "[data-dye=white]")
    is_now(page, "blue half_horizontal_bottom:white")
    click(page, "button[aria-label=Undo]")
    is_now(page, "blue half_horizontal_bottom:yellow")
    open_tab(page, "loom")
    assert "Dye (Yellow)" in text(page, "#panel-loom ul.loom")


def test_a_word(page: Any) -> None:
    open_tab(page, "letters")
    fill(page, "Word", "go 4")
    fill(page, "Ink", "red")
    banners = letter_banners("GO 4", ink="red")
    commands = "\n".join(write_banner(each, "give") for each in banners)
    wait_until(lambda: value(page, "letters-text") == commands)
    wait_until(lambda: page.find_elements("css selector", ".letters canvas[width]"))
    click(page, ".letters:not(.candidates) .found:nth-child(2)")
    wait_until(lambda: value(page, "written") == write_banner(banners[1], "give"))


def test_a_design_from_a_photo(page: Any, tmp_path: Path) -> None:
    photo = np.full((200, 160, 3), (90, 200, 90), np.uint8)
    face = draw_face(Banner.parse("red cross:white"), scale=4).pixels[..., :3]
    photo[20:180, 40:120] = face * np.array([0.8, 0.75, 0.7])
    Image.fromarray(photo).save(tmp_path / "wall.png")
    open_tab(page, "picture")
    click(page, "#panel-picture input[type=checkbox]")
    find(page, "#panel-picture input[type=file]").send_keys(str(tmp_path / "wall.png"))
    click(page, "#panel-picture .candidates .found")
    is_now(page, "red cross:white")


def test_a_design_from_a_command(page: Any) -> None:
    paste(
        page,
        "/give @p minecraft:red_banner[custom_name='\"Lime Ghost\"',banner_patterns="
        '[{pattern:"creeper",color:"lime"},{pattern:"border",color:"black"}]]',
    )
    title = find(page, "input.title")
    wait_until(lambda: title.get_property("value") == "Lime Ghost")
    open_tab(page, "text")
    fill_form = find(page, "#panel-text select")
    page.execute_script(CHOOSE, fill_form, "blazon")
    wait_until(lambda: value(page, "written").startswith("Gules"))


def test_a_pattern_of_a_pack(page: Any, tmp_path: Path) -> None:
    anvil = "assets/acme/textures/entity/banner/anvil.png"
    mask = np.zeros((64, 64, 4), np.uint8)
    mask[..., 3], mask[8:20, 8:20] = 255, 255
    files = {META: mcmeta(), CREEPER: png(mask), anvil: png(noise(3))}
    drop(page, "acme.zip", zip_pack(tmp_path / "acme.zip", files).read_bytes())
    wait_until(lambda: text(page, ".pack-name").startswith("acme.zip"))
    open_tab(page, "patterns")
    click(page, "[data-pattern='acme:anvil']")
    wait_until(lambda: "acme:anvil" in value(page, "written"))
    open_tab(page, "packs")
    summary = find(page, ".pack-name summary")
    assert summary.get_property("scrollWidth") > summary.get_property("clientWidth")
    summary.click()
    assert summary.get_property("scrollWidth") <= summary.get_property("clientWidth")
    assert summary.text.endswith("masks)")
    click(page, "button[aria-label='Remove: acme.zip']")
    line = "acme:anvil is in none of the packs: the game shows a checker. Add its pack."
    wait_until(lambda: line in text(page, "#panel-layers .warning"))


def test_a_cape_on_a_skin(page: Any) -> None:
    drop(page, "me.png", png(noise(5)), ".live-view")
    wait_until(lambda: "me.png" in value(page, "as-command"))
    fill(page, "Garment", "cape")
    wait_until(lambda: "cape" in value(page, "as-command"))
    assert "me.png" in value(page, "as-command")
    wait_until(lambda: "getting ready" not in text(page, ".live-view"))
    open_tab(page, "export")
    fill(page, "File", "gif")
    path = "//label[starts-with(., 'Turntable')]//input"
    wait_until(page.find_element("xpath", path).is_displayed)
    page.find_element("xpath", path).click()
    wait_until(lambda: "--turntable" in value(page, "as-command"))


def test_all_banners_of_a_schematic(page: Any) -> None:
    designs = ["red creeper:lime", "blue skull:white border:black", "white flower:red"]
    banners = [Banner.parse(text) for text in designs]
    cells = {(n, 1, 0): (block_id(each), entity(each)) for n, each in enumerate(banners)}
    drop(page, "hall.schem", nbt_file(schem(2, (3, 2, 1), cells), "Schematic"))
    wait_until(lambda: len(page.find_elements("css selector", "#panel-text .found")) == 3)
    wait_until(
        lambda: len(page.find_elements("css selector", "#panel-text .found canvas[width]")) == 3
    )
    assert text(page, "#panel-text .found") == "hall.schem block 0,1,0"
    for place, design in enumerate(designs):
        page.find_elements("css selector", "#panel-text .found")[place].click()
        is_now(page, design)
    click(page, "#panel-text button[aria-label='Save all banners in the library']")
    open_tab(page, "library")
    titles = "#panel-library .design-title"
    wait_until(lambda: len(page.find_elements("css selector", titles)) >= 3)
    assert text(page, titles) == "hall.schem block 2,1,0"
    assert text(page, "#panel-library .design-tags") == "hall.schem"


def test_packs_are_compared(page: Any, tmp_path: Path) -> None:
    paste(page, "white creeper:lime")
    for name, blue in (("soft.zip", 90), ("hard.zip", 255)):
        files = {META: mcmeta(), CREEPER: plain(blue, blue, blue, 255)}
        drop(page, name, zip_pack(tmp_path / name, files).read_bytes())
        wait_until(lambda name=name: text(page, ".pack-name").startswith(name))
    fill(page, "Compare with", "1")
    drawn = "return [...document.querySelectorAll('.versus canvas')].map((e) => e.toDataURL())"
    wait_until(lambda: len(set(page.execute_script(drawn))) == 4)
    slider = find(page, "#panel-packs .versus-slider")
    slider.find_element("css selector", "input").send_keys(*[Keys.ARROW_LEFT] * 10)
    assert "--cut: 40%" in slider.get_attribute("style")
    wait_until(lambda: "soft.zip" in text(page, ".viewer-host"))


def test_a_design_is_shared(page: Any) -> None:
    paste(page, "red creeper:lime border:black")
    is_now(page, "red creeper:lime border:black")
    find(page, "input.title").send_keys("Lime Ghost", Keys.TAB)
    wait_until(lambda: page.title.startswith("Lime Ghost - "))
    open_tab(page, "export")
    link = value(page, "share-link")
    page.switch_to.new_window("tab")
    try:
        page.get(link)
        wait_until(lambda: page.execute_script("return !!window.studio?.ready"))
        is_now(page, "red creeper:lime border:black")
        assert page.title.startswith("Lime Ghost - ")
    finally:
        page.close()
        page.switch_to.window(page.window_handles[0])


@pytest.fixture
def phone(page: Any) -> Iterator[Any]:
    touch = "Emulation.setTouchEmulationEnabled"
    page.execute_cdp_cmd(touch, {"enabled": True})
    resize(page, PHONE)
    yield page
    page.execute_cdp_cmd(touch, {"enabled": False})


def tap(page: Any, selector: str) -> None:
    element = find(page, selector)
    page.execute_script("arguments[0].scrollIntoView({ block: 'center' })", element)
    finger = ActionBuilder(page, mouse=PointerInput(POINTER_TOUCH, "finger"))
    finger.pointer_action.move_to(element).pointer_down().pointer_up()
    finger.perform()


def test_on_a_phone(phone: Any) -> None:
    tap(phone, "[data-dye=blue]")
    tap(phone, "#tab-patterns")
    for pattern in ("creeper", "border", "flower"):
        tap(phone, f"[data-pattern={pattern}]")
    is_now(phone, "blue creeper:black border:black flower:black")
    tap(phone, "#tab-layers")
    grip = find(phone, ".layer-list li[data-at='2'] .grip")
    height = find(phone, ".layer-list li").rect["height"]
    finger = ActionBuilder(phone, mouse=PointerInput(POINTER_TOUCH, "finger"))
    down = finger.pointer_action.move_to(grip).pointer_down()
    down.move_to(grip, 0, int(height * 1.3)).pointer_up()
    finger.perform()
    is_now(phone, "blue creeper:black flower:black border:black")
    tap(phone, ".group[aria-controls=tabs-2]")
    tap(phone, "#tab-export")
    tap(phone, "#panel-export button[aria-label='Export the file']")
    wait_until(find(phone, "#panel-export .export-link").is_displayed)
    assert phone.execute_script("return document.documentElement.scrollWidth") <= PHONE[0]


FOCUS = """
const here = document.activeElement;
const around = [here, here.parentElement, here.parentElement?.parentElement];
const marked = around.filter(Boolean).some((each) => {
  const style = getComputedStyle(each);
  const outlined = style.outlineStyle !== "none" && parseFloat(style.outlineWidth) > 0;
  return outlined || style.boxShadow !== "none";
});
// Behind the last element comes the browser's own part, which takes the focus from the page.
const seen = marked || here === document.body;
return [here.matches(arguments[0]), seen, here.outerHTML.slice(0, 120)];
"""


def walk_to(page: Any, selector: str) -> None:
    """Press Tab until such an element has the focus, which is seen at each stop on the way."""
    for _ in range(120):
        press(page, Keys.TAB)
        is_there, is_marked, what = page.execute_script(FOCUS, selector)
        assert is_marked, f"the focus cannot be seen on {what}"
        if is_there:
            return
    raise AssertionError(f"no way leads to {selector}")


def test_with_the_keyboard_alone(page: Any) -> None:
    page.execute_script("document.activeElement.blur()")
    walk_to(page, ".dye")
    press(page, Keys.ARROW_RIGHT, Keys.ENTER)
    is_now(page, "orange")
    press(page, "/", "creeper", Keys.ENTER)
    is_now(page, "orange creeper:black")
    press_with(page, Keys.CONTROL, "a")
    press(page, "frame", Keys.ENTER)
    is_now(page, "orange creeper:black border:black")
    press(page, Keys.ESCAPE, Keys.ESCAPE)
    walk_to(page, ".layer-list li[data-at='1'] .layer")
    press_with(page, Keys.ALT, Keys.ARROW_DOWN)
    is_now(page, "orange border:black creeper:black")
    walk_to(page, ".group")
    press(page, Keys.ARROW_RIGHT, Keys.ARROW_RIGHT)
    walk_to(page, "#tab-export")
    walk_to(page, "#panel-export button[aria-label='Export the file']")
    press(page, Keys.ENTER)
    wait_until(find(page, "#panel-export .export-link").is_displayed)
    walk_to(page, "#panel-export .export-link")


def test_designs_on_buttons_follow_the_packs_in_place(page: Any, tmp_path: Path) -> None:
    face = "document.querySelector('[data-own=Slime] canvas')"
    before = wait_until(lambda: page.execute_script(f"return {face}?.toDataURL()"))
    page.execute_script(f"window.before = {face}")
    label = page.execute_script(f"return {face}.parentElement.ariaLabel")
    assert label.startswith("Slime: Banner: ")
    files = {META: mcmeta(), CREEPER: plain(0, 0, 255, 255)}
    drop(page, "blue.zip", zip_pack(tmp_path / "blue.zip", files).read_bytes())
    wait_until(lambda: page.execute_script(f"return {face}.toDataURL()") != before)
    assert page.execute_script(f"return window.before === {face}")
