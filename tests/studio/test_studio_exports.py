"""Exports have the bytes of the command line; an export that is stopped leaves no file."""

import re
import shlex
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from drapery.banner.design import Banner, Layer
from drapery.errors import DraperyError, OptionError
from drapery.file_formats import KIND_NAMES, format_of
from drapery.settings import LoopSettings, Settings
from drapery.studio import exports
from drapery.studio.chosen_scene import scene_choice, what_follows
from drapery.studio.exports import Export, ExportSlots, count_frames, make, stem_of
from drapery.studio.session import Session
from drapery.studio.snippets import (
    KINDS,
    LOOPS,
    MODELS,
    STILLS,
    ExportRequest,
    as_command,
    as_python,
    file_name,
)

BANNER = Banner("red", (Layer("creeper", "lime"), Layer("gradient", "blue")))
PICTURE = Settings(size=(40, 48), wind=5.0, samples=4, pixel=2, background="#302050", view="hero")
WORDS = (
    *("--size", "40x48", "--wind", "5", "--samples", "4", "--pixel", "2"),
    *("--background", "#302050", "--view", "hero"),
)
TIMES = ("--seconds", "0.5", "--fps", "10")
TEXT = "red creeper:lime gradient:blue"

COMMANDS = {
    **dict.fromkeys(STILLS, ("render", TEXT, *WORDS)),
    "face": ("flat", TEXT, "--scale", "5"),
    **dict.fromkeys(LOOPS, ("animate", TEXT, *TIMES, *WORDS)),
    **dict.fromkeys(MODELS, ("model", TEXT, *WORDS[:4], "--view", "hero")),
    "glb": ("model", TEXT, *TIMES, *WORDS[:4], "--view", "hero"),
}


def request_of(kind: str) -> ExportRequest:
    return ExportRequest(BANNER, PICTURE, kind, LoopSettings(0.5, 10.0), scale=5)


@pytest.mark.parametrize("kind", COMMANDS)
def test_the_bytes_are_those_of_the_command(kind: str, tmp_path: Path, drapery) -> None:
    wanted = request_of(kind)
    for name in ("page", "line"):
        (tmp_path / name).mkdir()
    make(wanted, tmp_path / "page" / file_name(wanted))
    code, _, err = drapery(*COMMANDS[kind], "-o", tmp_path / "line" / file_name(wanted))
    assert code == 0, err
    page, line = ((tmp_path / name / file_name(wanted)).read_bytes() for name in ("page", "line"))
    assert page == line


@pytest.mark.parametrize("kind", KINDS)
def test_a_turntable_is_of_animations(kind: str) -> None:
    wanted = ExportRequest(BANNER, Settings(turntable=True), kind, garment="cape")
    is_loop = kind in LOOPS
    assert ("--turntable" in as_command(wanted)) == is_loop
    assert ("turntable=True" in as_python(wanted)) == is_loop


def test_the_design_is_what_show_writes(tmp_path: Path, drapery) -> None:
    make(request_of("json"), tmp_path / "banner.json")
    assert (tmp_path / "banner.json").read_text() == drapery("show", TEXT, "--as", "json")[1]


def test_a_scene_is_exported_with_the_design_and_the_wind(
    tmp_path: Path, drapery, monkeypatch: pytest.MonkeyPatch
) -> None:
    scene = scene_choice("vanilla", BANNER, PICTURE)
    assert dict(scene.words) == {"design": TEXT, "wind": "5"}
    wanted = ExportRequest(BANNER, PICTURE, "gif", LoopSettings(0.25, 8.0), scene=scene)
    make(wanted, tmp_path / "page.gif")
    monkeypatch.chdir(tmp_path)
    code, _, err = drapery(*shlex.split(as_command(wanted, stem="line"))[1:])
    assert code == 0, err
    assert (tmp_path / "page.gif").read_bytes() == (tmp_path / "line.gif").read_bytes()
    exec(as_python(wanted, stem="python"), {})
    assert (tmp_path / "page.gif").read_bytes() == (tmp_path / "python.gif").read_bytes()


def test_a_page_says_what_a_scene_takes_from_it() -> None:
    assert what_follows("flag") == "This scene shows your banner, in your wind."
    assert "a cloth of its own" in what_follows("sail")


def test_every_kind_is_tested() -> None:
    assert {*COMMANDS, "json", "html"} == set(KINDS)


def test_every_kind_can_be_downloaded() -> None:
    names = [file_name(ExportRequest(BANNER, PICTURE, kind)) for kind in KINDS]
    assert all(format_of(name, *KIND_NAMES).media_type for name in names)


def test_a_page_is_that_of_the_command(tmp_path: Path, drapery, playable) -> None:
    settings = playable(size=(64, 96), wind=5.0, rotation=3)
    wanted = ExportRequest(BANNER, settings, "html", garment="flag")
    make(wanted, tmp_path / "page.html")
    command = as_command(wanted, stem="line")
    line, python = tmp_path / "line.html", tmp_path / "python.html"
    code, _, err = drapery(*shlex.split(command.replace("line.html", str(line)))[1:])
    assert code == 0, err
    exec(as_python(wanted, stem="python").replace("python.html", str(python)), {})
    text = (tmp_path / "page.html").read_bytes()
    assert text == line.read_bytes() == python.read_bytes()


@pytest.mark.parametrize("kind", [*COMMANDS, "json"])
def test_progress_goes_to_the_end(kind: str, tmp_path: Path) -> None:
    wanted, events = request_of(kind), []
    make(wanted, tmp_path / file_name(wanted), lambda done, total: events.append((done, total)))
    total = count_frames(wanted)
    assert events[-1] == (total, total)
    assert [done for done, _ in events] == sorted(done for done, _ in events)


def stop_after(frames: int) -> Callable[[int, int], None]:
    def progress(done: int, total: int) -> None:
        if done >= frames:
            raise exports.StoppedError("stopped")

    return progress


@pytest.mark.parametrize("kind", ["png", "face", "gif", "apng", "webp", "mp4", "glb"])
def test_what_is_stopped_leaves_nothing(kind: str, tmp_path: Path) -> None:
    wanted = request_of(kind)
    target = tmp_path / file_name(wanted)
    with pytest.raises(exports.StoppedError):
        make(wanted, target, stop_after(1))
    assert [*tmp_path.iterdir()] == []
    target.write_text("older")
    with pytest.raises(exports.StoppedError):
        make(wanted, target, stop_after(0))
    assert target.read_text() == "older" and len([*tmp_path.iterdir()]) == 1


def export(wanted: ExportRequest, folder: Path) -> Export:
    return Export(wanted, folder / file_name(wanted), file_name(wanted))


def test_a_thread_makes_it_and_reports_progress(tmp_path: Path) -> None:
    work = export(request_of("gif"), tmp_path)
    work.start()
    assert work.wait(120)
    assert (work.state, work.done, work.total, work.fault) == ("done", 5, 5, "")
    assert (work.moved, work.share) == (1.0, 1.0)
    assert work.path.read_bytes()[:6] == b"GIF89a"


def test_a_thread_stops_and_leaves_nothing(tmp_path: Path) -> None:
    settings = Settings(size=(128, 128), grid=(4, 7))  # its motion is short, its frames many
    work = export(ExportRequest(BANNER, settings, "apng", LoopSettings(10.0)), tmp_path)
    work.start()
    start = time.monotonic()
    while work.done < 2 and time.monotonic() < start + 120:
        time.sleep(0.005)
    work.stop()
    assert work.wait(120)
    assert work.state == "stopped" and 2 <= work.done < work.total
    assert [*tmp_path.iterdir()] == []
    assert not [thread for thread in threading.enumerate() if thread.name == "export"]


@pytest.mark.parametrize("kind", ["apng", "glb"])
def test_the_motion_of_a_loop_is_told_and_can_be_stopped(kind: str, tmp_path: Path) -> None:
    """It takes longer than the frames of a small picture, and comes before the first of them."""
    wanted, moments, frames = request_of(kind), [], []

    def told(number: int, last: int) -> None:
        moments.append(number / last)

    def progress(done: int, total: int) -> None:
        frames.append(done)
        assert done == 0 or moments[-1] == 1.0

    make(wanted, tmp_path / file_name(wanted), progress, told)
    assert moments == sorted(moments) and moments[0] == 0.0 and len(moments) > max(frames) > 0

    def stop(number: int, last: int) -> None:
        if number > last // 2:
            raise exports.StoppedError("stopped")

    (tmp_path / file_name(wanted)).unlink()
    with pytest.raises(exports.StoppedError):
        make(wanted, tmp_path / file_name(wanted), None, stop)
    assert [*tmp_path.iterdir()] == []


def test_a_fault_is_one_line(tmp_path: Path) -> None:
    work = export(ExportRequest(BANNER, Settings(packs=(tmp_path / "none.zip",))), tmp_path)
    work.start()
    assert work.wait(120)
    assert work.state == "failed" and "does not exist" in work.fault
    assert [*tmp_path.iterdir()] == []


def test_an_unforeseen_error_ends_it_with_a_line_and_a_traceback_in_the_log(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    work = Export(7, tmp_path / "x.png", "x.png")  # not a request: no typed caller does this
    work.start()
    assert work.wait(120)
    assert work.state == "failed" and re.search(r"\(\w+Error\); see the studio's log", work.fault)
    assert "\n" not in work.fault and "Traceback" in caplog.text
    assert [*tmp_path.iterdir()] == []


@pytest.mark.parametrize(
    "wanted",
    [
        ExportRequest(BANNER, PICTURE, "exe"),
        ExportRequest(BANNER, PICTURE, "../../x"),
        ExportRequest(BANNER, Settings(size=(8192, 8192)), "gif", LoopSettings(60.0)),
        ExportRequest(BANNER, Settings(), "face", scale=9999),
        ExportRequest(None, Settings(), "json"),
    ],
)
def test_requests_out_of_bounds_are_refused(wanted: ExportRequest, tmp_path: Path) -> None:
    with pytest.raises((OptionError, DraperyError)) as fault:
        make(wanted, tmp_path / "x.png")
    assert "\n" not in str(fault.value)
    assert [*tmp_path.iterdir()] == []


@pytest.fixture
def session() -> Iterator[Session]:
    opened = Session()
    yield opened
    opened.close()


LONG = ExportRequest(BANNER, Settings(size=(128, 128)), "apng", LoopSettings(60.0))


def test_a_second_export_takes_the_place_of_the_first(session: Session) -> None:
    own = session.exports
    first = own.start(LONG)
    second = own.start(request_of("json"), "flag")
    assert first.wait(120) and second.wait(120)
    assert (first.state, second.state, second.name) == ("stopped", "done", "flag.json")
    assert own.finished(2) is second and own.finished(1) is None
    assert [path.name for path in session.folder.iterdir()] == ["export-2.json"]
    own.start(request_of("face")).wait(120)
    assert [path.name for path in session.folder.iterdir()] == ["export-3.png"]


def test_a_tab_that_closes_stops_its_export() -> None:
    session = Session()
    work, folder = session.exports.start(LONG), session.folder
    session.close()
    assert work.wait(120) and not folder.exists()


def test_the_tabs_of_a_studio_share_its_slots() -> None:
    slots = ExportSlots()
    session = Session(slots=slots)
    others = [Session(slots=slots) for _ in range(exports.MAX_RUNNING)]
    work = [other.exports.start(LONG) for other in others]
    with pytest.raises(OptionError, match="under way"):
        session.exports.start(request_of("json"))
    # A tab that has one may replace it.
    work.append(others[0].exports.start(LONG))
    for other in others:
        other.close()
    assert all(each.wait(120) for each in work)
    assert session.exports.start(request_of("json")).wait(120)
    session.close()


@pytest.mark.parametrize("kind", ["exe", "../x", "png/../../x", ""])
def test_no_order_names_a_file(session: Session, kind: str) -> None:
    with pytest.raises(OptionError):
        session.exports.start(ExportRequest(BANNER, PICTURE, kind))
    assert session.exports.current is None


@pytest.mark.parametrize(
    ("title", "stem"),
    [
        ("Lime Ghost!", "lime-ghost"),
        ("../../etc/passwd", "etc-passwd"),
        ("Żółw 2", "żółw-2"),
        ("", "banner"),
        ("...", "banner"),
        ("\r\nSet-Cookie: x", "set-cookie-x"),
        ("x" * 80, "x" * 60),
    ],
)
def test_files_are_named_by_the_title(title: str, stem: str) -> None:
    assert stem_of(title) == stem
