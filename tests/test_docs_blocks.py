"""The docs tell the truth: their programs run, their commands exist, their pictures are made so."""

import re
import shutil
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from conftest import Run
from docs_blocks import (
    BY_HAND,
    DOCS,
    ROOT,
    SHELL,
    Block,
    Reader,
    blocks,
    check_command,
    commands,
    is_for_one_shell,
    prints,
)
from page_files import write_files
from PIL import Image
from public_api import PACKAGES

from drapery.web.gallery import ITEMS, GalleryItem

TUTORIAL = DOCS / "tutorial.md"
GUIDES = sorted(page for page in DOCS.glob("guides/*.md") if page.stem != "index")
LAYERING = DOCS / "explanation" / "layering.md"
TESTED = ("blazon", "garments")
"""Guides whose programs have tests of their own."""
ALL = sorted([*ROOT.glob("*.md"), *DOCS.glob("**/*.md"), *ROOT.glob("examples/**/*.md")])
PICTURES = {"banner.png": 0, "heart.png": 0, "difference.png": 0.02}
"""Those of the tutorial, and the share of their numbers that may differ: one has labels."""


@pytest.fixture
def reader(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, drapery: Run) -> Reader:
    monkeypatch.chdir(tmp_path)
    return Reader(tmp_path, drapery)


def pixels(path: Path) -> np.ndarray:
    with Image.open(path) as picture:
        return np.asarray(picture.convert("RGBA"))


def test_the_tutorial_runs_as_it_is_typed(
    reader: Reader, request: pytest.FixtureRequest, untraced_processes: None
) -> None:
    for block in blocks(TUTORIAL):
        reader.type(TUTORIAL, block)
    assert (reader.folder / ".github" / "workflows" / "banners.yml").is_file()
    for name, share in PICTURES.items():
        shown = DOCS / "pictures" / "tutorial" / name
        if request.config.getoption("--drapery-update"):
            shutil.copy(reader.folder / name, shown)
        assert np.mean(pixels(reader.folder / name) != pixels(shown)) <= share, name


def test_the_programs_of_the_readme_and_of_the_first_page_run(reader: Reader) -> None:
    for page in (ROOT / "README.md", DOCS / "index.md"):
        for block in blocks(page):
            if block.language:
                reader.type(page, block)


LONG = ("players", "wikis-and-bots", "photos", "match")
"""Pages of many films, icons and photos."""
TYPED = [
    pytest.param(page, id=page.stem, marks=[pytest.mark.slow] if page.stem in LONG else [])
    for page in (*GUIDES, LAYERING)
]


@pytest.mark.parametrize("page", TYPED)
def test_a_page_runs_as_it_is_typed(page: Path, reader: Reader) -> None:
    """Its reader has the pack of the tutorial, and the files that the page names."""
    (make_pack,) = (block for block in blocks(TUTORIAL) if block.title == "make_pack.py")
    reader.type(TUTORIAL, make_pack)
    reader.run("python make_pack.py")
    write_files(reader.folder)
    for block in blocks(page):
        if block.language != "python" or page.stem not in TESTED:
            reader.type(page, block)


def test_each_command_that_is_typed_by_hand_stands_on_a_page() -> None:
    typed = [
        f"{line} "
        for page in ALL
        for block in blocks(page)
        if block.language in SHELL and not block.title
        for line, _ in commands(block.text)
    ]
    assert [each for each in BY_HAND if not any(t.startswith(f"{each} ") for t in typed)] == []


@pytest.mark.slow
def test_the_golden_test_of_the_guide_passes_after_its_update(
    reader: Reader, untraced_processes: None
) -> None:
    (make_pack,) = (block for block in blocks(TUTORIAL) if block.title == "make_pack.py")
    reader.type(TUTORIAL, make_pack)
    reader.run("python make_pack.py")
    page = DOCS / "guides" / "golden-images.md"
    programs = [block.text for block in blocks(page) if block.language == "python"]
    assert "def test_creeper(golden)" in programs[0] and "(golden_numbers)" in programs[1]
    for number, program in enumerate(programs):
        (reader.folder / f"test_{number}.py").write_text(program, "utf-8")
    for options, code in ((" ", 1), (" --drapery-update", 0), (" ", 0)):
        assert reader.run("pytest" + options)[0] == code


def test_programs_of_pages_import_public_packages() -> None:
    programs = [block.text for page in ALL for block in blocks(page) if block.language == "python"]
    imported = re.findall(r"(?m)^ *(?:from|import) (drapery[\w.]*)", "\n".join(programs))
    assert len(imported) > 50 and set(imported) <= set(PACKAGES)


@pytest.mark.parametrize("page", ALL, ids=lambda page: page.relative_to(ROOT).as_posix())
def test_every_command_of_a_page_exists_with_its_options(page: Path) -> None:
    for block in blocks(page):
        if block.language in SHELL and not block.title:
            for line, _ in commands(block.text):
                if line.startswith("drapery "):
                    check_command(line)


def typed_lines(page: Path) -> Iterator[str]:
    """What a page gives to type: the lines of its blocks for a shell, and code in its text."""
    for block in blocks(page):
        if block.language in SHELL and not block.title:
            yield from (line.removeprefix("$ ") for line in block.text.splitlines())
    prose = re.sub(r"(?ms)^ *```.*?^ *```", "", page.read_text("utf-8"))
    yield from (re.sub(r"\s+", " ", code) for code in re.findall(r"(?<!`)`([^`]+)`(?!`)", prose))


@pytest.mark.parametrize(
    "page",
    [*ALL, ROOT / ".github" / "pull_request_template.md"],
    ids=lambda page: page.relative_to(ROOT).as_posix(),
)
def test_a_command_can_be_typed_in_any_shell(page: Path) -> None:
    """A variable has a line for each shell; all else is the same in all."""
    text = page.read_text("utf-8")
    found = [line for line in typed_lines(page) if is_for_one_shell(line)]
    for name in re.findall(r"(?m)(?:^|`)export (\w+)=", text):
        if f'$env:{name} = "' not in text or f"set {name}=" not in text:
            found.append(f"export {name}")
    assert found == []


@pytest.mark.parametrize("item", ITEMS, ids=lambda item: item.name)
def test_a_command_of_the_live_gallery_can_be_typed_in_any_shell(item: GalleryItem) -> None:
    check_command(item.command)
    assert not is_for_one_shell(item.command)


def test_what_one_shell_alone_knows_is_found() -> None:
    wrong = ("pip install . && pytest", "drapery web 'white'", "A=1 pytest", "--left 'white cross'")
    assert all(map(is_for_one_shell, wrong))
    assert not any(map(is_for_one_shell, ("drapery web \"{text:'white'}\"", "don't", "a && b")))


def test_a_block_has_the_note_before_it_and_its_title(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text('<!-- exit 1 -->\n```sh\na\n```\n\n```python title="x.py"\nb\n```\n', "utf-8")
    assert list(blocks(page)) == [
        Block(2, "sh", "", "exit 1", "a\n"),
        Block(6, "python", "x.py", "", "b\n"),
    ]
    assert next(blocks(page)).exit_code == 1


def test_dots_stand_for_what_a_page_leaves_out() -> None:
    assert prints("a\n...\nd\n", "a\nb\nc\nd\n") and prints("...\nd\n", "d\n")
    assert prints("x has 1 texel; ...\n", "x has 1 texel; 25 pixels\n")
    assert not prints("a\nd\n", "a\nb\nd\n")
