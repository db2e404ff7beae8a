"""Tabs that are opened and closed leave nothing behind: no session, thread, file or memory."""

import json
import os
import time
import urllib.error
import urllib.request
from collections.abc import Iterator
from pathlib import Path

import pytest
from studio_browser import Studio, wait_until
from studio_tabs import open_tab

CYCLES = int(os.environ.get("DRAPERY_STUDIO_CYCLES", "6"))


def status(studio: Studio, token: str) -> int:
    try:
        address = f"{studio.address}faces/{token}/banner.bin"
        return urllib.request.urlopen(address, timeout=10).status
    except urllib.error.HTTPError as error:
        return error.code


def threads(studio: Studio) -> int:
    return len(list(Path(f"/proc/{studio.process.pid}/task").iterdir()))


def handles(studio: Studio) -> int:
    return len(list(Path(f"/proc/{studio.process.pid}/fd").iterdir()))


def memory(studio: Studio) -> float:
    """What the process has in memory [MiB]."""
    pages = int(Path(f"/proc/{studio.process.pid}/statm").read_text(encoding="utf-8").split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") / 2**20


def send(studio: Studio, token: str) -> None:
    """Send a file, for which the tab makes its folder."""
    address = f"{studio.address}upload/{token}/design?name=x.txt"
    urllib.request.urlopen(address, b"white creeper:lime", timeout=10)


@pytest.fixture
def own_studio(tmp_path: Path, compiled_kernels: None) -> Iterator[Studio]:
    """A studio without pages of other tests, whose work it keeps for minutes, as it should."""
    studio = Studio(tmp_path)
    yield studio
    studio.stop()


@pytest.mark.skipif(not Path("/proc/self/task").is_dir(), reason="needs Linux's /proc to count")
@pytest.mark.slow
def test_tabs_leave_nothing(own_studio: Studio) -> None:
    studio = own_studio

    def cycle() -> str:
        with open_tab(studio.address) as token:
            assert status(studio, token) == 200
            send(studio, token)
            assert list(studio.folder.glob("drapery-studio-*"))
        return token

    def closed(token: str) -> bool:
        return status(studio, token) == 404

    # Pools of threads grow to their size, and modules are loaded, with the first tabs.
    first = [cycle() for _ in range(10)]
    for token in first:
        wait_until(lambda token=token: closed(token))
    before = threads(studio), handles(studio), memory(studio)
    began = time.monotonic()
    tokens = [cycle() for _ in range(CYCLES)]
    each = (time.monotonic() - began) / CYCLES
    for token in tokens:
        wait_until(lambda token=token: closed(token))
    wait_until(lambda: handles(studio) <= before[1] + 2)
    after = threads(studio), handles(studio), memory(studio)
    print(f"{CYCLES} tabs, {each:.2f} s each; threads, handles, MiB: {before} -> {after}")
    assert after[0] <= before[0] + 16
    assert after[2] < before[2] + 30
    wait_until(lambda: not list(studio.folder.glob("drapery-studio-*")))


def test_a_busy_page_is_not_gone(studio: Studio) -> None:
    """A page that draws for a minute answers no message of its framework, and is not reloaded."""
    address = f"{studio.address}_nicegui_ws/socket.io/?EIO=4&transport=polling"
    opened = json.loads(urllib.request.urlopen(address, timeout=10).read()[1:])
    assert opened["pingTimeout"] >= 60_000


def test_a_stopped_studio_leaves_no_files(tmp_path: Path) -> None:
    studio = Studio(tmp_path)
    with open_tab(studio.address) as token:
        send(studio, token)
        assert list(tmp_path.glob("drapery-studio-*"))
        studio.stop()
    assert not list(tmp_path.glob("drapery-studio-*"))
    assert "Traceback" not in "".join(studio.log)
