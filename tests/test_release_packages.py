"""The packages of a site: pip installs from their page, which names each file."""

import os
import re
import subprocess
import sys
import zipfile
from collections.abc import Iterator
from pathlib import Path

import pytest
from web_sites import served

from release import packages

NAMES = (
    *("drapery_mc-9.9-py3-none-any.whl", "drapery_mc-9.9.tar.gz"),
    *("drapery-banner-9.9.tgz", "drapery_banners.py"),
)


def write_wheel(path: Path) -> None:
    """The smallest wheel: a module, and what it is."""
    about = path.stem.rsplit("-", 3)[0] + ".dist-info"
    with zipfile.ZipFile(path, "w") as wheel:
        wheel.writestr("made_up.py", "FOUND = True\n")
        wheel.writestr(
            f"{about}/METADATA", "Metadata-Version: 2.1\nName: drapery-mc\nVersion: 9.9\n"
        )
        tags = "Root-Is-Purelib: true\nTag: py3-none-any\n"
        wheel.writestr(f"{about}/WHEEL", f"Wheel-Version: 1.0\nGenerator: test\n{tags}")
        wheel.writestr(f"{about}/RECORD", "")


@pytest.fixture
def site(tmp_path: Path) -> Path:
    """A site that has nothing but packages."""
    made = tmp_path / "made"
    made.mkdir()
    for name in NAMES:
        (made / name).write_text(name, "utf-8")
    write_wheel(made / NAMES[0])
    packages.publish(list(made.iterdir()), tmp_path / "site")
    return tmp_path / "site"


@pytest.fixture
def address(site: Path) -> Iterator[str]:
    yield from served(site)


def test_the_page_links_to_each_file(site: Path) -> None:
    folder = site / packages.FOLDER
    page = (folder / "index.html").read_text("utf-8")
    assert re.findall(r'<li><a href="(.+?)">', page) == list(NAMES)
    assert {path.name for path in folder.iterdir()} == {*NAMES, "index.html"}


def test_a_second_site_replaces_the_files_of_the_first(site: Path, tmp_path: Path) -> None:
    packages.publish([tmp_path / "made" / NAMES[3]], site)
    assert len(list((site / packages.FOLDER).iterdir())) == 2


def test_pip_installs_from_the_page(address: str, tmp_path: Path) -> None:
    """The command of the docs, without the package index."""
    words = ("install", "--no-index", "--find-links", f"{address}/{packages.FOLDER}/", "drapery-mc")
    command = [sys.executable, "-m", "pip", *words, "--target", tmp_path / "installed"]
    env = os.environ | {"NO_PROXY": "127.0.0.1", "no_proxy": "127.0.0.1"}
    subprocess.run([*command, "--quiet", "--no-cache-dir"], env=env, check=True, timeout=120)
    assert (tmp_path / "installed" / "made_up.py").read_text("utf-8") == "FOUND = True\n"
