"""Live cloth in headless Chromium on software GL: the first waving frame, and many banners.

`python -m benchmarks.web_page` needs Chromium, its driver and selenium, and the kernels of
`python -m drapery.web.wasm.build`. The times are of the processor: of the page's main thread, which
steps the cloth, and of the process that draws with the software GL. Each of the two may take 16.7
ms at 60 frames/s. Each frame moves the cloth by 1/60 s, however long it takes.
"""

import argparse
import gzip
import shutil
import sys
import tempfile
import time
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import psutil
from selenium.webdriver import Chrome, ChromeOptions, ChromeService

from benchmarks.quick import add_quick, needs
from benchmarks.web import whole_module
from drapery import Banner, Settings
from drapery.web.page import page_text
from drapery.web.wasm.module import is_module_built

BANNERS = 20
SECONDS = 10.0
FLAGS = (
    *("--headless=new", "--no-sandbox", "--disable-gpu", "--use-angle=swiftshader"),
    *("--enable-unsafe-swiftshader", "--window-size=1280,1024"),
)
SETTINGS: Any = {"solver": "desbrun", "grid": (11, 21), "size": (120, 180)}
FIRST = """
const start = performance.now();
document.addEventListener("drapery-ready", () => requestAnimationFrame(() => requestAnimationFrame(
  () => (window.first = performance.now()))));
window.frames = 0;
const count = () => { window.frames++; requestAnimationFrame(count); };
requestAnimationFrame(count);
"""
CLOCK = """
const request = requestAnimationFrame.bind(window);
window.requestAnimationFrame = (call) => request(() => call((window.frames * 1000) / 60));
"""
UNDRAWN = """
for (const name of ["clear", "drawElements", "blitFramebuffer"])
  WebGL2RenderingContext.prototype[name] = () => {};
CanvasRenderingContext2D.prototype.drawImage = () => {};
"""


def opened(folder: Path, name: str, text: str) -> Any:
    """A browser that has loaded a page, whose scripts FIRST and CLOCK ran before it."""
    options = ChromeOptions()
    for flag in FLAGS:
        options.add_argument(flag)
    options.binary_location = str(shutil.which("chromium"))
    driver = Chrome(options=options, service=ChromeService(str(shutil.which("chromedriver"))))
    command = "Page.addScriptToEvaluateOnNewDocument"
    driver.execute_cdp_cmd(command, {"source": FIRST + CLOCK})
    driver.execute_cdp_cmd("Performance.enable", {"timeDomain": "threadTicks"})
    (folder / name).write_text(text, encoding="utf-8")
    driver.get((folder / name).as_uri())
    while driver.execute_script("return window.first ?? null") is None:
        time.sleep(0.05)
    return driver


def busy(driver: Any) -> tuple[float, float, int]:
    """Seconds that the main thread and the process of the GL have worked, and the frames."""
    metrics = driver.execute_cdp_cmd("Performance.getMetrics", {})["metrics"]
    task = next(each["value"] for each in metrics if each["name"] == "TaskDuration")
    every = psutil.Process(driver.service.process.pid).children(recursive=True)
    drawing = [each for each in every if "--type=gpu-process" in each.cmdline()]
    spent = sum(sum(each.cpu_times()[:2]) for each in drawing)
    return task, spent, driver.execute_script("return window.frames")


def main() -> int:
    """Print the figures."""
    parser = argparse.ArgumentParser(description=__doc__)
    add_quick(parser)
    quick = parser.parse_args().quick
    needs(shutil.which("chromium") and shutil.which("chromedriver"), "Chromium or its driver")
    banners, seconds = (2, 0.5) if quick else (BANNERS, SECONDS)
    if quick and find_spec("ziglang"):
        whole_module(quick)  # pages find it beside numba's kernels
    needs(is_module_built(), "The module of `drapery.web.wasm.build`")
    settings = Settings(**SETTINGS)
    text = page_text(Banner.parse("white creeper:lime border:black"), settings)
    print(f"page: {len(text)} bytes, gzipped {len(gzip.compress(text.encode()))}")
    start, end = text.index("<drapery-banner"), text.index("</drapery-banner>") + 17
    many = text[:start] + banners * text[start:end] + text[end:]
    many = many.replace("main { display: grid;", "main { display: flex; flex-wrap: wrap;")
    with tempfile.TemporaryDirectory() as name:
        driver = opened(Path(name), "one.html", text)
        first = driver.execute_script("return window.first")
        task, drawn, _ = busy(driver)
        print(
            f"first waving frame: {first:.0f} ms; thread {task * 1e3:.0f}, GL {drawn * 1e3:.0f} ms"
        )
        driver.quit()
        driver = opened(Path(name), "many.html", many)
        for what, script in (("stepped and drawn", ""), ("stepped only", UNDRAWN)):
            driver.execute_script(script)
            before = busy(driver)
            time.sleep(seconds)
            task, drawn, frames = (b - a for a, b in zip(before, busy(driver), strict=True))
            per = 1e3 / max(frames, 1)
            print(
                f"{banners} banners 11x21, {what}: {frames / seconds:.1f} frames/s;"
                f" thread {task * per:.1f} ms a frame, GL {drawn * per:.1f} ms"
            )
        driver.quit()
    return 0


if __name__ == "__main__":
    sys.exit(main())
