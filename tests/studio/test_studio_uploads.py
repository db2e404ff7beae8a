"""Files that are sent: measured as they arrive, stored under safe names, removed with the tab."""

import asyncio
import threading
import time
import warnings
import zipfile
from collections.abc import AsyncIterator, Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fastapi import FastAPI
from pack_maker import BANNER, CREEPER, META, mcmeta, plain, png, red, zip_pack

from drapery.banner.design import Banner
from drapery.errors import DesignError, DraperyError, PackError
from drapery.settings import Settings
from drapery.studio import uploads as module
from drapery.studio.kernel_build import KernelBuild
from drapery.studio.pack_store import PackStore
from drapery.studio.routes import add_routes
from drapery.studio.session import Session, Sessions, StudioConfig
from drapery.studio.uploads import Purpose, Upload, shown_name
from drapery.studio.warning_log import collected_warnings


@pytest.fixture
def session() -> Iterator[Session]:
    opened = Session()
    yield opened
    opened.close()


async def pieces(data: bytes, size: int = 1 << 16) -> AsyncIterator[bytes]:
    for start in range(0, len(data), size):
        yield data[start : start + size]


def send(session: Session, data: bytes, name: str = "a.zip", purpose: str = "pack") -> Upload:
    return asyncio.run(session.uploads.receive(pieces(data), purpose, name))


def packed(tmp_path: Path, *reds: int) -> bytes:
    files = {META: mcmeta(), CREEPER: plain(reds[0], 0, 0, 255)}
    return zip_pack(tmp_path / "made.zip", files).read_bytes()


def test_a_file_whose_sender_leaves_is_refused_in_one_line_and_leaves_nothing() -> None:
    """An upload that was stopped ended in a traceback of the server."""
    app, sessions = FastAPI(), Sessions(StudioConfig())
    add_routes(app, sessions, KernelBuild(sessions))
    session = sessions.open()
    parts = [{"type": "http.request", "body": b"x" * 100, "more_body": True}]
    sent: list[dict[str, Any]] = []

    async def receive() -> dict[str, Any]:
        return parts.pop(0) if parts else {"type": "http.disconnect"}

    async def send(message: Any) -> None:
        sent.append(message)

    path = f"/upload/{session.token}/pack"
    scope = {"type": "http", "method": "POST", "path": path, "query_string": b"name=a.zip"}
    asyncio.run(app({**scope, "headers": []}, receive, send))
    assert sent[0]["status"] == 400 and b"not sent whole; send it again" in sent[1]["body"]
    assert [*session.folder.iterdir()] == []
    sessions.close_all()


def test_what_comes_lies_in_the_sessions_folder(session: Session) -> None:
    upload = send(session, b"x" * 100_000, "My Pack.zip")
    assert upload.path.read_bytes() == b"x" * 100_000 and upload.size == 100_000
    assert upload.path.parent == session.folder and upload.name == "My Pack.zip"
    assert session.uploads.get(upload.number, "pack") is upload
    session.close()
    assert not upload.path.parent.exists()


@pytest.mark.parametrize(
    "name",
    ["../../etc/passwd", "/etc/passwd", "C:\\x\\..\\passwd", "..", ".", "", "a\0b/\n", "x" * 5000],
)
def test_no_name_becomes_a_path(session: Session, name: str) -> None:
    upload = send(session, b"x", name)
    assert upload.path.parent == session.folder and upload.path.name == f"pack-{upload.number}"
    assert upload.name.isprintable() and "/" not in upload.name and 0 < len(upload.name) <= 80
    assert [*session.folder.iterdir()] == [upload.path]


def test_names_are_shown_short() -> None:
    assert shown_name("C:\\packs\\Żółw 1.zip") == "Żółw 1.zip"
    assert shown_name("..") == shown_name("a/") == "the file"


def test_too_long_stops_while_it_comes(session: Session, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(module.PURPOSES, "pack", Purpose(1 << 20, 3))
    taken = 0

    async def endless() -> AsyncIterator[bytes]:
        nonlocal taken
        while True:
            taken += 1
            yield b"\0" * (1 << 16)

    with pytest.raises(DesignError, match=r"^big\.zip is over 1 MiB"):
        asyncio.run(session.uploads.receive(endless(), "pack", "big.zip"))
    assert taken == 17 and [*session.folder.iterdir()] == []


def test_a_library_that_is_sent_has_a_largest_size(session: Session) -> None:
    data = bytes(module.MAX_LIBRARY + 1)
    with pytest.raises(DesignError, match=r"^all\.json is over 64 MiB; send a smaller one$"):
        send(session, data, "all.json", "library")


def test_too_many_are_refused_also_at_once(
    session: Session, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(module.PURPOSES, "pack", Purpose(1 << 20, 3))

    async def slow() -> AsyncIterator[bytes]:
        await asyncio.sleep(0.01)
        yield b"x"

    async def five() -> list[object]:
        own = session.uploads
        return await asyncio.gather(
            *(own.receive(slow(), "pack", "a") for _ in range(5)), return_exceptions=True
        )

    results = asyncio.run(five())
    assert [isinstance(each, Upload) for each in results] == [True] * 3 + [False] * 2
    session.uploads.remove(1)
    send(session, b"x")
    assert len([*session.folder.iterdir()]) == 3


def test_all_together_have_a_limit(session: Session, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "MAX_SESSION", 1000)
    send(session, b"x" * 600)
    with pytest.raises(DesignError, match="together"):
        send(session, b"x" * 600)
    assert len([*session.folder.iterdir()]) == 1


def test_what_breaks_off_leaves_nothing(session: Session) -> None:
    async def torn() -> AsyncIterator[bytes]:
        yield b"x" * 1000
        raise ConnectionError

    own = session.uploads
    with pytest.raises(ConnectionError):
        asyncio.run(own.receive(torn(), "pack", "a"))
    with pytest.raises(DesignError, match="is empty"):
        send(session, b"")
    assert [*session.folder.iterdir()] == []
    for _ in range(module.PURPOSES["pack"].max_count):
        send(session, b"x")


def test_a_tab_that_goes_meanwhile(session: Session) -> None:
    async def closing() -> AsyncIterator[bytes]:
        yield b"x"
        session.close()
        yield b"y"

    folder = session.folder
    with pytest.raises(DesignError, match="the page is gone"):
        asyncio.run(session.uploads.receive(closing(), "pack", "a"))
    assert not folder.exists()


@pytest.mark.parametrize("number", [0, -1, 99, "1", None, [1], 1.0, "../x"])
def test_only_numbers_of_ours_are_known(session: Session, number: object) -> None:
    upload = send(session, b"x")
    assert upload.number == 1
    with pytest.raises(DesignError):
        session.uploads.get(number, "pack")
    with pytest.raises(DesignError):
        session.uploads.get(1, "library")


def store_with(session: Session, *packs: bytes) -> PackStore:
    pack_store = session.pack_store
    for number, pack in enumerate(packs):
        upload = send(session, pack, f"{number}.zip")
        pack_store.adopt(upload.number, pack_store.check(upload.number))
    return pack_store


def test_a_pack_counts_when_it_is_adopted(session: Session, tmp_path: Path) -> None:
    events = []
    session.listen(lambda: events.append(1), "packs")
    pack_store = store_with(session, packed(tmp_path, 7), packed(tmp_path, 9))
    assert [entry.contents.summary for entry in pack_store.entries] == ["Patterns: 1"] * 2
    assert red(session.packs()) == 9 and len(events) == 2
    pack_store.move(pack_store.entries[1].number, -1)
    assert red(session.packs()) == 7
    pack_store.switch(pack_store.entries[1].number)
    assert red(session.packs()) == 9
    assert len(session.settings.packs) == 1
    pack_store.remove(pack_store.entries[0].number)
    assert len(pack_store.entries) == 1 and session.settings.packs == ()
    assert len([*session.folder.iterdir()]) == 1


def test_packs_of_the_command_line_are_there(tmp_path: Path) -> None:
    given = zip_pack(tmp_path / "given.zip", {META: mcmeta(), CREEPER: plain(5, 0, 0, 255)})
    session = Session(Settings(packs=(given,)))
    pack_store = store_with(session, packed(tmp_path, 7))
    assert [entry.name for entry in pack_store.entries] == [str(given), "0.zip"]
    assert pack_store.names[str(pack_store.entries[1].path)] == "0.zip"
    pack_store.remove(pack_store.entries[0].number)
    assert given.exists() and red(session.packs()) == 7
    session.close()


def bomb(path: Path) -> bytes:
    huge = {META: mcmeta(), CREEPER: png(np.zeros((8192, 2048, 4), np.uint8))}
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name, data in huge.items():
            archive.writestr(name, data)
        archive.writestr(BANNER + "base.png", b"\0" * (64 << 20))
    return path.read_bytes()


def test_broken_packs_are_refused_by_their_own_name(session: Session, tmp_path: Path) -> None:
    whole = packed(tmp_path, 7)
    inside = zip_pack(tmp_path / "b.zip", {META: mcmeta(), CREEPER: b"no png"}).read_bytes()
    out = zip_pack(tmp_path / "e.zip", {"../../x": b"", META: mcmeta()}).read_bytes()
    cases = {
        "junk": b"no zip",
        "short": whole[: len(whole) // 2],
        "foreign": zip_pack(tmp_path / "f.zip", {"readme.txt": b"x"}).read_bytes(),
        "texture": inside,
        "leads out": out,
        "bomb": bomb(tmp_path / "bomb.zip"),
        "meta": zip_pack(
            tmp_path / "m.zip", {META: b"{", CREEPER: plain(1, 1, 1, 255)}
        ).read_bytes(),
    }
    pack_store = session.pack_store
    for name, data in cases.items():
        upload = send(session, data, f"{name}.zip")
        with pytest.raises(PackError) as fault:
            pack_store.check(upload.number)
        line = str(fault.value)
        assert f"{name}.zip" in line and "\n" not in line and str(session.folder) not in line
        pack_store.refuse(upload.number)
    assert pack_store.entries == () and [*session.folder.iterdir()] == []


def test_a_pack_that_is_gone_changes_nothing(session: Session, tmp_path: Path) -> None:
    pack_store = store_with(session, packed(tmp_path, 7))
    upload = send(session, packed(tmp_path, 9), "late.zip")
    upload.path.unlink()
    with pytest.raises(PackError, match=r"late\.zip"):
        pack_store.adopt(upload.number)
    assert len(pack_store.entries) == 1 and red(session.packs()) == 7
    for act in (pack_store.remove, pack_store.switch, pack_store.path_of):
        with pytest.raises(DraperyError, match="not here any more"):
            act(99)


def test_sessions_do_not_see_each_others_files(session: Session) -> None:
    other = Session()
    send(session, b"x")
    with pytest.raises(DesignError):
        other.uploads.get(1, "pack")
    other.close()


def parts(text: str) -> AsyncIterator[bytes]:
    """A body in two parts, between which other requests have their turn."""

    async def body() -> AsyncIterator[bytes]:
        half = len(text) // 2
        yield text[:half].encode()
        await asyncio.sleep(0.02)
        yield text[half:].encode()

    return body()


async def read(session: Session, name: str, text: str) -> None:
    """What the page does with a file of designs."""
    upload = await session.uploads.receive(parts(text), "design", name)
    await session.upload_queue.read_file(upload.number)


def test_two_designs_that_arrive_at_once_do_not_mix(session: Session) -> None:
    queue, noted = session.upload_queue, []

    def note() -> None:
        noted.append((queue.name, queue.line, [each.banner for each in queue.found]))

    session.listen(note, "read")
    texts = {"a.txt": "red creeper:lime border:black", "b.txt": "blue skull:white"}

    async def both() -> None:
        await asyncio.gather(*(read(session, *each) for each in texts.items()))

    asyncio.run(both())
    wanted = [(name, "", [Banner.parse(text)]) for name, text in texts.items()]
    assert sorted(noted) == sorted(wanted)
    assert [*session.folder.iterdir()] == []


def test_a_design_that_is_too_long_is_one_line(
    session: Session, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(module.PURPOSES, "design", Purpose(10, 3))
    with pytest.raises(DesignError, match=r"^big\.txt is over 10 bytes; [a-z ]+$"):
        asyncio.run(read(session, "../x/big.txt", "white creeper:lime"))
    assert session.upload_queue.found == () and [*session.folder.iterdir()] == []


def test_each_thread_collects_its_own_warnings() -> None:
    """`warnings.catch_warnings` takes those of all threads, or loses them."""
    start = threading.Barrier(4)

    def collect(name: str) -> list[str]:
        start.wait()
        with collected_warnings() as notes:
            for number in range(200):
                warnings.warn(f"{name} {number % 3}", stacklevel=1)
                time.sleep(0)
        return notes

    with ThreadPoolExecutor(4) as pool:
        found = [*pool.map(collect, "abcd")]
    assert found == [[f"{name} {number % 3}" for number in range(200)] for name in "abcd"]


def test_broken_lines_are_notes_each_time(session: Session) -> None:
    good = "/give @p minecraft:white_banner"
    for _ in range(2):
        session.upload_queue.read_text(f"{good}\n/give @p minecraft:red_banner{{{{\n")
        assert len(session.upload_queue.notes) == 1 and "line 2" in session.upload_queue.notes[0]


def test_threads_that_ask_for_packs_while_they_change_get_one_or_the_other(
    session: Session, tmp_path: Path
) -> None:
    store = store_with(session, packed(tmp_path, 7), packed(tmp_path, 9))
    top, faults, seen = store.entries[1].number, [], set()
    done = threading.Event()

    def draw() -> None:
        while not done.is_set():
            try:
                seen.add(red(session.packs()))
            except Exception as error:
                faults.append(error)

    threads = [threading.Thread(target=draw) for _ in range(3)]
    for thread in threads:
        thread.start()
    for _ in range(40):
        store.switch(top)
    done.set()
    for thread in threads:
        thread.join()
    assert faults == [] and seen <= {7, 9}
