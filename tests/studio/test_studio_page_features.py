"""What other editors have, on the real page: commands with names, recent designs, comparison."""

from typing import Any

import numpy as np
import pytest
from studio_browser import WIDE, Studio, console_errors, drop, open_page, resize, wait_until

from drapery.render import png_bytes

FILL = """
const field = [...document.querySelectorAll("#panel-text label")]
  .find((each) => each.innerText.startsWith(arguments[0])).querySelector("input, select");
field.value = arguments[1];
field.dispatchEvent(new Event("change", { bubbles: true }));
"""


@pytest.fixture
def page(chromium: Any, studio: Studio) -> Any:
    resize(chromium, WIDE)
    open_page(chromium, studio)
    click(chromium, ".live-bar button[aria-label=Pause]")
    yield chromium
    assert console_errors(chromium) == []


def find(page: Any, selector: str) -> Any:
    return page.find_element("css selector", selector)


def click(page: Any, selector: str) -> None:
    page.execute_script("arguments[0].click()", find(page, selector))


def value(page: Any, name: str) -> str:
    return str(page.execute_script("return document.getElementById(arguments[0]).value", name))


def test_a_give_command_has_player_count_name_and_lore(page: Any) -> None:
    page.execute_script("studio.tab('text')")
    told = {"Player": "@a", "Count": "3", "Name of": "Sea Star", "Lore": "one | two"}
    for label, text in told.items():
        page.execute_script(FILL, label, text)
    command = '/give @a minecraft:white_banner[custom_name="Sea Star",lore=["one","two"]] 3'
    wait_until(lambda: value(page, "written") == command)
    page.execute_script(FILL, "Form", "give-legacy")
    wait_until(
        lambda: value(page, "written").startswith("/give @a minecraft:white_banner{display:")
    )


def test_banner_and_shield_stand_side_by_side(page: Any) -> None:
    widths = "return [...document.querySelectorAll('#panel-face canvas')].map((e) => e.width)"
    wait_until(lambda: page.execute_script(widths) == [20, 12])
    click(page, ".face-other")
    wait_until(lambda: page.execute_script(widths) == [12, 20])
    wait_until(lambda: value(page, "written").startswith("/give @p minecraft:shield"))


def test_the_browser_remembers_the_designs_of_closed_tabs(page: Any, studio: Studio) -> None:
    click(page, "[data-pattern=globe]")
    wait_until(lambda: "globe" in value(page, "written"))
    wait_until(lambda: "?d=" in page.current_url)
    open_page(page, studio)
    wait_until(lambda: page.find_elements("css selector", ".recent-designs .own-design"))
    click(page, ".recent-designs .own-design")
    wait_until(lambda: "globe" in value(page, "written"))


def test_two_designs_are_compared_by_a_slider(page: Any) -> None:
    box = "document.querySelector('#panel-compare .versus-slider')"
    assert page.execute_script(f"return {box}.hidden")
    click(page, "#panel-compare button")
    click(page, "[data-pattern=creeper]")
    wait_until(lambda: "creeper" in value(page, "written"))
    drawn = f"return [...{box}.querySelectorAll('canvas')].map((each) => each.toDataURL())"
    wait_until(lambda: len(set(page.execute_script(drawn))) == 2)
    label = f"return {box}.querySelector('input').ariaLabel"
    assert page.execute_script(label) == "Left: your design now. Right: Banner: White"
    choices = "return [...document.querySelectorAll('#panel-compare option')].map((e) => e.text)"
    assert page.execute_script(choices) == [
        *("nothing", "1: Banner: White", "2: Banner: White; Creeper, Black"),
    ]
    click(page, "[data-act=kind]")
    wait_until(lambda: "shield" in value(page, "written"))
    assert len(set(page.execute_script(drawn))) == 2


def test_what_other_pages_need_follows_the_design(page: Any) -> None:
    click(page, "[data-pattern=creeper]")
    wait_until(lambda: value(page, "embed-link") == "banner.html#white%20creeper:black")
    assert 'design="white creeper:black"' in value(page, "embed-component")
    assert "/banner.png?design=white+creeper%3Ablack" in value(page, "embed-address")


def test_a_skin_dropped_on_the_live_view_becomes_a_player(page: Any) -> None:
    skin = png_bytes(np.full((64, 64, 4), 200, np.uint8))
    drop(page, "me.png", skin, ".live-view")
    command = "drapery player --skin me.png --head white -o banner.png"
    wait_until(lambda: value(page, "as-command").startswith(command))


KEPT = """
const found = [...document.querySelectorAll(arguments[0])];
const kept = found.map((each) => each.kept === true);
for (const each of found) each.kept = true;
return kept;
"""
"""Whether each element was there at the last call."""
READ = """
document.getElementById("design-text").dispatchEvent(
  new CustomEvent("read", { detail: arguments[0] }));
"""
MOVE = """
const slider = document.querySelector(arguments[0]);
slider.value = 20;
slider.dispatchEvent(new Event("input", { bubbles: true }));
"""


def test_lists_keep_their_elements_in_place(page: Any) -> None:
    def count(selector: str) -> int:
        return len(page.find_elements("css selector", selector))

    found, step = "#panel-text .found", ".steps-strip .step"
    page.execute_script(READ, "red creeper:lime\nblue skull:white\ngreen cross:red")
    wait_until(lambda: count(found) == 3)
    page.execute_script(KEPT, found)
    page.execute_script(READ, "red creeper:lime\nblue skull:white\npink cross:red\nwhite")
    wait_until(lambda: count(found) == 4)
    assert page.execute_script(KEPT, found) == [True, True, False, False]
    slider = "#panel-compare .versus-slider input"
    click(page, "#panel-compare button")
    wait_until(lambda: count(slider))
    page.execute_script(MOVE, slider)
    for pattern, steps in (("creeper", 2), ("skull", 3)):
        click(page, f"[data-pattern={pattern}]")
        wait_until(lambda steps=steps: count(step) == steps)
        kept = page.execute_script(KEPT, step)
    assert kept == [True, True, False]
    at = "return document.querySelector(arguments[0]).value"
    assert page.execute_script(at, slider) == "20", "it stays where it was moved to"
