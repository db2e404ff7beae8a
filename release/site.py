"""Build the site: `python -m release.site [-o site]`.

The designer is at its root, the docs, with live cloth, in `docs/`, and what can be installed in
`packages/`; each leads to the others. All links are relative, so the site works under any path. The
kernels that pages play must have been compiled before: `python -m drapery.web.wasm.build`.

A designer that loads over 260 kB at first, or a page of one file of over 300 kB, is an error.
"""

import argparse
import gzip
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path

from drapery import Banner, Settings
from drapery.web.designer_page import PAGE, write_designer
from drapery.web.page import SIZE, page_text
from release import packages
from release.build import ROOT, epoch

DOCS = "docs"
DESIGNER = f"../{PAGE}"
"""The designer's address for the first page of the docs."""
LINKS = {
    "docs/index.html": "Docs",
    "docs/guides/web.html": "Put it on a page",
    "docs/guides/index.html": "Guides",
    "docs/reference/live-gallery.html": "Live gallery",
    f"{packages.FOLDER}/index.html": "Install",
}
LATER = ("-still.bin", "-fabrics.bin", "wall.bin", "shield.bin", ".d.ts")
"""The endings of files that a page loads only when they are wanted, or never."""
MAX_LOAD = 260_000
"""The most bytes that the designer loads at first."""
MAX_PAGE = 300_000
"""The most bytes of a page of one file with a banner."""
STYLE = """nav {
  display: flex; flex-wrap: wrap; justify-content: flex-end; gap: 0.25rem 1.25rem;
  padding: 0.625rem 1rem 0; max-inline-size: 98rem; margin-inline: auto;
  font: 0.9375rem/1.4 system-ui, sans-serif;
}
nav a { color: light-dark(#9c2f27, #e0796f); }
drapery-designer { min-block-size: calc(100vh - 2rem) !important; }
</style>
"""


def build(out: Path, files: Sequence[Path]) -> None:
    """Write the site into a folder, with files that can be installed.

    Raises CalledProcessError where the docs have a fault.
    """
    words = ("build", "--strict", "--quiet", "-f", "mkdocs.yml", "-d", (out / DOCS).resolve())
    env = os.environ | {"DRAPERY_DESIGNER": DESIGNER, "SOURCE_DATE_EPOCH": str(epoch())}
    command = [sys.executable, "-m", "properdocs", *words]
    subprocess.run(command, cwd=ROOT, env=env, check=True, stdout=sys.stderr)
    packages.publish(files, out)
    with tempfile.TemporaryDirectory() as name:
        write_designer(Path(name), Settings(size=SIZE))
        check_sizes(Path(name), page_text(Banner.parse("white creeper:lime"), Settings()))
        put_files(Path(name), out)
    page = out / PAGE
    page.write_text(linked(page.read_text("utf-8")), "utf-8", newline="\n")


def put_files(folder: Path, out: Path) -> None:
    """Copy the files of a folder into another, which keeps its rights.

    Those of a temporary folder let no other user in, so a server could read nothing.
    """
    for path in folder.iterdir():
        shutil.copy(path, out)


def sent_bytes(folder: Path) -> dict[str, int]:
    """The bytes of each file as a server sends it: texts gzipped, the others as they are."""
    files = {path.name: path.read_bytes() for path in sorted(folder.iterdir())}
    return {
        name: len(data) if name.endswith(".bin") else len(gzip.compress(data, 9))
        for name, data in files.items()
    }


def loaded_first(sizes: Mapping[str, int]) -> int:
    """The bytes that the designer loads before it shows a banner."""
    return sum(size for name, size in sizes.items() if not name.endswith(LATER))


def check_sizes(designer: Path, page: str) -> None:
    """Raise SystemExit for a designer's folder or a page of one file that is too large."""
    first, whole = loaded_first(sent_bytes(designer)), len(page.encode())
    if first > MAX_LOAD:
        raise SystemExit(f"the designer loads {first} bytes at first: over {MAX_LOAD}")
    if whole > MAX_PAGE:
        raise SystemExit(f"a page of one file has {whole} bytes: over {MAX_PAGE}")


def linked(page: str) -> str:
    """The designer's page with links to the docs and packages above it."""
    links = "".join(f'<a href="{target}">{title}</a>' for target, title in LINKS.items())
    page = page.replace("</style>\n", STYLE, 1)
    return page.replace("<body>\n", f'<body>\n<nav aria-label="Site">{links}</nav>\n', 1)


def main(words: Sequence[str] | None = None) -> None:
    """The command."""
    parser = argparse.ArgumentParser("python -m release.site", description=__doc__)
    parser.add_argument("-o", "--out", type=Path, default=Path("site"))
    out = parser.parse_args(words).out
    with tempfile.TemporaryDirectory() as name:
        packages.make(Path(name), None)
        build(out, list(Path(name).glob("*/*")))


if __name__ == "__main__":
    main()
