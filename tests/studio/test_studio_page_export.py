"""Packs, exports and the library on the real page; and its doors, tried by raw HTTP."""

import http.client
import json
import socket
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any
from urllib.parse import quote, urlsplit

import pytest
from pack_maker import CREEPER, META, mcmeta, plain, zip_pack
from studio_browser import (
    WIDE,
    Studio,
    console_errors,
    drop as drop_file,
    lying,
    notices,
    open_page,
    resize,
    wait_until,
)

from drapery.settings import Settings
from drapery.studio.panels.file_options import difference
from drapery.studio.share import read_link, write_link
from drapery.studio.sketch import Sketch, Stroke
from drapery.studio.viewport import ViewportRequest

DESIGN = Sketch(
    "red", (Stroke("creeper", "lime"), Stroke("border", "black")), "banner", "Lime Ghost"
)


class Page:
    """The page of one tab, by what a person sees of it."""

    def __init__(self, driver: Any, studio: Studio, query: str = "") -> None:
        self.driver, self.studio = driver, studio
        open_page(driver, studio, query)

    def run(self, script: str, *words: Any) -> Any:
        return self.driver.execute_script(script, *words)

    def tab(self, name: str) -> None:
        self.run("studio.tab(arguments[0])", name)

    def find(self, selector: str) -> Any:
        return self.driver.find_element("css selector", selector)

    def click(self, panel: str, label: str) -> None:
        wait_until(lambda: self.run(CLICK, panel, label))

    def fill(self, panel: str, label: str, value: Any) -> None:
        wait_until(lambda: self.run(FILL, panel, label, value))

    def text(self, selector: str) -> str:
        return str(self.run("return document.querySelector(arguments[0])?.value ?? ''", selector))

    def notice(self, words: str) -> str:
        """The notice with these words, which may be gone again."""
        found = wait_until(lambda: [each for each in notices(self.driver) if words in each])
        return found[0]

    @property
    def token(self) -> str:
        return str(self.run("return document.querySelector('.studio').dataset.token"))


CLICK = """
const panel = document.querySelector(`#panel-${arguments[0]}`) ?? document.body;
const dialog = document.querySelectorAll(".q-dialog button");
const found = [...panel.querySelectorAll("button"), ...dialog]
  .find((each) => each.getAttribute("aria-label") === arguments[1] && !each.disabled);
found?.click();
return !!found;
"""
FILL = """
const root = document.querySelector(arguments[0] ? `#panel-${arguments[0]}` : ".q-dialog");
const field = [...(root?.querySelectorAll("label") ?? [])]
  .find((each) => each.innerText.trimStart().startsWith(arguments[1]))
  ?.querySelector("input, select");
if (!field) return false;
const choices = [...(field.options ?? [])].map((each) => each.value);
if (choices.length && !choices.includes(arguments[2])) return false;  // not offered yet
const tick = field.type === "checkbox";
field[tick ? "checked" : "value"] = arguments[2];
field.dispatchEvent(new Event("input", { bubbles: true }));
field.dispatchEvent(new Event("change", { bubbles: true }));
return true;
"""


MOVES = pytest.mark.parametrize("moves", [True], ids=["moves"])


@pytest.fixture
def moves() -> bool:
    """Whether the user of a test's page wants motion; `MOVES` says so."""
    return False


@pytest.fixture
def page(chromium: Any, studio: Studio, moves: bool) -> Iterator[Page]:
    resize(chromium, WIDE, moves=moves)
    opened = Page(chromium, studio, f"?d={write_link(DESIGN, Settings())}")
    yield opened
    assert console_errors(chromium) == []
    assert "Traceback" not in "".join(studio.log)


@pytest.fixture
def downloads(chromium: Any, tmp_path: Path) -> Path:
    behaviour = {"behavior": "allow", "downloadPath": str(tmp_path / "downloads")}
    chromium.execute_cdp_cmd("Browser.setDownloadBehavior", behaviour)
    return tmp_path / "downloads"


def landed(downloads: Path, name: str) -> bytes:
    wait_until(lambda: (downloads / name).exists())
    return (downloads / name).read_bytes()


@MOVES
def test_a_picture_is_the_commands_to_the_byte(
    page: Page, downloads: Path, tmp_path: Path, drapery: Any
) -> None:
    page.tab("export")
    page.fill("export", "Width", "160")
    page.fill("export", "Height", "120")
    page.fill("export", "View", "iso")
    page.fill("export", "Background", "colour")
    page.fill("export", "Background colour", "#204060")
    page.fill("export", "Shadow", True)
    wait_until(lambda: "--shadow" in page.text("#as-command"))
    page.click("export", "Export the file")
    picture = landed(downloads, "lime-ghost.png")
    words = page.text("#as-command").replace('"', "|").split("|")
    assert words[:2] == ["drapery render ", "red creeper:lime border:black"]
    options = ("--view", "iso", "--size", "160x120", "--background", "#204060", "--shadow")
    code, _, err = drapery("render", words[1], "-o", tmp_path / "x.png", *options)
    assert code == 0, err
    assert (tmp_path / "x.png").read_bytes() == picture
    link = page.find("#panel-export a.export-link")
    assert wait_until(lambda: link.text).startswith("lime-ghost")
    page.run("document.querySelector('.live-bar button[aria-label=Pause]').click()")
    wait_until(lambda: "--time" in page.text("#as-command"))
    assert link.is_displayed(), "a pause makes no file stale"
    page.fill("export", "Width", "161")
    wait_until(lambda: not link.is_displayed())


def test_what_the_live_banner_has_alone_is_said() -> None:
    assert difference(ViewportRequest(), "glb") == ""
    assert difference(ViewportRequest(scene="sail"), "png") == ""
    assert "not the scene" in difference(ViewportRequest(scene="sail"), "glb")


def test_a_file_without_wind_is_exported_without_wind(page: Page) -> None:
    page.run(
        "[...document.querySelectorAll('#panel-motion label')]"
        ".find((each) => each.innerText.includes('Wind on')).click()"
    )
    wait_until(lambda: "--wind 0" in page.text("#as-command"))
    assert not page.find("#panel-export .warning").is_displayed()


def test_an_animation_shows_progress_and_can_be_stopped(page: Page, downloads: Path) -> None:
    page.tab("export")
    page.fill("export", "File", "apng")
    page.fill("export", "Width", "240")  # enough frames that it can be stopped before the last
    page.fill("export", "Height", "180")
    page.fill("export", "Seconds", "40")
    wait_until(lambda: "--seconds 40" in page.text("#as-command"))
    page.click("export", "Export the file")
    shown = "return document.querySelector('#panel-export progress').value"
    first = wait_until(lambda: page.run(shown))
    assert wait_until(lambda: page.run(shown) > first)
    page.click("export", "Stop the export")
    page.notice("Stopped; no file was made")
    assert wait_until(lambda: not lying(page.studio.folder, "drapery-studio-*/*export*"))
    assert not downloads.exists() or not [*downloads.iterdir()]


def test_the_link_brings_the_design_back(page: Page) -> None:
    page.tab("export")
    page.fill("export", "View", "hero")
    wait_until(lambda: "view" in page.text("#as-command"))
    link = page.text("#share-link")
    permission = {"permissions": ["clipboardReadWrite", "clipboardSanitizedWrite"]}
    page.driver.execute_cdp_cmd("Browser.grantPermissions", permission)
    page.click("export", "Copy: Link to this design (packs stay here)")
    copied = "navigator.clipboard.readText().then(arguments[0])"
    assert wait_until(lambda: page.driver.execute_async_script(copied) == link)
    sketch, settings = read_link(link.partition("?d=")[2])
    assert (sketch, settings) == (DESIGN, Settings(view="hero"))
    # The address follows, so a reload loses nothing.
    wait_until(lambda: page.driver.current_url == link)
    page.driver.refresh()
    again = Page(page.driver, page.studio, "?d=" + link.partition("?d=")[2])
    assert again.text("#as-command") == (
        'drapery render "red creeper:lime border:black" -o lime-ghost.png --view hero'
    )
    said = again.run("return document.querySelector('.face .unseen').textContent")
    assert said == "Banner: Red; Creeper, Lime; Border, Black"


def test_a_bad_link_is_reported_and_the_page_continues(chromium: Any, studio: Studio) -> None:
    page = Page(chromium, studio, "?d=a<script>alert(1)</script>")
    assert "has characters that no link has" in page.notice("link")
    assert page.text("#as-command") == "drapery render white -o banner.png"


def sheet(page: Page) -> str:
    """The picture of a pattern in the grid."""
    return str(
        page.run("return document.querySelector('[data-pattern=creeper] canvas').toDataURL()")
    )


def drop(page: Page, panel: str, *paths: Path) -> None:
    page.find(f"#panel-{panel} .file-field input").send_keys("\n".join(map(str, paths)))


def test_packs_change_the_patterns(page: Page, tmp_path: Path) -> None:
    page.tab("packs")
    before, lay = sheet(page), sent(page)
    pack = zip_pack(tmp_path / "blue <b>&.zip", {META: mcmeta(), CREEPER: plain(0, 0, 255, 255)})
    drop(page, "packs", pack)
    page.notice("blue <b>&.zip: Patterns: 1")
    assert wait_until(lambda: sheet(page) != before)
    changed = sheet(page)
    page.run("document.querySelector('.pack input').click()")
    assert wait_until(lambda: sheet(page) == before)
    page.run("document.querySelector('.pack input').click()")
    assert wait_until(lambda: sheet(page) == changed)
    wait_until(lambda: '--pack "blue <b>&.zip"' in page.text("#as-command"))
    assert str(page.studio.folder) not in page.text("#as-command")
    page.fill("packs", "Compare with", "own")
    drawn = "return [...document.querySelectorAll('.versus canvas')].map((e) => e.toDataURL())"
    assert wait_until(lambda: len(set(page.run(drawn))) == 4)
    page.click("packs", "Remove: blue <b>&.zip")
    assert wait_until(lambda: sheet(page) == before)
    assert wait_until(lambda: sent(page) <= lay)


def test_a_pack_may_be_dropped_anywhere(page: Page, tmp_path: Path) -> None:
    pack = zip_pack(tmp_path / "x.zip", {META: mcmeta(), CREEPER: plain(0, 0, 255, 255)})
    drop_file(page.driver, "thrown.zip", pack.read_bytes())
    page.notice("thrown.zip: Patterns: 1")
    assert page.find(".pack-name").text.startswith("thrown.zip")


def test_keys_reorder_packs_and_keep_the_focus(page: Page, tmp_path: Path) -> None:
    page.tab("packs")
    blue = zip_pack(tmp_path / "blue.zip", {META: mcmeta(), CREEPER: plain(0, 0, 255, 255)})
    red = zip_pack(tmp_path / "red.zip", {META: mcmeta(), CREEPER: plain(255, 0, 0, 255)})
    drop(page, "packs", blue, red)

    def names() -> list[str]:
        every = "return [...document.querySelectorAll(arguments[0])].map((e) => e.innerText)"
        return list(page.run(every, ".pack-name > :first-child"))[:2]

    wait_until(lambda: names() == ["red.zip", "blue.zip"])
    page.run("document.querySelector('[aria-label=\"Lower: red.zip\"]').focus()")
    page.driver.switch_to.active_element.send_keys(" ")
    wait_until(lambda: names() == ["blue.zip", "red.zip"])
    focused = "return document.activeElement.getAttribute('aria-label')"
    wait_until(lambda: page.run(focused) == "Lower: red.zip")


def sent(page: Page) -> set[Path]:
    """The packs that lie with the server, those that it keeps of closed tabs too."""
    return lying(page.studio.folder, "drapery-studio-*/pack-*")


def test_two_tabs_have_their_own_packs(page: Page) -> None:
    first, before = page.token, sent(page)
    assert fetch(page.studio, "POST", f"/upload/{first}/pack?name=a", b"x")[0] == 200
    mine = sent(page) - before
    page.driver.switch_to.new_window("tab")
    try:
        other = Page(page.driver, page.studio)
        assert other.token != first
        assert fetch(page.studio, "POST", f"/upload/{other.token}/pack?name=a", b"x")[0] == 200
        others = sent(page) - before - mine
        assert len(mine) == len(others) == 1
    finally:
        page.driver.close()
        page.driver.switch_to.window(page.driver.window_handles[0])
    # A tab that is closed takes its files along.
    wait_until(lambda: not (others & sent(page)))
    assert mine <= sent(page)


def test_a_broken_pack_is_one_line(page: Page, tmp_path: Path) -> None:
    page.tab("packs")
    before, lay = sheet(page), sent(page)
    broken = tmp_path / "broken.zip"
    broken.write_bytes(b"PK\x03\x04 not whole")
    odd = zip_pack(tmp_path / "odd.zip", {META: mcmeta(), CREEPER: b"no picture"})
    drop(page, "packs", broken, odd)
    assert "neither a folder nor a complete zip" in page.notice("broken.zip")
    assert "is not a PNG file" in page.notice("odd.zip")
    assert notices(page.driver) == notices(page.driver, "alert")
    assert sheet(page) == before
    assert wait_until(lambda: sent(page) <= lay)


def titles(page: Page) -> list[str]:
    return list(
        page.run("return [...document.querySelectorAll('.design-title')].map((e) => e.innerText)")
    )


def search(page: Page, words: str) -> None:
    field = page.find("#panel-library input[type=search]")
    page.run("arguments[0].value = ''", field)
    field.send_keys(words or " ")


def test_the_library_keeps_finds_and_opens(page: Page, downloads: Path, tmp_path: Path) -> None:
    page.tab("library")
    page.fill("library", "Tags", "Team, green")
    page.click("library", "Save")
    page.notice("Saved Lime Ghost")
    page.fill("library", "Title", "Second")
    page.click("library", "Save as a new design")
    page.notice("Saved Second")
    wait_until(lambda: titles(page) == ["Second", "Lime Ghost"])
    search(page, "ghost creeper")
    wait_until(lambda: titles(page) == ["Lime Ghost"])
    search(page, "")
    wait_until(lambda: len(titles(page)) == 2)
    page.fill("library", "Title", "Third")
    page.fill("library", "Tags", "blue")
    page.click("library", "Save changes")
    wait_until(lambda: titles(page) == ["Third", "Lime Ghost"])
    page.fill("library", "Tag\n", "blue")
    wait_until(lambda: titles(page) == ["Third"])
    page.fill("library", "Tag\n", "")
    page.click("library", "Keep the old one too")
    wait_until(lambda: titles(page) == ["Second", "Third", "Lime Ghost"])
    page.fill("library", "Tag\n", "blue")
    wait_until(lambda: titles(page) == ["Third"])
    page.click("library", "Delete Third")
    wait_until(lambda: titles(page) == ["Second", "Lime Ghost"])
    focused = "return document.activeElement.innerText"
    wait_until(lambda: page.run(focused) == "Put it back")
    other = Page(page.driver, page.studio)
    other.tab("library")
    wait_until(lambda: titles(other) == ["Second", "Lime Ghost"])
    other.click("library", "Open Lime Ghost")
    other.notice("Opened Lime Ghost")
    assert "red creeper:lime border:black" in wait_until(
        lambda: "creeper" in other.text("#as-command") and other.text("#as-command")
    )
    other.click("library", "Rename or tag Second")
    other.fill("", "Title", "Zweite")
    other.click("library", "Save title and tags")
    wait_until(lambda: titles(other) == ["Zweite", "Lime Ghost"])
    other.click("library", "Delete Zweite")
    wait_until(lambda: titles(other) == ["Lime Ghost"])
    other.click("library", "Put it back")
    wait_until(lambda: titles(other) == ["Zweite", "Lime Ghost"])
    status, dumped = fetch(page.studio, "GET", f"/library/{other.token}")
    assert status == 200 and len(json.loads(dumped)["designs"]) == 2
    (tmp_path / "again.json").write_bytes(dumped)
    drop(other, "library", tmp_path / "again.json")
    other.notice("Designs added: 0; here already: 2")
    (tmp_path / "broken.json").write_text("{")
    drop(other, "library", tmp_path / "broken.json")
    other.notice("the file is not a library")


def test_no_text_becomes_code(page: Page, tmp_path: Path) -> None:
    evil = '<img src=x onerror="window.hit = 1">{{7 * 191}}\'"'
    link = write_link(replace(DESIGN, title=evil), Settings())
    other = Page(page.driver, page.studio, f"?d={link}")
    other.tab("library")
    other.fill("library", "Tags", evil[:30] + "," + evil[-12:])
    other.click("library", "Save")
    other.notice("Saved <img")
    wait_until(lambda: evil in titles(other))
    other.click("library", f"Rename or tag {evil}")
    other.click("", "Change nothing")
    other.click("library", f"Delete {evil}")
    wait_until(lambda: evil not in titles(other))
    pack = zip_pack(tmp_path / "{{7 * 191}}<img src=x onerror=hit()>.zip", {META: mcmeta()})
    drop(other, "packs", pack)
    other.notice("{{7 * 191}}<img src=x onerror=hit()>.zip")
    other.fill("packs", "Compare with", "1")
    wait_until(lambda: other.run("return document.querySelectorAll('.versus canvas').length"))
    assert "1337" not in other.run("return document.body.innerText")
    assert other.run("return window.hit ?? null") is None


def fetch(
    studio: Studio, method: str, path: str, body: Any = None, headers: dict[str, str] | None = None
) -> tuple[int, bytes]:
    """One request, whose path is sent as it is written."""
    connection = http.client.HTTPConnection(urlsplit(studio.address).netloc, timeout=10)
    try:
        connection.putrequest(method, path, skip_accept_encoding=True)
        for name, value in (headers or {}).items():
            connection.putheader(name, value)
        if body is not None and "Content-Length" not in (headers or {}):
            connection.putheader("Content-Length", str(len(body)))
        connection.endheaders(body)
        answer = connection.getresponse()
        return answer.status, answer.read()
    finally:
        connection.close()


def test_an_address_reads_only_its_own_files(page: Page) -> None:
    token, secret = page.token, page.studio.folder / "secret.txt"
    secret.write_text("secret words")
    up = (
        "..",
        "%2e%2e",
        "..%2f..",
        "....//",
        "%252e%252e",
        "..\\..",
        "/etc/passwd",
        "%00",
        "a" * 5000,
    )
    for step in up:
        for path in (
            f"/export/{token}/{step}",
            f"/export/{token}/{step}/secret.txt",
            f"/export/{step}/1",
            f"/library/{token}/{step}/secret.txt",
            f"/library/{step}",
            f"/faces/{token}/banner.bin?pack={step}",
            f"/faces/{step}/banner.bin?pack=own",
            f"/{step}/secret.txt",
        ):
            status, body = fetch(page.studio, "GET", path.replace(" ", "%20"))
            assert status in (400, 404, 405, 422), path
            assert b"secret words" not in body and b"root:" not in body
    for path in ("/export/x/1", "/library/x", "/faces/x/banner.bin"):
        assert fetch(page.studio, "GET", path)[0] == 404
    for number in ("0", "1", "-1", "99999999999999999999", "1e3"):
        assert fetch(page.studio, "GET", f"/export/{token}/{number}")[0] in (404, 422)
    for pack in ("0", "-1", "99", "²", "../own", str(secret)):
        assert fetch(
            page.studio,
            "GET",
            f"/faces/{token}/banner.bin?pack={quote(pack)}",
        )[0] in (404, 422)


def test_no_upload_writes_elsewhere(page: Page) -> None:
    token, folder = page.token, page.studio.folder
    before = {path for path in lying(folder, "**/*") if "drapery-studio-" not in str(path)}
    for name in ("../../evil", "/tmp/evil", "..%2f..%2fevil", "%2e%2e%2fevil", "a%00b"):
        status, body = fetch(page.studio, "POST", f"/upload/{token}/pack?name={name}", b"x")
        assert status == 200, body
    for path in (
        "/upload/wrong/pack",
        f"/upload/{token}/other",
        f"/upload/{token}/../pack",
        f"/upload/{token}/%2e%2e",
    ):
        assert fetch(page.studio, "POST", path + "?name=x", b"x")[0] in (404, 405)
    assert {path for path in lying(folder, "**/*") if "drapery-studio-" not in str(path)} == before
    assert {path.name for path in sent(page)} == {f"pack-{number}" for number in range(1, 6)}


def test_uploads_are_bounded_as_they_come(page: Page) -> None:
    token = page.token
    for length in (str((256 << 20) + 1), "9" * 30):
        headers = {"Content-Length": length}
        status, body = fetch(
            page.studio, "POST", f"/upload/{token}/pack?name=big.zip", b"", headers
        )
        assert status in (400, 413) and (status == 400 or b"big.zip is over 256 MiB" in body)
    # One that does not say how long it is: it ends at the limit, though more would come.
    limit = 64 << 20
    sent = _pour(page.studio, f"/upload/{token}/library?name=big.json", limit)
    assert limit <= sent <= limit + (16 << 20)
    assert not lying(page.studio.folder, "drapery-studio-*/library-*")
    for _ in range(16):
        assert fetch(page.studio, "POST", f"/upload/{token}/pack?name=a", b"x")[0] == 200
    status, body = fetch(page.studio, "POST", f"/upload/{token}/pack?name=a", b"x")
    assert status == 413 and b"16 files of this kind are here already" in body


def test_an_upload_can_be_stopped(page: Page, tmp_path: Path) -> None:
    big, slow = tmp_path / "big.zip", {"offline": False, "latency": 0, "downloadThroughput": -1}
    big.write_bytes(bytes(8 << 20))
    network = "Network.emulateNetworkConditions"
    page.tab("packs")
    before = sent(page)
    page.driver.execute_cdp_cmd("Network.enable", {})
    page.driver.execute_cdp_cmd(network, {**slow, "uploadThroughput": 65536})
    try:
        page.find("#panel-packs input[type=file]").send_keys(str(big))
        stop = "const found = document.querySelector('#panel-packs .file-field button'); "
        wait_until(lambda: page.run(stop + "found?.click(); return !!found"))
        page.notice("big.zip was not sent")
    finally:
        page.driver.execute_cdp_cmd(network, {**slow, "uploadThroughput": -1})
    wait_until(lambda: page.find("#panel-packs input[type=file]").is_enabled())
    wait_until(lambda: sent(page) <= before)


def _pour(studio: Studio, path: str, limit: int) -> int:
    """Send a body in chunks until the other end hangs up: how many bytes went."""
    address = urlsplit(studio.address)
    sent, piece = 0, b"0" * (1 << 20)
    with socket.create_connection((address.hostname, address.port), 10) as wire:
        head = (
            f"POST {path} HTTP/1.1\r\nHost: {address.netloc}\r\nTransfer-Encoding: chunked\r\n\r\n"
        )
        wire.sendall(head.encode())
        try:
            while sent < 2 * limit:
                wire.sendall(b"%x\r\n%s\r\n" % (len(piece), piece))
                sent += len(piece)
        except OSError:
            pass
    return sent


def test_other_pages_may_not_send(page: Page) -> None:
    path = f"/upload/{page.token}/pack?name=x"
    for headers in ({"Origin": "http://evil.example"}, {"Origin": "null"}):
        assert fetch(page.studio, "POST", path, b"x", headers)[0] == 403
