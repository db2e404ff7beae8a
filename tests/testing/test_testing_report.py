"""The report of changed goldens: its page, its table for a CI job, and accepted pictures."""

import json
import os
import re
import subprocess
from pathlib import Path
from shutil import copytree

import numpy as np
import pytest
import yaml
from conftest import Run
from PIL import Image

from drapery.errors import OutputError
from drapery.render import Frame
from drapery.testing import GoldenUpdate, accept_failures, keep_failure, markdown_report
from drapery.testing.failures import read_approvals

ROOT = Path(__file__).parents[2]
TEXTURE = "pack/assets/minecraft/textures/entity/banner/creeper.png"
pytest_plugins = ["pytester"]


@pytest.fixture
def pack(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The example pack as the present folder, with one texel of its heart changed."""
    folder = tmp_path / "pack"
    copytree(ROOT / "examples/pack", folder)
    with Image.open(folder / TEXTURE) as opened:
        texels = np.array(opened.convert("RGBA"))
    texels[20, 10, 3] = 0
    Image.fromarray(texels).save(folder / TEXTURE)
    monkeypatch.chdir(folder)
    return folder


def test_a_changed_texel_is_named_accepted_and_then_as_before(drapery: Run, pack: Path) -> None:
    code, out, _ = drapery("golden", "check", "cases.toml", "--summary", "summary.md")
    assert code == 1 and "0 as before, 3 not" in out
    summary = Path("summary.md").read_text(encoding="utf-8")
    assert "**3 goldens changed.**" in summary
    assert "layer 1 \\(creeper, red\\) has 1 changed texel" in summary
    page = Path("drapery-report/index.html").read_text(encoding="utf-8")
    assert page.count('<section id="') == 3 and page.count("data:image/png") == 9
    assert page.count('data-frames="12" data-columns="4" data-fps="10.0"') == 3
    assert "http" not in re.sub(r"base64,[^\"]+", "", page)

    (heart,) = Path("drapery-report").glob("case-heart-????????.failure.json")
    decisions = {"accepted": [heart.name.partition(".")[0]], "rejected": []}
    Path("approvals.json").write_text(json.dumps(decisions), encoding="utf-8")
    code, out, _ = drapery("golden", "accept", "--only", "approvals.json")
    assert (code, out) == (0, "wrote goldens/heart.png\n1 golden written\n")
    assert "1 as before, 2 not" in drapery("golden", "check", "cases.toml")[1]
    assert "2 goldens written" in drapery("golden", "accept")[1]
    assert drapery("golden", "check", "cases.toml")[0] == 0


def failure(golden: str) -> None:
    """One failed picture in the folder `report`."""
    frame = Frame(np.full((2, 2, 4), 255, np.uint8))
    update = GoldenUpdate(Path(golden), b"golden")
    keep_failure(Path("report"), "case", "<one>", frame, frame, "a|b `c`\n# d", update)


@pytest.mark.parametrize("golden", ["../outside.png", "/etc/outside.png", "setup.py", ""])
def test_a_report_cannot_write_outside_the_project_or_other_files(
    golden: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    failure("goldens/one.png")
    (facts,) = Path("report").glob("*.failure.json")
    known = json.loads(facts.read_text(encoding="utf-8"))
    facts.write_text(json.dumps(known | {"golden": golden}), encoding="utf-8")
    with pytest.raises(OutputError, match="is not a golden in this folder"):
        list(accept_failures(Path("report")))
    assert [path.name for path in tmp_path.iterdir()] == ["report"]


def test_unknown_pictures_and_files_without_decisions_are_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    failure("one.png")
    with pytest.raises(OutputError, match="has no picture 'other'"):
        list(accept_failures(Path("report"), ["other"]))
    for text in ("", "[]", '{"accepted": 1}', '{"accepted": [1]}', "[" * 100_000):
        Path("approvals.json").write_text(text, encoding="utf-8")
        with pytest.raises(OutputError, match="has no decisions"):
            read_approvals(Path("approvals.json"))


def test_texts_in_the_table_are_shown_as_they_are(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    failure("one.png")
    assert "| case \\[\\<one\\>\\] | a\\|b \\`c\\` \\# d |" in markdown_report(Path("report"))
    assert markdown_report(Path("empty")) == "All goldens are as before.\n"


def test_pytest_writes_the_page_where_it_is_told(pytester: pytest.Pytester) -> None:
    pytester.makepyfile(
        "import numpy as np\ndef test_one(golden):\n    golden(np.full((4, 4, 4), 255, np.uint8))\n"
    )
    result = pytester.runpytest_inprocess("--drapery-report", "my out/report.html")
    result.assert_outcomes(failed=1)
    page = (pytester.path / "my out/report.html").read_text(encoding="utf-8")
    assert "<section" in page
    # Neither cmd nor PowerShell 5.1 knows single quotes.
    assert "drapery golden accept &#34;my out/report.files&#34; --only" in page
    assert list((pytester.path / "my out/report.files").glob("*.actual.png"))
    result = pytester.runpytest_inprocess(
        "--drapery-report", "my out/report.html", "--drapery-update"
    )
    result.assert_outcomes(passed=1)
    assert not (pytester.path / "my out/report.html").exists()


def test_the_action_and_the_hook_call_commands_that_exist(tmp_path: Path) -> None:
    action = yaml.safe_load((ROOT / "action.yml").read_text(encoding="utf-8"))
    scripts = [step["run"] for step in action["runs"]["steps"] if "run" in step]
    assert scripts[0] == '"$ACTION/release/check_goldens.sh"'
    assert all("${{" not in script for script in scripts), "inputs must come by the environment"
    if os.name == "posix":
        summary = tmp_path / "summary.md"
        told = os.environ | {"URL": "https://host/1", "GITHUB_STEP_SUMMARY": str(summary)}
        subprocess.run(["bash", "-ec", *scripts[1:]], env=told, check=True)
        assert summary.read_text() == "\n[Pictures: index.html in the report](https://host/1)\n"
        assert (ROOT / "release/check_goldens.sh").stat().st_mode & 0o111
    (hook,) = yaml.safe_load((ROOT / ".pre-commit-hooks.yaml").read_text(encoding="utf-8"))
    assert hook["entry"] == "drapery golden check" and hook["args"] == ["cases.toml"]
