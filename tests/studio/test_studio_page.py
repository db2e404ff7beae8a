"""The page of the studio in a real browser: what a designer clicks, drags, pastes and sees."""

import base64
import io
import tempfile
import urllib.request
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image
from selenium.webdriver import ActionChains, Keys
from selenium.webdriver.common.by import By
from studio_browser import (
    PHONE,
    WIDE,
    Studio,
    console_errors,
    drop,
    notices,
    open_browser,
    open_page,
    open_tab,
    paste,
    resize,
    wait_until,
)

from drapery.banner.design import Banner
from drapery.banner.formats import write_banner
from drapery.pictures import draw_face

HERE = Path(__file__).parents[1]
CONTRAST = (HERE / "page_contrast.js").read_text()
NAMELESS = (HERE / "page_names.js").read_text()


@pytest.fixture
def page(chromium: Any, studio: Studio) -> Any:
    resize(chromium, WIDE)
    open_page(chromium, studio)
    # A cloth that waves is drawn without a graphics card here, and takes the time of all else.
    click(chromium, ".live-bar button[aria-label=Pause]")
    return chromium


def find(page: Any, selector: str) -> Any:
    return page.find_element(By.CSS_SELECTOR, selector)


def click(page: Any, selector: str) -> None:
    find(page, selector).click()


def written(page: Any) -> str:
    """The design as the page writes it, in the form `give`."""
    return page.execute_script("return document.getElementById('written').value")


def is_now(page: Any, design: str) -> None:
    wanted = write_banner(Banner.parse(design), "give")
    wait_until(lambda: written(page) == wanted)


def face(page: Any) -> np.ndarray:
    """The flat picture that the page shows, a pixel for each texel."""
    data = page.execute_script("return document.querySelector('.face canvas').toDataURL()")
    return np.asarray(Image.open(io.BytesIO(base64.b64decode(data.partition(",")[2]))))


def shows(page: Any, design: str) -> None:
    wanted = draw_face(Banner.parse(design), scale=1).pixels
    wait_until(lambda: np.array_equal(face(page), wanted))


def press(page: Any, *keys: str) -> None:
    actions = ActionChains(page)
    for key in keys[:-1]:
        actions.key_down(key)
    actions.send_keys(keys[-1])
    for key in keys[:-1]:
        actions.key_up(key)
    actions.perform()


def titles(page: Any) -> list[str]:
    """The layers as they are listed, topmost first."""
    # At once: an edit replaces the rows.
    texts = "[...document.querySelectorAll('.layer-name b')].map((each) => each.innerText)"
    found: list[str] = page.execute_script(f"return {texts}")
    return found


def layer(place: int, part: str = ".layer") -> str:
    """The selector of a part of a layer, counted from 0 at the bottom."""
    return f".layer-list li[data-at='{place}'] {part}"


def alert(page: Any) -> str:
    """The text of the notices that a screen reader announces at once."""
    return " ".join(notices(page, "alert"))


def test_a_design_is_built_by_clicking(page: Any) -> None:
    shows(page, "white")
    click(page, "[data-dye=blue]")
    click(page, "[data-pattern=stripe_center]")
    is_now(page, "blue stripe_center:black")
    click(page, "[data-dye=yellow]")
    click(page, "[data-pattern=creeper]")
    is_now(page, "blue stripe_center:black creeper:yellow")
    shows(page, "blue stripe_center:black creeper:yellow")
    click(page, layer(0))
    assert "Layer 1" in find(page, ".panel-palette h2").text
    click(page, "[data-dye=red]")
    shows(page, "blue stripe_center:red creeper:yellow")
    click(page, layer(1, ".hide"))
    shows(page, "blue stripe_center:red")
    click(page, layer(1, ".hide"))
    click(page, layer(1, ".double"))
    is_now(page, "blue stripe_center:red creeper:yellow creeper:yellow")
    click(page, layer(2, ".remove"))
    is_now(page, "blue stripe_center:red creeper:yellow")
    click(page, "button[aria-label=Undo]")
    is_now(page, "blue stripe_center:red creeper:yellow creeper:yellow")
    click(page, "button[aria-label=Redo]")
    is_now(page, "blue stripe_center:red creeper:yellow")
    assert console_errors(page) == []


def test_layers_are_dragged(page: Any) -> None:
    paste(page, "white creeper:lime border:black flower:red skull:blue")
    wait_until(lambda: len(titles(page)) == 5)
    top = find(page, layer(3, ".grip"))
    height = find(page, ".layer-list li").rect["height"]
    drag = ActionChains(page, duration=20).click_and_hold(top)
    drag.move_by_offset(0, int(height)).move_by_offset(0, int(height * 1.2)).perform()
    row, passed = (find(page, layer(at, "")).rect["y"] for at in (3, 1))
    assert row > passed, "the row goes along; its name may have more lines than others"
    ActionChains(page).release().perform()
    is_now(page, "white creeper:lime skull:blue border:black flower:red")
    assert not page.find_elements(By.CSS_SELECTOR, ".layer[aria-pressed=true]")
    grip = find(page, layer(1, ".grip"))
    drag = ActionChains(page, duration=20).click_and_hold(grip).move_by_offset(0, -90)
    drag.send_keys(Keys.ESCAPE).release().perform()
    is_now(page, "white creeper:lime skull:blue border:black flower:red")
    press(page, Keys.CONTROL, "z")
    is_now(page, "white creeper:lime border:black flower:red skull:blue")


def test_all_goes_by_keyboard(page: Any) -> None:
    paste(page, "white creeper:lime border:black flower:red")
    wait_until(lambda: len(titles(page)) == 4)
    find(page, layer(0)).send_keys(Keys.ENTER)
    assert find(page, layer(0)).get_attribute("aria-pressed") == "true"
    press(page, Keys.ALT, Keys.ARROW_UP)
    is_now(page, "white border:black creeper:lime flower:red")
    focused = page.switch_to.active_element.accessible_name
    assert focused.startswith("Creeper"), "a layer that moves keeps the focus"
    press(page, Keys.CONTROL, "d")
    is_now(page, "white border:black creeper:lime creeper:lime flower:red")
    press(page, Keys.DELETE)
    is_now(page, "white border:black creeper:lime flower:red")
    press(page, Keys.ESCAPE)
    press(page, "/")
    page.switch_to.active_element.send_keys("lozenge", Keys.ENTER)
    is_now(page, "white border:black creeper:lime flower:red rhombus:black")
    page.switch_to.active_element.send_keys(Keys.ESCAPE, Keys.ESCAPE)
    press(page, "?")
    assert find(page, "#shortcuts").is_displayed()
    press(page, Keys.ESCAPE)
    assert not find(page, "#shortcuts").is_displayed()
    press(page, Keys.CONTROL, Keys.SHIFT, "z")
    press(page, "b")
    wait_until(lambda: written(page).startswith("/give @p minecraft:shield["))


def test_dyes_and_patterns_are_walked_by_arrows(page: Any) -> None:
    find(page, ".dye[tabindex='0']").send_keys(Keys.ARROW_RIGHT, Keys.ENTER)
    assert find(page, "[data-dye=orange]").get_attribute("aria-pressed") == "true"
    find(page, ".pattern[tabindex='0']").send_keys(Keys.ARROW_RIGHT, Keys.ARROW_DOWN, Keys.ENTER)
    wait_until(lambda: len(titles(page)) == 2)


FORMS = {
    "address": write_banner(Banner.parse("red creeper:lime border:black"), "needcoolshoes"),
    "command": write_banner(Banner.parse("red creeper:lime border:black"), "give"),
    "old command": write_banner(Banner.parse("red creeper:lime border:black"), "give-1.12"),
    "words": "red creeper:lime border:black",
}


@pytest.mark.parametrize("text", FORMS.values(), ids=FORMS)
def test_what_is_pasted_is_read(page: Any, text: str) -> None:
    open_tab(page, "text")
    find(page, "#design-text").send_keys(text, Keys.CONTROL, Keys.ENTER)
    is_now(page, "red creeper:lime border:black")
    shows(page, "red creeper:lime border:black")


def test_broken_text_shows_the_line_and_the_page_goes_on(page: Any) -> None:
    paste(page, "white creeper:mauve")
    wait_until(lambda: "unknown dye 'mauve'" in alert(page))
    open_tab(page, "text")
    assert "unknown dye 'mauve'" in find(page, ".panel-text .fault").text
    secret = Path(__file__).resolve()
    paste(page, str(secret))
    wait_until(lambda: "not a known form of a banner" in alert(page))
    paste(page, "white creeper:lime")
    is_now(page, "white creeper:lime")
    assert not find(page, ".panel-text .fault").is_displayed()


def test_a_file_of_several_offers_a_choice(page: Any) -> None:
    designs = ["white creeper:lime", "red border:black", "blue skull:white"]
    lines = [write_banner(Banner.parse(text), "give") for text in designs]
    drop(page, "banners.mcfunction", "\n".join(lines).encode())
    wait_until(lambda: len(page.find_elements(By.CSS_SELECTOR, "#panel-text .found")) == 3)
    assert find(page, "#panel-text").is_displayed()
    page.find_elements(By.CSS_SELECTOR, "#panel-text .found")[1].click()
    is_now(page, "red border:black")


def test_a_binary_file_is_read_and_a_broken_one_named(page: Any) -> None:
    from world_maker import block_id, entity, nbt_file, schem

    banner = Banner.parse("red creeper:lime border:black")
    tree = schem(2, (2, 2, 2), {(1, 1, 1): (block_id(banner), entity(banner))})
    drop(page, "hall.schem", nbt_file(tree, "Schematic"))
    is_now(page, "red creeper:lime border:black")
    drop(page, "../../etc/hall.nbt", b"\x0a\x00\x00\x08\x00\x00\x00")
    wait_until(lambda: "hall.nbt" in alert(page))
    assert "/" not in alert(page).split("hall.nbt")[0]


def test_the_text_is_copied_by_one_click(page: Any) -> None:
    origin = page.current_url.rstrip("/")
    grant = {"permissions": ["clipboardReadWrite", "clipboardSanitizedWrite"], "origin": origin}
    page.execute_cdp_cmd("Browser.grantPermissions", grant)
    paste(page, "white creeper:lime")
    is_now(page, "white creeper:lime")
    open_tab(page, "text")
    click(page, "[data-copy=written]")
    wait_until(lambda: find(page, "[data-copy=written]").text.endswith("Copied"))
    read = "navigator.clipboard.readText().then(arguments[0])"
    assert page.execute_async_script(read) == written(page)


def test_the_page_loads_no_font(page: Any) -> None:
    """Its icons are pictures of lines; the font of icons alone has 129 kB."""
    tabs = page.find_elements(By.CSS_SELECTOR, ".tab[data-panel]")
    for tab in tabs:
        page.execute_script("studio.tab(arguments[0])", tab.get_attribute("data-panel"))
    paste(page, "white creeper:mauve")
    wait_until(lambda: notices(page))
    loaded = "return performance.getEntriesByType('resource').map((each) => each.name)"
    assert not [each for each in page.execute_script(loaded) if "woff" in each]
    assert not page.find_elements(By.CSS_SELECTOR, ".material-icons, .q-icon:empty")
    assert len(page.find_elements(By.CSS_SELECTOR, ".tab .q-icon path")) == len(tabs)


def test_the_loom_stops_at_six_and_says_what_is_needed(page: Any) -> None:
    # Soft edges show through a second layer of the same pattern; a whole field hides all below.
    paste(page, "white " + "creeper:lime base:black " * 3 + "flower:red")
    open_tab(page, "loom")
    wait_until(lambda: len(page.find_elements(By.CSS_SELECTOR, "ol.loom li")) == 7)
    assert (
        find(page, ".panel-layers .head .hint").text == "7 of 16 · Over 6 layers: by commands only"
    )
    assert find(page, "#panel-loom .warning").text == "Over 6 layers: by commands only"
    assert find(page, "ul.loom").text.splitlines() == [
        *("6 × Wool (White)", "1 × Stick", "3 × Dye (Lime)", "3 × Dye (Black)", "1 × Dye (Red)"),
        *("2 × Paper", "1 × Creeper head", "1 × Oxeye daisy"),
        *("1 × Banner pattern: Creeperkept", "1 × Banner pattern: Flowerkept"),
    ]
    button = "//button[.='Leave out layers that change nothing: 5']"
    page.find_element(By.XPATH, button).click()
    is_now(page, "white base:black flower:red")
    wait_until(lambda: len(page.find_elements(By.CSS_SELECTOR, "ol.loom li")) == 2)
    assert not find(page, "#panel-loom button").is_displayed()
    assert not find(page, "#panel-loom .warning").is_displayed()


def test_two_browsers_have_their_own_sessions(page: Any, studio: Studio) -> None:
    paste(page, "white creeper:lime")
    is_now(page, "white creeper:lime")
    with tempfile.TemporaryDirectory() as folder:
        other = open_browser(Path(folder))
        try:
            open_page(other, studio)
            paste(other, "black skull:white")
            is_now(other, "black skull:white")
            assert written(page) == write_banner(Banner.parse("white creeper:lime"), "give")
        finally:
            other.quit()


@pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
@pytest.mark.parametrize("size", [WIDE, PHONE], ids=["wide", "phone"])
def test_words_stand_out_from_what_is_behind_them(
    page: Any, size: tuple[int, int], dark: bool
) -> None:
    """WCAG 2.2, 1.4.3: 4.5 to 1; large words 3 to 1. What is switched off is exempt."""
    resize(page, size, dark=dark)
    paste(page, "white " + "creeper:lime border:black " * 4)
    wait_until(lambda: len(titles(page)) >= 9 or size == PHONE)
    click(page, "[data-dye=red]")
    for group in page.find_elements(By.CSS_SELECTOR, ".group"):
        group.click()
        for panel in page.find_elements(By.CSS_SELECTOR, ".tab"):
            if panel.is_displayed():
                panel.click()
                assert page.execute_script(CONTRAST) == []
    assert page.execute_script("return document.documentElement.scrollWidth") <= size[0]


def test_all_that_can_be_used_has_a_name(page: Any) -> None:
    paste(page, "white creeper:lime border:black")
    wait_until(lambda: len(titles(page)) == 3)
    assert page.execute_script(NAMELESS) == []
    assert find(page, "html").get_attribute("lang") == "en-US"


def test_to_load_the_page_anew_loses_no_work(page: Any) -> None:
    paste(page, "white creeper:lime border:black")
    is_now(page, "white creeper:lime border:black")
    wait_until(lambda: "?d=" in page.current_url)
    link = page.current_url
    page.refresh()
    wait_until(lambda: page.execute_script("return !!window.studio?.ready"))
    is_now(page, "white creeper:lime border:black")
    press(page, "r")
    wait_until(lambda: "?d=" in page.current_url and page.current_url != link)
    paste(page, link)
    is_now(page, "white creeper:lime border:black")


def test_others_are_let_in_by_the_token(chromium: Any, tmp_path: Path) -> None:
    studio = Studio(tmp_path, "--host", "0.0.0.0", "--token", "open sesame & more")
    address, _, word = studio.address.partition("?")
    assert "0.0.0.0" not in address, "others cannot open that address"
    try:
        chromium.get(address)
        assert "give the token" in find(chromium, "body").text
        assert _status(f"{address}face/x.png") == 403
        chromium.get(f"{address}?{word}")
        wait_until(lambda: chromium.execute_script("return !!window.studio?.ready"))
        assert chromium.current_url == address, "the token does not stay in the history"
        paste(chromium, "white creeper:lime")
        is_now(chromium, "white creeper:lime")
    finally:
        studio.stop()


def test_nothing_is_loaded_from_elsewhere(page: Any, studio: Studio) -> None:
    script = "return performance.getEntriesByType('resource').map((entry) => entry.name)"
    assert all(
        name.startswith((studio.address, studio.address.replace("http", "ws"), "data:", "blob:"))
        for name in page.execute_script(script)
    )


def test_a_closed_tab_ends_its_session(page: Any, studio: Studio) -> None:
    address = find(page, "link[href^=faces]").get_property("href")
    assert _status(address) == 200
    page.get("about:blank")
    wait_until(lambda: _status(address) == 404)


def _status(address: str) -> int:
    try:
        return urllib.request.urlopen(address, timeout=5).status
    except urllib.error.HTTPError as error:
        return error.code


def test_a_style_is_chosen_by_its_picture(page: Any) -> None:
    def drawn(name: str) -> bool:
        script = "const i = arguments[0]; return i.complete && i.naturalWidth === 72"
        return bool(page.execute_script(script, find(page, f"[data-style={name}] img")))

    assert not drawn("ink")  # nothing is drawn for a panel that is not shown
    open_tab(page, "styles")
    wait_until(lambda: drawn("game"))
    click(page, "[data-style=few-bends]")
    pressed = "[data-style=few-bends][aria-pressed=true]"
    wait_until(lambda: page.find_elements(By.CSS_SELECTOR, pressed))
    click(page, "[data-style=few-bends]")
    wait_until(lambda: not page.find_elements(By.CSS_SELECTOR, pressed))
