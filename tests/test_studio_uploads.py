"""Files that are sent are measured as they come, lie under names of ours, and go with the tab."""

import asyncio
import zipfile
from collections.abc import AsyncIterator, Iterator
from pathlib import Path

import numpy as np
import pytest
from pack_maker import BANNER, CREEPER, META, mcmeta, noise, plain, png, red, zip_pack

from drapery.errors import DesignError, DraperyError, PackError
from drapery.settings import Settings
from drapery.studio import uploads as module
from drapery.studio.pack_store import PackStore, shelf_of
from drapery.studio.session import Session
from drapery.studio.uploads import Purpose, Upload, Uploads, shown_name, uploads_of


@pytest.fixture
def session() -> Iterator[Session]:
    opened = Session()
    yield opened
    opened.close()


async def pieces(data: bytes, size: int = 1 << 16) -> AsyncIterator[bytes]:
    for start in range(0, len(data), size):
        yield data[start : start + size]


def send(session: Session, data: bytes, name: str = "a.zip", purpose: str = "pack") -> Upload:
    return asyncio.run(uploads_of(session).receive(pieces(data), purpose, name))


def packed(tmp_path: Path, *reds: int) -> bytes:
    files = {META: mcmeta(), CREEPER: plain(reds[0], 0, 0, 255)}
    return zip_pack(tmp_path / "made.zip", files).read_bytes()


def test_what_comes_lies_in_the_sessions_folder(session: Session) -> None:
    kept = send(session, b"x" * 100_000, "My Pack.zip")
    assert kept.path.read_bytes() == b"x" * 100_000 and kept.size == 100_000
    assert kept.path.parent == session.folder and kept.name == "My Pack.zip"
    assert uploads_of(session).get(kept.number, "pack") is kept
    session.close()
    assert not kept.path.parent.exists()


@pytest.mark.parametrize(
    "name",
    ["../../etc/passwd", "/etc/passwd", "C:\\x\\..\\passwd", "..", ".", "", "a\0b/\n", "x" * 5000],
)
def test_no_name_becomes_a_path(session: Session, name: str) -> None:
    kept = send(session, b"x", name)
    assert kept.path.parent == session.folder and kept.path.name == f"pack-{kept.number}"
    assert kept.name.isprintable() and "/" not in kept.name and 0 < len(kept.name) <= 80
    assert [*session.folder.iterdir()] == [kept.path]


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
        asyncio.run(uploads_of(session).receive(endless(), "pack", "big.zip"))
    assert taken == 17 and [*session.folder.iterdir()] == []


def test_too_many_are_refused_also_at_once(
    session: Session, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(module.PURPOSES, "pack", Purpose(1 << 20, 3))

    async def slow() -> AsyncIterator[bytes]:
        await asyncio.sleep(0.01)
        yield b"x"

    async def five() -> list[object]:
        own = uploads_of(session)
        return await asyncio.gather(
            *(own.receive(slow(), "pack", "a") for _ in range(5)), return_exceptions=True
        )

    results = asyncio.run(five())
    assert [isinstance(each, Upload) for each in results] == [True] * 3 + [False] * 2
    uploads_of(session).remove(1)
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

    own = uploads_of(session)
    with pytest.raises(ConnectionError):
        asyncio.run(own.receive(torn(), "pack", "a"))
    with pytest.raises(DesignError, match="is empty"):
        send(session, b"")
    assert [*session.folder.iterdir()] == [] and own._coming == {} and own._kept == {}


def test_a_tab_that_goes_meanwhile(session: Session) -> None:
    async def closing() -> AsyncIterator[bytes]:
        yield b"x"
        session.close()
        yield b"y"

    folder = session.folder
    with pytest.raises(DesignError, match="the page is gone"):
        asyncio.run(uploads_of(session).receive(closing(), "pack", "a"))
    assert not folder.exists()


@pytest.mark.parametrize("number", [0, -1, 99, "1", None, [1], 1.0, "../x"])
def test_only_numbers_of_ours_are_known(session: Session, number: object) -> None:
    kept = send(session, b"x")
    assert kept.number == 1
    with pytest.raises(DesignError):
        uploads_of(session).get(number, "pack")
    with pytest.raises(DesignError):
        uploads_of(session).get(1, "library")


def shelf_with(session: Session, *packs: bytes) -> PackStore:
    shelf = shelf_of(session)
    for number, pack in enumerate(packs):
        kept = send(session, pack, f"{number}.zip")
        shelf.adopt(kept.number, shelf.check(kept.number))
    return shelf


def test_a_pack_counts_when_it_is_adopted(session: Session, tmp_path: Path) -> None:
    told = []
    session.listen("packs", lambda: told.append(1))
    shelf = shelf_with(session, packed(tmp_path, 7), packed(tmp_path, 9))
    assert [entry.summary for entry in shelf.entries] == ["1 pattern"] * 2
    assert red(session.packs()) == 9 and len(told) == 2
    shelf.move(shelf.entries[1].number, -1)
    assert red(session.packs()) == 7
    shelf.switch(shelf.entries[1].number)
    assert red(session.packs()) == 9
    assert len(session.settings.packs) == 1
    shelf.remove(shelf.entries[0].number)
    assert len(shelf.entries) == 1 and session.settings.packs == ()
    assert len([*session.folder.iterdir()]) == 1


def test_packs_of_the_command_line_are_there(tmp_path: Path) -> None:
    given = zip_pack(tmp_path / "given.zip", {META: mcmeta(), CREEPER: plain(5, 0, 0, 255)})
    session = Session(Settings(packs=(given,)))
    shelf = shelf_with(session, packed(tmp_path, 7))
    assert [entry.name for entry in shelf.entries] == [str(given), "0.zip"]
    assert shelf.called[str(shelf.entries[1].path)] == "0.zip"
    shelf.remove(shelf.entries[0].number)
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
    odd = zip_pack(tmp_path / "o.zip", {META: mcmeta(), CREEPER: png(noise(1)[:7, :9])})
    out = zip_pack(tmp_path / "e.zip", {"../../x": b"", META: mcmeta()}).read_bytes()
    cases = {
        "junk": b"no zip",
        "short": whole[: len(whole) // 2],
        "foreign": zip_pack(tmp_path / "f.zip", {"readme.txt": b"x"}).read_bytes(),
        "texture": inside,
        "odd": odd.read_bytes(),
        "leads out": out,
        "bomb": bomb(tmp_path / "bomb.zip"),
        "meta": zip_pack(
            tmp_path / "m.zip", {META: b"{", CREEPER: plain(1, 1, 1, 255)}
        ).read_bytes(),
    }
    shelf = shelf_of(session)
    for name, data in cases.items():
        kept = send(session, data, f"{name}.zip")
        with pytest.raises(PackError) as fault:
            shelf.check(kept.number)
        line = str(fault.value)
        assert f"{name}.zip" in line and "\n" not in line and str(session.folder) not in line
        shelf.refuse(kept.number)
    assert shelf.entries == () and [*session.folder.iterdir()] == []


def test_a_pack_that_is_gone_changes_nothing(session: Session, tmp_path: Path) -> None:
    shelf = shelf_with(session, packed(tmp_path, 7))
    kept = send(session, packed(tmp_path, 9), "late.zip")
    kept.path.unlink()
    with pytest.raises(PackError, match=r"late\.zip"):
        shelf.adopt(kept.number)
    assert len(shelf.entries) == 1 and red(session.packs()) == 7
    for act in (shelf.remove, shelf.switch, shelf.path_of):
        with pytest.raises(DraperyError, match="not here any more"):
            act(99)


def test_sessions_do_not_see_each_others_files(session: Session) -> None:
    other = Session()
    send(session, b"x")
    with pytest.raises(DesignError):
        uploads_of(other).get(1, "pack")
    assert isinstance(uploads_of(other), Uploads)
    other.close()
