"""Two folders of pictures are compared file by file, with one result in text, JSON and HTML."""

import json
import re
from pathlib import Path

import numpy as np
import pytest
from conftest import Run
from PIL import Image

VERDICTS = {
    "added/fresh.jpg": "added",
    "gone.png": "removed",
    "near.png": "within",
    "same.png": "same",
    "size.png": "different",
    "sub/other.png": "different",
}


def write(path: Path, pixels: np.ndarray) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    Image.fromarray(pixels).save(path)


@pytest.fixture
def folders(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    old = np.random.default_rng(1).integers(0, 256, (9, 12, 3), np.uint8)
    near, other = old.copy(), old.copy()
    near[0, 0] ^= 1
    other[2:4, 5:9] ^= 255
    changed = {"near.png": near, "same.png": old, "size.png": old[:5], "sub/other.png": other}
    for name, pixels in changed.items():
        write(Path("old", name), old)
        write(Path("new", name), pixels)
    write(Path("old/gone.png"), old)
    write(Path("new/added/fresh.jpg"), old)
    Path("old/notes.txt").write_text("no picture", encoding="utf-8")
    return tmp_path


COMPARE = ("compare", "old", "new", "--tolerance", "1")
SUMMARY = (
    "1 the same, 1 within the limits, 2 different, 1 removed, 1 added;"
    " files that are no pictures and are left out: 1"
)


def test_text_json_and_html_agree(folders: Path, drapery: Run) -> None:
    code, out, err = drapery(*COMPARE, "-o", "r.json", "-o", "r.html")
    *lines, summary = out.splitlines()
    assert (code, err, summary) == (1, "", SUMMARY)
    facts = json.loads(Path("r.json").read_text(encoding="utf-8"))
    assert {file["name"]: file["verdict"] for file in facts["files"]} == VERDICTS
    assert facts["left_out"] == 1 and facts["counts"]["different"] == 2
    page = Path("r.html").read_text(encoding="utf-8")
    entries = re.findall(r'<h2 class="(\w+)">(.*?)</h2>\n<p>(.*?)</p>', page)
    named = {name: verdict for name, verdict in VERDICTS.items() if verdict != "same"}
    assert [f"{name}: {line}" for _, name, line in entries] == lines
    assert {name: kind for kind, name, _ in entries} == {
        name: "same" if verdict == "within" else "different" for name, verdict in named.items()
    }
    assert page.count('src="data:image/png') == len(named) and "http" not in page
    assert SUMMARY in page and "<td>tolerance 1</td>" in page


def test_a_file_is_measured_as_two_pictures_are(folders: Path, drapery: Run) -> None:
    drapery(*COMPARE, "-o", "r.json")
    (found,) = (
        file
        for file in json.loads(Path("r.json").read_text(encoding="utf-8"))["files"]
        if file["name"] == "sub/other.png"
    )
    pair = ("compare", "old/sub/other.png", "new/sub/other.png", "--tolerance", "1")
    assert drapery(*pair, "-o", "pair.json")[0] == 1
    (alone,) = json.loads(Path("pair.json").read_text(encoding="utf-8"))["pairs"]
    assert {name: found[name] for name in alone} == alone | {
        "a": "old/sub/other.png",
        "b": "new/sub/other.png",
    }
    assert found["box"] == [5, 2, 4, 2]


def test_the_exit_code_counts_what_one_folder_lacks(folders: Path, drapery: Run) -> None:
    assert drapery("compare", "old", "old")[0] == 0
    for name in ("added/fresh.jpg", "size.png", "sub/other.png"):
        Path("new", name).unlink()
        Path("old", name).unlink(missing_ok=True)
    assert drapery(*COMPARE)[0] == 1
    Path("old/gone.png").unlink()
    code, out, _ = drapery(*COMPARE)
    assert code == 0 and "near.png: 1 pixel differs within the limits" in out
    Path("new/extra.PNG").write_bytes(Path("new/same.png").read_bytes())
    assert drapery(*COMPARE)[0] == 1


def test_a_broken_file_ends_itself_alone(folders: Path, drapery: Run) -> None:
    for side in ("old", "new"):
        Path(side, "bad.png").write_text("junk", encoding="utf-8")
    Path("old/only.png").write_text("junk", encoding="utf-8")
    code, out, err = drapery(*COMPARE, "-o", "r.html")
    assert code == 2 and "only.png: removed" in out and "2 different" in out
    assert "1 cannot be compared" in out
    assert err.startswith("bad.png: old/bad.png is not a picture that can be read")
    assert "bad.png is not a picture" in Path("r.html").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("old", "new", "-o", "r.png"), "holds no page or figures; use .html, .htm or .json"),
        (("old", "new", "-o", "r.gif"), "holds no page or figures; use .html, .htm or .json"),
        (("old", "white creeper:lime"), "compare it with one other such folder"),
        (("old", "new", "old"), "compare it with one other such folder"),
        (("old", "new", "--size", "64x64"), "--size does nothing for finished pictures"),
        (("old/same.png", "new/same.png", "--cost"), "--cost does nothing for finished pictures"),
        (("old/same.png", "new/same.png", "--number", "2"), "--number does nothing"),
        (("old/same.png", "new/same.png", "--layers", "flat"), "--layers does nothing"),
        (("old/same.png", "new/same.png", "--style", "cel"), "--style does nothing"),
        (("empty", "empty"), "have no pictures; name two folders that have some"),
    ],
)
def test_what_does_nothing_is_refused(
    folders: Path, drapery: Run, words: tuple[str, ...], message: str
) -> None:
    Path("empty").mkdir()
    code, out, err = drapery("compare", *words)
    assert (code, out, len(err.splitlines())) == (2, "", 1) and message in err
    assert not Path("r.png").exists()


def test_a_link_to_a_folder_is_not_followed(folders: Path, drapery: Run) -> None:
    Path("old/loop").symlink_to("..", target_is_directory=True)
    code, out, _ = drapery(*COMPARE)
    assert code == 1 and out.endswith("left out: 2\n")


def test_a_folder_has_a_largest_number_of_files(
    folders: Path, drapery: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("drapery.comparison.folders.MAX_FILES", 5)
    code, _, err = drapery(*COMPARE)
    assert code == 2 and "old has over 5 files; compare a part of it" in err


def test_a_page_has_a_largest_size(
    folders: Path, drapery: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("drapery.commands.compare_folders.MAX_PAGE", 1)
    assert drapery(*COMPARE, "-o", "r.html")[0] == 1
    page = Path("r.html").read_text(encoding="utf-8")
    assert page.count("data:image/png") == 1 and page.count("<h2") == 5
    assert "pictures after the first" in page
