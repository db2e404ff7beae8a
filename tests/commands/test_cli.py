"""The command line does the job, and bad input ends in one clear line and exit code 2."""

import io
import os
import signal
import subprocess
import sys
import time
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import GIVE, Run
from PIL import Image

from drapery import Banner, DraperyError, __version__, animate, draw
from drapery.banner.packs import open_packs
from drapery.banner.sprites import SHIELD_REGIONS, composite, shield_layers
from drapery.commands import notices
from drapery.errors import DesignError, OptionError
from drapery.settings import Settings


def test_render_writes_what_draw_draws(drapery: Run, tmp_path: Path) -> None:
    target = tmp_path / "out.png"
    code, _, err = drapery("render", GIVE, "-o", target, "--size", "120x160", "--view", "iso")
    assert (code, [line for line in err.splitlines() if "kernels" not in line]) == (0, [])
    frame = draw(Banner.parse(GIVE), size=(120, 160), view="iso")
    assert np.array_equal(np.asarray(Image.open(target)), frame.pixels)


def test_the_version_is_that_of_the_installed_package(drapery: Run) -> None:
    assert drapery("--version") == (0, f"drapery {__version__}\n", "")


def test_animate_writes_what_animate_draws(drapery: Run, tmp_path: Path) -> None:
    target = tmp_path / "out.apng"
    words = ("--size", "60x80", "--seconds", "0.5", "--fps", "10")
    assert drapery("animate", GIVE, "-o", target, *words)[0] == 0
    drawn = animate(Banner.parse(GIVE), size=(60, 80), seconds=0.5, fps=10)
    with Image.open(target) as image:
        assert image.n_frames == len(drawn) == 5
        for number, frame in enumerate(drawn):
            image.seek(number)
            assert np.array_equal(np.asarray(image.convert("RGBA")), frame.pixels)


def test_a_matte_colours_the_soft_edges_of_a_gif(drapery: Run, tmp_path: Path) -> None:
    words = ("--size", "40x60", "--seconds", "0.2", "--fps", "10", "--samples", "16")
    for name, more in (("plain", ()), ("matte", ("--matte", "#ff0000"))):
        assert drapery("animate", "white", "-o", tmp_path / f"{name}.gif", *words, *more)[0] == 0
    plain, matte = (
        np.asarray(Image.open(tmp_path / f"{name}.gif").convert("RGBA")).astype(int)
        for name in ("plain", "matte")
    )
    redder = (matte[..., 0] - matte[..., 1] > 60) & (matte[..., 3] == 255)
    assert redder.any() and not ((plain[..., 0] - plain[..., 1] > 60) & redder).all()


def test_a_folder_gets_numbered_frames(drapery: Run, tmp_path: Path) -> None:
    words = ("--size", "20x20", "--seconds", "0.3", "--fps", "10")
    assert drapery("animate", "red", "-o", f"{tmp_path}/frames/", *words)[0] == 0
    assert len(list((tmp_path / "frames").glob("*.png"))) == 3


def test_the_same_command_gives_the_same_bytes(drapery: Run, tmp_path: Path) -> None:
    for ending in ("png", "gif", "webp"):
        targets = [tmp_path / f"{i}.{ending}" for i in range(2)]
        for target in targets:
            words = ["render"] if ending == "png" else ["animate", "--seconds", "0.2"]
            assert drapery(*words, GIVE, "-o", target, "--size", "40x40")[0] == 0
        assert targets[0].read_bytes() == targets[1].read_bytes()


def test_flat_is_the_plain_face(drapery: Run, tmp_path: Path) -> None:
    target = tmp_path / "face.png"
    assert drapery("flat", GIVE, "-o", target, "--scale", "3")[0] == 0
    with Image.open(target) as image:
        assert image.size == (60, 120)
        texels = np.asarray(image)
    assert np.array_equal(texels, texels[::3, ::3].repeat(3, axis=0).repeat(3, axis=1))
    assert (texels[..., 3] == 255).all()


@pytest.mark.parametrize("side", ["front", "back"])
@pytest.mark.parametrize("words", [("--kind", "shield"), ()])
def test_flat_is_the_plain_face_of_a_shield(
    drapery: Run, tmp_path: Path, words: tuple[str, ...], side: str
) -> None:
    item = 'shield[base_color="red",banner_patterns=[{pattern:"creeper",color:"lime"}]]'
    design = "red creeper:lime" if words else f"/give @p {item}"
    back = ("--back",) if side == "back" else ()
    target = tmp_path / "face.png"
    assert drapery("flat", design, "-o", target, "--scale", "3", *words, *back)[0] == 0
    sheet = composite(shield_layers(Banner.parse("red creeper:lime"), open_packs()))
    wanted = SHIELD_REGIONS[side].crop(sheet).repeat(3, 0).repeat(3, 1)
    pixels = np.asarray(Image.open(target))
    assert pixels.shape == (66, 36, 4) and np.array_equal(pixels, wanted)


@pytest.mark.parametrize("form", ["json", "give", "give-legacy", "shorthand"])
def test_show_converts_to_a_form_that_reads_back(drapery: Run, form: str) -> None:
    code, out, _ = drapery("show", GIVE, "--as", form)
    assert code == 0
    assert Banner.parse(out.strip()) == Banner.parse(GIVE)


def test_show_names_every_layer(drapery: Run) -> None:
    _, out, _ = drapery("show", GIVE)
    for word in ("white", "lime", "creeper", "Creeper Charge", "black", "Bordure"):
        assert word in out


def test_a_design_is_read_from_a_file_and_from_standard_input(
    drapery: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    design = tmp_path / "banner.txt"
    design.write_text(GIVE)
    from_file = drapery("show", design, "--as", "shorthand")
    monkeypatch.setattr("sys.stdin", io.TextIOWrapper(io.BytesIO(GIVE.encode()), encoding="utf-8"))
    assert from_file == drapery("show", "-", "--as", "shorthand") != (0, "", "")


def bad_packs(folder: Path) -> dict[str, Path]:
    """A missing pack, a file that is none, a truncated zip, and a PNG that unfolds too far."""
    text = folder / "pack.zip"
    text.write_text("not a zip")
    short = folder / "short.zip"
    with zipfile.ZipFile(short, "w") as pack:
        pack.writestr("pack.mcmeta", "{}" * 999)
    short.write_bytes(short.read_bytes()[:100])
    bomb = folder / "bomb"
    sprite = bomb / "assets/minecraft/textures/entity/banner/creeper.png"
    sprite.parent.mkdir(parents=True)
    Image.new("1", (20000, 20000)).save(sprite)
    return {"missing": folder / "none.zip", "text": text, "short": short, "bomb": bomb}


BAD_DESIGNS = {
    "unknown pattern": ("white creper:lime", "creeper"),
    "unknown dye": ("white creeper:lme", "lime"),
    "unclosed command": (GIVE[:-8], ""),
    "17 layers": ("white " + "creeper:lime " * 17, "16"),
    "nothing": ("", ""),
}


@pytest.mark.parametrize("case", BAD_DESIGNS)
def test_a_bad_design_is_one_line(drapery: Run, tmp_path: Path, case: str) -> None:
    design, hint = BAD_DESIGNS[case]
    target = tmp_path / "out.png"
    code, _, err = drapery("render", design, "-o", target)
    assert code == 2
    assert len(err.splitlines()) == 1 and err.startswith("drapery: ")
    assert hint in err
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("case", ["missing", "text", "short", "bomb"])
def test_a_bad_pack_is_one_line_that_names_it(drapery: Run, tmp_path: Path, case: str) -> None:
    pack = bad_packs(tmp_path)[case]
    target = tmp_path / "out.png"
    code, _, err = drapery("render", GIVE, "-o", target, "--pack", pack, "--size", "20x20")
    lines = [line for line in err.splitlines() if "kernels" not in line]
    assert (code, len(lines)) == (2, 1)
    assert pack.name in lines[0]
    assert not target.exists()


BAD_OPTIONS = [
    ("--size", "0x512"),
    ("--size", "100000x100000"),
    ("--size", "big"),
    ("--grid", "1x9"),
    ("--grid", "5000x9"),
    ("--wind", "nan"),
    ("--time", "-1"),
    ("--thickness", "99"),
    ("--background", "#12"),
    ("--pose", "stiff"),
    ("--placement", "floor"),
    ("--view", "below"),
    ("--layers", "three"),
    ("--backend", "crayon"),
    ("--seed", "-4"),
]


@pytest.mark.parametrize("option", BAD_OPTIONS, ids=" ".join)
def test_a_bad_option_is_one_line_that_names_it(
    drapery: Run, tmp_path: Path, option: tuple[str, str]
) -> None:
    code, _, err = drapery("render", GIVE, "-o", tmp_path / "out.png", *option)
    lines = [line for line in err.splitlines() if "kernels" not in line]
    assert (code, len(lines)) == (2, 1)
    assert option[0].strip("-") in lines[0]
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("target", ["no/such/folder/out.png", "out.doc", "."])
def test_a_bad_target_is_one_line(drapery: Run, tmp_path: Path, target: str) -> None:
    code, _, err = drapery("render", GIVE, "-o", tmp_path / target)
    assert (code, len(err.splitlines())) == (2, 1)
    assert not list(tmp_path.iterdir())


def test_unknown_words_are_one_line(drapery: Run) -> None:
    for words in (("paint",), ("render", GIVE), ("render", GIVE, "-o", "x.png", "--colour")):
        code, _, err = drapery(*words)
        assert (code, len(err.splitlines())) == (2, 1)


def test_the_library_raises_what_the_command_line_prints() -> None:
    with pytest.raises(DraperyError, match="size"):
        draw(Banner(), size=(0, 10))


@pytest.mark.parametrize(
    "options",
    [
        {"packs": 5},
        {"size": (64,)},
        {"size": "64"},
        {"grid": (5.5, 9)},
        {"wind": "4"},
        {"seed": 1.5},
        {"rotation": 0.5},
        {"format": 0},
        {"background": None},
    ],
    ids=str,
)
def test_the_library_names_an_option_of_the_wrong_kind(options: dict[str, Any]) -> None:
    with pytest.raises(OptionError, match=next(iter(options))):
        Settings(**options)


def test_what_is_not_a_banner_is_refused_with_a_remedy() -> None:
    with pytest.raises(DesignError, match=r"Banner\.parse"):
        draw("white creeper:lime")  # type: ignore[arg-type]
    with pytest.raises(DesignError, match="Layer"):
        Banner("white", (("creeper", "lime"),))  # type: ignore[arg-type]


def test_a_plain_face_knows_only_formats_that_may_be(drapery: Run, tmp_path: Path) -> None:
    code, _, err = drapery("flat", "white", "-o", tmp_path / "face.png", "--format", "-3")
    assert (code, len(err.splitlines())) == (2, 1) and "format" in err


def test_help_does_not_wait_for_the_kernels() -> None:
    """`drapery --help` must not import numba; it must be fast, since users type it first."""
    code = (
        "import sys; sys.argv = ['drapery', '--help']\n"
        "from drapery.cli import main\n"
        "try: main()\n"
        "except SystemExit: pass\n"
        "assert 'numba' not in sys.modules and 'numpy' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code], check=True, capture_output=True)


def test_doctor_prints_the_whole_remedy(drapery: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    from drapery.render import doctor

    report = [doctor.BackendReport("video", False, "no PyAV", 'pip install "drapery-mc[video]"')]
    monkeypatch.setattr(doctor, "backend_report", lambda: report)
    code, out, _ = drapery("doctor")
    assert code == 0 and 'to mend it: pip install "drapery-mc[video]"' in out


def test_a_variable_that_turns_the_compiler_off_is_named(tmp_path: Path) -> None:
    off = os.environ | {"NUMBA_DISABLE_JIT": "1", "DRAPERY_AOT": "0"}
    run = command("render", "red", "-o", tmp_path / "red.png", "--size", "16x16", env=off)
    assert run.returncode == 2 and run.stderr.count("\n") == 1
    assert "unset NUMBA_DISABLE_JIT" in run.stderr


def test_the_doctor_names_a_variable_that_turns_the_compiler_off(
    drapery: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    from numba import config

    monkeypatch.setattr("drapery.render.doctor.backend_report", lambda: [])
    monkeypatch.setattr(config, "DISABLE_JIT", 1)
    code, out, _ = drapery("doctor")
    assert code == 0 and "to mend it: NUMBA_DISABLE_JIT is set" in out


def command(*words: object, **options: Any) -> "subprocess.CompletedProcess[str]":
    """Drapery in a process of its own."""
    line = [sys.executable, "-m", "drapery", *map(str, words)]
    return subprocess.run(line, capture_output=True, encoding="utf-8", **options)


def test_help_is_shown_in_ascii() -> None:
    ran = command("--help", env=os.environ | {"PYTHONIOENCODING": "ascii", "LC_ALL": "C"})
    assert (ran.returncode, ran.stderr) == (0, "")
    assert r"?design=\u2026" in ran.stdout


def test_a_closed_standard_input_is_one_line(drapery: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.stdin", None)
    code, out, err = drapery("show", "-")
    assert (code, out, len(err.splitlines())) == (2, "", 1)
    assert "standard input" in err


def test_errors_are_one_line_of_bounded_length(capsys: pytest.CaptureFixture[str]) -> None:
    notices.say("a\nb" * 100_000)
    (line,) = capsys.readouterr().err.splitlines()
    assert len(line) < notices.MAX_LINE + 20


def test_an_error_that_cannot_be_printed_keeps_its_exit_code() -> None:
    if not Path("/dev/full").exists():
        pytest.skip("there is no /dev/full")
    with Path("/dev/full").open("w", encoding="utf-8") as full:
        line = [sys.executable, "-m", "drapery", "show", "creper"]
        assert subprocess.run(line, stderr=full).returncode == 2


@pytest.mark.skipif(sys.platform == "win32", reason="Windows ends processes without a signal")
@pytest.mark.parametrize("name, code", [("SIGTERM", 143), ("SIGHUP", 129), ("SIGINT", 130)])
def test_a_stopped_animation_leaves_no_partial_file(tmp_path: Path, name: str, code: int) -> None:
    target = "frames/" if name == "SIGHUP" else "out.gif"
    # Its motion is short, its frames many.
    words = ["animate", "white", "-o", target, "--size", "256x256", "--seconds", "9"]
    words += ["--grid", "4x7"]
    line = [sys.executable, "-m", "drapery", *words]
    run = subprocess.Popen(line, cwd=tmp_path, stderr=subprocess.PIPE, text=True)
    end = time.monotonic() + 120
    while not list(tmp_path.glob(".*.part")):
        assert time.monotonic() < end and run.poll() is None
        time.sleep(0.01)
    run.send_signal(getattr(signal, name))
    assert run.communicate(timeout=60)[1].endswith("drapery: stopped\n")
    assert run.returncode == code
    assert not list(tmp_path.rglob(".*.part"))


def test_signals_do_as_before_after_a_command(drapery: Run) -> None:
    names = [name for name in ("SIGTERM", "SIGHUP") if hasattr(signal, name)]
    before = [signal.getsignal(getattr(signal, name)) for name in names]
    assert drapery("show", "white")[0] == 0
    assert [signal.getsignal(getattr(signal, name)) for name in names] == before


def test_a_system_without_sighup_runs_commands(
    drapery: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delattr(signal, "SIGHUP", raising=False)
    assert drapery("show", "white")[0] == 0
