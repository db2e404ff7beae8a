"""The studio under use: `python -m benchmarks.studio session` or `first`.

`session` does random things on the page in Chromium (`--minutes 30 --seed 1`). Each action must
leave no error in the browser's console, no traceback in the server's log, and a design that only
actions on designs change, and that Undo brings back. It prints what failed; then it exits with 1.

`first` opens the page in Chromium again and again (`--count 10`) and prints the time from the
address to a picture of cloth that has moved. Kernels, files and the browser's cache are warm.
"""

import argparse
import random
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from contextlib import ExitStack, suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

from pack_maker import BANNER, META, mcmeta, noise, png, zip_pack
from selenium.common.exceptions import WebDriverException
from selenium.webdriver import ActionChains, Keys
from studio_browser import (
    CHROMIUM,
    DRIVER,
    PHONE,
    WIDE,
    Studio,
    console_errors,
    open_browser,
    open_page,
    paste,
    resize,
    wait_until,
)

from benchmarks.quick import add_quick, needs
from drapery import Banner, Layer
from drapery.banner import DYE_NAMES, PATTERN_NAMES, write_banner

QUIET = 0.25
"""An action has had its effect when the design has not changed for this time [s]."""
USABLE = """
const usable = "button, select, summary, input:not([type=file])";
const avoided = "a[download], [data-copy]";
return [...document.querySelectorAll(usable)].filter(
  (e) => !e.disabled && !e.matches(avoided) && e.checkVisibility({ visibilityProperty: true })
    && e.getBoundingClientRect().width > 2);
"""
SET = """
const [field, share] = arguments;
if (field.tagName === "SELECT") field.selectedIndex = Math.floor(share * field.options.length);
else field.value = Number(field.min) + share * (Number(field.max) - Number(field.min));
for (const name of ["input", "change"]) field.dispatchEvent(new Event(name, { bubbles: true }));
"""
FIRST = """
const look = () => {
  const waves = document.querySelector(".viewer")?.viewer?.time > 0;
  // What has come is drawn before the next frame.
  requestAnimationFrame(waves ? (now) => (window.waves = now) : look);
};
requestAnimationFrame(look);
"""
WORDS = ("creeper", "12", "-3", "lime ghost", "zigzag, red", "'\"<b>", "1e9", "", "München 4")


@dataclass
class Visitor:
    """Someone who does random things on a page. folder: of files to send."""

    page: Any
    studio: Studio
    folder: Path
    random: random.Random
    faults: list[str] = field(default_factory=list)
    counts: dict[str, int] = field(default_factory=dict)
    last: str = ""

    @property
    def design(self) -> str:
        """The design as the page writes it."""
        return str(self.page.execute_script("return document.getElementById('written').value"))

    def settled_design(self) -> str:
        """The design once it has not changed for a moment."""
        shown, since = self.design, time.monotonic()
        while time.monotonic() < since + QUIET:
            time.sleep(0.05)
            if (now := self.design) != shown:
                shown, since = now, time.monotonic()
        return shown

    def act(self) -> None:
        """Do one thing and look at its effect."""
        name = self.random.choice(list(ACTIONS))
        self.counts[name] = self.counts.get(name, 0) + 1
        before = self.settled_design()
        what = name
        try:
            what = f"{name} {ACTIONS[name](self) or ''}"
        except WebDriverException as error:
            # What is covered or has gone meanwhile cannot be clicked by anyone.
            if "tab crashed" in str(error):
                raise
        with suppress(WebDriverException):
            self.page.switch_to.alert.accept()
        after = self.settled_design()
        # A busy server may show the effect of the action before only now.
        late, self.last = self.last in DESIGNING, name
        self._look(what, before, after, may_change=name in DESIGNING or late, undo=not late)

    def _look(self, what: str, before: str, after: str, *, may_change: bool, undo: bool) -> None:
        found = [f"console: {line}" for line in console_errors(self.page)]
        log = "".join(self.studio.log)
        if "Traceback" in log or "ERROR" in log:
            found.append(f"log: {log[-3000:]}")
            self.studio.log.clear()
        if before != after and not may_change:
            found.append(f"the design has changed from {before} to {after}")
        elif undo and before != after and what.split()[0] in UNDOABLE and not _is_step(what):
            found += self._undone(before, after)
        for line in found:
            print(f"FAULT after {what}: {line}", flush=True)
        self.faults += found

    def _undone(self, before: str, after: str) -> list[str]:
        """What is wrong with Undo and Redo of the last change."""
        press = "document.querySelector(`.bar-group button:nth-of-type(${arguments[0]})`).click()"
        for number, wanted in ((1, before), (2, after)):
            self.page.execute_script(press, number)
            try:
                wait_until(lambda wanted=wanted: self.design == wanted, 10)
            except AssertionError:
                return [f"{('Undo', 'Redo')[number - 1]} gives {self.design}, not {wanted}"]
        return []

    def find(self, selector: str) -> list[Any]:
        """The elements that are shown."""
        found = self.page.find_elements("css selector", selector)
        return [each for each in found if each.is_displayed()]

    def pick(self, selector: str) -> str:
        """Click one of the elements that are shown."""
        found = self.find(selector)
        if not found:
            return ""
        chosen = self.random.choice(found)
        words = chosen.get_attribute("outerHTML")[:100]
        self.page.execute_script("arguments[0].scrollIntoView({block: 'center'})", chosen)
        chosen.click()
        return words

    def press(self, *keys: str) -> str:
        """Press keys on what has the focus."""
        ActionChains(self.page).send_keys(*keys).perform()
        return repr(keys)


def _is_step(what: str) -> bool:
    """Whether a click was on a step of the history, after which Undo goes elsewhere."""
    return any(each in what for each in ('class="step"', 'aria-label="Undo"', 'aria-label="Redo"'))


def _tab(visitor: Visitor) -> str:
    return visitor.pick(".tab")


def _dye(visitor: Visitor) -> str:
    return visitor.pick(".dye")


def _pattern(visitor: Visitor) -> str:
    visitor.page.execute_script("studio.tab('patterns')")
    name = visitor.random.choice(PATTERN_NAMES)
    return visitor.pick(f"[data-pattern={name}]")


def _layer(visitor: Visitor) -> str:
    return visitor.pick(".layer-list .layer")


def _layer_tool(visitor: Visitor) -> str:
    return visitor.pick(".layer-list .icon")


def _random_design(visitor: Visitor) -> str:
    return visitor.pick("button[aria-label='Random design']")


def _paste(visitor: Visitor) -> str:
    pick = visitor.random.choice
    layers = (Layer(pick(PATTERN_NAMES), pick(DYE_NAMES)) for _ in range(4))
    banner = Banner(pick(DYE_NAMES), tuple(layers))
    text = write_banner(banner, visitor.random.choice(("give", "text", "needcoolshoes")))
    paste(visitor.page, text)
    return text


def _paste_nonsense(visitor: Visitor) -> str:
    text = visitor.random.choice(("white creeper:mauve", "{", "/give @p stone", "\x00", "ab " * 99))
    paste(visitor.page, text)
    return repr(text)


def _own_design(visitor: Visitor) -> str:
    visitor.page.execute_script("studio.tab('start')")
    return visitor.pick("#panel-start .own-design")


def _history(visitor: Visitor) -> str:
    return visitor.pick("button[aria-label=Undo], button[aria-label=Redo], .step")


def _title(visitor: Visitor) -> str:
    field, word = visitor.find("input.title")[0], visitor.random.choice(WORDS)
    field.send_keys(Keys.CONTROL + "a" + Keys.NULL, word or Keys.DELETE, Keys.TAB)
    return word


def _set(visitor: Visitor) -> str:
    """Move a slider, choose in a list, or type into a field."""
    fields = visitor.find("select, input.slider, .field:is(input):not(.title)")
    if not fields:
        return ""
    one = visitor.random.choice(fields)
    words = one.get_attribute("outerHTML")[:100]
    if one.get_attribute("type") in ("text", "number", "search"):
        word = visitor.random.choice(WORDS)
        one.send_keys(Keys.CONTROL + "a" + Keys.NULL, word, Keys.TAB)
        return f"{words} {word}"
    visitor.page.execute_script(SET, one, visitor.random.random())
    return words


def _choose_show(visitor: Visitor) -> str:
    """A scene or a garment in the viewer, or the banner again."""
    fields = visitor.find(".live-bar select")
    if not fields:
        return ""
    one = visitor.random.choice(fields)
    visitor.page.execute_script(SET, one, visitor.random.choice([0.0, visitor.random.random()]))
    return str(one.get_attribute("value"))


def _viewer(visitor: Visitor) -> str:
    """Views and pause, keys of the wind, or a pull."""
    kind = visitor.random.randrange(3)
    if kind == 0:
        return visitor.pick(".live-bar button")
    canvas = visitor.find(".viewer-host")[0]
    if kind == 1:
        canvas.send_keys(visitor.random.choice("wasdqe +-"))
        return "keys"
    chain = ActionChains(visitor.page).move_to_element(canvas).click_and_hold()
    chain.move_by_offset(visitor.random.randint(-60, 60), 20).release().perform()
    return "drag"


def _export(visitor: Visitor) -> str:
    visitor.page.execute_script("studio.tab('export')")
    return visitor.pick("#panel-export button:not([data-copy])")


def _pack(visitor: Visitor) -> str:
    visitor.page.execute_script("studio.tab('packs')")
    kind = visitor.random.randrange(3)
    if kind:
        return visitor.pick(".pack button, .pack input")
    seed = visitor.random.randrange(4)
    files = {META: mcmeta(), f"{BANNER}creeper.png": png(noise(seed))}
    path = zip_pack(visitor.folder / f"pack {seed}.zip", files)
    visitor.page.find_element("css selector", "#panel-packs input[type=file]").send_keys(str(path))
    return path.name


def _library(visitor: Visitor) -> str:
    visitor.page.execute_script("studio.tab('library')")
    return visitor.pick("#panel-library button, .q-dialog button")


def _letters(visitor: Visitor) -> str:
    visitor.page.execute_script("studio.tab('letters')")
    return visitor.pick("#panel-letters .found")


def _anything(visitor: Visitor) -> str:
    found = visitor.page.execute_script(USABLE)
    chosen = visitor.random.choice(found)
    words = chosen.get_attribute("outerHTML")[:160]
    visitor.page.execute_script("arguments[0].scrollIntoView({block: 'center'})", chosen)
    chosen.click()
    return words


def _keys(visitor: Visitor) -> str:
    keys = [Keys.TAB, Keys.ENTER, Keys.ESCAPE, Keys.DELETE, Keys.ARROW_DOWN, *"rbmh?/ "]
    return visitor.press(visitor.random.choice(keys))


def _resize(visitor: Visitor) -> str:
    size = visitor.random.choice((WIDE, PHONE, (820, 1180), (320, 640)))
    resize(visitor.page, size, dark=visitor.random.random() < 0.5)
    return str(size)


def _reload(visitor: Visitor) -> str:
    visitor.page.refresh()
    wait_until(lambda: visitor.page.execute_script("return !!window.studio?.ready"))
    return ""


ACTIONS: dict[str, Callable[[Visitor], str]] = {
    "tab": _tab,
    "dye": _dye,
    "pattern": _pattern,
    "layer": _layer,
    "layer-tool": _layer_tool,
    "random-design": _random_design,
    "paste": _paste,
    "nonsense": _paste_nonsense,
    "own-design": _own_design,
    "history": _history,
    "title": _title,
    "set": _set,
    "show": _choose_show,
    "viewer": _viewer,
    "export": _export,
    "pack": _pack,
    "library": _library,
    "letters": _letters,
    "anything": _anything,
    "keys": _keys,
    "resize": _resize,
    "reload": _reload,
}
UNDOABLE = frozenset(
    {"dye", "pattern", "layer-tool", "random-design", "paste", "own-design", "letters", "anything"}
)
"""Actions whose change of the design one Undo takes back."""
DESIGNING = UNDOABLE | {"history", "library", "keys", "set"}
"""Actions that may change the design; `set` may choose the form in which it is written."""


def session(minutes: float, seed: int) -> int:
    """A session of random actions. Returns the number of faults."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        studio, driver = Studio(folder), open_browser(folder)
        visitor = Visitor(driver, studio, folder, random.Random(seed))
        try:
            open_page(driver, studio)
            end = time.monotonic() + 60 * minutes
            while time.monotonic() < end:
                visitor.act()
        finally:
            count, faults = sum(visitor.counts.values()), len(visitor.faults)
            print(f"{count} actions in {minutes:g} minutes, seed {seed}: {faults} faults")
            print(", ".join(f"{name} {number}" for name, number in sorted(visitor.counts.items())))
            driver.quit()
            with suppress(subprocess.TimeoutExpired):  # on a busy machine; then it is killed
                studio.stop()
    return faults


def first(count: int) -> None:
    """Opens the page and prints the time until its cloth waves."""
    with tempfile.TemporaryDirectory() as name, ExitStack() as stack:
        folder, times = Path(name), []
        studio, driver = Studio(folder), open_browser(folder)
        stack.callback(studio.stop)
        stack.callback(driver.quit)
        driver.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": FIRST})
        for _ in range(count + 1):
            open_page(driver, studio)
            times.append(wait_until(lambda: driver.execute_script("return window.waves")) / 1000)
    cold, *warm = times
    print(
        f"first waving frame: {statistics.median(warm):.2f} s, {min(warm):.2f} to {max(warm):.2f}"
    )
    print(f"of the studio's first page: {cold:.2f} s")


def main(words: Sequence[str] | None = None) -> int:
    """Run one of them."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.studio", description=__doc__)
    add_quick(parser)
    commands = parser.add_subparsers(dest="command")
    one = commands.add_parser("session")
    one.add_argument("--minutes", type=float, default=30)
    one.add_argument("--seed", type=int, default=1)
    one = commands.add_parser("first")
    one.add_argument("--count", type=int, default=10)
    given = parser.parse_args(words)
    needs(CHROMIUM and DRIVER, "Chromium or its driver")
    if given.quick:
        first(1)
        return 1 if session(0.02, 1) else 0
    if given.command is None:
        parser.error("name one of: session, first")
    if given.command == "session":
        return 1 if session(given.minutes, given.seed) else 0
    first(given.count)
    return 0


if __name__ == "__main__":
    sys.exit(main())
