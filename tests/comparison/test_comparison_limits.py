"""Each limit has one name and one meaning in the command, the fixture, cases and defaults."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import Run
from PIL import Image

from drapery.comparison import LIMIT_OPTIONS, Tolerance, measure, read_picture, read_tolerance
from drapery.errors import OptionError

pytest_plugins = ["pytester"]

LIMITS: dict[str, tuple[Any, Any]] = {
    "tolerance": (3, 2),
    "pixels": (1, 0),
    "ratio": (0.001, 0.0001),
    "colour": (0.9, 0.0),
    "antialiasing": (False, True),
    "ignore": ("{x},{y},1,1", "0,0,1,1"),
    "mask": ("mask.png", "blank.png"),
}
"""A value of each limit with which the pictures of `pictures` agree, and one with which not."""
MEASURES: dict[str, tuple[Any, Any]] = {"flip": (1, 0), "ssim": (0, 1), "ciede2000": (200, 0)}
"""The same for the limits that hold beside the others."""
CASE = '[[case]]\nname = "one"\ndesign = "white creeper:lime"\nsize = "32x40"\n'


@pytest.fixture
def pictures(tmp_path: Path, drapery: Run) -> Path:
    """A folder with cases.toml, its picture actual.png, and the golden, of which a pixel of a
    smoothed edge differs by 3; mask.png covers it."""
    (tmp_path / "cases.toml").write_text(CASE)
    assert drapery("golden", "update", tmp_path / "cases.toml")[0] == 0
    golden = tmp_path / "goldens" / "one.png"
    (pixels,) = read_picture(golden).frames
    (tmp_path / "actual.png").write_bytes(golden.read_bytes())
    for y, x in np.argwhere(pixels[..., 3] == 255):
        other = pixels.copy()
        other[y, x, :3] = np.where(other[y, x, :3] > 9, other[y, x, :3] - 3, other[y, x, :3] + 3)
        if measure(other, pixels, Tolerance(antialiasing=False)).smoothed:
            break
    Image.fromarray(other).save(golden)
    mask = np.zeros(pixels.shape[:2], np.uint8)
    Image.fromarray(mask).save(tmp_path / "blank.png")
    mask[y, x] = 255
    Image.fromarray(mask).save(tmp_path / "mask.png")
    (tmp_path / "place.json").write_text(json.dumps({"x": int(x), "y": int(y)}))
    return tmp_path


def values(name: str, folder: Path) -> tuple[Any, Any]:
    place = json.loads((folder / "place.json").read_text())
    return tuple(value.format(**place) if name == "ignore" else value for value in LIMITS[name])  # type: ignore[return-value]


def test_each_limit_is_tested() -> None:
    assert set(LIMITS) | set(MEASURES) == set(LIMIT_OPTIONS)


@pytest.mark.parametrize("name", LIMITS)
def test_limits_of_the_command(pictures: Path, drapery: Run, name: str) -> None:
    both = ("compare", pictures / "goldens" / "one.png", pictures / "actual.png")
    assert drapery(*both)[0] == 1
    for code, value in enumerate(values(name, pictures)):
        if name == "antialiasing":
            words = [f"--{'' if value else 'no-'}antialiasing"]
        else:
            words = [f"--{name}", str(pictures / value if name == "mask" else value)]
        assert drapery(*both, *words)[0] == code


@pytest.mark.parametrize("name", LIMITS)
def test_limits_of_cases(pictures: Path, drapery: Run, name: str) -> None:
    file, report = pictures / "cases.toml", ("--report", pictures / "report")
    assert drapery("golden", "check", file, *report)[0] == 1
    for code, value in enumerate(values(name, pictures)):
        line = f"{name} = {json.dumps(value)}\n"
        for text in (CASE + line, f"[defaults]\n{line}{CASE}"):
            file.write_text(text)
            assert drapery("golden", "check", file, *report)[0] == code


@pytest.mark.slow
def test_limits_of_the_fixture_and_of_a_project(
    pictures: Path, pytester: pytest.Pytester, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(pytester.path)
    for path in pictures.glob("*.png"):
        (pytester.path / path.name).write_bytes(path.read_bytes())
    chosen = {name: values(name, pictures) for name in LIMITS}
    pytester.makepyfile(
        test_it=f"""
import pytest
CHOSEN = {[(name, value) for name, both in chosen.items() for value in both]}

@pytest.mark.parametrize("name, value", CHOSEN)
def test_it(golden, name, value):
    golden("actual.png", "a", **{{name: value}})

def test_plain(golden):
    golden("actual.png", "a")
"""
    )
    run = pytester.runpytest_inprocess
    run("-p", "no:cacheprovider", "--drapery-update").assert_outcomes(passed=2 * len(LIMITS) + 1)
    changed = (pictures / "goldens" / "one.png").read_bytes()
    for path in pytester.path.glob("goldens/*/*.png"):
        path.write_bytes(changed)
    half = len(LIMITS)
    run("-p", "no:cacheprovider").assert_outcomes(passed=half, failed=half + 1)
    for name, (right, wrong) in chosen.items():
        for value, outcome in ((right, {"passed": 1}), (wrong, {"failed": 1})):
            pytester.makeini(f"[pytest]\ndrapery_{name} = {value}")
            run("-p", "no:cacheprovider", "-k", "plain").assert_outcomes(
                deselected=2 * half, **outcome
            )


def test_perceptual_limits_have_the_same_names_too(pictures: Path, drapery: Run) -> None:
    pytest.importorskip("flip_evaluator")
    both = ("compare", pictures / "goldens" / "one.png", pictures / "actual.png", "--tolerance", 3)
    file = pictures / "cases.toml"
    for name, chosen in MEASURES.items():
        for code, value in enumerate(chosen):
            assert drapery(*map(str, both), f"--{name}", str(value))[0] == code
            file.write_text(f"{CASE}tolerance = 3\n{name} = {value}\n")
            assert drapery("golden", "check", file, "--report", pictures / "report")[0] == code
            found = read_tolerance({name: str(value)})
            assert getattr(found, name) == value


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"tolerance": "much"}, "tolerance 'much' is not a number; use 0 to 255"),
        ({"pixels": 1.5}, "pixels 1.5 is not a whole number"),
        ({"ratio": 2}, "ratio 2 is out of range; use 0 to 1"),
        ({"antialiasing": "maybe"}, "antialiasing 'maybe' is not yes or no"),
        ({"ignore": "1,2,3"}, "ignore '1,2,3' is not a box; write it like 10,20,64,32"),
        ({"ignore": [[0, 0, 0, 1]]}, "is not a box: left, top, width, height"),
        ({"mask": "none.png"}, "none.png"),
        ({"flip": float("nan")}, "flip nan is out of range; use 0 to 1"),
    ],
)
def test_a_wrong_limit_is_one_line(given: dict[str, Any], message: str) -> None:
    with pytest.raises(OptionError, match=r"(?s)^[^\n]*$") as refused:
        read_tolerance(given)
    assert message in str(refused.value)


def test_a_wrong_limit_names_its_place(pytester: pytest.Pytester, drapery: Run) -> None:
    pytester.makepyfile(
        test_it="""
import numpy as np
PLAIN = np.zeros((2, 2, 4), np.uint8)
def test_name(golden): golden(PLAIN, toleranse=3)
def test_hashed(golden): golden(PLAIN, hashed=True, tolerance=3)
def test_default(golden): golden(PLAIN)
def test_own(golden): golden(PLAIN, ratio=0.5)
def test_box(golden): golden(PLAIN, "b", ignore=(5, 5, 1, 1), tolerance=0)
"""
    )
    assert pytester.runpytest_inprocess("--drapery-update", "-k", "default or own or box").ret == 0
    pytester.makeini("[pytest]\ndrapery_ratio = half")
    result = pytester.runpytest_inprocess("-p", "no:cacheprovider")
    result.assert_outcomes(failed=4, passed=1)
    result.stdout.fnmatch_lines(
        [
            "'toleranse' is not an option; did you mean tolerance?",
            "tolerance does nothing for a hashed golden; leave one out",
            "drapery_... in pytest's configuration: ratio 'half' is not a number; use 0 to 1",
        ]
    )
    (pytester.path / "cases.toml").write_text(CASE + "hashed = true\npixels = 3\n")
    code, _, err = drapery("golden", "check", pytester.path / "cases.toml")
    assert code == 2 and "case 'one': pixels does nothing in a hashed case" in err
    (pytester.path / "cases.toml").write_text(CASE + "tolerance = 300\n")
    code, _, err = drapery("golden", "check", pytester.path / "cases.toml")
    assert code == 2 and "case 'one': tolerance 300 is out of range; use 0 to 255" in err


def test_a_mask_of_one_of_two_sizes_leaves_the_sizes_to_be_told(
    tmp_path: Path, drapery: Run
) -> None:
    for name, size in (("a", (6, 8)), ("b", (9, 5)), ("mask", (6, 8)), ("other", (5, 5))):
        Image.new("RGB", size, "white").save(tmp_path / f"{name}.png")
    words = [tmp_path / f"{name}.png" for name in ("a", "b")]
    code, out, _ = drapery("compare", *words, "--mask", tmp_path / "mask.png")
    assert code == 1 and "the sizes 6x8 and 9x5; 15 pixels differ" in out
    code, _, err = drapery("compare", *words, "--mask", tmp_path / "other.png")
    assert code == 2 and "the mask is 5x5 and the picture 9x8" in err
