"""The files of the repository to which pages link: the site has them under `files/`.

A page links to a file as it lies in a checkout. A folder becomes an archive of the same name.
"""

import io
import logging
import os
import re
import subprocess
import zipfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from mkdocs.structure.files import File, InclusionLevel

ROOT = Path(__file__).resolve().parent.parent
DOCS = ROOT / "docs"
FOLDER = "files"
LINK = re.compile(r"(?<=\])\(((?:\.\./)+[\w./-]+)\)")


def linked_files(files: Any, config: Any) -> list[File]:
    """What pages link to outside of the docs, as files of the site.

    files: those of the site, config: its configuration.
    """
    pages = [file for file in files if file.is_documentation_page() and file.abs_src_path]
    found = {path for page in pages for path in _targets(page)}
    return [
        File.generated(
            config, _place(path), inclusion=InclusionLevel.INCLUDED, content=_content(path)
        )
        for path in sorted(found)
    ]


def with_links(text: str, source: str) -> str:
    """The text of a page with its links to files of the repository led to those of the site.

    source: the page's path in the docs.
    """
    folder = (DOCS / source).parent

    def replace(found: re.Match[str]) -> str:
        path = (folder / found[1]).resolve()
        if path.is_relative_to(DOCS):
            return found[0]
        if not path.exists():
            logging.getLogger("mkdocs.hooks").warning("%s: no %s", source, found[1])
        return f"({Path(os.path.relpath(DOCS / _place(path), folder)).as_posix()})"

    return LINK.sub(replace, text)


def _targets(page: Any) -> Iterator[Path]:
    """The files and folders of the repository to which a page links."""
    folder = Path(page.abs_src_path).parent
    for target in LINK.findall(Path(page.abs_src_path).read_text("utf-8")):
        path = (folder / target).resolve()
        if path.exists() and path.is_relative_to(ROOT) and not path.is_relative_to(DOCS):
            yield path


def _place(path: Path) -> str:
    """Where a file lies in the site. Markdown is text there, for its links fit a checkout."""
    ending = ".zip" if path.is_dir() else ".txt" if path.suffix == ".md" else ""
    return f"{FOLDER}/{path.relative_to(ROOT).as_posix()}{ending}"


def _content(path: Path) -> bytes:
    """The bytes of a file, or an archive of a folder: the same for the same files."""
    if path.is_file():
        return path.read_bytes()
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as archive:
        for each in sorted(_kept(path)):
            entry = zipfile.ZipInfo(each.relative_to(path.parent).as_posix())
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = 0o100644 << 16
            archive.writestr(entry, each.read_bytes())
    return content.getvalue()


def _kept(folder: Path) -> list[Path]:
    """The files of a folder that git knows; all of them in an unpacked archive of the sources."""
    command = ["git", "-C", folder, "ls-files", "-z"]
    listed = subprocess.run(command, capture_output=True, text=True).stdout.split("\0")
    return [folder / name for name in listed if name] or [
        path for path in folder.rglob("*") if path.is_file()
    ]
