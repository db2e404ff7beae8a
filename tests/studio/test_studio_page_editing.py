"""Editing on the real page: the first visit, previews, the history, search, every width."""

from typing import Any

import pytest
from selenium.webdriver import Keys
from studio_browser import (
    PHONE,
    WIDE,
    Studio,
    console_errors,
    notices,
    open_page,
    paste,
    resize,
    wait_until,
)

from drapery.banner import PATTERN_NAMES
from drapery.banner.design import Banner
from drapery.banner.formats import write_banner
from drapery.studio.design_catalogue import EXAMPLES, own_designs


@pytest.fixture
def page(chromium: Any, studio: Studio) -> Any:
    resize(chromium, WIDE)
    open_page(chromium, studio)
    click(chromium, ".live-bar button[aria-label=Pause]")
    return chromium


def find(page: Any, selector: str) -> Any:
    return page.find_element("css selector", selector)


def click(page: Any, selector: str) -> None:
    page.execute_script("arguments[0].click()", find(page, selector))


def is_now(page: Any, design: str) -> None:
    wanted = write_banner(Banner.parse(design), "give")
    script = "return document.getElementById('written')?.value"  # none while it is loaded again
    wait_until(lambda: page.execute_script(script) == wanted)


def is_shown(page: Any, selector: str) -> bool:
    return any(each.is_displayed() for each in page.find_elements("css selector", selector))


def test_a_first_visit_begins_with_an_example_and_goes_back(page: Any) -> None:
    examples = page.find_elements("css selector", ".welcome .own-design")
    assert [each.get_attribute("data-own") for each in examples] == [*EXAMPLES]
    click(page, ".welcome [data-own=Pirate]")
    is_now(page, "black skull:white border:gray")
    wait_until(lambda: not is_shown(page, ".welcome") and page.title.startswith("Pirate - "))
    click(page, ".step")
    is_now(page, "white")
    assert console_errors(page) == []


def test_the_start_page_has_our_own_designs(page: Any) -> None:
    page.execute_script("studio.tab('start')")
    assert len(page.find_elements("css selector", "#panel-start .own-design")) >= 60
    assert len({design.title for design in own_designs()}) == len(own_designs())
    click(page, "#panel-start [data-own=Carpet]")
    wait_until(lambda: page.title.startswith("Carpet - "))


def test_a_pattern_is_previewed_and_found_by_an_everyday_word(page: Any) -> None:
    cell = "return document.querySelector('[data-pattern=creeper] canvas').toDataURL()"
    before = page.execute_script(cell)
    click(page, "[data-dye=lime]")
    wait_until(lambda: page.execute_script(cell) != before)
    is_now(page, "lime")
    field = find(page, ".panel-patterns input")
    field.send_keys("pirate", Keys.ENTER)
    is_now(page, "lime skull:black")
    click(page, "[data-dye=red]")
    click(page, "[data-pattern=border]")
    is_now(page, "lime skull:black border:red")


def test_a_new_layer_differs_from_a_field_of_its_dye(page: Any) -> None:
    click(page, "[data-dye=black]")
    click(page, "[data-pattern=border]")
    is_now(page, "black border:white")
    click(page, "[data-dye=black]")
    click(page, "[data-pattern=skull]")
    is_now(page, "black border:white skull:black")


def test_after_a_new_banner_a_dye_goes_to_the_field(page: Any) -> None:
    click(page, "[data-pattern=creeper]")
    click(page, "#panel-start [data-act=new]")
    click(page, "[data-dye=red]")
    is_now(page, "red")
    click(page, "button[aria-label=Undo]")
    click(page, "button[aria-label=Undo]")
    is_now(page, "white creeper:black")


# The line goes dead: what the page says still arrives, and the answers do not.
DEAD = """
window.missed = "";
window.socket.io.engine.transport.ws.onmessage = ({ data }) => { window.missed += data; };
"""

# The browser notices it, and connects again after a moment. Until then an edit is made.
LOST = """
window.socket.io.engine.close();
const { viewer } = document.querySelector(".viewer");
document.querySelector(`[data-dye=${arguments[0]}]`).click();
return [window.socket.connected, viewer.players[0].text, document.getElementById("written").value];
"""


def test_an_edit_is_drawn_without_the_server_which_hears_of_it_later(page: Any) -> None:
    player = "return !!document.querySelector('.viewer').viewer?.players.length"
    wait_until(lambda: page.execute_script(player))
    is_now(page, "white")
    white = write_banner(Banner.parse("white"), "give")
    page.execute_script(DEAD)
    click(page, "[data-dye=red]")
    wait_until(lambda: page.execute_script("return missed.includes('red_banner')"))
    assert page.execute_script(LOST, "lime") == [False, "lime", white]
    is_now(page, "lime")


def test_a_page_that_is_loaded_again_has_its_undo(page: Any) -> None:
    click(page, "[data-pattern=creeper]")
    is_now(page, "white creeper:black")
    wait_until(lambda: "?d=" in page.current_url)
    page.refresh()
    wait_until(lambda: page.execute_script("return !!window.studio?.ready"))
    is_now(page, "white creeper:black")
    wait_until(lambda: find(page, "button[aria-label=Undo]").is_enabled())
    click(page, "button[aria-label=Undo]")
    is_now(page, "white")


RELOADED = """
window.location.reload();
history.replaceState(history.state, "", `${location.search}&again=1`);
"""


def test_an_address_that_changes_while_its_page_is_loaded_again_keeps_the_work(page: Any) -> None:
    """As after a cut connection, when the server lets the page load again and writes a design."""
    click(page, "[data-pattern=creeper]")
    is_now(page, "white creeper:black")
    wait_until(lambda: "?d=" in page.current_url)
    page.execute_script(RELOADED)
    wait_until(lambda: page.execute_script("return !!window.studio?.ready"))
    is_now(page, "white creeper:black")
    wait_until(lambda: find(page, "button[aria-label=Undo]").is_enabled())
    click(page, "button[aria-label=Undo]")
    is_now(page, "white")


def test_only_the_design_that_was_saved_can_save_changes(page: Any) -> None:
    click(page, "[data-pattern=creeper]")
    is_now(page, "white creeper:black")
    page.execute_script("studio.tab('library')")
    click(page, "#panel-library button[aria-label=Save]")
    over = "#panel-library button[aria-label='Save changes']"
    wait_until(lambda: is_shown(page, over))
    click(page, "button[aria-label='Random design']")
    wait_until(lambda: not is_shown(page, over))
    click(page, "button[aria-label=Undo]")
    wait_until(lambda: is_shown(page, over))


def test_sliders_have_a_role_and_a_name_where_the_focus_is(page: Any) -> None:
    sliders = page.find_elements("css selector", "#panel-motion .slider")
    assert len(sliders) >= 7
    for slider in sliders:
        page.execute_script("arguments[0].focus()", slider)
        active = page.switch_to.active_element
        if active == slider:  # those behind Advanced are not shown
            assert active.aria_role == "slider"
            assert active.accessible_name


SHOWN = """
const { wind, view } = document.querySelector(".viewer").viewer.state;
return [wind, view, document.querySelectorAll(".step").length];
"""


def test_undo_brings_back_wind_and_view_between_edits(page: Any) -> None:
    def stands(*wanted: object) -> None:
        wait_until(lambda: page.execute_script(SHOWN) == [*wanted])

    speed = "#panel-motion .slider"
    set_slider = "arguments[0].value = arguments[1]; arguments[0].dispatchEvent(new Event('input'))"
    for value in (6, 7, 8):  # a slider that is dragged is one step
        page.execute_script(set_slider, find(page, speed), value)
    stands(8, "front", 0)
    page.find_element("xpath", "//button[.='Hero']").click()
    stands(8, "hero", 0)
    click(page, "[data-pattern=creeper]")
    stands(8, "hero", 2)
    for wanted in ((8, "hero", 2), (8, "front", 2), (4, "front", 2)):
        click(page, "button[aria-label=Undo]")
        stands(*wanted)
    assert not find(page, "button[aria-label=Undo]").is_enabled()
    for wanted in ((8, "front", 2), (8, "hero", 2)):
        click(page, "button[aria-label=Redo]")
        stands(*wanted)


CHOOSE = """
const labels = [...document.querySelectorAll("label")];
const field = labels.find((e) => e.innerText.startsWith(arguments[0])).querySelector("select");
field.value = arguments[1];
field.dispatchEvent(new Event("change", { bubbles: true }));
"""
CHOSEN = """
const labels = [...document.querySelectorAll(".live-bar label")];
const { wind } = document.querySelector(".viewer").viewer.state;
return [wind, ...labels.map((each) => each.querySelector("select").value)];
"""


def test_undo_brings_back_garment_skin_and_scene_with_the_options_of_the_banner(page: Any) -> None:
    def stands(*wanted: object) -> None:
        wait_until(lambda: page.execute_script(CHOSEN) == [*wanted])

    states: list[tuple[object, ...]] = [(4, "", "", "")]
    for label, name, *shown in (
        ("Garment", "cape", 0.5, "", "cape", ""),
        ("Garment", "pennon", 7, "", "pennon", ""),
        ("Skin", "traveller", 7, "", "pennon", "traveller"),
        ("Scene", "fold", 4, "fold", "", ""),
    ):
        wait_until(lambda name=name: page.find_elements("css selector", f"option[value={name}]"))
        page.execute_script(CHOOSE, label, name)
        states.append((*shown,))
        stands(*shown)
    for way, wanted in (("Undo", states[-2::-1]), ("Redo", states[1:3])):
        for state in wanted:
            click(page, f"button[aria-label={way}]")
            stands(*state)
    wait_until(lambda: "?d=" in page.current_url)
    page.refresh()
    wait_until(lambda: page.execute_script("return !!window.studio?.ready"))
    stands(*states[2])
    page.execute_script(CHOOSE, "Garment", "")
    stands(4, "", "", "")
    assert console_errors(page) == []


EARLY = """
const waiting = setInterval(() => {
  if (!window.studio) return;
  clearInterval(waiting);
  const data = new DataTransfer();
  const more = { bubbles: true, cancelable: true };
  EVENT
}, 1);
"""
EARLY_EVENTS = {
    "pasted": """data.setData("text/plain", "blue skull:white");
    document.body.dispatchEvent(new ClipboardEvent("paste", { clipboardData: data, ...more }));""",
    "dropped": """data.items.add(new File(["blue skull:white"], "design.txt"));
    document.body.dispatchEvent(new DragEvent("drop", { dataTransfer: data, ...more }));""",
}


@pytest.mark.parametrize("way", EARLY_EVENTS)
def test_what_is_pasted_or_dropped_before_the_page_is_whole_is_read(
    chromium: Any, studio: Studio, way: str
) -> None:
    resize(chromium, WIDE)
    source = EARLY.replace("EVENT", EARLY_EVENTS[way])
    added = chromium.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": source})
    try:
        open_page(chromium, studio)
        is_now(chromium, "blue skull:white")
    finally:
        chromium.execute_cdp_cmd("Page.removeScriptToEvaluateOnNewDocument", added)


CUT = """
const cut = [];
for (const each of document.querySelectorAll(".live-bar *, #panel-motion *")) {
  if (!each.offsetParent) continue;
  if (each.matches("select")) {
    const alone = each.cloneNode();
    alone.append(each.selectedOptions[0].cloneNode(true));
    alone.style = "position: absolute; width: auto";
    each.parentElement.append(alone);
    if (alone.offsetWidth > each.offsetWidth) cut.push(each.selectedOptions[0].text);
    alone.remove();
  } else if (getComputedStyle(each).textOverflow === "ellipsis") {
    if (each.scrollWidth > each.clientWidth) cut.push(each.textContent);
  }
}
return cut;
"""


def test_no_choice_under_the_live_view_is_cut_off(page: Any) -> None:
    assert page.execute_script(CUT) == []


@pytest.mark.parametrize(
    "size", [(320, 640), (640, 400), (820, 1180), (1000, 700), (1280, 800), (3840, 2160)]
)
def test_the_live_view_comes_first_at_every_width(
    chromium: Any, studio: Studio, size: tuple[int, int]
) -> None:
    resize(chromium, size)
    open_page(chromium, studio, "?design=red+creeper:lime")
    click(chromium, ".live-bar button[aria-label=Pause]")
    script = """
      const box = (name) => document.querySelector(name).getBoundingClientRect();
      const [view, face] = [box(".live-view"), box(".face")];
      const wide = document.documentElement.scrollWidth;
      const over = [...document.querySelectorAll(".live-bar button")].filter(
        (each) => each.getBoundingClientRect().right > box(".live-bar").right + 1);
      const tabs = [...document.querySelectorAll(".tab")].filter((each) => each.offsetParent);
      const rows = new Set(tabs.map((each) => each.offsetTop)).size;
      const other = box(".face-other");
      const covered = other.height && Math.max(0, face.bottom - other.top);
      const [seen, flat] = [view, face].map((each) => each.width * each.height);
      return [seen, flat, view.top, wide, over.length, rows, covered];
    """
    view, face, top, wide, over, rows, covered = chromium.execute_script(script)
    assert view > face
    assert top < size[1] / 2
    assert wide <= size[0]
    assert over == 0
    assert rows == 1
    assert covered == 0
    if size[0] < 1000:
        chromium.execute_script("window.scrollTo(0, 400)")
        wait_until(lambda: chromium.execute_script(script)[2] >= -1)
    resize(chromium, WIDE)


BELOW = """
const bottom = (each) => each.getBoundingClientRect().bottom;
return [...document.querySelectorAll(".pattern")].map(bottom);
"""
BROKEN = """
// A caption whose longest word is wider than its button is broken inside of the word.
const ruler = document.createElement("canvas").getContext("2d");
return [...document.querySelectorAll(".pattern .caption")].filter((each) => {
  ruler.font = getComputedStyle(each).font;
  const widths = each.textContent.split(" ").map((word) => ruler.measureText(word).width);
  return Math.max(...widths) > each.parentElement.clientWidth;
}).map((each) => each.textContent);
"""


def test_all_patterns_are_on_one_screen_over_the_present_design(
    chromium: Any, studio: Studio
) -> None:
    resize(chromium, (1440, 900))
    open_page(chromium, studio, "?design=white+creeper:lime+border:black")
    bottoms = wait_until(lambda: chromium.execute_script(BELOW))
    assert len(bottoms) == len(PATTERN_NAMES)
    assert max(bottoms) <= 900
    assert chromium.execute_script(BROKEN) == []
    resize(chromium, WIDE)


def test_a_phone_has_one_row_of_header_and_the_dyes_in_reach(chromium: Any, studio: Studio) -> None:
    resize(chromium, PHONE)
    open_page(chromium, studio, "?design=white+creeper:lime")
    rows = """
      const buttons = [...document.querySelectorAll(".bar button")];
      const boxes = buttons.map((each) => each.getBoundingClientRect());
      const middles = boxes.filter(({ height }) => height).map(({ top, bottom }) => top + bottom);
      return Math.max(...middles) - Math.min(...middles);
    """
    assert chromium.execute_script(rows) <= 4
    reach = "return document.querySelector('.dye-grid').getBoundingClientRect().bottom"
    for top in (0, 400):
        chromium.execute_script("window.scrollTo(0, arguments[0])", top)
        assert chromium.execute_script(reach) <= PHONE[1]
    resize(chromium, WIDE)


COVERED = """
const box = (each) => each.getBoundingClientRect();
const shown = [...document.querySelectorAll(".q-notification")];
const list = box(shown[0].parentElement);
const panels = ".bar, .tabs, .live-bar, .left > *, .under, .side > *";
return [...document.querySelectorAll(panels)].filter((each) => {
  const { top, bottom, left, right, height } = box(each);
  const across = shown.map(box).filter((line) => line.left < right && line.right > left);
  const low = (line) => Math.min(line.bottom, list.bottom);
  return height && across.some((line) => line.top < bottom && low(line) > top);
}).map((each) => each.className);
"""


@pytest.mark.parametrize("size", [PHONE, (1000, 700), (1440, 900)])
def test_three_messages_cover_no_panel(
    chromium: Any, studio: Studio, size: tuple[int, int]
) -> None:
    resize(chromium, size)
    open_page(chromium, studio)
    for text in ("/give @p stone", "no banner", "white creeper"):
        paste(chromium, text)
    wait_until(lambda: len(notices(chromium)) == 3)
    wait_until(lambda: not chromium.execute_script(COVERED))  # once they have slid in
    resize(chromium, WIDE)


def test_the_page_speaks_the_language_of_the_browser(chromium: Any, studio: Studio) -> None:
    resize(chromium, WIDE)
    chromium.execute_cdp_cmd("Network.enable", {})
    header = {"headers": {"Accept-Language": "de-AT,en;q=0.5"}}
    chromium.execute_cdp_cmd("Network.setExtraHTTPHeaders", header)
    try:
        open_page(chromium, studio)
        wait_until(lambda: find(chromium, "html").get_attribute("lang") == "de")
        assert find(chromium, "#tab-patterns").text.endswith("Muster")
        assert is_shown(chromium, "button[aria-label='Rückgängig']")
        assert find(chromium, "[data-pattern=cross]").get_attribute("title") == "Andreaskreuz"
        assert find(chromium, "[data-dye=light_blue]").get_attribute("title") == "Hellblau"
        assert chromium.execute_script(CUT) == []
        click(chromium, "[data-pattern=cross]")
        wait_until(lambda: find(chromium, ".layer-name b").text == "Andreaskreuz")
        click(chromium, ".layer-list .layer")
        assert find(chromium, ".panel-palette h2").text == "Lage 1: Andreaskreuz"
    finally:
        chromium.execute_cdp_cmd("Network.setExtraHTTPHeaders", {"headers": {}})
