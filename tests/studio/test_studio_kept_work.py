"""A page that is loaded again goes on from the work of the page before it."""

import asyncio
from collections.abc import AsyncIterator
from pathlib import Path

import pytest
from pack_maker import CREEPER, META, mcmeta, plain, zip_pack

from drapery.banner.design import Banner
from drapery.errors import DesignError
from drapery.garments import Garment
from drapery.studio import kept_work
from drapery.studio.app import prune_regularly
from drapery.studio.kept_work import KeptWork
from drapery.studio.session import Session, Sessions
from drapery.studio.sketch import sketch_of


async def _chunks(data: bytes) -> AsyncIterator[bytes]:
    yield data


def send_pack(session: Session, path: Path) -> None:
    chunks = _chunks(path.read_bytes())
    upload = asyncio.run(session.uploads.receive(chunks, "pack", path.name))
    session.pack_store.adopt(upload.number, session.pack_store.check(upload.number))


@pytest.fixture
def pack(tmp_path: Path) -> Path:
    return zip_pack(tmp_path / "blue.zip", {META: mcmeta(), CREEPER: plain(0, 0, 255, 255)})


@pytest.mark.parametrize("is_gone", [False, True])
def test_designs_packs_and_the_librarys_entry_are_there_again(pack: Path, is_gone: bool) -> None:
    sessions = Sessions()
    first = sessions.open()
    first.lay_out(sketch_of(Banner.parse("white creeper:lime")))
    first.entries[first.sketch.origin] = 7
    send_pack(first, pack)
    if is_gone:
        sessions.keep(first)
    second = sessions.open(sketch=first.sketch)
    second.resume(sessions.work(first.token))
    assert [entry.title for entry in second.pack_store.entries] == ["blue.zip"]
    assert second.packs().level("creeper") == 1
    assert second.entries[second.sketch.origin] == 7
    if not is_gone:
        here, there = second.settings.pack_paths[0], first.settings.pack_paths[0]
        assert here.samefile(there), "a large pack is not copied while all pages wait"
    first.close()
    assert second.settings.pack_paths[0].exists()
    folder = Path(second.settings.pack_paths[0]).parent
    sessions.close_all()
    assert not folder.exists()


SHAWL = 'piece = [{ name = "shawl", size = [8, 8], points = [3, 3], place = [0, 9, 0] }]'


@pytest.mark.parametrize("is_gone", [False, True])
def test_a_garment_that_was_sent_is_worn_again(is_gone: bool) -> None:
    sessions = Sessions()
    first = sessions.open()
    chunks = _chunks(SHAWL.encode())
    number = asyncio.run(first.uploads.receive(chunks, "garment", "My Shawl.toml")).number
    path = first.garment_store.adopt(number, "garment")
    first.viewport.update(garment=path)
    step = first.motion  # as the page keeps it
    stranger = sessions.open()
    with pytest.raises(DesignError, match="the file is not here any more; send it again"):
        stranger.move(step)
    if is_gone:
        sessions.keep(first)
    second = sessions.open()
    second.resume(sessions.work(first.token))
    first.close()
    second.move(step)
    worn = second.viewport.request.garment
    assert worn != path and Path(worn).parents[1] == second.folder
    assert Garment.load(Path(worn)).piece[0].name == "shawl"
    assert second.garment_store.titles("garment") == {worn: "My Shawl.toml"}
    sessions.close_all()


def test_a_closed_tab_makes_no_new_folder() -> None:
    """A file that is read in a thread may be finished after its tab; nothing would remove it."""
    sessions = Sessions()
    session = sessions.open()
    session.lay_out(sketch_of(Banner.parse("white creeper:lime")))
    sessions.keep(session)
    with pytest.raises(DesignError, match="the page is gone"):
        print(session.folder)


def test_nothing_is_kept_of_a_page_without_work() -> None:
    sessions = Sessions()
    session = sessions.open()
    sessions.keep(session)
    assert session.closed
    assert sessions.work(session.token) is None


def test_work_is_kept_for_a_time_and_up_to_a_number(monkeypatch: pytest.MonkeyPatch) -> None:
    now = 0.0
    kept = KeptWork(clock=lambda: now)
    session = Session()
    kept.add("first", session.work, None)
    now = kept_work.KEEP - 1
    assert kept.find("first") is not None
    now = kept_work.KEEP + 1
    assert kept.find("first") is None
    monkeypatch.setattr(kept_work, "MAX_KEPT", 2)
    for name in "abc":
        kept.add(name, session.work, None)
    assert kept.find("a") is None
    assert len(kept) == 2
    session.close()


def test_work_is_kept_up_to_a_size(pack: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(kept_work, "MAX_BYTES", pack.stat().st_size)
    kept, tokens = KeptWork(), []
    for _ in range(2):
        session = Session()
        send_pack(session, pack)
        kept.add(session.token, session.work, session.take_folder())
        tokens.append(session.token)
        session.close()
    assert [kept.find(token) is not None for token in tokens] == [False, True]
    kept.clear()


def test_a_pack_that_is_gone_is_one_line(tmp_path: Path) -> None:
    session = Session()
    with pytest.raises(DesignError, match=r"blue\.zip: the file is not here any more"):
        session.uploads.adopt(tmp_path / "none", "pack", "blue.zip")
    session.close()


def test_old_work_goes_although_no_page_comes(
    pack: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(kept_work, "KEEP", 0.5)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    sessions = Sessions()
    session = sessions.open()
    send_pack(session, pack)
    sessions.keep(session)
    assert list(tmp_path.glob("drapery-studio-*/*"))

    async def until_it_is_gone() -> None:
        pruning = asyncio.create_task(prune_regularly(sessions, 0.05))
        while list(tmp_path.glob("drapery-studio-*")):
            await asyncio.sleep(0.05)
        pruning.cancel()

    asyncio.run(asyncio.wait_for(until_it_is_gone(), 30))
