"""Other processes of the package run the same package, wherever they start."""

import re
import subprocess
from pathlib import Path

import drapery
from drapery.module_process import module_command


def test_a_module_is_that_of_this_process_in_a_folder_with_another_package(tmp_path: Path) -> None:
    (tmp_path / "drapery").mkdir()
    (tmp_path / "drapery" / "__init__.py").write_text("raise SystemExit('another package')\n")
    command = module_command("drapery", "--version")
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, "")
    assert drapery.__version__ in done.stdout


def test_no_process_is_started_with_modules_of_the_working_directory() -> None:
    started = re.compile(r'"-m",\s*"drapery')
    sources = sorted(Path(drapery.__file__).parent.rglob("*.py"))
    assert len(sources) > 300
    assert [each.name for each in sources if started.search(each.read_text("utf-8"))] == []
