"""The live cloth in a real browser: it waves, obeys keys and hands, and looks as pictures do."""

import base64
import io
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image
from selenium.webdriver import ActionChains, Keys
from selenium.webdriver.common.by import By
from studio_browser import WIDE, Studio, console_errors, open_page, resize, wait_until

from drapery.banner import Banner
from drapery.packs import open_packs
from drapery.scenes import STEP, StagedBody
from drapery.settings import Settings
from drapery.style import body_of

WRITTEN = (
    "const text = document.getElementById('written').value; return /pattern/.test(text) && text"
)
VIEWER = "document.querySelector('.viewer').viewer"


@pytest.fixture
def page(chromium: Any, studio: Studio) -> Any:
    resize(chromium, WIDE, moves=True)
    open_page(chromium, studio)
    wait_until(lambda: ask(chromium, "time > 0"))
    return chromium


def ask(page: Any, what: str) -> Any:
    """A field of the viewer's."""
    return page.execute_script(f"const viewer = {VIEWER}; return viewer?.{what}")


def positions(page: Any) -> np.ndarray:
    """Where all vertices are in the browser, shape [V, 3]."""
    text = page.execute_script(
        f"const bytes = new Uint8Array({VIEWER}.players[0].drawing.scene.positions.slice().buffer);"
        " let text = ''; for (const byte of bytes) text += String.fromCharCode(byte);"
        " return btoa(text)"
    )
    return np.frombuffer(base64.b64decode(text), np.float32).reshape(-1, 3)


def canvas(page: Any) -> Any:
    return page.find_element(By.CSS_SELECTOR, ".viewer-host")


def frame_rate(page: Any) -> int:
    """What the viewer says of itself [frames/s]; 0 before it has counted."""
    shown = page.find_element(By.CSS_SELECTOR, ".viewer-rate").text.split()
    return int(shown[0]) if shown else 0


def picture(page: Any) -> np.ndarray:
    """The canvas's pixels, shape [H, W, 4]."""
    url = page.execute_script(
        f"const [player] = {VIEWER}.players; player.draw(); return player.canvas.toDataURL()"
    )
    return np.asarray(Image.open(io.BytesIO(base64.b64decode(url.partition(",")[2]))))


def press(page: Any, key: str, seconds: float) -> None:
    ActionChains(page).key_down(key).pause(seconds).key_up(key).perform()


def hold(page: Any, key: str, condition: Callable[[], object]) -> None:
    """Hold a key until the condition is true: a page that has just been opened answers late."""
    ActionChains(page).key_down(key).perform()
    wait_until(condition)
    ActionChains(page).key_up(key).perform()


def shows(page: Any, text: str) -> bool:
    return text in page.find_element(By.CSS_SELECTOR, ".viewer").text


def test_it_waves_and_says_how_often(page: Any) -> None:
    before = positions(page)
    wait_until(lambda: np.abs(positions(page) - before).max() > 0.02)
    rate = wait_until(lambda: (found := frame_rate(page)) > 5 and found)
    print(f"{rate} frames/s")
    assert console_errors(page) == []


def test_it_stands_still_for_a_user_who_prefers_that(chromium: Any, studio: Studio) -> None:
    resize(chromium, WIDE)
    open_page(chromium, studio)
    pause = chromium.find_element(By.CSS_SELECTOR, ".live-bar button[aria-label=Pause]")
    wait_until(lambda: pause.get_attribute("aria-pressed") == "true")
    pause.click()
    wait_until(lambda: pause.get_attribute("aria-pressed") == "false")
    wait_until(lambda: ask(chromium, "players.length"))
    before = positions(chromium)
    wait_until(lambda: np.abs(positions(chromium) - before).max() > 0.02)


def test_keys_steer_the_wind(page: Any) -> None:
    canvas(page).send_keys("")
    heading = ask(page, "wind.heading")
    hold(page, "a", lambda: abs(ask(page, "wind.heading") - heading) > 30)
    hold(page, "e", lambda: ask(page, "wind.speed") > 5)
    speed = page.find_element(By.CSS_SELECTOR, "#panel-motion .option-value")
    wait_until(lambda: float(speed.text.split()[0]) > 5)
    page.execute_script("document.activeElement.blur()")
    press(page, Keys.SPACE, 0.0)
    wait_until(lambda: shows(page, "no wind"))
    press(page, Keys.SPACE, 0.0)
    wait_until(lambda: not shows(page, "no wind"))


def test_typing_in_a_text_field_does_not_change_the_wind(page: Any) -> None:
    wind = ask(page, "wind")
    field = page.find_element(By.CSS_SELECTOR, "#panel-patterns input")
    field.send_keys("weak sea")
    assert field.get_attribute("value") == "weak sea"
    assert ask(page, "wind") == wind and not ask(page, "input.heldKeys.size")


def test_a_point_of_the_cloth_follows_the_mouse(page: Any) -> None:
    press(page, Keys.SPACE, 0.0)
    wait_until(lambda: shows(page, "no wind"))
    page.find_element(By.CSS_SELECTOR, '[aria-label="Back to rest"]').click()
    wait_until(lambda: ask(page, "time") < 0.5)
    corner = np.argmax(flag(page) @ [1, -1, 0])
    before = flag(page)[corner]
    x, y = seen_at(page, before)
    hand = ActionChains(page)
    hand.move_to_element_with_offset(canvas(page), *from_middle(page, (x - 8, y - 8)))
    hand.click_and_hold()
    for _ in range(4):
        hand.move_by_offset(17, -20)
    hand.perform()
    assert ask(page, "input.pulling") is True
    wait_until(lambda: np.linalg.norm(flag(page)[corner] - before) > 0.15)
    pulled = flag(page)[corner]
    ActionChains(page).release().perform()
    assert ask(page, "input.pulling") is False
    wait_until(lambda: np.linalg.norm(flag(page)[corner] - pulled) > 0.1)


def test_the_background_is_walked_round(page: Any) -> None:
    azimuth = ask(page, "azimuth()")
    hand = ActionChains(page)
    hand.move_to_element_with_offset(canvas(page), *from_middle(page, (20, 240)))
    hand.click_and_hold().move_by_offset(100, 0).release().perform()
    assert ask(page, "azimuth()") == pytest.approx(azimuth - math.degrees(0.75), abs=1)
    assert ask(page, "input.pulling") is False
    hand.double_click().perform()
    assert ask(page, "azimuth()") == pytest.approx(azimuth, abs=0.1)


def flag(page: Any) -> np.ndarray:
    first, count = ask(page, "players[0].header.grip")[0]
    return positions(page)[first : first + count]


def seen_at(page: Any, point: np.ndarray) -> tuple[float, float]:
    """Where a point is seen from straight before it [CSS pixels of the canvas]."""
    box, camera = canvas(page).size, ask(page, "players[0].base")
    scale = box["height"] / camera["height"]
    right, up = (point[:2] - camera["target"][:2]) * scale
    return box["width"] / 2 + right, box["height"] / 2 - up


def from_middle(page: Any, at: tuple[float, float]) -> tuple[int, int]:
    box = canvas(page).size
    return round(at[0] - box["width"] / 2), round(at[1] - box["height"] / 2)


def choose(page: Any, label: str, name: str) -> None:
    """Take one of a list, by its name."""
    path = f"//*[@class='live-bar']//label[starts-with(., '{label}')]//option[@value='{name}']"
    wait_until(lambda: page.find_elements(By.XPATH, path))[0].click()


def test_scenes_are_pictures_that_move_and_are_left_again(page: Any) -> None:
    moves = (
        "const image = document.querySelector('.viewer-picture'); return image?.naturalWidth > 0"
    )
    choose(page, "Scene", "fold")
    wait_until(lambda: page.execute_script(moves))
    wait_until(lambda: "getting ready" not in page.find_element(By.CSS_SELECTOR, ".viewer").text)
    assert ask(page, "players.length") == 0
    choose(page, "Scene", "")
    wait_until(lambda: ask(page, "time") > 0 and not page.execute_script(moves))
    assert console_errors(page) == []


def test_without_webgl_there_are_pictures(chromium: Any, studio: Studio) -> None:
    none = "HTMLCanvasElement.prototype.getContext = () => null"
    added = chromium.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": none})
    try:
        open_page(chromium, studio)
        picture = "return document.querySelector('.viewer-picture')?.naturalWidth > 0"
        wait_until(lambda: chromium.execute_script(picture))
        wait_until(lambda: shows(chromium, "WebGL 2 is missing"))
    finally:
        chromium.execute_cdp_cmd("Page.removeScriptToEvaluateOnNewDocument", added)


def test_another_thickness_goes_on_with_the_motion_and_the_view(page: Any) -> None:
    ask(page, "orbit.turn(0.5, 0)")
    wait_until(lambda: ask(page, "time") > 1)
    vertices = ask(page, "players[0].header.vertices")
    page.execute_script(f"{VIEWER}.before = {VIEWER}.players[0]")
    slider = page.find_element(By.XPATH, "//*[@id='panel-motion']//input[@aria-label='Thickness']")
    slider.send_keys(Keys.ARROW_RIGHT)
    wait_until(lambda: ask(page, "players[0] !== viewer.before"))
    assert ask(page, "time") > 1 and ask(page, "orbit.azimuth") == 0.5
    assert ask(page, "players[0].header.vertices") == vertices


def test_another_design_on_a_cape_goes_on_with_the_motion(page: Any) -> None:
    garments = page.find_element(By.XPATH, "//label[starts-with(., 'Garment')]/select")
    wait_until(lambda: "cape" in garments.text)
    page.execute_script(
        "arguments[0].value = 'cape'; arguments[0].dispatchEvent(new Event('change'))", garments
    )
    wait_until(lambda: ask(page, "players[0]?.header.textures") and ask(page, "time") > 1)
    page.execute_script(f"{VIEWER}.before = {VIEWER}.players[0]")
    page.execute_script("document.querySelector('[data-pattern=creeper]').click()")
    wait_until(lambda: ask(page, "players[0] !== viewer.before"))
    assert ask(page, "time") > 1


def test_a_garment_of_ones_own_is_sent_and_shown(page: Any, tmp_path: Path) -> None:
    wrong, right = tmp_path / "wrong.toml", tmp_path / "shawl.toml"
    wrong.write_text('piece = [{ name = "shawl", size = [8], points = [3, 3] }]')
    right.write_text(
        'piece = [{ name = "shawl", size = [8, 8], points = [3, 3], place = [0, 9, 0] }]'
    )
    field, chosen = (
        page.find_element(By.CSS_SELECTOR, f".live {part}")
        for part in (".file-field-input", ".live-bar")
    )
    field.send_keys(str(wrong))
    wait_until(lambda: "wrong.toml line 1: size has too few values" in page.page_source)
    field.send_keys(str(right))
    wait_until(lambda: "The garment shawl" in page.page_source or "shawl.toml" in chosen.text)
    worn = "return document.querySelector('.live-bar').querySelectorAll('select')[1]"
    title = f"{worn}.selectedOptions[0]?.text"
    wait_until(lambda: page.execute_script(title) == "shawl.toml")
    page.refresh()
    wait_until(lambda: page.execute_script("return !!window.studio?.ready"))
    wait_until(lambda: page.execute_script(title) == "shawl.toml")
    assert console_errors(page) == []


def test_a_pause_is_the_moment_of_the_picture(page: Any) -> None:
    """The browser's cloth hangs as that of the renderer does at the same time."""
    page.find_element(By.CSS_SELECTOR, '[aria-label="Back to rest"]').click()
    wait_until(lambda: 0.3 < ask(page, "time") < 60)
    page.find_element(By.CSS_SELECTOR, '[aria-label="Pause"]').click()
    wait_until(lambda: is_still(page))
    time, seen = ask(page, "time"), flag(page)
    command = "return document.getElementById('as-command').value"
    wait_until(
        lambda: f"--time {math.floor(time * 1e6) / 1e6:g}"[:10] in page.execute_script(command)
    )
    settings = Settings(contact="world")
    body = body_of(Banner(), open_packs(()), settings)
    staged = StagedBody(body, settings, curves=False)
    (drape,) = staged.drapes
    moved = drape.begin(STEP).advance(drape.forces(None), round(time * 60))
    own = staged.soft(moved.state.positions)[-1].positions
    assert np.abs(seen - own.reshape(-1, 3)).max() < 0.01


def test_it_comes_back_when_the_graphics_card_does(page: Any) -> None:
    page.find_element(By.CSS_SELECTOR, '[aria-label="Pause"]').click()
    wait_until(lambda: is_still(page))
    before = picture(page)
    lost = "players[0].drawing.gl.getExtension('WEBGL_lose_context')"
    page.execute_script(f"window.loss = {VIEWER}.{lost}; loss.loseContext()")
    page.execute_async_script("setTimeout(arguments[0], 200)")
    page.execute_script("loss.restoreContext()")
    page.execute_async_script("setTimeout(arguments[0], 200)")
    wait_until(lambda: np.array_equal(picture(page), before))


def is_still(page: Any) -> bool:
    before = ask(page, "time")
    page.execute_async_script("setTimeout(arguments[0], 120)")
    return ask(page, "time") == before
