"""Check the package for npm: `python -m release.check_npm FILE.tgz [BUNDLER ...]`.

Each section of `docs/guides/vite.md` that runs a bundler becomes a project: its files, or those of
the section before, and its lines as they stand. The site that is built is opened in Chromium under
a path prefix, where the cloth of each element must move and the console stay empty. TypeScript must
find the types of the package. It needs npm, Chromium and ten minutes.
"""

import argparse
import re
import shlex
import shutil
import subprocess
import tempfile
import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any, NamedTuple

from release.build import ROOT

GUIDE = ROOT / "docs/guides/vite.md"
PACKAGE = "./drapery-banner"
PREFIX = "/banners"
TYPES = "--noEmit --strict --target es2022 --module esnext --moduleResolution bundler main.ts"
WAIT = 60.0
"""How long a page may take to show its cloth, and the cloth to move [s]."""
PICTURES = """
const inner = [...document.querySelectorAll("drapery-designer")].map(
  (each) => each.shadowRoot?.querySelector("drapery-banner"));
const live = [...document.querySelectorAll("drapery-banner"), ...inner].map(
  (each) => each?.shadowRoot?.querySelector("canvas:not([hidden])"));
return live.map((each) => each && each.width > 0 ? each.toDataURL() : null);
"""


class Project(NamedTuple):
    """What a section of the guide does."""

    name: str
    files: dict[str, str]
    commands: list[list[str]]


def projects() -> list[Project]:
    """The projects of the guide, in its order."""
    found: list[Project] = []
    files: dict[str, str] = {}
    for section in re.split(r"(?m)^## ", GUIDE.read_text("utf-8"))[1:]:
        blocks = re.findall(r"(?ms)^```([^\n]*)\n(.*?)^```$", section)
        titled = [(re.search('title="(.+)"', head), text) for head, text in blocks]
        own = {title[1]: text for title, text in titled if title}
        lines = [line for head, text in blocks if not head for line in text.splitlines()]
        commands = [shlex.split(line) for line in lines]
        files = {**files, **own} if list(own) == ["main.js"] else own or files
        if any(words[0] == "npx" for words in commands):
            found.append(Project(section.splitlines()[0], files, commands))
    return found


def built(project: Project, folder: Path, package: Path) -> Path:
    """The site that a project builds in a folder."""
    for name, text in project.files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text, "utf-8")
    for words in project.commands:
        npm(folder, *(str(package.resolve()) if word == PACKAGE else word for word in words))
    if "main.ts" in project.files:
        npm(folder, "npm", "install", "--no-audit", "--no-fund", "typescript@5")
        npm(folder, "npx", "tsc", *TYPES.split())
    return next(folder / name for name in ("out", "dist") if (folder / name).is_dir())


def npm(folder: Path, program: str, *words: str) -> None:
    """Run a program of npm, which is a script of cmd on Windows."""
    command = [shutil.which(program) or program, *words]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(f"{shlex.join([program, *words])}:\n{done.stdout}{done.stderr}")


class _Handler(SimpleHTTPRequestHandler):
    def translate_path(self, path: str) -> str:
        inner = path.removeprefix(PREFIX) if path.startswith(f"{PREFIX}/") else "/missing"
        return super().translate_path(inner)

    def log_message(self, format: str, *args: Any) -> None:
        pass


@contextmanager
def served(folder: Path) -> Iterator[str]:
    """The address of a folder under the prefix."""
    server = ThreadingHTTPServer(("127.0.0.1", 0), partial(_Handler, directory=str(folder)))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    try:
        yield f"http://127.0.0.1:{server.server_port}{PREFIX}/"
    finally:
        server.shutdown()


@contextmanager
def browser() -> Iterator[Any]:
    """A Chromium without a window."""
    from selenium import webdriver

    options = webdriver.ChromeOptions()
    options.binary_location = shutil.which("chromium") or shutil.which("google-chrome") or ""
    for flag in ("--headless=new", "--no-sandbox", "--enable-unsafe-swiftshader"):
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    service = webdriver.ChromeService(shutil.which("chromedriver"))
    opened = webdriver.Chrome(options=options, service=service)
    try:
        yield opened
    finally:
        opened.quit()


def check_site(page: Any, address: str) -> int:
    """How many banners of a page move. Raises SystemExit for one that does not, and for a line on
    the console."""
    page.get(address)
    first, end = _pictures(page), time.monotonic() + WAIT
    while not _moves(first, now := _pictures(page)):
        first = [*(old or new for old, new in zip(first, now, strict=True))] if first else now
        if time.monotonic() > end:
            raise SystemExit(f"{sum(map(bool, now))} of {len(now)} banners of the page are live")
        time.sleep(0.2)
    logged = [each for each in page.get_log("browser") if each["source"] != "rendering"]
    if told := [each["message"] for each in logged if "/favicon.ico" not in each["message"]]:
        raise SystemExit("the console has lines:\n" + "\n".join(told))
    return len(now)


def _pictures(page: Any) -> list[str | None]:
    found: list[str | None] = page.execute_script(PICTURES)
    return found


def _moves(first: list[str | None], now: list[str | None]) -> bool:
    pairs = list(zip(first, now, strict=False))
    return bool(pairs) and all(old and new and old != new for old, new in pairs)


def main(words: Sequence[str] | None = None) -> None:
    """The command. Raises SystemExit where a program fails or a page is not live."""
    known = {each.name.lower(): each for each in projects()}
    parser = argparse.ArgumentParser("python -m release.check_npm", description=__doc__)
    parser.add_argument("package", type=Path)
    parser.add_argument("bundlers", nargs="*", metavar="BUNDLER", help=", ".join(known))
    given = parser.parse_args(words)
    if strange := sorted(set(given.bundlers) - known.keys()):
        parser.error(f"{strange[0]} is not known; use of: {', '.join(known)}")
    for name in given.bundlers or known:
        with tempfile.TemporaryDirectory() as folder, browser() as page:
            site = built(known[name], Path(folder).resolve(), given.package)
            with served(site) as address:
                print(f"{known[name].name}: {check_site(page, address)} live banners", flush=True)


if __name__ == "__main__":
    main()
