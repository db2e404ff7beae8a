"""What is copied as a command or as Python makes the very file that the page makes."""

import ast
import inspect
import os
import shlex
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import given, strategies as st
from pack_maker import CREEPER, META, mcmeta, plain, zip_pack
from tracing import untraced_environment

from drapery.banner.design import Banner, Layer
from drapery.banner.formats import parse_banner
from drapery.banner.formats.shorthand import write
from drapery.commands import animate, flat, model, render, web
from drapery.errors import quoted
from drapery.garments import find_garment
from drapery.settings import LOOP_OPTIONS, LoopSettings, Settings, applicable
from drapery.studio import snippets
from drapery.studio.exports import make
from drapery.studio.snippets import ExportRequest, as_command, as_python

BANNER = Banner("white", (Layer("creeper", "lime"), Layer("border", "black")))
SMALL = Settings(size=(48, 64), view="iso", background="#204080", wind=6.5, shadow=True)

SMALL_FLAG = find_garment("flag").settings(size=(48, 64), time=0.1, view="front")


def run_shell(command: str, folder: Path) -> None:
    environment = untraced_environment() | {
        "PATH": f"{Path(sys.executable).parent}:{os.environ['PATH']}"
    }
    subprocess.run(
        ["/bin/sh", "-c", command], cwd=folder, env=environment, check=True, capture_output=True
    )


def run_python(lines: str, folder: Path) -> None:
    command = [sys.executable, "-c", lines]
    environment = untraced_environment()
    subprocess.run(command, cwd=folder, env=environment, check=True, capture_output=True)


@pytest.fixture
def pack(tmp_path: Path) -> Path:
    return zip_pack(tmp_path / "it's a pack.zip", {META: mcmeta(), CREEPER: plain(0, 0, 255, 255)})


ORDERS = {
    "png": ExportRequest(BANNER, SMALL),
    "shield": ExportRequest(
        Banner("red", (Layer("flow", "blue"),), "shield"), Settings(size=(32, 32))
    ),
    "face": ExportRequest(BANNER, SMALL, "face", scale=3),
    "gif": ExportRequest(BANNER, SMALL, "gif", LoopSettings(0.5, 8.0)),
    "glb": ExportRequest(BANNER, SMALL, "glb", LoopSettings(0.5, 8.0)),
    "json": ExportRequest(BANNER, SMALL, "json"),
    "garment": ExportRequest(BANNER, SMALL_FLAG, garment="flag"),
    "own": ExportRequest(
        BANNER, Settings(size=(24, 24)), "glb", LoopSettings(0.2, 10.0), garment="pennants"
    ),
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """All of ORDERS as the shell makes them, and in one process as Python does."""
    folder = tmp_path_factory.mktemp("made")
    for way in ("shell", "python"):
        (folder / way).mkdir()
    run_shell(" && ".join(as_command(o, stem=name) for name, o in ORDERS.items()), folder / "shell")
    run_python("\n".join(as_python(o, stem=name) for name, o in ORDERS.items()), folder / "python")
    return folder


@pytest.mark.parametrize("name", ORDERS)
def test_both_make_what_the_page_makes(name: str, folder: Path) -> None:
    file = snippets.file_name(ORDERS[name], name)
    make(ORDERS[name], folder / file)
    wanted = (folder / file).read_bytes()
    assert (folder / "shell" / file).read_bytes() == wanted, as_command(ORDERS[name])
    assert (folder / "python" / file).read_bytes() == wanted, as_python(ORDERS[name])


def test_a_pack_is_called_as_its_owner_calls_it(pack: Path, tmp_path: Path) -> None:
    hidden = tmp_path / "upload-1"
    pack.rename(hidden)
    wanted = ExportRequest(BANNER, Settings(packs=(hidden,), size=(32, 32)))
    called = {str(hidden): pack.name}
    command, lines = as_command(wanted, called), as_python(wanted, called)
    assert str(hidden) not in command + lines
    with pytest.warns(UserWarning, match="our own art"):
        make(wanted, tmp_path / "banner.png")
    folder = tmp_path / "elsewhere"
    folder.mkdir()
    hidden.rename(folder / pack.name)
    for run, code in ((run_shell, command), (run_python, lines)):
        run(code, folder)
        assert (folder / "banner.png").read_bytes() == (tmp_path / "banner.png").read_bytes()
        (folder / "banner.png").unlink()


@pytest.mark.parametrize(
    ("word", "written"),
    [
        ("müller.png", "müller.png"),
        ("mu\u0308ller.png", "mu\u0308ller.png"),
        ("旗.png", "旗.png"),
        ("it's a flag.png", '"it\'s a flag.png"'),
        ("0,0,4", '"0,0,4"'),
        ("a\u2019b", "'a\u2019b'"),
        ("$HOME", "'$HOME'"),
        ("", "''"),
    ],
)
def test_a_word_is_quoted_only_where_a_shell_needs_it(word: str, written: str) -> None:
    """In those of the docs: sh, cmd and PowerShell, for which a comma parts a bare word."""
    assert quoted(word) == written


@given(st.text(st.characters(exclude_characters="\0")))
def test_a_shell_reads_the_word_that_was_quoted(word: str) -> None:
    assert shlex.split(quoted(word)) == [word]


def test_only_what_is_off_its_default_is_said() -> None:
    assert as_command(ExportRequest(BANNER, Settings())) == (
        'drapery render "white creeper:lime border:black" -o banner.png'
    )
    assert as_command(ExportRequest(Banner("red"), Settings(pbr=True, size=(64, 64)), "apng")) == (
        "drapery animate red -o banner.apng --size 64x64 --pbr"
    )
    assert as_python(ExportRequest(Banner("red"), Settings(view="iso"))) == (
        "from drapery import Banner, draw\n\n"
        'banner = Banner.parse("red")\ndraw(banner, view="iso").save("banner.png")\n'
    )


def test_a_garment_shows_the_design_where_its_file_has_one(tmp_path: Path) -> None:
    flag = as_command(ExportRequest(Banner("red"), find_garment("flag").settings(), garment="flag"))
    assert flag == "drapery garment flag --design red -o banner.png"
    shawl = tmp_path / "shawl.toml"
    shawl.write_text('piece = [{ name = "shawl", size = [8, 8], points = [3, 3] }]')
    own = as_command(ExportRequest(None, find_garment(shawl).settings(), garment=str(shawl)))
    assert own == "drapery garment shawl.toml -o banner.png"
    calm = find_garment("poncho").settings(wind=0)
    lines = as_python(ExportRequest(Banner("red"), calm, garment="poncho"))
    assert 'banner = find_garment("poncho")\ndraw(banner, wind=0.0).save("banner.png")\n' in lines


@pytest.mark.parametrize(
    ("names", "command"),
    [
        (applicable(output="still"), render),
        (applicable(output="loop"), animate),
        (applicable(output="model"), model),
        (applicable(output="face"), flat),
        (applicable(output="page"), web),
    ],
)
def test_the_commands_have_these_options_and_no_others(names, command) -> None:
    other = {"ctx", "out", "design", "form", "number", *LOOP_OPTIONS, "matte", "scale", "back"}
    other |= {"component", "context", "designer", "gallery", "quality", "origin", "to"}
    if command is flat:
        other.add("kind")  # the design of a shield is one by itself
    taken = set(inspect.signature(command.run).parameters) - other
    assert taken == set(names)


paths = st.text(st.characters(exclude_categories=["Cs"], exclude_characters="\0"), min_size=1)


@given(paths)
def test_no_name_of_a_pack_breaks_out(name: str) -> None:
    wanted = ExportRequest(BANNER, Settings(packs=(name,)))
    assert shlex.split(as_command(wanted))[-2:] == ["--pack", name]
    calls = [node for node in ast.walk(ast.parse(as_python(wanted))) if isinstance(node, ast.Call)]
    given_packs = [word.value for call in calls for word in call.keywords if word.arg == "packs"]
    assert [ast.literal_eval(packs) for packs in given_packs] == [[name]]


@given(st.sampled_from(("white", "red")), st.sampled_from(("acme:x.json", "creeper", "a:b/c")))
def test_a_design_reads_back(base: str, pattern: str) -> None:
    banner = Banner(base, (Layer(pattern, "lime"),))
    command = as_command(ExportRequest(banner, Settings()))
    assert parse_banner(shlex.split(command)[2]) == banner
    assert write(banner) in command
