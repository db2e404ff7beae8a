"""Files of cases: they can say all that a command can, and their faults name the case."""

from pathlib import Path

import pytest
from conftest import Run
from PIL import Image, PngImagePlugin

from drapery.testing.golden import LAYERS_KEY

CASES = """
[defaults]
size = "32x40"
time = 0.5

[[case]]
name = "cape"
kind = "cape"
texture = "cape.png"

[[case]]
name = "turned"
design = "white creeper:lime"
rotation = 4
"""
ONE_CASE = '[[case]]\nname = "one"\ndesign = "white creeper:lime"\nsize = "32x40"\n'


def file_of(folder: Path, text: str) -> Path:
    path = folder / "cases.toml"
    path.write_text(text)
    return path


def test_capes_and_rotations_are_stored_and_found_again(drapery: Run, tmp_path: Path) -> None:
    Image.new("RGBA", (64, 32), "red").save(tmp_path / "cape.png")
    file = file_of(tmp_path, CASES)
    assert drapery("golden", "update", file)[0] == 0
    assert sorted(path.stem for path in (tmp_path / "goldens").iterdir()) == ["cape", "turned"]
    assert drapery("golden", "check", file, "--report", tmp_path / "report")[0] == 0


def test_a_bad_option_names_its_case(drapery: Run, tmp_path: Path) -> None:
    file = file_of(tmp_path, ONE_CASE + "wind = 999\n")
    code, _, err = drapery("golden", "check", file, "--report", tmp_path / "report")
    assert code == 2 and "case 'one': wind 999" in err.splitlines()[-1]


def test_a_design_that_is_no_text_is_named_with_its_case(drapery: Run, tmp_path: Path) -> None:
    file = file_of(tmp_path, '[[case]]\nname = "one"\ndesign = []\n')
    code, _, err = drapery("golden", "check", file)
    assert (code, err.count("\n")) == (2, 1)
    assert "case 'one': design [] is not a text; put it in quotes" in err


def test_an_unknown_option_is_reported_with_the_nearest_name(drapery: Run, tmp_path: Path) -> None:
    file = file_of(tmp_path, ONE_CASE + "wnid = 9\nhashed = true\n")
    code, _, err = drapery("golden", "check", file)
    assert (code, err.count("\n")) == (2, 1)
    assert "case 'one': 'wnid' is not an option; did you mean wind?" in err


def test_a_length_that_no_loop_has_is_a_fault_of_the_file(drapery: Run, tmp_path: Path) -> None:
    file = file_of(tmp_path, ONE_CASE + "seconds = 1000\nfps = 8\n")
    code, _, err = drapery("golden", "check", file)
    assert (code, err.count("\n")) == (2, 1)
    assert "case 'one': seconds 1000 is out of range; use 0.125 to 450 s at 8 frames/s" in err


@pytest.mark.parametrize("command", ["update", "check"])
def test_a_folder_that_is_a_file_is_one_line(drapery: Run, tmp_path: Path, command: str) -> None:
    (tmp_path / "taken").write_text("")
    file = file_of(tmp_path, 'goldens = "taken"\n' + ONE_CASE)
    report = ("--report", tmp_path / "taken") if command == "check" else ()
    code, _, err = drapery("golden", command, file, *report)
    lines = [line for line in err.splitlines() if "kernels" not in line]
    assert (code, len(lines)) == (2, 1) and "taken" in lines[0]


@pytest.mark.parametrize("command", ["update", "check"])
@pytest.mark.parametrize("goldens", ["{}/elsewhere", "../elsewhere", "a/../../elsewhere", "link"])
def test_goldens_lie_in_the_folder_of_their_file(
    drapery: Run, tmp_path: Path, command: str, goldens: str
) -> None:
    elsewhere, own = tmp_path / "elsewhere", tmp_path / "own"
    elsewhere.mkdir()
    own.mkdir()
    (own / "link").symlink_to(elsewhere, target_is_directory=True)
    named = goldens.format(tmp_path.as_posix())
    code, _, err = drapery("golden", command, file_of(own, f'goldens = "{named}"\n' + ONE_CASE))
    assert (code, err.count("\n")) == (2, 1)
    assert "is not in the folder of the file; name one there" in err
    assert not list(elsewhere.iterdir())


@pytest.mark.parametrize("note", ["{broken", '[{"x": 1}]', "[" * 9999, "7"])
def test_a_golden_whose_note_was_harmed_is_compared_without_it(
    drapery: Run, tmp_path: Path, note: str
) -> None:
    file = file_of(tmp_path, ONE_CASE)
    (tmp_path / "goldens").mkdir()
    kept = PngImagePlugin.PngInfo()
    kept.add_text(LAYERS_KEY, note, zip=True)
    Image.new("RGBA", (32, 40)).save(tmp_path / "goldens/one.png", pnginfo=kept)
    code, out, _ = drapery("golden", "check", file, "--report", tmp_path / "report")
    assert code == 1 and "pixels differ" in out


def test_a_default_is_left_out_of_a_case_in_which_it_does_nothing(
    drapery: Run, tmp_path: Path
) -> None:
    text = """[defaults]\nsize = "8x8"\ntime = 0\nturntable = true\nwind = 9
[[case]]\nname = "still"\ndesign = "red"
[[case]]\nname = "loop"\ndesign = "red"\nseconds = 0.2\nfps = 10
[[case]]\nname = "item"\ndesign = "red"\nplacement = "item"
"""
    file = file_of(tmp_path, text)
    assert drapery("golden", "update", file)[0] == 0
    file.write_text(text + "wind = 4\n")
    code, _, said = drapery("golden", "update", file)
    assert code == 2 and "case 'item': wind does nothing for placement item" in said


def test_a_yaml_file_of_cases_is_bounded(drapery: Run, tmp_path: Path) -> None:
    """400 bytes of aliases, each nine times the one before, once took 4.6 GB."""
    lines = ["a0: &a0 lol"]
    for number in range(1, 10):
        lines.append(f"a{number}: &a{number} [{', '.join([f'*a{number - 1}'] * 9)}]")
    file = tmp_path / "cases.yaml"
    file.write_text("\n".join([*lines, "case: [{name: one, design: *a9}]"]))
    code, _, err = drapery("golden", "check", file)
    assert (code, err.count("\n")) == (2, 1) and len(err) < 500
    assert f"{file}, line 7" in err and "aliases repeat more than 100000 values" in err


def test_a_long_name_does_not_fill_the_message(drapery: Run, tmp_path: Path) -> None:
    file = file_of(tmp_path, f'[[case]]\nname = "{"x" * 100_000}"\nwnid = 3\n')
    code, _, err = drapery("golden", "check", file)
    assert code == 2 and len(err) < 600


TWO = """
[[case]]
name = "first"
design = "red"
packs = ["no-such-pack"]

[[case]]
name = "second"
design = "blue"
size = "32x40"
time = 0.5
"""


def test_a_case_that_cannot_be_drawn_ends_itself_alone(drapery: Run, tmp_path: Path) -> None:
    file, report = file_of(tmp_path, TWO), ("--report", tmp_path / "report")
    code, out, err = drapery("golden", "update", file)
    assert code == 2 and "wrote second" in out and "no-such-pack" in err
    code, out, err = drapery("golden", "check", file, *report)
    assert code == 2 and out.startswith("1 as before, 0 not, 1 cannot be checked")
    assert err.splitlines()[-1].startswith("first: ")
    (tmp_path / "goldens/second.png").unlink()
    code, out, _ = drapery("golden", "check", file, *report)
    assert code == 2 and "second: no golden at" in out and "0 as before, 1 not" in out
    assert (tmp_path / "report/index.html").exists()


def test_one_case_is_checked_by_its_name(drapery: Run, tmp_path: Path) -> None:
    file, report = (
        file_of(tmp_path, TWO.replace('packs = ["no-such-pack"]', "")),
        tmp_path / "report",
    )
    code, out, _ = drapery("golden", "check", file, "--report", report)
    assert code == 1 and "0 as before, 2 not" in out
    assert "1 of 1 golden written" in drapery("golden", "update", file, "--only", "second")[1]
    code, out, _ = drapery("golden", "check", file, "--only", "second", "--report", report)
    assert code == 0 and out.startswith("1 as before, 0 not; see ")
    # What did not run keeps its entry.
    assert [path.name[:10] for path in report.glob("*.failure.json")] == ["case-first"]
    code, _, err = drapery("golden", "check", file, "--only", "third")
    assert code == 2 and "there is no case 'third'; the first cases are first, second" in err
